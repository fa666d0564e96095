# SPDX-License-Identifier: MIT
# Two interface targets that every target of the project links: lsys_options sets the compiler options, lsys_warnings
# the warnings. The functions below add libraries.

# For the same floating-point results on every machine: no contraction to fused multiply-add, no optimisation that
# changes values.
add_library(lsys_options INTERFACE)
target_include_directories(lsys_options INTERFACE "${PROJECT_SOURCE_DIR}")
# LSYS_HAS_FLOAT_CHARS: std::from_chars and std::to_chars of the standard library support floating-point numbers.
# Where they do not (libc++ 13), grammar/base/impl/portable_chars.cpp replaces them, which needs fast_float.
include(CheckCXXSourceCompiles)
check_cxx_source_compiles("#include <charconv>
  int main() { char b[32]; float x = 1; std::to_chars(b, b + 32, x); return std::from_chars(b, b + 32, x).ptr == b; }"
  LSYS_HAS_FLOAT_CHARS)
find_path(LSYS_FAST_FLOAT fast_float/fast_float.h)
mark_as_advanced(LSYS_FAST_FLOAT)
if(NOT LSYS_HAS_FLOAT_CHARS AND NOT LSYS_FAST_FLOAT)
  message(FATAL_ERROR "fast_float is missing, which numbers need with this standard library: install libfast-float-dev")
endif()
target_compile_definitions(lsys_options INTERFACE "LSYS_THREADS=$<BOOL:${LSYS_THREADS}>")
# Every target links fmt and glm, because the precompiled headers include them.
target_link_libraries(lsys_options INTERFACE fmt::fmt glm::glm)
target_compile_options(lsys_options INTERFACE
  -ffp-contract=off
  # Release programs do not contain paths of the machine that built them.
  $<$<CONFIG:Release>:-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=>
  $<$<CONFIG:Release>:-ffile-prefix-map=${PROJECT_BINARY_DIR}/=>)
