// SPDX-License-Identifier: MIT
// The types for which templates of the engine are instantiated: codes C of 1, 2 and 4 bytes,
// records R of 1 and 4 bytes. INSTANTIATE is a macro with parameters C, or C and R.
#pragma once

#include <cstdint>

#define LSYS_FOR_CODES(INSTANTIATE)                                                                \
    INSTANTIATE(std::uint8_t)                                                                      \
    INSTANTIATE(std::uint16_t)                                                                     \
    INSTANTIATE(std::uint32_t)

#define LSYS_FOR_CODES_AND_RECORDS(INSTANTIATE)                                                    \
    INSTANTIATE(std::uint8_t, std::uint8_t)                                                        \
    INSTANTIATE(std::uint8_t, std::uint32_t)                                                       \
    INSTANTIATE(std::uint16_t, std::uint8_t)                                                       \
    INSTANTIATE(std::uint16_t, std::uint32_t)                                                      \
    INSTANTIATE(std::uint32_t, std::uint8_t)                                                       \
    INSTANTIATE(std::uint32_t, std::uint32_t)
