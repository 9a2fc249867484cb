# SPDX-License-Identifier: Apache-2.0
# rung_precompile(<target> [HEADERS <header>...])      makes the precompiled header that others reuse
# rung_precompile(<target> REUSE <owner>)               uses that of <owner>, whose flags must be the same
# Without it two thirds of a build go into parsing standard headers. Off (RUNG_PRECOMPILE) in the preset fuzz,
# which so checks that each file includes what it uses.
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
