# SPDX-License-Identifier: MIT
# Fails if a program calls a function of the mathematical library whose results differ between machines. Such functions
# are in grammar/base/trigonometry.h and exponentials.h. Usage: cmake -D NM=<nm> -D PROGRAM=<file> -P check_functions.cmake
execute_process(COMMAND "${NM}" -D --undefined-only "${PROGRAM}" OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
if(NOT symbols MATCHES "floor")
  message(FATAL_ERROR "${NM} lists no functions of the mathematical library")
endif()
set(failures "")
string(REPLACE "\n" ";" lines "${symbols}")
foreach(line IN LISTS lines)
  if(line MATCHES " ((a?(sin|cos|tan)h?|sincos|atan2|exp|exp2|exp10|expm1|log|log2|log10|log1p|pow|hypot|cbrt|[lt]gamma|erfc?)[fl]?)(@|$)")
    string(APPEND failures "${PROGRAM} calls ${CMAKE_MATCH_1}()\n")
  endif()
endforeach()
if(failures)
  message(FATAL_ERROR "${failures}")
endif()
