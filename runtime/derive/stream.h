// Derivation without a stored word: depth-first expansion of a context-free parallel system, in
// memory that grows with the number of generations only. Each generation counts the modules it has
// passed, which is the position of the next, so draws are those of the stored word and the result
// is the same.
#pragma once

#include "runtime/derive/derive.h"

#include <cstdint>
#include <functional>
#include <span>

namespace lsys {

/// Whether the system can be streamed: parallel, without contexts. Otherwise a reason for the user.
[[nodiscard]] std::optional<std::string> why_not_streamable(const Bytecode& bytecode);

/// A run of modules of the last word, in order.
struct StreamChunk {
    std::span<const Code> codes;
    std::span<const float> parameters;
    std::span<const Origin> origins; // of each module, if DeriveOptions::origins asks for them
};
/// Returns false to stop the derivation (it then ends as Cancelled).
using StreamConsumer = std::function<bool(const StreamChunk&)>;

struct StreamOutcome {
    DeriveStatus status = DeriveStatus::Ok;
    RuntimeError error;
    LimitReport limit;
    std::uint64_t modules = 0;
    std::uint64_t parameters = 0;
};

/// Precondition: !why_not_streamable(bytecode). options.generations generations from the axiom.
[[nodiscard]] StreamOutcome derive_streamed(const Bytecode& bytecode,
                                            const DeriveOptions& options,
                                            const StreamConsumer& consumer);

} // namespace lsys
