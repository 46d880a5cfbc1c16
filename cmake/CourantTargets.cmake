# One library a room, one test executable a room.

# What nearly every file includes, parsed once a target rather than once a file. Eigen's decompositions are not here:
# core compiles them once (see docs/decisions.md).
set(courant_precompiled <Eigen/Core> <Eigen/SparseCore> <algorithm> <cmath> <functional> <memory> <random> <stdexcept>
    <string> <vector> <courant/core/expressions/function.hpp>)

# How much a release optimises a room, but for the parts of it that are listed as `fast`, which have -O3; "." is the folder
# of the room itself. It takes a third to half of the compiler's time.
foreach(room core manifolds structures integrators systems)
  set(courant_optimisation_${room} -O1)
endforeach()
foreach(room reading running extensions plotting reporting cli lab tests)
  set(courant_optimisation_${room} $<IF:$<BOOL:${EMSCRIPTEN}>,-O1,-Og>) # em++ does not know the latter
endforeach()

# courant_optimise(<target> <room>)
function(courant_optimise target room)
  if(NOT courant_optimisation_${room})
    return()
  endif()
  set(level ${courant_optimisation_${room}})
  # What a template makes here may be what the linker keeps for all, loops of a step included, so small functions are inlined.
  # That compiles as fast, and without it a step that inverts by least squares took 2.3 times as long.
  target_compile_options(${target} PRIVATE $<$<OR:$<CONFIG:Release>,$<BOOL:${COURANT_SANITIZE}>>:${level}>
    $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-finline-small-functions;-findirect-inlining>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>) # seen in Eigen, and not there
  # What is not fast keeps checking indices: a mistake is one line and status 3, and writes nothing where it must not.
  if(NOT EMSCRIPTEN)
    target_compile_options(${target} PRIVATE -UNDEBUG -D_GLIBCXX_ASSERTIONS)
  endif()
endfunction()

# courant_precompile(<target> <room> <suffix> [<header>...])
#
# Uses precompiled headers in a target: those above and the given ones. GCC compiles by the optimisation that these were
# compiled with, whatever its command line says, so rooms that share them are optimised alike. What runs in steps has those
# of core for that (<room>: "steps"); manifolds, structures, integrators and systems have those of core; running, reporting
# and cli those of reading, which have JSON too. Tests have those of the tests of core and of reading (<suffix>: "_tests").
# Plotting knows nothing but the standard library.
function(courant_precompile target room suffix)
  if(target MATCHES "^courant_(core|core_steps|core_tests)$")
    target_precompile_headers(${target} PRIVATE ${courant_precompiled} ${ARGN})
  elseif(room STREQUAL reading)
    target_precompile_headers(${target} PRIVATE ${courant_precompiled} <nlohmann/json.hpp> ${ARGN})
  elseif(room MATCHES "^(running|extensions|reporting|cli|lab)$")
    target_precompile_headers(${target} REUSE_FROM courant_reading${suffix})
  elseif(room STREQUAL steps)
    target_precompile_headers(${target} REUSE_FROM courant_core_steps)
  elseif(NOT room STREQUAL plotting)
    target_precompile_headers(${target} REUSE_FROM courant_core${suffix})
  endif()
endfunction()

# courant_unite(<target>)
#
# Compiles up to thirty-two sources of a target as one if COURANT_UNITY is on, in batches of one size. That takes 1.5 GB, so
# there are sixteen where each processor has less than 3 GB; a dozen if they are instrumented, which takes more. Names in their
# unnamed namespaces must differ then; those of a test are in its suite.
#
# A batch names its sources as headers are named, "courant/core/solve/newton.cpp", and not by where the checkout is, as those
# of CMake's UNITY_BUILD do: what ccache keeps of one checkout serves another.
cmake_host_system_information(RESULT courant_processors QUERY NUMBER_OF_LOGICAL_CORES)
function(courant_unite target)
  if(NOT COURANT_UNITY)
    return()
  endif()
  math(EXPR memory_of_each "${memory} / ${courant_processors}")
  if(COURANT_SANITIZE)
    set(most 12)
  elseif(memory_of_each LESS 3000)
    set(most 16)
  else()
    set(most 32)
  endif()
  get_target_property(others ${target} SOURCES)
  set(together "")
  foreach(source IN LISTS others)
    get_source_file_property(stands_alone ${source} SKIP_UNITY_BUILD_INCLUSION)
    cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE path NORMALIZE)
    cmake_path(IS_PREFIX PROJECT_BINARY_DIR ${path} is_made)
    if(source MATCHES "\\.cpp$" AND NOT stands_alone AND NOT is_made)
      list(APPEND together ${source})
    endif()
  endforeach()
  list(LENGTH together count)
  math(EXPR batches "(${count} + ${most} - 1) / ${most}")
  if(batches EQUAL 0)
    return()
  endif()
  math(EXPR size "(${count} + ${batches} - 1) / ${batches}")
  list(REMOVE_ITEM others ${together})
  math(EXPR last "${batches} - 1")
  foreach(batch RANGE ${last})
    math(EXPR begin "${batch} * ${size}")
    list(SUBLIST together ${begin} ${size} sources)
    set(text "")
    foreach(source IN LISTS sources)
      cmake_path(ABSOLUTE_PATH source NORMALIZE)
      cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
      string(APPEND text "#include \"courant/${source}\"\n")
    endforeach()
    set(file ${CMAKE_CURRENT_BINARY_DIR}/batches/${target}_${batch}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY) # left as it is where nothing changes, and not compiled again
    list(APPEND others ${file})
  endforeach()
  set_target_properties(${target} PROPERTIES SOURCES "${others}")
  # What is included, GCC takes for a header: there an unnamed namespace would make different types of one.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# courant_steps(<room> [PUBLIC <links>...] [PRIVATE <links>...])
