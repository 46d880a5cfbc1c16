# The engine of the laboratory in the browser, by Emscripten: `emcmake cmake …`, see scripts/lab.
#
# Emscripten looks for nothing of the machine that it runs on, whose libraries are not for WebAssembly. What is needed of it are
# headers alone, so these are found here and shown to the compiler by links, not by a folder that has those of the machine's C
# library too.

add_compile_options(-fwasm-exceptions "SHELL:-include ${PROJECT_SOURCE_DIR}/lab/libcxx_13.hpp")
add_link_options(-fwasm-exceptions)
set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)

set(headers ${PROJECT_BINARY_DIR}/host-headers)
file(MAKE_DIRECTORY ${headers})
foreach(found boost/version.hpp eigen3/Eigen/Core nlohmann/json.hpp xxhash.h)
  string(MAKE_C_IDENTIFIER ${found} name)
  find_path(COURANT_HOST_${name} ${found} PATHS /usr/include /usr/local/include REQUIRED NO_CMAKE_FIND_ROOT_PATH)
  string(REGEX REPLACE "/.*" "" top ${found})
  file(CREATE_LINK ${COURANT_HOST_${name}}/${top} ${headers}/${top} SYMBOLIC)
endforeach()
set(COURANT_XXHASH ${headers})

find_package(Threads REQUIRED)
foreach(library Eigen3::Eigen Boost::headers nlohmann_json::nlohmann_json)
  add_library(${library} INTERFACE IMPORTED)
  target_include_directories(${library} SYSTEM INTERFACE ${headers} ${headers}/eigen3)
endforeach()
