# SPDX-License-Identifier: MIT
# Compares the functions that the shared library exports with a list. A removed function or a changed
# signature breaks programs that are already linked: increase the version of the library (SOVERSION),
# then copy the new list. Usage: cmake -D LIBRARY=... -D NM=... -D EXPECTED=... -D ACTUAL=...
execute_process(COMMAND "${NM}" -D --defined-only -C --format=just-symbols "${LIBRARY}"
  OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE ";" "," symbols "${symbols}")
string(REPLACE "\n" ";" symbols "${symbols}")
list(REMOVE_ITEM symbols "")
list(REMOVE_DUPLICATES symbols)
list(SORT symbols)
list(JOIN symbols "\n" text)
file(WRITE "${ACTUAL}" "${text}\n")
file(READ "${EXPECTED}" expected)
if(NOT "${text}\n" STREQUAL "${expected}")
  message(FATAL_ERROR "the library exports other functions than ${EXPECTED} lists; see ${ACTUAL}")
endif()
