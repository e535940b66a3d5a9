# find_package(exactgvd) gives gvd::robust, gvd::predicates, gvd::kernel, gvd::io and gvd::gvd (all of them).
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/exactgvd)

install(TARGETS gvd_robust gvd_predicates gvd_kernel gvd_io gvd_all EXPORT exactgvd FILE_SET HEADERS)
if(TARGET gvd)
  install(TARGETS gvd)
endif()
install(EXPORT exactgvd NAMESPACE gvd:: FILE exactgvd-targets.cmake DESTINATION ${package_dir})
configure_package_config_file(cmake/exactgvd-config.cmake.in exactgvd-config.cmake INSTALL_DESTINATION ${package_dir}
                              NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(exactgvd-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/exactgvd-config.cmake ${PROJECT_BINARY_DIR}/exactgvd-config-version.cmake
              cmake/dependencies.cmake DESTINATION ${package_dir})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
