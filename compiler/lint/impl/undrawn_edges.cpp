// SPDX-License-Identifier: MIT
// Edge rewriting in which one of two edges is never drawn: Sierpinski's gasket written with `F` and
// `X`, where only `F` draws. Edges differ from growing tips of plants by their productions, which
// are mirror images of each other and have no brackets.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/reachable.h"
#include "compiler/program/message_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace lsys {

namespace {

/// A module of a successor: an edge or a turn.
struct Step {
    bool is_edge = false;
    bool is_own = false; // an edge with the name of the predecessor
    TurtleOperation turn = TurtleOperation::Nothing;

    friend bool operator==(const Step&, const Step&) = default;
};

TurtleOperation opposite(TurtleOperation turn) {
    using enum TurtleOperation;
    switch (turn) {
    case YawLeft:
        return YawRight;
    case YawRight:
        return YawLeft;
    case PitchUp:
        return PitchDown;
    case PitchDown:
        return PitchUp;
    case RollLeft:
        return RollRight;
    case RollRight:
        return RollLeft;
    default:
        return turn;
    }
}

/// Whether some combination of exchanging the edges, reversing the turns and reading backwards
/// turns one successor into the other.
bool are_images(const std::vector<Step>& a, const std::vector<Step>& b) {
    for (std::uint32_t form = 0; form < 8; ++form) {
        std::vector<Step> image = a;
        if ((form & 1U) != 0) {
            std::reverse(image.begin(), image.end());
        }
        for (Step& step : image) {
            if (step.is_edge) {
                step.is_own = step.is_own == ((form & 2U) == 0);
            } else if ((form & 4U) != 0) {
                step.turn = opposite(step.turn);
            }
        }
        if (image == b) {
            return true;
        }
    }
    return false;
}

class UndrawnEdges {
public:
    UndrawnEdges(const CheckInput& input, Diagnostics& diagnostics)
        : input_(input), program_(input.program), diagnostics_(diagnostics),
          reachable_(find_reachable(input.program)),
          plain_production_(input.program.symbols.size(), kNone) {}

    void check() {
        find_productions();
        for (std::uint32_t s = 0; s < program_.symbols.size(); ++s) {
            const SymbolId edge{s};
            if (program_.symbol(edge).turtle == TurtleOperation::Nothing &&
                has_plain_production(edge) && reachable_.occurs(edge)) {
                check(edge);
            }
        }
    }

private:
    static constexpr std::uint32_t kNotPlain = kNone - 1;

    /// Sets plain_production_. A production is plain if it rewrites one module and has no contexts,
    /// conditions, probabilities or parameters.
    void find_productions() {
        for (std::uint32_t p = 0; p < program_.productions.size(); ++p) {
            const Production& production = program_.productions[p];
            const bool is_plain = production.stage == Stage::Rewrite && !production.has_left &&
                                  !production.has_right && !production.stochastic &&
                                  production.condition == kNoValue && production.formals.empty() &&
                                  production.predecessor.items.size() == 1;
            for (const ProgramPatternItem& item : production.predecessor.items) {
                std::uint32_t& known = plain_production_[static_cast<std::size_t>(item.symbol)];
                known = is_plain && known == kNone ? p : kNotPlain;
            }
        }
    }

    [[nodiscard]] bool has_plain_production(SymbolId symbol) const {
        return plain_production_[static_cast<std::size_t>(symbol)] < kNotPlain;
    }
    [[nodiscard]] const Production& production_of(SymbolId symbol) const {
        return program_.productions[plain_production_[static_cast<std::size_t>(symbol)]];
    }

    /// The successor of `edge` as steps; sets `other` to the only other edge. Empty if the
    /// successor has a third edge, a module with parameters, no other edge or no turn.
    [[nodiscard]] std::vector<Step> steps(SymbolId edge, SymbolId& other) const {
        std::vector<Step> path;
        bool fits = true;
        bool bends = false;
        for_each_symbol(program_, production_of(edge).successor, [&](std::size_t, SymbolId symbol) {
            const Symbol& row = program_.symbol(symbol);
            if (row.parameter_count != 0) {
                fits = false;
            } else if (turns(row.turtle)) {
                path.push_back({.turn = row.turtle});
                bends = true;
            } else {
                other = symbol != edge && other == kNoSymbol ? symbol : other;
                fits = fits && (symbol == edge || symbol == other);
                path.push_back({.is_edge = true, .is_own = symbol == edge});
            }
        });
        return fits && bends && other != kNoSymbol ? path : std::vector<Step>();
    }

    void check(SymbolId edge) {
        SymbolId drawn = kNoSymbol;
        const std::vector<Step> edge_steps = steps(edge, drawn);
        if (edge_steps.empty() || !has_plain_production(drawn) ||
            info(program_.symbol(drawn).turtle).drawn != DrawnKind::Segment) {
            return;
        }
        SymbolId back = kNoSymbol;
        const std::vector<Step> drawn_steps = steps(drawn, back);
        if (back != edge || !are_images(edge_steps, drawn_steps)) {
            return;
        }
        const std::string_view name = input_.name(edge);
        Diagnostic& note = diagnostics_.add(
            DiagnosticCode::UndrawnEdge, production_of(edge).predecessor.span,
            fmt::format("{} is rewritten as the edge {} is, but never drawn: its part of the line "
                        "is missing",
                        quoted(name), quoted(input_.name(drawn))));
        note.labels.push_back({production_of(drawn).predecessor.span, "the edge that is drawn"});
        note.help.push_back(fmt::format("`#object {} BRANCH;` draws it in the same way", name));
    }

    const CheckInput& input_;
    const Program& program_;
    Diagnostics& diagnostics_;
    Reachable reachable_;
    /// By symbol: its only production if that is plain, kNone without a production, else kNotPlain.
    std::vector<std::uint32_t> plain_production_;
};

} // namespace

void check_undrawn_edges(const CheckInput& input, Diagnostics& diagnostics) {
    if (input.program.settings.rewriting == RewritingMode::Parallel) {
        UndrawnEdges(input, diagnostics).check();
    }
}

} // namespace lsys
