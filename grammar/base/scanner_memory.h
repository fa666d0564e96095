// SPDX-License-Identifier: MIT
// What scanners made by Flex do when they get no memory, the only error that can stop them: they
// throw std::bad_alloc instead of ending the program. To be included by .ll files only.
#pragma once

#include <new>

// Flex defines a function that ends the program, which nothing calls any more.
#pragma GCC diagnostic ignored "-Wunused-function"

#define YY_FATAL_ERROR(message) throw std::bad_alloc()
