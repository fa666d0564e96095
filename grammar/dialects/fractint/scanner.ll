/* The tokens of Fractint's .l collections. Between entries there are words, of which one may be the name of the
   entry that `{` opens. What an entry holds is one token while a collection is listed, and words of lines while one
   entry is read. `;` begins a comment everywhere. No pattern that may be long contains NUL. */

%option reentrant noyywrap nounput noinput nodefault never-interactive batch
%option 8bit full ecs case-insensitive stack noyy_top_state
%option prefix="fractint_yy" extra-type="lsys::FractintSession*"

%x BLOCK
%x LINE
%x REST
%x COMMENT

%{
#include "grammar/dialects/fractint/session.h"
#include "fractint/parser.h"

#define YY_DECL int fractint_yylex(lsys::SourceSpan* location, lsys::FractintSession& session, void* yyscanner)
#define YY_USER_ACTION                                                                             \
    *location = session.take(static_cast<std::uint32_t>(yyleng));

using Token = lsys::fractint_grammar::Parser::token;
%}

%%

%{
    if (const int start = session.start_token(); start != 0) {
        *location = session.take(0);
        if (start == Token::TOK_START_ENTRY) {
            BEGIN(LINE);
        }
        return start;
    }
%}

<*>[ \t\r\x1A]+                       { }
<INITIAL,BLOCK,LINE,REST>";"          { yy_push_state(COMMENT, yyscanner); }
<COMMENT>{
[^\n\0]+                              { }
\0                                    { }
"\n"                                  { session.untake(1); yyless(0); yy_pop_state(yyscanner); }
}

<INITIAL>"\xEF\xBB\xBF"               { }
<INITIAL,LINE,REST>\0                 { return Token::TOK_WORD; }
<BLOCK>\0                             { }

"\n"                                  { return Token::TOK_NEWLINE; }
"("[^\n;{\0]*                         { }
"{"                                   { BEGIN(BLOCK); return Token::TOK_OPEN; }
[^ \t\r\x1A\n(;{\0]+                   { return Token::TOK_WORD; }

<BLOCK>{
"}"                                   { BEGIN(INITIAL); return Token::TOK_CLOSE; }
"\n"+                                 { }
[^ \t\r\x1A\n;}\0]+                   { }
}

<LINE>{
"\n"                                  { return Token::TOK_NEWLINE; }
"="                                   { BEGIN(REST); return Token::TOK_EQUALS; }
axiom                                 { BEGIN(REST); return Token::TOK_AXIOM; }
angle                                 { BEGIN(REST); return Token::TOK_ANGLE; }
[^ \t\r\x1A\n;=\0]+                    { BEGIN(REST); return Token::TOK_KEY; }
}

<REST>{
"\n"                                  { BEGIN(LINE); return Token::TOK_NEWLINE; }
"="                                   { return Token::TOK_EQUALS; }
[^ \t\r\x1A\n;=\0]+                    { return Token::TOK_WORD; }
}

<<EOF>>                               { *location = session.take(0); return session.end_token(); }

%%

namespace lsys {

FractintScanning::FractintScanning(FractintSession& session, std::string_view text) {
    const int failed = fractint_yylex_init_extra(&session, &scanner_);
    LSYS_CHECK(failed == 0);
    fractint_yy_scan_bytes(text.data(), static_cast<int>(text.size()), scanner_);
}

FractintScanning::~FractintScanning() {
    fractint_yylex_destroy(scanner_);
}

}
