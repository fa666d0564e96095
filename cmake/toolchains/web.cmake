# SPDX-License-Identifier: MIT
# WebAssembly by Emscripten of Debian (emscripten): programs for Node.js that access the files of the machine. Packages
# come from scripts/cross-packages web.
set(LSYS_EMSCRIPTEN /usr/share/emscripten)
include("${LSYS_EMSCRIPTEN}/cmake/Modules/Platform/Emscripten.cmake")
get_filename_component(LSYS_CROSS "${CMAKE_CURRENT_LIST_DIR}/../../build/cross/web" ABSOLUTE)
list(PREPEND CMAKE_FIND_ROOT_PATH "${LSYS_CROSS}")
set(CMAKE_PREFIX_PATH "${LSYS_CROSS}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# Running out of memory throws an exception, which the libraries catch (runtime/README.md, Memory). Exceptions of
# WebAssembly cost nothing until one is thrown; exceptions that Emscripten implements in JavaScript slow down every
# call.
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -include ${CMAKE_CURRENT_LIST_DIR}/libcxx13.h")
set(CMAKE_EXE_LINKER_FLAGS_INIT
  "-fwasm-exceptions -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB -sTOTAL_STACK=8MB")
# Emscripten runs its optimiser of JavaScript with any Node.js; the modules that it needs are in Debian's folder.
set(CMAKE_CXX_LINKER_LAUNCHER env NODE_PATH=/usr/share/nodejs)
set(ENV{NODE_PATH} /usr/share/nodejs)
