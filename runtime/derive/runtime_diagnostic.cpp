// SPDX-License-Identifier: MIT
#include "runtime/derive/runtime_diagnostic.h"

#include "compiler/bytecode/distributions.h"
#include "compiler/bytecode/instructions.h"
#include "runtime/base/random.h"
#include "runtime/derive/stream.h"
#include "runtime/derive/word_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

namespace {

std::string number(float value) {
    if (std::isnan(value)) {
        return "not a number";
    }
    if (std::isinf(value)) {
        return value > 0.0F ? "infinite" : "minus infinite";
    }
    std::string text;
    append_number(value, text);
    return text;
}

std::string module_text(const RuntimeError& error, const Bytecode& bytecode) {
    std::string text =
        spelled_name(bytecode.symbol(error.symbol).name, bytecode.settings.print_letters);
    for (std::size_t i = 0; i < error.parameters.size(); ++i) {
        text += i == 0 ? '(' : ',';
        append_number(error.parameters[i], text);
    }
    return error.parameters.empty() ? text : text + ')';
}

/// The part of the grammar in which the error occurred: "production `p`", "the axiom", "constant
/// `c`".
std::string owner(const RuntimeError& error, const Bytecode& bytecode) {
    if (error.global != kNone) {
        return fmt::format("constant `{}`", bytecode.globals[error.global].name);
    }
    if (error.production == kNoProduction) {
        return "the axiom";
    }
    return fmt::format("production `{}`",
                       bytecode.productions[static_cast<std::size_t>(error.production)].name);
}

/// Points the diagnostic to a site, or adds a note that names the place if there is no source text.
void place(Diagnostic& diagnostic,
           std::uint32_t site,
           const Bytecode& bytecode,
           bool sources_loaded) {
    if (site == kNone) {
        return;
    }
    const Site& at = bytecode.sites[site];
    if (sources_loaded) {
        diagnostic.span = at.span;
        return;
    }
    const std::string& file = bytecode.files[static_cast<std::size_t>(at.span.file)];
    diagnostic.notes.push_back(fmt::format("at {}:{}:{}", file, at.line, at.column));
    diagnostic.facts.push_back({"file", file});
    diagnostic.facts.push_back({"line", std::uint64_t{at.line}});
    diagnostic.facts.push_back({"column", std::uint64_t{at.column}});
}

/// The verb for the stage of the production.
const char* verb_of(const RuntimeError& error, const Bytecode& bytecode) {
    switch (error.production == kNoProduction
                ? Stage::Rewrite
                : bytecode.productions[static_cast<std::size_t>(error.production)].stage) {
    case Stage::Rewrite:
        break;
    case Stage::Decompose:
        return "decomposing";
    case Stage::Interpret:
        return "interpreting";
    case Stage::Down:
    case Stage::Up:
        return "sweeping";
    }
    return "rewriting";
}

void note_module(Diagnostic& diagnostic, const RuntimeError& error, const Bytecode& bytecode) {
    if (error.global != kNone) {
        diagnostic.notes.emplace_back("drawn when the derivation starts");
    } else if (error.generation == kStartGeneration) {
        diagnostic.notes.push_back(
            fmt::format("module {} of the axiom (counted from 0)", grouped_digits(error.position)));
    } else {
        diagnostic.notes.push_back(fmt::format(
            "while {} `{}`, module {} of generation {} (counted from 0)", verb_of(error, bytecode),
            module_text(error, bytecode), grouped_digits(error.position), error.generation));
    }
}

/// Adds the production, the module and its place in the word as facts, for programs that read JSON.
void add_facts(Diagnostic& diagnostic, const RuntimeError& error, const Bytecode& bytecode) {
    if (error.global != kNone) {
        diagnostic.facts.push_back({"constant", bytecode.globals[error.global].name});
        return;
    }
    if (error.production != kNoProduction) {
        const BytecodeProduction& production =
            bytecode.productions[static_cast<std::size_t>(error.production)];
        diagnostic.facts.push_back({"production", production.name});
        diagnostic.facts.push_back(
            {"stage", std::string(production.stage == Stage::Rewrite ? "rewriting"
                                                                     : verb_of(error, bytecode))});
    }
    if (error.generation == kStartGeneration) {
        diagnostic.facts.push_back({"axiom_position", error.position});
        return;
    }
    diagnostic.facts.push_back({"generation", std::uint64_t{error.generation}});
    if (error.symbol == kNoSymbol) {
        return; // no module is involved
    }
    diagnostic.facts.push_back({"position", error.position});
    diagnostic.facts.push_back({"module", module_text(error, bytecode)});
}

/// The operations of an expression.
std::vector<Opcode> operations_at(std::uint32_t site, const Bytecode& bytecode) {
    std::vector<Opcode> found;
    for (std::size_t i = 0; i < bytecode.site_ranges.size() && site != kNone; ++i) {
        if (bytecode.site_ranges[i].site != site) {
            continue;
        }
        const auto end = i + 1 < bytecode.site_ranges.size()
                             ? bytecode.site_ranges[i + 1].instruction
                             : static_cast<std::uint32_t>(bytecode.instructions.size());
        for (const Instruction each :
             InstructionRange(bytecode.instructions, bytecode.site_ranges[i].instruction, end)) {
            found.push_back(each.opcode);
        }
    }
    return found;
}

/// The cause of a value that is not finite, if its expression has one operation that can yield it.
std::string reason_for(const RuntimeError& error, const Bytecode& bytecode) {
    const std::vector<Opcode> operations = operations_at(error.site, bytecode);
    const auto has = [&](Opcode opcode) {
        return std::find(operations.begin(), operations.end(), opcode) != operations.end();
    };
    const bool is_nan = std::isnan(error.value);
    if (has(Opcode::Log) && !has(Opcode::Divide)) {
        return is_nan
                   ? "the logarithm of a negative number is not a number: write `log(max(x, "
                     "0.001))`, or stop with a condition"
                   : std::string("the logarithm of 0 is minus infinite") +
                         (has(Opcode::Step) ? ", and `step()` is 0 in the first generation: write "
                                              "`log(step() + 1)`"
                                            : ": add something to its argument, as in `log(x + "
                                              "1)`");
    }
    if (is_nan && has(Opcode::Sqrt)) {
        return "the square root of a negative number is not a number: write `sqrt(max(0, ...))`, "
               "or "
               "stop with a condition";
    }
    if ((has(Opcode::Divide) || has(Opcode::Mod)) && !has(Opcode::Log) && !has(Opcode::Power)) {
        return is_nan ? "0 divided by 0 is not a number: exclude a divisor of 0 by a condition"
                      : "a division by 0 is infinite: exclude a divisor of 0 by a condition, or "
                        "choose with `if(condition, a, b)`";
    }
    if (!is_nan && error.production != kNoProduction && !has(Opcode::Divide) &&
        (has(Opcode::Multiply) || has(Opcode::Power) || has(Opcode::Exp))) {
        return "the value grows with every generation and passes 3.4e38, the largest binary32 "
               "number: stop it with a condition such as `x < 100`, or bound it, as in `min(x * "
               "x, 100)`";
    }
    return {};
}

Diagnostic not_finite(const RuntimeError& error, const Bytecode& bytecode) {
    const char* const what = error.global != kNone ? "the value"
                             : error.in_weight     ? "the weight"
                             : error.in_condition  ? "the condition"
                                                   : "a parameter";
    Diagnostic diagnostic = make_diagnostic(
        DiagnosticCode::NotFinite, {},
        fmt::format("{} of {} is {}", what, owner(error, bytecode), number(error.value)));
    diagnostic.label = number(error.value) + " here";
    note_module(diagnostic, error, bytecode);
    const bool is_test = error.in_condition && !error.in_weight;
    const std::string reason = is_test ? std::string() : reason_for(error, bytecode);
    if (!reason.empty()) {
        diagnostic.help.push_back(reason);
    } else if (error.production != kNoProduction) {
        diagnostic.help.emplace_back(
            error.in_weight ? "bound the weight with `min` and `max`"
            : error.in_condition
                ? "add an earlier production for the modules for which the condition has no value"
                : "guard the production with a condition, or bound the value with `min` and "
                  "`max`");
    }
    return diagnostic;
}

Diagnostic bad_range(const RuntimeError& error, const Bytecode& bytecode) {
    const bool reversed = error.kind == RuntimeErrorKind::RangeReversed;
    std::string why = "its minimum lies above its maximum";
    if (!reversed) {
        why = std::isfinite(error.first_argument) && std::isfinite(error.second_argument)
                  ? "its width overflows binary32"
                  : "its bounds must be finite";
    }
    Diagnostic diagnostic =
        make_diagnostic(DiagnosticCode::BadRangeBounds, {},
                        fmt::format("the range {{{}, {}}} of {} cannot be drawn from: {}",
                                    number(error.first_argument), number(error.second_argument),
                                    owner(error, bytecode), why));
    note_module(diagnostic, error, bytecode);
    if (reversed) {
        diagnostic.help.emplace_back("order the bounds with `min` and `max`");
    }
    return diagnostic;
}

Diagnostic bad_distribution(const RuntimeError& error, const Bytecode& bytecode) {
    const DistributionFault fault =
        check_distribution(error.opcode, error.first_argument, error.second_argument);
    const std::string call =
        info(error.opcode).pops == 1
            ? fmt::format("{}({})", info(error.opcode).mnemonic, number(error.first_argument))
            : fmt::format("{}({}, {})", info(error.opcode).mnemonic, number(error.first_argument),
                          number(error.second_argument));
    Diagnostic diagnostic =
        make_diagnostic(DiagnosticCode::BadDistribution, {},
                        fmt::format("`{}` of {} cannot be drawn from: {}", call,
                                    owner(error, bytecode), describe(error.opcode, fault)));
    note_module(diagnostic, error, bytecode);
    const std::string_view name = info(error.opcode).mnemonic;
    const std::vector<Opcode> operations = operations_at(error.site, bytecode);
    const bool has_step =
        std::find(operations.begin(), operations.end(), Opcode::Step) != operations.end();
    switch (fault) {
    case DistributionFault::Mean:
        if (error.opcode == Opcode::Poisson) {
            diagnostic.help.push_back(
                error.first_argument < 0.0F
                    ? fmt::format("{}let it end at 0: write `{}(max(0, ...))`",
                                  has_step ? "`step()` grows by 1 in each generation: " : "", name)
                    : fmt::format("bound it: write `{}(min(700, ...))`", name));
            break;
        }
        diagnostic.help.emplace_back("bound its arguments with `clamp`");
        break;
    case DistributionFault::Deviation:
        diagnostic.help.push_back(fmt::format("bound it: write `{}(mean, max(0, ...))`", name));
        break;
    case DistributionFault::Trials:
        diagnostic.help.push_back(
            fmt::format("round and bound it: write `{}(clamp(floor(...), 0, 10000), p)`", name));
        break;
    case DistributionFault::Probability:
        diagnostic.help.push_back(fmt::format("bound it: write `{}(n, clamp(..., 0, 1))`", name));
        break;
    case DistributionFault::None:
        break;
    }
    return diagnostic;
}

Diagnostic bad_weight(const RuntimeError& error, const Bytecode& bytecode) {
    const bool is_negative = error.kind == RuntimeErrorKind::NegativeWeight;
    Diagnostic diagnostic = make_diagnostic(
        DiagnosticCode::BadProbability, {},
        is_negative ? fmt::format("the weight of {} is {}, below 0", owner(error, bytecode),
                                  number(error.value))
                    : fmt::format("the weights of the choice that {} belongs to are too large: "
                                  "their sum overflows binary32",
                                  owner(error, bytecode)));
    diagnostic.label = number(error.value) + " here";
    note_module(diagnostic, error, bytecode);
    diagnostic.help.emplace_back(is_negative
                                     ? "bound the weight: `max(0, ...)`"
                                     : "only the ratios of weights matter: make all smaller");
    return diagnostic;
}

Diagnostic out_of_bounds(const RuntimeError& error, const Bytecode& bytecode) {
    const BytecodeGlobal& global = bytecode.globals[error.global];
    Diagnostic diagnostic = make_diagnostic(
        DiagnosticCode::BadParameterBounds, {},
        fmt::format("parameter `{}` is {}, outside its bounds {{{}, {}}}", global.name,
                    number(error.value), number(global.minimum), number(global.maximum)));
    note_module(diagnostic, error, bytecode);
    return diagnostic;
}

/// The predecessor of the production that failed, if the successor contains it; else empty.
std::string repeated_module(const RuntimeError& error, const Bytecode& bytecode) {
    const BytecodeProduction& production =
        bytecode.productions[static_cast<std::size_t>(error.production)];
    const SymbolId own = bytecode.patterns[production.predecessor.first].symbol;
    const TableRange codes = production.successor.codes;
    const auto begin = bytecode.template_codes.begin() + codes.first;
    const bool repeats = std::any_of(begin, begin + codes.count,
                                     [&](Code code) { return bytecode.symbol_of(code) == own; });
    return repeats ? spelled_name(bytecode.symbol(own).name, bytecode.settings.print_letters)
                   : std::string();
}

Diagnostic unbalanced(const RuntimeError& error, const Bytecode& bytecode) {
    const BytecodeSymbol& close = bytecode.symbol(error.symbol);
    const bool is_branch = close.kind == SymbolKind::BranchClose;
    Diagnostic diagnostic = make_diagnostic(
        is_branch ? DiagnosticCode::UnbalancedWord : DiagnosticCode::UnbalancedPolygon, {},
        fmt::format("module {} of generation {} is a `{}` without its `{}` (counted from 0)",
                    grouped_digits(error.position), error.generation, close.name,
                    is_branch ? "[" : "{"));
    diagnostic.severity = Severity::Error;
    if (error.production != kNoProduction) {
        diagnostic.label = "writes it";
        const std::string own = repeated_module(error, bytecode);
        diagnostic.notes.push_back(
            own.empty()
                ? fmt::format("{} {}, and every `{}` before it already has its `{}`",
                              owner(error, bytecode),
                              is_branch ? "closes a branch that it does not open"
                                        : "ends a polygon that it does not begin",
                              is_branch ? "[" : "{", close.name)
                : fmt::format("{} writes `{}` again, and with it one more `{}` in each generation",
                              owner(error, bytecode), own, close.name));
    }
    diagnostic.help.emplace_back(
        is_branch ? "close each branch in the successor that opens it"
                  : "give each `}` a `{` of its own earlier in the word, or remove it");
    return diagnostic;
}

Diagnostic too_deep(const RuntimeError& error, const Bytecode& bytecode) {
    const BytecodeProduction& production =
        bytecode.productions[static_cast<std::size_t>(error.production)];
    const bool draws = production.stage == Stage::Interpret;
    const std::uint32_t depth =
        draws ? bytecode.settings.interpret_depth : bytecode.settings.decompose_depth;
    Diagnostic diagnostic = make_diagnostic(
        draws ? DiagnosticCode::InterpretDepth : DiagnosticCode::DecomposeDepth, {},
        fmt::format("production `{}` still matches after {} passes of `{}`", production.name,
                    grouped_digits(depth), keyword_of(production.stage)));
    note_module(diagnostic, error, bytecode);
    for (const float parameter : error.parameters) {
        constexpr float kTiny = 1e-6F;
        if (parameter != 0.0F && std::fabs(parameter) < kTiny) {
            diagnostic.help.push_back(fmt::format(
                "repeated multiplication never reaches 0; the value is {} here: let the "
                "condition compare it with a small number, for example 0.01",
                number(parameter)));
            break;
        }
    }
    const std::string key = draws ? "interpret_depth" : "decompose_depth";
    const std::string raise = depth < kMaxDepth
                                  ? fmt::format(", raise the number of passes with `#set {} {};`,",
                                                key, std::min(depth * 10, kMaxDepth))
                                  : std::string();
    diagnostic.help.push_back(
        fmt::format("let its productions end{} or keep the remaining modules unchanged with "
                    "`#set at_depth stop;`",
                    raise));
    return diagnostic;
}

Diagnostic sense_not_finite(const RuntimeError& error, const Bytecode& bytecode) {
    Diagnostic diagnostic =
        make_diagnostic(DiagnosticCode::SenseNotFinite, {},
                        fmt::format("an answer to `{}` is {}", bytecode.symbol(error.symbol).name,
                                    number(error.value)));
    diagnostic.notes.push_back(fmt::format("module {} of generation {} (counted from 0)",
                                           grouped_digits(error.position), error.generation));
    return diagnostic;
}

Diagnostic sense_failed(const RuntimeError& error, const Bytecode& bytecode) {
    const std::string subject = error.environment == kNone
                                    ? "the plant cannot sense"
                                    : fmt::format("the environment `{}` has no answer",
                                                  bytecode.environments[error.environment].name);
    Diagnostic diagnostic = make_diagnostic(DiagnosticCode::SenseFailed, {},
                                            fmt::format("{}: {}", subject, error.text));
    if (error.symbol != kNoSymbol) {
        diagnostic.notes.push_back(fmt::format(
            "asked by `{}`, module {} of generation {} (counted from 0)",
            module_text(error, bytecode), grouped_digits(error.position), error.generation));
    }
    for (std::size_t begin = 0; begin < error.help.size();) { // one help per line
        const std::size_t end = std::min(error.help.find('\n', begin), error.help.size());
        if (end > begin) {
            diagnostic.help.push_back(error.help.substr(begin, end - begin));
        }
        begin = end + 1;
    }
    return diagnostic;
}

} // namespace

