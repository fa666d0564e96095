// SPDX-License-Identifier: MIT
#include "grammar/lsys/parse.h"

#include "grammar/ast/reports.h"
#include "grammar/lsys/impl/normalized_text.h"
#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/scanning.h"
#include "grammar/lsys/impl/statement_ends.h"
#include "grammar/lsys/parse_with_names.h"

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

void parse_text(const NormalizedText& normalized,
                const ParseContext& context,
                Ast& ast,
                IncludeChain& includes) {
    ParseSession session(context, normalized.scanned, ast, &includes);
    session.builder.set_names(normalized.names);
    ast.incomplete = ast.incomplete || normalized.is_incomplete;
    const lsys_grammar::Scanning scanning(session);
    lsys_grammar::Parser parser(session, scanning.scanner());
    const int failed = parser.parse();
    LSYS_CHECK(failed == 0); // the parser recovers from every error
}

/// Parses one file and its included files.
void parse_file(FileId file, const ParseContext& context, Ast& ast, IncludeChain& includes) {
    parse_text(normalize_source(file, context), context, ast, includes);
}

} // namespace

bool ParseSession::is_independent(DiagnosticCode code) {
    return code == DiagnosticCode::MissingSemicolon || code == DiagnosticCode::MalformedNumber ||
           code == DiagnosticCode::NumberOverflow || code == DiagnosticCode::BadQuotedName ||
           code == DiagnosticCode::ForeignFeature;
}

bool ParseSession::follows_doubtful_error() {
    const std::vector<Diagnostic>& all = context.diagnostics.all();
    PartDiagnostics& part = part_diagnostics_;
    const std::uint32_t begin = std::max(scan.part_begin, scan.statement_begin);
    if (part.part_begin != begin) {
        part = {begin, all.size(), false};
    }
    for (; !part.has_doubtful_error && part.next < all.size(); ++part.next) {
        const Diagnostic& diagnostic = all[part.next];
        part.has_doubtful_error = diagnostic.severity == Severity::Error &&
                                  !is_independent(diagnostic.code) && !has_certain_fix(diagnostic);
    }
    return part.has_doubtful_error;
}

bool ParseSession::is_commented_out(std::size_t at) {
    const std::string_view text = scanned.text;
    const std::size_t newline = text.substr(0, at).substr(line_search_end_).rfind('\n');
    if (newline != std::string_view::npos || line_search_end_ == 0) {
        const std::size_t line =
            newline == std::string_view::npos ? 0 : line_search_end_ + newline + 1;
        line_first_ = text.find_first_not_of(" \t", line);
    }
    line_search_end_ = at;
    return line_first_ < at && text.substr(line_first_, 2) == "//";
}

void ParseSession::offer_doubtful_fixes() {
    Diagnostics& diagnostics = context.diagnostics;
    if (checked_.first != scan.first_diagnostic) {
        checked_ = {scan.first_diagnostic, scan.first_diagnostic, false};
    }
    if (checked_.end == diagnostics.all().size()) {
        return;
    }
    if (is_commented_out(scan.statement_begin)) {
        diagnostics.offer_fixes_from(checked_.end);
    }
    if (checked_.has_doubtful_error) {
        diagnostics.offer_fixes_from(checked_.end);
    } else if (diagnostics.has_doubtful_error_from(checked_.end)) {
        checked_.has_doubtful_error = true;
        diagnostics.offer_fixes_from(checked_.first);
    }
    checked_.end = diagnostics.all().size();
}

void ParseSession::end_statement(SourceSpan span, bool whole) {
    const bool is_kept = builder.finish_statement(span, whole);
    if (is_kept && scan.semicolon_inserted) {
        lsys_grammar::report_missing_semicolon(*this);
    }
    offer_doubtful_fixes();
    const std::uint32_t begin = scanned.source_begin(scan.statement_begin);
    const SourceSpan statement{scanned.file, begin, std::max(begin, span.end)};
    for (const DiagnosticCode code : std::exchange(allowed, {})) {
        context.sources.allow(statement, info(code).name);
    }
    if (context.statements != nullptr) {
        context.statements->push_back(statement);
    }
    if (!is_kept || ast_.statements.back().kind != StatementKind::Include || includes == nullptr) {
        return;
    }
    const std::uint32_t index = ast_.statements.back().index;
    // A copy: the vector grows during the parse of the file.
    const IncludeNode node = ast_.includes[index];
    const FileId file = includes->enter(node.path, node.path_span);
    if (file == kNoFile) {
        ast_.incomplete = true;
        return;
    }
    if (!check_is_text(file, context.sources, context.diagnostics)) {
        ast_.incomplete = true;
        includes->leave();
        return;
    }
    ast_.includes[index].file = file;
    ast_.files.push_back({file, node.path_span});
    parse_file(file, context, ast_, *includes);
    includes->leave();
    builder.set_watermark();
}

Ast parse_lsys(FileId root, const ParseContext& context) {
    return parse_lsys_with_names(root, {}, context);
}

Ast parse_lsys_with_names(FileId root, std::string_view names, const ParseContext& context) {
    Ast ast;
    ast.files.push_back({root, {}});
    if (!check_is_text(root, context.sources, context.diagnostics)) {
        ast.incomplete = true;
        return ast;
    }
    IncludeChain includes(context, root);
    NormalizedText normalized = normalize_source(root, context);
    if (names == "words") {
        normalized.names = ModuleNames::Words;
    } else if (names == "letters") {
        normalized.names = ModuleNames::Letters;
    } else if (names == "characters") {
        normalized.names = ModuleNames::Characters;
    }
    parse_text(normalized, context, ast, includes);
    std::sort(ast.written_names.begin(), ast.written_names.end());
    return ast;
}

Ast parse_translation(const Translation& translation, const ParseContext& context) {
    Ast ast;
    for (const FileId file : translation.files()) {
        ast.files.push_back({file, {}});
    }
    IncludeChain includes(context, translation.file());
    parse_text(normalize_source(translation, context), context, ast, includes);
    std::sort(ast.written_names.begin(), ast.written_names.end());
    for (const auto& [name, original] : translation.replaced_names()) {
        context.names.set_written(context.names.intern(name), original);
    }
    return ast;
}

} // namespace lsys
