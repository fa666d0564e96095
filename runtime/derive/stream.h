// SPDX-License-Identifier: MIT
// Derivation without a stored word: depth-first expansion of a context-free parallel system, in
// memory that grows with the number of generations only. Each generation counts its modules, so the
// position of its next module is known, and draws and results equal those of a stored derivation.
#pragma once

#include "runtime/derive/derive.h"

#include <cstdint>
#include <functional>
#include <span>

namespace lsys {

/// The reason, for the user, why the system cannot be streamed: it is not parallel, or has
/// contexts, sense modules or sweeps.
[[nodiscard]] std::optional<std::string> streaming_obstacle(const Bytecode& bytecode);

/// A run of modules of the last word, in order.
struct StreamChunk {
    std::span<const Code> codes;
    std::span<const float> parameters;
    std::span<const Origin> origins; // one per module with DeriveOptions::origins, else none
};
/// Returns false to end the derivation with Stop::Cancelled.
using StreamConsumer = std::function<bool(const StreamChunk&)>;

/// End of a streamed derivation, and the numbers of modules and parameters given to the consumer.
struct StreamOutcome {
    DerivationEnd end;
    std::uint64_t modules = 0;
    std::uint64_t parameters = 0;
};

/// Derives options.generations generations from the axiom. Precondition:
/// !streaming_obstacle(bytecode).
[[nodiscard]] StreamOutcome derive_streamed(const Bytecode& bytecode,
                                            const DeriveOptions& options,
                                            const StreamConsumer& consumer);

} // namespace lsys
