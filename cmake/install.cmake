# SPDX-License-Identifier: MIT
# What `cmake --install` puts where, and the package that find_package(encase CONFIG) reads.
include(CMakePackageConfigHelpers)
set(ENCASE_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/encase)

set_target_properties(encase_common PROPERTIES EXPORT_NAME common)
set_target_properties(encase_arrangement PROPERTIES EXPORT_NAME arrangement)
set_target_properties(encase_verify PROPERTIES EXPORT_NAME verify)
set_target_properties(encase_2d PROPERTIES EXPORT_NAME 2d)
set_target_properties(encase_3d PROPERTIES EXPORT_NAME 3d)
set_target_properties(encase_io PROPERTIES EXPORT_NAME io)
set_target_properties(encase_core PROPERTIES EXPORT_NAME core)
install(TARGETS encase_common encase_arrangement encase_verify encase_2d encase_3d encase_io
  encase_core EXPORT encase-core ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT encase-core NAMESPACE encase:: DESTINATION ${ENCASE_PACKAGE_DIR})
install(DIRECTORY include/encase DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING
  PATTERN "*.hpp" PATTERN "vtk.hpp" EXCLUDE PATTERN "open_mesh.hpp" EXCLUDE)

foreach(component IN ITEMS vtk open_mesh)
  if(TARGET encase_${component})
    set_target_properties(encase_${component} PROPERTIES EXPORT_NAME ${component})
    install(TARGETS encase_${component} EXPORT encase-${component}
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT encase-${component} NAMESPACE encase:: DESTINATION ${ENCASE_PACKAGE_DIR})
    install(FILES include/encase/${component}.hpp
      DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/encase OPTIONAL)
  endif()
endforeach()
if(TARGET encase)
  install(TARGETS encase RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

configure_package_config_file(cmake/encaseConfig.cmake.in
  ${PROJECT_BINARY_DIR}/encaseConfig.cmake INSTALL_DESTINATION ${ENCASE_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/encaseConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/encaseConfig.cmake
  ${PROJECT_BINARY_DIR}/encaseConfigVersion.cmake cmake/FindGMP.cmake cmake/FindMPFR.cmake
  cmake/FindFLINT.cmake DESTINATION ${ENCASE_PACKAGE_DIR})