#
# The parts of the library courant_<room> that run in every step, or that long preparations spend their time in: the
# sources of ${fast} in ${in_steps}, with -O3.
function(courant_steps room)
  set(target courant_${room}_steps)
  add_library(${target} OBJECT ${in_steps})
  courant_settings(${target})
  courant_precompile(${target} steps "")
  courant_unite(${target})
  target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR}/include)
  list(TRANSFORM courant_known_${room} PREPEND courant_ OUTPUT_VARIABLE known)
  target_link_libraries(${target} PUBLIC ${known})
  target_link_libraries(${target} ${ARGN})
  target_sources(courant_${room} PRIVATE $<TARGET_OBJECTS:${target}>)
endfunction()

# courant_library(<room> [PUBLIC <links>...] [PRIVATE <links>...])
#
# The library courant_<room> of all sources of this folder and its parts but those in ${left_out}, linked to the rooms
# that it may know and to what is given, exported as Courant::<room>. The parts (folders) in ${fast} are optimised, see
# courant_steps.
function(courant_library room)
  set(target courant_${room})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp */*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS *.hpp */*.hpp)
  list(TRANSFORM left_out PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  list(REMOVE_ITEM sources ${left_out})
  set(in_steps "")
  foreach(part IN LISTS fast)
    cmake_path(ABSOLUTE_PATH part NORMALIZE)
    string(REGEX REPLACE "/$" "" part "${part}") # of ".", or its sources had two slashes, and were compiled twice
    file(GLOB part_sources CONFIGURE_DEPENDS ${part}/*.cpp)
    list(APPEND in_steps ${part_sources})
  endforeach()
  if(in_steps)
    list(REMOVE_ITEM in_steps ${left_out})
    list(REMOVE_ITEM sources ${in_steps})
  endif()
  if(NOT sources) # a folder may consist of headers alone
    set(sources ${CMAKE_CURRENT_BINARY_DIR}/headers_only.cpp)
    file(CONFIGURE OUTPUT ${sources} CONTENT "") # left as it is, and not compiled again, at the next configuration
  endif()
  add_library(${target} ${sources} ${headers})
  add_library(Courant::${room} ALIAS ${target})
  courant_settings(${target})
  courant_optimise(${target} ${room})
  courant_precompile(${target} ${room} "")
  courant_unite(${target})
  if(in_steps)
    courant_steps(${room} ${ARGN})
  endif()
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM courant_known_${room} PREPEND courant_ OUTPUT_VARIABLE known)
  target_link_libraries(${target} PUBLIC ${known})
  target_link_libraries(${target} ${ARGN})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${room}
    DEFINE_SYMBOL "" # or no other room could use its precompiled headers
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  install(TARGETS ${target} EXPORT CourantTargets COMPONENT development)
endfunction()

# courant_tests(<room>)
#
# The executable courant_<room>_tests of all *_test.cpp in tests/<room> and its parts but those in ${left_out}. Each Boost.Test suite in it,
# that is each file, becomes one ctest entry <room>.<suite>, labelled "long" when its name ends in
# _long_test or _long, and "quick" otherwise. The suites are asked of the executable itself once it is built, so
# none can be forgotten.
function(courant_tests room)
  file(GLOB sources CONFIGURE_DEPENDS ${room}/*_test.cpp ${room}/*/*_test.cpp)
  if(NOT sources)
    return()
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${room}/*.cpp ${room}/*/*.cpp) # with what several tests share
  list(TRANSFORM left_out PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  list(REMOVE_ITEM sources ${left_out})
  set(target courant_${room}_tests)
  add_executable(${target} ${sources} $<TARGET_OBJECTS:courant_tests_main>)
  courant_settings(${target})
  courant_optimise(${target} tests)
  courant_precompile(${target} ${room} _tests <Eigen/Geometry> <boost/test/unit_test.hpp>)
  courant_unite(${target})
  target_compile_definitions(${target} PRIVATE BOOST_TEST_DYN_LINK)
  target_link_libraries(${target} PRIVATE courant_${room} Boost::unit_test_framework)
  # Of a template that several objects make, the linker keeps the first: that of what is optimised, and not that of a test.
  if(NOT BUILD_SHARED_LIBS AND NOT room STREQUAL plotting)
    set(first core)
    if(NOT room MATCHES "^(core|manifolds|structures|systems)$")
      list(APPEND first integrators)
    endif()
    foreach(optimised IN LISTS first)
      target_link_options(${target} PRIVATE
        $<FILTER:$<TARGET_OBJECTS:courant_${optimised}_steps>,EXCLUDE,cmake_pch>)
    endforeach()
  endif()

  set(discover ${PROJECT_SOURCE_DIR}/cmake/DiscoverTests.cmake)
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${target}.cmake)
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${discover})
  add_custom_command(TARGET ${target} POST_BUILD VERBATIM
    COMMAND ${CMAKE_COMMAND} -D EXECUTABLE=$<TARGET_FILE:${target}> -D FOLDER=${room}
            -D WORKING_DIRECTORY=${PROJECT_SOURCE_DIR} -D OUTPUT=${suites} -P ${discover})
  file(CONFIGURE OUTPUT ${target}_include.cmake @ONLY CONTENT [[
if(EXISTS "@suites@")
  include("@suites@")
else()
  add_test("@room@.not_built" "@target@-is-not-built")
endif()
]])
  set_property(DIRECTORY APPEND PROPERTY
    TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake)
endfunction()
