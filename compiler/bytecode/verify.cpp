// SPDX-License-Identifier: MIT
#include "compiler/bytecode/verify.h"

#include "compiler/bytecode/impl/bytecode_contents.h"
#include "compiler/bytecode/impl/verify_code.h"
#include "compiler/bytecode/impl/verify_parts.h"
#include "compiler/bytecode/instructions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace lsys {

namespace {

std::uint32_t number(SymbolId id) {
    return static_cast<std::uint32_t>(id);
}

/// Verifies bytecode in one pass over the tables in the order that bytecode.h describes. A check
/// that fails calls fail(), which stores the message, and returns false.
class Verifier {
public:
    explicit Verifier(const Bytecode& bytecode) : bytecode_(bytecode), code_(bytecode) {}

    std::optional<std::string> run() {
        if (has_no(settings_problem(bytecode_)) && has_no(curves_problem(bytecode_)) &&
            has_no(contours_problem(bytecode_)) && symbols() && folded() && sites() &&
            has_no(materials_problem(bytecode_)) && has_no(environments_problem(bytecode_)) &&
            places() && globals() && axioms() && productions() && ends()) {
            return std::nullopt;
        }
        return std::move(problem_);
    }

private:
    template <typename... Values>
    bool fail(fmt::format_string<Values...> format, Values&&... values) {
        problem_ = fmt::format(format, std::forward<Values>(values)...);
        return false;
    }

    /// Stores the problem if there is one.
    bool has_no(std::optional<std::string> problem) {
        problem_ = std::move(problem).value_or("");
        return problem_.empty();
    }

    /// Whether the symbol sets a contour that does not exist.
    [[nodiscard]] bool lacks_contour(const BytecodeSymbol& symbol) const {
        return symbol.turtle == TurtleOperation::SetContour && !symbol.mesh_file.empty() &&
               std::ranges::find(bytecode_.contours, symbol.mesh_file, &BytecodeContour::name) ==
                   bytecode_.contours.end();
    }

    bool symbols() {
        for (std::size_t i = 0; i < bytecode_.symbols.size(); ++i) {
            const BytecodeSymbol& symbol = bytecode_.symbols[i];
            if (symbol.name.empty() || !is_printable(symbol.name)) {
                return fail("symbol {} has no printable name", i);
            }
            if (!is_enumerator(symbol.kind) || !is_enumerator(symbol.turtle)) {
                return fail("symbol {} is of no known kind", i);
            }
            const bool saves_branch = symbol.turtle == TurtleOperation::SaveBranch;
            if (saves_branch && (symbol.kind != SymbolKind::BranchOpen ||
                                 symbol.parameter_count < kBranchArguments)) {
                return fail("symbol {} is not a branch", i);
            }
            const bool plain = symbol.kind == SymbolKind::Plain;
            if (symbol.parameter_count > (plain || saves_branch ? kMaxOperand : 0)) {
                return fail("symbol {} has {} parameters", i, symbol.parameter_count);
            }
            if (symbol.senses() && (!plain || !is_sense(symbol.sense))) {
                return fail("symbol {} senses nothing that there is", i);
            }
            if (lacks_contour(symbol)) {
                return fail("symbol {} sets a contour that does not exist", i);
            }
            parameters_.push_back(symbol.parameter_count);
        }
        const std::uint64_t count =
            std::uint64_t{bytecode_.symbols.size()} + bytecode_.folded.size();
        return count < kNone || fail("{} codes", count);
    }

    /// Whether `sense` is a value that a symbol may have.
    [[nodiscard]] bool is_sense(Sense sense) const {
        return asks_environment(sense)
                   ? static_cast<std::size_t>(sense) < bytecode_.environments.size()
                   : sense >= Sense::Position && sense <= Sense::Left;
    }

    bool folded() {
        std::uint64_t next = 0;
        for (std::size_t i = 0; i < bytecode_.folded.size(); ++i) {
            const FoldedModule& module = bytecode_.folded[i];
            if (number(module.symbol) >= bytecode_.symbols.size() ||
                bytecode_.symbol(module.symbol).parameter_count == 0) {
                return fail("folded module {} is of no symbol with parameters", i);
            }
            if (bytecode_.symbol(module.symbol).senses()) {
                return fail("folded module {} has no room for an answer", i);
            }
            if (module.first_constant != next) {
                return fail("folded module {} does not follow the one before it", i);
            }
            next += bytecode_.symbol(module.symbol).parameter_count;
        }
        if (next != bytecode_.constants.size()) {
            return fail("{} constants, {} needed", bytecode_.constants.size(), next);
        }
        for (const float constant : bytecode_.constants) {
            if (!std::isfinite(constant)) {
                return fail("a folded argument is not finite");
            }
        }
        return true;
    }

