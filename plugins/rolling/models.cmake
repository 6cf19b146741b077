dust_plugin(rolling epsd2)
