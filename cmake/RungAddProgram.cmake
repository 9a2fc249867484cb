# SPDX-License-Identifier: Apache-2.0
# rung_add_program(<target> SOURCES <file|folder>... [NAME <id>] [ROOT <folder>] [OPTIONS <option>...] [FILES <n>]
#                  [RUNTIME <part>...])
#
# Compiles PLC programs with `rung emit` and adds the C++ to <target> (an existing executable or library). The module
# is <id>_module() of rung/module.h. A changed source runs `rung emit` again; a C++ file is compiled again only when its
# content has changed. SOURCES may be folders: new files in them are found, too.
# NAME: prefix of the module's symbols (default: the target's name). ROOT: paths in messages are relative to it
# (default: the folder of the call). OPTIONS: further options of `rung emit`. FILES: the number of C++ files (default:
# 8); their names do not depend on the program, so CMake need not run again. RUNTIME: the parts of the runtime to link, of
# core, motion and nct (default: runtime, all); a program without axes needs core.
#
# Uses the targets Rung::<part> and Rung::rung, the tool, which runs on the machine that builds (RUNG_EXECUTABLE: another
# one). The size of a pointer is that of the target.
include_guard(GLOBAL)

# Appends arguments to the text of a response file of rung, one in a line.
function(rung_append_arguments variable)
  set(text "${${variable}}")
  foreach(argument IN LISTS ARGN)
    if(argument MATCHES "^\\$<")
      string(APPEND text "$<$<BOOL:${argument}>:\"$<JOIN:${argument},\"\n\">\"\n>")
    else()
      string(REGEX REPLACE "([\"\\])" "\\\\\\1" argument "${argument}")
      string(APPEND text "\"${argument}\"\n")
    endif()
  endforeach()
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

function(rung_add_program target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "NAME;ROOT;FILES" "SOURCES;OPTIONS;RUNTIME")
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "rung_add_program(${target}): unknown arguments: ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT ARG_SOURCES)
    message(FATAL_ERROR "rung_add_program(${target}): SOURCES are missing")
  endif()
  if(NOT ARG_NAME)
    string(MAKE_C_IDENTIFIER "${target}" ARG_NAME)
  endif()
  if(NOT ARG_ROOT)
    set(ARG_ROOT ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  if(NOT ARG_FILES)
    set(ARG_FILES 8)
  endif()
  if(NOT ARG_RUNTIME)
    set(ARG_RUNTIME runtime)
  endif()
  list(TRANSFORM ARG_RUNTIME PREPEND Rung::)
  if(RUNG_EXECUTABLE)
    set(tool ${RUNG_EXECUTABLE})
  else()
    set(tool $<TARGET_FILE:Rung::rung>)
  endif()

  set(sources)
  foreach(source ${ARG_SOURCES})
    get_filename_component(source ${source} ABSOLUTE)
    list(APPEND sources ${source})
  endforeach()
  if(CMAKE_SIZEOF_VOID_P)
    list(PREPEND ARG_OPTIONS --target-pointer=${CMAKE_SIZEOF_VOID_P})
  endif()
  set(place ${target}.rung/${ARG_NAME})  # in the folder where commands run
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${place})
  set(stamp ${folder}.stamp)
  set(bundles)
  math(EXPR last "${ARG_FILES} - 1")
  foreach(number RANGE ${last})
    list(APPEND bundles ${folder}/${ARG_NAME}_bundle_${number}.cpp)
  endforeach()

  # Ninja and make print the command of a step that fails before its messages. The arguments are in a file, so that
  # the messages are seen.
  set(arguments)
  rung_append_arguments(arguments --bundles=${ARG_FILES} --name=${ARG_NAME} --root=${ARG_ROOT} --depfile=${stamp}.d
                        --depfile-target=${stamp} -o ${folder} ${ARG_OPTIONS} -- ${sources})
  get_property(is_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
  set(response ${place}.arguments)
  if(is_multi_config)
    string(APPEND response .$<CONFIG>)
  endif()
  file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${response} CONTENT "${arguments}")

  # The stamp is the first output and the depfile's target, the C++ files are by-products: so neither Ninja nor make
  # runs rung again when there is nothing to do, and neither compiles a file that rung left untouched. Ninja prints all
  # outputs of a step that fails; there the C++ files are those of a second step, which finds out which have changed.
  set(byproducts BYPRODUCTS ${bundles})
  if(CMAKE_GENERATOR MATCHES "Ninja")
    set(byproducts)
    add_custom_command(OUTPUT ${bundles} COMMAND ${CMAKE_COMMAND} -E true DEPENDS ${stamp}
                       COMMENT "Looking for changed files of ${ARG_NAME}" VERBATIM)
  endif()
  add_custom_command(
    OUTPUT ${stamp}
    ${byproducts}
    COMMAND ${tool} emit @${response}
    COMMAND ${CMAKE_COMMAND} -E touch ${place}.stamp
    DEPFILE ${stamp}.d
    DEPENDS ${tool} ${CMAKE_CURRENT_BINARY_DIR}/${response}
    COMMENT "Compiling ${ARG_NAME} with rung"
    VERBATIM)
  target_sources(${target} PRIVATE ${stamp} ${bundles})
  set_source_files_properties(${stamp} PROPERTIES HEADER_FILE_ONLY TRUE)
  set_source_files_properties(${bundles} PROPERTIES GENERATED TRUE SKIP_AUTOGEN TRUE
                                                    COMPILE_OPTIONS "-ffp-contract=off;-fvisibility=hidden")
  target_compile_features(${target} PRIVATE cxx_std_17)
  target_link_libraries(${target} PRIVATE ${ARG_RUNTIME})
endfunction()