    bool sites() {
        for (std::size_t i = 0; i < bytecode_.sites.size(); ++i) {
            const SourceSpan span = bytecode_.sites[i].span;
            if (static_cast<std::uint32_t>(span.file) >= bytecode_.files.size() ||
                span.begin > span.end) {
                return fail("site {} lies in no file", i);
            }
        }
        std::uint64_t next = 0;
        for (std::size_t i = 0; i < bytecode_.site_ranges.size(); ++i) {
            const SiteRange range = bytecode_.site_ranges[i];
            if (range.site >= bytecode_.sites.size() || range.instruction < next ||
                range.instruction >= bytecode_.instructions.size()) {
                return fail("site range {} is out of place", i);
            }
            next = std::uint64_t{range.instruction} + 1;
        }
        return true;
    }

    /// Checks each row of template_places; has_places() checks that each word begins a run.
    bool places() {
        const std::vector<PlaceRun>& runs = bytecode_.template_places;
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const PlaceRun& run = runs[i];
            const std::uint64_t end =
                i + 1 < runs.size() ? runs[i + 1].first : bytecode_.template_codes.size();
            if (run.first >= end) {
                return fail("place run {} is empty", i);
            }
            const std::uint64_t count = end - run.first;
            if (run.line == 0 || run.column == 0 || run.length == 0 ||
                (run.stride < run.length && (count > 1 || run.stride != 0))) {
                return fail("place run {} is malformed", i);
            }
            // Bytes from the first module of the run to its last.
            const std::uint64_t distance = (count - 1) * run.stride;
            if (distance + run.begin + run.length > kNone || distance + run.column > kNone) {
                return fail("place run {} ends beyond every file", i);
            }
        }
        return true;
    }

    /// Whether a run begins with the word, and the file of its places is known.
    bool has_places(const WordTemplate& word, std::uint32_t site) {
        const std::vector<PlaceRun>& runs = bytecode_.template_places;
        if (runs.empty() || word.codes.count == 0) {
            return true;
        }
        const auto run = std::lower_bound(
            runs.begin(), runs.end(), word.codes.first,
            [](const PlaceRun& each, std::uint32_t first) { return each.first < first; });
        return site != kNone && run != runs.end() && run->first == word.codes.first;
    }

    bool site(std::uint32_t index) const { return is_site(bytecode_, index); }

    bool globals() {
        if (bytecode_.globals.size() > kMaxOperand) {
            return fail("{} globals", bytecode_.globals.size());
        }
        for (std::size_t i = 0; i < bytecode_.globals.size(); ++i) {
            const BytecodeGlobal& global = bytecode_.globals[i];
            if (!site(global.site) || !is_printable(global.name)) {
                return fail("global {} has no place", i);
            }
            if (!std::isfinite(global.minimum) || !std::isfinite(global.maximum) ||
                global.minimum > global.maximum) {
                return fail("global {} has invalid bounds", i);
            }
            code_.begin_piece();
            if (!code(CodePlace::Global, global.instruction,
                      {.globals = static_cast<std::uint32_t>(i), .draws = global.draw_count})) {
                return false;
            }
        }
        return true;
    }

    bool axioms() {
        if (bytecode_.axioms.empty()) {
            return fail("there is no axiom");
        }
        for (const BytecodeAxiom& axiom : bytecode_.axioms) {
            if (!site(axiom.site)) {
                return fail("an axiom has no place");
            }
            if (axiom.word.codes.count == 0) {
                return fail("an axiom is empty");
            }
            if (!(std::isfinite(axiom.weight) && axiom.weight > 0.0F)) {
                return fail("an axiom has a probability of {}", axiom.weight);
            }
            if (!has_places(axiom.word, axiom.site)) {
                return fail("the modules of an axiom have no places");
            }
            if (!word(CodePlace::Axiom, axiom.word, 0)) {
                return false;
            }
        }
        return true;
    }

