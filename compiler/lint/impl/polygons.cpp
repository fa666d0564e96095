// SPDX-License-Identifier: MIT
// Polygons: the axiom and every successor have as many `{` as `}`; `.` only occurs within a
// polygon, and a polygon has at least three vertices. In profile `carey` polygons do not nest.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"
#include "grammar/base/characters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace lsys {

namespace {

class PolygonCheck {
public:
    PolygonCheck(const CheckInput& input, Diagnostics& diagnostics)
        : input_(input), program_(input.program), diagnostics_(diagnostics),
          inside_(program_.symbols.size(), false), rewriters_(rewriters_of(program_)) {}

    void run() {
        bool any = false;
        for (const Symbol& symbol : program_.symbols) {
            any = any || symbol.kind == SymbolKind::PolygonOpen ||
                  symbol.kind == SymbolKind::PolygonClose ||
                  symbol.turtle == TurtleOperation::PolygonVertex;
        }
        if (!any) {
            return;
        }
        find_inside();
        crosses_words_ = std::any_of(
            program_.productions.begin(), program_.productions.end(),
            [&](const Production& production) { return leaves_open(production.successor); });
        find_partners();
        for (const Axiom& axiom : program_.axioms) {
            check_word(axiom.word, "axiom", crosses_words_);
        }
        for (const Production& production : program_.productions) {
            bool may_be_inside = crosses_words_;
            for (const ProgramPatternItem& item : production.predecessor.items) {
                may_be_inside = may_be_inside || inside_[static_cast<std::size_t>(item.symbol)];
            }
            check_word(production.successor, "successor", may_be_inside);
        }
    }

private:
    SymbolKind kind(SymbolId symbol) const { return program_.symbol(symbol).kind; }

    /// Calls visit(symbol) for the modules of a word that stand in a polygon, including polygons
    /// that begin or end in another word.
    template <typename Visit>
    void for_each_inside(const ProgramWord& word, Visit&& visit) const {
        std::size_t depth = 0;
        std::size_t last_end = word.first_module; // last `}` whose `{` is in another word
        for_each_symbol(program_, word, [&](std::size_t index, SymbolId symbol) {
            if (kind(symbol) == SymbolKind::PolygonClose && depth-- == 0) {
                depth = 0;
                last_end = index;
            }
            depth += kind(symbol) == SymbolKind::PolygonOpen ? 1U : 0U;
        });
        depth = 0;
        for_each_symbol(program_, word, [&](std::size_t index, SymbolId symbol) {
            if (kind(symbol) == SymbolKind::PolygonClose) {
                depth -= depth > 0 ? 1U : 0U;
            } else if (kind(symbol) == SymbolKind::PolygonOpen) {
                ++depth;
            } else if (depth > 0 || index < last_end) {
                visit(symbol);
            }
        });
    }

    /// Calls visit(symbol) for the modules of a word that neither begin nor end a polygon.
    template <typename Visit>
    void for_each(const ProgramWord& word, Visit&& visit) const {
        for_each_symbol(program_, word, [&](std::size_t, SymbolId symbol) {
            if (kind(symbol) != SymbolKind::PolygonOpen &&
                kind(symbol) != SymbolKind::PolygonClose) {
                visit(symbol);
            }
        });
    }

    /// Whether a polygon that the word begins is still open at its end.
    bool leaves_open(const ProgramWord& word) const {
        std::size_t depth = 0;
        for_each_symbol(program_, word, [&](std::size_t, SymbolId symbol) {
            depth += kind(symbol) == SymbolKind::PolygonOpen ? 1U : 0U;
            depth -= kind(symbol) == SymbolKind::PolygonClose && depth > 0 ? 1U : 0U;
        });
        return depth > 0;
    }

    /// Sets open_words_ and end_words_.
    void find_partners() {
        const auto read = [&](const ProgramWord& word) {
            std::int64_t surplus = 0; // number of `{` minus number of `}`
            for_each_symbol(program_, word, [&](std::size_t, SymbolId symbol) {
                surplus += kind(symbol) == SymbolKind::PolygonOpen    ? 1
                           : kind(symbol) == SymbolKind::PolygonClose ? -1
                                                                      : 0;
            });
            open_words_ += surplus > 0 ? 1U : 0U;
            end_words_ += surplus < 0 ? 1U : 0U;
        };
        for (const Axiom& axiom : program_.axioms) {
            read(axiom.word);
        }
        for (const Production& production : program_.productions) {
            read(production.successor);
        }
    }

