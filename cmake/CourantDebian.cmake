# `cpack -G DEB` makes three packages: the command, with manual pages, completion and the experiments; libcourant-dev, what
# a program is built with that uses the libraries; and, where it is built, python3-courant. scripts/package does it.

if(BUILD_SHARED_LIBS)
  return() # a command that needs libraries of its own
endif()

set(COURANT_MAINTAINER "The developers of Courant <developers@courant.example>" CACHE STRING
    "Whom a Debian package names as its maintainer")

# The licence, and a changelog of one entry, as Debian wants them.
file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
string(REGEX REPLACE "^[^\n]*\n\n[^\n]*\n[^\n]*\n\n" "" licence "${licence}") # title and owners stand above
string(STRIP "${licence}" licence)
string(REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REPLACE "\n" "\n " licence " ${licence}")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
if(COURANT_WITH_SUITESPARSE)
  set(comment "
Comment:
 Programs and modules are linked with SuiteSparseQR, which is under the GPL,
 version 2 or later: as a whole they are distributed under those terms, see
 /usr/share/common-licenses/GPL-2.")
endif()
configure_file(cmake/debian/copyright.in debian/copyright @ONLY)
configure_file(cmake/debian/changelog.in debian/changelog @ONLY)

set(courant_debian_development libcourant-dev)
set(courant_debian_python python3-courant)
install(CODE "set(PAGES \"${PROJECT_BINARY_DIR}/pages\")
set(DEBIAN \"${PROJECT_BINARY_DIR}/debian\")
set(EXPERIMENTS \"${PROJECT_SOURCE_DIR}/experiments\")" COMPONENT debian EXCLUDE_FROM_ALL)
install(SCRIPT ${PROJECT_SOURCE_DIR}/cmake/install_debian.cmake COMPONENT debian EXCLUDE_FROM_ALL)
foreach(part development python)
  install(CODE "set(DEBIAN \"${PROJECT_BINARY_DIR}/debian\")
set(PACKAGE ${courant_debian_${part}})" COMPONENT debian_${part} EXCLUDE_FROM_ALL)
  install(SCRIPT ${PROJECT_SOURCE_DIR}/cmake/install_debian_library.cmake COMPONENT debian_${part} EXCLUDE_FROM_ALL)
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME courant)
set(CPACK_PACKAGE_CONTACT "${COURANT_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL command debian development debian_development)
if(COURANT_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python_in_debian debian_python)
endif()
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME courant)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION math)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${courant_debian_development})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libboost-dev, libeigen3-dev, nlohmann-json3-dev")
if(COURANT_WITH_SUITESPARSE)
  string(APPEND CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS ", libsuitesparse-dev, liblapack-dev")
endif()
if(COURANT_WITH_ARB)
  string(APPEND CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS ", libflint-arb-dev")
endif()
if(COURANT_WITH_PUGIXML)
  string(APPEND CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS ", libpugixml-dev")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME ${courant_debian_python})
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${courant_debian_python_depends}")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "gcc | c-compiler, python3-matplotlib")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    "${PROJECT_SOURCE_DIR}/cmake/debian/postinst;${PROJECT_SOURCE_DIR}/cmake/debian/prerm")
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# Without a compiler formulas are interpreted; without rsvg-convert figures are written as SVG only.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "gcc | c-compiler, librsvg2-bin")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "geometric integrators from Dirac structures")
set(about "\
Courant turns the geometric description of a mechanical or physical system
(a manifold, a Dirac structure, an energy) into a numerical integrator that
keeps the geometry, and says beforehand, by a numerical constraint algorithm,
whether and where the equations have solutions.
.
")
set(CPACK_COMPONENT_COMMAND_GROUP program)
set(CPACK_COMPONENT_DEBIAN_GROUP program)
set(CPACK_COMPONENT_DEVELOPMENT_GROUP library)
set(CPACK_COMPONENT_DEBIAN_DEVELOPMENT_GROUP library)
set(CPACK_COMPONENT_PYTHON_IN_DEBIAN_GROUP python)
set(CPACK_COMPONENT_DEBIAN_PYTHON_GROUP python)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "${about}\
This package contains the command, which reads experiments in JSON and writes
trajectories, reports and figures. `courant tour` is an introduction.")
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "${about}\
This package contains the static libraries and the headers, for programs that
make systems of their own in C++ and integrate them. CMake finds it by
find_package(Courant), other builds by pkg-config.")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "${about}\
This package contains the module for Python 3: equations, energies and
classes written with NumPy, results with the fields of SciPy.")
include(CPack)
