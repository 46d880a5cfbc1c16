# The installed package, the component "development": find_package(Courant) gives Courant::courant, which is everything but the command, one
# target a room (Courant::core, ...) for those who want less, and Courant::command for those who want the command with
# kinds of their own.

include(CMakePackageConfigHelpers)

add_library(courant_all INTERFACE)
add_library(Courant::courant ALIAS courant_all)
foreach(room IN LISTS courant_rooms)
  if(NOT room MATCHES "^(cli|lab|python)$")
    target_link_libraries(courant_all INTERFACE courant_${room})
  endif()
endforeach()
set_target_properties(courant_all PROPERTIES EXPORT_NAME courant)

# Of the headers, those of the public API.
install(CODE "set(SOURCE \"${PROJECT_SOURCE_DIR}\")
set(INCLUDE_DIR \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}\")" COMPONENT development)
install(SCRIPT ${PROJECT_SOURCE_DIR}/cmake/install_headers.cmake COMPONENT development)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Courant)
install(TARGETS courant_all EXPORT CourantTargets)
install(EXPORT CourantTargets NAMESPACE Courant:: DESTINATION ${package_dir} COMPONENT development)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/CourantConfig.cmake.in
  ${PROJECT_BINARY_DIR}/CourantConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/CourantConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/CourantConfig.cmake
  ${PROJECT_BINARY_DIR}/CourantConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/CourantPetsc.cmake
  ${PROJECT_SOURCE_DIR}/cmake/FindArb.cmake
  ${PROJECT_SOURCE_DIR}/cmake/FindSuiteSparse.cmake
  DESTINATION ${package_dir} COMPONENT development)

# For builds without CMake: pkg-config --cflags --libs courant. Libraries before those that they need.
set(courant_pc_libraries "")
foreach(room IN LISTS courant_rooms)
  if(NOT room MATCHES "^(cli|lab|python)$")
    string(PREPEND courant_pc_libraries " -lcourant_${room}")
  endif()
endforeach()
if(COURANT_WITH_SUITESPARSE)
  set(courant_pc_needed "-lspqr -lcholmod -lklu -lamd -lcamd -llapack -lblas")
endif()
if(COURANT_WITH_ARB)
  string(APPEND courant_pc_needed " -lflint-arb -lflint")
endif()
if(COURANT_WITH_PETSC)
  string(APPEND courant_pc_needed " -lpetsc_real -lmpi")
endif()
if(COURANT_WITH_PUGIXML)
  string(APPEND courant_pc_needed " -lpugixml")
endif()
string(APPEND courant_pc_needed " ${CMAKE_DL_LIBS}" " -pthread")
string(REGEX REPLACE " ([a-z])" " -l\\1" courant_pc_needed "${courant_pc_needed}")
if(BUILD_SHARED_LIBS) # which name what they need themselves
  set(courant_pc_private "${courant_pc_needed}")
else()
  string(APPEND courant_pc_libraries " ${courant_pc_needed}")
endif()
file(RELATIVE_PATH courant_pc_prefix ${CMAKE_INSTALL_FULL_DATADIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(${PROJECT_SOURCE_DIR}/cmake/courant.pc.in ${PROJECT_BINARY_DIR}/courant.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/courant.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig COMPONENT development)
