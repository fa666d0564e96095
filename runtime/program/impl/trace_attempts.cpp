// SPDX-License-Identifier: MIT
#include "grammar/base/counted_text.h"
#include "runtime/derive/word_text.h"
#include "runtime/program/impl/trace_printer.h"

namespace lsys {

namespace {

/// Max numbers of items shown, so that the report of a module fits one screen.
constexpr std::size_t kMaxParts = 12;
constexpr std::size_t kMaxVisited = 6; // max modules that a context search visited
/// Max number of productions with frames. If there are more, each production that does not apply
/// takes one line.
constexpr std::size_t kMaxFrames = 4;
constexpr std::size_t kMaxReasons = 4; // operations in the line of a production without a frame

/// A step of an evaluation: "3 > 2 is true", "3 * 2 = 6".
std::string part_text(const TracedPart& part) {
    return part.is_truth
               ? fmt::format("{} is {}", part.values, part.value != 0.0F ? "true" : "false")
               : fmt::format("{} = {}", part.values, value_text(part.value));
}

} // namespace

std::string TracePrinter::visited_text(const ContextTrace& context) const {
    std::string text;
    const std::size_t shown = std::min(context.visited.size(), kMaxVisited);
    for (std::size_t i = 0; i < shown; ++i) {
        text += fmt::format("{}{} at {}", i == 0 ? "" : ", then ",
                            module(context.visited[i].module), context.visited[i].position);
    }
    text += context.visited.size() > shown ? ", ..." : "";
    return text;
}

std::string TracePrinter::passed_text(const ContextTrace& context) {
    std::string text;
    if (context.ignored != 0) {
        text += fmt::format("; {} ignored", counted(context.ignored, "module"));
    }
    if (context.branches != 0) {
        text += fmt::format("; {} passed over", count_text(context.branches, "branch", "branches"));
    }
    return text;
}

std::string TracePrinter::pattern_text(TableRange pattern, std::uint32_t item) const {
    const BytecodeSymbol& symbol =
        bytecode_.symbol(bytecode_.patterns[pattern.first + item].symbol);
    const std::string spelled = spelled_name(symbol.name, bytecode_.settings.print_letters);
    return symbol.parameter_count == 0
               ? spelled
               : fmt::format("{} with {}", spelled, counted(symbol.parameter_count, "parameter"));
}

std::string
TracePrinter::context_text(const ContextTrace& context, TableRange pattern, bool is_left) const {
    const std::string passed = passed_text(context);
    switch (context.end) {
    case ContextEnd::Fits:
        return (context.visited.empty() ? std::string("a branch") : visited_text(context)) + passed;
    case ContextEnd::OtherModule:
        return fmt::format("{}, not {}{}", visited_text(context),
                           pattern_text(pattern, context.item), passed);
    case ContextEnd::EndOfPath: {
        const std::string visited =
            context.visited.empty() ? std::string() : visited_text(context) + ", then ";
        return fmt::format("{}{}, not {}{}", visited,
                           is_left ? "the beginning of the word"
                                   : "the end of the branch or of the word",
                           pattern_text(pattern, context.item), passed);
    }
    case ContextEnd::NoBranch: {
        const std::string visited =
            context.visited.empty() ? std::string() : visited_text(context) + ", then ";
        return visited + "no branch" + passed;
    }
    case ContextEnd::NotSearched:
        break;
    }
    return {};
}

void TracePrinter::add(Notes& notes, const char* what, SourceSpan span, std::string text) {
    notes.texts.push_back(fmt::format("{}: {}", what, text));
    notes.labels.push_back({span, std::move(text)});
}

void TracePrinter::print(const Notes& notes, const Production* source) {
    if (source != nullptr) {
        render_frame(notes.labels, *grammar_.sources, colour_, out_);
        return;
    }
    for (const std::string& text : notes.texts) {
        line("    {}", text);
    }
}

void TracePrinter::explain(const Attempt& attempt,
                           const TracedModule& traced,
                           const std::optional<Label>& written) {
    const Production* const source = source_of(attempt.production);
    const BytecodeProduction& tried = production(attempt.production);
    const auto span = [&](SourceSpan Production::*member) {
        return source == nullptr ? SourceSpan{} : source->*member;
    };
    Notes notes;
    if (attempt.condition) {
        add(notes, "condition", span(&Production::condition_span),
            condition_text(*attempt.condition));
    }
    if (attempt.weight) {
        add(notes, "weight", span(&Production::weight_span),
            "weight " + condition_text(*attempt.weight));
    }
    if (attempt.verdict == Verdict::Predecessor) {
        add(notes, "predecessor", source == nullptr ? SourceSpan{} : source->predecessor.span,
            followed_text(attempt, traced));
    }
    if (attempt.right.end != ContextEnd::NotSearched) {
        add(notes, "right context", source == nullptr ? SourceSpan{} : source->right.span,
            context_text(attempt.right, tried.right, false));
    }
    if (attempt.left.end != ContextEnd::NotSearched) {
        add(notes, "left context", source == nullptr ? SourceSpan{} : source->left.span,
            context_text(attempt.left, tried.left, true));
    }
    const bool joins = written && (notes.labels.empty() || source == nullptr ||
                                   in_one_frame(notes.labels.front().span, written->span));
    if (written && joins) {
        notes.labels.push_back(*written);
    }
    if (notes.labels.empty() && source != nullptr) {
        notes.labels.push_back({source->predecessor.span, std::string()});
    }
    print(notes, source);
    if (written && !joins) {
        render_frame({*written}, *grammar_.sources, colour_, out_);
    }
    if (attempt.condition) {
        parts(*attempt.condition);
    }
    if (attempt.weight) {
        parts(*attempt.weight);
    }
}

std::string TracePrinter::followed_text(const Attempt& attempt, const TracedModule& traced) const {
    std::string text;
    for (const VisitedModule& visited : attempt.predecessor) {
        text += fmt::format("{}{} at {}", text.empty() ? "" : ", then ", module(visited.module),
                            visited.position);
    }
    return fmt::format("{} is followed by {}", module(traced),
                       text.empty() ? "the end of the word" : text);
}

bool TracePrinter::in_one_frame(SourceSpan primary, SourceSpan other) const {
    constexpr std::uint32_t kMaxColumns = 90;
    const SourceFile& file = grammar_.sources->file(primary.file);
    return primary.file == other.file &&
           file.line_column(primary.begin).line == file.line_column(other.begin).line &&
           other.end < primary.begin + kMaxColumns;
}

std::string TracePrinter::reason_text(const Attempt& attempt, const TracedModule& traced) const {
    const BytecodeProduction& tried = production(attempt.production);
    switch (attempt.verdict) {
    case Verdict::Predecessor:
        return ": " + followed_text(attempt, traced);
    case Verdict::LeftContext:
        return ": " + context_text(attempt.left, tried.left, true);
    case Verdict::RightContext:
        return ": " + context_text(attempt.right, tried.right, false);
    case Verdict::Condition:
        return reasons_text(*attempt.condition);
    default:
        return {};
    }
}

std::string TracePrinter::reasons_text(const ExpressionTrace& condition) {
    std::string text;
    std::size_t count = 0;
    for (std::size_t i = 0; i < condition.parts.size(); ++i) {
        const TracedPart& part = condition.parts[i];
        const bool joins = i + 1 == condition.parts.size() && i != 0 && count != 0 &&
                           (part.values.starts_with("true ") || part.values.starts_with("false ") ||
                            part.values[0] == '!');
        if (part.is_truth && !joins && ++count <= kMaxReasons) {
            text += (text.empty() ? ": " : ", ") + part_text(part);
        }
    }
    return count > kMaxReasons ? text + ", ..." : text;
}

std::string TracePrinter::condition_text(const ExpressionTrace& condition) {
    if (!condition.is_finite && condition.parts.size() != 1) {
        return "this is " + value_text(condition.value);
    }
    return condition.parts.empty() ? value_text(condition.value)
                                   : part_text(condition.parts.back());
}

void TracePrinter::parts(const ExpressionTrace& condition) {
    std::vector<PartLine> lines;
    std::size_t first = 0; // index of the first operation that is in no line yet
    for (std::size_t i = 0; i + 1 < condition.parts.size(); ++i) {
        if (!condition.parts[i].is_truth) {
            continue;
        }
        for (; !is_within(condition, first, i); ++first) {
            add_part_lines(condition, first, first + 1, lines);
        }
        add_part_lines(condition, first, i + 1, lines);
        first = i + 1;
    }
    for (; first + 1 < condition.parts.size(); ++first) {
        add_part_lines(condition, first, first + 1, lines);
    }
    const std::size_t shown = std::min(lines.size(), kMaxParts);
    std::size_t width = 0;
    std::size_t hidden = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::size_t size = lines[i].text.size();
        width = i < shown && size <= 40 ? std::max(width, size) : width;
        hidden += i < shown ? 0 : lines[i].operations;
    }
    for (std::size_t i = 0; i < shown; ++i) {
        line("      {:<{}}   {}", lines[i].text, width, lines[i].values);
    }
    if (hidden != 0) {
        line("      and {} more", counted(hidden, "operation"));
    }
}

