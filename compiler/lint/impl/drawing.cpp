// SPDX-License-Identifier: MIT
// Grammars that are meant to draw but draw nothing in the requested generations.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"
#include "compiler/lint/impl/reachable.h"

#include <fmt/format.h>

#include <algorithm>

namespace lsys {

void check_drawing(const CheckInput& input, Diagnostics& diagnostics) {
    const Program& program = input.program;
    const Reachable reachable = find_reachable(program);
    bool prepared = false;
    bool has_unreachable_drawing = false; // some module would draw, but never occurs
    SymbolId drawn = kNoSymbol;           // the first module that draws
    for (std::uint32_t s = 0; s < program.symbols.size(); ++s) {
        const auto symbol = SymbolId{s};
        const TurtleOperation operation = program.symbols[s].turtle;
        if (draws(operation)) {
            has_unreachable_drawing = has_unreachable_drawing || !reachable.occurs(symbol);
            if (reachable.occurs(symbol) &&
                (drawn == kNoSymbol ||
                 reachable.generation[s] < reachable.generation[static_cast<std::size_t>(drawn)])) {
                drawn = symbol;
            }
        }
        prepared = prepared ||
                   (reachable.occurs(symbol) && info(operation).has(TurtleInfo::PreparesDrawing));
    }
    if (drawn == kNoSymbol) {
        // Other checks report modules that never occur. Without operations that prepare drawing,
        // the grammar may be meant for words alone.
        if (has_unreachable_drawing || !prepared) {
            return;
        }
        Diagnostic& diagnostic =
            diagnostics.add(DiagnosticCode::NothingDrawn, program.axiom_span(),
                            "nothing is drawn: the axiom leads to no module that draws");
        diagnostic.help.emplace_back(
            "`F` draws a segment, and `#object NAME SPHERE;` draws an object for a module");
        return;
    }
    const std::uint32_t generations =
        input.options.generations.value_or(program.generations.value_or(0));
    const std::uint32_t first = reachable.generation[static_cast<std::size_t>(drawn)];
    const bool known_generations = input.options.generations || program.generations;
    if (known_generations && generations < first) {
        const bool written = !input.options.generations;
        Diagnostic& diagnostic = diagnostics.add(
            DiagnosticCode::NothingDrawn, written ? program.generations_span : program.axiom_span(),
            fmt::format("nothing is drawn yet in generation {}: {} first appears in generation {}",
                        generations, quoted(input.name(drawn)), first));
        diagnostic.help.push_back(fmt::format("ask for {} generations or more", first));
    }
}

} // namespace lsys
