# SPDX-License-Identifier: Apache-2.0
# Contents of the packages that `cmake --install` and cpack make: the Debian packages rung and rung-cam-fit.
# tools/package/package.sh makes them, and the archive for any Linux.
set(RUNG_MAINTAINER "The authors of Rung <rung@example.org>" CACHE STRING "Who answers for the Debian packages")
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME common)
install(FILES NOTICE CHANGELOG.md README.md DESTINATION share/doc/rung COMPONENT common)
install(DIRECTORY samples DESTINATION share/rung COMPONENT common)
install(DIRECTORY tools/editors DESTINATION share/rung COMPONENT common)
configure_file(${PROJECT_SOURCE_DIR}/cmake/rung.pc.in ${PROJECT_BINARY_DIR}/rung.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/rung.pc DESTINATION lib/pkgconfig COMPONENT common)

# The documentation as HTML, when tools/site/site.sh has made it: in the folder $RUNG_SITE, else in build/site.
install(CODE "set(rung_site \"${PROJECT_BINARY_DIR}/site\")" COMPONENT common)
install(CODE [[
  if(DEFINED ENV{RUNG_SITE})
    set(rung_site "$ENV{RUNG_SITE}")
  endif()
  if(EXISTS "${rung_site}/index.html")
    file(INSTALL DESTINATION "${CMAKE_INSTALL_PREFIX}/share/doc/rung/html" TYPE DIRECTORY FILES "${rung_site}/")
  endif()
]] COMPONENT common)

# Files that Debian requires in each package; the date is that of the newest heading in CHANGELOG.md.
file(STRINGS CHANGELOG.md rung_heading REGEX "^## " LIMIT_COUNT 1)
string(REGEX MATCH "[0-9]+-[0-9]+-[0-9]+" rung_date "${rung_heading}")
if(NOT rung_heading MATCHES "^## ${PROJECT_VERSION} ")
  message(FATAL_ERROR "CHANGELOG.md does not begin with version ${PROJECT_VERSION}")
endif()
execute_process(COMMAND date -R -u -d ${rung_date} OUTPUT_VARIABLE rung_date OUTPUT_STRIP_TRAILING_WHITESPACE)
file(WRITE ${PROJECT_BINARY_DIR}/debian/copyright
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/

Files: *
Copyright: 2025-2026 The authors of Rung
License: Apache-2.0
 On Debian systems the text of the Apache License, version 2.0, is in
 /usr/share/common-licenses/Apache-2.0.
")
foreach(package rung rung-cam-fit)
  string(REPLACE rung-cam-fit cam_fit component ${package})
  string(REGEX REPLACE "^rung$" tool component ${component})
  file(WRITE ${PROJECT_BINARY_DIR}/debian/${package}/changelog
"${package} (${PROJECT_VERSION}) unstable; urgency=medium

  * See CHANGELOG.md.

 -- ${RUNG_MAINTAINER}  ${rung_date}
")
  execute_process(COMMAND gzip -9nf ${PROJECT_BINARY_DIR}/debian/${package}/changelog)
  install(FILES ${PROJECT_BINARY_DIR}/debian/copyright ${PROJECT_BINARY_DIR}/debian/${package}/changelog.gz
    DESTINATION share/doc/${package} COMPONENT ${component})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rung)
set(CPACK_PACKAGE_VENDOR "The authors of Rung")
set(CPACK_PACKAGE_CONTACT "${RUNG_MAINTAINER}")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL tool common cam_fit)
set(CPACK_COMPONENT_TOOL_GROUP rung)
set(CPACK_COMPONENT_COMMON_GROUP rung)
set(CPACK_COMPONENT_CAM_FIT_GROUP cam_fit)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_RUNG_PACKAGE_NAME rung)
set(CPACK_COMPONENT_RUNG_DESCRIPTION "compiler for the languages of IEC 61131-3
Rung checks, runs, tests, draws and formats PLC programs in ST, IL, LD, FBD,
CFC, SFC and C++, and compiles them to C++ for the firmware of a controller.")
set(CPACK_DEBIAN_RUNG_PACKAGE_SUGGESTS "g++, rung-cam-fit")
set(CPACK_DEBIAN_CAM_FIT_PACKAGE_NAME rung-cam-fit)
set(CPACK_DEBIAN_CAM_FIT_PACKAGE_DEPENDS "rung (= ${PROJECT_VERSION})")
set(CPACK_COMPONENT_CAM_FIT_DESCRIPTION "fits electronic cams to measured points
The part of Rung that rung cam fit loads; it needs Ceres.")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS OFF)
include(CPack)
