// SPDX-License-Identifier: MIT
// The loop of `lsc lsp`: reads messages from a stream, and writes the messages of the server.
#pragma once

#include "runtime/languageserver/language_server.h"

#include <functional>
#include <iosfwd>

namespace lsys {

/// Serves until `exit` or the end of `in`. Calls `wait` before a read that may block; if it returns
/// false, serving ends. Returns the exit status: 0 if `shutdown` came before
/// `exit`; otherwise 1, also if `in` ends or `out` fails.
[[nodiscard]] int serve_editor(LanguageServer& server,
                               std::istream& in,
                               std::ostream& out,
                               const std::function<bool()>& wait);

} // namespace lsys
