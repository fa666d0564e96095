// The counting pass: for a stretch of modules, what rewriting it will write, so that every word is
// sized exactly before it is written and cut into parts that do not meet. Modules whose row is not
// Fixed leave one record each.
#pragma once

#include "runtime/derive/engine/choose.h"
#include "runtime/derive/engine/marks.h"

#include <cstdint>

namespace lsys {

/// What to count: from `begin` up to `end`, while no more than the room is written.
struct CountRequest {
    ModulePlace begin;
    std::uint64_t end = 0;
    std::uint64_t room_modules = ~std::uint64_t{0};
    std::uint64_t room_parameters = ~std::uint64_t{0};
};

struct CountResult {
    /// Where counting stopped: at the end; beyond it by a match of several modules; before it for
    /// want of room or at a fault.
    ModulePlace end;
    std::uint64_t modules = 0;
    std::uint64_t parameters = 0;
    bool fault = false; // a condition of the module at `end` has no finite value
};

/// Writes a record (R: uint8_t or uint32_t, as Plan::record_width says) for each module whose row
/// is not Fixed; with a predecessor of several modules, for each match and each miss.
template <typename C, typename R>
[[nodiscard]] CountResult count_modules(const Plan& plan,
                                        Chooser<C>& chooser,
                                        const WordView<C>& word,
                                        const CountRequest& request,
                                        R* records);

/// The same for all modules from `begin` to `end` by their marks, which leave out what is surely
/// copied: a record for each marked module whose row is not Fixed.
template <typename C, typename R>
[[nodiscard]] CountResult count_marked(const Plan& plan,
                                       Chooser<C>& chooser,
                                       const Marks& marks,
                                       const WordView<C>& word,
                                       ModulePlace begin,
                                       std::uint64_t end,
                                       R* records);

} // namespace lsys
