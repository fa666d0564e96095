// SPDX-License-Identifier: MIT
// cpfg: the L-system files of L-studio and vlab. A label `Lsystem: 1`, header items, the axiom,
// productions `left < predecessor > right : {statements} condition {statements} --> successor :
// weight`, then decomposition and homomorphism. A line that begins with a tab continues the line
// before. The turtle is the profile `cpfg`.
#include "cpfg/parser.h"
#include "grammar/ast/reports.h"
#include "grammar/dialects/cpfg/preprocessor.h"
#include "grammar/dialects/cpfg/session.h"
#include "grammar/dialects/cpfg/systems.h"
#include "grammar/dialects/cpfg/writer.h"
#include "grammar/dialects/impl/frontends.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

/// Max nesting, since the stages after the parser recurse.
constexpr std::uint32_t kMaxDepth = 1000;

} // namespace

ForeignId CpfgSession::add(ForeignNode expression) {
    const SourceSpan span = expression.span;
    const ForeignId added = expressions.add(std::move(expression));
    const std::uint32_t depth = expressions[added].depth;
    if (depth <= kMaxDepth) {
        return added;
    }
    if (depth == kMaxDepth + 1) { // report once, not for every enclosing expression
        report_unsupported(span, "an expression of more than 1000 operations in one another");
    }
    ForeignNode placeholder{.kind = ForeignKind::Number, .text = "0", .span = span, .token = span};
    placeholder.depth =
        depth + 1; // so that the enclosing expressions are replaced, too, without a report
    return expressions.add(std::move(placeholder));
}

int CpfgSession::add(CpfgStatement statement) {
    for (const std::vector<int>* const block : {&statement.block, &statement.otherwise}) {
        for (const int index : *block) {
            statement.depth =
                std::max(statement.depth, statements[static_cast<std::size_t>(index)].depth + 1);
        }
    }
    if (statement.depth > static_cast<int>(kMaxDepth)) {
        if (statement.depth == static_cast<int>(kMaxDepth) + 1) {
            report_unsupported(statement.span, "more than 1000 blocks in one another");
        }
        statement.block.clear();
        statement.otherwise.clear();
    }
    statements.push_back(std::move(statement));
    return static_cast<int>(statements.size()) - 1;
}

void CpfgSession::production(CpfgProduction new_production) {
    new_production.stage = stage;
    productions.push_back(std::move(new_production));
}

std::string_view recognise_cpfg(std::string_view text) {
    return cpfg_systems(text).empty() ? std::string_view() : "a line `Lsystem:`";
}

namespace {

/// The part of a text with the system that the context names, or with the first one. nullopt after
/// a report.
std::optional<CpfgSystem> choose(const Translation& text, const ParseContext& context) {
    const std::vector<CpfgSystem> systems = cpfg_systems(text.text());
    if (systems.empty()) {
        return CpfgSystem{{}, 0, text.text().size()};
    }
    const auto place = [&](const CpfgSystem& system) {
        const auto begin = static_cast<std::uint32_t>(system.begin);
        const std::size_t line = std::min(text.text().find('\n', begin), text.text().size());
        return text.origin(begin, static_cast<std::uint32_t>(line));
    };
    const std::string_view wanted = context.system;
    const auto found = std::find_if(systems.begin(), systems.end(), [&](const CpfgSystem& system) {
        return wanted.empty() || system.name == wanted;
    });
    if (found == systems.end()) {
        Diagnostic& error =
            context.diagnostics.add(DiagnosticCode::WhichSystem, place(systems.front()),
                                    "this file has no system `" + shown(wanted) + "`");
        std::string names;
        for (const CpfgSystem& system : systems) {
            names += (names.empty() ? "" : ", ") + shown(system.name);
        }
        error.help.push_back("it holds " + names);
        return std::nullopt;
    }
    if (wanted.empty() && systems.size() > 1) {
        Diagnostic& warning =
            context.diagnostics.add(DiagnosticCode::ForeignIgnored, place(systems[1]),
                                    "only the first L-system of the file is read");
        warning.help.push_back("`--system " + shown(systems[1].name) + "` reads this one");
    }
    return *found;
}

} // namespace

void translate_cpfg(const DialectRow& row, const ParseContext& context, Translation& translation) {
    const FileId root = translation.file();
    const Translation text = preprocess_cpfg(root, context);
    static_cast<void>(text.report_overflow(context.diagnostics));
    CpfgSession session(text, context);
    if (!context.diagnostics.has_errors()) {
        const std::optional<CpfgSystem> system = choose(text, context);
        if (!system) {
            return;
        }
        session.begin_at(static_cast<std::uint32_t>(system->begin));
        const CpfgScanning scanning(
            session,
            std::string_view(text.text()).substr(system->begin, system->end - system->begin));
        cpfg_grammar::Parser parser(session, scanning.scanner());
        static_cast<void>(parser.parse()); // errors have been reported
    }
    if (context.diagnostics.has_errors()) {
        return;
    }
    const auto size = static_cast<std::uint32_t>(context.sources.file(root).text().size());
    if (session.systems == 0 || !session.axiom_span) {
        context.diagnostics.add(DiagnosticCode::ForeignSyntax, {root, size, size},
                                session.systems == 0 ? "the file has no line `Lsystem: 1`"
                                                     : "the file has no line `Axiom: ...`");
        return;
    }
    CpfgWriter(session, translation).write(row.turtle);
}

} // namespace lsys
