# SPDX-License-Identifier: MIT
# A test that fails because something is not installed. Usage: cmake -D WHAT=<package> -P missing.cmake
message(FATAL_ERROR "${WHAT} is missing: run scripts/install-packages --tools and configure again")
