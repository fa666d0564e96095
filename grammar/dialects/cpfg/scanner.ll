/* SPDX-License-Identifier: MIT */
/* The tokens of cpfg files, after the preprocessor. Expressions stand within the parentheses of a module, in
   conditions and in statements; elsewhere each character is the symbol of a module. A line that begins with a tab
   continues the line before; line ends within braces do not count. */

%option reentrant noyywrap nounput noinput nodefault never-interactive batch
%option 8bit full ecs
%option prefix="cpfg_yy" extra-type="lsys::CpfgSession*"

%{
#include "grammar/base/cancellation.h"
#include "grammar/base/scanner_memory.h"
#include "cpfg/parser.h"
#include "grammar/dialects/cpfg/session.h"

#define YY_DECL                                                                                    \
    int cpfg_yylex(lsys::cpfg_grammar::Parser::value_type* value, lsys::SourceSpan* location,      \
                   lsys::CpfgSession& session, void* yyscanner)
#define YY_USER_ACTION                                                                             \
    lsys::stop_if_cancelled();                                                                     \
    *location = session.take(static_cast<std::uint32_t>(yyleng));

using Token = lsys::cpfg_grammar::Parser::token;
using Mode = lsys::CpfgSession::Mode;

#define TEXT std::string(yytext, static_cast<std::size_t>(yyleng))
#define ITEM(kind, next)                                                                           \
    do {                                                                                           \
        session.mode = Mode::next;                                                                 \
        session.nesting = 0;                                                                       \
        return Token::TOK_##kind;                                                                  \
    } while (false)
#define OPERATOR(kind)                                                                             \
    do {                                                                                           \
        value->emplace<std::string>(TEXT);                                                                        \
        return Token::TOK_##kind;                                                                  \
    } while (false)
/* A command of several letters, without the blanks between them. */
#define COMMAND                                                                                    \
    do {                                                                                           \
        std::string name = TEXT;                                                                   \
        std::erase_if(name, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });             \
        value->emplace<std::string>(std::move(name));                                              \
        return Token::TOK_SYMBOL;                                                                  \
    } while (false)
%}

B       [ \t\r]
NAME    [A-Za-z][A-Za-z0-9_]*
NUMBER  ([0-9]+("."[0-9]*)?|"."[0-9]+)([eE][+-]?[0-9]+)?

%x SYMBOLS
%x EXPRESSION

%%

%{
    switch (session.mode) {
    case Mode::Line:
        BEGIN(INITIAL);
        break;
    case Mode::Symbols:
        BEGIN(SYMBOLS);
        break;
    case Mode::Expression:
        BEGIN(EXPRESSION);
        break;
    }
%}

<INITIAL>{
  {B}+                                   { }
  "\n"                                   { }
  [Ll]"system"{B}*":"                    { session.in_label = true; ITEM(LABEL, Symbols); }
  [Ss]"eed"{B}*":"                       { ITEM(SEED, Expression); }
  [Dd]"erivation"" "?[Ll]"ength"{B}*":"  { ITEM(LENGTH, Expression); }
  [Mm]"aximum "[Dd]"epth"{B}*":"         { ITEM(DEPTH, Expression); }
  [Cc]"onsider"{B}*":"                   { ITEM(CONSIDER, Symbols); }
  [Ii]"gnore"{B}*":"                     { ITEM(IGNORE, Symbols); }
  [Aa]"xiom"{B}*":"                      { ITEM(AXIOM, Symbols); }
  [Dd]"efine"{B}*":"                     { ITEM(DEFINE, Expression); }
  [Ss]"tart"{B}*":"                      { ITEM(START, Expression); }
  [Ee]"nd"{B}*":"                        { ITEM(FINISH, Expression); }
  [Ss]"tart"" "?[Ee]"ach"{B}*":"         { ITEM(START_EACH, Expression); }
  [Ee]"nd"" "?[Ee]"ach"{B}*":"           { ITEM(END_EACH, Expression); }
  [Hh]"omomorphism"{B}*":"?              { ITEM(HOMOMORPHISM, Symbols); }
  [Dd]"ecomposition"{B}*":"?             { ITEM(DECOMPOSITION, Symbols); }
  [Rr]"ing "[Ll]"system"                 { ITEM(RING, Symbols); }
  [Ee]"nd"[Ll]"system"                   { ITEM(END_SYSTEM, Symbols); }
  "production"[s]?":"                    { }
  .                                      {
                                           session.put_back(1);
                                           yyless(0);
                                           session.mode = Mode::Symbols;
                                           BEGIN(SYMBOLS);
                                         }
}