bool TracePrinter::is_within(const ExpressionTrace& condition,
                             std::size_t first,
                             std::size_t last) {
    const std::string& whole = condition.parts[last].text;
    return std::all_of(
        condition.parts.begin() + static_cast<std::ptrdiff_t>(first),
        condition.parts.begin() + static_cast<std::ptrdiff_t>(last),
        [&](const TracedPart& part) { return whole.find(part.text) != std::string::npos; });
}

void TracePrinter::add_part_lines(const ExpressionTrace& condition,
                                  std::size_t first,
                                  std::size_t end,
                                  std::vector<PartLine>& lines) {
    PartLine all{condition.parts[end - 1].text, {}, end - first};
    for (std::size_t i = first; i < end; ++i) {
        all.values += (i == first ? "" : ", ") + part_text(condition.parts[i]);
    }
    if (all.text.size() + all.values.size() <= kMaxTraceColumns - 9) {
        lines.push_back(std::move(all));
        return;
    }
    for (std::size_t i = first; i < end; ++i) {
        lines.push_back({condition.parts[i].text, part_text(condition.parts[i]), 1});
    }
}

void TracePrinter::attempt(const ModuleTrace& trace,
                           const Attempt& attempt,
                           bool is_later,
                           bool is_brief,
                           const std::optional<Label>& written) {
    const std::string who = place_of(attempt.production) + name(attempt.production);
    const BytecodeProduction& tried = production(attempt.production);
    const std::string why = is_brief ? reason_text(attempt, trace.module) : std::string();
    switch (attempt.verdict) {
    case Verdict::Applies:
        if (is_later && !framed_.insert(attempt.production).second) {
            return; // the title names the earlier explanation: again_text()
        }
        line("{} {}{}", who, marked("applies"), trace.choice ? ", chosen by chance" : "");
        explain(attempt, trace.module, written);
        return;
    case Verdict::OtherCount: {
        line("{} does not apply: it is for {}, this one has {}", who,
             pattern_text(tried.predecessor, 0),
             static_cast<std::uint32_t>(trace.module.values.size()));
        return;
    }
    case Verdict::OtherRule:
        line("{} is not tried: it is of rule {}, and generation {} rewrites by rule {} alone", who,
             tried.rule, trace.generation, trace.rule);
        return;
    case Verdict::Predecessor:
        line("{} does not apply: other modules follow{}", who, why);
        break;
    case Verdict::LeftContext:
        line("{} does not apply: its left context does not match{}", who, why);
        break;
    case Verdict::RightContext:
        line("{} does not apply: its right context does not match{}", who, why);
        break;
    case Verdict::Condition:
        line("{} does not apply: its condition is 0{}", who, why);
        break;
    case Verdict::Fault:
        line("{} fails: its {}", who,
             attempt.weight ? "weight is negative or too large" : "condition has no finite value");
        explain(attempt, trace.module, std::nullopt);
        return;
    case Verdict::NoWeight:
        line("{} matches, but its weight is 0", who);
        break;
    case Verdict::NotDrawn:
        if (is_later) {
            return; // brief_choice() lists such productions
        }
        line("{} matches too, and is not the one chosen by chance", who);
        break;
    case Verdict::NotTried:
        return; // attempts() lists such productions in one line
    }
    if (!is_brief) {
        explain(attempt, trace.module, std::nullopt);
    }
}

