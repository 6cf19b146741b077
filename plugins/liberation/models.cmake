dust_plugin(liberation energy)
dust_plugin(liberation force_ratio)
dust_plugin(liberation given)
dust_plugin(liberation shear)
