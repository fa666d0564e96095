/* The tokens of .sys files: words between blanks, and ends of lines. A word keeps the blanks within its
   parentheses. */

%option reentrant noyywrap nounput noinput nodefault never-interactive batch
%option 8bit full ecs
%option prefix="sys_yy" extra-type="lsys::SysSession*"

%{
#include "grammar/dialects/sys/session.h"
#include "sys/parser.h"

#define YY_DECL int sys_yylex(lsys::SourceSpan* location, lsys::SysSession& session, void* yyscanner)
#define YY_USER_ACTION                                                                             \
    *location = session.take(static_cast<std::uint32_t>(yyleng));

using Token = lsys::sys_grammar::Parser::token;
%}

%%

[ \t\r]+                              { }
"\n"([ \t\r]*"\n")*                   { return Token::TOK_NEWLINE; }
LSYSTEM                               { return Token::TOK_LSYSTEM; }
([^ \t\r\n(]|"("[^()\n]*")")+         { return Token::TOK_WORD; }
"("                                   { return Token::TOK_OPEN; }
<<EOF>>                               { *location = session.take(0); return session.at_end(); }

%%

namespace lsys {

SysScanning::SysScanning(SysSession& session, std::string_view text) {
    const int failed = sys_yylex_init_extra(&session, &scanner_);
    LSYS_CHECK(failed == 0);
    sys_yy_scan_bytes(text.data(), static_cast<int>(text.size()), scanner_);
}

SysScanning::~SysScanning() {
    sys_yylex_destroy(scanner_);
}

}
