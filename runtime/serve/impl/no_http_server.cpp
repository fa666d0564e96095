// SPDX-License-Identifier: MIT
// For systems without Boost.Asio.
#include "runtime/serve/http_server.h"

namespace lsys {

Result<void> serve_tiles(TileService&,
                         const ServerOptions&,
                         const std::function<void(const std::string&)>&,
                         const std::function<bool()>&) {
    return Error{"this build has no server"};
}

} // namespace lsys
