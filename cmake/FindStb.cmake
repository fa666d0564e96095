# SPDX-License-Identifier: MIT
# Finds the headers of https://github.com/nothings/stb (Debian: libstb-dev) for `#include <stb/...>`.
# Target: stb::stb, without a library to link.
find_path(STB_INCLUDE_DIR stb/stb_perlin.h)
mark_as_advanced(STB_INCLUDE_DIR)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Stb REQUIRED_VARS STB_INCLUDE_DIR)
if(Stb_FOUND AND NOT TARGET stb::stb)
  add_library(stb::stb INTERFACE IMPORTED)
  set_target_properties(stb::stb PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${STB_INCLUDE_DIR}")
endif()