    /// Finds the modules that can occur in a polygon: modules written in a polygon, and modules
    /// that replace such modules.
    void find_inside() {
        std::vector<SymbolId> work;
        const auto mark = [&](SymbolId symbol) {
            if (!inside_[static_cast<std::size_t>(symbol)]) {
                inside_[static_cast<std::size_t>(symbol)] = true;
                work.push_back(symbol);
            }
        };
        for (const Axiom& axiom : program_.axioms) {
            for_each_inside(axiom.word, mark);
        }
        for (const Production& production : program_.productions) {
            for_each_inside(production.successor, mark);
        }
        while (!work.empty()) {
            const SymbolId symbol = work.back();
            work.pop_back();
            for (const std::uint32_t p : rewriters_[static_cast<std::size_t>(symbol)]) {
                for_each(program_.productions[p].successor, mark);
            }
        }
    }

    /// A polygon of a word whose `{` has been read and whose `}` has not.
    struct OpenPolygon {
        std::size_t begin = 0;      // index of its `{`
        std::uint32_t vertices = 0; // number of `.` in the polygon
        std::uint32_t moves = 0;    // number of its modules with TurtleInfo::AddsCorners
        bool may_grow = false;      // some module in it is rewritten
    };

    /// `where`: "axiom" or "successor", for messages. `may_be_inside`: the word may stand within a
    /// polygon of another word.
    void check_word(const ProgramWord& word, const char* where, bool may_be_inside) {
        const bool may_nest = program_.settings.turtle != TurtleProfile::Carey;
        std::vector<OpenPolygon> open;        // innermost last
        bool nesting_reported = false;        // one message per word
        std::optional<std::size_t> first_end; // the first `}` without its `{`
        std::size_t opened = 0;               // number of `{`
        std::size_t closed = 0;               // number of `}`
        for_each_symbol(program_, word, [&](std::size_t i, SymbolId id) {
            const Symbol& symbol = program_.symbol(id);
            if (symbol.kind == SymbolKind::PolygonOpen) {
                if (!may_nest && !nesting_reported) {
                    nesting_reported = report_nesting(word, i, open, may_be_inside);
                }
                open.push_back({i, 0, 0, false});
                ++opened;
            } else if (symbol.kind == SymbolKind::PolygonClose) {
                ++closed;
                if (open.empty()) {
                    first_end = first_end.value_or(i);
                    return;
                }
                const OpenPolygon ended = open.back();
                open.pop_back();
                if (!ended.may_grow) {
                    check_size(word, ended, i, may_be_inside || !open.empty());
                }
            } else if (!open.empty()) {
                OpenPolygon& inner = open.back();
                inner.vertices += symbol.turtle == TurtleOperation::PolygonVertex ? 1U : 0U;
                inner.moves += info(symbol.turtle).has(TurtleInfo::AddsCorners) ? 1U : 0U;
                inner.may_grow =
                    inner.may_grow || !rewriters_[static_cast<std::size_t>(id)].empty();
            } else if (symbol.turtle == TurtleOperation::PolygonVertex && !may_be_inside &&
                       !stray_reported_ && !is_decimal_point(word, i)) {
                stray_reported_ = true;
                Diagnostic& diagnostic =
                    add(DiagnosticCode::StrayVertex, word, i, "a vertex outside of any polygon");
                diagnostic.help.emplace_back(
                    "`.` adds the position to the polygon between `{` and `}`");
            }
        });
        // If exactly one word has more `{` than `}`, and exactly one word has more `}` than `{`,
        // the second word may end the polygon that the first begins.
        if (opened != closed && !(open_words_ == 1 && end_words_ == 1)) {
            report_imbalance(word, where, opened > closed ? open.back().begin : *first_end,
                             opened > closed);
        }
    }

    /// Whether a digit follows the `.` at `index`: a number that was read as modules.
    [[nodiscard]] bool is_decimal_point(const ProgramWord& word, std::size_t index) const {
        if (index + 1 == std::size_t{word.first_module} + word.module_count) {
            return false;
        }
        const std::string_view name = input_.name(program_.modules[index + 1].symbol);
        return name.size() == 1 && is_digit(name[0]);
    }

