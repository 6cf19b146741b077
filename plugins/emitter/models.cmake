dust_plugin(emitter feed)
