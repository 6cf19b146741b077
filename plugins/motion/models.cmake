dust_plugin(motion belt)
dust_plugin(motion oscillate)
dust_plugin(motion rotate)
dust_plugin(motion translate)
