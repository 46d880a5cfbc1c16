# Installs the headers of cmake/public_headers.txt. Run by `cmake --install` with SOURCE and INCLUDE_DIR set.

cmake_minimum_required(VERSION 3.25)
file(STRINGS ${SOURCE}/cmake/public_headers.txt headers REGEX "^[a-z]")
foreach(header IN LISTS headers)
  get_filename_component(folder courant/${header} DIRECTORY)
  file(INSTALL ${SOURCE}/${header} DESTINATION ${INCLUDE_DIR}/${folder})
endforeach()
