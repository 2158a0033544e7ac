# What `cmake --install` writes: headers, libraries, package files for find_package(hri) and for pkg-config.
# Everything is in the component "development", so that a Python wheel (component "python") takes none of it.
set(config_dir "${CMAKE_INSTALL_LIBDIR}/cmake/hri")

# Found from the .pc file itself, so that `cmake --install --prefix` and a moved tree stay right.
file(RELATIVE_PATH HRI_PREFIX_FROM_PC "/x/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/x")

# What a static library needs is linked by the program; pkg-config leaves out what is private to it.
get_target_property(hri_core_type hri_core TYPE)
set(HRI_PC_OPENCV "")
if(hri_core_type STREQUAL "STATIC_LIBRARY")
  set(HRI_PC_OPENCV " -lopencv_objdetect -lopencv_videoio -lopencv_imgproc -lopencv_core")
endif()

function(hri_install_library name)
  install(TARGETS hri_${name} EXPORT hri-${name}-targets
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development
          LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development
          RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT development)
  install(EXPORT hri-${name}-targets NAMESPACE hri:: DESTINATION "${config_dir}" COMPONENT development)
  configure_file("${PROJECT_SOURCE_DIR}/cmake/hri-${name}.pc.in" "${CMAKE_CURRENT_BINARY_DIR}/hri-${name}.pc" @ONLY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/hri-${name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
          COMPONENT development)
endfunction()

hri_install_library(core)
install(DIRECTORY include/hri "${CMAKE_CURRENT_BINARY_DIR}/include/hri" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        COMPONENT development FILES_MATCHING PATTERN "*.hpp" PATTERN "vision" EXCLUDE)
if(HRI_BUILD_VISION)
  hri_install_library(vision)
  install(DIRECTORY include/hri/vision DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/hri" COMPONENT development)
endif()

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/hri-config.cmake.in"
                              "${CMAKE_CURRENT_BINARY_DIR}/hri-config.cmake" INSTALL_DESTINATION "${config_dir}")
# Before 1.0 every minor version may change the interface.
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/hri-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/hri-config.cmake" "${CMAKE_CURRENT_BINARY_DIR}/hri-config-version.cmake"
        DESTINATION "${config_dir}" COMPONENT development)
