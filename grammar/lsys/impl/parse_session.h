// SPDX-License-Identifier: MIT
// ParseSession: the state shared by scanner, parser and reports during the parse of one .lsys file.
// Each included file has its own session; all build the same Ast.
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
    IncludeChain* includes; // null: included files are not read

    std::vector<DiagnosticCode> allowed;        // codes that comments allow for the next statement
    bool silent = false;                        // reports nothing
    std::vector<TextRange>* comments = nullptr; // receives comments; may be null
    std::vector<StrayCharacter>* strays = nullptr; // receives stray characters; null in the parse
    // No token may depend on `failed` or `token_inserted`, since the parser sets them, and scans
    // without a parser must yield the same tokens.
    bool failed = false;         // the statement has a syntax error and gets no further reports
    bool token_inserted = false; // the last token was inserted

    /// Place of the current match: the text that a rule of the scanner has matched last.
    [[nodiscard]] SourceSpan match() const { return scanned.span(scan.begin, scan.end); }
    [[nodiscard]] std::string_view match_text() const {
        return scanned.text.substr(scan.begin, scan.end - scan.begin);
    }
    /// Makes the current match a token; returns its span.
    SourceSpan token() {
        scan.last_end = scan.end;
        scan.part_empty = false;
        return match();
    }
    /// The span of an inserted token, after the last token.
    [[nodiscard]] SourceSpan insertion_place() const { return scanned.after(scan.last_end); }

    /// Whether syntax errors are reported: not after the first one of a statement.
    [[nodiscard]] bool wants_reports() const { return !silent && !failed; }
    /// Whether the caller should compose and report a syntax error of `code`. If the list of
    /// diagnostics is full, counts the error and returns false.
    [[nodiscard]] bool wants(DiagnosticCode code) {
        return wants_reports() && (is_independent(code) || !follows_doubtful_error()) &&
               context.diagnostics.admits(code);
    }

    /// Reports the current match.
    Diagnostic& report(DiagnosticCode code, std::string message) {
        return report(code, match(), std::move(message));
    }
    Diagnostic& report(DiagnosticCode code, SourceSpan span, std::string message) {
        return context.diagnostics.add(code, span, std::move(message));
    }

    // --- for the parser
    /// Ends a statement: keeps it if it is `whole`, that is without a syntax error, and not
    /// discarded; parses an included file.
    void end_statement(SourceSpan span, bool whole);
    /// Continues within a statement after an error.
    void recover() {
        builder.recover();
        failed = false;
    }

private:
    /// Whether an error of `code` is neither the cause nor the consequence of other errors.
    [[nodiscard]] static bool is_independent(DiagnosticCode code);
    /// Whether the current part of the statement has an error without a certain fix; later errors
    /// of the part may be consequences. A `:` begins a new part.
    [[nodiscard]] bool follows_doubtful_error();
    /// Whether the line of `at` begins with `//` and would be a comment if the statement before it
    /// were complete. Precondition: `at` never decreases between calls, since each call continues
    /// the search of the call before it.
    [[nodiscard]] bool is_commented_out(std::size_t at);
    /// Makes all fixes of a statement offers if one of its errors has no certain fix, or if the
    /// statement is on a line that begins with `//`. Statements that may belong together count as
    /// one.
    void offer_doubtful_fixes();

    /// Diagnostics of statements that may belong together, as a range of context.diagnostics.
    struct CheckedDiagnostics {
        std::size_t first = 0;
        std::size_t end = 0;             // diagnostics before this index have been checked
        bool has_doubtful_error = false; // one of the errors has no certain fix
    };

    /// Diagnostics of a part of a statement.
    struct PartDiagnostics {
        std::uint32_t part_begin = 0xFFFFFFFF; // offset at which the part begins; initially none
        std::size_t next = 0;                  // index of the first unchecked diagnostic
        bool has_doubtful_error = false;       // one of the errors has no certain fix
    };

    Ast& ast_;
    CheckedDiagnostics checked_;
    PartDiagnostics part_diagnostics_;
    std::size_t line_search_end_ = 0; // offset up to which is_commented_out() has searched
    // First character that is not a blank on the line searched last; npos: none.
    std::size_t line_first_ = std::string_view::npos;
};

} // namespace lsys
