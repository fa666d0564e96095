// SPDX-License-Identifier: MIT
// serve_tiles() of a build without LSYS_SERVER.
#include "runtime/serve/http_server.h"

namespace lsys {

Result<void> serve_tiles(TileService&,
                         const ServerOptions&,
                         const std::function<void(const std::string&)>&,
                         const std::function<bool()>&) {
    return Error{"this build has no server"};
}

} // namespace lsys
