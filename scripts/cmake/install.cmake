# SPDX-License-Identifier: MIT
# cmake --install. Two components: `development` is the libraries with find_package(trajlo), `programs`
# is the commands with the configurations and scripts that they use.
include(CMakePackageConfigHelpers)

install(TARGETS ${trajlo_libraries} EXPORT trajlo_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/trajlo)
install(EXPORT trajlo_targets FILE trajlo-targets.cmake NAMESPACE trajlo:: DESTINATION ${package_dir}
        COMPONENT development)
set(TRAJLO_COMPONENTS ${trajlo_libraries})
list(TRANSFORM TRAJLO_COMPONENTS REPLACE "^trajlo_" "")
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/trajlo-config.cmake.in
  ${PROJECT_BINARY_DIR}/trajlo-config.cmake INSTALL_DESTINATION ${package_dir})
# Before 1.0 every minor version may change what others build on.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/trajlo-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/trajlo-config.cmake
              ${PROJECT_BINARY_DIR}/trajlo-config-version.cmake
        DESTINATION ${package_dir} COMPONENT development)

set(folders ${TRAJLO_CORE_FOLDERS})
list(TRANSFORM folders PREPEND core/)
foreach(folder manifolds factors ${folders})
  get_filename_component(above ${folder} DIRECTORY)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/trajlo/${above} COMPONENT development
          FILES_MATCHING PATTERN "*.h")
endforeach()

if(NOT TRAJLO_BUILD_APPS)
  return()
endif()
set(commands trajlo_run trajlo_info trajlo_convert trajlo_evaluate trajlo_compare_solvers)
if(TRAJLO_BUILD_SIMULATION)
  list(APPEND commands trajlo_simulate)
endif()
install(TARGETS ${commands} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
foreach(command ${commands})
  install(FILES ${PROJECT_SOURCE_DIR}/scripts/completion.bash RENAME ${command}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT programs)
endforeach()
set(share_dir ${CMAKE_INSTALL_DATADIR}/trajlo)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/config DESTINATION ${share_dir} COMPONENT programs)
# The Python commands: scripts/draw_run.py is trajlo_draw_run. What installs, builds and tests a source
# tree stays there.
set(scripts ${PROJECT_SOURCE_DIR}/scripts)
file(GLOB drawing RELATIVE ${scripts} CONFIGURE_DEPENDS ${scripts}/draw_*.py)
file(RELATIVE_PATH to_scripts /prefix/${CMAKE_INSTALL_BINDIR} /prefix/${share_dir}/scripts)
set(links ${PROJECT_BINARY_DIR}/links)
file(MAKE_DIRECTORY ${links})
foreach(script batch experiment check_covariance.py ${drawing})
  get_filename_component(name ${script} NAME_WE)
  file(CREATE_LINK ${to_scripts}/${script} ${links}/trajlo_${name} SYMBOLIC)
  install(FILES ${links}/trajlo_${name} DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
  install(PROGRAMS ${scripts}/${script} DESTINATION ${share_dir}/scripts COMPONENT programs)
endforeach()
install(DIRECTORY ${scripts}/trajlo_report ${scripts}/trajlo_batch ${scripts}/trajlo_experiment
                  ${scripts}/workflow ${scripts}/datasets
        DESTINATION ${share_dir}/scripts USE_SOURCE_PERMISSIONS COMPONENT programs
        PATTERN __pycache__ EXCLUDE)
