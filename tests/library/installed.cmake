# Installs the library into a folder, builds the examples against it, by find_package and by
# pkg-config, and runs them. Usage: cmake -D BUILD=... -D EXAMPLES=... -D SAMPLES=... -D FOLDER=...
# -D COMPILER=... -D LIBRARY_FOLDER=lib -P installed.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${status}\n${out}\n${err}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${FOLDER}")
set(prefix "${FOLDER}/usr")
foreach(component library development)
  run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${prefix}" --component ${component})
endforeach()
file(GLOB installed RELATIVE "${prefix}" "${prefix}/*")
if(NOT installed STREQUAL "include;${LIBRARY_FOLDER}")
  message(FATAL_ERROR "installed besides headers and library: ${installed}")
endif()

set(sample "${SAMPLES}/abop-1-24a/abop-1-24a.lsys")
run("${BUILD}/lsc" dump -q -n 3 "${sample}")
set(expected "${out}")
foreach(static OFF ON)
  set(build "${FOLDER}/build-${static}")
  run("${CMAKE_COMMAND}" -S "${EXAMPLES}" -B "${build}" -D "CMAKE_PREFIX_PATH=${prefix}"
    -D "CMAKE_CXX_COMPILER=${COMPILER}" -D STATIC_LSYS=${static})
  run("${CMAKE_COMMAND}" --build "${build}")
  run("${build}/print_word" "${sample}" 3)
  if(NOT out STREQUAL expected)
    message(FATAL_ERROR "print_word prints\n${out}instead of\n${expected}")
  endif()
  run("${build}/vertex_buffer" "${SAMPLES}/carey-type-1/carey-type-1.lsys")
  if(NOT out MATCHES "bark: [0-9]+ triangles\n[0-9]+ vertices of 32 bytes\n$")
    message(FATAL_ERROR "vertex_buffer prints\n${out}")
  endif()
endforeach()
file(WRITE "${FOLDER}/wrong.lsys" "#n = 1;\n#w : F(lengt);\n")
execute_process(COMMAND "${FOLDER}/build-OFF/diagnostics" INPUT_FILE "${FOLDER}/wrong.lsys"
  RESULT_VARIABLE status OUTPUT_VARIABLE out)
if(NOT status EQUAL 1 OR NOT out MATCHES "^2:8-13 \\[unknown-name\\] unknown name `lengt`\n")
  message(FATAL_ERROR "diagnostics ends with ${status} and prints\n${out}")
endif()

# By pkg-config, as a Makefile would.
find_program(PKG_CONFIG pkg-config REQUIRED)
set(ENV{PKG_CONFIG_PATH} "${prefix}/${LIBRARY_FOLDER}/pkgconfig")
set(ENV{PKG_CONFIG_SYSROOT_DIR} "")
execute_process(COMMAND "${PKG_CONFIG}" "--define-variable=prefix=${prefix}" --cflags --libs lsys
  OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
run("${COMPILER}" "${EXAMPLES}/print_word.cpp" -o "${FOLDER}/print_word" ${flags}
  "-Wl,-rpath,${prefix}/${LIBRARY_FOLDER}")
run("${FOLDER}/print_word" "${sample}" 3)
if(NOT out STREQUAL expected)
  message(FATAL_ERROR "print_word prints\n${out}instead of\n${expected}")
endif()
