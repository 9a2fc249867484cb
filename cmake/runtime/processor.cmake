# SPDX-License-Identifier: Apache-2.0
# rung_processor(<variable>): what a runtime was compiled for, or a product is: system, processor, compiler, size of a
# pointer, and the flags of the toolchain file that choose instructions (-mcpu=..., -mthumb, ...).
function(rung_processor variable)
  string(REGEX MATCHALL "-m[^ ]+" flags "${CMAKE_CXX_FLAGS}")
  list(REMOVE_DUPLICATES flags)
  list(SORT flags)
  set(words ${CMAKE_SYSTEM_NAME} ${CMAKE_SYSTEM_PROCESSOR} ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_TARGET}
            ${CMAKE_SIZEOF_VOID_P} ${flags})
  list(JOIN words " " words)
  set(${variable} "${words}" PARENT_SCOPE)
endfunction()
