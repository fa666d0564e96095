// SPDX-License-Identifier: MIT
// Interpretation: applies the productions of `#interpret` to a derived word in passes, and gives
// the modules to draw to a sink. No word of a pass is stored.
#pragma once

#include "runtime/derive/derive.h"
#include "runtime/derive/word.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace lsys {

/// Values of the derivation that made the word, and limits of the interpretation.
struct InterpretInputs {
    std::uint64_t seed = 0;
    std::uint32_t generations = 0; // the age of the word
    std::uint64_t max_bytes = ~std::uint64_t{0};
    const std::atomic<bool>* cancelled = nullptr; // becomes true to cancel; null: never
};

class Interpretation {
public:
    /// Receives modules to draw. Returns false to end the interpretation.
    using Sink =
        std::function<bool(std::span<const Code>, std::span<const float>, std::span<const Origin>)>;

    /// Returns null if the program has no productions of `#interpret`. `bytecode` must outlive the
    /// result. `origins`: feed() and the sink get the origin of each module.
    [[nodiscard]] static std::unique_ptr<Interpretation>
    make(const Bytecode& bytecode, const InterpretInputs& inputs, bool origins, Sink sink);
    virtual ~Interpretation() = default;
    Interpretation(const Interpretation&) = delete;
    Interpretation& operator=(const Interpretation&) = delete;

    /// Interprets the next modules of the derived word. Stop::Cancelled: the sink returned false.
    [[nodiscard]] virtual std::optional<Stop> feed(std::span<const Code> codes,
                                                   std::span<const float> parameters,
                                                   std::span<const Origin> origins) = 0;
    /// The error after Stop::Diagnosed.
    [[nodiscard]] virtual const RuntimeError& error() const = 0;

protected:
    Interpretation() = default;
};

} // namespace lsys
