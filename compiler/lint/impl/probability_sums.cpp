// SPDX-License-Identifier: MIT
// The probabilities of stochastic alternatives without conditions sum to 1 (docs/language.md
// section 5). With conditions the sum depends on the matching alternatives, so weights are
// normalised at run time. With `weights any` all weights are normalised at run time, and their sum
// has to be finite.
#include "compiler/lint/checks.h"
#include "compiler/lint/impl/places.h"
#include "grammar/base/counted_text.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace lsys {

namespace {

/// Tolerance of sums: 0.33 + 0.33 + 0.33 is accepted.
constexpr double kTolerance = 0.011 + 1e-6;
constexpr std::size_t kMaxLabels = 8; // of one message; a note counts the other places
constexpr const char* kUseWeights =
    "change the numbers, or let them be weights that are normalised: `#set weights any;`";

struct Group {
    double sum = 0.0;
    bool has_fixed_sum = true;          // no member has a condition or a weight in error
    std::vector<std::uint32_t> members; // indices of productions
};

void report(const CheckInput& input, const Group& group, Diagnostics& diagnostics) {
    const std::vector<Production>& productions = input.program.productions;
    // The message is at the probability that makes the sum exceed 1, else at the last probability.
    std::uint32_t culprit = group.members.back();
    double running = 0.0;
    for (const std::uint32_t member : group.members) {
        running += static_cast<double>(productions[member].weight);
        if (running > 1.0 + kTolerance) {
            culprit = member;
            break;
        }
    }
    const auto normalised = [&](std::uint32_t member) {
        return fmt::format("{:.4g}", static_cast<double>(productions[member].weight) / group.sum);
    };
    const SymbolId symbol = productions[culprit].predecessor.items.front().symbol;
    Diagnostic& error =
        diagnostics.add(DiagnosticCode::ProbabilitySum, productions[culprit].weight_span,
                        fmt::format("the probabilities of {} sum to {:.6g}, not to 1",
                                    quoted(input.name(symbol)), group.sum));
    error.label = fmt::format("normalised, this would be {}", normalised(culprit));
    std::size_t hidden_count = 0;
    for (const std::uint32_t member : group.members) {
        if (member != culprit && error.labels.size() == kMaxLabels) {
            ++hidden_count;
        } else if (member != culprit) {
            error.labels.push_back({productions[member].weight_span,
                                    fmt::format("normalised, {}", normalised(member))});
        }
    }
    if (hidden_count != 0) {
        error.notes.push_back("and " + counted(hidden_count, "more place"));
    }
    error.help.emplace_back(kUseWeights);
}

/// Reports weights whose sum overflows. `whose` names their module or "the axioms" in the message.
void report_overflow(SourceSpan span, const std::string& whose, Diagnostics& diagnostics) {
    Diagnostic& error = diagnostics.add(
        DiagnosticCode::BadProbability, span,
        fmt::format("the weights of {} are too large: their sum overflows binary32", whose));
    error.help.emplace_back("only the ratios of weights matter: make all smaller");
}

bool overflows(double sum) {
    return sum > static_cast<double>(std::numeric_limits<float>::max());
}

/// Checks the probabilities of several axioms.
void check_axioms(const CheckInput& input, Diagnostics& diagnostics) {
    const std::vector<Axiom>& axioms = input.program.axioms;
    if (axioms.empty() || !axioms.front().has_weight) {
        return;
    }
    double sum = 0.0;
    for (const Axiom& axiom : axioms) {
        sum += static_cast<double>(axiom.weight);
    }
    const SourceSpan last = axioms.back().weight_span;
    if (input.program.settings.weights == WeightRule::Any) {
        if (overflows(sum)) {
            report_overflow(last, "the axioms", diagnostics);
        }
    } else if (std::fabs(sum - 1.0) > kTolerance) { // false for NaN, a weight in error
        Diagnostic& error = diagnostics.add(
            DiagnosticCode::ProbabilitySum, last,
            fmt::format("the probabilities of the axioms sum to {:.6g}, not to 1", sum));
        error.help.emplace_back(kUseWeights);
    }
}

} // namespace

void check_probability_sums(const CheckInput& input, Diagnostics& diagnostics) {
    const Program& program = input.program;
    if (!program.has_all_statements) {
        return;
    }
    check_axioms(input, diagnostics);
    std::vector<Group> groups(program.context_group_count);
    for (std::uint32_t i = 0; i < program.productions.size(); ++i) {
        const Production& production = program.productions[i];
        if (production.stochastic) {
            Group& group = groups[production.group];
            group.sum += static_cast<double>(production.weight);
            group.has_fixed_sum = group.has_fixed_sum && production.condition == kNoValue &&
                                  !std::isnan(production.weight);
            group.members.push_back(i);
        }
    }
    for (const Group& group : groups) {
        if (program.settings.weights == WeightRule::Any) {
            if (overflows(group.sum)) {
                const Production& last = program.productions[group.members.back()];
                report_overflow(last.weight_span,
                                quoted(input.name(last.predecessor.items.front().symbol)),
                                diagnostics);
            }
        } else if (!group.members.empty() && group.has_fixed_sum &&
                   std::fabs(group.sum - 1.0) > kTolerance) {
            report(input, group, diagnostics);
        }
    }
}

} // namespace lsys
