// SPDX-License-Identifier: MIT
// Two productions that are meant to put branches on opposite sides by `/` and `\`. These modules
// roll, so both branches point the same way. With the turtle of Crankshaw's thesis `/` and `\`
// pitch, as in its equation 2.11.
#include "compiler/lint/impl/lints.h"
#include "compiler/program/message_words.h"
#include "compiler/resolve/profiles.h"
#include "grammar/base/cancellation.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

namespace {

bool is_roll(TurtleOperation operation) {
    return operation == TurtleOperation::RollLeft || operation == TurtleOperation::RollRight;
}

/// Whether the operation leaves the heading unchanged.
bool keeps_heading(TurtleOperation operation) {
    return operation == TurtleOperation::Nothing || draws(operation) ||
           info(operation).has(TurtleInfo::PreparesDrawing);
}

class RolledSides {
public:
    RolledSides(const CheckInput& input, Diagnostics& diagnostics)
        : input_(input), program_(input.program), diagnostics_(diagnostics),
          is_rewritten_(input.program.symbols.size(), 0) {}

    /// Compares each production with the previous one of the same module. Reports the first pair
    /// with rolled sides.
    void check() {
        for (const Production& production : program_.productions) {
            for (const ProgramPatternItem& item : production.predecessor.items) {
                is_rewritten_[static_cast<std::size_t>(item.symbol)] = 1;
            }
        }
        std::vector<const Production*> last_of(program_.symbols.size(), nullptr);
        for (const Production& production : program_.productions) {
            if (!is_alone(production)) {
                continue;
            }
            const SymbolId symbol = production.predecessor.items[0].symbol;
            const Production*& last = last_of[static_cast<std::size_t>(symbol)];
            if (last != nullptr && check(*last, production)) {
                return;
            }
            last = &production;
        }
    }

private:
    [[nodiscard]] const Symbol& symbol_at(std::size_t module) const {
        return program_.symbol(program_.modules[module].symbol);
    }

    /// Whether the production replaces a single module, without contexts.
    [[nodiscard]] static bool is_alone(const Production& production) {
        return production.stage == Stage::Rewrite && !production.has_left &&
               !production.has_right && production.predecessor.items.size() == 1;
    }

    /// Whether a `]` follows each module with the symbol. Reads all words once.
    [[nodiscard]] bool ends_branches(SymbolId symbol) {
        if (ends_branch_.empty()) {
            ends_branch_.assign(program_.symbols.size(), 1);
            for (const Axiom& axiom : program_.axioms) {
                mark_modules_without_close(axiom.word);
            }
            for (const Production& production : program_.productions) {
                mark_modules_without_close(production.successor);
            }
        }
        return ends_branch_[static_cast<std::size_t>(symbol)] != 0;
    }

    /// Clears `ends_branch_` of each symbol that stands in `word` without a `]` behind it.
    void mark_modules_without_close(const ProgramWord& word) {
        std::optional<SymbolId> previous;
        const auto clear_previous = [&] {
            if (previous) {
                ends_branch_[static_cast<std::size_t>(*previous)] = 0;
            }
        };
        for_each_symbol(program_, word, [&](std::size_t, SymbolId symbol) {
            if (program_.symbol(symbol).kind != SymbolKind::BranchClose) {
                clear_previous();
            }
            previous = symbol;
        });
        clear_previous();
    }

    /// Reports two productions that differ only by rolls in opposite directions, if something is
    /// drawn after the rolls and nothing changes the heading until the branch ends. Returns whether
    /// it reported them.
    bool check(const Production& one, const Production& other) {
        const std::size_t count = one.successor.module_count;
        if (other.successor.module_count != count) {
            return false;
        }
        const Symbol* roll = nullptr;
        bool found_drawing = false;
        constexpr std::size_t kModulesPerLook = std::size_t{1} << 14U; // per cancellation check
        for (std::size_t i = 0; i < count; ++i) {
            if (i % kModulesPerLook == 0) {
                stop_if_cancelled();
            }
            const Symbol& a = symbol_at(one.successor.first_module + i);
            const Symbol& b = symbol_at(other.successor.first_module + i);
            if (is_roll(a.turtle) && is_roll(b.turtle)) {
                roll = roll == nullptr && a.turtle != b.turtle ? &a : roll;
                continue;
            }
            if (a.name != b.name || a.turtle != b.turtle) {
                return false;
            }
            const SymbolId symbol = program_.modules[one.successor.first_module + i].symbol;
            if (roll != nullptr && (!keeps_heading(a.turtle) ||
                                    is_rewritten_[static_cast<std::size_t>(symbol)] != 0)) {
                return false;
            }
            found_drawing = found_drawing || (roll != nullptr && draws(a.turtle));
        }
        if (roll == nullptr || !found_drawing || !pitches_in_thesis(*roll) ||
            !ends_branches(one.predecessor.items[0].symbol)) {
            return false;
        }
        Diagnostic& note = diagnostics_.add(
            DiagnosticCode::RolledSides, one.predecessor.span,
            fmt::format(
                "{} draws in the same direction in both productions: `/` and `\\` only roll",
                quoted(input_.name(one.predecessor.items[0].symbol))));
        note.labels.push_back({other.predecessor.span, "the same direction"});
        note.help.push_back(
            "`#set turtle thesis;` gives two directions: there `/` and `\\` pitch, as "
            "in tables 2.1, 3.1 and 5.1 of Crankshaw's thesis");
        return true;
    }

    [[nodiscard]] bool pitches_in_thesis(const Symbol& roll) const {
        const TurtleCommand* command =
            find_turtle_command(TurtleProfile::Thesis, input_.name(roll.name));
        return command != nullptr && (command->operation == TurtleOperation::PitchUp ||
                                      command->operation == TurtleOperation::PitchDown);
    }

    const CheckInput& input_;
    const Program& program_;
    Diagnostics& diagnostics_;
    std::vector<std::uint8_t> is_rewritten_; // by symbol: it has a production
    std::vector<std::uint8_t> ends_branch_;  // by symbol, see ends_branches(); empty: not read yet
};

} // namespace

void check_rolled_sides(const CheckInput& input, Diagnostics& diagnostics) {
    // An author who has chosen another turtle profile intends its rolls.
    if (input.program.settings.turtle == Settings{}.turtle) {
        RolledSides(input, diagnostics).check();
    }
}

} // namespace lsys
