# SPDX-License-Identifier: MIT
# Finds the headers of https://github.com/marzer/tomlplusplus (Debian: libtomlplusplus-dev) for
# `#include <toml++/toml.h>`. Target: toml::headers, without a library to link, because the compiled library of the
# package throws exceptions.
find_path(TOML_INCLUDE_DIR toml++/toml.h)
mark_as_advanced(TOML_INCLUDE_DIR)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(TomlHeaders REQUIRED_VARS TOML_INCLUDE_DIR)
if(TomlHeaders_FOUND AND NOT TARGET toml::headers)
  add_library(toml::headers INTERFACE IMPORTED)
  set_target_properties(toml::headers PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${TOML_INCLUDE_DIR}")
endif()
