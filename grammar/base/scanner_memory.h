// SPDX-License-Identifier: MIT
// Scanners made by Flex stop only if an allocation fails. With this macro they then throw
// std::bad_alloc instead of ending the program. For .ll files only.
#pragma once

#include <new>

// Flex defines a function that ends the program, which nothing calls any more.
#pragma GCC diagnostic ignored "-Wunused-function"

#define YY_FATAL_ERROR(message) throw std::bad_alloc()
