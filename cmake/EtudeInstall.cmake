# `cmake --install`, and packages (`cpack -G DEB`): the program, its modules, and the files that it finds next to itself
# by name. The whole tree may be moved, because nothing in it contains the prefix.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
set(ETUDE_MODULES "${CMAKE_INSTALL_LIBDIR}/etude")
file(RELATIVE_PATH modules_from_program "/${CMAKE_INSTALL_BINDIR}" "/${ETUDE_MODULES}")
# `etude` starts etude_program, which is beside its modules: in the build folder, and in their folder after installation.
set_target_properties(etude_program PROPERTIES INSTALL_RPATH "$ORIGIN" BUILD_WITH_INSTALL_RPATH ON)
target_compile_definitions(etude PRIVATE ETUDE_MODULES_FROM_PROGRAM="${modules_from_program}")
install(TARGETS etude RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(TARGETS etude_program RUNTIME DESTINATION "${ETUDE_MODULES}")
install(TARGETS etude_training_pagmo etude_clips_assimp LIBRARY DESTINATION "${ETUDE_MODULES}")
if(TARGET etude_boards_opencv)  # optional, and not in packages, because it would require all of OpenCV
  install(TARGETS etude_boards_opencv LIBRARY DESTINATION "${ETUDE_MODULES}" COMPONENT boards)
endif()

install(DIRECTORY scenarios examples DESTINATION share/etude USE_SOURCE_PERMISSIONS PATTERN __pycache__ EXCLUDE PATTERN node_modules EXCLUDE)
install(DIRECTORY ci DESTINATION share/etude USE_SOURCE_PERMISSIONS)
install(DIRECTORY docs/schemas DESTINATION share/etude)
# The Python package has a folder of its own, which the programs of outside methods can see behind their fence
# (docs/outside-methods.md). A path file tells Debian's Python where this folder is.
install(DIRECTORY python/etude DESTINATION share/etude/python PATTERN __pycache__ EXCLUDE)
file(WRITE "${CMAKE_BINARY_DIR}/etude.pth" "../../../share/etude/python\n")
install(FILES "${CMAKE_BINARY_DIR}/etude.pth" DESTINATION lib/python3/dist-packages)
install(DIRECTORY docs/ DESTINATION "${CMAKE_INSTALL_DOCDIR}/docs" PATTERN schemas EXCLUDE)
install(DIRECTORY findings DESTINATION "${CMAKE_INSTALL_DOCDIR}" USE_SOURCE_PERMISSIONS)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION "${CMAKE_INSTALL_DOCDIR}")
# The pages link to these folders, which are installed in share/etude, where the program finds them. A symbolic link
# in the folder of documentation leads to each of them.
set(links "${CMAKE_BINARY_DIR}/doc_links")
file(MAKE_DIRECTORY "${links}/docs")
foreach(name docs/schemas examples scenarios ci)
  cmake_path(GET name FILENAME folder)
  cmake_path(GET name PARENT_PATH above)
  file(RELATIVE_PATH there "/${CMAKE_INSTALL_DOCDIR}/${above}" "/share/etude/${folder}")
  file(CREATE_LINK "${there}" "${links}/${name}" SYMBOLIC)
