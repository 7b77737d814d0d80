# SPDX-License-Identifier: MIT
# What all libraries of manifolds, factors and core have in common: trajlo_io is trajlo::io, here and
# for who finds the installed package, with headers as "core/io/...".
include(GNUInstallDirs)

function(trajlo_libraries_below folder result)
  get_property(libraries DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  list(FILTER libraries EXCLUDE REGEX "^trajlo_git_version$")
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(below ${folders})
    trajlo_libraries_below(${below} more)
    list(APPEND libraries ${more})
  endforeach()
  set(${result} ${libraries} PARENT_SCOPE)
endfunction()

foreach(folder manifolds factors core)
  trajlo_libraries_below(${PROJECT_SOURCE_DIR}/${folder} below)
  list(APPEND trajlo_libraries ${below})
endforeach()

foreach(library ${trajlo_libraries})
  get_target_property(type ${library} TYPE)
  set(scope PUBLIC)
  if(type STREQUAL INTERFACE_LIBRARY)
    set(scope INTERFACE)
  endif()
  target_include_directories(${library} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/trajlo>)
  target_compile_features(${library} ${scope} cxx_std_17)
  string(REGEX REPLACE "^trajlo_" "" name ${library})
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
  if(NOT TARGET trajlo::${name})
    add_library(trajlo::${name} ALIAS ${library})
  endif()
endforeach()
