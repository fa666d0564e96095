# SPDX-License-Identifier: MIT
# Writes the commit of the sources, for `lsc --version --verbose`, and its date, for man pages: in a repository from
# git, else from packaging/revision.txt, which `git archive` fills. A file whose
# content stays the same keeps its modification time.
# Usage: cmake -D SOURCE=... -D HEADER=revision.h -D DATE=date.txt -P Revision.cmake
cmake_minimum_required(VERSION 3.25)
set(revision "")
set(changed 0)
find_package(Git QUIET)
if(Git_FOUND AND EXISTS "${SOURCE}/.git")
  execute_process(COMMAND "${GIT_EXECUTABLE}" -C "${SOURCE}" log -1 "--format=commit %H%nepoch %ct%n"
    OUTPUT_VARIABLE text ERROR_QUIET)
  execute_process(COMMAND "${GIT_EXECUTABLE}" -C "${SOURCE}" diff-index --quiet HEAD --
    RESULT_VARIABLE changed ERROR_QUIET)
elseif(EXISTS "${SOURCE}/packaging/revision.txt")
  file(READ "${SOURCE}/packaging/revision.txt" text)
endif()
if("${text}" MATCHES "commit ([0-9a-f]+)\nepoch ([0-9]+)\n")
  string(SUBSTRING "${CMAKE_MATCH_1}" 0 12 revision)
  set(ENV{SOURCE_DATE_EPOCH} "${CMAKE_MATCH_2}")
endif()
string(TIMESTAMP date "%Y-%m-%d" UTC) # of SOURCE_DATE_EPOCH, if that is set
if(revision STREQUAL "")
  set(text "unknown")
else()
  set(text "${revision} of ${date}")
  if(NOT changed EQUAL 0)
    string(APPEND text ", with changes")
  endif()
endif()
file(CONFIGURE OUTPUT "${HEADER}" CONTENT "#define LSYS_REVISION \"${text}\"\n" @ONLY)
file(CONFIGURE OUTPUT "${DATE}" CONTENT "${date}\n" @ONLY)
