# SPDX-License-Identifier: MIT
# Linux on 64-bit ARM by the cross compiler of Debian (g++-aarch64-linux-gnu). The programs are static, so that
# qemu-user runs them without libraries of that system. Packages come from scripts/cross-packages arm64.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
get_filename_component(LSYS_CROSS "${CMAKE_CURRENT_LIST_DIR}/../../build/cross/arm64" ABSOLUTE)
set(CMAKE_FIND_ROOT_PATH "${LSYS_CROSS}" /usr/aarch64-linux-gnu)
set(CMAKE_PREFIX_PATH "${LSYS_CROSS}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")
find_program(LSYS_QEMU NAMES qemu-aarch64-static qemu-aarch64)
if(LSYS_QEMU)
  set(CMAKE_CROSSCOMPILING_EMULATOR "${LSYS_QEMU}")
endif()
