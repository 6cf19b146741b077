dust_plugin(motion belt)
