# The two interface targets that every target of ours links: how code is compiled, and how strictly.

# Numbers are portable: no contraction to fused multiply-add, no value-changing optimisation.
add_library(lsys_options INTERFACE)
target_include_directories(lsys_options INTERFACE "${PROJECT_SOURCE_DIR}")
target_compile_options(lsys_options INTERFACE
  -ffp-contract=off
  # What users get names no folder of the machine that built it.
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

add_library(lsys_warnings INTERFACE)
target_compile_options(lsys_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align -Wformat=2 -Wimplicit-fallthrough
  -Wdouble-promotion
  # -Wrestrict: g++ 12 sees overlaps in std::string's operator+ that cannot be. A warning of null
  # dereferences is not in the set: with optimisation or sanitizers it sees them in the containers.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wduplicated-cond -Wlogical-op -Wuseless-cast>
  $<$<BOOL:${LSYS_WERROR}>:-Werror>)
if(LSYS_SANITIZE)
  # g++ 12 loses track of std::string's buffers in code with sanitizers.
  target_compile_options(lsys_warnings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()

# lsys_library(NAME SOURCES... ) : a static library of ours.
function(lsys_library name)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PUBLIC lsys_options PRIVATE lsys_warnings)
endfunction()
