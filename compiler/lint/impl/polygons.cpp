// Polygons: `{` and `}` balance in the axiom and in every successor and do not nest; `.` only
// stands within them, and a polygon has at least three vertices.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

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
        check_word(program_.axiom, "axiom", false);
        for (const Production& production : program_.productions) {
            bool may_be_inside = false;
            for (const ProgramPatternItem& item : production.predecessor.items) {
                may_be_inside = may_be_inside || inside_[static_cast<std::size_t>(item.symbol)];
            }
            check_word(production.successor, "successor", may_be_inside);
        }
    }

private:
    SymbolKind kind(std::size_t index) const {
        return program_.symbol(program_.modules[index].symbol).kind;
    }

    /// Calls visit(symbol) for the modules of a word that stand in a polygon of it. A `{` that is
    /// never closed is an error and opens no polygon.
    template <typename Visit>
    void for_each_inside(const ProgramWord& word, Visit&& visit) const {
        std::optional<std::size_t> open;
        for (std::size_t i = word.first_module;
             i < std::size_t{word.first_module} + word.module_count; ++i) {
            if (kind(i) == SymbolKind::PolygonOpen) {
                open = open.value_or(i);
            } else if (kind(i) == SymbolKind::PolygonClose && open) {
                for (std::size_t inner = *open + 1; inner < i; ++inner) {
                    visit_module(inner, visit);
                }
                open.reset();
            }
        }
    }

    template <typename Visit>
    void for_each(const ProgramWord& word, Visit&& visit) const {
        for (std::size_t i = word.first_module;
             i < std::size_t{word.first_module} + word.module_count; ++i) {
            visit_module(i, visit);
        }
    }

    template <typename Visit>
    void visit_module(std::size_t index, Visit&& visit) const {
        if (kind(index) != SymbolKind::PolygonOpen && kind(index) != SymbolKind::PolygonClose) {
            visit(program_.modules[index].symbol);
        }
    }

    /// Finds the modules that can stand in a polygon, directly or in place of a module that does.
    void find_inside() {
        std::vector<SymbolId> work;
        const auto mark = [&](SymbolId symbol) {
            if (!inside_[static_cast<std::size_t>(symbol)]) {
                inside_[static_cast<std::size_t>(symbol)] = true;
                work.push_back(symbol);
            }
        };
        for_each_inside(program_.axiom, mark);
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

    void check_word(const ProgramWord& word, const char* where, bool may_be_inside) {
        std::optional<std::size_t> open;
        bool error_reported = false; // one error per word
        bool may_nest = false;       // one warning per word, beside the error
        std::uint32_t vertices = 0;  // of the open polygon
        std::uint32_t moves = 0;
        bool may_grow = false; // some module in it is rewritten
        for (std::size_t i = word.first_module;
             i < std::size_t{word.first_module} + word.module_count; ++i) {
            const SymbolId id = program_.modules[i].symbol;
            const Symbol& symbol = program_.symbol(id);
            if (symbol.kind == SymbolKind::PolygonOpen) {
                if (open && !error_reported) {
                    error_reported = true;
                    Diagnostic& diagnostic = add(DiagnosticCode::NestedPolygon, word, i,
                                                 "a polygon begins within a polygon");
                    diagnostic.labels.push_back(
                        {module_name_span(input_, word, *open), "this one is still open"});
                    diagnostic.help.emplace_back(
                        "close the first with `}` before the second begins");
                } else if (!open && may_be_inside && !error_reported && !may_nest) {
                    may_nest = true;
                    Diagnostic diagnostic = make_diagnostic(
                        DiagnosticCode::NestedPolygon, module_name_span(input_, word, i),
                        "this polygon can begin within another one: the module that becomes it "
                        "also stands in one");
                    diagnostic.severity = Severity::Warning; // before add() counts it
                    diagnostics_.add(std::move(diagnostic));
                }
                open = i;
                vertices = moves = 0;
                may_grow = false;
            } else if (symbol.kind == SymbolKind::PolygonClose) {
                if (!open && !error_reported) {
                    error_reported = true;
                    Diagnostic& diagnostic =
                        add(DiagnosticCode::UnbalancedPolygon, word, i,
                            fmt::format("`}}` ends no polygon of this {}", where));
                    diagnostic.help.push_back(
                        fmt::format("`{{` and `}}` balance in every {}", where));
                } else if (open && !error_reported && !may_nest && !may_grow) {
                    check_size(word, *open, i, vertices, moves);
                }
                open.reset();
            } else if (open) {
                vertices += symbol.turtle == TurtleOperation::PolygonVertex ? 1U : 0U;
                moves += info(symbol.turtle).has(TurtleInfo::AddsCorners) ? 1U : 0U;
                may_grow = may_grow || !rewriters_[static_cast<std::size_t>(id)].empty();
            } else if (symbol.turtle == TurtleOperation::PolygonVertex && !may_be_inside &&
                       !std::exchange(stray_reported_, true)) {
                Diagnostic& diagnostic =
                    add(DiagnosticCode::StrayVertex, word, i, "a vertex outside of any polygon");
                diagnostic.help.emplace_back(
                    "`.` adds the position to the polygon between `{` and `}`");
            }
        }
        if (open && !error_reported) {
            Diagnostic& diagnostic = add(DiagnosticCode::UnbalancedPolygon, word, *open,
                                         fmt::format("`{{` is closed nowhere in this {}", where));
            diagnostic.help.push_back(fmt::format("`{{` and `}}` balance in every {}", where));
        }
    }

    /// The vertices of a polygon without `.` are the start and end of every move (ABOP 1.25).
    void check_size(const ProgramWord& word,
                    std::size_t open,
                    std::size_t close,
                    std::uint32_t vertices,
                    std::uint32_t moves) {
        const std::uint32_t count = vertices != 0 ? vertices : moves == 0 ? 0 : moves + 1;
        if (count >= 3) {
            return;
        }
        Diagnostic& diagnostic = add(DiagnosticCode::SmallPolygon, word, open,
                                     count == 0 ? std::string("a polygon without vertices")
                                                : fmt::format("a polygon of {} {}", count,
                                                              count == 1 ? "vertex" : "vertices"));
        diagnostic.span = join(diagnostic.span, module_name_span(input_, word, close));
        diagnostic.help.emplace_back(
            vertices != 0
                ? "add vertices with `.`: a polygon has at least three"
                : "add vertices with `.`, or moves with `F` or `f`: a polygon has at least three");
    }

    Diagnostic&
    add(DiagnosticCode code, const ProgramWord& word, std::size_t index, std::string message) {
        return diagnostics_.add(code, module_name_span(input_, word, index), std::move(message));
    }

    const CheckInput& input_;
    const Program& program_;
    Diagnostics& diagnostics_;
    std::vector<bool> inside_; // by symbol: can stand in a polygon
    GroupedLists rewriters_;
    bool stray_reported_ = false;
};

} // namespace

void check_polygons(const CheckInput& input, Diagnostics& diagnostics) {
    PolygonCheck(input, diagnostics).run();
}

} // namespace lsys
