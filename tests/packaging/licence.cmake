# SPDX-License-Identifier: MIT
# Fails if a source does not name its licence in its first two lines. Usage: cmake -D SOURCE=<folder> -P licence.cmake
file(GLOB_RECURSE sources RELATIVE "${SOURCE}" LIST_DIRECTORIES false
  "${SOURCE}/cmake/*" "${SOURCE}/compiler/*" "${SOURCE}/grammar/*" "${SOURCE}/packaging/*" "${SOURCE}/runtime/*"
  "${SOURCE}/scripts/*" "${SOURCE}/tests/*" "${SOURCE}/viewer/*"
  "${SOURCE}/web/binding/*" "${SOURCE}/web/test/*")
list(FILTER sources INCLUDE REGEX "(\\.(h|cpp|c|yy|ll|def|glsl|mjs|py|cmake)|CMakeLists\\.txt|scripts/[a-z-]+)$")
# Except files that tests read and expect, and folders that builds write.
list(FILTER sources EXCLUDE REGEX "^tests/(ui/[^/]*/parts|layering/forbidden)/|__pycache__|node_modules|\\.egg-info")
set(count 0)
set(failures "")
foreach(path ${sources})
  file(STRINGS "${SOURCE}/${path}" lines LIMIT_COUNT 2)
  if(NOT lines MATCHES "SPDX-License-Identifier: MIT")
    string(APPEND failures "${path} does not name its licence\n")
  endif()
  math(EXPR count "${count} + 1")
endforeach()
if(failures OR count LESS 1000)
  message(FATAL_ERROR "${count} sources\n${failures}")
endif()
