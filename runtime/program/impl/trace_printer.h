// SPDX-License-Identifier: MIT
// The text of a trace, which people read: its paragraphs, by the question that they answer.
#pragma once

#include "grammar/rendering/render_diagnostic.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

/// Max width of a line that joins shorter lines.
inline constexpr std::size_t kMaxTraceColumns = 96;

/// The shortest text of a number, or "not a number", "infinity", "-infinity".
[[nodiscard]] std::string value_text(float value);
/// "1 branch", "2 branches".
[[nodiscard]] std::string
count_text(std::uint64_t count, std::string_view one, std::string_view several);

/// Writes a trace as text. Functions without a result append lines to the text.
class TracePrinter {
public:
    TracePrinter(const Trace& trace, const Grammar& grammar, bool colour)
        : trace_(trace), grammar_(grammar), bytecode_(grammar.bytecode), colour_(colour) {}

    std::string run();

private:
    [[nodiscard]] const BytecodeProduction& production(ProductionId id) const;
    /// The production in the Program, which has the places of its parts; null for a .lsb file.
    [[nodiscard]] const Production* source_of(ProductionId id) const;
    [[nodiscard]] std::string module(const TracedModule& module) const;
    [[nodiscard]] std::string name(ProductionId id) const;
    /// The name of a production, with the keyword of a stage other than rewriting: "`#decompose
    /// leaf`".
    [[nodiscard]] std::string full_name(ProductionId id) const;
    [[nodiscard]] std::string site_text(const Site& site) const;
    [[nodiscard]] std::string place_of(ProductionId id) const;
    template <typename... Arguments>
    void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Arguments>(arguments)...);
        out_ += '\n';
    }

    /// `text` in green, if the report has colours.
    [[nodiscard]] std::string marked(std::string_view text) const;

    // --- the module

    [[nodiscard]] std::string origin_text(const TraceOrigin& origin) const;

    void head(const TracedPlace& place);

    // --- productions that were tried

    /// The text of a label with the modules that a context search visited.
    [[nodiscard]] std::string visited_text(const ContextTrace& context) const;
    [[nodiscard]] static std::string passed_text(const ContextTrace& context);
    [[nodiscard]] std::string pattern_text(TableRange pattern, std::uint32_t item) const;
    [[nodiscard]] std::string
    context_text(const ContextTrace& context, TableRange pattern, bool is_left) const;

    /// Notes on a production: labels in its source line, or lines of text for a .lsb file.
    struct Notes {
        std::vector<Label> labels;
        std::vector<std::string> texts;
    };
    static void add(Notes& notes, const char* what, SourceSpan span, std::string text);
    void print(const Notes& notes, const Production* source);

    /// Prints the notes on a production that was tried, beginning with the reason why it does not
    /// apply. `written`: an additional label, of a module of the successor.
    void explain(const Attempt& attempt,
                 const TracedModule& traced,
                 const std::optional<Label>& written);

    [[nodiscard]] std::string followed_text(const Attempt& attempt,
                                            const TracedModule& traced) const;

    /// Whether the frame of `primary` also shows `other`: a frame is one line, cut if it is long.
    [[nodiscard]] bool in_one_frame(SourceSpan primary, SourceSpan other) const;

    /// The reason why a production does not apply, as the end of a line; may be empty.
    [[nodiscard]] std::string reason_text(const Attempt& attempt, const TracedModule& traced) const;
    /// The comparisons of a condition with their values.
    [[nodiscard]] static std::string reasons_text(const ExpressionTrace& condition);

    /// The last operation of a condition, which gives its value.
    static std::string condition_text(const ExpressionTrace& condition);
    /// A line under a frame: an operation and its values.
    struct PartLine {
        std::string text;
        std::string values;
        std::size_t operations = 0; // number of operations in `text`
    };
    /// Prints the operations of a condition before the last, which is the label of the frame. A
    /// comparison shares its line with the arithmetic before it.
    void parts(const ExpressionTrace& condition);
    /// Whether all operations from `first` on are operands of the operation `last`.
    static bool is_within(const ExpressionTrace& condition, std::size_t first, std::size_t last);
    /// Adds the operations [first, end) in one line, or each in its own if the line is too long.
    static void add_part_lines(const ExpressionTrace& condition,
                               std::size_t first,
                               std::size_t end,
                               std::vector<PartLine>& lines);

    /// Prints a production that was tried. `is_later`: the module was written in this step, which
    /// shortens the text. `is_brief`: one line if the production does not apply. `written`: a label
    /// for a module of the successor of the production that applies.
    void attempt(const ModuleTrace& trace,
                 const Attempt& attempt,
                 bool is_later,
                 bool is_brief,
                 const std::optional<Label>& written);

    void attempts(const ModuleTrace& trace, bool is_later, const std::optional<Label>& written);

    void choice(const ModuleTrace& trace, const ChoiceTrace& choice);
    void brief_choice(const ChoiceTrace& choice);
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
    [[nodiscard]] static std::string draw_text(std::uint64_t number);

    // --- written modules

    [[nodiscard]] std::string modules(const std::vector<TracedModule>& list) const;
    /// Prints modules behind `title`, or below it if the line is too long.
    void list(const std::string& title, const std::vector<TracedModule>& written);
    [[nodiscard]] static std::string range_text(std::uint64_t first, std::size_t count);

    /// A range or distribution with the values of its arguments: "{1, 2}", "normal(4, 0.25)".
    [[nodiscard]] static std::string arguments_text(const TracedRange& range);

    void values(const ModuleTrace& trace);

    /// The target of a sense module's question: "the environment `light` (shadow)", "the turtle".
    [[nodiscard]] std::string asked_text(const TracedModule& asking) const;

    /// Prints the outcome of the module in this pass. `word`: names the word that the positions
    /// refer to, such as " of generation 3"; empty: without positions.
    void outcome(const ModuleTrace& trace, const std::string& word);

    /// Whether all traces of the list belong to the same pass as `trace`.
    [[nodiscard]] bool is_only_pass(const std::vector<ModuleTrace>& list,
                                    const ModuleTrace& trace) const;

    /// The title of a trace, "decomposition, pass 2: L(3) at position 5"; empty if the generation
    /// has only one pass.
    [[nodiscard]] std::string pass_head(const ModuleTrace& trace) const;

    /// The end of a title that says that an earlier pass has shown the applied production.
    [[nodiscard]] std::string again_text(const ModuleTrace& trace) const;

    /// Prints the traces of one module. `start`: the position of the module.
    void
    traces(const std::vector<ModuleTrace>& list, std::uint64_t start, std::uint32_t generation);

    /// Whether the trace belongs to a match that consumed the traced module as a later module of
    /// its predecessor.
    [[nodiscard]] static bool is_cause(const std::vector<ModuleTrace>& list,
                                       const ModuleTrace& trace);

    void step(const TracedPlace& place);

    void drawing(const TracedPlace& place);

    // --- the step that wrote a module

    void written(const TracedPlace& place);

    void written_by(const AncestorStep& step);

    /// The module of a successor that a trace wrote, with a label; nothing for a .lsb file.
    [[nodiscard]] std::optional<Label> successor_label(const ModuleTrace& trace,
                                                       std::uint64_t offset) const;

    /// Prints the place of a module that a derivation begins with, and the choice of the axiom.
    void axiom(const TraceOrigin& origin, const TracedModule& written);

    // --- following a module back to the axiom

    /// Prints the generations in which a module was only copied.
    void copies(std::uint32_t first, std::uint32_t last);

    void back(const TracedPlace& place);

    void back_step(const AncestorStep& each);

    /// Prints the line of the production with a label under the module that it wrote.
    void back_frame(const ModuleTrace& trace, std::uint64_t offset);

    // --- the end

    void untraced_matches();

    const Trace& trace_;
    const Grammar& grammar_;
    const Bytecode& bytecode_;
    bool colour_;                   // whether to use the colours of a terminal
    std::set<ProductionId> framed_; // productions that traces() has shown for later passes
    std::string out_;
};

} // namespace lsys
