# SPDX-License-Identifier: MIT
# cpack -G DEB: `trajlo` (the commands) and `libtrajlo-dev` (the libraries). scripts/package.sh makes
# them for any CPU.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME trajlo)
set(CPACK_PACKAGE_VENDOR "The trajlo authors")
set(CPACK_PACKAGE_CONTACT "The trajlo authors <trajlo@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_COMPONENTS_ALL programs development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME trajlo)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libtrajlo-dev)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(built_for "")
if(TRAJLO_ARCH)
  set(built_for "\n.\nBuilt with -march=${TRAJLO_ARCH}: other CPUs cannot run it.")
  # The name says it too.
  set(CPACK_DEBIAN_PACKAGE_RELEASE "1+${TRAJLO_ARCH}")
  string(REPLACE "-" "." CPACK_DEBIAN_PACKAGE_RELEASE "${CPACK_DEBIAN_PACKAGE_RELEASE}")
endif()
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "LiDAR odometry in continuous time (Traj-LO)
From the points of one or more LiDARs, each with its time, trajlo finds the way of the sensor and a
map, with nothing but geometry. The commands read recordings (bags, MCAP, packet captures, folders of
scans), estimate, evaluate against a ground truth, compare solvers, simulate, and draw a page with
figures and a 3-D view.${built_for}")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "LiDAR odometry in continuous time (C++ libraries)
The static libraries and headers of trajlo, with find_package(trajlo) for CMake.${built_for}")

# Programs: what they link, and what the page is drawn with. trajlo_batch needs Snakemake.
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "python3, python3-jinja2, python3-matplotlib, python3-numpy, \
python3-scipy, python3-yaml, libjs-three")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS snakemake)
# Libraries: what find_package(trajlo) looks for.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libceres-dev (>= 2.1), libeigen3-dev (>= 3.4), libtbb-dev, \
libyaml-cpp-dev, libbz2-dev, liblz4-dev, liblzf-dev, libpcap-dev, libsqlite3-dev, libzstd-dev, zlib1g-dev")
if(TRAJLO_BUILD_SIMULATION)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libembree-dev")
endif()
foreach(pair programs=trajlo development=libtrajlo-dev)
  string(REPLACE "=" ";" pair ${pair})
  list(GET pair 0 component)
  list(GET pair 1 package)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
          RENAME copyright COMPONENT ${component})
endforeach()
include(CPack)
