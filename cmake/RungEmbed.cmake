# SPDX-License-Identifier: Apache-2.0
# rung_embed(<target> <name> [PREFIX <prefix>] <file>...)
# Compiles files into <target>, which the same CMakeLists.txt defines, as a table sorted by name. The target includes
# "<name>.h": namespace rung::embedded { struct File { string_view name, text; }; extern const File <name>[]; extern
# const size_t <name>_count; }. A file's name is its path relative to PREFIX (default: the folder of the call).
function(rung_embed target name)
  cmake_parse_arguments(ARG "" "PREFIX" "" ${ARGN})
  if(NOT ARG_PREFIX)
    set(ARG_PREFIX ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  get_filename_component(prefix ${ARG_PREFIX} ABSOLUTE)
  set(files)
  foreach(file ${ARG_UNPARSED_ARGUMENTS})
    get_filename_component(file ${file} ABSOLUTE)
    list(APPEND files ${file})
  endforeach()
  set(out ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  set(list ${out}/${name}.list)
  list(JOIN files "\n" lines)
  file(CONFIGURE OUTPUT ${list} CONTENT "@lines@\n" @ONLY)  # untouched when the list is the same
  add_custom_command(
    OUTPUT ${out}/${name}.cpp ${out}/${name}.h
    COMMAND rung_embed_tool ${name} ${prefix} ${list} ${out}/${name}.cpp ${out}/${name}.h
    DEPENDS rung_embed_tool ${list} ${files}
    COMMENT "Embedding ${name}"
    VERBATIM)
  target_sources(${target} PRIVATE ${out}/${name}.cpp ${out}/${name}.h)
  target_include_directories(${target} PRIVATE ${out})
endfunction()
