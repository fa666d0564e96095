# SPDX-License-Identifier: MIT
add_custom_target(generated_sources COMMENT "Scanners and parsers") # clang-tidy needs these files

# lsys_add_grammar(TARGET FOLDER): runs Bison on parser.yy and Flex on scanner.ll of FOLDER, and adds the
# results to TARGET. Sources include them as `NAME/parser.h`, with NAME the last part of FOLDER. The results
# are in the build folder, not beside the sources.
function(lsys_add_grammar target folder)
  get_filename_component(dialect "${folder}" NAME)
  set(source "${PROJECT_SOURCE_DIR}/${folder}")
  set(out "${CMAKE_CURRENT_BINARY_DIR}/${dialect}")
  file(MAKE_DIRECTORY "${out}")
  bison_target(${dialect}_parser "${source}/parser.yy" "${out}/parser.cpp"
    DEFINES_FILE "${out}/parser.h"
    COMPILE_FLAGS "-Wall -Wcounterexamples -Werror -M ${PROJECT_SOURCE_DIR}=. -M ${PROJECT_BINARY_DIR}=.")
  add_custom_command(OUTPUT "${out}/parser.cpp" APPEND COMMAND
    "${CMAKE_COMMAND}" -D "HEADER=${out}/parser.h" -P "${PROJECT_SOURCE_DIR}/cmake/BisonStack.cmake")
  flex_target(${dialect}_scanner "${source}/scanner.ll" "${out}/scanner.cpp"
    DEFINES_FILE "${out}/scanner.h")
  add_flex_bison_dependency(${dialect}_scanner ${dialect}_parser)
  add_custom_target(${dialect}_sources
    DEPENDS ${BISON_${dialect}_parser_OUTPUTS} ${FLEX_${dialect}_scanner_OUTPUTS})
  add_dependencies(generated_sources ${dialect}_sources)
  target_sources(${target} PRIVATE
    ${BISON_${dialect}_parser_OUTPUTS} ${FLEX_${dialect}_scanner_OUTPUTS})
  target_include_directories(${target} PRIVATE "${CMAKE_CURRENT_BINARY_DIR}")
  # Warnings of generated code are off: scanners of Flex 2.6 have C casts and mix signs, and the LAC code (lookahead
  # correction) in parsers of Bison 3.8 narrows states.
  # -fno-inline: all actions of a scanner are one function, which is called for every token. Inlined token
  # constructors would each add local variables to it, which sanitizers initialise at every call.
  set_source_files_properties("${out}/scanner.cpp" PROPERTIES
    COMPILE_OPTIONS "-fno-inline;-Wno-old-style-cast;-Wno-sign-conversion;-Wno-null-dereference;$<$<CXX_COMPILER_ID:GNU>:-Wno-useless-cast>"
    SKIP_LINTING ON SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
  set_source_files_properties("${out}/parser.cpp" PROPERTIES
    COMPILE_OPTIONS "-Wno-conversion;-Wno-sign-conversion"
    SKIP_LINTING ON SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
endfunction()
