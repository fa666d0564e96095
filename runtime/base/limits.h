// SPDX-License-Identifier: MIT
// Limits of a run, and the report of a run that reached a limit.
#pragma once

#include <cstdint>

namespace lsys {

struct Limits {
    std::uint64_t max_modules = std::uint64_t{1} << 32; // max modules of one word
    /// Max bytes of a derivation, skeleton, mesh or file.
    std::uint64_t max_bytes = ~std::uint64_t{0};

    friend bool operator==(const Limits&, const Limits&) = default;
};

enum class LimitKind : std::uint8_t { Modules, Memory };

/// The limit that a derivation reached, and its place.
struct LimitReport {
    LimitKind kind = LimitKind::Modules;
    std::uint32_t generation = 0;        // age of the last complete word
    std::uint64_t modules = 0;           // modules of the last complete word
    std::uint64_t predicted_modules = 0; // modules of the word that did not fit
    std::uint64_t predicted_bytes = 0;   // memory in use with the word that did not fit
    bool exact = true;                   // false: predictions are lower bounds
    bool streamed = false;               // `generation` is the age of a streamed, incomplete word
    /// Index of the production that adds most modules to the word that did not fit, or none.
    std::uint32_t production = 0xFFFFFFFFu;
};

} // namespace lsys
