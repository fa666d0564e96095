// SPDX-License-Identifier: MIT
// The counting pass: the number of modules and parameters that rewriting a range of modules will
// write, so that every word is sized exactly before threads write disjoint parts of it. Each module
// whose row is not Fixed gets one record.
#pragma once

#include "runtime/derive/engine/active_mask.h"
#include "runtime/derive/engine/choose.h"

#include <cstdint>

namespace lsys {

/// The modules to count: from `begin` to `end`, or until the modules written would exceed the room
/// for codes or parameters.
struct CountRequest {
    ModulePlace begin;
    std::uint64_t end = 0;
    std::uint64_t room_modules = ~std::uint64_t{0};
    std::uint64_t room_parameters = ~std::uint64_t{0};
};

struct CountResult {
    /// The module at which counting stopped: CountRequest::end; a later one after a match of
    /// several modules; an earlier one if the room was used up or at a fault.
    ModulePlace end;
    std::uint64_t modules = 0;    // modules that rewriting will write
    std::uint64_t parameters = 0; // parameters that rewriting will write
    /// A condition or weight of a production for the module at `end` has no valid value (a run-time
    /// error).
    bool fault = false;
};

/// Writes a record (R: uint8_t or uint32_t, as Plan::record_width says) for each module whose row
/// is not Fixed; with a predecessor of several modules, one for each match and one for each module
/// without a match.
template <typename C, typename R>
[[nodiscard]] CountResult count_modules(const Plan& plan,
                                        Chooser<C>& chooser,
                                        const WordView<C>& word,
                                        const CountRequest& request,
                                        R* records);

/// Counts all modules from `begin` to `end` by their mask, without a lookup of modules that are
/// certain to be copied. Writes a record for each active module whose row is not Fixed.
template <typename C, typename R>
[[nodiscard]] CountResult count_active(const Plan& plan,
                                       Chooser<C>& chooser,
                                       const ActiveMask& mask,
                                       const WordView<C>& word,
                                       ModulePlace begin,
                                       std::uint64_t end,
                                       R* records);

} // namespace lsys
