/* SPDX-License-Identifier: MIT */
/* The tokens of .lsys files. Positions are byte offsets of the scanned text; Flex holds a copy of it. A run of
   module names, blanks and plain arguments, `F+F [ +(30) A`, is one token, because an axiom may have a hundred
   million modules. No long pattern contains NUL, at which Flex rescans the token from its start. Mistakes are
   handled in the files of impl/ that are included here. */

%option reentrant noyywrap nounput noinput nodefault never-interactive batch
%option 8bit full ecs
%option prefix="lsys_yy" extra-type="lsys::ParseSession*"

%{
#include "grammar/base/cancellation.h"
#include "grammar/base/scanner_memory.h"
#include "grammar/lsys/impl/adjacent_values.h"
#include "grammar/lsys/impl/expression_tokens.h"
#include "grammar/lsys/impl/lookahead.h"
#include "grammar/lsys/impl/module_tokens.h"
#include "grammar/lsys/impl/normalized_text.h"
#include "grammar/lsys/impl/number_tokens.h"
#include "grammar/lsys/impl/scanning.h"
#include "grammar/lsys/impl/statement_ends.h"
#include "grammar/lsys/impl/statement_insertions.h"
#include "grammar/lsys/impl/statement_start.h"
#include "grammar/lsys/impl/statement_tokens.h"
#include "lsys/parser.h"

#define YY_DECL                                                                                    \
    lsys::lsys_grammar::Token lsys::lsys_grammar::next_token(                        \
        lsys::ParseSession& session, void* yyscanner)

#define YY_USER_ACTION                                                                             \
    lsys::stop_if_cancelled();                                                                     \
    scan.begin = static_cast<std::uint32_t>(yytext - YY_CURRENT_BUFFER_LVALUE->yy_ch_buf);         \
    scan.end = scan.begin + static_cast<std::uint32_t>(yyleng);

/* Shortens the match to `length` bytes and updates scan.end. */
#define SHORTEN(length)                                                                            \
    do {                                                                                           \
        const int shortened = (length);                                                            \
        yyless(shortened);                                                                         \
        scan.end = scan.begin + static_cast<std::uint32_t>(shortened);                             \
    } while (false)
#define TEXT std::string_view(yytext, static_cast<std::size_t>(yyleng))
#define OPERATOR(kind)                                                                             \
    do {                                                                                           \
        const SourceSpan span = session.token();                                                   \
        scan.after_operator();                                                                     \
        return Token(Parser::token::TOK_##kind, span);                                                          \
    } while (false)
/* Skips a comment and returns to the current start condition. */
#define BEGIN_COMMENT(condition)                                                                   \
    do {                                                                                           \
        scan.comment_begin = scan.begin;                                                           \
        scan.comment_return = YY_START;                                                            \
        BEGIN(condition);                                                                          \
    } while (false)
/* Inserts an operator or a comma if the current value follows another one. */
#define BEGIN_VALUE()                                                                              \
    do {                                                                                           \
        if (scan.value_before) {                                                                   \
            yyless(0);                                                                             \
            return insert_before_value(session);                                                   \
        }                                                                                          \
    } while (false)
%}

BLANK   [ \t\r\n]
IDENT   [A-Za-z_][A-Za-z0-9_]*
SYMBOL  [-+/\\^&|$!"'.[\]{}%]
NUMBER  ([0-9]+("."[0-9]*)?|"."[0-9]+)([eE][+-]?[0-9]+)?
NUMBER_LIKE ([0-9]|"."[0-9])[0-9A-Za-z_.]*
PLAIN   "-"?{BLANK}*{NUMBER}
PLAINS  "("{BLANK}*{PLAIN}{BLANK}*(","{BLANK}*{PLAIN}{BLANK}*)*")"
NAME    "?"?{IDENT}|{SYMBOL}
ITEM    ({NAME})({BLANK}*{PLAINS})?
RUN     {ITEM}({BLANK}*{ITEM})*
CONTROL [\x01-\x08\x0B\x0C\x0E-\x1F\x7F]

%x OPENING
%x OBJECT_NAME
%x OBJECT_VALUE
%x SETTING
%x MODULES
%x EXPRESSION
%x SKIP
%x COMMENT
%x LINE_COMMENT
%x RANGE

%%

%{
    ScanState& scan = session.scan;
    const auto start_condition = [](const ScanState& state) {
        if (state.skipping) {
            return SKIP;
        }
        if (!state.open.empty()) {
            return EXPRESSION;
        }
        switch (state.part) {
        case Part::Between:
            return INITIAL;
        case Part::Opening:
            return OPENING;
        case Part::FunctionHead:
        case Part::Value:
        case Part::Probability:
        case Part::Condition:
        case Part::Locals:
            return EXPRESSION;
        case Part::ObjectName:
            return OBJECT_NAME;
        case Part::ObjectValue:
            return OBJECT_VALUE;
        case Part::Setting:
            return SETTING;
        case Part::Declaration:
        case Part::Ignored:
        case Part::Axiom:
        case Part::Head:
        case Part::Successor:
            return MODULES;
        }
        return INITIAL;
    };
    if (scan.inserting != Insertion::None) {
        return insert_token(session);
    }
    /* The start condition depends on the part of the statement, which changes only when a token is returned. */
    BEGIN(start_condition(scan));
%}

<INITIAL,OPENING,OBJECT_NAME,OBJECT_VALUE,SETTING,MODULES,EXPRESSION>{
  {BLANK}+              { }
}
<INITIAL,OPENING,OBJECT_NAME,OBJECT_VALUE,SETTING,MODULES,EXPRESSION,SKIP>{
  "/*"                  {
                          BEGIN_COMMENT(COMMENT);
                        }
  ";"                   {
                          if (report_colour_symbol(session)) {
                              return read_as_module(session, ";");
                          }
                          if (const auto token = semicolon(session)) {
                              return *token;
                          }
                        }
}

<COMMENT>{
  [^*\0]+               { }
  "*"+"/"               {
                          keep_comment(session);
                          BEGIN(scan.comment_return);
                        }
  "*"+                  { }
  \0                    { }
}
<LINE_COMMENT>{
  [^\n\0]+              { }
  \0                    { }
  \n                    {
                          scan.end = scan.begin;
                          keep_comment(session);
                          BEGIN(scan.comment_return);
                        }
}

<INITIAL>{
  "//"                  {
                          BEGIN_COMMENT(LINE_COMMENT);
                        }
  "#"[ \t]*{IDENT}      {
                          if (report_hash_comment(session, TEXT)) {
                              BEGIN_COMMENT(LINE_COMMENT);
                          } else {
                              const Token token = start_statement(session, TEXT);
                              yyless(static_cast<int>(scan.end - scan.begin)); /* scan the key of `#angle 30;` again */
                              return token;
                          }
                        }
  {IDENT}               {
                          return start_without_hash(session, TEXT);
                        }
  [^#;A-Za-z_ \t\r\n\0\x01-\x08\x0B\x0C\x0E-\x1F\x7F\x80-\xFF]|"#" {
                          return start_without_hash(session, {});
                        }
}

<SKIP>{
  [^;#/\0]+             { }
  "/"                   { }
  \0                    { }
}
<SKIP,OPENING,OBJECT_NAME,OBJECT_VALUE,SETTING,MODULES,EXPRESSION>{
  "#"                   {
                          if (begins_statement(session.scanned.text, scan.begin)) {
                              scan.next_statement = scan.begin;
                              SHORTEN(0);
                              return begin_insertion(session, Insertion::NextStatement, {});
                          }
                          if (YY_START == EXPRESSION || YY_START == SETTING) {
                              report_stray_hash(session);
                              if (!scan.value_before) {
                                  scan.value_before = true;
                                  return Token(Parser::token::TOK_BAD_VALUE, session.token());
                              }
                          } else if (YY_START == MODULES) {
                              report_foreign_symbol(session, '#');
                              return read_as_module(session, "#");
                          } else if (YY_START != SKIP) {
                              return Token(Parser::token::TOK_OTHER, session.token());
                          }
                        }
}

<OPENING>{
  ":"                   {
                          return opening_colon(session);
                        }
  [=,]                  {
                          return opening_sign(session);
                        }
  "~"                   {
                          if (scan.keyword == Keyword::Axiom) {
                              const SourceSpan span = session.token();
                              scan.enter(Part::Probability);
                              return Token(Parser::token::TOK_TILDE, span);
                          }
                          if (const auto missing = missing_opening(session)) {
                              SHORTEN(0);
                              return *missing;
                          }
                          return Token(Parser::token::TOK_OTHER, session.token());
                        }
  {IDENT}               {
                          if (const auto missing = missing_opening(session)) {
                              SHORTEN(0);
                              return *missing;
                          }
                          const SourceSpan span = session.token();
                          if (names_production(scan.keyword)) {
                              scan.name_before = true; // the `:` is next
                          } else if (scan.keyword == Keyword::Function) {
                              scan.enter(Part::FunctionHead);
                              scan.name_before = true; // the `(` is next
                          } else if (scan.keyword == Keyword::Curve || scan.keyword == Keyword::Contour ||
                                     scan.keyword == Keyword::Sense) {
                              scan.enter(Part::Setting);
                          } else {
                              scan.enter(scan.keyword == Keyword::Set ? Part::Setting : Part::Value);
                          }
                          return Token(Parser::token::TOK_IDENTIFIER, session.builder.intern(TEXT), span);
                        }
  [^:;=,#A-Za-z_ \t\r\n\0\x01-\x08\x0B\x0C\x0E-\x1F\x7F\x80-\xFF] {
                          if (const auto missing = missing_opening(session)) {
                              SHORTEN(0);
                              return *missing;
                          }
                          if (!report_needless_question_mark(session)) {
                              return Token(Parser::token::TOK_OTHER, session.token());
                          }
                        }
}

<OBJECT_NAME,OBJECT_VALUE>{
  "\""[^"\n\0]*"\""     {
    return Token(Parser::token::TOK_STRING, session.builder.intern(TEXT.substr(1, TEXT.size() - 2)),
                 session.token());
  }
}
<OBJECT_NAME>{
  {NAME}                {
                          if (yytext[0] == '"' && scan.keyword == Keyword::Include) {
                              return unclosed_quote(session);
                          }
                          const SourceSpan span = session.token();
                          scan.enter(Part::ObjectValue);
                          return Token(Parser::token::TOK_NAMES, {scan.begin, scan.end}, span);
                        }
}
<OBJECT_VALUE>{
  {IDENT}               { return Token(Parser::token::TOK_IDENTIFIER, session.builder.intern(TEXT), session.token()); }
  "("                   {
                          return opening_bracket(session, OpenBracket::Kind::Module, Parser::token::TOK_OPEN);
                        }
  "\""                  {
                          return unclosed_quote(session);
                        }
  "`"                   { return Token(Parser::token::TOK_OTHER, session.token()); }
}
<OBJECT_VALUE,SETTING>{
  "//"                  {
                          report_comment_in_statement(session);
                          BEGIN_COMMENT(LINE_COMMENT);
                        }
}
<OBJECT_NAME,OBJECT_VALUE>{
  ":"                   { return Token(Parser::token::TOK_COLON, session.token()); }
  [^:;#"`A-Za-z_ \t\r\n\0\x01-\x08\x0B\x0C\x0E-\x1F\x7F\x80-\xFF] {
                          return Token(Parser::token::TOK_OTHER, session.token());
                        }
}

<SETTING,EXPRESSION>{
  [$@]{IDENT}           {
                          if (scan.value_before) {
                              SHORTEN(1);
                              return Token(Parser::token::TOK_OTHER, session.token());
                          }
                          return foreign_value(session, TEXT);
                        }
  {IDENT}[ \t]*"("[ \t]*"\""[^"\n\0]*"\""[^()\n;\0]*")" {
                          BEGIN_VALUE();
                          return foreign_value(session, TEXT);
                        }
}
<SETTING>{
  {IDENT}               { return Token(Parser::token::TOK_IDENTIFIER, session.builder.intern(TEXT), session.token()); }
  {NUMBER}              {
                          const SourceSpan span = session.token();
                          return number(session, TEXT, span);
                        }
  {NUMBER_LIKE}         {
                          const SourceSpan span = session.token();
                          report_malformed_number(session, TEXT, span);
                          return Token(Parser::token::TOK_BAD_VALUE, span);
                        }
  "\""[^"\n\0]*"\""     {
                          if (!takes_file_names(scan.keyword)) {
                              SHORTEN(1);
                              return Token(Parser::token::TOK_OTHER, session.token());
                          }
                          return Token(Parser::token::TOK_STRING,
                                       session.builder.intern(TEXT.substr(1, TEXT.size() - 2)), session.token());
                        }
  "\""                  {
                          if (takes_file_names(scan.keyword)) {
                              return unclosed_quote(session);
                          }
                          return Token(Parser::token::TOK_OTHER, session.token());
                        }
  "-"                   { return Token(Parser::token::TOK_MINUS, session.token()); }
  "("                   {
                          return opening_bracket(session, OpenBracket::Kind::Group, Parser::token::TOK_LPAREN);
                        }
  [=:]                  {
                          if (!report_needless_sign(session)) {
                              return Token(Parser::token::TOK_OTHER, session.token());
                          }
                        }
  ","                   {
                          const bool separates =
                              scan.keyword == Keyword::Curve || scan.keyword == Keyword::Contour;
                          return Token(separates ? Parser::token::TOK_COMMA : Parser::token::TOK_OTHER,
                                       session.token());
                        }
  [^=:;,#"A-Za-z_0-9( \t\r\n\0\x01-\x08\x0B\x0C\x0E-\x1F\x7F\x80-\xFF-] {
                          return Token(Parser::token::TOK_OTHER, session.token());
                        }
}

<MODULES>{
  {RUN}                 {
                          const SourceSpan span = session.token();
                          return Token(Parser::token::TOK_NAMES, {scan.begin, scan.end}, span);
                        }
  {RUN}"*"              {
                          /* The run ends before a comment. */
                          SHORTEN(run_before_star(TEXT));
                          const SourceSpan span = session.token();
                          return Token(Parser::token::TOK_NAMES, {scan.begin, scan.end}, span);
                        }
  "("                   {
                          return opening_bracket(session, OpenBracket::Kind::Module, Parser::token::TOK_OPEN);
                        }
  ")"+                  {
                          switch (report_extra_parenthesis(session)) {
                          case StrayHandling::ReadAsModule:
                              SHORTEN(1);
                              return read_as_module(session, "]");
                          case StrayHandling::Discard:
                              return discard_statement(session);
                          default:
                              break;
                          }
                        }
  ":"                   {
                          if (!report_doubled_colon(session)) {
                              return colon_after_modules(session);
                          }
                        }
  [<>]                  {
                          if (scan.part == Part::Head) {
                              return Token(yytext[0] == '<' ? Parser::token::TOK_CLT : Parser::token::TOK_CGT,
                                           session.token());
                          }
                          report_foreign_symbol(session, yytext[0]);
                          return read_as_module(session, TEXT);
                        }
  [@*~=?,]|{NUMBER}     {
                          switch (report_stray_in_modules(session, TEXT)) {
                          case StrayHandling::Skip:
                              break;
                          case StrayHandling::ReadAsModule:
                              return read_as_module(session, TEXT);
                          case StrayHandling::SkipRange:
                              BEGIN(RANGE);
                              break;
                          case StrayHandling::InsertColon:
                              SHORTEN(0);
                              scan.enter(Part::Condition);
                              return Token(Parser::token::TOK_COLON, session.insertion_place());
                          case StrayHandling::EndStatement:
                              if (const auto token = semicolon(session)) {
                                  return *token;
                              }
                              break;
                          case StrayHandling::Discard:
                              return discard_statement(session);
                          }
                        }
}
<RANGE>{
  [^};:#`/\0]+          { }
  [};:#`/\0]            {
                          SHORTEN(0);
                          BEGIN(MODULES);
                        }
}

<MODULES,OBJECT_NAME>{
  "`"[^`\n\0]*"`"       {
                          normalize_quoted(session, TEXT);
                          const SourceSpan span = session.token();
                          if (session.builder.module_names() == ModuleNames::Characters &&
                              scan.part != Part::ObjectName) {
                              check_quoted_text(session, TEXT);
                              return Token(Parser::token::TOK_TEXT, {scan.begin, scan.end}, span);
                          }
                          const NameId name = quoted_name(session, TEXT, span);
                          if (scan.part == Part::ObjectName) {
                              scan.enter(Part::ObjectValue);
                          }
                          return Token(Parser::token::TOK_QUOTED, name, span);
                        }
  "`"                   { report_unclosed_back_quote(session); }
}

<EXPRESSION>{
  {NUMBER}              {
                          BEGIN_VALUE();
                          const SourceSpan span = session.token();
                          scan.value_before = true;
                          return number(session, TEXT, span);
                        }
  {NUMBER_LIKE}         {
                          BEGIN_VALUE();
                          if (const std::size_t length = number_before_name(TEXT); length != 0) {
                              SHORTEN(static_cast<int>(length));
                              const SourceSpan span = session.token();
                              scan.value_before = true;
                              return number(session, TEXT, span);
                          }
                          const SourceSpan span = session.token();
                          scan.value_before = true;
                          report_malformed_number(session, TEXT, span);
                          return Token(Parser::token::TOK_BAD_VALUE, span);
                        }
  {IDENT}               {
                          if (const auto token = local_value_token(session, TEXT)) {
                              return *token;
                          }
                          if (report_unit_word(session, TEXT)) {
                              break;
                          }
                          if (report_word_for_operator(session, TEXT)) {
                              if (yytext[0] == 'a') {
                                  OPERATOR(AND);
                              }
                              OPERATOR(OR);
                          }
                          if (report_word_for_not(session, TEXT)) {
                              return nesting_operator(session, Parser::token::TOK_NOT);
                          }
                          BEGIN_VALUE();
                          const SourceSpan span = session.token();
                          scan.value_before = true;
                          scan.name_before = true;
                          return Token(Parser::token::TOK_IDENTIFIER, session.builder.intern(TEXT), span);
                        }
  "("                   {
                          const bool is_call = scan.name_before;
                          if (!is_call) {
                              BEGIN_VALUE();
                          }
                          return opening_bracket(session, is_call ? OpenBracket::Kind::Call : OpenBracket::Kind::Group,
                                         Parser::token::TOK_LPAREN);
                        }
  "{"                   {
                          if (!begins_bounds(scan)) {
                              BEGIN_VALUE();
                          }
                          return opening_bracket(session, OpenBracket::Kind::Brace, Parser::token::TOK_LBRACE);
                        }
  [)}]                  {
                          const std::optional<Token> token =
                              closing_bracket(session, yytext[0]);
                          if (token) {
                              if (token->location.begin == token->location.end) {
                                  SHORTEN(0);
                              }
                              return *token;
                          }
                        }
  ","                   {
                          if (const auto token = local_value_token(session, TEXT)) {
                              return *token;
                          }
                          OPERATOR(COMMA);
                        }
  "*"                   { OPERATOR(STAR); }
  "/"                   { OPERATOR(SLASH); }
  "+"                   { OPERATOR(PLUS); }
  "<"                   { OPERATOR(LESS); }
  "<="                  { OPERATOR(LESS_EQUAL); }
  ">"                   { OPERATOR(GREATER); }
  ">="                  { OPERATOR(GREATER_EQUAL); }
  "=="                  { OPERATOR(EQUAL); }
  "!="                  { OPERATOR(NOT_EQUAL); }
  "&&"                  { OPERATOR(AND); }
  "||"                  { OPERATOR(OR); }
  "~"                   { OPERATOR(TILDE); }
  "-"                   {
                          if (scan.value_before) {
                              OPERATOR(MINUS);
                          }
                          return nesting_operator(session, Parser::token::TOK_MINUS);
                        }
  "!"                   { return nesting_operator(session, Parser::token::TOK_NOT); }
  "^"                   { return nesting_operator(session, Parser::token::TOK_CARET); }
  "!"{BLANK}+"="        { report_split_operator(session, TEXT); OPERATOR(NOT_EQUAL); }
  "="{BLANK}+"="        { report_split_operator(session, TEXT); OPERATOR(EQUAL); }
  "<"{BLANK}+"="        { report_split_operator(session, TEXT); OPERATOR(LESS_EQUAL); }
  ">"{BLANK}+"="        { report_split_operator(session, TEXT); OPERATOR(GREATER_EQUAL); }
  "&"{BLANK}+"&"        { report_split_operator(session, TEXT); OPERATOR(AND); }
  "|"{BLANK}+"|"        { report_split_operator(session, TEXT); OPERATOR(OR); }
  "&"                   { report_wrong_operator(session, "&&"); OPERATOR(AND); }
  "|"                   { report_wrong_operator(session, "||"); OPERATOR(OR); }
  "=<"                  { report_wrong_operator(session, "<="); OPERATOR(LESS_EQUAL); }
  "=>"                  { report_wrong_operator(session, ">="); OPERATOR(GREATER_EQUAL); }
  "<>"                  { report_wrong_operator(session, "!="); OPERATOR(NOT_EQUAL); }
  "==="                 { report_wrong_operator(session, "=="); OPERATOR(EQUAL); }
  "**"                  {
                          report_wrong_operator(session, "^");
                          return nesting_operator(session, Parser::token::TOK_CARET);
                        }
  "%"                   {
                          if (is_percent_sign(session)) {
                              break; /* read with its number */
                          }
                          if (scan.value_before) {
                              report_remainder_operator(session);
                              OPERATOR(SLASH);
                          }
                          return Token(Parser::token::TOK_OTHER, session.token());
                        }
  "="                   {
                          if (const auto token = local_value_token(session, TEXT)) {
                              return *token;
                          }
                          if (is_named_argument(session)) {
                              report_named_argument(session);
                              return discard_statement(session);
                          }
                          if (report_compound_assignment(session)) {
                              break;
                          }
                          if (!report_needless_sign(session)) {
                              report_assignment(session);
                              OPERATOR(EQUAL);
                          }
                        }
  "`"                   {
                          if (scan.open.empty()) {
                              scan.after_operator();
                              return Token(Parser::token::TOK_OTHER, session.token());
                          }
                          report_quoted_expression(session);
                        }
  "//"                  {
                          if (is_quotient(session.scanned.text, scan.end)) {
                              report_quotient(session);
                              OPERATOR(SLASH);
                          }
                          report_comment_in_statement(session);
                          BEGIN_COMMENT(LINE_COMMENT);
                        }
  "//*"                 { SHORTEN(1); OPERATOR(SLASH); }
  ":"                   {
                          if (!report_doubled_colon(session)) {
                              return colon_in_expression(session);
                          }
                        }
  [[\]$"'.?@\\]         { scan.after_operator(); return Token(Parser::token::TOK_OTHER, session.token()); }
}

<INITIAL,OPENING,OBJECT_NAME,OBJECT_VALUE,SETTING,MODULES,EXPRESSION>{
  {CONTROL}+|\0         { control_characters(session); }
}
<INITIAL,OPENING,OBJECT_NAME,OBJECT_VALUE,SETTING,MODULES,EXPRESSION>{
  [\x80-\xFF][\x80-\xBF]* { /* one character */
                          const int length = normalize_character(session, yytext, yyleng);
                          SHORTEN(length);
                        }
}

<<EOF>>                 {
                          scan.begin = scan.end = static_cast<std::uint32_t>(session.scanned.text.size());
                          if (YY_START == COMMENT) {
                              report_unclosed_comment(session);
                          }
                          if (YY_START == COMMENT || YY_START == LINE_COMMENT) {
                              keep_comment(session);
                          }
                          scan.next_statement = scan.end;
                          return begin_insertion(session, Insertion::EndOfFile, {});
                        }

%%

namespace lsys::lsys_grammar {

Scanning::Scanning(ParseSession& session) {
    if (lsys_yylex_init_extra(&session, &scanner_) != 0) {
        throw std::bad_alloc();
    }
    const std::string_view text = session.scanned.text;
    lsys_yy_scan_bytes(text.data(), static_cast<int>(text.size()), scanner_);
}

Scanning::~Scanning() {
    lsys_yylex_destroy(scanner_);
}

}
