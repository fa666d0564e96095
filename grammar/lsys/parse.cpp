#include "grammar/lsys/parse.h"

#include "grammar/lsys/impl/lookahead.h"
#include "grammar/lsys/impl/normalized_text.h"
#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/scanning.h"
#include "grammar/lsys/impl/statement_ends.h"

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

void ParseSession::end_statement(SourceSpan span, bool whole) {
    const bool is_kept = builder.finish_statement(span, whole);
    if (is_kept && scan.semicolon_supplied) {
        lsys_grammar::report_missing_semicolon(*this);
    }
    if (is_commented_out(scanned.text, scan.statement_begin)) {
        context.diagnostics.offer_fixes_from(scan.first_diagnostic);
    } else {
        context.diagnostics.offer_partial_fixes(scan.first_diagnostic);
    }
    if (context.statements != nullptr) {
        const std::uint32_t begin = scanned.source_begin(scan.statement_begin);
        context.statements->push_back({scanned.file, begin, std::max(begin, span.end)});
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
    ast_.includes[index].file = file;
    ast_.files.push_back({file, node.path_span});
    parse_file(file, context, ast_, *includes);
    includes->leave();
    builder.set_watermark();
}

Ast parse_lsys(FileId root, const ParseContext& context) {
    Ast ast;
    ast.files.push_back({root, {}});
    IncludeChain includes(context, root);
    parse_file(root, context, ast, includes);
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
