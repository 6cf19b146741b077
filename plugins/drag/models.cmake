dust_plugin(drag ergun)
dust_plugin(drag gidaspow)
dust_plugin(drag wen_yu)
