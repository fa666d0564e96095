// Chooser: which production rewrites a module (LANGUAGE.md section 5). Conditions and draws are
// evaluated here and nowhere else; the answer is a record, which the writing pass reads.
#pragma once

#include "runtime/derive/match.h"
#include "runtime/derive/plan.h"
#include "runtime/expressions/eval.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// What names the draws of one pass.
struct PassKeys {
    std::uint64_t seed = 0;
    std::uint32_t generation = 0;
    std::uint64_t first_draw = 0; // 4096 k in the pass of rule k of a sequential generation
};

/// Reads what it is given when it is asked, so that word and keys may be changed between calls.
template <typename C>
class Chooser {
public:
    Chooser(const Plan& plan,
            const PassKeys& keys,
            const WordView<C>& word,
            const ContextTables* contexts)
        : plan_(plan), keys_(keys), word_(word), matcher_(plan, word, contexts) {}

    /// The record of a module whose row is not Fixed: 0 if nothing matches, r if entry row.base + r
    /// rewrites it. False: a condition has no finite value, fault() tells.
    [[nodiscard]] bool choose(ModulePlace place, const Row& row, std::uint32_t& record);

    [[nodiscard]] const EvalFault& fault() const { return fault_; }
    /// The candidate at fault, an index into Plan::candidate().
    [[nodiscard]] std::uint32_t faulty_candidate() const { return faulty_candidate_; }
    [[nodiscard]] Matcher<C>& matcher() { return matcher_; }

private:
    [[nodiscard]] bool
    condition(const Candidate& candidate, ModulePlace place, const float* own, bool& is_true);
    [[nodiscard]] bool choose_among(const Family& family,
                                    std::uint32_t first,
                                    ModulePlace place,
                                    std::uint32_t& record);
    [[nodiscard]] float module_draw(ModulePlace place) const;

    const Plan& plan_;
    const PassKeys& keys_;
    const WordView<C>& word_;
    Matcher<C> matcher_;
    EvalFault fault_;
    std::uint32_t faulty_candidate_ = 0;
    std::vector<std::uint32_t> matching_;
};

extern template class Chooser<std::uint8_t>;
extern template class Chooser<std::uint16_t>;
extern template class Chooser<std::uint32_t>;

} // namespace lsys
