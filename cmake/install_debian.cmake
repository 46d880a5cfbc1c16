# Installs what only a Debian package has: manual pages and changelog compressed, the copyright, completion where zsh of
# Debian looks for it, the experiments as examples. Run by cpack with PAGES, DEBIAN and EXPERIMENTS set.

set(share ${CMAKE_INSTALL_PREFIX}/share)
function(install_compressed file destination)
  get_filename_component(name ${file} NAME)
  execute_process(COMMAND gzip -9nc ${file} OUTPUT_FILE ${DEBIAN}/${name}.gz COMMAND_ERROR_IS_FATAL ANY)
  file(INSTALL ${DEBIAN}/${name}.gz DESTINATION ${destination})
endfunction()

file(GLOB pages ${PAGES}/man1/*.1)
foreach(page IN LISTS pages)
  install_compressed(${page} ${share}/man/man1)
endforeach()
install_compressed(${DEBIAN}/changelog ${share}/doc/courant)
file(INSTALL ${DEBIAN}/copyright DESTINATION ${share}/doc/courant)
file(INSTALL ${PAGES}/_courant DESTINATION ${share}/zsh/vendor-completions)
file(GLOB experiments ${EXPERIMENTS}/*.json)
file(INSTALL ${experiments} DESTINATION ${share}/doc/courant/examples)
