dust_plugin(voidage big_particle)
dust_plugin(voidage centre)
dust_plugin(voidage divided)
dust_plugin(voidage gaussian)