void TracePrinter::attempts(const ModuleTrace& trace,
                            bool is_later,
                            const std::optional<Label>& written) {
    const auto frames =
        std::count_if(trace.attempts.begin(), trace.attempts.end(), [](const Attempt& each) {
            return each.verdict != Verdict::OtherCount && each.verdict != Verdict::OtherRule &&
                   each.verdict != Verdict::NotTried;
        });
    const bool is_brief = is_later || frames > static_cast<std::ptrdiff_t>(kMaxFrames);
    for (const Attempt& each : trace.attempts) {
        attempt(trace, each, is_later, is_brief, written);
    }
    std::string later;
    for (const Attempt& each : trace.attempts) {
        if (each.verdict == Verdict::NotTried) {
            later += (later.empty() ? "" : ", ") + name(each.production);
        }
    }
    if (!later.empty() && !is_later) {
        line("not tried, since one before was taken: {}", later);
    }
    if (trace.attempts.empty() && trace.fate == Fate::Copied) {
        line("no production {}rewrites modules of this name{}",
             trace.kind == DerivationPass::Kind::Decompose   ? "of `#decompose` "
             : trace.kind == DerivationPass::Kind::Interpret ? "of `#interpret` "
                                                             : "",
             trace.other_names == 0
                 ? std::string()
                 : fmt::format("; {} for modules of other names",
                               count_text(trace.other_names, "production is", "productions are")));
    } else if (trace.other_names != 0 && !is_later) {
        line("{} for modules of other names",
             count_text(trace.other_names, "production is", "productions are"));
    }
}

