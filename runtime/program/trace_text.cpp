// SPDX-License-Identifier: MIT
#include "grammar/base/counted_text.h"
#include "grammar/rendering/render_diagnostic.h"
#include "runtime/derive/word_text.h"
#include "runtime/program/trace_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// Max numbers of items shown, so that the report of a module fits one screen.
constexpr std::size_t kMaxParts = 12;
constexpr std::size_t kMaxWritten = 60;
constexpr std::size_t kMaxLater = 8;   // max modules of later passes
constexpr std::size_t kMaxVisited = 6; // max modules that a context search visited
/// Max width of a line that joins shorter lines.
constexpr std::size_t kMaxListColumns = 96;
/// Max number of productions with frames. If there are more, each production that does not apply
/// takes one line.
constexpr std::size_t kMaxFrames = 4;
constexpr std::size_t kMaxReasons = 4; // operations in the line of a production without a frame

std::string value_text(float value) {
    if (!std::isfinite(value)) {
        return std::isnan(value) ? "not a number" : value > 0.0F ? "infinity" : "-infinity";
    }
    std::string text;
    append_number(value, text);
    return text;
}

/// A step of an evaluation: "3 > 2 is true", "3 * 2 = 6".
std::string part_text(const TracedPart& part) {
    return part.is_truth
               ? fmt::format("{} is {}", part.values, part.value != 0.0F ? "true" : "false")
               : fmt::format("{} = {}", part.values, value_text(part.value));
}

std::string count_text(std::uint64_t count, std::string_view one, std::string_view several) {
    return fmt::format("{} {}", count, count == 1 ? one : several);
}

class Report {
public:
    Report(const Trace& trace, const Grammar& grammar, bool colour)
        : trace_(trace), grammar_(grammar), bytecode_(grammar.bytecode), colour_(colour) {}

