# Run after each build of a test executable: writes the ctest entries of the suites that it contains.
# Input: EXECUTABLE, FOLDER, WORKING_DIRECTORY, OUTPUT. See courant_tests.

execute_process(COMMAND ${EXECUTABLE} --list_content --color_output=no
                ERROR_VARIABLE content OUTPUT_VARIABLE content RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${EXECUTABLE} --list_content failed:\n${content}")
endif()

# Lines that are not indented are the outermost suites; "*" marks what is enabled.
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_]+" suites "${content}")
set(script "")
foreach(suite IN LISTS suites)
  string(STRIP "${suite}" suite)
  set(label quick)
  set(cost 0)
  if(suite MATCHES "_long(_test)?$")
    set(label long)
    set(cost 1000) # ctest starts with these, so that none of them runs alone at the end
  endif()
  string(APPEND script
    "add_test([[${FOLDER}.${suite}]] [[${EXECUTABLE}]] [[--run_test=${suite}]] --color_output=no)\n"
    "set_tests_properties([[${FOLDER}.${suite}]] PROPERTIES LABELS ${label} COST ${cost}"
    " WORKING_DIRECTORY [[${WORKING_DIRECTORY}]])\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
