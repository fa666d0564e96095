// SPDX-License-Identifier: MIT
#include "runtime/languageserver/serve_editor.h"

#include <algorithm>
#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

int serve_editor(LanguageServer& server,
                 std::istream& in,
                 std::ostream& out,
                 const std::function<bool()>& wait) {
    MessageReader reader;
    std::string piece;
    while (!server.has_exited() && (in.rdbuf()->in_avail() > 0 || wait()) &&
           in.peek() != std::istream::traits_type::eof()) {
        // Reads the bytes that are there without waiting for more.
        const std::streamsize available = std::max<std::streamsize>(in.rdbuf()->in_avail(), 1);
        piece.resize(static_cast<std::size_t>(std::min<std::streamsize>(available, 1 << 16)));
        in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        reader.add(std::string_view(piece).substr(0, static_cast<std::size_t>(in.gcount())));
        std::vector<ReadMessage> messages;
        while (std::optional<ReadMessage> message = reader.next()) {
            messages.push_back(std::move(*message));
        }
        if (messages.empty()) {
            continue;
        }
        for (const std::string& answer : server.receive(messages)) {
            out << framed(answer);
        }
        if (!out.flush()) {
            return 1;
        }
    }
    return server.exit_status();
}

} // namespace lsys
