# What `cmake --install` lays down, and the Debian packages that `cpack` makes of it. tools/package
# calls it. The version is project()'s. Component `program` is the program, `dev` the planner's
# library: `find_package(gnbv)` gives gnbv::planner.

install(TARGETS gnbv RUNTIME COMPONENT program)
# loaded when first needed: sim/core/module.cpp looks for them from where the program is
install(TARGETS gnbv_symmetry gnbv_poisson LIBRARY DESTINATION lib/gnbv COMPONENT program)
install(FILES README.md CHANGELOG.md FIDELITY.md CONTRIBUTING.md SECURITY.md CITATION.cff
  DESTINATION share/doc/gnbv COMPONENT program)
install(DIRECTORY docs DESTINATION share/doc/gnbv COMPONENT program
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
install(DIRECTORY bench/results DESTINATION share/doc/gnbv/bench COMPONENT program
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
install(FILES LICENSE DESTINATION share/doc/gnbv RENAME copyright COMPONENT program)

# man pages and completions, of docs/reference/commands.md; what others wrote of the program, where
# Debian's packages can say so
install(CODE "
  set(prefix \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
  execute_process(COMMAND python3 ${PROJECT_SOURCE_DIR}/tools/docs --install \${prefix}/share
    COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND python3 ${PROJECT_SOURCE_DIR}/tools/licences
    -o \${prefix}/share/doc/gnbv/third-party.txt.gz --build ${PROJECT_BINARY_DIR}
    \"$<TARGET_FILE:gnbv>\" \"$<TARGET_FILE:gnbv_symmetry>\" \"$<TARGET_FILE:gnbv_poisson>\")
" COMPONENT program)

# ---- the planner's library ------------------------------------------------------------------------
get_property(libraries GLOBAL PROPERTY gnbv_installed_libraries)
list(APPEND libraries gnbv_public)
foreach(library IN LISTS libraries)
  string(REPLACE gnbv_ "" name ${library})
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
endforeach()
add_custom_target(gnbv_dev DEPENDS ${libraries} gnbv_symmetry)  # what component `dev` installs
# what loads the symmetry module finds it where component `program` was installed
target_link_options(gnbv_planner_symmetry INTERFACE
  $<INSTALL_INTERFACE:LINKER:-rpath,$<INSTALL_PREFIX>/lib/gnbv>)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/gnbv)
install(TARGETS ${libraries} EXPORT gnbv-targets ARCHIVE COMPONENT dev)
install(EXPORT gnbv-targets NAMESPACE gnbv:: DESTINATION ${config_folder} COMPONENT dev)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gnbv-config-version.cmake
  COMPATIBILITY SameMajorVersion)
install(FILES packaging/gnbv-config.cmake ${PROJECT_BINARY_DIR}/gnbv-config-version.cmake
  DESTINATION ${config_folder} COMPONENT dev)
install(SCRIPT packaging/install_headers.cmake COMPONENT dev)
install(DIRECTORY examples/onboard DESTINATION share/doc/gnbv/examples COMPONENT dev)

# ---- the packages ---------------------------------------------------------------------------------
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gnbv)
set(CPACK_PACKAGE_VENDOR "The gnbv authors")
set(CPACK_PACKAGE_CONTACT "The gnbv authors <gnbv@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program dev)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME gnbv)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)  # what is linked; the rest is opened or run by name
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libosmesa6 | libegl-mesa0, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS
  "python3-matplotlib, python3-jinja2, python3-pil")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, python3-numpy")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME gnbv-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "gnbv (= ${PROJECT_VERSION}), libeigen3-dev, libfmt-dev, \
libpng-dev, libssl-dev")
include(CPack)
