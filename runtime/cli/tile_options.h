// SPDX-License-Identifier: MIT
// The options of `lsc place`, `lsc tiles` and `lsc serve`. lsc-mpi has the options of `lsc tiles`.
#pragma once

#include "runtime/cli/options.h"

namespace CLI {
class App;
}

namespace lsys::lsc {

/// The options of every command for its messages, and --version.
void add_message_options(CLI::App& app, MessageOptions& options);
void add_place(CLI::App& app, PlaceCommand& command);
void add_tiles(CLI::App& app, TilesCommand& command);
void add_serve(CLI::App& app, ServeCommand& command);

} // namespace lsys::lsc
