# SPDX-License-Identifier: MIT
# Corrects a parser header of Bison 3.8: the constructor of its stack allocates, but is declared noexcept, so a parser
# without memory would end the process. Usage: cmake -D HEADER=parser.h -P BisonStack.cmake
file(READ "${HEADER}" text)
string(REPLACE "stack (size_type n = 200) YY_NOEXCEPT" "stack (size_type n = 200)" text "${text}")
file(WRITE "${HEADER}" "${text}")
