// SPDX-License-Identifier: MIT
// `==` and `!=` on values that may differ by rounding. Each value has a Level. Exact: computed from
// multiples of a small power of 1/2 by + - * and similar operations. Literal: a constant that is
// only passed on, so it equals itself. Computed: everything else.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"
#include "grammar/base/characters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

/// How a value arises: exact in binary32, a rounded literal, a result that may be rounded.
enum class Level : std::uint8_t { Exact, Literal, Computed };

constexpr int kMaxRounds = 16; // max number of calls of propagate()

class EqualityCheck {
public:
    EqualityCheck(const CheckInput& input, Diagnostics& diagnostics)
        : input_(input), program_(input.program), diagnostics_(diagnostics),
          levels_(program_.values.size(), Level::Exact), source_(program_.values.size(), kNone) {}

    void run() {
        if (!any_equality()) {
            return;
        }
        std::uint32_t parameters = 0;
        for (const Symbol& symbol : program_.symbols) {
            base_.push_back(parameters);
            parameters += symbol.parameter_count;
        }
        parameter_levels_.assign(parameters, Level::Exact);
        for (const Production& production : program_.productions) {
            trace(production);
        }
        for (int round = 0; round < kMaxRounds && propagate(); ++round) {
        }
        for (const Production& production : program_.productions) {
            if (production.condition != kNoValue) {
                check(production);
            }
        }
    }

private:
    bool any_equality() const {
        for (std::size_t i = 0; i < program_.values.size(); ++i) {
            const Opcode opcode = program_.values[i].opcode;
            if (opcode == Opcode::Equal || opcode == Opcode::NotEqual) {
                return true;
            }
        }
        return false;
    }

    /// Sets source_ for the formals and slots that the expressions of a production read.
    void trace(const Production& production) {
        std::vector<std::uint32_t> parameter(production.formals.size(), kNone);
        for (const ProgramPattern* pattern :
             {&production.left, &production.predecessor, &production.right}) {
            for (const ProgramPatternItem& item : pattern->items) {
                if (item.kind == PatternKind::Module) {
                    const auto s = static_cast<std::size_t>(item.symbol);
                    for (std::uint32_t i = 0; i < program_.symbols[s].parameter_count; ++i) {
                        parameter[item.first_formal + i] = base_[s] + i;
                    }
                }
            }
        }
        std::vector<ValueId> slots;
        for (const LocalValue& local : production.locals) {
            slots.push_back(local.value);
        }
        const auto for_each = [&](auto&& visit) {
            for_each_value(program_, expressions_of(program_, production), visit);
        };
        for_each([&](ValueId, const Value& value) {
            if (value.opcode == Opcode::SetLocal) {
                slots.resize(std::max<std::size_t>(slots.size(), value.index + 1U), kNoValue);
                slots[value.index] = value.left;
            }
        });
        for_each([&](ValueId id, const Value& value) {
            if (value.opcode == Opcode::Formal && value.index < parameter.size()) {
                source_[static_cast<std::size_t>(id)] = parameter[value.index];
            } else if (value.opcode == Opcode::Local && value.index < slots.size()) {
                source_[static_cast<std::size_t>(id)] =
                    static_cast<std::uint32_t>(slots[value.index]);
            }
        });
    }

    /// Calls visit(argument, parameter) for each argument of a word.
    template <typename Visit>
    void for_each_argument(const ProgramWord& word, Visit&& visit) const {
        for_each_module(
            program_, word, [&](std::size_t, std::size_t argument, const ProgramModule& module) {
                const auto s = static_cast<std::size_t>(module.symbol);
                for (std::uint32_t i = 0; i < program_.symbols[s].parameter_count; ++i) {
                    visit(program_.arguments[argument + i], base_[s] + i);
                }
            });
    }

    Level level(ValueId id) const {
        return id == kNoValue ? Level::Exact : levels_[static_cast<std::size_t>(id)];
    }

