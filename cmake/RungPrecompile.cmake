# rung_precompile(<target> [HEADERS <header>...])      makes the precompiled header that others reuse
# rung_precompile(<target> REUSE <owner>)               reads that of <owner>, whose flags must be the same
# Two thirds of a build without it is the parsing of standard headers. Off (RUNG_PRECOMPILE) in the presets that prove
# that each file includes what it uses.
function(rung_precompile target)
  cmake_parse_arguments(ARG "" "REUSE" "HEADERS" ${ARGN})
  if(NOT RUNG_PRECOMPILE)
    return()
  endif()
  if(ARG_REUSE)
    target_precompile_headers(${target} REUSE_FROM ${ARG_REUSE})
  else()
    target_precompile_headers(${target} PRIVATE ${ARG_HEADERS})
  endif()
endfunction()
