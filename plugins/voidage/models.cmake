dust_plugin(voidage centre)
dust_plugin(voidage divided)
