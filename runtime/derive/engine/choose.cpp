// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/choose.h"

#include <cmath>

namespace lsys {

template <typename C>
bool Chooser<C>::condition(const Candidate& candidate,
                           const ModulePlace& place,
                           const float* own,
                           bool& is_true) {
    switch (candidate.condition) {
    case ConditionKind::Always:
        is_true = true;
        return true;
    case ConditionKind::Never:
        is_true = false;
        return true;
    case ConditionKind::Comparisons:
        is_true = true;
        for (const Comparison& comparison : plan_.comparisons(candidate)) {
            is_true = is_true && holds(comparison, own);
        }
        return true;
    case ConditionKind::Expression:
        break;
    }
    float value = 0.0F;
    const std::uint32_t first = plan_.bytecode().productions[candidate.production].condition;
    if (!evaluate_for(candidate, first, place, value)) {
        return false;
    }
    is_true = value != 0.0F;
    return true;
}

template <typename C>
bool Chooser<C>::evaluate_for(const Candidate& candidate,
                              std::uint32_t first,
                              const ModulePlace& place,
                              float& value) {
    const PlanInputs& inputs = plan_.inputs();
    const EvalFrame frame{matcher_.formals(candidate, place), inputs.globals,
                          static_cast<float>(keys_.generation), inputs.steps};
    return evaluate(plan_.bytecode(), first, frame, nullptr, &value, fault_) ||
           set_faulty_candidate(candidate, false);
}

template <typename C>
bool Chooser<C>::set_faulty_candidate(const Candidate& candidate, bool in_weight) {
    faulty_candidate_ = static_cast<std::uint32_t>(&candidate - &plan_.candidate(0));
    fault_in_weight_ = in_weight;
    return false;
}

template <typename C>
bool Chooser<C>::weight(const Candidate& candidate,
                        const ModulePlace& place,
                        float& sum,
                        float& weight) {
    weight = candidate.weight;
    if (!candidate.computes_weight) {
        sum += weight;
        return true;
    }
    const std::uint32_t first = plan_.bytecode().productions[candidate.production].weight_code;
    if (!evaluate_for(candidate, first, place, weight)) {
        return set_faulty_candidate(candidate, true);
    }
    sum += weight;
    if (weight < 0.0F || !std::isfinite(sum)) {
        fault_ = {weight < 0.0F ? Fault::NegativeWeight : Fault::WeightsTooLarge, first, weight,
                  0.0F, 0.0F};
        return set_faulty_candidate(candidate, true);
    }
    return true;
}

template <typename C>
bool Chooser<C>::choose(const ModulePlace& place, const Row& row, std::uint32_t& record) {
    record = 0;
    if (row.kind == RowKind::Choice) {
        record = choose_by_chance(module_draw(place.index), row);
        return true;
    }
    if (row.kind == RowKind::Tests) {
        record = choose_by_test(word_.parameters + place.parameter, row);
        return true;
    }
    const Bytecode& bytecode = plan_.bytecode();
    const Family& family = plan_.family(row.source);
    const std::span<const Candidate> candidates = plan_.candidates(family);
    const float* const own = matcher_.own_parameters(place);
    std::uint32_t group = kNone; // the last group whose contexts were searched
    bool in_context = true;
    for (std::uint32_t i = 0; i < candidates.size(); ++i) {
        const Candidate& candidate = candidates[i];
        if (candidate.modules > 1 && !matcher_.matches_predecessor(
                                         bytecode.productions[candidate.production], place.index)) {
            continue;
        }
        if (candidate.has_context) {
            if (candidate.group != group) {
                group = candidate.group;
                in_context = matcher_.matches_contexts(bytecode.productions[candidate.production],
                                                       place.index);
            }
            if (!in_context) {
                continue;
            }
        }
        bool is_true = false;
        if (!condition(candidate, place, own, is_true)) {
            return false;
        }
        if (is_true) {
            record = i + 1;
            return !candidate.stochastic || choose_among(family, i, place, record);
        }
    }
    return true;
}

template <typename C>
bool Chooser<C>::choose_among(const Family& family,
                              std::uint32_t first,
                              const ModulePlace& place,
                              std::uint32_t& record) {
    const std::span<const Candidate> candidates = plan_.candidates(family);
    const std::uint32_t group = candidates[first].group;
    const float* const own = matcher_.own_parameters(place);
    matching_.assign(1, {first, 0.0F});
    for (std::uint32_t i = first + 1; i < candidates.size(); ++i) {
        const Candidate& candidate = candidates[i];
        if (candidate.group != group || !candidate.stochastic) {
            continue;
        }
        bool is_true = false;
        if (!condition(candidate, place, own, is_true)) {
            return false;
        }
        if (is_true) {
            matching_.push_back({i, 0.0F});
        }
    }
    float sum = 0.0F;
    for (Matching& each : matching_) {
        if (!weight(candidates[each.candidate], place, sum, each.weight)) {
            return false;
        }
    }
    std::erase_if(matching_, [](const Matching& each) { return each.weight == 0.0F; });
    record = matching_.empty() ? 0 : matching_.front().candidate + 1;
    if (matching_.size() <= 1) {
        return true; // without a weight above 0 the module counts as not matched
    }
    const Bytecode& bytecode = plan_.bytecode();
    const std::uint32_t rule = bytecode.productions[candidates[first].production].rule;
    const float u = bytecode.settings.choice == ChoiceScope::Generation
                        ? plan_.rule_draw(rule, keys_.generation)
                        : module_draw(place.index);
    float cumulative = 0.0F;
    for (const Matching& each : matching_) {
        record = each.candidate + 1;
        cumulative += each.weight / sum;
        if (cumulative > u) {
            break;
        }
    }
    return true;
}

template class Chooser<std::uint8_t>;
template class Chooser<std::uint16_t>;
template class Chooser<std::uint32_t>;

} // namespace lsys
