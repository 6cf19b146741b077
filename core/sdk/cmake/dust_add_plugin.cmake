# dust_add_plugin(NAME SOURCE...)
# dust_add_plugin([KIND] NAME SOURCES SOURCE...)
#
# One plugin library NAME.so (KIND_NAME.so where the kind is given) as a target of the same name.
# It is put at the top of the build folder, so that `engine --plugin-path build` finds it. Built with
# the flags that the engine's own models have: arithmetic without contraction, which gives the same
# bits for every instruction set; vectorised loops; Release unless another build type is chosen.
function(dust_add_plugin)
  cmake_parse_arguments(PARSE_ARGV 0 P "" "" "SOURCES")
  if(P_SOURCES)
    list(JOIN P_UNPARSED_ARGUMENTS "_" name)
    set(sources ${P_SOURCES})
  else()
    list(POP_FRONT P_UNPARSED_ARGUMENTS name)
    set(sources ${P_UNPARSED_ARGUMENTS})
  endif()
  if(NOT name OR NOT sources)
    message(FATAL_ERROR "dust_add_plugin: write dust_add_plugin(NAME SOURCE...)")
  endif()
  add_library(${name} MODULE ${sources})
  target_link_libraries(${name} PRIVATE dust::sdk)
  # g++ 12 sees uninitialised members in every std::variant and overlaps in every string it inlines.
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wno-unknown-pragmas -Wno-maybe-uninitialized
    -Wno-restrict -Wno-missing-field-initializers -fopenmp-simd -ffp-contract=off
    $<$<NOT:$<CONFIG:Debug>>:-O3 -fno-math-errno -fno-trapping-math>)
  # What nobody defines is told when linking, not when a run begins.
  target_link_options(${name} PRIVATE -Wl,--no-undefined)
  set_target_properties(${name} PROPERTIES
    PREFIX "" SUFFIX ".so" CXX_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(NOT CMAKE_LIBRARY_OUTPUT_DIRECTORY)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
  endif()
endfunction()
