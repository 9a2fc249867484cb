# SPDX-License-Identifier: Apache-2.0
# Rung::core, Rung::motion, Rung::nct and their sum Rung::runtime, from the sources that sources.mk lists. They need a C++17
# compiler and the C library of the target, and no C++ library. Included by the CMakeLists.txt of this folder, which installs
# them, and by RungConfig.cmake, which compiles them with the product.
include_guard(GLOBAL)

# The values of RUNG_<name> in sources.mk.
function(rung_runtime_list variable name)
  file(STRINGS ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/sources.mk values REGEX "^RUNG_${name} ")
  list(TRANSFORM values REPLACE "^RUNG_${name} [+]?= " "")
  set(${variable} ${values} PARENT_SCOPE)
endfunction()

rung_runtime_list(rung_flags FLAGS)
rung_runtime_list(rung_include INCLUDE)
list(TRANSFORM rung_include PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
get_filename_component(rung_headers ${CMAKE_CURRENT_LIST_DIR}/../include ABSOLUTE)
get_property(rung_shared GLOBAL PROPERTY TARGET_SUPPORTS_SHARED_LIBS)
foreach(part core motion nct)
  string(TOUPPER ${part} rung_name)
  rung_runtime_list(rung_sources ${rung_name})
  list(TRANSFORM rung_sources PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
  add_library(rung_${part} STATIC ${rung_sources})
  target_include_directories(rung_${part} PUBLIC $<BUILD_INTERFACE:${rung_headers}> $<INSTALL_INTERFACE:include>
                                          PRIVATE ${rung_include})
  target_compile_features(rung_${part} PUBLIC cxx_std_17)
  target_compile_options(rung_${part} PRIVATE ${rung_flags})
  target_link_libraries(rung_${part} PUBLIC m)
  set_target_properties(rung_${part} PROPERTIES EXPORT_NAME ${part} POSITION_INDEPENDENT_CODE ${rung_shared})
  add_library(Rung::${part} ALIAS rung_${part})
endforeach()
target_link_libraries(rung_motion PUBLIC rung_core)
target_link_libraries(rung_nct PUBLIC rung_core)
add_library(rung_runtime INTERFACE)
target_link_libraries(rung_runtime INTERFACE rung_motion rung_nct rung_core)
set_target_properties(rung_runtime PROPERTIES EXPORT_NAME runtime)
add_library(Rung::runtime ALIAS rung_runtime)
foreach(variable flags include headers shared name sources)
  unset(rung_${variable})
endforeach()