void TracePrinter::choice(const ModuleTrace& trace, const ChoiceTrace& choice) {
    const std::string unit = value_text(choice.unit);
    if (choice.by_glibc) {
        line("random choice for all modules: number {} of rand(), as u = {}", choice.number, unit);
    } else if (choice.by_generation) {
        line("random choice for all modules: draw 0 of rule {} in generation {}, u = {}",
             choice.rule, trace.generation, unit);
    } else {
        line("random choice: {} at position {} in generation {}, u = {}", draw_text(choice.number),
             choice.position, trace.generation, unit);
    }
    alternatives(choice,
                 [this](const ChoiceTrace::Alternative& each) { return name(each.production); });
}

void TracePrinter::brief_choice(const ChoiceTrace& choice) {
    std::string text;
    for (const ChoiceTrace::Alternative& each : choice.alternatives) {
        text += fmt::format("{}{} below {}", text.empty() ? "" : ", ", name(each.production),
                            value_text(each.cumulative));
    }
    line("random choice: {}, u = {}: {}", draw_text(choice.number), value_text(choice.unit), text);
}

std::string TracePrinter::draw_text(std::uint64_t number) {
    constexpr std::uint64_t kDrawsOfPass = 4096;
    return fmt::format("draw {}{}", number % kDrawsOfPass,
                       number < kDrawsOfPass ? "" : " of the pass");
}

} // namespace lsys
