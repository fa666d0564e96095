// SPDX-License-Identifier: MIT
// Scanning: one pass of the scanner over the text of a session, with a parser or without.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/token.h"

namespace lsys::lsys_grammar {

/// The next token; END after the last one.
Token next_token(ParseSession& session, void* scanner);

class Scanning {
public:
    /// `session` must outlive this object.
    explicit Scanning(ParseSession& session);
    ~Scanning();
    Scanning(const Scanning&) = delete;
    Scanning& operator=(const Scanning&) = delete;

    [[nodiscard]] void* scanner() const { return scanner_; }

private:
    void* scanner_ = nullptr;
};

} // namespace lsys::lsys_grammar
