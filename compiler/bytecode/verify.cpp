// SPDX-License-Identifier: MIT
#include "compiler/bytecode/verify.h"

#include "compiler/bytecode/impl/bytecode_contents.h"
#include "compiler/bytecode/impl/verify_senses.h"
#include "compiler/bytecode/instructions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// A stream for describe_settings() that finds invalid enumerators and numbers that are not finite.
struct RangeCheck : IgnoringStream {
    bool all_enumerators = true;
    bool all_finite = true;

    RangeCheck& outside_digest() { return *this; }
    template <typename Enum>
    void tag(const Enum& value) {
        all_enumerators = all_enumerators && is_enumerator(value);
    }
    void real(const float& value) { all_finite = all_finite && std::isfinite(value); }
};

std::uint32_t number(SymbolId id) {
    return static_cast<std::uint32_t>(id);
}

/// The place in which a piece of code is used, which decides the instructions that the code may
/// have.
enum class CodePlace : std::uint8_t { Global, Axiom, Condition, Locals, Successor };

/// Verifies bytecode in one pass over the tables in the order that bytecode.h describes. A check
/// that fails calls fail(), which stores the message, and returns false.
class Verifier {
public:
    explicit Verifier(const Bytecode& bytecode) : bytecode_(bytecode) {}

    std::optional<std::string> run() {
        if (settings() && curves() && contours() && symbols() && folded() && sites() &&
            materials() && environments() && places() && globals() && axioms() && productions() &&
            ends()) {
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

    bool settings() {
        const Settings& s = bytecode_.settings;
        RangeCheck ranges;
        describe_settings(ranges, s);
        if (!ranges.all_enumerators) {
            return fail("a setting has a value that does not exist");
        }
        if (!ranges.all_finite) {
            return fail("a setting is not finite");
        }
#define LSYS_COUNT(field, initial, effect, group, min, max, wanted, misfit)                        \
    if (static_cast<std::int64_t>(s.field) < (min) || s.field > (max)) {                           \
        return fail(misfit, s.field);                                                              \
    }
#include "compiler/bytecode/settings.def"
        if (s.height != 0.0F && !(s.height >= kMinHeight && s.height <= kMaxHeight)) {
            return fail("a plant {} m high", s.height);
        }
        const bool is_exponent =
            s.pipe.exponent >= kMinPipeExponent && s.pipe.exponent <= kMaxPipeExponent;
        if (s.pipe != Pipe{} && !(is_exponent && s.pipe.tip_width >= 0.0F)) {
            return fail("a pipe model of exponent {} and width {}", s.pipe.exponent,
                        s.pipe.tip_width);
        }
        if (!(s.pipe.taper >= 0.0F && s.pipe.taper <= 1.0F)) {
            return fail("a pipe model of taper {}", s.pipe.taper);
        }
        const auto& [factor, height, roots] = s.flare;
        if (s.flare != Flare{} && !(factor >= 1.0F && factor <= kMaxFlare && height > 0.0F &&
                                    (roots == 0 || (roots >= kMinRoots && roots <= kMaxRoots)))) {
            return fail("a flare of factor {}, height {} and {} roots", factor, height, roots);
        }
        bool ended = false;
        for (const StepTropism& tropism : s.tropisms) {
            const bool is_used = tropism.kind != TropismKind::None;
            if (is_used ? ended : tropism != StepTropism{}) {
                return fail("a tropism behind the last one");
            }
            ended = !is_used;
        }
        if (!(s.collar >= 0.0F)) {
            return fail("a collar of factor {}", s.collar);
        }
        if (bytecode_.generations && *bytecode_.generations == kNone) {
            return fail("more generations than there can be");
        }
        return true;
    }

    bool curves() {
        for (std::size_t i = 0; i < bytecode_.curves.size(); ++i) {
            const std::vector<CurveKnot>& points = bytecode_.curves[i].points;
            if (points.size() < 2 || !is_printable(bytecode_.curves[i].name)) {
                return fail("curve {} has {} points", i, points.size());
            }
            for (std::size_t k = 0; k < points.size(); ++k) {
                if (!std::isfinite(points[k].x) || !std::isfinite(points[k].y) ||
                    (k > 0 && !(points[k - 1].x < points[k].x))) {
                    return fail("point {} of curve {} is out of place", k, i);
                }
            }
        }
        return true;
    }

    bool contours() {
        for (std::size_t i = 0; i < bytecode_.contours.size(); ++i) {
            const BytecodeContour& contour = bytecode_.contours[i];
            if (contour.points.size() < kMinContourPoints ||
                contour.points.size() > kMaxContourPoints || contour.name.empty() ||
                !is_printable(contour.name)) {
                return fail("contour {} has {} points", i, contour.points.size());
            }
            for (const ContourPoint& point : contour.points) {
                if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
                    return fail("a point of contour {} is not finite", i);
                }
            }
        }
        return true;
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

    bool materials() {
        const auto in_unit = [](float value) { return value >= 0.0F && value <= 1.0F; };
        const auto is_picture = [&](const BytecodePicture& picture) {
            return is_printable(picture.path) && site(picture.site);
        };
        std::uint64_t next = 0;
        for (const BytecodeMaterial& material : bytecode_.materials) {
            if (material.index < next || material.index > kMaxColourIndex) {
                return fail("a material of colour index {} is out of place", material.index);
            }
            next = std::uint64_t{material.index} + 1;
            if (!std::all_of(material.colour.begin(), material.colour.end(), in_unit) ||
                !in_unit(material.roughness) || !in_unit(material.translucency)) {
                return fail("a number of material {} is not from 0 to 1", material.index);
            }
            if (!is_picture(material.picture) || !is_picture(material.normal)) {
                return fail("a picture of material {} has no place", material.index);
            }
        }
        return true;
    }

    bool environments() {
        problem_ = environments_problem(bytecode_).value_or("");
        return problem_.empty();
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

    bool site(std::uint32_t index) const {
        return is_site(bytecode_, index);
    }

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
            begin_piece();
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
            begin_piece();
            if (p.condition != kNone &&
                !code(CodePlace::Condition, p.condition, {.formals = p.formal_count})) {
                return false;
            }
            begin_piece();
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
        begin_piece();
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

    /// Limits of the operands of a piece of code, and the number of values that it must produce.
    struct CodeBounds {
        std::uint32_t formals = 0;
        std::uint32_t globals = kNone; // kNone: no limit
        std::uint32_t draws = 0;
        std::uint32_t emits = 1;
    };

    /// Verifies one piece of code, which may also read the slots that earlier code of the same word
    /// has set.
    bool code(CodePlace place, std::uint32_t first, const CodeBounds& bounds) {
        const std::vector<std::uint32_t>& instructions = bytecode_.instructions;
        if (first != next_instruction_) {
            return fail("the code at {} does not follow the code before it", first);
        }
        const bool numbered_by_pass =
            (place == CodePlace::Successor || place == CodePlace::Locals) &&
            bytecode_.settings.rewriting == RewritingMode::Sequential;
        if (bounds.draws > (numbered_by_pass ? kMaxSequentialDraws : kMaxOperand)) {
            return fail("the code at {} draws {} times", first, bounds.draws);
        }
        std::uint32_t depth = 0;
        std::uint32_t taken_count = 0; // number of values that Emit or Test took
        choices_.clear();
        while (next_instruction_ < instructions.size()) {
            const std::uint64_t at = next_instruction_++;
            const std::uint32_t operand = instructions[at] >> 8;
            if ((instructions[at] & 0xFF) >= kOpcodeCount) {
                return fail("instruction {} does not exist", at);
            }
            const auto opcode = static_cast<Opcode>(instructions[at] & 0xFF);
            const OpcodeInfo& row = info(opcode);
            bool fits = false;
            switch (row.operand) {
            case OperandKind::None:
                fits = operand == 0;
                break;
            case OperandKind::Literal:
                fits = operand == 0 && next_instruction_++ < instructions.size();
                break;
            case OperandKind::Formal:
                fits = operand < bounds.formals;
                break;
            case OperandKind::Global:
                fits = operand < bytecode_.globals.size() && operand < bounds.globals;
                break;
            case OperandKind::Draw:
                fits = operand < bounds.draws && record_draw(operand);
                break;
            case OperandKind::Branch:
                fits = true;
                break;
            case OperandKind::Local:
                fits = operand < bytecode_.local_count && slot(opcode, operand);
                break;
            case OperandKind::Curve:
                fits = operand < bytecode_.curves.size();
                break;
            case OperandKind::Skip:
                fits = true; // choice() checks the operand
                break;
            }
            if (!fits || !allowed(place, opcode)) {
                return fail("instruction {} ({}) is not allowed there", at, row.mnemonic);
            }
            if (row.pops > depth) {
                return fail("instruction {} ({}) lacks values", at, row.mnemonic);
            }
            depth = depth - row.pops + row.pushes;
            if (!choice(opcode, at, operand, depth)) {
                return fail("instruction {} ({}) does not fit its choice", at, row.mnemonic);
            }
            if (opcode == Opcode::Emit || opcode == Opcode::Test) {
                ++taken_count;
            }
            if (opcode == Opcode::End) {
                return (depth == 0 && taken_count == bounds.emits && choices_.empty()) ||
                       fail("the code at {} leaves a wrong number of values", first);
            }
        }
        return fail("the code at {} has no end", first);
    }

    /// Records the use of draw `number`. Returns false if this word or constant has used it
    /// already. Numbers of draws that constant folding removed stay unused.
    bool record_draw(std::uint32_t number) {
        draw_is_seen_.resize(std::max<std::size_t>(draw_is_seen_.size(), std::size_t{number} + 1));
        const bool is_first = !draw_is_seen_[number];
        draw_is_seen_[number] = true;
        return is_first;
    }

    /// Begins a word, constant or condition, which shares neither slots nor draws with others.
    void begin_piece() {
        end_slots(0);
        draw_is_seen_.clear();
    }

    /// Sets the slot if `opcode` is SetLocal; returns whether the slot has a value. Values set in
    /// one side of a choice are lost at the end of that side.
    bool slot(Opcode opcode, std::uint32_t index) {
        is_set_.resize(std::max<std::size_t>(is_set_.size(), std::size_t{index} + 1));
        if (opcode == Opcode::SetLocal && !is_set_[index]) {
            is_set_[index] = true;
            set_slots_.push_back(index);
        }
        return is_set_[index];
    }

    /// Clears all slots but the `count` that were set first.
    void end_slots(std::size_t count) {
        for (; set_slots_.size() > count; set_slots_.pop_back()) {
            is_set_[set_slots_.back()] = false;
        }
    }

    /// Whether an instruction fits the open choices: If skips to the instruction after its Else,
    /// Else to the one after its EndIf, each side leaves one value, and Emit and Test are outside
    /// of choices. `depth`: stack depth after the instruction.
    bool choice(Opcode opcode, std::uint64_t at, std::uint32_t operand, std::uint32_t depth) {
        if (opcode == Opcode::If) {
            choices_.push_back({at + operand + 1, depth, set_slots_.size(), false});
            return true;
        }
        if (opcode != Opcode::Else && opcode != Opcode::EndIf) {
            return (opcode != Opcode::Emit && opcode != Opcode::Test) || choices_.empty();
        }
        if (choices_.empty()) {
            return false;
        }
        Choice& open = choices_.back();
        end_slots(open.slots);
        if (opcode == Opcode::Else) {
            const bool fits = !open.has_else && open.next == at + 1 && depth == open.depth + 1;
            open.has_else = true;
            open.next = at + operand + 1;
            return fits;
        }
        const bool fits = open.has_else && open.next == at + 1 && depth == open.depth;
        choices_.pop_back();
        return fits;
    }

    bool allowed(CodePlace place, Opcode opcode) const {
        const bool in_production = place == CodePlace::Condition || place == CodePlace::Locals ||
                                   place == CodePlace::Successor;
        switch (opcode) {
        case Opcode::Step:
            return in_production;
        case Opcode::BranchDraw:
            return place == CodePlace::Successor;
        case Opcode::Steps:
            return bytecode_.uses_steps && in_production;
        case Opcode::Emit:
            return place != CodePlace::Condition && place != CodePlace::Locals;
        case Opcode::Test:
            return place == CodePlace::Condition;
        default:
            return true;
        }
    }

    bool ends() {
        if (next_pattern_ != bytecode_.patterns.size() ||
            next_code_ != bytecode_.template_codes.size() ||
            next_instruction_ != bytecode_.instructions.size()) {
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
    /// A choice whose EndIf has not been read yet.
    struct Choice {
        std::uint64_t next = 0;  // target of the skip of its If or Else
        std::uint32_t depth = 0; // stack depth, condition included
        std::size_t slots = 0;   // number of slots set before the choice
        bool has_else = false;
    };
    std::vector<Choice> choices_;
    std::vector<std::uint32_t> set_slots_; // slots with a value, in the order of setting
    std::vector<bool> is_set_;             // by slot: whether it has a value
    std::vector<bool> draw_is_seen_;       // per random draw of the current word or constant
    // The first elements of the tables that no part of the program so far has.
    std::uint64_t next_pattern_ = 0;
    std::uint64_t next_code_ = 0;
    std::uint64_t next_instruction_ = 0;
};

} // namespace

std::optional<std::string> verify(const Bytecode& bytecode) {
    return Verifier(bytecode).run();
}

} // namespace lsys
