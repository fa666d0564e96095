// SPDX-License-Identifier: MIT
#include "runtime/pipeline/sensed_heroes.h"

#include "runtime/forest/tree_heights.h"

#include <utility>

namespace lsys {

namespace {

/// Passes words on to the senses of heroes, which are derived one after the other, and keeps what
/// each hero sensed last.
class HeroRecorder final : public WordSense {
public:
    HeroRecorder(WordSense& next,
                 const EnvironmentSense& hero_sense,
                 const Bytecode& bytecode,
                 const std::vector<EnvironmentFiles>& files)
        : next_(next), hero_sense_(hero_sense), bytecode_(bytecode), files_(files) {}

    [[nodiscard]] std::optional<Stop> begin(std::uint64_t seed,
                                            std::uint32_t generations,
                                            std::span<const float> globals,
                                            DerivationEnd& end) override {
        keep();
        has_begun_ = true;
        return next_.begin(seed, generations, globals, end);
    }
    [[nodiscard]] std::optional<Stop>
    sense(Word& word, std::uint32_t age, DerivationEnd& end) override {
        return next_.sense(word, age, end);
    }
    [[nodiscard]] std::string state() const override { return next_.state(); }
    [[nodiscard]] bool restore(std::string_view state) override { return next_.restore(state); }

    [[nodiscard]] std::vector<SensedPlant> take() {
        keep();
        return std::move(heroes_);
    }

private:
    void keep() {
        if (!std::exchange(has_begun_, false) || heroes_.size() == kMaxSensedHeroes) {
            return;
        }
        SensedPlant& hero = heroes_.emplace_back(sensed_plant_of(bytecode_, files_, hero_sense_));
        for (SensedPart& part : hero.parts) {
            if (heroes_.size() > 1) {
                part.meshes.clear();
                part.planes.clear();
            }
        }
    }

    WordSense& next_;
    const EnvironmentSense& hero_sense_;
    const Bytecode& bytecode_;
    const std::vector<EnvironmentFiles>& files_;
    bool has_begun_ = false; // a hero has begun whose senses are not in heroes_ yet
    std::vector<SensedPlant> heroes_;
};

} // namespace

CacheOutcome make_sensing_cache(const Bytecode& bytecode,
                                const PlantSenses& senses,
                                const EnvironmentSense* hero_sense,
                                CacheOptions options,
                                std::vector<SensedStage>* kept) {
    if (kept == nullptr || hero_sense == nullptr || bytecode.environments.empty()) {
        return make_instance_cache(bytecode, options);
    }
    HeroRecorder recorder(*options.senses, *hero_sense, bytecode, senses.files);
    options.senses = &recorder;
    CacheOutcome outcome = make_instance_cache(bytecode, options);
    if (outcome.ok()) {
        kept->push_back({recorder.take(), {}});
    }
    return outcome;
}

void finish_sensed_heroes(double scale,
                          const std::vector<const InstanceCache*>& caches,
                          SensedHeroes& heroes) {
    for (std::size_t i = 0; i < heroes.stages.size(); ++i) {
        SensedStage& stage = heroes.stages[i];
        for (SensedPlant& plant : stage.heroes) {
            plant.scale = scale;
        }
        for (const Bounds& box : make_height_table(*caches[i]).boxes) {
            if (!box.empty) {
                stage.bounds.add(box.low);
                stage.bounds.add(box.high);
            }
        }
    }
}

} // namespace lsys
