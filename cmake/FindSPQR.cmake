# SuiteSparseQR as the target SuiteSparse::SPQR, which is also its name where SuiteSparse brings its own
# CMake package (7.4 and later). Debian 12 has 5.12, which does not.

find_package(SPQR CONFIG QUIET)
if(TARGET SuiteSparse::SPQR)
  set(SPQR_FOUND TRUE)
  return()
endif()

find_path(SPQR_INCLUDE_DIR SuiteSparseQR.hpp PATH_SUFFIXES suitesparse)
find_library(SPQR_LIBRARY spqr)
find_library(CHOLMOD_LIBRARY cholmod)
mark_as_advanced(SPQR_INCLUDE_DIR SPQR_LIBRARY CHOLMOD_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SPQR
  REQUIRED_VARS SPQR_LIBRARY CHOLMOD_LIBRARY SPQR_INCLUDE_DIR)

if(SPQR_FOUND)
  add_library(SuiteSparse::SPQR UNKNOWN IMPORTED)
  set_target_properties(SuiteSparse::SPQR PROPERTIES
    IMPORTED_LOCATION ${SPQR_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${SPQR_INCLUDE_DIR}
    INTERFACE_LINK_LIBRARIES ${CHOLMOD_LIBRARY})
endif()
