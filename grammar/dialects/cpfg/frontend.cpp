// SPDX-License-Identifier: MIT
// cpfg: the L-system files of L-studio and vlab. A label `Lsystem: 1`, header items, the axiom,
// productions `left < predecessor > right : {statements} condition {statements} --> successor :
// weight`, then decomposition and homomorphism. A line that begins with a tab continues the line
// before. The turtle is the profile `cpfg`.
#include "cpfg/parser.h"
#include "grammar/dialects/cpfg/preprocessor.h"
#include "grammar/dialects/cpfg/session.h"
#include "grammar/dialects/cpfg/writer.h"
#include "grammar/dialects/impl/frontends.h"

#include <algorithm>
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
            const bool nests = statement.kind == CpfgStatementKind::If;
            const int depth = nests ? statements[static_cast<std::size_t>(index)].depth + 1 : 1;
            statement.depth = std::max(statement.depth, depth);
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

void CpfgSession::production(CpfgProduction made) {
    made.stage = stage;
    productions.push_back(std::move(made));
}

void CpfgSession::begin_system(SourceSpan label_span) {
    ++systems;
    if (systems == 2) {
        report_unsupported(label_span, "a second L-system of the file, which the first would call");
    }
    stage = Stage::Rewrite;
}

std::string_view recognise_cpfg(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view line = text.substr(at, end - at);
        at = end + 1;
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (!line.starts_with("Lsystem") && !line.starts_with("lsystem")) {
            continue;
        }
        line.remove_prefix(7);
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (line.starts_with(":")) {
            return "a line `Lsystem:`";
        }
    }
    return {};
}

void translate_cpfg(const DialectRow& row, const ParseContext& context, Translation& translation) {
    const FileId root = translation.file();
    const Translation text = preprocess_cpfg(root, context);
    static_cast<void>(text.report_overflow(context.diagnostics));
    CpfgSession session(text, context);
    if (!context.diagnostics.has_errors()) {
        const CpfgScanning scanning(session, text.text());
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
