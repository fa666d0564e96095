# SPDX-License-Identifier: MIT
# Windows on x86-64 by MinGW-w64 of Debian (g++-mingw-w64-x86-64-posix). The programs need no library but those of
# Windows. Packages come from scripts/cross-packages windows; Wine runs tests.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
get_filename_component(LSYS_CROSS "${CMAKE_CURRENT_LIST_DIR}/../../build/cross/windows" ABSOLUTE)
set(CMAKE_FIND_ROOT_PATH "${LSYS_CROSS}" /usr/x86_64-w64-mingw32)
set(CMAKE_PREFIX_PATH "${LSYS_CROSS}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# 0x0A00 is Windows 10, which has long paths and escape codes in consoles. The assembler replaces aligned moves of
# vectors by unaligned ones, because g++ aligns the stack to 16 bytes only and spilled AVX2 vectors need 32 (GCC bug
# 54412).
set(CMAKE_CXX_FLAGS_INIT "-D_WIN32_WINNT=0x0A00 -DUNICODE -D_UNICODE -DWIN32_LEAN_AND_MEAN -DNOMINMAX -Wa,-muse-unaligned-vector-move")
# A stack of 8 MiB as on Linux, for tests of deep nesting.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -Wl,--stack,8388608")
find_program(LSYS_WINE NAMES wine64 wine PATHS /usr/lib/wine)
if(LSYS_WINE)
  set(CMAKE_CROSSCOMPILING_EMULATOR "${LSYS_WINE}")
endif()
