dust_plugin(contact hertz_mindlin)