    std::string run() {
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

private:
    [[nodiscard]] const BytecodeProduction& production(ProductionId id) const {
        return bytecode_.productions[static_cast<std::size_t>(id)];
    }
    /// The production in the Program, which has the places of its parts; null for a .lsb file.
    [[nodiscard]] const Production* source_of(ProductionId id) const {
        const bool known = grammar_.program &&
                           grammar_.program->productions.size() == bytecode_.productions.size();
        return known ? &grammar_.program->productions[static_cast<std::size_t>(id)] : nullptr;
    }
    [[nodiscard]] std::string module(const TracedModule& module) const {
        return module_text(bytecode_, module);
    }
    [[nodiscard]] std::string name(ProductionId id) const {
        return fmt::format("`{}`", production(id).name);
    }
    /// The name of a production, with the keyword of a stage other than rewriting: "`#decompose
    /// leaf`".
    [[nodiscard]] std::string full_name(ProductionId id) const {
        const BytecodeProduction& named = production(id);
        return named.stage == Stage::Rewrite
                   ? name(id)
                   : fmt::format("`{} {}`", keyword_of(named.stage), named.name);
    }
    [[nodiscard]] std::string site_text(const Site& site) const {
        return fmt::format("{}:{}:{}", bytecode_.files[static_cast<std::size_t>(site.span.file)],
                           site.line, site.column);
    }
    [[nodiscard]] std::string place_of(ProductionId id) const {
        const std::uint32_t site = production(id).name_site;
        return site == kNone ? std::string() : site_text(bytecode_.sites[site]) + ": ";
    }
    template <typename... Arguments>
    void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Arguments>(arguments)...);
        out_ += '\n';
    }

    /// `text` in green, if the report has colours.
    [[nodiscard]] std::string marked(std::string_view text) const {
        return colour_ ? fmt::format("\x1b[1;32m{}\x1b[0m", text) : std::string(text);
    }

    // --- the module

    [[nodiscard]] std::string origin_text(const TraceOrigin& origin) const {
        const std::string place = origin.place ? " at " + site_text(*origin.place) : "";
        if (origin.production == kNoProduction) {
            return fmt::format("of the axiom{}", place);
        }
        return fmt::format("written by {}{} in generation {}", full_name(origin.production), place,
                           origin.generation);
    }

    void head(const TracedPlace& place) {
        line("{} at position {} of generation {}, {}", module(place.module), place.position,
             trace_.generation,
             trace_.scope == TraceScope::Back && trace_.generation > 0
                 ? std::string("back to the axiom")
                 : origin_text(place.origin));
    }

    // --- productions that were tried

    /// The text of a label with the modules that a context search visited.
    [[nodiscard]] std::string visited_text(const ContextTrace& context) const {
        std::string text;
        const std::size_t shown = std::min(context.visited.size(), kMaxVisited);
        for (std::size_t i = 0; i < shown; ++i) {
            text += fmt::format("{}{} at {}", i == 0 ? "" : ", then ",
                                module(context.visited[i].module), context.visited[i].position);
        }
        text += context.visited.size() > shown ? ", ..." : "";
        return text;
    }
    [[nodiscard]] static std::string passed_text(const ContextTrace& context) {
        std::string text;
        if (context.ignored != 0) {
            text += fmt::format("; {} ignored", counted(context.ignored, "module"));
        }
        if (context.branches != 0) {
            text +=
                fmt::format("; {} passed over", count_text(context.branches, "branch", "branches"));
        }
        return text;
    }
    [[nodiscard]] std::string pattern_text(TableRange pattern, std::uint32_t item) const {
        const BytecodeSymbol& symbol =
            bytecode_.symbol(bytecode_.patterns[pattern.first + item].symbol);
        const std::string spelled = spelled_name(symbol.name, bytecode_.settings.print_letters);
        return symbol.parameter_count == 0
                   ? spelled
                   : fmt::format("{} with {}", spelled,
                                 counted(symbol.parameter_count, "parameter"));
    }
    [[nodiscard]] std::string
    context_text(const ContextTrace& context, TableRange pattern, bool is_left) const {
        const std::string passed = passed_text(context);
        switch (context.end) {
        case ContextEnd::Fits:
            return (context.visited.empty() ? std::string("a branch") : visited_text(context)) +
                   passed;
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

    /// Notes on a production: labels in its source line, or lines of text for a .lsb file.
    struct Notes {
        std::vector<Label> labels;
        std::vector<std::string> texts;
    };
    static void add(Notes& notes, const char* what, SourceSpan span, std::string text) {
        notes.texts.push_back(fmt::format("{}: {}", what, text));
        notes.labels.push_back({span, std::move(text)});
    }
    void print(const Notes& notes, const Production* source) {
        if (source != nullptr) {
            render_frame(notes.labels, *grammar_.sources, colour_, out_);
            return;
        }
        for (const std::string& text : notes.texts) {
            line("    {}", text);
        }
    }

    /// Prints the notes on a production that was tried, beginning with the reason why it does not
    /// apply. `written`: an additional label, of a module of the successor.
    void explain(const Attempt& attempt,
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

    [[nodiscard]] std::string followed_text(const Attempt& attempt,
                                            const TracedModule& traced) const {
        std::string text;
        for (const VisitedModule& visited : attempt.predecessor) {
            text += fmt::format("{}{} at {}", text.empty() ? "" : ", then ", module(visited.module),
                                visited.position);
        }
        return fmt::format("{} is followed by {}", module(traced),
                           text.empty() ? "the end of the word" : text);
    }

    /// Whether the frame of `primary` also shows `other`: a frame is one line, cut if it is long.
    [[nodiscard]] bool in_one_frame(SourceSpan primary, SourceSpan other) const {
        constexpr std::uint32_t kMaxColumns = 90;
        const SourceFile& file = grammar_.sources->file(primary.file);
        return primary.file == other.file &&
               file.line_column(primary.begin).line == file.line_column(other.begin).line &&
               other.end < primary.begin + kMaxColumns;
    }

    /// The reason why a production does not apply, as the end of a line; may be empty.
    [[nodiscard]] std::string reason_text(const Attempt& attempt,
                                          const TracedModule& traced) const {
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
    /// The comparisons of a condition with their values.
    [[nodiscard]] static std::string reasons_text(const ExpressionTrace& condition) {
        std::string text;
        std::size_t count = 0;
        for (std::size_t i = 0; i < condition.parts.size(); ++i) {
            const TracedPart& part = condition.parts[i];
            const bool joins = i + 1 == condition.parts.size() && i != 0 && count != 0 &&
                               (part.values.starts_with("true ") ||
                                part.values.starts_with("false ") || part.values[0] == '!');
            if (part.is_truth && !joins && ++count <= kMaxReasons) {
                text += (text.empty() ? ": " : ", ") + part_text(part);
            }
        }
        return count > kMaxReasons ? text + ", ..." : text;
    }

    /// The last operation of a condition, which gives its value.
    static std::string condition_text(const ExpressionTrace& condition) {
        if (!condition.is_finite && condition.parts.size() != 1) {
            return "this is " + value_text(condition.value);
        }
        return condition.parts.empty() ? value_text(condition.value)
                                       : part_text(condition.parts.back());
    }
    /// A line under a frame: an operation and its values.
    struct PartLine {
        std::string text;
        std::string values;
        std::size_t operations = 0; // number of operations in `text`
    };
    /// Prints the operations of a condition before the last, which is the label of the frame. A
    /// comparison shares its line with the arithmetic before it.
    void parts(const ExpressionTrace& condition) {
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
    /// Whether all operations from `first` on are operands of the operation `last`.
    static bool is_within(const ExpressionTrace& condition, std::size_t first, std::size_t last) {
        const std::string& whole = condition.parts[last].text;
        return std::all_of(
            condition.parts.begin() + static_cast<std::ptrdiff_t>(first),
            condition.parts.begin() + static_cast<std::ptrdiff_t>(last),
            [&](const TracedPart& part) { return whole.find(part.text) != std::string::npos; });
    }
    /// Adds the operations [first, end) in one line, or each in its own if the line is too long.
    static void add_part_lines(const ExpressionTrace& condition,
                               std::size_t first,
                               std::size_t end,
                               std::vector<PartLine>& lines) {
        PartLine all{condition.parts[end - 1].text, {}, end - first};
        for (std::size_t i = first; i < end; ++i) {
            all.values += (i == first ? "" : ", ") + part_text(condition.parts[i]);
        }
        if (all.text.size() + all.values.size() <= kMaxListColumns - 9) {
            lines.push_back(std::move(all));
            return;
        }
        for (std::size_t i = first; i < end; ++i) {
            lines.push_back({condition.parts[i].text, part_text(condition.parts[i]), 1});
        }
    }

    /// Prints a production that was tried. `is_later`: the module was written in this step, which
    /// shortens the text. `is_brief`: one line if the production does not apply. `written`: a label
    /// for a module of the successor of the production that applies.
    void attempt(const ModuleTrace& trace,
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
            line("{} is not tried: it is of rule {}, and generation {} rewrites by rule {} alone",
                 who, tried.rule, trace.generation, trace.rule);
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
                 attempt.weight ? "weight is negative or too large"
                                : "condition has no finite value");
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

    void attempts(const ModuleTrace& trace, bool is_later, const std::optional<Label>& written) {
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
                 trace.other_names == 0 ? std::string()
                                        : fmt::format("; {} for modules of other names",
                                                      count_text(trace.other_names, "production is",
                                                                 "productions are")));
        } else if (trace.other_names != 0 && !is_later) {
            line("{} for modules of other names",
                 count_text(trace.other_names, "production is", "productions are"));
        }
    }

    void choice(const ModuleTrace& trace, const ChoiceTrace& choice) {
        const std::string unit = value_text(choice.unit);
        if (choice.by_glibc) {
            line("random choice for all modules: number {} of rand(), as u = {}", choice.number,
                 unit);
        } else if (choice.by_generation) {
            line("random choice for all modules: draw 0 of rule {} in generation {}, u = {}",
                 choice.rule, trace.generation, unit);
        } else {
            line("random choice: {} at position {} in generation {}, u = {}",
                 draw_text(choice.number), choice.position, trace.generation, unit);
        }
        alternatives(
            choice, [this](const ChoiceTrace::Alternative& each) { return name(each.production); });
    }
    void brief_choice(const ChoiceTrace& choice) {
        std::string text;
        for (const ChoiceTrace::Alternative& each : choice.alternatives) {
            text += fmt::format("{}{} below {}", text.empty() ? "" : ", ", name(each.production),
                                value_text(each.cumulative));
        }
        line("random choice: {}, u = {}: {}", draw_text(choice.number), value_text(choice.unit),
             text);
    }
    /// Prints the alternatives of a choice with the sums of their weights. `name_of`: the name of
    /// an alternative.
    template <typename Choice, typename Name>
    void alternatives(const Choice& choice, const Name& name_of) {
        std::size_t width = 0;
        for (const auto& each : choice.alternatives) {
            width = std::max(width, name_of(each).size());
        }
        for (std::size_t i = 0; i < choice.alternatives.size(); ++i) {
            const auto& each = choice.alternatives[i];
            line("  {} {:<{}}   weight {}, sum {}{}", i == choice.taken ? '>' : ' ', name_of(each),
                 width, value_text(each.weight), value_text(each.cumulative),
                 i != choice.taken               ? ""
                 : each.cumulative > choice.unit ? ", the first above u"
                                                 : ", the last");
        }
    }
    /// The number of a draw. Later passes of a generation have numbers from a multiple of 4,096 on
    /// (docs/language.md section 6.2).
    [[nodiscard]] static std::string draw_text(std::uint64_t number) {
        constexpr std::uint64_t kDrawsOfPass = 4096;
        return fmt::format("draw {}{}", number % kDrawsOfPass,
                           number < kDrawsOfPass ? "" : " of the pass");
    }

    // --- written modules

    [[nodiscard]] std::string modules(const std::vector<TracedModule>& list) const {
        if (list.empty()) {
            return "nothing";
        }
        std::string text;
        const std::size_t shown = std::min(list.size(), kMaxWritten);
        std::size_t column = 0;
        for (std::size_t i = 0; i < shown; ++i) {
            const std::string each = module(list[i]);
            if (column != 0 && column + each.size() > 90) {
                text += "\n      ";
                column = 0;
            }
            text += (column == 0 ? "" : " ") + each;
            column += each.size() + 1;
        }
        if (list.size() > shown) {
            text += fmt::format(" ... and {} more", list.size() - shown);
        }
        return text;
    }
    /// Prints modules behind `title`, or below it if the line is too long.
    void list(const std::string& title, const std::vector<TracedModule>& written) {
        const std::string text = modules(written);
        const bool fits = title.size() + 1 + text.size() <= kMaxListColumns &&
                          text.find('\n') == std::string::npos;
        line("{}{}{}", title, fits ? " " : "\n      ", text);
    }
    [[nodiscard]] static std::string range_text(std::uint64_t first, std::size_t count) {
        return count == 1 ? fmt::format("position {}", first)
                          : fmt::format("positions {} to {}", first, first + count - 1);
    }

    /// A range or distribution with the values of its arguments: "{1, 2}", "normal(4, 0.25)".
    [[nodiscard]] static std::string arguments_text(const TracedRange& range) {
        const bool is_range = range.opcode == Opcode::Range;
        std::string text = is_range ? std::string() : std::string(info(range.opcode).mnemonic);
        text += is_range ? '{' : '(';
        for (std::size_t i = 0; i < range.arguments.size(); ++i) {
            text += (i == 0 ? "" : ", ") + value_text(range.arguments[i]);
        }
        return text + (is_range ? '}' : ')');
    }

    void values(const ModuleTrace& trace) {
        for (const TracedLocal& local : trace.locals) {
            const std::string number = value_text(local.value);
            line("  let {} = {}{}{}", local.name,
                 local.text == number ? number : fmt::format("{} = {}", local.text, number),
                 local.choices.empty() ? "" : ", since ", fmt::join(local.choices, ", "));
        }
        for (const TracedRange& range : trace.ranges) {
            const std::string values = arguments_text(range);
            line("  {} = {}{}: {}, u = {}", range.text,
                 values == range.text ? std::string() : values + " = ", value_text(range.value),
                 draw_text(range.number), value_text(range.unit));
        }
    }

    /// The target of a sense module's question: "the environment `light` (shadow)", "the turtle".
    [[nodiscard]] std::string asked_text(const TracedModule& asking) const {
        const Sense sense = bytecode_.symbol(asking.symbol).sense;
        if (!asks_environment(sense)) {
            return "the turtle";
        }
        const BytecodeEnvironment& environment =
            bytecode_.environments[static_cast<std::size_t>(sense)];
        return fmt::format("the environment `{}` ({})", environment.name,
                           lsys::name_of(environment.kind));
    }

    /// Prints the outcome of the module in this pass. `word`: names the word that the positions
    /// refer to, such as " of generation 3"; empty: without positions.
    void outcome(const ModuleTrace& trace, const std::string& word) {
        switch (trace.fate) {
        case Fate::Cut:
            if (trace.cause == trace.position) {
                line("taken out, with the rest of its branch, before anything is rewritten");
            } else {
                line("taken out before anything is rewritten: the % at position {} cuts it off",
                     trace.cause);
            }
            return;
        case Fate::Consumed:
            line("consumed by the match of {} that begins at position {}", name(trace.production),
                 trace.cause);
            return;
        case Fate::Sensed:
            line("{} answers: {}", asked_text(trace.module), modules(trace.written));
            break;
        case Fate::Failed:
            line("{}", trace.fault.empty() ? std::string("the derivation ends here")
                                           : fmt::format("fails: {}", trace.fault));
            return;
        case Fate::Copied:
            if (trace.is_checked) {
                line("copied to position {}{}", trace.first_written, word);
            } else {
                line("copied");
            }
            break;
        case Fate::Rewritten:
            values(trace);
            if (!trace.is_checked) {
                line("would write: {}", modules(trace.written));
            } else if (trace.written.empty()) {
                line("writes nothing: the module is erased");
            } else if (word.empty()) {
                line("writes {}", modules(trace.written));
            } else {
                list(fmt::format("writes {}{}:",
                                 range_text(trace.first_written, trace.written.size()), word),
                     trace.written);
            }
            break;
        }
        if (trace.is_checked && !trace.agrees) {
            line("internal error: the engine wrote something else here; please report it");
        }
    }

    /// Whether all traces of the list belong to the same pass as `trace`.
    [[nodiscard]] bool is_only_pass(const std::vector<ModuleTrace>& list,
                                    const ModuleTrace& trace) const {
        return std::none_of(list.begin(), list.end(), [&](const ModuleTrace& other) {
            return other.kind != trace.kind || other.pass != trace.pass || other.rule != trace.rule;
        });
    }

    /// The title of a trace, "decomposition, pass 2: L(3) at position 5"; empty if the generation
    /// has only one pass.
    [[nodiscard]] std::string pass_head(const ModuleTrace& trace) const {
        const std::string where =
            fmt::format("{} at position {}", module(trace.module), trace.position);
        switch (trace.kind) {
        case DerivationPass::Kind::Cut:
            return {};
        case DerivationPass::Kind::Rewrite:
            return bytecode_.settings.rewriting == RewritingMode::Sequential && trace.was_run
                       ? fmt::format("sequential, pass of rule {}: {}", trace.rule, where)
                       : std::string();
        case DerivationPass::Kind::Decompose:
            return fmt::format("decomposition, pass {}: {}", trace.pass, where);
        case DerivationPass::Kind::Interpret:
            return fmt::format("interpretation, pass {}: {}", trace.pass, where);
        case DerivationPass::Kind::Sense:
            return fmt::format("sensing: {}", where);
        case DerivationPass::Kind::Down:
            return fmt::format("sweep down: {}", where);
        case DerivationPass::Kind::Up:
            return fmt::format("sweep up: {}", where);
        }
        return {};
    }

    /// The end of a title that says that an earlier pass has shown the applied production.
    [[nodiscard]] std::string again_text(const ModuleTrace& trace) const {
        const auto applies =
            std::find_if(trace.attempts.begin(), trace.attempts.end(),
                         [](const Attempt& each) { return each.verdict == Verdict::Applies; });
        if (applies == trace.attempts.end() || !framed_.contains(applies->production)) {
            return {};
        }
        return fmt::format(", {} again{}", name(applies->production),
                           applies->condition ? ": " + condition_text(*applies->condition)
                                              : std::string());
    }

    /// Prints the traces of one module. `start`: the position of the module.
    void
    traces(const std::vector<ModuleTrace>& list, std::uint64_t start, std::uint32_t generation) {
        std::size_t later = 0;
        std::size_t hidden = 0;
        framed_.clear();
        for (std::size_t i = 0; i < list.size(); ++i) {
            const ModuleTrace& trace = list[i];
            const bool is_later =
                trace.parent != kNoTrace && trace.fate != Fate::Consumed && !is_cause(list, trace);
            if (is_later && trace.fate == Fate::Copied) {
                continue;
            }
            if (is_later && ++later > kMaxLater) {
                ++hidden;
                continue;
            }
            const std::string title = pass_head(trace);
            if (!title.empty()) {
                line("{}{}", title, is_later ? again_text(trace) : std::string());
            } else if (is_cause(list, trace)) {
                line("the match begins with {} at position {}", module(trace.module),
                     trace.position);
            }
            if (trace.parent == kNoTrace && trace.position != start && title.empty() &&
                trace.kind == DerivationPass::Kind::Rewrite) {
                line("at position {} after the cuts of `%`", trace.position);
            }
            attempts(trace, is_later, std::nullopt);
            if (trace.choice && is_later) {
                brief_choice(*trace.choice);
            } else if (trace.choice) {
                choice(trace, *trace.choice);
            }
            const bool plain =
                trace.kind == DerivationPass::Kind::Rewrite && is_only_pass(list, trace);
            outcome(trace, is_later ? std::string()
                           : plain  ? fmt::format(" of generation {}", generation)
                           : trace.kind == DerivationPass::Kind::Interpret
                               ? std::string(" of the drawn word")
                               : std::string(" of the word of this pass"));
        }
        if (hidden != 0) {
            line("and {} in later passes; `--format json` has them all",
                 count_text(hidden, "more module", "more modules"));
        }
    }

    /// Whether the trace belongs to a match that consumed the traced module as a later module of
    /// its predecessor.
    [[nodiscard]] static bool is_cause(const std::vector<ModuleTrace>& list,
                                       const ModuleTrace& trace) {
        return trace.parent != kNoTrace && list[trace.parent].fate == Fate::Consumed;
    }

    void step(const TracedPlace& place) {
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

    void drawing(const TracedPlace& place) {
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

    // --- the step that wrote a module

    void written(const TracedPlace& place) {
        if (place.back.empty() && grammar_.is_module_file && !trace_.axiom) {
            return; // the heading is sufficient
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

    void written_by(const AncestorStep& step) {
        const std::uint32_t generation = step.generation + 1;
        if (generation < trace_.generation) {
            copies(generation + 1, trace_.generation);
        }
        const std::uint32_t replaced = step.steps.front().replaced;
        line("generation {}: in place of {}{} at {} of generation {}", generation,
             module(step.module),
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
            const bool plain = step.steps.size() == 1 &&
                               trace.kind == DerivationPass::Kind::Rewrite &&
                               bytecode_.settings.rewriting != RewritingMode::Sequential;
            outcome(trace, plain ? fmt::format(" of generation {}", generation) : std::string());
        }
    }

    /// The module of a successor that a trace wrote, with a label; nothing for a .lsb file.
    [[nodiscard]] std::optional<Label> successor_label(const ModuleTrace& trace,
                                                       std::uint64_t offset) const {
        if (trace.production == kNoProduction) {
            return std::nullopt; // an answer
        }
        const TableRange codes = production(trace.production).successor.codes;
        if (source_of(trace.production) == nullptr || offset >= codes.count) {
            return std::nullopt;
        }
        const std::uint32_t index = codes.first + static_cast<std::uint32_t>(offset);
        const std::optional<Site> place = lsys::place_of(bytecode_, index);
        return place ? std::optional(Label{place->span, module(trace.written[offset])})
                     : std::nullopt;
    }

    /// Prints the place of a module that a derivation begins with, and the choice of the axiom.
    void axiom(const TraceOrigin& origin, const TracedModule& written) {
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

    // --- following a module back to the axiom

    /// Prints the generations in which a module was only copied.
    void copies(std::uint32_t first, std::uint32_t last) {
        if (first == last) {
            line("generation {}: copied", first);
        } else {
            line("generations {} to {}: copied", first, last);
        }
    }

    void back(const TracedPlace& place) {
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

    void back_step(const AncestorStep& each) {
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

    /// Prints the line of the production with a label under the module that it wrote.
    void back_frame(const ModuleTrace& trace, std::uint64_t offset) {
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
                notes.labels.push_back(
                    {source->condition_span, condition_text(*attempt.condition)});
            }
        }
        if (notes.labels.empty()) {
            notes.labels.push_back({source->predecessor.span, module(trace.module)});
        }
        render_frame(notes.labels, *grammar_.sources, colour_, out_);
    }

    // --- the end

    void untraced_matches() {
        if (trace_.matches > trace_.places.size()) {
            out_ += '\n';
            const std::uint64_t more = trace_.matches - trace_.places.size();
            line("{} like it in generation {}, the next at position {}",
                 count_text(more, "more module is", "more modules are"), trace_.generation,
                 trace_.next_untraced);
        }
    }

    const Trace& trace_;
    const Grammar& grammar_;
    const Bytecode& bytecode_;
    bool colour_;                   // whether to use the colours of a terminal
    std::set<ProductionId> framed_; // productions that traces() has shown for later passes
    std::string out_;
};

} // namespace

std::string trace_text(const Trace& trace, const Grammar& grammar, bool colour) {
    return Report(trace, grammar, colour).run();
}

} // namespace lsys
