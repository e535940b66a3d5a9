# find_package(exactgvd) gives gvd::robust, gvd::predicates, gvd::kernel, gvd::io and gvd::gvd (all of them);
# find_package(exactgvd COMPONENTS predicates) asks for nothing but what that layer needs. pkg-config knows the predicates as gvd-predicates.
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
file(RELATIVE_PATH GVD_PC_TO_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" GVD_PC_TO_PREFIX "${GVD_PC_TO_PREFIX}")
configure_file(cmake/gvd-predicates.pc.in gvd-predicates.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/gvd-predicates.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
