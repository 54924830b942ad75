# Only verify is installed: it is the part that other renderers link. The rest is used from the tree.

include(CMakePackageConfigHelpers)

install(TARGETS plumbline_verify EXPORT plumbline_verify_targets FILE_SET HEADERS)
install(
  EXPORT plumbline_verify_targets
  NAMESPACE plumbline::
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/plumbline)
configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/cmake/plumbline-config.cmake.in"
  "${PROJECT_BINARY_DIR}/plumbline-config.cmake"
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/plumbline)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/plumbline-config-version.cmake"
                                 COMPATIBILITY SameMajorVersion)
install(FILES "${PROJECT_BINARY_DIR}/plumbline-config.cmake"
              "${PROJECT_BINARY_DIR}/plumbline-config-version.cmake"
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/plumbline)