Diagnostic
runtime_diagnostic(const RuntimeError& error, const Bytecode& bytecode, bool sources_loaded) {
    Diagnostic diagnostic;
    switch (error.kind) {
    case RuntimeErrorKind::NotFinite:
        diagnostic = not_finite(error, bytecode);
        break;
    case RuntimeErrorKind::RangeReversed:
    case RuntimeErrorKind::RangeTooWide:
        diagnostic = bad_range(error, bytecode);
        break;
    case RuntimeErrorKind::BadDistribution:
        diagnostic = bad_distribution(error, bytecode);
        break;
    case RuntimeErrorKind::NegativeWeight:
    case RuntimeErrorKind::WeightsTooLarge:
        diagnostic = bad_weight(error, bytecode);
        break;
    case RuntimeErrorKind::OutOfBounds:
        diagnostic = out_of_bounds(error, bytecode);
        break;
    case RuntimeErrorKind::Unbalanced:
        diagnostic = unbalanced(error, bytecode);
        break;
    case RuntimeErrorKind::TooDeep:
        diagnostic = too_deep(error, bytecode);
        break;
    case RuntimeErrorKind::SenseNotFinite:
        diagnostic = sense_not_finite(error, bytecode);
        break;
    case RuntimeErrorKind::SenseFailed:
        diagnostic = sense_failed(error, bytecode);
        break;
    }
    add_facts(diagnostic, error, bytecode);
    place(diagnostic, error.site, bytecode, sources_loaded);
    return diagnostic;
}

