// SPDX-License-Identifier: MIT
#include "runtime/environment/neighbours.h"

#include "runtime/base/out_of_memory.h"

namespace lsys {

namespace {

/// Moves a point of a plant to where the point is if the plant stands at `neighbour`.
Vector3 moved(const Vector3& point, const Neighbour& neighbour) {
    double x = point[0];
    double z = point[2];
    for (std::uint32_t turn = 0; turn < neighbour.turns; ++turn) {
        const double before = x;
        x = z;
        z = 0.0 - before;
    }
    return {x + neighbour.x, point[1], z + neighbour.z};
}

} // namespace

void Neighbours::append_places(std::uint32_t age,
                               std::size_t environment,
                               std::vector<SensePlace>& places) const {
    if (age >= words.size() || environment >= words[age].places.size()) {
        return;
    }
    for (const Neighbour& neighbour : plants) {
        for (const Vector3& place : words[age].places[environment]) {
            places.push_back({moved(place, neighbour), {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}});
        }
    }
}

void Neighbours::append_organs(std::uint32_t age, std::vector<SensedOrgan>& organs) const {
    if (age >= words.size()) {
        return;
    }
    for (const Neighbour& neighbour : plants) {
        for (const SensedOrgan& organ : words[age].organs) {
            organs.push_back({moved(organ.middle, neighbour), organ.area});
        }
    }
}

std::optional<Stop> RecordingSense::begin(std::uint64_t seed,
                                          std::uint32_t generations,
                                          std::span<const float> globals,
                                          DerivationEnd& end) {
    records_ = seed == seed_;
    return senses_.begin(seed, generations, globals, end);
}

std::optional<Stop> RecordingSense::sense(Word& word, std::uint32_t age, DerivationEnd& end) {
    if (const std::optional<Stop> stop = senses_.sense(word, age, end); stop || !records_) {
        return stop;
    }
    const auto record = [&]() -> std::optional<Stop> {
        if (words_.size() <= age) {
            words_.resize(age + std::size_t{1});
        }
        ShadingWord& shading = words_[age];
        shading.organs = senses_.organs();
        shading.places.resize(senses_.sensed().size());
        for (std::size_t i = 0; i < shading.places.size(); ++i) {
            shading.places[i].clear();
            if (bytecode_.environments[i].kind == EnvironmentKind::Shadow) {
                for (const SensePlace& place : senses_.sensed()[i].places) {
                    shading.places[i].push_back(place.position);
                }
            }
        }
        return std::nullopt;
    };
    return catch_out_of_memory(record, [] { return std::optional(Stop::OutOfMemory); });
}

} // namespace lsys
