# The headers of https://github.com/nothings/stb, as in Debian's libstb-dev: stb::stb, for
# `#include <stb/...>`. Nothing is linked.
find_path(STB_INCLUDE_DIR stb/stb_perlin.h)
mark_as_advanced(STB_INCLUDE_DIR)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Stb REQUIRED_VARS STB_INCLUDE_DIR)
if(Stb_FOUND AND NOT TARGET stb::stb)
  add_library(stb::stb INTERFACE IMPORTED)
  set_target_properties(stb::stb PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${STB_INCLUDE_DIR}")
endif()
