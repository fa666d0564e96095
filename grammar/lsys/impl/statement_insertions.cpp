// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/statement_insertions.h"

#include "grammar/base/characters.h"
#include "grammar/lsys/impl/statement_facts.h"

#include <string>
#include <string_view>
#include <utility>

namespace lsys::lsys_grammar {

namespace {

void report_unclosed(ParseSession& session) {
    const ScanState& scan = session.scan;
    if (!session.wants(DiagnosticCode::UnclosedParenthesis)) {
        return;
    }
    const OpenBracket& inner = scan.open.back();
    const auto character = [](const OpenBracket& bracket) {
        return bracket.kind == OpenBracket::Kind::Brace ? '{' : '(';
    };
    Diagnostic& diagnostic = session.report(
        DiagnosticCode::UnclosedParenthesis, session.scanned.span(inner.begin, inner.begin + 1),
        std::string("`") + character(inner) + "` is never closed");
    if (scan.open.size() > 1) {
        diagnostic.notes.push_back(std::to_string(scan.open.size()) +
                                   " brackets are open here, one inside the other");
    }
    std::string closing;
    constexpr std::size_t kMaxInserted = 100;
    for (std::size_t i = scan.open.size(); i > 0 && closing.size() < kMaxInserted; --i) {
        closing += scan.open[i - 1].kind == OpenBracket::Kind::Brace ? '}' : ')';
    }
    if (closing.size() == scan.open.size()) {
        add_fix(diagnostic, "add `" + closing + "`", session.insertion_place(), closing, true);
    }
}

/// Reports an arrow of other languages in the head of a production. Returns whether there is one.
bool report_arrow(const ParseSession& session, Diagnostics& diagnostics) {
    const ScanState& scan = session.scan;
    const std::string_view head =
        session.scanned.text.substr(scan.part_begin, scan.last_end - scan.part_begin);
    for (const std::string_view arrow : {"-->", "==>", "->", "=>"}) {
        const std::size_t at = head.find(arrow);
        if (at != std::string_view::npos && head.find(arrow, at + 1) == std::string_view::npos) {
            const auto begin = static_cast<std::uint32_t>(scan.part_begin + at);
            const SourceSpan span =
                session.scanned.span(begin, begin + static_cast<std::uint32_t>(arrow.size()));
            Diagnostic& diagnostic =
                diagnostics.add(DiagnosticCode::MissingColon, span,
                                "`" + std::string(arrow) + "` of other programs is `: * :` here");
            diagnostic.help.emplace_back(kFourParts);
            add_fix(diagnostic, "write `: * :`", span, ": * :", false);
            return true;
        }
    }
    return false;
}

/// Reports the end of a production before its successor.
void report_missing_parts(ParseSession& session) {
    const ScanState& scan = session.scan;
    if (!session.wants(DiagnosticCode::MissingColon)) {
        return;
    }
    const SourceSpan place = session.insertion_place();
    Diagnostics& diagnostics = session.context.diagnostics;
    if (scan.part == Part::Head) {
        if (report_arrow(session, diagnostics)) {
            return;
        }
        Diagnostic& diagnostic =
            diagnostics.add(DiagnosticCode::MissingColon, place,
                            "the production ends before its condition and its successor");
        diagnostic.help.emplace_back(kFourParts);
        if (scan.keyword == Keyword::Generations) {
            diagnostic.help.emplace_back("the number of generations is `#n = 6;`");
        }
        return;
    }
    if (scan.part == Part::Locals) {
        Diagnostic& diagnostic = diagnostics.add(DiagnosticCode::MissingColon, place,
                                                 "the production ends before its successor");
        diagnostic.help.emplace_back("local values are between two `:`, as in `#grow : A(x) : * "
                                     ": let l = x / 2 : F(l) A(l);`");
        return;
    }
    const std::string_view part =
        session.scanned.text.substr(scan.part_begin, scan.last_end - scan.part_begin);
    const bool is_condition = part.find_first_of("<>=!~&|") != std::string_view::npos ||
                              part.find_first_not_of(" \t\r\n*") == std::string_view::npos;
    if (is_condition) {
        Diagnostic& diagnostic = diagnostics.add(DiagnosticCode::MissingColon, place,
                                                 "the production ends before its successor");
        diagnostic.help.emplace_back(kFourParts);
        return;
    }
    const std::uint32_t first =
        scan.part_begin + static_cast<std::uint32_t>(part.find_first_not_of(kWhitespace));
    Diagnostic& diagnostic =
        diagnostics.add(DiagnosticCode::MissingColon, session.scanned.span(first, scan.last_end),
                        "the production has three parts, not four");
    diagnostic.help.emplace_back(kFourParts);
    const std::uint32_t at = session.scanned.source_begin(first);
    add_fix(diagnostic, "if this is the successor, add the condition `*`",
            {session.scanned.file, at, at}, "* : ", has_plain_head(session));
}

} // namespace

Token begin_insertion(ParseSession& session, Insertion kind, SourceSpan written) {
    ScanState& scan = session.scan;
    scan.inserting = kind;
    scan.pending_span = written;
    if (!scan.skipping && !scan.open.empty()) {
        report_unclosed(session);
    }
    if (kind != Insertion::Colon &&
        (scan.part == Part::Head || scan.part == Part::Condition || scan.part == Part::Locals)) {
        if (!scan.skipping) {
            report_missing_parts(session);
        }
        session.failed = true;
        session.builder.discard_statement();
    }
    return insert_token(session);
}

Token insert_token(ParseSession& session) {
    ScanState& scan = session.scan;
    if (!scan.open.empty()) {
        const SourceSpan place = session.insertion_place();
        switch (scan.pop()) {
        case OpenBracket::Kind::Module:
            return Token(Parser::token::TOK_CLOSE, place).as_inserted();
        case OpenBracket::Kind::Brace:
            return Token(Parser::token::TOK_RBRACE, place).as_inserted();
        case OpenBracket::Kind::Call:
        case OpenBracket::Kind::Group:
            return Token(Parser::token::TOK_RPAREN, place).as_inserted();
        }
    }
    if (scan.inserting == Insertion::Colon) {
        const SourceSpan colon = scan.pending_span;
        scan.inserting = Insertion::None;
        scan.last_end = scan.end;
        scan.enter(part_after_colon(session));
        return Token(Parser::token::TOK_COLON, colon);
    }
    if (scan.part == Part::Condition || scan.part == Part::Locals) {
        scan.enter(Part::Successor);
        return Token(Parser::token::TOK_COLON, session.insertion_place()).as_inserted();
    }
    if (scan.part == Part::Head) {
        scan.enter(Part::Successor); // an empty successor
        return Token(Parser::token::TOK_YYerror, session.insertion_place()).as_inserted();
    }
    if (scan.statement_open) {
        const SourceSpan place = session.insertion_place();
        scan.statement_open = false;
        scan.skipping = false;
        scan.ended_part = std::exchange(scan.part, Part::Between);
        if (scan.inserting == Insertion::Semicolon) {
            scan.inserting = Insertion::None;
            scan.last_end = scan.end;
            return Token(Parser::token::TOK_SEMICOLON, scan.pending_span);
        }
        if (scan.inserting == Insertion::NextStatement) {
            scan.inserting = Insertion::None;
        }
        scan.semicolon_inserted = true;
        return Token(Parser::token::TOK_SEMICOLON, place).as_inserted();
    }
    return Token(Parser::token::TOK_END, session.insertion_place()).as_inserted();
}

Token discard_statement(ParseSession& session) {
    ScanState& scan = session.scan;
    const SourceSpan span = session.token();
    scan.skipping = true;
    session.failed = true;
    session.builder.discard_statement();
    return Token(Parser::token::TOK_YYerror, span);
}

} // namespace lsys::lsys_grammar
