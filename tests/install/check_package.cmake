# Installs the build into an empty prefix, builds the project beside this file against it, runs that, and
# compares the tutorials with what they show.

cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# check_tutorial(<document> <source> <output>): every block ```cpp of the document stands in the source, every block
# ```text in the output.
function(check_tutorial document source output)
  file(READ ${document} rest)
  file(READ ${source} code)
  set(blocks 0)
  while(TRUE)
    string(FIND "${rest}" "\n```cpp\n" at_code)
    string(FIND "${rest}" "\n```text\n" at_text)
    if(at_code EQUAL -1 AND at_text EQUAL -1)
      break()
    endif()
    if(at_text EQUAL -1 OR (NOT at_code EQUAL -1 AND at_code LESS at_text))
      math(EXPR begin "${at_code} + 8")
      set(whole "${code}")
      set(place ${source})
    else()
      math(EXPR begin "${at_text} + 9")
      set(whole "${output}")
      set(place "the output of the program")
    endif()
    string(SUBSTRING "${rest}" ${begin} -1 rest)
    string(FIND "${rest}" "\n```\n" length)
    math(EXPR length "${length} + 1")
    string(SUBSTRING "${rest}" 0 ${length} block)
    string(FIND "${whole}" "${block}" found)
    if(found EQUAL -1)
      message(FATAL_ERROR "${document} shows what is not in ${place}:\n${block}\nIt has:\n${whole}")
    endif()
    string(SUBSTRING "${rest}" ${length} -1 rest)
    math(EXPR blocks "${blocks} + 1")
  endwhile()
  if(blocks EQUAL 0)
    message(FATAL_ERROR "${document} shows no code; expected blocks that begin with ```cpp")
  endif()
endfunction()

# configure(<directory> <flags>): the consumer, to be compiled with these flags.
function(configure directory flags)
  run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${directory} -G ${GENERATOR}
      -D CMAKE_PREFIX_PATH=${PREFIX} -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
      -D CMAKE_BUILD_TYPE=${BUILD_TYPE} -D CMAKE_CXX_FLAGS=${flags}
      -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
endfunction()

file(REMOVE_RECURSE ${PREFIX} ${CONSUMER} ${CONSUMER}_native ${CONSUMER}_asan)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX})
configure(${CONSUMER} "${CXX_FLAGS}")
run(${CMAKE_COMMAND} --build ${CONSUMER})
run(${CONSUMER}/consumer)

# A program may be compiled with flags that make Eigen align and allocate in another way by itself.
configure(${CONSUMER}_native "${CXX_FLAGS} -march=native")
run(${CMAKE_COMMAND} --build ${CONSUMER}_native --target consumer)
run(${CONSUMER}_native/consumer)
configure(${CONSUMER}_asan "${CXX_FLAGS} -fsanitize=address")
run(${CMAKE_COMMAND} --build ${CONSUMER}_asan --target consumer)
run(${CONSUMER}_asan/consumer)

foreach(example method_2 discretization_map generating_family)
  run(${CONSUMER}/${example})
endforeach()

set(docs ${CMAKE_CURRENT_LIST_DIR}/../../docs)
execute_process(COMMAND ${CONSUMER}/heisenberg OUTPUT_VARIABLE output COMMAND_ECHO NONE
                COMMAND_ERROR_IS_FATAL ANY)
check_tutorial(${docs}/tutorial-new-manifold.md ${docs}/examples/heisenberg.cpp "${output}")
execute_process(COMMAND ${CONSUMER}/rolling_penny OUTPUT_VARIABLE output COMMAND_ECHO NONE
                COMMAND_ERROR_IS_FATAL ANY)
check_tutorial(${docs}/tutorial-new-structure.md ${docs}/examples/rolling_penny.cpp "${output}")
execute_process(COMMAND ${CONSUMER}/linear_dirac OUTPUT_VARIABLE output COMMAND_ECHO NONE
                COMMAND_ERROR_IS_FATAL ANY)
check_tutorial(${docs}/linear-dirac-structures.md ${docs}/examples/linear_dirac.cpp "${output}")
