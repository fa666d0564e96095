// SPDX-License-Identifier: MIT
// Productions that are never used because earlier ones match first, and duplicate conditions.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"
#include "compiler/lint/impl/rule_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace lsys {

namespace {

constexpr std::size_t kMaxComparedProductions =
    1'000; // productions of a module; more are not compared

class PrecedenceCheck {
public:
    PrecedenceCheck(const CheckInput& input, Diagnostics& diagnostics)
        : input_(input), bytecode_(*input.bytecode), index_(bytecode_), diagnostics_(diagnostics) {}

    void run() {
        for (std::uint32_t s = 0; s < bytecode_.symbols.size(); ++s) {
            const std::span<const std::uint32_t> productions = index_.productions_of(SymbolId{s});
            if (productions.size() >= 2) {
                reported_.clear();
                check_equal_conditions(productions);
                check_unconditional(productions);
                check_covered(SymbolId{s}, productions);
            }
        }
        // Rules with several predecessor modules have no condition grid, so check_covered() does
        // not apply.
        std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> sequences;
        for (std::uint32_t p = 0; p < bytecode_.productions.size(); ++p) {
            if (bytecode_.productions[p].predecessor.count > 1) {
                sequences[bytecode_.productions[p].rule].push_back(p);
            }
        }
        for (std::uint32_t rule = 0; rule < bytecode_.rule_count && !sequences.empty(); ++rule) {
            if (const auto found = sequences.find(rule); found != sequences.end()) {
                reported_.clear();
                check_equal_conditions(found->second);
                check_unconditional(found->second);
            }
        }
    }

private:
    const BytecodeProduction& code(std::uint32_t p) const { return bytecode_.productions[p]; }
    const Production& production(std::uint32_t p) const { return input_.program.productions[p]; }
    bool is_context_free(std::uint32_t p) const { return !code(p).has_left && !code(p).has_right; }
    bool is_reported(std::uint32_t p) const { return reported_.contains(p); }

    /// The group and the instructions of a condition as text: conditions with equal keys are equal.
    std::string key(std::uint32_t p) const {
        std::string text = std::to_string(code(p).group) + ":";
        for (const Instruction each : InstructionRange(bytecode_.instructions, code(p).condition)) {
            text += fmt::format("{},{},{},", static_cast<unsigned>(each.opcode), each.operand,
                                std::bit_cast<std::uint32_t>(each.literal));
        }
        return text;
    }

    void check_equal_conditions(std::span<const std::uint32_t> productions) {
        std::unordered_map<std::string, std::uint32_t>
            first_of_key; // index of the production, by key()
        for (const std::uint32_t p : productions) {
            if (code(p).condition == kNone || code(p).stochastic ||
                is_meant_as_probability(input_, production(p))) {
                continue;
            }
            const auto [place, is_new] = first_of_key.emplace(key(p), p);
            const Production& earlier = production(place->second);
            // Conditions with different constants may be equal only until a user changes a
            // constant.
            const bool may_change =
                (names_constant(input_, production(p)) || names_constant(input_, earlier)) &&
                input_.sources.text(production(p).condition_span) !=
                    input_.sources.text(earlier.condition_span);
            if (is_new || may_change) {
                continue;
            }
            Diagnostic& diagnostic =
                diagnostics_.add(DiagnosticCode::DuplicateCondition, production(p).condition_span,
                                 fmt::format("{} has the condition of {}, which always precedes it",
                                             quoted(input_.name(production(p).name)),
                                             quoted(input_.name(earlier.name))));
            diagnostic.labels.push_back({earlier.condition_span, "the first in the file is taken"});
            diagnostic.help.emplace_back(
                "change one of the conditions, or give both a probability with `~`");
            reported_.insert(p);
        }
    }

    /// Reports productions that are never used, because an earlier production without condition
    /// matches wherever they match.
    void check_unconditional(std::span<const std::uint32_t> productions) {
        std::uint32_t unconditional = kNone; // the first production without condition and context
        std::unordered_map<std::uint32_t, std::uint32_t>
            first_unconditional; // by group: the first production without condition
        std::unordered_map<std::uint32_t, std::uint32_t>
            first_stochastic; // by group: the first stochastic production
        for (const std::uint32_t p : productions) {
            const std::uint32_t group = code(p).group;
            if (code(p).stochastic) {
                first_stochastic.emplace(group, p);
            }
            // A stochastic production may be chosen as soon as the first stochastic production of
            // its group is tried.
            const std::uint32_t from = code(p).stochastic ? first_stochastic.at(group) : p;
            const auto in_group = first_unconditional.find(group);
            std::uint32_t earlier =
                unconditional != kNone && unconditional < from ? unconditional : kNone;
            if (in_group != first_unconditional.end() && in_group->second < from) {
                earlier = std::min(earlier, in_group->second);
            }
            if (earlier != kNone && !same_choice(earlier, p)) {
                report(p, earlier);
            }
            if (code(p).condition == kNone) {
                first_unconditional.emplace(group, p);
                if (is_context_free(p) && unconditional == kNone) {
                    unconditional = p;
                }
            }
        }
    }