    /// The level of value `i` by those of its operands; level() has the levels found so far.
    Level level_of(std::size_t i) const {
        const Value& value = program_.values[i];
        const Level left = level(value.left);
        const Level right = level(value.right);
        switch (value.opcode) {
        case Opcode::Literal: {
            // Sums of multiples of 1/64 are exact, so long as they are not large.
            constexpr float kGrain = 64.0F;
            constexpr float kMaxExact = 65'536.0F;
            const bool exact = std::fabs(value.literal) <= kMaxExact &&
                               std::floor(value.literal * kGrain) == value.literal * kGrain;
            return exact ? Level::Exact : Level::Literal;
        }
        case Opcode::Formal:
            return source_[i] == kNone ? Level::Exact : parameter_levels_[source_[i]];
        case Opcode::Local:
            return source_[i] == kNone ? Level::Computed : level(ValueId{source_[i]});
        case Opcode::Step:
        case Opcode::Steps:
        case Opcode::Floor:
        case Opcode::Ceil:
        case Opcode::Round:
        case Opcode::Sign:
        case Opcode::Not:
        case Opcode::Less:
        case Opcode::LessEqual:
        case Opcode::Greater:
        case Opcode::GreaterEqual:
        case Opcode::Equal:
        case Opcode::NotEqual:
        case Opcode::And:
        case Opcode::Or:
            return Level::Exact;
        case Opcode::Negate:
        case Opcode::Abs:
        case Opcode::Min:
        case Opcode::Max:
            return std::max(left, right);
        case Opcode::Add:
        case Opcode::Subtract:
        case Opcode::Multiply:
        case Opcode::Mod:
            return left == Level::Exact && right == Level::Exact ? Level::Exact : Level::Computed;
        case Opcode::Divide: {
            const Value& divisor = program_.value(value.right);
            int exponent = 0;
            const bool halves = divisor.opcode == Opcode::Literal &&
                                std::fabs(std::frexp(divisor.literal, &exponent)) == 0.5F;
            return halves && left == Level::Exact ? Level::Exact : Level::Computed;
        }
        case Opcode::If:
        case Opcode::SetLocal:
            return value.opcode == Opcode::If ? std::max(left, right) : right;
        default:
            return Level::Computed;
        }
    }

    /// Updates the levels of all values and parameters once. Returns whether a level changed.
    bool propagate() {
        for (std::size_t i = 0; i < program_.values.size(); ++i) {
            levels_[i] = level_of(i);
        }
        bool changed = false;
        const auto pass = [&](ValueId argument, std::uint32_t parameter) {
            const Level next = std::max(parameter_levels_[parameter], level(argument));
            changed = changed || next != parameter_levels_[parameter];
            parameter_levels_[parameter] = next;
        };
        for (const Axiom& axiom : program_.axioms) {
            for_each_argument(axiom.word, pass);
        }
        for (const Production& production : program_.productions) {
            for_each_argument(production.successor, pass);
        }
        return changed;
    }

    void check(const Production& production) {
        std::vector<ValueId> work{production.condition};
        while (!work.empty()) {
            const ValueId id = work.back();
            work.pop_back();
            const Value& value = program_.value(id);
            const bool equality = value.opcode == Opcode::Equal || value.opcode == Opcode::NotEqual;
            if (equality &&
                (level(value.left) == Level::Computed || level(value.right) == Level::Computed)) {
                report(value);
                continue;
            }
            for (const ValueId child : value.operands()) {
                if (child != kNoValue) {
                    work.push_back(child);
                }
            }
        }
    }

    void report(const Value& value) {
        const std::string_view text = input_.sources.text(value.span);
        const char* sign = value.opcode == Opcode::Equal ? "==" : "!=";
        Diagnostic& diagnostic = diagnostics_.add(
            DiagnosticCode::ComputedEquality, value.span,
            fmt::format("`{}` compares a computed value, which rounding may keep from being equal",
                        sign));
        const std::size_t at = text.find(sign);
        if (at == std::string_view::npos || text.find(sign, at + 2) != std::string_view::npos) {
            return;
        }
        const std::uint32_t place = value.span.begin + static_cast<std::uint32_t>(at);
        diagnostic.span = {value.span.file, place, place + 2};
        const auto trim = [](std::string_view side) {
            const std::size_t first = side.find_first_not_of(kWhitespace);
            const std::size_t last = side.find_last_not_of(kWhitespace);
            return first == std::string_view::npos ? std::string_view()
                                                   : side.substr(first, last - first + 1);
        };
        diagnostic.help.push_back(fmt::format(
            "allow for a small difference: `abs({} - {}) {} 0.001`", trim(text.substr(0, at)),
            trim(text.substr(at + 2)), value.opcode == Opcode::Equal ? "<" : ">="));
    }

    const CheckInput& input_;
    const Program& program_;
    Diagnostics& diagnostics_;
    std::vector<Level> levels_; // per value
    /// Per value: for a Formal its module parameter, for a Local the value in its slot, else kNone.
    std::vector<std::uint32_t> source_;
    std::vector<std::uint32_t> base_; // per symbol: first index in parameter_levels_
    std::vector<Level> parameter_levels_;
};

} // namespace

void check_computed_equality(const CheckInput& input, Diagnostics& diagnostics) {
    EqualityCheck(input, diagnostics).run();
}

} // namespace lsys
