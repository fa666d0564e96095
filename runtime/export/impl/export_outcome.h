// Outcomes of exports that write no file, and their messages.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/export/export.h"
#include "runtime/turtle/turtle_diagnostic.h"

#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace lsys {

[[nodiscard]] Messages messages_of(Diagnostic diagnostic);
[[nodiscard]] Messages messages_of(std::string error);
Outcome<void> nothing_to_draw(ExportSubject subject);
Outcome<void> too_large_for_format(ExportSubject subject);
/// Done, or Cancelled where the sink has stopped.
Outcome<void> finish(PieceWriter& out);

/// The outcome of `run()`, or OutOfMemory with a message about `what` if it throws bad_alloc or
/// length_error.
template <typename Run>
auto catch_no_memory(std::string_view what, const Run& run) -> decltype(run()) {
    try {
        return run();
    } catch (const std::bad_alloc&) {
    } catch (const std::length_error&) {
    }
    return {Stop::OutOfMemory, messages_of(no_memory_diagnostic(what))};
}

} // namespace lsys
