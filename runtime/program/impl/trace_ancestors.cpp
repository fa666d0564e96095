// SPDX-License-Identifier: MIT
#include "grammar/base/counted_text.h"
#include "runtime/program/impl/trace_printer.h"

namespace lsys {

void TracePrinter::written(const TracedPlace& place) {
    if (place.back.empty() && grammar_.is_module_file && !trace_.axiom) {
        return; // the heading says all that is known
    }
    out_ += '\n';
    if (!place.back.empty() && !place.back.back().steps.empty()) {
        written_by(place.back.back());
        return;
    }
    if (!place.back.empty()) {
        copies(1, trace_.generation);
    }
    axiom(place.origin, place.module);
}

void TracePrinter::written_by(const AncestorStep& step) {
    const std::uint32_t generation = step.generation + 1;
    if (generation < trace_.generation) {
        copies(generation + 1, trace_.generation);
    }
    const std::uint32_t replaced = step.steps.front().replaced;
    line("generation {}: in place of {}{} at {} of generation {}", generation, module(step.module),
         replaced == 1 ? std::string()
                       : fmt::format(" and {} after it", counted(replaced - 1, "module")),
         range_text(step.position, replaced), step.generation);
    for (std::size_t i = 0; i < step.steps.size(); ++i) {
        const ModuleTrace& trace = step.steps[i];
        const bool is_last = i + 1 == step.steps.size();
        if (const std::string title = pass_head(trace); !title.empty()) {
            line("{}", title);
        }
        attempts(trace, false,
                 successor_label(trace, is_last ? step.offset : step.steps[i + 1].offset));
        if (trace.choice) {
            choice(trace, *trace.choice);
        }
        const bool plain = step.steps.size() == 1 && trace.kind == DerivationPass::Kind::Rewrite &&
                           bytecode_.settings.rewriting != RewritingMode::Sequential;
        outcome(trace, plain ? fmt::format(" of generation {}", generation) : std::string());
    }
}

std::optional<Label> TracePrinter::successor_label(const ModuleTrace& trace,
                                                   std::uint64_t offset) const {
    if (trace.production == kNoProduction) {
        return std::nullopt; // an answer set the parameters of the module
    }
    const TableRange codes = production(trace.production).successor.codes;
    if (source_of(trace.production) == nullptr || offset >= codes.count) {
        return std::nullopt;
    }
    const std::uint32_t index = codes.first + static_cast<std::uint32_t>(offset);
    const std::optional<Site> place = lsys::place_of(bytecode_, index);
    return place ? std::optional(Label{place->span, module(trace.written[offset])}) : std::nullopt;
}

void TracePrinter::axiom(const TraceOrigin& origin, const TracedModule& written) {
    if (origin.place && !grammar_.is_module_file) {
        render_frame({{origin.place->span, module(written)}}, *grammar_.sources, colour_, out_);
    }
    if (trace_.axiom) {
        line("axiom by chance: u = {}", value_text(trace_.axiom->unit));
        alternatives(*trace_.axiom, [this](const AxiomTrace::Alternative& each) {
            return each.site == kNone
                       ? std::string("axiom")
                       : fmt::format("axiom of line {}", bytecode_.sites[each.site].line);
        });
    }
}

void TracePrinter::copies(std::uint32_t first, std::uint32_t last) {
    if (first == last) {
        line("generation {}: copied", first);
    } else {
        line("generations {} to {}: copied", first, last);
    }
}

void TracePrinter::back(const TracedPlace& place) {
    if (place.back.empty()) {
        return;
    }
    out_ += '\n';
    std::optional<std::uint32_t> copied; // last generation of a run of copies; unset: no run
    std::uint32_t first_copy = 0;
    for (const AncestorStep& each : place.back) {
        if (each.steps.empty()) {
            copied = copied.value_or(each.generation + 1);
            first_copy = each.generation + 1;
            continue;
        }
        if (copied) {
            copies(first_copy, *copied);
            copied.reset();
        }
        back_step(each);
    }
    if (copied) {
        copies(first_copy, *copied);
    }
    const AncestorStep& last = place.back.back();
    line("generation 0: {} at position {}, {}", module(last.module), last.position,
         origin_text(place.origin));
    axiom(place.origin, last.module);
}

void TracePrinter::back_step(const AncestorStep& each) {
    for (std::size_t i = each.steps.size(); i-- > 0;) {
        const ModuleTrace& trace = each.steps[i];
        if (trace.fate == Fate::Sensed) {
            line("generation {}: {} answers {} at position {}: {}", each.generation + 1,
                 asked_text(trace.module), module(trace.module), trace.position,
                 modules(trace.written));
            continue;
        }
        const bool is_last = i + 1 == each.steps.size();
        const std::uint64_t offset = is_last ? each.offset : each.steps[i + 1].offset;
        const std::string pass =
            trace.kind == DerivationPass::Kind::Decompose
                ? fmt::format("the word of decomposition pass {}", trace.pass)
            : trace.kind == DerivationPass::Kind::Down || trace.kind == DerivationPass::Kind::Up
                ? std::string("the word that is swept")
            : bytecode_.settings.rewriting == RewritingMode::Sequential
                ? fmt::format("the word of pass {}", trace.rule)
                : fmt::format("generation {}", each.generation);
        line("generation {}: {}{} from {} at position {} of {}{}", each.generation + 1,
             place_of(trace.production), full_name(trace.production), module(trace.module),
             trace.position, pass,
             trace.choice ? fmt::format(", chosen by u = {}", value_text(trace.choice->unit))
                          : std::string());
        back_frame(trace, offset);
        values(trace);
    }
    if (!each.agrees) {
        line("internal error: the engine wrote something else here; please report it");
    }
}

void TracePrinter::back_frame(const ModuleTrace& trace, std::uint64_t offset) {
    const Production* const source = source_of(trace.production);
    if (source == nullptr) {
        return;
    }
    Notes notes;
    if (const std::optional<Label> written = successor_label(trace, offset)) {
        notes.labels.push_back(*written);
    }
    for (const Attempt& attempt : trace.attempts) {
        if (attempt.production == trace.production && attempt.condition) {
            notes.labels.push_back({source->condition_span, condition_text(*attempt.condition)});
        }
    }
    if (notes.labels.empty()) {
        notes.labels.push_back({source->predecessor.span, module(trace.module)});
    }
    render_frame(notes.labels, *grammar_.sources, colour_, out_);
}

} // namespace lsys
