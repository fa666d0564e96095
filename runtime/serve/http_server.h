// SPDX-License-Identifier: MIT
// Serves a TileService over HTTP/1.1 (RFC 9112), with Boost.Beast.
#pragma once

#include "grammar/base/result.h"
#include "runtime/serve/tile_service.h"

#include <cstdint>
#include <functional>
#include <string>

namespace lsys {

struct ServerOptions {
    std::string address = "127.0.0.1"; // IPv4 or IPv6
    std::uint16_t port = 8080;         // 0: the system chooses
    bool is_public = false;            // whether an address beyond this machine is allowed
    std::uint32_t threads = 0;         // to make tiles; 0: one per hardware thread
    std::uint32_t max_connections = 1024;
};

/// Serves until should_stop(), called about ten times a second, returns true; then finishes
/// responses for at most five seconds. `ready` is called with the address,
/// "http://127.0.0.1:8080/", when connections are accepted.
///
/// Closes connections without a request for 10 s, connections whose response takes longer than 2
/// minutes, and new connections beyond `max_connections`. Headers may have 16 KiB; requests with a
/// body are refused.
///
/// Errors: an invalid address; an address that other machines can reach, without `is_public`; a
/// port in use; a build without a server.
[[nodiscard]] Result<void> serve_tiles(TileService& service,
                                       const ServerOptions& options,
                                       const std::function<void(const std::string&)>& ready,
                                       const std::function<bool()>& should_stop);

} // namespace lsys