Diagnostic limit_diagnostic(const LimitReport& report,
                            const Limits& limits,
                            const Bytecode& bytecode,
                            bool sources_loaded) {
    const bool modules = report.kind == LimitKind::Modules;
    const bool no_memory = !modules && report.predicted_bytes <= limits.max_bytes;
    // A report without a complete word is about the axiom.
    const bool axiom = report.modules == 0 && report.generation == 0 && !report.streamed;
    const std::uint64_t failed =
        std::uint64_t{report.generation} + (axiom || report.streamed ? 0 : 1);
    // Counts end at the largest number, which stands for all numbers from it on.
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
    const bool is_countless = modules && report.predicted_modules == kMost;
    const std::string size = is_countless ? "2^64 modules or more"
                             : modules    ? grouped_digits(report.predicted_modules) + " modules"
                                          : byte_size_text(report.predicted_bytes);
    const std::string limit =
        modules ? grouped_digits(limits.max_modules) : byte_size_text(limits.max_bytes);
    Diagnostic diagnostic = make_diagnostic(
        DiagnosticCode::LimitReached, {},
        no_memory
            ? fmt::format("the system has no memory for generation {}{}{}{}", failed,
                          report.predicted_bytes == 0 ? "" : ", which takes ",
                          report.exact ? "" : "at least ", report.predicted_bytes == 0 ? "" : size)
            : fmt::format("generation {} {} {}{}, over the limit of {}", failed,
                          modules ? "has" : "takes",
                          report.exact || is_countless ? "" : "at least ", size, limit));
    diagnostic.facts.push_back({"generation", failed});
    diagnostic.facts.push_back({"last_that_fits", std::uint64_t{report.generation}});
    diagnostic.facts.push_back({"modules", report.modules});
    std::uint32_t site = bytecode.axioms.front().site;
    if (report.production != kNone) {
        const BytecodeProduction& production = bytecode.productions[report.production];
        diagnostic.facts.push_back({"production", production.name});
        site = production.name_site;
        diagnostic.label = "adds most of them";
        if (!modules || !sources_loaded) {
            diagnostic.label.clear();
            diagnostic.notes.push_back(
                fmt::format("production `{}` adds most modules", production.name));
        }
    }
    place(diagnostic, site, bytecode, sources_loaded);
    if (axiom || report.streamed) {
        diagnostic.help.push_back(modules ? "raise the limit with `--max-modules`"
                                          : "raise the limit with `--max-memory`");
        return diagnostic;
    }
    diagnostic.notes.push_back(fmt::format("generation {}, with {} modules, is the last that fits",
                                           report.generation, grouped_digits(report.modules)));
    std::string help = fmt::format("ask for fewer generations: `-n {}`", report.generation);
    if (!no_memory && !is_countless) { // no limit is so high
        help += modules ? ", or raise the limit with `--max-modules`"
                        : ", or raise the limit with `--max-memory`";
    }
    if (!modules && !streaming_obstacle(bytecode)) {
        help += ", or store no word: `--stream`";
    }
    diagnostic.help.push_back(std::move(help));
    return diagnostic;
}

} // namespace lsys