<SYMBOLS>{
  {B}+                  { }
  "\n\t"                { }
  "\n"                  { session.mode = Mode::Line; session.in_label = false; return Token::TOK_EOL; }
  "no warnings"|"warnings" { return Token::TOK_WARNINGS; }
  "-->"                 { session.mode = Mode::Symbols; return Token::TOK_ARROW; }
  "-o>"                 { return Token::TOK_OBJECT_ARROW; }
  ":"                   {
                          session.mode = Mode::Expression;
                          session.nesting = 0;
                          session.in_arguments = false;
                          return Token::TOK_COLON;
                        }
  "<"                   { return Token::TOK_CLT; }
  ">"                   { return Token::TOK_CGT; }
  "*"                   { return Token::TOK_NOTHING; }
  "("                   {
                          session.mode = Mode::Expression;
                          session.nesting = 1;
                          session.in_arguments = true;
                          return Token::TOK_OPEN;
                        }
  ")"                   { return Token::TOK_CLOSE; }
  "@"{B}*[GTCDPBS]{B}*[a-z] { COMMAND; }
  "@"[\x21-\x7E]{-}[<>:*] { COMMAND; }
  "@"{B}+[A-Za-z#]      { COMMAND; }
  "?"[PHULRE]           { OPERATOR(SYMBOL); }
  [\x21-\x7E]           { OPERATOR(SYMBOL); }
  .                     { return Token::TOK_OTHER; }
}

<EXPRESSION>{
  {B}+                  { }
  "\n"                  {
                          if (session.nesting == 0) {
                              session.mode = Mode::Line;
                              return Token::TOK_EOL;
                          }
                        }
  "\n\t"                { }
  "-->"                 { session.mode = Mode::Symbols; return Token::TOK_ARROW; }
  "-o>"                 { session.mode = Mode::Symbols; return Token::TOK_OBJECT_ARROW; }
  "("                   { ++session.nesting; return Token::TOK_LPAREN; }
  ")"                   {
                          session.nesting -= session.nesting > 0 ? 1 : 0;
                          if (session.nesting == 0 && session.in_arguments) {
                              session.in_arguments = false;
                              session.mode = Mode::Symbols;
                              return Token::TOK_CLOSE;
                          }
                          return Token::TOK_RPAREN;
                        }
  "{"                   { ++session.nesting; return Token::TOK_LBRACE; }
  "}"                   { session.nesting -= session.nesting > 0 ? 1 : 0; return Token::TOK_RBRACE; }
  "["                   { return Token::TOK_LBRACKET; }
  "]"                   { return Token::TOK_RBRACKET; }
  ";"                   { return Token::TOK_SEMICOLON; }
  ","                   { return Token::TOK_COMMA; }
  "?"                   { return Token::TOK_QUESTION; }
  ":"                   { return Token::TOK_COLON; }
  "="                   { return Token::TOK_ASSIGN; }
  "&&"                  { OPERATOR(AND); }
  "||"                  { OPERATOR(OR); }
  "=="                  { OPERATOR(EQUAL); }
  "!="|"<>"             { OPERATOR(NOT_EQUAL); }
  "<="                  { OPERATOR(LESS_EQUAL); }
  ">="                  { OPERATOR(GREATER_EQUAL); }
  "<"                   { OPERATOR(LESS); }
  ">"                   { OPERATOR(GREATER); }
  "+"                   { OPERATOR(PLUS); }
  "-"                   { OPERATOR(MINUS); }
  "*"                   { OPERATOR(TIMES); }
  "/"                   { OPERATOR(DIVIDE); }
  "%"                   { OPERATOR(REMAINDER); }
  "^"                   { OPERATOR(POWER); }
  "!"                   { OPERATOR(NOT); }
  "&"                   { return Token::TOK_ADDRESS; }
  "if"                  { return Token::TOK_IF; }
  "else"                { return Token::TOK_ELSE; }
  "while"               { return Token::TOK_WHILE; }
  "do"                  { return Token::TOK_DO; }
  "array"               { return Token::TOK_ARRAY; }
  "external"            { return Token::TOK_EXTERNAL; }
  {NAME}                { OPERATOR(NAME); }
  {NUMBER}              { OPERATOR(NUMBER); }
  "\""[^"\n]*"\""       { OPERATOR(STRING); }
  [\x80-\xFF][\x80-\xBF]*|. { return Token::TOK_OTHER; }
}

<<EOF>>                 {
                          *location = session.take(0);
                          if (session.mode != Mode::Line) {
                              session.mode = Mode::Line;
                              session.nesting = 0;
                              return Token::TOK_EOL;
                          }
                          return Token::TOK_END;
                        }

%%

namespace lsys {

CpfgScanning::CpfgScanning(CpfgSession& session, std::string_view text) {
    if (cpfg_yylex_init_extra(&session, &scanner_) != 0) {
        throw std::bad_alloc();
    }
    cpfg_yy_scan_bytes(text.data(), static_cast<int>(text.size()), scanner_);
}

CpfgScanning::~CpfgScanning() {
    cpfg_yylex_destroy(scanner_);
}

}
