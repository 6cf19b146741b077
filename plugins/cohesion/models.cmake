dust_plugin(cohesion sjkr)
dust_plugin(cohesion dmt)
dust_plugin(cohesion jkr)
dust_plugin(cohesion liquid_bridge)
