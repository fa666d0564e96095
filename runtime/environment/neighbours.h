// SPDX-License-Identifier: MIT
// Neighbours: plants that shade a plant that senses, for heroes of a forest that grow among other
// trees (runtime/forest/surroundings.h). A neighbour is a plant of the same grammar that grew
// alone. When the sensing plant has age n, the neighbour shades it with the places and organs that
// the neighbour had at age n, so that both are about equally tall at every age.
#pragma once

#include "runtime/derive/derive.h"
#include "runtime/environment/word_sense.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// The parts of one word that cast shade: the places of its sense modules and its organs.
struct ShadingWord {
    std::vector<std::vector<Vector3>> places; // by environment; empty for kinds other than Shadow
    std::vector<SensedOrgan> organs;
};

/// A plant beside the sensing plant: turned by `turns` quarter turns from +X to -Z, then moved by
/// `x` and `z`.
struct Neighbour {
    std::uint32_t turns = 0;
    double x = 0.0; // m
    double z = 0.0; // m
};

struct Neighbours {
    std::vector<ShadingWord> words; // words of one plant, by age
    std::vector<Neighbour> plants;  // all of the same shape

    /// Appends the places of the neighbours' sense modules at an age; nothing if the recorded plant
    /// had no sense modules at that age.
    void append_places(std::uint32_t age,
                       std::size_t environment,
                       std::vector<SensePlace>& places) const;
    void append_organs(std::uint32_t age, std::vector<SensedOrgan>& organs) const;
};

/// Passes words on to the senses of a plant. In the derivation with the given seed, records the
/// places and organs of each word that cast shade.
class RecordingSense final : public WordSense {
public:
    /// `senses` and `bytecode` outlive the object.
    RecordingSense(EnvironmentSense& senses, const Bytecode& bytecode, std::uint64_t seed)
        : senses_(senses), bytecode_(bytecode), seed_(seed) {}

    [[nodiscard]] std::optional<Stop> begin(std::uint64_t seed,
                                            std::uint32_t generations,
                                            std::span<const float> globals,
                                            DerivationEnd& end) override;
    [[nodiscard]] std::optional<Stop>
    sense(Word& word, std::uint32_t age, DerivationEnd& end) override;
    [[nodiscard]] std::string state() const override { return senses_.state(); }
    [[nodiscard]] bool restore(std::string_view state) override { return senses_.restore(state); }

    /// The recorded words by age.
    [[nodiscard]] std::vector<ShadingWord> take_words() { return std::move(words_); }

private:
    EnvironmentSense& senses_;
    const Bytecode& bytecode_;
    std::uint64_t seed_;
    bool records_ = false;           // the derivation in progress has the seed `seed_`
    std::vector<ShadingWord> words_; // by age
};

} // namespace lsys
