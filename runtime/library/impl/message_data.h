// SPDX-License-Identifier: MIT
// The data of the public Messages.
#pragma once

#include "grammar/base/outcome.h"

#include <lsys/messages.h>
#include <memory>
#include <vector>

namespace lsys::v0 {

struct Messages::Data {
    ::lsys::Messages messages;
    std::vector<Diagnostic> diagnostics;
};

[[nodiscard]] std::shared_ptr<const Messages::Data> make_message_data(::lsys::Messages messages);

} // namespace lsys::v0
