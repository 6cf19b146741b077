dust_plugin(rolling epsd2)
dust_plugin(rolling epsd)
dust_plugin(rolling cdt)
