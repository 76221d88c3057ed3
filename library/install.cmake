# cmake --install: the program, the library and all that belongs to them. Nothing holds a path of the build or of the prefix, so that
# the folder can be moved.
include(GNUInstallDirs)

file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" to_prefix ${to_prefix})
configure_file(library/fracas.pc.in generated/fracas.pc @ONLY)

set_target_properties(fracas libfracas PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
install(TARGETS fracas libfracas)
install(FILES library/fracas.h TYPE INCLUDE)
install(FILES ${CMAKE_BINARY_DIR}/generated/fracas.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(FILES README.md LICENSE CHANGELOG.md CITATION.cff TYPE DOC)
install(DIRECTORY docs/ TYPE DOC)
install(DIRECTORY campaigns/examples/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples/campaigns)

# The package of Python where Debian has its own, with the file that tells its version.
set(python lib/python3/dist-packages)
install(DIRECTORY python/fracas DESTINATION ${python} FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
file(CONFIGURE OUTPUT generated/METADATA CONTENT "Metadata-Version: 2.1\nName: fracas\nVersion: ${PROJECT_VERSION}\n")
install(FILES ${CMAKE_BINARY_DIR}/generated/METADATA DESTINATION ${python}/fracas-${PROJECT_VERSION}.dist-info)

# Manual pages, completions and the schema, as the installed program writes them.
install(CODE "set(bin ${CMAKE_INSTALL_BINDIR})\nset(man ${CMAKE_INSTALL_MANDIR}/man1)\nset(data ${CMAKE_INSTALL_DATADIR})")
install(CODE [[
  set(prefix $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX})
  function(write_by_fracas file) # arguments
    get_filename_component(folder ${prefix}/${file} DIRECTORY)
    file(MAKE_DIRECTORY ${folder})
    execute_process(COMMAND ${prefix}/${bin}/fracas ${ARGN} OUTPUT_FILE ${prefix}/${file} COMMAND_ERROR_IS_FATAL ANY)
  endfunction()
  execute_process(COMMAND ${prefix}/${bin}/fracas help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "\n  fracas [a-z][a-z-]*" calls "${help}")
  list(TRANSFORM calls REPLACE "\n  fracas " "")
  list(REMOVE_ITEM calls help)
  write_by_fracas(${man}/fracas.1 man fracas)
  foreach(command ${calls})
    write_by_fracas(${man}/fracas-${command}.1 man ${command})
  endforeach()
  write_by_fracas(${data}/bash-completion/completions/fracas completion bash)
  write_by_fracas(${data}/zsh/site-functions/_fracas completion zsh)
  write_by_fracas(${data}/fish/vendor_completions.d/fracas.fish completion fish)
  write_by_fracas(${data}/fracas/campaign.schema.json reference --schema)
]])

# A package for Debian: cpack -G DEB in the build folder.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the authors of fracas <fracas@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "openmpi-bin, librsvg2-2, libcairo2") # mpirun; figures as PDF: both are not linked
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS python3-h5py) # for the package of Python
set(CPACK_DEBIAN_PACKAGE_SECTION science)
include(CPack)
