// SPDX-License-Identifier: MIT
#include "runtime/derive/word_text.h"
#include "runtime/program/impl/trace_printer.h"
#include "runtime/program/trace_report.h"

#include <cmath>

namespace lsys {

std::string value_text(float value) {
    if (!std::isfinite(value)) {
        return std::isnan(value) ? "not a number" : value > 0.0F ? "infinity" : "-infinity";
    }
    std::string text;
    append_number(value, text);
    return text;
}

std::string count_text(std::uint64_t count, std::string_view one, std::string_view several) {
    return fmt::format("{} {}", count, count == 1 ? one : several);
}

std::string TracePrinter::run() {
    for (const TracedPlace& place : trace_.places) {
        out_ += out_.empty() ? "" : "\n";
        head(place);
        switch (trace_.scope) {
        case TraceScope::Next:
            drawing(place);
            step(place);
            break;
        case TraceScope::Written:
            written(place);
            drawing(place);
            break;
        case TraceScope::Back:
            back(place);
            break;
        }
    }
    untraced_matches();
    return std::move(out_);
}

const BytecodeProduction& TracePrinter::production(ProductionId id) const {
    return bytecode_.productions[static_cast<std::size_t>(id)];
}

const Production* TracePrinter::source_of(ProductionId id) const {
    const bool known =
        grammar_.program && grammar_.program->productions.size() == bytecode_.productions.size();
    return known ? &grammar_.program->productions[static_cast<std::size_t>(id)] : nullptr;
}

std::string TracePrinter::module(const TracedModule& module) const {
    return module_text(bytecode_, module);
}

std::string TracePrinter::name(ProductionId id) const {
    return fmt::format("`{}`", production(id).name);
}

std::string TracePrinter::full_name(ProductionId id) const {
    const BytecodeProduction& named = production(id);
    return named.stage == Stage::Rewrite
               ? name(id)
               : fmt::format("`{} {}`", keyword_of(named.stage), named.name);
}

std::string TracePrinter::site_text(const Site& site) const {
    return fmt::format("{}:{}:{}", bytecode_.files[static_cast<std::size_t>(site.span.file)],
                       site.line, site.column);
}

std::string TracePrinter::place_of(ProductionId id) const {
    const std::uint32_t site = production(id).name_site;
    return site == kNone ? std::string() : site_text(bytecode_.sites[site]) + ": ";
}

std::string TracePrinter::marked(std::string_view text) const {
    return colour_ ? fmt::format("\x1b[1;32m{}\x1b[0m", text) : std::string(text);
}

std::string TracePrinter::origin_text(const TraceOrigin& origin) const {
    const std::string place = origin.place ? " at " + site_text(*origin.place) : "";
    if (origin.production == kNoProduction) {
        return fmt::format("of the axiom{}", place);
    }
    return fmt::format("written by {}{} in generation {}", full_name(origin.production), place,
                       origin.generation);
}

void TracePrinter::head(const TracedPlace& place) {
    line("{} at position {} of generation {}, {}", module(place.module), place.position,
         trace_.generation,
         trace_.scope == TraceScope::Back && trace_.generation > 0
             ? std::string("back to the axiom")
             : origin_text(place.origin));
}

void TracePrinter::step(const TracedPlace& place) {
    out_ += '\n';
    if (trace_.is_last) {
        line("if generation {} followed:", trace_.generation + 1);
    }
    traces(place.step, place.position, trace_.generation + 1);
    const bool several = place.step.size() > 1;
    if (several && !trace_.stop) {
        if (place.next.empty()) {
            line("generation {} has no module of it", trace_.generation + 1);
        } else {
            list(fmt::format("in generation {} at {}:", trace_.generation + 1,
                             range_text(place.first_next, place.next.size())),
                 place.next);
        }
    }
}

void TracePrinter::drawing(const TracedPlace& place) {
    const bool is_plain = place.drawing.size() == 1 && place.drawing[0].attempts.empty();
    if (place.drawing.empty() || (is_plain && trace_.scope == TraceScope::Written)) {
        return;
    }
    out_ += '\n';
    traces(place.drawing, place.position, trace_.generation);
    if (place.drawing.size() > 1) {
        line("drawn as: {}", modules(place.drawn));
    }
}

void TracePrinter::untraced_matches() {
    if (trace_.matches > trace_.places.size()) {
        out_ += '\n';
        const std::uint64_t more = trace_.matches - trace_.places.size();
        line("{} like it in generation {}, the next at position {}",
             count_text(more, "more module is", "more modules are"), trace_.generation,
             trace_.next_untraced);
    }
}

std::string trace_text(const Trace& trace, const Grammar& grammar, bool colour) {
    return TracePrinter(trace, grammar, colour).run();
}

} // namespace lsys
