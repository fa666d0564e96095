// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/sweep_visitor.h"

#include "runtime/base/random.h"

#include <algorithm>

namespace lsys {

SweepVisitor::SweepVisitor(const Plan& plan, const SweepProgram& program, const PassKeys& keys)
    : plan_(plan), program_(program), keys_(keys), folded_(plan.bytecode().constants.data()),
      candidates_(program.candidates()), operations_(program.operations()),
      machine_(plan.bytecode()), neighbours_(program.reach()),
      units_(program.draw_blocks().size() * kWordsPerBlock * kSweepLanes) {
    program.prepare(machine_);
}

void SweepVisitor::draw(const std::uint64_t* positions, std::size_t count) {
    lane_ = 0;
    DrawKey key{keys_.seed, keys_.generation, 0, 0};
    float* units = units_.data();
    for (const std::uint32_t block : program_.draw_blocks()) {
        key.block = block;
        draw_all_units(key, positions, count, units, kSweepLanes);
        units += kWordsPerBlock * kSweepLanes;
    }
}

std::uint32_t SweepVisitor::outcome(const SweepCandidate& candidate) const {
    const SweepOutcome* const first = program_.outcomes() + candidate.outcomes.first;
    std::uint32_t taken = 0;
    if (candidate.outcomes.count > 1) {
        const float u = choice_draw(candidate.rule);
        for (std::uint32_t i = 0; i + 1 < candidate.outcomes.count; ++i) {
            taken += first[i].threshold > u ? 0U : 1U; // thresholds ascend
        }
    }
    return first[taken].candidate;
}

float SweepVisitor::choice_draw(std::uint32_t rule) const {
    return plan_.bytecode().settings.choice == ChoiceScope::Generation
               ? plan_.rule_draw(rule, keys_.generation)
               : machine_.value(program_.choice_draw());
}

bool SweepVisitor::write_several(std::uint32_t count, float* own) const {
    const float* const values = machine_.values();
    const bool is_finite =
        std::all_of(values, values + count, [](float value) { return std::isfinite(value); });
    std::copy_n(values, is_finite ? count : 0, own);
    return is_finite;
}

// Adds in the order of Chooser::choose_among(), because the order decides the rounding.
bool SweepVisitor::choose_among(const SweepCandidate*& chosen, const SweepCandidate* end) {
    matching_.clear();
    for (const SweepCandidate* each = chosen; each != end; ++each) {
        bool holds = each->group == chosen->group && each->is_stochastic;
        if (holds && each != chosen && !condition(*each, holds)) {
            return false;
        }
        if (holds) {
            matching_.push_back({each, each->weight});
        }
    }
    float sum = 0.0F;
    for (Matching& each : matching_) {
        if (each.candidate->weight_code != kNone) {
            each.weight = machine_.run(operations_ + each.candidate->weight_code);
        }
        sum += each.weight;
        if (!std::isfinite(sum) || each.weight < 0.0F) {
            return false;
        }
    }
    std::erase_if(matching_, [](const Matching& each) { return each.weight == 0.0F; });
    chosen = matching_.empty() ? nullptr : matching_.front().candidate;
    if (matching_.size() <= 1) {
        return true; // without a weight above 0 the module counts as not matched
    }
    const float u = choice_draw(chosen->rule);
    float cumulative = 0.0F;
    for (const Matching& each : matching_) {
        chosen = each.candidate;
        cumulative += each.weight / sum;
        if (cumulative > u) {
            break;
        }
    }
    return true;
}

} // namespace lsys