endforeach()
install(DIRECTORY "${links}/" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" RENAME copyright)
# Write what Debian requires of each package.
set(changelog "${CMAKE_BINARY_DIR}/changelog.gz")
execute_process(COMMAND gzip -9nc "${CMAKE_SOURCE_DIR}/CHANGELOG.md" OUTPUT_FILE "${changelog}" COMMAND_ERROR_IS_FATAL ANY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS CHANGELOG.md)
install(FILES "${changelog}" DESTINATION share/doc/etude)
set(packages libetude libetude-dev)
set(components library development)
foreach(package component IN ZIP_LISTS packages components)
  install(FILES LICENSE DESTINATION share/doc/${package} COMPONENT ${component} RENAME copyright)
  install(FILES "${changelog}" DESTINATION share/doc/${package} COMPONENT ${component})
endforeach()

# The program makes its manual pages from its options.
set(made "${CMAKE_BINARY_DIR}/option_tree")
add_custom_command(OUTPUT "${made}/etude.fish"
  COMMAND "${CMAKE_COMMAND}" -E rm -rf "${made}/man"
  COMMAND etude man "${made}/man" >/dev/null
  COMMAND gzip -9nr "${made}/man"
  COMMAND etude completion bash > "${made}/etude"
  COMMAND etude completion zsh > "${made}/_etude"
  COMMAND etude completion fish > "${made}/etude.fish"
  DEPENDS etude COMMENT "Writing manual pages and completions")
add_custom_target(etude_option_tree ALL DEPENDS "${made}/etude.fish")
install(DIRECTORY "${made}/man/" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
install(FILES "${made}/etude" DESTINATION share/bash-completion/completions)
install(FILES "${made}/_etude" DESTINATION share/zsh/vendor-completions)
install(FILES "${made}/etude.fish" DESTINATION share/fish/vendor_completions.d)

# The libraries, for `find_package(Etude)`.
set(config "${CMAKE_INSTALL_LIBDIR}/cmake/Etude")
install(TARGETS etude_shared etude_sim_shared EXPORT EtudeTargets
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library NAMELINK_COMPONENT development)
install(DIRECTORY engine/api/etude sim/api/etude DESTINATION include/etude COMPONENT development FILES_MATCHING PATTERN "*.h")
# Install the headers of engine and sim whose namespace is public. Of our headers they include only installed ones
# (checked by tests/guards).
file(GLOB_RECURSE headers RELATIVE "${CMAKE_SOURCE_DIR}" CONFIGURE_DEPENDS engine/*.h sim/*.h)
foreach(header IN LISTS headers)
  file(STRINGS "${header}" public REGEX "^namespace \\[\\[gnu::visibility" LIMIT_COUNT 1)
  if(public)
    cmake_path(GET header PARENT_PATH folder)
    install(FILES "${header}" DESTINATION "include/etude/${folder}" COMPONENT development)
  endif()
endforeach()
install(EXPORT EtudeTargets NAMESPACE etude:: DESTINATION "${config}" COMPONENT development)
file(WRITE "${CMAKE_BINARY_DIR}/EtudeConfig.cmake"
  "include(CMakeFindDependencyMacro)\nfind_dependency(glm)\ninclude(\"\${CMAKE_CURRENT_LIST_DIR}/EtudeTargets.cmake\")\n")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/EtudeConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/EtudeConfig.cmake" "${CMAKE_BINARY_DIR}/EtudeConfigVersion.cmake"
  DESTINATION "${config}" COMPONENT development)

# A package's version ends with the number of its Debian release, so that the package for the later release counts as
# the newer one: 0.4.0+deb12 < 0.4.0+deb13.
cmake_host_system_information(RESULT system QUERY DISTRIB_INFO)
set(package_version "${PROJECT_VERSION}")
if(system_ID STREQUAL debian AND system_VERSION_ID)  # a Debian after the latest release has no number
  string(APPEND package_version "+deb${system_VERSION_ID}")
endif()
set(CPACK_PACKAGE_NAME etude)
set(CPACK_PACKAGE_VENDOR "The Etude authors")
set(CPACK_PACKAGE_CONTACT "The Etude authors <etude@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Deterministic benchmark for interactive human motion")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "Synthesizes what sensors would have seen of a motion, replays it
through a dance coach and a markerless capture, and compares methods
in worlds whose truth is known.")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
  "Inverse kinematics, transitions between clips, recognition of moves and
capture by cameras, and simulated sensors, for programs that link them.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "The headers of libetude and libetude_sim, and what CMake's
find_package(Etude) reads.")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
file(WRITE "${CMAKE_BINARY_DIR}/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA "${CMAKE_BINARY_DIR}/triggers")
set(CPACK_DEBIAN_PACKAGE_VERSION "${package_version}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program library development)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME etude)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libetude)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libetude-dev)
# Debian's tools find linked libraries. The lists below name the packages whose libraries, programs and files Etude
# opens by name while it runs; assimp-testmodels has clips of the quick suite.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(OSMESA_FOUND)
  set(draws libosmesa6)
else()
  set(draws "libegl1, libegl-mesa0, libgl1-mesa-dri")
endif()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "${draws}, ffmpeg, fonts-dejavu-core, bubblewrap, assimp-testmodels")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS python3)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "${draws}")  # the libraries that draw pictures
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libetude (= ${package_version}), libglm-dev")
include(CPack)