    /// Reports a `{` within a polygon, which profile `carey` does not allow. Returns whether it
    /// reported one.
    bool report_nesting(const ProgramWord& word,
                        std::size_t index,
                        const std::vector<OpenPolygon>& open,
                        bool may_be_inside) {
        if (!open.empty()) {
            Diagnostic& diagnostic = add(DiagnosticCode::NestedPolygon, word, index,
                                         "a polygon begins within a polygon");
            diagnostic.labels.push_back(
                {module_name_span(input_, word, open.back().begin), "this one is still open"});
            diagnostic.help.emplace_back("close the first with `}` before the second begins");
        } else if (may_be_inside) {
            Diagnostic diagnostic = make_diagnostic(
                DiagnosticCode::NestedPolygon, module_name_span(input_, word, index),
                "this polygon can begin within another one: the module that becomes it also stands "
                "in one");
            diagnostic.severity = Severity::Warning; // set before add(), which counts errors
            diagnostics_.add(std::move(diagnostic));
        }
        return !open.empty() || may_be_inside;
    }

    void
    report_imbalance(const ProgramWord& word, const char* where, std::size_t index, bool is_open) {
        Diagnostic diagnostic = make_diagnostic(
            DiagnosticCode::UnbalancedPolygon, module_name_span(input_, word, index),
            is_open ? fmt::format("`{{` is closed nowhere in this {}", where)
                    : fmt::format("`}}` ends no polygon of this {}", where));
        diagnostic.notes.emplace_back("polygons begin and end along the whole word, so another "
                                      "production may hold the other bracket");
        diagnostics_.add(std::move(diagnostic));
    }

    /// The first `.` outside of polygons between the `}` at `close` and the next polygon of the
    /// word; nullopt if there is none.
    [[nodiscard]] std::optional<std::size_t> vertex_behind(const ProgramWord& word,
                                                           std::size_t close) const {
        const std::size_t end = std::size_t{word.first_module} + word.module_count;
        for (std::size_t i = close + 1; i < end; ++i) {
            const Symbol& symbol = program_.symbol(program_.modules[i].symbol);
            if (symbol.kind == SymbolKind::PolygonOpen) {
                break;
            }
            if (symbol.turtle == TurtleOperation::PolygonVertex && !is_decimal_point(word, i)) {
                return i;
            }
        }
        return std::nullopt;
    }

    /// Reports a polygon, whose `}` is at `close`, with fewer than three vertices. Without `.` the
    /// vertices are the start and end of every move (ABOP figure 1.25); in profile `cpfg` they are
    /// each `.` and the end of each move. `is_inside`: it may stand within another polygon.
    void check_size(const ProgramWord& word,
                    const OpenPolygon& polygon,
                    std::size_t close,
                    bool is_inside) {
        const std::uint32_t vertices = polygon.vertices;
        const std::uint32_t moves = polygon.moves;
        const bool are_ends = program_.settings.traits.corners_are_ends;
        const std::uint32_t count = are_ends        ? vertices + moves
                                    : vertices != 0 ? vertices
                                    : moves == 0    ? 0
                                                    : moves + 1;
        if (count >= 3) {
            return;
        }
        Diagnostic& diagnostic = add(DiagnosticCode::SmallPolygon, word, polygon.begin,
                                     count == 0 ? std::string("a polygon without vertices")
                                                : fmt::format("a polygon of {} {}", count,
                                                              count == 1 ? "vertex" : "vertices"));
        diagnostic.span = join(diagnostic.span, module_name_span(input_, word, close));
        diagnostic.help.emplace_back(
            vertices != 0 && !are_ends
                ? "add vertices with `.`: a polygon has at least three"
                : "add vertices with `.`, or moves with `F` or `f`: a polygon has at least three");
        const std::optional<std::size_t> behind =
            is_inside || stray_reported_ ? std::nullopt : vertex_behind(word, close);
        if (behind) { // one mistake: the `}` stands too early
            diagnostic.labels.push_back(
                {module_name_span(input_, word, *behind), "this vertex is outside of any polygon"});
            stray_reported_ = true;
        }
    }

    Diagnostic&
    add(DiagnosticCode code, const ProgramWord& word, std::size_t index, std::string message) {
        return diagnostics_.add(code, module_name_span(input_, word, index), std::move(message));
    }

    const CheckInput& input_;
    const Program& program_;
    Diagnostics& diagnostics_;
    std::vector<bool> inside_; // by symbol: can occur in a polygon
    GroupedLists rewriters_;
    bool stray_reported_ = false; // a `.` outside of polygons has been reported
    /// Some successor leaves a polygon open, so modules outside of `{` and `}` of their own word
    /// may be inside a polygon.
    bool crosses_words_ = false;
    std::size_t open_words_ = 0; // words with more `{` than `}`
    std::size_t end_words_ = 0;  // words with more `}` than `{`
};

} // namespace

void check_polygons(const CheckInput& input, Diagnostics& diagnostics) {
    PolygonCheck(input, diagnostics).run();
}

} // namespace lsys
