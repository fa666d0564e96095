// Interpretation: modules are drawn as what the productions of `#interpret` make of them. The
// derived word is the first of as many words as there are passes; the last of them is drawn, and
// none is stored.
#pragma once

#include "runtime/derive/derive.h"
#include "runtime/derive/word.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace lsys {

/// What a derivation has fixed for its last word.
struct InterpretInputs {
    std::uint64_t seed = 0;
    std::uint32_t generations = 0; // asked for; the age of the word
    std::uint64_t max_bytes = ~std::uint64_t{0};
    const std::atomic<bool>* cancelled = nullptr;
};

class Interpretation {
public:
    /// False ends the work.
    using Sink =
        std::function<bool(std::span<const Code>, std::span<const float>, std::span<const Origin>)>;

    /// Null where the program has no such productions. `bytecode` outlives it. `origins`: every
    /// piece has them.
    [[nodiscard]] static std::unique_ptr<Interpretation>
    make(const Bytecode& bytecode, const InterpretInputs& inputs, bool origins, Sink sink);
    virtual ~Interpretation() = default;
    Interpretation(const Interpretation&) = delete;
    Interpretation& operator=(const Interpretation&) = delete;

    /// Interprets the next modules of the derived word. Stop::Cancelled: the sink has ended the
    /// work.
    [[nodiscard]] virtual std::optional<Stop> feed(std::span<const Code> codes,
                                                   std::span<const float> parameters,
                                                   std::span<const Origin> origins) = 0;
    /// After Stop::Diagnosed.
    [[nodiscard]] virtual const RuntimeError& error() const = 0;

protected:
    Interpretation() = default;
};

} // namespace lsys
