dust_plugin(turbulence smagorinsky)