    bool productions() {
        std::vector<std::uint32_t> rule_example;
        std::vector<std::uint32_t> group_example;
        for (std::size_t i = 0; i < bytecode_.productions.size(); ++i) {
            const BytecodeProduction& p = bytecode_.productions[i];
            if (p.name.empty() || !is_printable(p.name) || !site(p.name_site)) {
                return fail("production {} has no name or no place", i);
            }
            if (!is_enumerator(p.stage) ||
                (i > 0 && p.stage < bytecode_.productions[i - 1].stage)) {
                return fail("production {} is out of its stage", i);
            }
            if (p.stage != Stage::Rewrite &&
                ((p.has_left && p.stage != Stage::Up) || (p.has_right && p.stage != Stage::Down) ||
                 p.predecessor.count != 1)) {
                return fail("production {} has more than one module", i);
            }
            if ((p.stage == Stage::Down || p.stage == Stage::Up) &&
                !changes_only_parameters(bytecode_, p)) {
                return fail("production {} of a sweep changes more than parameters", i);
            }
            const bool is_computed =
                p.weight_code != kNone && bytecode_.settings.weights == WeightRule::Any;
            const bool weight_fits =
                p.weight_code != kNone ? p.stochastic && p.weight == 0.0F && is_computed
                : p.stochastic
                    ? std::isfinite(p.weight) && p.weight > 0.0F &&
                          (p.weight <= 1.0F || bytecode_.settings.weights == WeightRule::Any)
                    : p.weight == 0.0F;
            if (!weight_fits) {
                return fail("production {} has a probability of {}", i, p.weight);
            }
            if (!head(i, p) || !rule_or_group(i, p.rule, rule_example, false) ||
                !rule_or_group(i, p.group, group_example, true)) {
                return false;
            }
            code_.begin_piece();
            if (p.condition != kNone &&
                !code(CodePlace::Condition, p.condition, {.formals = p.formal_count})) {
                return false;
            }
            code_.begin_piece();
            if (p.weight_code != kNone &&
                !code(CodePlace::Condition, p.weight_code, {.formals = p.formal_count})) {
                return false;
            }
            if (!word(CodePlace::Successor, p.successor, p.formal_count)) {
                return false;
            }
            if (!has_places(p.successor, p.name_site)) {
                return fail("the modules of production {} have no places", i);
            }
        }
        if (rule_example.size() != bytecode_.rule_count ||
            group_example.size() != bytecode_.context_group_count) {
            return fail("{} rules and {} groups are named, {} and {} found", bytecode_.rule_count,
                        bytecode_.context_group_count, rule_example.size(), group_example.size());
        }
        return true;
    }

    /// Checks that rule or group `index` of a production is numbered by first appearance, and that
    /// its members have equal predecessors and, in a group (`with_contexts`), equal contexts.
    /// `examples`: the first production of each rule or group.
    bool rule_or_group(std::size_t production,
                       std::uint32_t index,
                       std::vector<std::uint32_t>& examples,
                       bool with_contexts) {
        const char* kind = with_contexts ? "group" : "rule";
        if (index > examples.size()) {
            return fail("production {} has {} {}, which no earlier production begins", production,
                        kind, index);
        }
        if (index == examples.size()) {
            examples.push_back(static_cast<std::uint32_t>(production));
            return true;
        }
        const BytecodeProduction& example = bytecode_.productions[examples[index]];
        const BytecodeProduction& p = bytecode_.productions[production];
        const bool same =
            example.stage == p.stage && same_pattern(example.predecessor, p.predecessor) &&
            (!with_contexts ||
             (same_pattern(example.left, p.left) && same_pattern(example.right, p.right)));
        return same || fail("production {} does not fit {} {}", production, kind, index);
    }

    bool same_pattern(TableRange a, TableRange b) const {
        if (a.count != b.count) {
            return false;
        }
        for (std::uint32_t i = 0; i < a.count; ++i) {
            const PatternItem& x = bytecode_.patterns[a.first + i];
            const PatternItem& y = bytecode_.patterns[b.first + i];
            if (x.kind != y.kind || x.symbol != y.symbol) {
                return false;
            }
        }
        return true;
    }

    bool head(std::size_t index, const BytecodeProduction& p) {
        std::uint64_t formals = 0;
        if (!pattern(index, p.left, formals, false) ||
            !pattern(index, p.predecessor, formals, false) ||
            !pattern(index, p.right, formals, true)) {
            return false;
        }
        if (p.has_left != (p.left.count != 0) || p.has_right != (p.right.count != 0)) {
            return fail("production {} has an empty context", index);
        }
        const bool several = bytecode_.settings.rewriting != RewritingMode::Parallel;
        if (p.predecessor.count == 0 || (p.predecessor.count > 1 && !several)) {
            return fail("production {} has {} modules to rewrite", index, p.predecessor.count);
        }
        if (formals != p.formal_count || formals > kMaxOperand) {
            return fail("production {} has {} formals, not {}", index, formals, p.formal_count);
        }
        return true;
    }

