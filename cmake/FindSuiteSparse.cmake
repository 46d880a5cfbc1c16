# Parts of SuiteSparse as targets: find_package(SuiteSparse REQUIRED COMPONENTS SPQR KLU AMD CAMD) gives SuiteSparse::SPQR,
# SuiteSparse::KLU and so on. These are also their names where SuiteSparse brings its own CMake packages (7.4 and later); Debian 12
# has 5.12, which does not.

# Of each part: its header, and the library that its own needs besides.
set(SuiteSparse_header_SPQR SuiteSparseQR.hpp)
set(SuiteSparse_needed_SPQR cholmod)
set(SuiteSparse_header_KLU klu.h)
set(SuiteSparse_header_AMD amd.h)
set(SuiteSparse_header_CAMD camd.h)

foreach(part IN LISTS SuiteSparse_FIND_COMPONENTS)
  find_package(${part} CONFIG QUIET)
  if(TARGET SuiteSparse::${part})
    set(SuiteSparse_${part}_FOUND TRUE)
    continue()
  endif()
  string(TOLOWER ${part} library)
  find_path(${part}_INCLUDE_DIR ${SuiteSparse_header_${part}} PATH_SUFFIXES suitesparse)
  mark_as_advanced(${part}_INCLUDE_DIR)
  set(SuiteSparse_libraries "")
  foreach(name IN ITEMS ${library} ${SuiteSparse_needed_${part}})
    string(TOUPPER ${name}_LIBRARY place)
    find_library(${place} ${name})
    mark_as_advanced(${place})
    if(${place})
      list(APPEND SuiteSparse_libraries ${${place}})
    else()
      set(${part}_INCLUDE_DIR "${part}_INCLUDE_DIR-NOTFOUND")
    endif()
  endforeach()
  if(NOT ${part}_INCLUDE_DIR)
    continue()
  endif()
  set(SuiteSparse_${part}_FOUND TRUE)
  add_library(SuiteSparse::${part} UNKNOWN IMPORTED)
  list(POP_FRONT SuiteSparse_libraries SuiteSparse_library)
  set_target_properties(SuiteSparse::${part} PROPERTIES
    IMPORTED_LOCATION "${SuiteSparse_library}"
    INTERFACE_INCLUDE_DIRECTORIES "${${part}_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${SuiteSparse_libraries}")
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse HANDLE_COMPONENTS)
