# Installs what only the Debian package of the libraries has: changelog and copyright. Run by cpack with DEBIAN set.

set(doc ${CMAKE_INSTALL_PREFIX}/share/doc/libcourant-dev)
file(MAKE_DIRECTORY ${doc})
execute_process(COMMAND gzip -9nc ${DEBIAN}/changelog OUTPUT_FILE ${DEBIAN}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
file(INSTALL ${DEBIAN}/changelog.gz ${DEBIAN}/copyright DESTINATION ${doc})
