// SPDX-License-Identifier: MIT
// Outcomes of exports, with messages for the case that an export writes no file.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/export/export.h"
#include "runtime/turtle/turtle_diagnostic.h"

#include <string>
#include <string_view>
#include <utility>

namespace lsys {

[[nodiscard]] Messages messages_of(Diagnostic diagnostic);
[[nodiscard]] Messages messages_of(std::string error);
Outcome<void> nothing_to_draw(ExportSubject subject);
/// Limit: a file of the format has a max size. `has_frames`: the plant moves or grows.
Outcome<void> too_large_for_format(ExportSubject subject, bool has_frames = false);
/// Limit: a skin of more than kMaxJoints joints.
Outcome<void> too_many_joints();
/// Success, or Cancelled if the sink has stopped.
Outcome<void> finish(PieceWriter& out);

/// The outcome of `run()`, or OutOfMemory with a message about `what`.
template <typename Run>
auto run_within_memory(std::string_view what, const Run& run) -> decltype(run()) {
    return catch_out_of_memory(run, [what]() -> decltype(run()) {
        return {Stop::OutOfMemory, messages_of(no_memory_diagnostic(what))};
    });
}

} // namespace lsys
