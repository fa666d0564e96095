// SPDX-License-Identifier: MIT
#include "runtime/pipeline/growth_forecast.h"

#include "compiler/growth/growth.h"
#include "grammar/base/exponentials.h"
#include "runtime/base/saturating.h"
#include "runtime/derive/brackets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

/// Larger programs are not predicted: a prediction would take longer than many derivations.
constexpr std::size_t kMaxProductions = 10'000;

bool is_small(const Bytecode& bytecode) {
    return bytecode.productions.size() <= kMaxProductions;
}

std::uint64_t saturated(const Count& count) {
    constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
    return count.at_most(kMax) ? count.value.low : kMax;
}

/// Whether no generation would have more than `max_modules` even if the longest successor replaced
/// every module. Much faster than a prediction if the axiom is long.
bool cannot_exceed(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t max_modules) {
    if (bytecode.has(Stage::Decompose) ||
        bytecode.settings.rewriting == RewritingMode::Sequential) {
        return false; // several productions may rewrite a module within one generation
    }
    std::uint64_t modules = 0;
    for (const BytecodeAxiom& axiom : bytecode.axioms) {
        modules = std::max<std::uint64_t>(modules, axiom.word.codes.count);
    }
    std::uint64_t growth = 1;
    for (const BytecodeProduction& production : bytecode.productions) {
        growth = std::max<std::uint64_t>(growth, production.successor.codes.count);
    }
    if (modules != 0 && growth > 1) {
        for (std::uint32_t i = 0; i < generations && modules <= max_modules; ++i) {
            modules = saturating_multiply(modules, growth);
        }
    }
    constexpr std::uint64_t kSaturated = std::numeric_limits<std::uint64_t>::max();
    return modules <= max_modules && modules != kSaturated;
}

/// Whether a closing bracket of the template has no partner in it.
bool closes_too_much(const Bytecode& bytecode, TableRange codes) {
    return has_unmatched_close(bytecode, codes, SymbolKind::BranchClose) ||
           has_unmatched_close(bytecode, codes, SymbolKind::PolygonClose);
}

/// Whether no error is possible once the derivation has computed its random constants.
bool cannot_fail(const Bytecode& bytecode) {
    const auto is_plain = [](const BytecodeSymbol& symbol) { return symbol.parameter_count == 0; };
    const auto is_safe = [&](const BytecodeProduction& production) {
        return production.condition == kNone && production.weight_code == kNone &&
               !rewrites_bracket(bytecode, production) &&
               !closes_too_much(bytecode, production.successor.codes);
    };
    return !bytecode.has_senses() && // an environment may have no answer
           std::all_of(bytecode.symbols.begin(), bytecode.symbols.end(), is_plain) &&
           std::none_of(bytecode.axioms.begin(), bytecode.axioms.end(),
                        [&](const BytecodeAxiom& axiom) {
                            return closes_too_much(bytecode, axiom.word.codes);
                        }) &&
           std::all_of(bytecode.productions.begin(), bytecode.productions.end(), is_safe);
}

} // namespace

std::optional<LimitReport>
predict_limit(const Bytecode& bytecode, std::uint32_t generations, const Limits& limits) {
    if (!is_small(bytecode) || cannot_exceed(bytecode, generations, limits.max_modules)) {
        return std::nullopt;
    }
    const std::optional<GrowthLimit> found =
        find_growth_end(bytecode, generations, limits.max_modules).limit;
    if (!found || !found->exact || !found->at_largest.modules.at_most(limits.max_modules)) {
        return std::nullopt;
    }
    LimitReport report;
    report.kind = LimitKind::Modules;
    report.generation = found->largest_fitting;
    report.modules = saturated(found->at_largest.modules);
    report.predicted_modules = saturated(found->at_next.modules);
    report.predicted_bytes = saturated(found->at_next.bytes);
    if (found->dominant != kNoProduction) {
        report.production = static_cast<std::uint32_t>(found->dominant);
    }
    return report;
}

std::optional<std::vector<std::uint64_t>>
predict_counts(const Bytecode& bytecode, std::uint32_t generations, const Limits& limits) {
    if (!is_small(bytecode) || !cannot_fail(bytecode)) {
        return std::nullopt;
    }
    const GrowthPrediction growth = predict_growth(bytecode, generations);
    if (!growth.exact || growth.low.size() <= generations) {
        return std::nullopt;
    }
    std::vector<std::uint64_t> counts;
    for (const GenerationSize& size : growth.low) {
        if (!size.modules.at_most(limits.max_modules)) {
            return std::nullopt;
        }
        counts.push_back(size.modules.value.low);
    }
    return counts;
}

std::vector<double> predict_expected_modules(const Bytecode& bytecode, std::uint32_t generations) {
    if (!is_small(bytecode)) {
        return {};
    }
    const GrowthPrediction growth = predict_growth(bytecode, generations);
    if (growth.low.size() <= generations || (!growth.exact && !growth.has_expected)) {
        return {};
    }
    if (growth.has_expected) {
        return growth.expected_modules;
    }
    std::vector<double> modules;
    for (const GenerationSize& size : growth.low) {
        modules.push_back(power_of_two(size.modules.approximate_log2()));
    }
    return modules;
}

} // namespace lsys
