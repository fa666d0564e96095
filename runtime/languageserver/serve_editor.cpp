// SPDX-License-Identifier: MIT
#include "runtime/languageserver/serve_editor.h"

#include <algorithm>
#include <istream>
#include <mutex>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// The destructor ends LanguageServer::deliver_late(), which writes responses of `lsys/plant` to
/// the stream.
struct LateDelivery {
    explicit LateDelivery(LanguageServer& own_server) : server(own_server) {}
    LateDelivery(const LateDelivery&) = delete;
    LateDelivery& operator=(const LateDelivery&) = delete;
    ~LateDelivery() { server.deliver_late({}); }
    LanguageServer& server;
};

} // namespace

int serve_editor(LanguageServer& server,
                 std::istream& in,
                 std::ostream& out,
                 const std::function<bool()>& wait) {
    std::mutex writing; // guards `out`
    const auto write = [&](std::span<const std::string> bodies) {
        const std::lock_guard lock(writing);
        for (const std::string& body : bodies) {
            out << framed(body);
        }
        return static_cast<bool>(out.flush());
    };
    server.deliver_late([&](const std::string& body) { static_cast<void>(write({&body, 1})); });
    const LateDelivery delivery{server};
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
        if (!write(server.receive(messages))) {
            return 1;
        }
    }
    return server.exit_status();
}

} // namespace lsys
