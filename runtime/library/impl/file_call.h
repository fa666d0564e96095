// SPDX-License-Identifier: MIT
// A public call that writes files to disk or passes them to a receiver. A console collects its
// messages.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/output/output_set.h"
#include "runtime/program/console.h"

#include <atomic>
#include <functional>
#include <lsys/export.h>
#include <string>
#include <vector>

namespace lsys::v0 {

class Call;

/// Runs `write` with a context of the call. If `receive` is null, writes files to disk, but none of
/// `inputs`. Returns the paths of the files.
[[nodiscard]] ::lsys::Outcome<std::vector<std::string>>
write_files(Call& call,
            const FileReceiver* receive,
            const std::vector<std::string>& inputs,
            const std::function<ExitStatus(const OutputContext& context)>& write);

} // namespace lsys::v0
