# How everything of this project is compiled, and where the build puts it.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  if(COURANT_SANITIZE)
    set(default_build_type Debug) # keeps the assertions of Eigen and of the standard library
  else()
    set(default_build_type Release) # -O3
  endif()
  set(CMAKE_BUILD_TYPE ${default_build_type} CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_SCAN_FOR_MODULES OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
if(BUILD_SHARED_LIBS)
  set(CMAKE_INSTALL_RPATH $ORIGIN/../${CMAKE_INSTALL_LIBDIR})
endif()

# Static libraries go into modules of Python, MEX files and plug-ins, so all code is position independent. Programs share
# precompiled headers with libraries, so they are compiled alike. No symbol of a library is replaced from outside: with that
# promise GCC inlines as it does in a program.
if(NOT DEFINED CMAKE_POSITION_INDEPENDENT_CODE)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
endif()
if(CMAKE_POSITION_INDEPENDENT_CODE)
  set(CMAKE_CXX_COMPILE_OPTIONS_PIE ${CMAKE_CXX_COMPILE_OPTIONS_PIC})
  add_compile_options(-fno-semantic-interposition)
endif()

# Headers are included by the names that they are installed under: "courant/core/expressions/expr.hpp".
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/include)
file(CREATE_LINK ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/include/courant SYMBOLIC)

# GCC collects its garbage when it holds some 100 MB. Where there is memory it need not: an eighth of the time.
cmake_host_system_information(RESULT memory QUERY TOTAL_PHYSICAL_MEMORY)
if(COURANT_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL GNU AND memory GREATER_EQUAL 8000)
  add_compile_options("SHELL:--param ggc-min-expand=200" "SHELL:--param ggc-min-heapsize=1000000")
endif()

if(COURANT_SANITIZE)
  if(COURANT_SANITIZE STREQUAL thread)
    set(courant_sanitizers -fsanitize=thread)
  else()
    # Left out of the undefined behaviour: what the address sanitizer sees as well. Eigen, inlined, compiles
    # twice as long with it, and as long again with full debug information.
    set(courant_sanitizers -fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr)
  endif()
  add_compile_options(${courant_sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer -O1 -g1)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT COURANT_SANITIZE STREQUAL thread)
    # Undefined behaviour traps, and AddressSanitizer prints where (handle_sigill=1); in large functions accesses are
    # checked by calls. Both keep the instrumented code small. Calls everywhere run three times as long.
    add_compile_options(-fsanitize-undefined-trap-on-error "SHELL:--param asan-instrumentation-with-call-threshold=200")
  endif()
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
  if(COURANT_FUZZ AND CMAKE_CXX_COMPILER_ID MATCHES Clang)
    add_compile_options(-fsanitize=fuzzer-no-link) # libFuzzer sees which branches an execution takes
  endif()
  # Instrumented code hides from GCC that an empty optional is never read: its manual warns of such warnings.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  add_link_options(${courant_sanitizers})
endif()

# Release builds are hardened, as Debian's packages are.
if(NOT COURANT_SANITIZE AND NOT EMSCRIPTEN)
  add_compile_options(-fstack-protector-strong "$<$<CONFIG:Release>:SHELL:-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2>")
  if(CMAKE_SYSTEM_NAME STREQUAL Linux)
    add_link_options(-Wl,-z,relro,-z,now)
  endif()
endif()

# courant_settings(<target>): language, warnings and floating point of a target of this project.
function(courant_settings target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion)
  if(NOT EMSCRIPTEN) # whose clang warns of what the one of the lint does not
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    target_compile_options(${target} PRIVATE -Wno-sign-conversion) # not in -Wconversion of GCC
  endif()
  target_compile_definitions(${target} PRIVATE COURANT_CALLS_PRODUCTS) # see core/linear/products.hpp
  # GCC 12 sees overlaps and overflows in "literal" + std::string that are not there (GCC bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow
      -Wno-stringop-overread)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(${target} PRIVATE -fpch-preprocess) # or ccache passes by precompiled headers
  endif()
  # The interpreter and the native code that is compiled at run time must give the same bits. A compiler
  # that contracts a*b+c into one rounding does so where it likes, differently in the two: so never.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
endfunction()
