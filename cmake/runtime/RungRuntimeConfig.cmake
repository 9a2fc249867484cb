# SPDX-License-Identifier: Apache-2.0
# The runtime for one processor, compiled and installed by share/rung/runtime/CMakeLists.txt. find_package(Rung) finds it.
include(${CMAKE_CURRENT_LIST_DIR}/RungRuntimeTargets.cmake)
