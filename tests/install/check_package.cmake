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

foreach(example circuit method_2 discrete_flow discretization_map generating_family pendulum pendulum_three_ways)
  run(${CONSUMER}/${example})
endforeach()

# What is not API is not installed.
if(EXISTS ${PREFIX}/include/courant/integrators/certificate/row_reduction.hpp)
  message(FATAL_ERROR "a header that no public one includes is installed: integrators/certificate/row_reduction.hpp")
endif()

set(docs ${CMAKE_CURRENT_LIST_DIR}/../../docs)
execute_process(COMMAND ${CONSUMER}/heisenberg OUTPUT_VARIABLE output COMMAND_ECHO NONE
                COMMAND_ERROR_IS_FATAL ANY)
check_tutorial(${docs}/tutorial-new-manifold.md ${docs}/examples/heisenberg.cpp "${output}")
execute_process(COMMAND ${CONSUMER}/rolling_penny OUTPUT_VARIABLE output COMMAND_ECHO NONE
                COMMAND_ERROR_IS_FATAL ANY)
check_tutorial(${docs}/tutorial-new-structure.md ${docs}/examples/rolling_penny.cpp "${output}")
execute_process(COMMAND ${CONSUMER}/verlet OUTPUT_VARIABLE output COMMAND_ECHO NONE
                COMMAND_ERROR_IS_FATAL ANY)
check_tutorial(${docs}/tutorial-new-method.md ${docs}/examples/verlet.cpp "${output}")
execute_process(COMMAND ${CONSUMER}/linear_dirac OUTPUT_VARIABLE output COMMAND_ECHO NONE
                COMMAND_ERROR_IS_FATAL ANY)
check_tutorial(${docs}/linear-dirac-structures.md ${docs}/examples/linear_dirac.cpp "${output}")

# The command with kinds of one's own: experiments, catalogue, schema and errors know them.
set(examples ${docs}/examples)
set(own ${CONSUMER}/my_courant)
foreach(experiment heisenberg_geodesic heisenberg_charge)
  run(${own} run ${examples}/${experiment}.json -o ${CONSUMER}/${experiment} --force --quiet)
endforeach()
execute_process(COMMAND ${own} list OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
foreach(line "nil: the Heisenberg group" "heisenberg-charge: a charge on the Heisenberg group")
  if(NOT output MATCHES "${line}")
    message(FATAL_ERROR "`my_courant list` does not have its kinds: ${output}")
  endif()
endforeach()
execute_process(COMMAND ${own} schema OUTPUT_VARIABLE schema COMMAND_ERROR_IS_FATAL ANY)
if(NOT schema MATCHES "\"heisenberg-charge\"")
  message(FATAL_ERROR "the schema of my_courant does not have its system")
endif()
file(READ ${examples}/heisenberg_charge.json wrong)
string(REPLACE "strength" "strengh" wrong "${wrong}")
file(WRITE ${CONSUMER}/wrong.json "${wrong}")
execute_process(COMMAND ${own} run - INPUT_FILE ${CONSUMER}/wrong.json ERROR_VARIABLE error RESULT_VARIABLE status)
if(NOT status EQUAL 2)
  message(FATAL_ERROR "my_courant takes a key that it does not know: exit status ${status}; expected 2")
endif()
check_tutorial(${docs}/tutorial-new-kind.md ${examples}/my_courant.cpp "${error}")