    /// Checks a context or predecessor of production `index`. Adds its formals to `formals`, the
    /// number of formals before it. `brackets`: whether the pattern may have brackets.
    bool pattern(std::size_t index, TableRange range, std::uint64_t& formals, bool brackets) {
        if (!consecutive(range, next_pattern_, bytecode_.patterns.size())) {
            return fail("production {} has a pattern out of place", index);
        }
        std::uint64_t depth = 0;
        for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
            const PatternItem& item = bytecode_.patterns[i];
            switch (item.kind) {
            case PatternKind::Module:
                if (number(item.symbol) >= bytecode_.symbols.size() ||
                    item.first_formal != formals) {
                    return fail("pattern item {} is malformed", i);
                }
                formals += bytecode_.symbol(item.symbol).parameter_count;
                break;
            case PatternKind::Open:
                ++depth;
                break;
            case PatternKind::Close:
                if (depth == 0) {
                    return fail("pattern item {} closes no open bracket", i);
                }
                --depth;
                break;
            default:
                return fail("pattern item {} is of no known kind", i);
            }
            if (item.kind != PatternKind::Module && !brackets) {
                return fail("pattern item {} is a bracket", i);
            }
        }
        return depth == 0 || fail("production {} has an open bracket in its context", index);
    }

    /// Whether `range` begins at `next` and ends within a table of `size` rows. Moves `next` to the
    /// end of the range.
    static bool consecutive(TableRange range, std::uint64_t& next, std::size_t size) {
        if (range.first != next || range.count > size - next) {
            return false;
        }
        next += range.count;
        return true;
    }

    bool word(CodePlace place, const WordTemplate& word, std::uint32_t formals) {
        if (!consecutive(word.codes, next_code_, bytecode_.template_codes.size())) {
            return fail("a successor's codes are out of place");
        }
        std::uint64_t stored = 0;
        const Code code_count = bytecode_.code_count();
        for (const Code code :
             std::span(bytecode_.template_codes).subspan(word.codes.first, word.codes.count)) {
            if (code >= code_count) {
                return fail("code {} does not exist", code);
            }
            stored += code < parameters_.size() ? parameters_[code] : 0;
        }
        if (stored != word.parameter_count || (stored == 0) != (word.arguments == kNone)) {
            return fail("a successor stores {} parameters, not {}", stored, word.parameter_count);
        }
        code_.begin_piece();
        if (word.locals != kNone &&
            (place != CodePlace::Successor ||
             !code(CodePlace::Locals, word.locals,
                   {.formals = formals, .draws = word.draw_count, .emits = 0}))) {
            return problem_.empty() ? fail("only a successor has local values") : false;
        }
        if (word.arguments == kNone) {
            return word.draw_count == 0 || word.locals != kNone ||
                   fail("a successor without arguments draws");
        }
        return code(place, word.arguments,
                    {.formals = formals, .draws = word.draw_count, .emits = word.parameter_count});
    }

    bool code(CodePlace place, std::uint32_t first, const CodeBounds& bounds) {
        return has_no(code_.problem(place, first, bounds));
    }

    /// Whether the productions use all of each table, and the stated sizes of the stack and of the
    /// slots are those that the code needs.
    bool ends() {
        if (next_pattern_ != bytecode_.patterns.size() ||
            next_code_ != bytecode_.template_codes.size() ||
            code_.next() != bytecode_.instructions.size()) {
            return fail("a table holds more than the productions use");
        }
        const CodeNeeds needs = needs_of(bytecode_.instructions);
        return (needs.stack_depth == bytecode_.stack_depth &&
                needs.local_count == bytecode_.local_count) ||
               fail("a stack of {} values and {} slots, not {} and {}", needs.stack_depth,
                    needs.local_count, bytecode_.stack_depth, bytecode_.local_count);
    }

    const Bytecode& bytecode_;
    std::vector<std::uint32_t> parameters_; // per symbol: number of parameters
    std::string problem_;
    // Index of the first pattern and of the first template code that no part checked so far uses.
    std::uint64_t next_pattern_ = 0;
    std::uint64_t next_code_ = 0;
    CodeVerifier code_;
};

} // namespace

std::optional<std::string> verify(const Bytecode& bytecode) {
    return Verifier(bytecode).run();
}

} // namespace lsys
