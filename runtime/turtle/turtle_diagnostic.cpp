// SPDX-License-Identifier: MIT
#include "runtime/turtle/turtle_diagnostic.h"

#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/derive/word_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace lsys {

namespace {

struct Wording {
    DiagnosticCode code;
    const char* what; // text after "module N of the word, a `X`, "; empty for UnclosedBranch
    const char* help; // may be empty
};

Wording wording_of(TurtleFaultKind kind) {
    switch (kind) {
    case TurtleFaultKind::Unbalanced:
        return {DiagnosticCode::UnbalancedWord, "closes a branch that nothing opens",
                "balance the brackets of every successor and of the axiom"};
    case TurtleFaultKind::NotFinite:
        return {DiagnosticCode::NotFinite,
                "gives a position, length or width that is infinite or not a number",
                "bound lengths and widths with `min` and `max`"};
    case TurtleFaultKind::TooMany:
        return {DiagnosticCode::LimitReached,
                "is more than the 4,294,967,280 segments, objects or corners of one plant",
                "ask for fewer generations with `-n`"};
    case TurtleFaultKind::UnclosedBranch:
        return {DiagnosticCode::UnclosedBranch, "", "close each `[` with a `]`"};
    case TurtleFaultKind::NegativeWidth:
        return {DiagnosticCode::NegativeWidth, "sets a negative width, which is drawn as 0",
                "bound the width, `!(max(0, w))`, or stop with a condition"};
    case TurtleFaultKind::VertexOutside:
        return {DiagnosticCode::StrayVertex, "is a vertex outside of any polygon", ""};
    case TurtleFaultKind::EndOutside:
        return {DiagnosticCode::UnbalancedPolygon, "ends a polygon that nothing begins",
                "give each `}` a `{` of its own earlier in the word, or remove it"};
    case TurtleFaultKind::FewCorners:
        return {DiagnosticCode::SmallPolygon,
                "ends a polygon of fewer than three vertices, which is not drawn", ""};
    case TurtleFaultKind::UnclosedPolygon:
        return {DiagnosticCode::UnbalancedPolygon,
                "begins a polygon that nothing ends, which is not drawn",
                "close each `{` with a `}`"};
    case TurtleFaultKind::SidesOutOfRange:
        return {DiagnosticCode::SidesOutOfRange,
                "sets fewer than 3 or more than 64 sides; the nearest allowed number is used", ""};
    case TurtleFaultKind::ColourOutOfRange:
        return {DiagnosticCode::ColourOutOfRange,
                "chooses a colour outside of 0 to 65,535; the nearest allowed number is used", ""};
    case TurtleFaultKind::RgbOutOfRange:
        return {DiagnosticCode::ColourOutOfRange,
                "sets a colour component below 0 or above 1; the nearest allowed value is used",
                "red, green and blue are from 0 to 1; bound them with `clamp`"};
    case TurtleFaultKind::SurfaceOutside:
        return {DiagnosticCode::StraySurface,
                "is a point or the end of a surface that is not open, and is ignored",
                "begin a surface with SURFACE_BEGIN in the same branch"};
    case TurtleFaultKind::SurfaceWithin:
        return {DiagnosticCode::StraySurface, "begins a surface within another one, and is ignored",
                "end the first surface, or begin the second in a branch of its own"};
    case TurtleFaultKind::SmallSurface:
        return {DiagnosticCode::SmallSurface,
                "begins a surface whose points are all at one place, which is not drawn",
                "move with `f` or `F` between its points"};
    }
    return {DiagnosticCode::NotFinite, "", ""};
}

bool is_at_end(TurtleFaultKind kind) {
    return kind == TurtleFaultKind::UnclosedBranch;
}

bool ends_drawing(TurtleFaultKind kind) {
    return kind == TurtleFaultKind::Unbalanced || kind == TurtleFaultKind::NotFinite ||
           kind == TurtleFaultKind::TooMany || kind == TurtleFaultKind::EndOutside;
}

/// The productions that write modules of this symbol, each with the place where it does so first.
std::vector<std::pair<ProductionId, Site>> writers_of(Code code, const Bytecode& bytecode) {
    std::vector<std::pair<ProductionId, Site>> writers;
    for (std::uint32_t i = 0; i < bytecode.template_codes.size(); ++i) {
        if (bytecode.symbol_of(bytecode.template_codes[i]) != bytecode.symbol_of(code)) {
            continue;
        }
        const ProductionId writer = production_with(bytecode, i);
        const std::optional<Site> site = place_of(bytecode, i);
        if (writer == kNoProduction || !site) {
            return {}; // the axiom writes it, too
        }
        if (writers.empty() || writers.back().first != writer) {
            writers.emplace_back(writer, *site);
        }
    }
    return writers;
}

/// Notes the productions that write modules of this symbol, if they are few.
void note_writers(Code code, const Bytecode& bytecode, Diagnostic& diagnostic) {
    constexpr std::size_t kMaxWriters = 4;
    const auto writers = writers_of(code, bytecode);
    if (writers.empty() || writers.size() > kMaxWriters) {
        return;
    }
    const auto text_of = [&](const std::pair<ProductionId, Site>& written) {
        const Site& site = written.second;
        return fmt::format("`{}` writes it: {}:{}:{}",
                           bytecode.productions[static_cast<std::size_t>(written.first)].name,
                           bytecode.files[static_cast<std::size_t>(site.span.file)], site.line,
                           site.column);
    };
    if (writers.size() > 1) {
        for (const auto& writer : writers) {
            diagnostic.notes.push_back("perhaps production " + text_of(writer));
        }
        return;
    }
    diagnostic.notes.push_back("production " + text_of(writers.front()));
    const BytecodeProduction& production =
        bytecode.productions[static_cast<std::size_t>(writers.front().first)];
    const SymbolId own = bytecode.patterns[production.predecessor.first].symbol;
    const bool repeats =
        std::any_of(bytecode.template_codes.begin() + production.successor.codes.first,
                    bytecode.template_codes.begin() + production.successor.codes.first +
                        production.successor.codes.count,
                    [&](Code each) { return bytecode.symbol_of(each) == own; });
    if (repeats && diagnostic.code == DiagnosticCode::UnbalancedPolygon) {
        diagnostic.help.push_back(
            fmt::format("`{}` writes its own predecessor again, and with it another `}}` in the "
                        "next generation: leave the predecessor out of the successor",
                        production.name));
    }
}

} // namespace

