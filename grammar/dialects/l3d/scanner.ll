/* The tokens of files of L3D: three numbers, then lines up to `@`. A `#` is a comment only where a token
   could begin. No pattern that may be long contains NUL. */

%option reentrant noyywrap nounput noinput nodefault never-interactive batch
%option 8bit full ecs
%option prefix="l3d_yy" extra-type="lsys::L3dSession*"

%{
#include "grammar/dialects/l3d/session.h"
#include "l3d/parser.h"

#define YY_DECL int l3d_yylex(lsys::SourceSpan* location, lsys::L3dSession& session, void* yyscanner)
#define YY_USER_ACTION                                                                             \
    *location = session.take(static_cast<std::uint32_t>(yyleng));

using Token = lsys::l3d_grammar::Parser::token;
%}

BLANK   [ \t\r\n\v\f]
NUMBER  [-+]?([0-9]+"."?[0-9]*|"."[0-9]+)([eE][-+]?[0-9]+)?
FIRST   [^=\n\0#@ \t\r\v\f]

%x BODY
%x VALUE
%x DONE

%%

%{
    if (session.in_value) {
        BEGIN(VALUE);
    } else if (session.mark) {
        BEGIN(DONE);
    } else if (session.numbers.size() == 3) {
        BEGIN(BODY);
    }
%}

<INITIAL,BODY>{BLANK}+        { }
<INITIAL,BODY>"#"[^\n\0]*     { }
<INITIAL>{NUMBER}             {
                                session.numbers.push_back(*location);
                                return Token::TOK_NUMBER;
                              }
<INITIAL>[^ \t\r\n\v\f#\0]+   { return Token::TOK_WORD; }
<BODY>"@"                     {
                                session.mark = *location;
                                return Token::TOK_MARK;
                              }
<BODY>({FIRST}[^=\n\0]*)?"="  {
                                session.in_value = true;
                                return Token::TOK_KEY;
                              }
<BODY>{FIRST}[^=\n\0]*        { return Token::TOK_AXIOM; }
<VALUE>[^\n\0]+               {
                                session.in_value = false;
                                return Token::TOK_VALUE;
                              }
<VALUE>"\n"                   {
                                session.in_value = false;
                                location->end = location->begin;
                                return Token::TOK_VALUE;
                              }
<DONE>.|\n                    { return Token::TOK_END; }
<INITIAL,BODY,VALUE>\0        {
                                session.in_value = false;
                                return Token::TOK_NUL;
                              }
<<EOF>>                       {
                                *location = session.take(0);
                                const bool empty = session.in_value;
                                session.in_value = false;
                                return empty ? Token::TOK_VALUE : Token::TOK_END;
                              }

%%

namespace lsys {

L3dScanning::L3dScanning(L3dSession& session, std::string_view text) {
    const int failed = l3d_yylex_init_extra(&session, &scanner_);
    LSYS_CHECK(failed == 0);
    l3d_yy_scan_bytes(text.data(), static_cast<int>(text.size()), scanner_);
}

L3dScanning::~L3dScanning() {
    l3d_yylex_destroy(scanner_);
}

}
