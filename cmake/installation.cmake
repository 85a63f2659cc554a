# cmake --install, and find_package(relevo) for programs that use the libraries.
include(CMakePackageConfigHelpers)

set(targets relevo_geo relevo_scene relevo_lod relevo_ingest relevo_output)
if(RELEVO_VIEWER)
  list(APPEND targets relevo_viewer)
endif()
install(TARGETS ${targets} EXPORT relevo-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS relevo RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES ${PROJECT_SOURCE_DIR}/docs/relevo.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
foreach(folder geo lod ingest output viewer)
  if(folder STREQUAL viewer AND NOT RELEVO_VIEWER)
    continue()
  endif()
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION include/relevo FILES_MATCHING PATTERN "*.hpp")
endforeach()

if(RELEVO_VIEWER)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/relevo)
endif()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/relevo)
install(EXPORT relevo-targets NAMESPACE relevo:: DESTINATION ${package_dir})
configure_package_config_file(cmake/relevo-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/relevo-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/relevo-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/relevo-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/relevo-config-version.cmake
              cmake/dependencies.cmake
        DESTINATION ${package_dir})
