// SPDX-License-Identifier: MIT
// The writing pass: writes the modules that the counting pass has counted. A typical module costs
// one row, one entry, one wide store of codes and one of parameters, and no branch.
#pragma once

#include "runtime/derive/engine/active_mask.h"
#include "runtime/derive/engine/choose.h"

#include <cstdint>

namespace lsys {

/// A range of modules and the room for their successors. Wide stores may write garbage up to the
/// limits, never beyond: memory between the successors and the limits is written later or never.
/// write_modules() advances `begin`, `codes`, `parameters` and `origins`.
template <typename C>
struct WriteRequest {
    ModulePlace begin;
    std::uint64_t end = 0;
    C* codes = nullptr; // where the next code is written
    C* codes_limit = nullptr;
    float* parameters = nullptr; // where the next parameter is written
    float* parameters_limit = nullptr;
    Origin* origins = nullptr;        // one per code; null: none are kept
    const ActiveMask* mask = nullptr; // if set, runs of inactive modules are moved as blocks
    bool writes_parameters = true;    // false: no written module stores a parameter
};

/// Writes the successors of the modules of `request`. Returns false if a parameter is not finite or
/// a random range is invalid; find_fault() finds the module. `records` were written by
/// count_active() if the request has a mask, else by count_modules().
template <typename C, typename R>
[[nodiscard]] bool write_modules(const Plan& plan,
                                 const PassKeys& keys,
                                 Matcher<C>& matcher,
                                 const WordView<C>& word,
                                 WriteRequest<C>& request,
                                 const R* records);

/// Evaluates the parameters of one entry for the module at `place`, in order, with evaluate().
/// Returns false and sets `fault` if one cannot be evaluated to a finite value.
template <typename C>
[[nodiscard]] bool evaluate_entry(const Plan& plan,
                                  const PassKeys& keys,
                                  Matcher<C>& matcher,
                                  std::uint64_t position,
                                  ModulePlace place,
                                  const Entry& entry,
                                  float* out,
                                  EvalFault& fault);

} // namespace lsys