std::vector<Diagnostic>
turtle_diagnostics(const std::array<TurtleFault, kTurtleFaultKindCount>& faults,
                   const Bytecode& bytecode) {
    std::vector<Diagnostic> diagnostics;
    for (std::size_t i = 0; i < faults.size(); ++i) {
        const TurtleFault& fault = faults[i];
        if (fault.count == 0) {
            continue;
        }
        const auto kind = static_cast<TurtleFaultKind>(i);
        const Wording wording = wording_of(kind);
        if (is_at_end(kind)) {
            Diagnostic diagnostic = make_diagnostic(
                wording.code, {},
                fault.count == 1
                    ? std::string("the word ends with an open branch, which is closed there")
                    : fmt::format("the word ends with {} open branches, which are closed there",
                                  grouped_digits(fault.count)));
            diagnostic.severity = Severity::Warning;
            diagnostic.help.emplace_back(wording.help);
            diagnostics.push_back(std::move(diagnostic));
            continue;
        }
        const std::string name = spelled_name(bytecode.symbol(bytecode.symbol_of(fault.code)).name,
                                              bytecode.settings.print_letters);
        Diagnostic diagnostic =
            make_diagnostic(wording.code, {},
                            fmt::format("module {} of the word, a `{}`, {}",
                                        grouped_digits(fault.position), name, wording.what));
        diagnostic.severity = ends_drawing(kind) ? Severity::Error : Severity::Warning;
        note_writers(fault.code, bytecode, diagnostic);
        diagnostic.notes.emplace_back("modules are counted from 0");
        if (fault.count > 1) {
            diagnostic.notes.push_back(
                fault.count == 2
                    ? std::string("1 more module does so")
                    : fmt::format("{} more modules do so", grouped_digits(fault.count - 1)));
        }
        if (*wording.help != '\0') {
            diagnostic.help.emplace_back(wording.help);
        }
        diagnostics.push_back(std::move(diagnostic));
    }
    return diagnostics;
}

Diagnostic plant_limit_diagnostic(std::string_view what, std::string_view limit, std::string help) {
    Diagnostic diagnostic = make_diagnostic(DiagnosticCode::LimitReached, {},
                                            fmt::format("{} does not fit into {}", what, limit));
    diagnostic.help.push_back(std::move(help));
    return diagnostic;
}

Diagnostic plant_limit_diagnostic(std::string_view what, std::uint64_t max_bytes) {
    return plant_limit_diagnostic(
        what, byte_size_text(max_bytes),
        "ask for fewer generations with `-n`, or raise the limit with `--max-memory`");
}

Diagnostic no_memory_diagnostic(std::string_view what) {
    Diagnostic diagnostic = make_diagnostic(DiagnosticCode::LimitReached, {},
                                            fmt::format("the system has no memory for {}", what));
    diagnostic.help.emplace_back("ask for fewer generations with `-n`");
    return diagnostic;
}

} // namespace lsys
