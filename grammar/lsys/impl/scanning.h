// One pass of the scanner over a session's text. The parser and whoever wants the tokens alone draw
// them from here.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/token.h"

namespace lsys::lsys_grammar {

/// The next token; END again and again after the last.
Token next_token(ParseSession& session, void* scanner);

class Scanning {
public:
    /// Precondition: the session outlives this.
    explicit Scanning(ParseSession& session);
    ~Scanning();
    Scanning(const Scanning&) = delete;
    Scanning& operator=(const Scanning&) = delete;

    [[nodiscard]] void* scanner() const { return scanner_; }

private:
    void* scanner_ = nullptr;
};

} // namespace lsys::lsys_grammar
