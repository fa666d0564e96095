// One parse of one .lsys file: what the scanner, the parser and their reports share. Included files
// have sessions of their own, and all build the same Ast.
#pragma once

#include "grammar/ast/ast_builder.h"
#include "grammar/ast/include_chain.h"
#include "grammar/ast/text_map.h"
#include "grammar/base/diagnostic.h"
#include "grammar/lsys/impl/scan_state.h"
#include "grammar/lsys/parse.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

struct StrayCharacter;

class ParseSession {
public:
    ParseSession(const ParseContext& parse_context,
                 const ScannedText& scanned_text,
                 Ast& ast,
                 IncludeChain* include_chain)
        : context(parse_context), scanned(scanned_text), builder(scanned, ast, parse_context),
          includes(include_chain), ast_(ast) {}
    ParseSession(const ParseSession&) = delete;
    ParseSession& operator=(const ParseSession&) = delete;

    const ParseContext& context;
    const ScannedText scanned;
    AstBuilder builder;
    ScanState scan;
    IncludeChain* includes; // null where files are not to be read

    bool silent = false; // the scan is for its tokens only: nothing is reported
    std::vector<TextRange>* comments = nullptr;    // collects them, if it is set
    std::vector<StrayCharacter>* strays = nullptr; // the same; set in scans before the parse
    // Of the statement and the last token, for reports. The parser sets them too, so no token may
    // depend on them: a scan without the parser reads the same tokens.
    bool failed = false;         // a syntax error was reported: no more reports in this statement
    bool token_supplied = false; // nobody wrote the token

    /// The match at hand.
    [[nodiscard]] SourceSpan match() const { return scanned.span(scan.begin, scan.end); }
    [[nodiscard]] std::string_view match_text() const {
        return scanned.text.substr(scan.begin, scan.end - scan.begin);
    }
    /// The match at hand becomes a token.
    SourceSpan token() {
        scan.last_end = scan.end;
        scan.part_empty = false;
        return match();
    }
    /// A token that the author did not write, after the last one.
    [[nodiscard]] SourceSpan supplied() const { return scanned.after(scan.last_end); }

    /// Whether a report of a syntax error would be read: none in a statement that has failed.
    [[nodiscard]] bool wants_reports() const { return !silent && !failed; }
    /// The same for one of `code`; counts it if it is one too many to be stored.
    [[nodiscard]] bool wants(DiagnosticCode code) {
        return wants_reports() && context.diagnostics.admits(code);
    }

    /// Reports the match at hand.
    Diagnostic& report(DiagnosticCode code, std::string message) {
        return report(code, match(), std::move(message));
    }
    Diagnostic& report(DiagnosticCode code, SourceSpan span, std::string message) {
        return context.diagnostics.add(code, span, std::move(message));
    }

    // --- for the parser
    /// Keeps the statement unless `whole` is false or a part of it was lost; reads an included
    /// file.
    void end_statement(SourceSpan span, bool whole);
    /// The parser has recovered within the statement.
    void recover() {
        builder.recover();
        failed = false;
    }

private:
    /// Whether the line of `at` begins with `//`, so that it is read only because the statement
    /// before has no end. `at` never falls between calls: each reads on where the last one ended.
    [[nodiscard]] bool is_commented_out(std::size_t at);
    /// Offers, rather than applies, the fixes of a statement that stays wrong in part or stands
    /// behind `//`. Statements that may belong together are judged together.
    void judge_fixes();

    /// The diagnostics of statements that may belong together, by their numbers in the sink.
    struct JudgedDiagnostics {
        std::size_t first = 0;
        std::size_t end = 0;     // those before are judged
        bool is_partial = false; // an error without a certain fix is among them
    };

    Ast& ast_;
    JudgedDiagnostics judged_;
    std::size_t line_sought_to_ = 0;
    std::size_t line_first_ = std::string_view::npos; // first character that is not blank
};

} // namespace lsys
