// SPDX-License-Identifier: MIT
// Chooser: chooses the production that rewrites a module (docs/language.md section 5). Conditions
// and draws are evaluated only here; the result is a record, which the writing pass reads.
#pragma once

#include "runtime/base/random.h"
#include "runtime/derive/engine/eval.h"
#include "runtime/derive/engine/match.h"
#include "runtime/derive/engine/plan.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// The key of the draws of one pass.
struct PassKeys {
    std::uint64_t seed = 0;
    std::uint32_t generation = 0;
    /// Number of the first draw of each module: 0, or in a sequential generation 4096 k for the
    /// pass of rule k; for later stages see stage_depth.h.
    std::uint64_t first_draw = 0;
    bool keeps_age = false; // the written word has age `generation`, not `generation` + 1
};

/// Refers to the plan, the keys and the word, all of which outlive the object. Keys and word may
/// change between calls.
template <typename C>
class Chooser {
public:
    Chooser(const Plan& plan,
            const PassKeys& keys,
            const WordView<C>& word,
            const ContextTables* contexts)
        : plan_(plan), keys_(keys), word_(word), contexts_(contexts),
          matcher_(plan, word, contexts) {}

    /// Sets `record` of a module whose row is not Fixed: 0 if nothing matches, r if entry
    /// row.base + r rewrites it. Returns false if a condition or weight has no valid value; see
    /// fault().
    [[nodiscard]] bool choose(const ModulePlace& place, const Row& row, std::uint32_t& record);

    /// The draw of a module of a Choice row. module_draws() makes the draws of several modules.
    [[nodiscard]] float module_draw(std::uint64_t index) const {
        const std::uint64_t position = word_.first_position + index;
        const DrawKey key = choice_key();
        const PhiloxBlock block = draw_block(key.seed, key.generation, position, key.block);
        return unit_interval(block[key.word]);
    }
    /// Writes the draws of the `count` modules at `positions` to `units`.
    void module_draws(const std::uint64_t* positions, std::size_t count, float* units) const {
        draw_units(choice_key(), positions, count, units);
    }
    /// choose() for a Choice row, given the module's draw; cannot fail.
    [[nodiscard]] std::uint32_t choose_by_chance(float u, const Row& row) const {
        const Choice& choice = plan_.choice(row.source);
        const float* const thresholds = plan_.thresholds(choice).data();
        std::uint32_t taken = 0;
        for (std::uint32_t i = 0; i + 1 < choice.count; ++i) {
            taken += thresholds[i] > u ? 0U : 1U; // thresholds ascend
        }
        return plan_.records(choice)[taken];
    }
    /// choose() for a Tests row; cannot fail. `own`: the parameters of the module.
    [[nodiscard]] std::uint32_t choose_by_test(const float* own, const Row& row) const {
        for (const Test& test : plan_.tests(row.source)) {
            if (holds(test.comparison, own)) {
                return test.record;
            }
        }
        return 0;
    }
    /// Whether the neighbours of a module of a General row allow any match.
    [[nodiscard]] bool passes_guards(std::uint64_t index, const Row& row) const {
        if (row.left_guard != kNone) {
            const std::uint64_t left = contexts_->left_of(index);
            if (left == kNowhere || plan_.guards()[row.left_guard + word_.codes[left]] == 0) {
                return false;
            }
        }
        if (row.right_guard != kNone) {
            const std::uint64_t next = contexts_->next_from(index + plan_.guard_distance());
            if (next == kNowhere || plan_.guards()[row.right_guard + word_.codes[next]] == 0) {
                return false;
            }
        }
        return true;
    }

    [[nodiscard]] const EvalFault& fault() const { return fault_; }
    /// Whether it is a weight, not a condition, that has no valid value.
    [[nodiscard]] bool fault_in_weight() const { return fault_in_weight_; }
    /// The candidate of the fault, an index for Plan::candidate().
    [[nodiscard]] std::uint32_t faulty_candidate() const { return faulty_candidate_; }
    [[nodiscard]] Matcher<C>& matcher() { return matcher_; }

private:
    /// Evaluates the condition of a candidate. `own`: the parameters of the module. Returns false
    /// on a fault.
    [[nodiscard]] bool condition(const Candidate& candidate,
                                 const ModulePlace& place,
                                 const float* own,
                                 bool& is_true);
    /// Evaluates the expression of a candidate at instruction `first`. Returns false on a fault.
    [[nodiscard]] bool evaluate_for(const Candidate& candidate,
                                    std::uint32_t first,
                                    const ModulePlace& place,
                                    float& value);
    /// Records the candidate to which fault_ belongs. Returns false.
    bool set_faulty_candidate(const Candidate& candidate, bool in_weight);
    /// Computes the weight of a matching candidate and adds it to `sum`. Returns false on a fault.
    [[nodiscard]] bool
    weight(const Candidate& candidate, const ModulePlace& place, float& sum, float& weight);
    /// The stochastic choice among the candidates in the group of `first`, which is known to match.
    [[nodiscard]] bool choose_among(const Family& family,
                                    std::uint32_t first,
                                    const ModulePlace& place,
                                    std::uint32_t& record);
    [[nodiscard]] DrawKey choice_key() const {
        return {keys_.seed, keys_.generation, static_cast<std::uint32_t>(keys_.first_draw / 4),
                static_cast<std::uint32_t>(keys_.first_draw % 4)};
    }

    const Plan& plan_;
    const PassKeys& keys_;
    const WordView<C>& word_;
    const ContextTables* contexts_;
    Matcher<C> matcher_;
    EvalFault fault_;
    std::uint32_t faulty_candidate_ = 0;
    bool fault_in_weight_ = false;
    /// A candidate that matches, by its index in the family, and its weight.
    struct Matching {
        std::uint32_t candidate = 0;
        float weight = 0.0F;
    };
    std::vector<Matching> matching_; // used by choose_among()
};

} // namespace lsys
