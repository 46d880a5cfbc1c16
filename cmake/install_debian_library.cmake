# Installs what the Debian packages of the libraries and of the module have besides: changelog and copyright. Run by cpack
# with DEBIAN and PACKAGE set.

set(doc ${CMAKE_INSTALL_PREFIX}/share/doc/${PACKAGE})
file(MAKE_DIRECTORY ${doc})
execute_process(COMMAND gzip -9nc ${DEBIAN}/changelog OUTPUT_FILE ${DEBIAN}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
file(INSTALL ${DEBIAN}/changelog.gz ${DEBIAN}/copyright DESTINATION ${doc})
