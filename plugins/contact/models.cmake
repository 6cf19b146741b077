dust_plugin(contact hertz_mindlin)
dust_plugin(contact hooke)
