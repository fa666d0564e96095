#include "grammar/dialects/fractint/session.h"

#include "fractint/parser.h"

namespace lsys {

FractintSession::FractintSession(FileId file, const ParseContext& parse_context)
    : context(parse_context), file_(file), name_{file, 0, 0} {}

FractintSession::FractintSession(const FractintEntry& entry, const ParseContext& parse_context)
    : context(parse_context), file_(entry.body.file), at_(entry.body.begin),
      is_entry_(true), name_{entry.body.file, 0, 0} {}

void FractintSession::parse(std::string_view text) {
    const FractintScanning scanning(*this, text);
    fractint_grammar::Parser parser(*this, scanning.scanner());
    static_cast<void>(parser.parse()); // what is wrong has been reported
}

int FractintSession::start_token() {
    using Token = fractint_grammar::Parser::token;
    if (started_) {
        return 0;
    }
    started_ = true;
    return is_entry_ ? Token::TOK_START_ENTRY : Token::TOK_START_COLLECTION;
}

int FractintSession::end_token() {
    using Token = fractint_grammar::Parser::token;
    const bool first = !ended_;
    ended_ = true;
    return first ? Token::TOK_NEWLINE : Token::TOK_END;
}

void FractintSession::see_word(SourceSpan word) {
    name_ = words_++ == 0 ? word : name_;
}

/// A name may stand alone on the line above its `{`.
void FractintSession::end_line() {
    if (words_ > 1) {
        name_.begin = name_.end;
    }
    words_ = 0;
}

void FractintSession::add_block(SourceSpan body) {
    entries.push_back({name_, body});
    name_.begin = name_.end;
    words_ = 0;
}

} // namespace lsys
