# find_package(Rung CONFIG): the tool Rung::rung, the libraries Rung::runtime and Rung::host, and rung_add_program().
include(CMakeFindDependencyMacro)
find_dependency(Threads)
include(${CMAKE_CURRENT_LIST_DIR}/RungTargets.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/RungAddProgram.cmake)
