// SPDX-License-Identifier: MIT
// Environments in tests: random places, and the answers of an environment at these places.
#pragma once

#include "runtime/base/workers.h"
#include "runtime/environment/environment.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <vector>

namespace lsys::asked {

inline SensePlace place_at(double x, double y, double z) {
    return {{x, y, z}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
}

/// Random numbers that are the same with every standard library.
class Draws {
public:
    explicit Draws(std::uint64_t seed) : engine_(seed) {}

    /// A random number from 0 to below 1.
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    std::size_t below(std::size_t end) { return engine_() % end; }
    template <typename T>
    const T& one_of(const std::vector<T>& items) {
        return items[below(items.size())];
    }
    Vector3 point(double radius) {
        return {between(-radius, radius), between(-radius, radius), between(-radius, radius)};
    }
    std::vector<SensePlace> places(std::size_t count, double radius) {
        std::vector<SensePlace> places(count);
        for (SensePlace& place : places) {
            place.position = point(radius);
        }
        return places;
    }

private:
    std::mt19937_64 engine_;
};

struct Answers {
    std::optional<EnvironmentFailure> failure;
    std::vector<float> numbers;
};

/// Threads, memory and cancellation of an environment.
struct Resources {
    std::uint32_t threads = 2;
    std::uint64_t max_bytes = ~std::uint64_t{0};
    bool is_cancelled = false;
};

/// The answers of the environment that `make` returns.
template <typename Make>
Answers ask(const Make& make,
            const std::vector<SensePlace>& places,
            const std::vector<SensedOrgan>& organs,
            std::uint32_t answer_size,
            const Resources& resources) {
    Workers workers(resources.threads);
    const std::atomic<bool> cancelled{resources.is_cancelled};
    EnvironmentContext context;
    context.workers = &workers;
    context.cancelled = &cancelled;
    context.max_bytes = resources.max_bytes;
    const std::unique_ptr<Environment> environment = make(context);
    Answers answers;
    answers.failure = environment->begin(0);
    if (answers.failure) {
        return answers;
    }
    SensedWord word;
    word.places = places;
    word.organs = organs;
    answers.numbers.assign(places.size() * answer_size, -7.0F);
    std::vector<std::uint32_t> sizes;
    answers.failure = environment->answer(word, answers.numbers, sizes);
    return answers;
}

inline Answers ask_shadow(const BytecodeEnvironment& declared,
                          const std::vector<SensePlace>& places,
                          const Resources& resources) {
    return ask([&](const EnvironmentContext& context) { return make_shadow(declared, context); },
               places, {}, 4, resources);
}

inline Answers ask_sky(const BytecodeEnvironment& declared,
                       const std::vector<SensedOrgan>& organs,
                       const std::vector<SensePlace>& places,
                       const Resources& resources) {
    return ask([&](const EnvironmentContext& context) { return make_sky(declared, context); },
               places, organs, 1, resources);
}

inline Answers ask_map(const BytecodeEnvironment& declared,
                       const EnvironmentPicture& picture,
                       const std::vector<SensePlace>& places,
                       const Resources& resources) {
    EnvironmentFiles files;
    files.picture = picture;
    return ask(
        [&](const EnvironmentContext& context) { return make_map(declared, files, context); },
        places, {}, 1, resources);
}

} // namespace lsys::asked
