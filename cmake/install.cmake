# What `cmake --install` and the packages hold, in two components: runtime (tools, workflow, pages, Python module) and
# dev (headers and libraries that read sizes and meshes, for find_package(st)).
include(CMakePackageConfigHelpers)

# --- runtime ---
install(FILES README.md CHANGELOG.md LICENSE DESTINATION share/doc/st COMPONENT runtime)
if(ST_HDF5_STATIC AND EXISTS /usr/share/doc/libhdf5-dev/copyright)  # of what is linked into the tools
  install(FILES /usr/share/doc/libhdf5-dev/copyright DESTINATION share/doc/st RENAME copyright.hdf5 COMPONENT runtime)
endif()
install(DIRECTORY docs DESTINATION share/doc/st COMPONENT runtime FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
# Examples lie beside the scripts and the workflow that they use, as in the sources; their place in Debian is a link.
install(DIRECTORY examples DESTINATION share/st COMPONENT runtime USE_SOURCE_PERMISSIONS
        PATTERN "CMakeLists.txt" EXCLUDE PATTERN "aircraft" EXCLUDE PATTERN "models" EXCLUDE PATTERN "__pycache__" EXCLUDE)
install(FILES examples/volume_mesher/CMakeLists.txt DESTINATION share/st/examples/volume_mesher COMPONENT runtime)
install(FILES scripts/render_common.py DESTINATION share/st/scripts COMPONENT runtime)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/installed_links)
file(CREATE_LINK ../../st/examples ${CMAKE_BINARY_DIR}/installed_links/examples SYMBOLIC)
install(FILES ${CMAKE_BINARY_DIR}/installed_links/examples DESTINATION share/doc/st COMPONENT runtime)
install(DIRECTORY python/st DESTINATION lib/python3/dist-packages COMPONENT runtime FILES_MATCHING PATTERN "*.py")
install(FILES Makefile.workflow DESTINATION share/st COMPONENT runtime)
file(GLOB workflow_scripts scripts/workflow_*.sh scripts/run_stage.sh scripts/replace_if_changed.sh
     scripts/nearest_word.sh scripts/make_example.sh scripts/setup.sh)
install(PROGRAMS ${workflow_scripts} DESTINATION share/st/scripts COMPONENT runtime)
install(TARGETS make_aircraft make_model RUNTIME DESTINATION bin COMPONENT runtime)

# Man pages and completions say what --help says; they are made where there is a Python.
find_program(ST_PYTHON python3)
if(ST_PYTHON)
  set(pages ${CMAKE_BINARY_DIR}/command_pages)
  add_custom_command(OUTPUT ${pages}/made COMMAND ${CMAKE_COMMAND} -E rm -rf ${pages}
                     COMMAND ${ST_PYTHON} -B ${CMAKE_SOURCE_DIR}/scripts/command_pages.py ${CMAKE_BINARY_DIR}/bin ${pages}
                             ${CMAKE_SOURCE_DIR}/packaging/make_aircraft.1 ${CMAKE_SOURCE_DIR}/packaging/make_model.1
                     COMMAND ${CMAKE_COMMAND} -E touch ${pages}/made
                     DEPENDS ${tools} scripts/command_pages.py packaging/make_aircraft.1 packaging/make_model.1 VERBATIM)
  add_custom_target(st_command_pages ALL DEPENDS ${pages}/made)
  install(DIRECTORY ${pages}/man1 DESTINATION share/man COMPONENT runtime)
  install(DIRECTORY ${pages}/bash/ DESTINATION share/bash-completion/completions COMPONENT runtime)
  install(DIRECTORY ${pages}/zsh/ DESTINATION share/zsh/vendor-completions COMPONENT runtime)
  install(DIRECTORY ${pages}/fish/ DESTINATION share/fish/vendor_completions.d COMPONENT runtime)
endif()

# --- dev ---
set(st_dev_layers base geometry mesh features sizing io)
foreach(layer ${st_dev_layers})
  install(TARGETS st_${layer} EXPORT st ARCHIVE DESTINATION lib COMPONENT dev)
  set_target_properties(st_${layer} PROPERTIES EXPORT_NAME ${layer})
  install(DIRECTORY lib/${layer} DESTINATION include/st COMPONENT dev FILES_MATCHING PATTERN "*.h")
endforeach()
install(EXPORT st NAMESPACE st:: FILE st_targets.cmake DESTINATION lib/cmake/st COMPONENT dev)
configure_package_config_file(packaging/stConfig.cmake.in ${CMAKE_BINARY_DIR}/stConfig.cmake
                              INSTALL_DESTINATION lib/cmake/st)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/stConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/stConfig.cmake ${CMAKE_BINARY_DIR}/stConfigVersion.cmake DESTINATION lib/cmake/st
        COMPONENT dev)

# --- uninstall: what the last installation wrote, by its manifest ---
add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} -DMANIFEST=${CMAKE_BINARY_DIR}/install_manifest.txt
                  -P ${CMAKE_SOURCE_DIR}/cmake/uninstall.cmake VERBATIM)

# --- Debian packages: cpack -G DEB ---
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME st)
set(CPACK_PACKAGE_CONTACT "ST developers <developers@st-mesh.invalid>")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL runtime dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME st)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "openmpi-bin, make, python3")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "python3-h5py, python3-numpy")
file(READ packaging/description.txt description)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "triangulated surfaces of CAD models for CFD\n${description}")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME st-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "st (= ${PROJECT_VERSION}), libeigen3-dev, libhdf5-dev, zlib1g-dev, libfmt-dev, libocct-data-exchange-dev, libtbb-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION "libraries that read sizes and meshes of ST\n${description}This package has the headers and static libraries.\n")
# Only in the packages: what Debian wants at its own places, compressed. CPack runs this while it installs.
set(CPACK_ST_SOURCE_DIR ${CMAKE_SOURCE_DIR})
set(CPACK_ST_VERSION ${PROJECT_VERSION})
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/packaging/debian_files.cmake)
include(CPack)
cpack_add_component(runtime REQUIRED)
cpack_add_component(dev)
