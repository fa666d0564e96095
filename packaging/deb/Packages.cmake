# SPDX-License-Identifier: MIT
# Debian packages by CPack: `cpack` in the build folder, or scripts/package.
set(LSYS_MAINTAINER "The lsc authors <lsc@example.org>" CACHE STRING "Maintainer of the Debian packages")
set(LSYS_DEBIAN_REVISION "1" CACHE STRING "Revision of the Debian packages, after the version")
set(LSYS_DEBIAN_VERSION "${PROJECT_VERSION}-${LSYS_DEBIAN_REVISION}")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lsc)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own
set(CPACK_PACKAGE_VENDOR "The lsc authors")
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
  WORLD_READ WORLD_EXECUTE)
# Adds the files that only Debian packages have: changelog.Debian.gz, copyright, compressed man pages.
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_BINARY_DIR}/deb/stage.cmake")

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL lsc)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_RELEASE "${LSYS_DEBIAN_REVISION}")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${LSYS_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# lsys_deb(COMPONENT NAME SECTION SUMMARY TEXT): sets the name, section and description of a component's package.
function(lsys_deb component name section summary text)
  string(TOUPPER "${component}" upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME "${name}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION "${section}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${text}" PARENT_SCOPE)
endfunction()

lsys_deb(lsc lsc graphics "compiler of L-system grammars, which describe how plants grow"
  "lsc checks grammars and says how to repair them, derives texts of hundreds of
millions of letters in parallel, and writes plants and forests as glTF, USD,
OBJ and other files. It reads grammars of several other programs. Manuals and
more than seventy samples are included.")
set(CPACK_DEBIAN_LSC_PACKAGE_SUGGESTS "lsview, python3-lsys")

if(LSYS_VIEWER)
  list(APPEND CPACK_COMPONENTS_ALL lsview)
  lsys_deb(lsview lsview graphics "viewer of plants and forests of L-systems"
    "lsview shows the plant of a grammar, or a forest of a million trees, while you
edit it, and takes pictures and films without a display.")
  # libepoxy opens these libraries at run time.
  set(CPACK_DEBIAN_LSVIEW_PACKAGE_DEPENDS "libegl1, libgl1")
  set(CPACK_DEBIAN_LSVIEW_PACKAGE_SUGGESTS "lsc, fonts-dejavu-core, ffmpeg")
endif()

if(LSYS_MPI)
  list(APPEND CPACK_COMPONENTS_ALL lsc-mpi)
  lsys_deb(lsc-mpi lsc-mpi graphics "forests of L-systems as 3D Tiles, written on clusters"
    "lsc-mpi writes a forest as 3D Tiles with all processes of an MPI job. The files
are those of the command tiles of lsc.")
  # openmpi-bin has mpirun, which starts the processes; without it Slurm can start them.
  set(CPACK_DEBIAN_LSC-MPI_PACKAGE_RECOMMENDS "openmpi-bin")
  set(CPACK_DEBIAN_LSC-MPI_PACKAGE_SUGGESTS "lsc")
endif()

if(LSYS_SHARED)
  # A library's package is named after its SONAME: liblsys.so.0.1, so liblsys0.1 (Debian policy 8.1).
  set(library "liblsys${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
  list(APPEND CPACK_COMPONENTS_ALL library development)
  lsys_deb(library "${library}" libs "L-systems: shared library"
    "liblsys compiles grammars of L-systems, derives words, draws plants, meshes
them and writes them as files, for programs in C++ and C.")
  # CPack would write the control file `shlibs` for all packages or for none. Only this package
  # needs it, because no program links to the Python module.
  file(CONFIGURE OUTPUT deb/shlibs CONTENT "liblsys ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} \
${library} (>= ${PROJECT_VERSION})\n")
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA
    "${CMAKE_CURRENT_BINARY_DIR}/deb/shlibs;${CMAKE_CURRENT_BINARY_DIR}/deb/triggers")
  lsys_deb(development liblsys-dev libdevel "L-systems: headers and static library"
    "Headers for C++ and C, the static library, and the files by which CMake and
pkg-config find liblsys.")
  # lsysConfig.cmake finds the libraries that the static library needs.
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library} (= ${LSYS_DEBIAN_VERSION}), libfmt-dev, \
libmeshoptimizer-dev, libpng-dev, libutf8proc-dev, zlib1g-dev")
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
endif()

if(LSYS_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  lsys_deb(python python3-lsys python "L-systems: module for Python"
    "The module lsys compiles grammars of L-systems, derives words, and gives words,
skeletons and meshes as arrays of numpy.")
  execute_process(COMMAND "${LSYS_PYTHON_EXECUTABLE}" -c "import sys; print(sys.version_info.minor)"
    OUTPUT_VARIABLE minor OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${minor}), python3 (<< 3.${next}), \
python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    "${CMAKE_CURRENT_SOURCE_DIR}/deb/postinst;${CMAKE_CURRENT_SOURCE_DIR}/deb/prerm")
endif()

set(LSYS_DEB_NAMES "")
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER "${component}" upper)
  string(APPEND LSYS_DEB_NAMES "set(name_${component} \"${CPACK_DEBIAN_${upper}_PACKAGE_NAME}\")\n")
endforeach()
file(CONFIGURE OUTPUT deb/triggers CONTENT "activate-noawait ldconfig\n")
configure_file(deb/stage.cmake.in deb/stage.cmake @ONLY)
include(CPack)
