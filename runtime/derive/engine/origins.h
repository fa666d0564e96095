// The origins of what a pass writes: a second walk over what the counting pass chose, for those who
// ask. Where a production was applied, its successor's modules are born; what is copied keeps its
// origin.
#pragma once

#include "runtime/derive/engine/marks.h"
#include "runtime/derive/engine/match.h"
#include "runtime/derive/engine/plan.h"

#include <cstdint>

namespace lsys {

/// Modules [begin, end) of the word that is read: exactly those that were written.
struct OriginRequest {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    std::uint32_t generation = 0; // of the word that is written
    const Marks* marks = nullptr; // those of WriteRequest
};

/// `records` as for write_modules(). Returns where the next origin belongs.
/// Precondition: word.origins is there.
template <typename C, typename R>
[[nodiscard]] Origin* trace_origins(const Plan& plan,
                                    const WordView<C>& word,
                                    const OriginRequest& request,
                                    const R* records,
                                    Origin* out);

/// The origins of the axiom's modules.
void copy_axiom_origins(const Bytecode& bytecode, Origin* out);

} // namespace lsys
