/* The tokens of .rules files: the key of a setting with its colon, and what stands between the `=` and `:` of a
   rule, without the blanks around it. No pattern that may be long contains NUL. */

%option reentrant noyywrap nounput noinput nodefault never-interactive batch
%option 8bit full ecs
%option prefix="carey_yy" extra-type="lsys::CareySession*"

%{
#include "grammar/dialects/carey/session.h"
#include "carey/parser.h"

#define YY_DECL int carey_yylex(lsys::SourceSpan* location, lsys::CareySession& session, void* yyscanner)
#define YY_USER_ACTION                                                                             \
    *location = session.take(static_cast<std::uint32_t>(yyleng));

using Token = lsys::carey_grammar::Parser::token;
%}

KEY    axiom|generations|step|step_scale|angle|angle_scale|thickness|thickness_scale|seed
TEXT   [^=: \t\r\n\0]+([ \t]+[^=: \t\r\n\0]+)*
VALUE  [^ \t\r\n\0]+([ \t]+[^ \t\r\n\0]+)*

%x RULE
%x SETTING

%%

<*>[ \t\r]+                   { }
<*>"\n"([ \t\r]*"\n")*        {
                                BEGIN(INITIAL);
                                return Token::TOK_NEWLINE;
                              }
<INITIAL>"\xEF\xBB\xBF"       { }
<INITIAL>{KEY}[ \t]*":"       {
                                BEGIN(SETTING);
                                return Token::TOK_KEY;
                              }
<SETTING>{VALUE}              { return Token::TOK_VALUE; }
<INITIAL,RULE>{TEXT}          {
                                BEGIN(RULE);
                                return Token::TOK_TEXT;
                              }
<INITIAL,RULE>"="             {
                                BEGIN(RULE);
                                return Token::TOK_EQUALS;
                              }
<INITIAL,RULE>":"             {
                                BEGIN(RULE);
                                return Token::TOK_COLON;
                              }
<*>\0                         { return Token::TOK_NUL; }
<<EOF>>                       { *location = session.take(0); return session.at_end(); }

%%

namespace lsys {

CareyScanning::CareyScanning(CareySession& session, std::string_view text) {
    const int failed = carey_yylex_init_extra(&session, &scanner_);
    LSYS_CHECK(failed == 0);
    carey_yy_scan_bytes(text.data(), static_cast<int>(text.size()), scanner_);
}

CareyScanning::~CareyScanning() {
    carey_yylex_destroy(scanner_);
}

}