if(LSYS_SANITIZE)
  target_compile_options(lsys_options INTERFACE
    -fsanitize=${LSYS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(lsys_options INTERFACE -fsanitize=${LSYS_SANITIZE})
endif()
if(LSYS_COVERAGE)
  target_compile_options(lsys_options INTERFACE --coverage)
  target_link_options(lsys_options INTERFACE --coverage)
endif()

# Relative relocations in a packed form (DT_RELR) make a program about 150 KB smaller. Needs the GNU C library 2.36.
if(NOT WIN32 AND NOT EMSCRIPTEN)
  include(CheckLinkerFlag)
  check_linker_flag(CXX "-Wl,-z,pack-relative-relocs,--fatal-warnings" LSYS_HAS_PACKED_RELOCATIONS)
  if(LSYS_HAS_PACKED_RELOCATIONS)
    target_link_options(lsys_options INTERFACE -Wl,-z,pack-relative-relocs)
  endif()
endif()

add_library(lsys_warnings INTERFACE)
target_compile_options(lsys_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align -Wformat=2 -Wimplicit-fallthrough
  -Wdouble-promotion
  # These warnings of g++ 12 are false alarms after inlining: overlaps, bounds and unset values in std::string,
  # std::vector and std::optional. clang and the sanitizers find real faults of these kinds.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-maybe-uninitialized -Wno-array-bounds>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow -Wno-stringop-overread>
  $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond -Wlogical-op>
  # Some integers have 64 bits on Linux and 32 on Windows, where casts to 32 bits are useless.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<NOT:$<BOOL:${WIN32}>>>:-Wuseless-cast>
  $<$<CXX_COMPILER_ID:Clang>:-Wconditional-uninitialized>
  # With addresses of 32 bits, indexes of 64 bits are converted wherever they meet the standard library. Words and
  # meshes that do not fit in memory cause an error before such a conversion.
  $<$<BOOL:${EMSCRIPTEN}>:-Wno-shorten-64-to-32 -Wno-sign-conversion -Wno-c++11-narrowing>
  $<$<BOOL:${LSYS_WERROR}>:-Werror>)

# lsys_shareable(TARGET): objects of a library may be part of the shared library, which exports the declarations marked
# with LSYS_API. Precompiled headers need the same options as their users.
function(lsys_shareable target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# Standard headers that most sources include, compiled once for all libraries and once for all tests. Sources must
# still include what they use: the preset `clang` builds without precompiled headers and finds missing includes.
option(LSYS_PRECOMPILED "Precompile common headers" ON)
add_library(lsys_precompiled STATIC "${CMAKE_CURRENT_LIST_DIR}/precompiled.cpp")
target_link_libraries(lsys_precompiled PRIVATE lsys_options lsys_warnings)
lsys_shareable(lsys_precompiled)
target_precompile_headers(lsys_precompiled PRIVATE
  <algorithm> <array> <cmath> <cstddef> <cstdint> <cstring> <functional> <limits> <memory> <optional>
  <span> <string> <string_view> <unordered_map> <utility> <vector>
  <fmt/format.h> <glm/geometric.hpp> <glm/gtc/quaternion.hpp> <glm/vec3.hpp>)
function(lsys_precompile target)
  if(LSYS_PRECOMPILED)
    target_precompile_headers(${target} REUSE_FROM lsys_precompiled)
  endif()
endfunction()

# lsys_unity(TARGETS...): compiles the sources of the targets in batches of six (unity build), because headers and
# templates take most of the time of a source. Names in unnamed namespaces must be unique within such a target.
# Libraries whose speed the benchmarks measure are not compiled in batches. LSYS_UNITY=OFF compiles each source alone,
# which clang-tidy, coverage and the search for missing includes need.
option(LSYS_UNITY "Compile sources of tests and programs in batches" OFF)
function(lsys_unity)
  set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ${LSYS_UNITY} UNITY_BUILD_BATCH_SIZE 6)
  if(LSYS_UNITY)
    # g++ warns about unnamed namespaces in a batch, because it takes the sources for headers.
    foreach(target ${ARGN})
      target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
    endforeach()
  endif()
endfunction()

# lsys_library(NAME SOURCES...): adds a static library with the options and warnings of the project.
function(lsys_library name)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PUBLIC lsys_options PRIVATE lsys_warnings)
  lsys_shareable(${name})
  lsys_precompile(${name})
endfunction()

# lsys_target_name(FOLDER RESULT): sets RESULT to the target of a folder's library: `lsys_runtime_derive` for
# runtime/derive.
function(lsys_target_name folder result)
  string(REPLACE "/" "_" name "lsys_${folder}")
  set(${result} "${name}" PARENT_SCOPE)
endfunction()

# Sub-folders of runtime/platform whose code is for systems other than the target of the build.
if(WIN32)
  set(LSYS_OTHER_SYSTEMS posix linux macos web)
elseif(EMSCRIPTEN)
  set(LSYS_OTHER_SYSTEMS linux macos windows)
elseif(APPLE)
  set(LSYS_OTHER_SYSTEMS linux windows web)
else()
  set(LSYS_OTHER_SYSTEMS macos windows web polled)
endif()
list(JOIN LSYS_OTHER_SYSTEMS "|" LSYS_OTHER_SYSTEMS)

# lsys_folder(FOLDER PACKAGES...): adds the library of a folder of cmake/Layers.cmake, from all sources in the folder
# and its private sub-folders. Links it to the libraries of the folders that the table lists, and to PACKAGES.
function(lsys_folder folder)
  lsys_target_name(${folder} name)
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${folder}/*.cpp")
  file(GLOB_RECURSE private_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${folder}/*/*.cpp")
  foreach(source ${private_sources})
    file(RELATIVE_PATH path "${PROJECT_SOURCE_DIR}" "${source}")
    lsys_layer("${path}" owner)
    if(owner STREQUAL folder)
      list(APPEND sources "${source}")
    endif()
  endforeach()
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$|/sanitizers/|/runtime/platform/(${LSYS_OTHER_SYSTEMS})/|/portable_chars\\.cpp$")
  if(EMSCRIPTEN)
    list(FILTER sources EXCLUDE REGEX "/runtime/platform/posix/memory\\.cpp$") # web/memory.cpp replaces it
  endif()
  lsys_library(${name} ${sources})
  lsys_layer_includes(${folder} included)
  foreach(other ${included})
    lsys_target_name(${other} library)
    target_link_libraries(${name} PUBLIC ${library})
  endforeach()
  target_link_libraries(${name} PRIVATE ${ARGN})
endfunction()

# lsys_optimise_for_size(TARGETS...): compiles libraries for size, which makes code that reads options and files and
# writes messages or JSON half as large and no slower. The shared precompiled header has other flags, so these libraries
# do not use it.
function(lsys_optimise_for_size)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Os>)
    set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
  endforeach()
endfunction()

# lsys_optimise_files_for_size(FILES...): compiles single files of a library for size.
function(lsys_optimise_files_for_size)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-Os>" SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# lsys_group(NAME FOLDERS...): adds a target that links the libraries of several folders.
function(lsys_group name)
  add_library(${name} INTERFACE)
  foreach(folder ${ARGN})
    lsys_target_name(${folder} library)
    target_link_libraries(${name} INTERFACE ${library})
  endforeach()
endfunction()
