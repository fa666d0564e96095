// The writing pass: what the counting pass found, written. The common module costs one row, one
// entry, one wide store of codes and one of parameters, and no branch.
#pragma once

#include "runtime/derive/engine/choose.h"
#include "runtime/derive/engine/marks.h"

#include <cstdint>

namespace lsys {

/// A stretch of modules and the room for what they become. Wide stores may spill up to the limits,
/// never beyond; what lies between the stretch's own part and its limits is written later or never.
/// write_modules() moves `begin`, `codes`, `parameters` and `origins` past what it has done.
template <typename C>
struct WriteRequest {
    ModulePlace begin;
    std::uint64_t end = 0;
    C* codes = nullptr;
    C* codes_limit = nullptr;
    float* parameters = nullptr;
    float* parameters_limit = nullptr;
    Origin* origins = nullptr;     // where origins are kept: those of what is written, as `codes`
    const Marks* marks = nullptr;  // then runs of modules that are not marked are moved as blocks
    bool writes_parameters = true; // false: the stretch becomes modules that store none
};

/// False: a parameter is not finite or a range is not one; find_fault() tells which.
/// `records` are those that count_marked(), with marks, or else count_modules() wrote for this
/// stretch.
template <typename C, typename R>
[[nodiscard]] bool write_modules(const Plan& plan,
                                 const PassKeys& keys,
                                 Matcher<C>& matcher,
                                 const WordView<C>& word,
                                 WriteRequest<C>& request,
                                 const R* records);

/// The parameters of one entry for the module at `place`, in order, by the general way.
/// False: `fault` says why.
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
