/* SPDX-License-Identifier: MIT */
/* The tokens of Houdini's rule texts. A line is a setting, the premise or a rule. Expressions stand within
   parentheses and after a `:`; elsewhere every character is a symbol. No pattern that may be long contains NUL. */

%option reentrant noyywrap nounput noinput nodefault never-interactive batch
%option 8bit full ecs
%option prefix="houdini_yy" extra-type="lsys::HoudiniSession*"

%x VALUE
%x MODULES
%x EXPRESSION
%x COMMENT

%{
#include "grammar/base/cancellation.h"
#include "grammar/base/scanner_memory.h"
#include "grammar/dialects/houdini/session.h"
#include "houdini/parser.h"

#define YY_DECL int houdini_yylex(lsys::SourceSpan* location, lsys::HoudiniSession& session, void* yyscanner)
#define YY_USER_ACTION                                                                             \
    lsys::stop_if_cancelled();                                                                     \
    *location = session.take(static_cast<std::uint32_t>(yyleng));

using Token = lsys::houdini_grammar::Parser::token;
%}

BLANK    [ \t\r]
NUMBER   ([0-9]+("."[0-9]*)?|"."[0-9]+)([eE][-+]?[0-9]+)?

%%

{BLANK}+                              { }
"\n"                                  { return Token::TOK_NEWLINE; }
("#"|"//"){BLANK}                     { BEGIN(COMMENT); }
"\xEF\xBB\xBF"                        { }
"#"/"\n"                              { }
([Rr]ule|RULE){BLANK}*"#"?{BLANK}*[0-9]*{BLANK}*[:=]     { BEGIN(MODULES); }
[bcd]{BLANK}*":"{BLANK}*[-+]?{NUMBER}{BLANK}*/"\n" {
    session.put_back(static_cast<std::uint32_t>(yyleng) - 1);
    yyless(1);
    static_cast<void>(session.key_token({yytext, 1}));
    *location = session.last();
    BEGIN(VALUE);
    return Token::TOK_KEY;
}
[A-Za-z][A-Za-z]+([ _-]+[A-Za-z]+)*{BLANK}*":"{BLANK}*[^=\n\0\r\t :][^=\n\0]*/"\n" { /* not a rule: it has no `=` */
    const std::string_view line(yytext, static_cast<std::size_t>(yyleng));
    const std::string_view key = line.substr(0, line.find(':'));
    const int kind = lsys::houdini_key(key) == "rule" ? 0 : session.any_key_token(key);
    const auto length = kind == 0 ? static_cast<std::uint32_t>(key.size() + 1) : session.length_of_key(key);
    session.put_back(static_cast<std::uint32_t>(yyleng) - length);
    yyless(static_cast<int>(length));
    *location = session.last();
    if (kind != 0) {
        BEGIN(VALUE);
        return kind;
    }
    BEGIN(MODULES);
}
[A-Za-z][A-Za-z]+([ _-]+[A-Za-z]+)*{BLANK}*[:=] {
    const int kind = session.key_token({yytext, static_cast<std::size_t>(yyleng) - 1});
    if (kind == 0) { // a line of modules
        session.put_back(static_cast<std::uint32_t>(yyleng));
        yyless(0);
        BEGIN(MODULES);
    } else {
        const auto length = session.length_of_key({yytext, static_cast<std::size_t>(yyleng) - 1});
        session.put_back(static_cast<std::uint32_t>(yyleng) - length);
        yyless(static_cast<int>(length));
        *location = session.last();
        BEGIN(VALUE);
        return kind;
    }
}
[^ \t\r\n]                            { session.put_back(1); yyless(0); BEGIN(MODULES); }

<COMMENT>{
[^\n\0]+                              { }
\0                                    { }
"\n"                                  { BEGIN(INITIAL); return Token::TOK_NEWLINE; }
}

<VALUE>{
{BLANK}*[:=]{BLANK}*                  { if (session.wants_modules()) { BEGIN(MODULES); } }
[^ \t\r\n:=\0][^\n\0]*                { return Token::TOK_VALUE; }
\0                                    { return Token::TOK_OTHER; }
{BLANK}+                              { }
"\n"                                  { BEGIN(INITIAL); return Token::TOK_NEWLINE; }
}

<MODULES>{
{BLANK}+                              { }
"\n"                                  { BEGIN(INITIAL); session.end_line(); return Token::TOK_NEWLINE; }
"("                                   { BEGIN(EXPRESSION); session.open(); return Token::TOK_OPEN; }
")"                                   { return Token::TOK_CLOSE; }
"<"                                   { return Token::TOK_LESS; }
">"                                   { return Token::TOK_GREATER; }
"="                                   { return Token::TOK_EQUALS; }
":"                                   { BEGIN(EXPRESSION); session.begin_condition(); return Token::TOK_COLON; }
","                                   { return Token::TOK_COMMA; }
[\xC2-\xF4][\x80-\xBF]+|[^ \t\r\n()<>=:,] { return Token::TOK_SYMBOL; }
}

<EXPRESSION>{
{BLANK}+                              { }
"\n"                                  { BEGIN(INITIAL); session.end_line(); return Token::TOK_NEWLINE; }
"("                                   { session.open(); return Token::TOK_OPEN; }
")"                                   {
    if (session.close()) {
        BEGIN(MODULES);
    }
    return Token::TOK_CLOSE;
}
{NUMBER}                              { return Token::TOK_NUMBER; }
[A-Za-z_][A-Za-z0-9_]*                { return Token::TOK_NAME; }
"\""[^"\n\0]*"\""                     { return Token::TOK_STRING; }
","                                   { return Token::TOK_COMMA; }
"=="                                  { return Token::TOK_EQUAL; }
"!="                                  { return Token::TOK_UNEQUAL; }
"<="                                  { return Token::TOK_AT_MOST; }
">="                                  { return Token::TOK_AT_LEAST; }
"<"                                   { return Token::TOK_LESS; }
">"                                   { return Token::TOK_GREATER; }
"&""&"?                               { return Token::TOK_AND; }
"|""|"?                               { return Token::TOK_OR; }
"!"                                   { return Token::TOK_NOT; }
"+"                                   { return Token::TOK_PLUS; }
"-"                                   { return Token::TOK_MINUS; }
"*"                                   { return Token::TOK_TIMES; }
"/"                                   { return Token::TOK_DIVIDE; }
"%"                                   { return Token::TOK_MODULO; }
"^"                                   { return Token::TOK_POWER; }
"="                                   {
    if (session.end_condition()) {
        BEGIN(MODULES);
    }
    return Token::TOK_EQUALS;
}
[\xC2-\xF4][\x80-\xBF]+|[^ \t\r\n]    { return Token::TOK_OTHER; }
}

<<EOF>>                               { *location = session.take(0); return Token::TOK_END; }

%%

namespace lsys {

/// Scans the text with a line end appended, since the last line may lack one.
HoudiniScanning::HoudiniScanning(HoudiniSession& session, std::string_view text) {
    if (houdini_yylex_init_extra(&session, &scanner_) != 0) {
        throw std::bad_alloc();
    }
    const std::string lines = std::string(text) + "\n";
    houdini_yy_scan_bytes(lines.data(), static_cast<int>(lines.size()), scanner_);
}

HoudiniScanning::~HoudiniScanning() {
    houdini_yylex_destroy(scanner_);
}

}
