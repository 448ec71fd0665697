# What `cmake --install` lays down, and the Debian package that `cpack` makes of it. tools/package
# calls it. The version is project()'s.

include(GNUInstallDirs)
install(TARGETS gnbv RUNTIME COMPONENT program)
# loaded when first needed: sim/core/module.cpp looks for them from where the program is
install(TARGETS gnbv_symmetry gnbv_poisson LIBRARY DESTINATION lib/gnbv COMPONENT program)
install(FILES README.md CHANGELOG.md DECISIONS.md FIDELITY.md DESTINATION share/doc/gnbv
  COMPONENT program)
install(DIRECTORY bench/results DESTINATION share/doc/gnbv/bench COMPONENT program
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
install(FILES LICENSE DESTINATION share/doc/gnbv RENAME copyright COMPONENT program)
install(FILES scenarios/README.md DESTINATION share/doc/gnbv/scenarios COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gnbv)
set(CPACK_PACKAGE_VENDOR "The gnbv authors")
set(CPACK_PACKAGE_CONTACT "The gnbv authors <gnbv@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};gnbv;program;/")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # what is linked; the rest is opened or run by name
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libosmesa6, fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg, python3-numpy")
include(CPack)
