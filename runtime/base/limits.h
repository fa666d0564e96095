// What a run may use, and what happened when it was not enough. A limit is an outcome, never an
// abort.
#pragma once

#include <cstdint>

namespace lsys {

struct Limits {
    std::uint64_t max_modules = std::uint64_t{1} << 32; // of one word
    std::uint64_t max_bytes = ~std::uint64_t{0};        // of all a derivation holds
};

enum class LimitKind : std::uint8_t { Modules, Memory };

/// Where a derivation stopped for a limit.
struct LimitReport {
    LimitKind kind = LimitKind::Modules;
    std::uint32_t generation = 0;           // the last complete word's age
    std::uint64_t modules = 0;              // of that word
    std::uint64_t predicted_modules = 0;    // of the word that did not fit
    std::uint64_t predicted_bytes = 0;      // of all that would be held
    bool exact = true;                      // else the predictions are lower bounds
    bool streamed = false;                  // then `generation` is the one that is handed out
    std::uint32_t production = 0xFFFFFFFFu; // the one that adds most modules in that step, or none
};

} // namespace lsys