    /// Whether productions `a` and `b` are alternatives of one random choice.
    bool same_choice(std::uint32_t a, std::uint32_t b) const {
        return code(a).stochastic && code(b).stochastic && code(a).group == code(b).group;
    }

    /// Reports productions whose condition holds only where earlier conditions hold.
    void check_covered(SymbolId symbol, std::span<const std::uint32_t> productions) {
        const bool plain = std::all_of(productions.begin(), productions.end(),
                                       [&](std::uint32_t p) { return is_context_free(p); });
        if (!plain || productions.size() > kMaxComparedProductions) {
            return;
        }
        const std::optional<RuleTable> table =
            make_rule_table(bytecode_, index_, symbol, {productions.begin(), productions.end()});
        if (!table) {
            return;
        }
        std::vector<bool> adjustable; // by row: the condition names a constant, which may change
        for (const std::uint32_t p : productions) {
            adjustable.push_back(code(p).condition != kNone &&
                                 names_constant(input_, production(p)));
        }
        for (std::size_t row = 1; row < productions.size(); ++row) {
            const std::uint32_t p = productions[row];
            bool holds_somewhere = false; // the condition holds at some point
            bool usable = false;          // holds at a point where no earlier condition does
            std::vector<std::uint32_t> covering;
            for (std::uint64_t point = 0; point < table->points && !usable; ++point) {
                if (!table->holds(row, point)) {
                    continue;
                }
                holds_somewhere = true;
                std::size_t first = 0;
                while (!table->holds(first, point)) {
                    ++first;
                }
                usable = first == row || adjustable[first] || same_choice(productions[first], p);
                if (std::find(covering.begin(), covering.end(), productions[first]) ==
                    covering.end()) {
                    covering.push_back(productions[first]);
                }
            }
            const bool is_probability = is_meant_as_probability(input_, production(p));
            if (holds_somewhere && !usable && !adjustable[row] && !is_reported(p) &&
                !is_probability) {
                report_covered(p, covering);
            }
        }
    }

    void report(std::uint32_t p, std::uint32_t earlier) {
        if (is_reported(p)) {
            return;
        }
        reported_.insert(p);
        const Production& late = production(p);
        const Production& early = production(earlier);
        const bool mixed = late.stochastic != early.stochastic; // only one has a probability
        Diagnostic& diagnostic = diagnostics_.add(
            mixed ? DiagnosticCode::MixedProbability : DiagnosticCode::UnreachableProduction,
            mixed && late.stochastic ? late.weight_span : late.name_span,
            fmt::format("{} is never used: {} always matches first", quoted(input_.name(late.name)),
                        quoted(input_.name(early.name))));
        diagnostic.labels.push_back({early.name_span, "has no condition"});
        if (mixed) {
            diagnostic.notes.emplace_back(
                "a choice is made only among productions that have a probability");
            diagnostic.help.push_back(
                fmt::format("give {} a probability with `~`, or a condition",
                            quoted(input_.name(late.stochastic ? early.name : late.name))));
        } else if (early.stochastic) {
            diagnostic.help.emplace_back("productions are tried in the order of the file");
        } else if (late.condition == kNoValue) {
            diagnostic.help.emplace_back("remove one of them, or let chance choose between both");
            offer_probabilities(early, late, diagnostic);
        } else {
            diagnostic.help.push_back(
                fmt::format("productions are tried in the order of the file: move {} above {}",
                            quoted(input_.name(late.name)), quoted(input_.name(early.name))));
        }
    }

    /// Offers a fix that makes two productions with the condition `*` stochastic alternatives.
    void offer_probabilities(const Production& early,
                             const Production& late,
                             Diagnostic& diagnostic) const {
        if (early.condition != kNoValue || early.span.file != late.span.file ||
            input_.sources.text(early.condition_span) != "*" ||
            input_.sources.text(late.condition_span) != "*") {
            return;
        }
        diagnostic.fixes.push_back(
            {"with a probability after `~`",
             {{early.condition_span, "* ~ 0.5"}, {late.condition_span, "* ~ 0.5"}},
             false});
    }

    void report_covered(std::uint32_t p, const std::vector<std::uint32_t>& covering) {
        constexpr std::size_t kMaxShown = 4;
        reported_.insert(p);
        Diagnostic& diagnostic = diagnostics_.add(
            DiagnosticCode::UnreachableProduction, production(p).name_span,
            fmt::format("{} is never used: earlier conditions hold wherever its own does",
                        quoted(input_.name(production(p).name))));
        for (std::size_t i = 0; i < std::min(covering.size(), kMaxShown); ++i) {
            diagnostic.labels.push_back({production(covering[i]).condition_span, "holds first"});
        }
        diagnostic.help.emplace_back(
            "productions are tried in the order of the file: move the more special one up");
    }

    const CheckInput& input_;
    const Bytecode& bytecode_;
    analysis::ProductionIndex index_;
    Diagnostics& diagnostics_;
    std::unordered_set<std::uint32_t> reported_; // productions of the current rule
};

} // namespace

void check_reachable_productions(const CheckInput& input, Diagnostics& diagnostics) {
    if (input.bytecode != nullptr) {
        PrecedenceCheck(input, diagnostics).run();
    }
}

} // namespace lsys
