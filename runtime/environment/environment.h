// SPDX-License-Identifier: MIT
// Environment: answers the modules `?NAME` of one `#sense` statement (docs/language.md section 13).
// An environment gets all places of a word at once, and answers all of them. Places and directions
// are in metres and in the plant's own axes, +Y up. Answers depend only on the places, never on the
// number of threads. docs/language.md says for which kinds they do not depend on the order of the
// places.
//
// One kind of environment is one file of this folder: shadow.cpp, sky.cpp, space.cpp, crowd.cpp,
// solid.cpp, map.cpp, program.cpp.
#pragma once

#include "compiler/bytecode/environment.h"
#include "grammar/base/outcome.h"
#include "runtime/base/workers.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

using Vector3 = std::array<double, 3>;

/// The pose of the turtle at a sense module.
struct SensePlace {
    Vector3 position{}; // m
    Vector3 heading{};  // unit vector
    Vector3 up{};       // unit vector
};

/// An organ that casts shade: an object or a polygon.
struct SensedOrgan {
    Vector3 middle{};  // m
    double area = 0.0; // m^2
};

/// The input of an environment for one word.
struct SensedWord {
    std::uint32_t generation = 0;        // age of the word
    std::span<const SensePlace> places;  // places of the environment's own modules, in word order
    std::span<const SensedOrgan> organs; // organs of the whole word, in word order; for kind Sky
    /// Parameters of the modules at `places`, one after the other.
    std::span<const float> parameters;
    std::span<const std::uint32_t>
        first; // by place: index of its first parameter; last: the size of `parameters`
};

/// A closed or open surface of triangles.
struct EnvironmentMesh {
    std::vector<Vector3> vertices; // m
    /// Indexes of vertices, in the order of the file; a face with more than three corners is split
    /// into a fan of triangles.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A picture as grey values, 0 to 1, by rows: column 0 at the least x, row 0 at the least z.
struct EnvironmentPicture {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::vector<double> values; // columns * rows
};

/// The contents of the files that a BytecodeEnvironment names, in the order of its surfaces.
struct EnvironmentFiles {
    std::vector<EnvironmentMesh> meshes; // one for each surface with a path; Solid and Space
    EnvironmentPicture picture;          // Map
};

/// The reason why an environment has no answers.
struct EnvironmentFailure {
    Stop stop = Stop::Diagnosed;  // or OutOfMemory, Limit, Cancelled
    std::string text;             // Diagnosed: the reason, such as "its program has ended"
    std::string help;             // advice for the author, or empty
    std::uint64_t bytes = 0;      // Limit: memory that the answers would take
    std::size_t failed_place = 0; // Diagnosed: index of the place that has no answer
};

/// Resources of an environment. They must outlive the environment.
struct EnvironmentContext {
    Workers* workers = nullptr;
    const std::atomic<bool>* cancelled = nullptr; // becomes true to cancel; null: never
    std::uint64_t max_bytes = ~std::uint64_t{0};  // max bytes that the environment may hold
};

/// begin() and answer() may throw std::bad_alloc, which EnvironmentSense catches.
class Environment {
public:
    Environment() = default;
    virtual ~Environment() = default;
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

    /// Begins a derivation: drops data kept from an earlier derivation.
    [[nodiscard]] virtual std::optional<EnvironmentFailure> begin(std::uint64_t /*seed*/) {
        return std::nullopt; // most kinds keep nothing
    }
    /// Computes the answers at all places of the word: answers[i * size + k] is number k of the
    /// answer at places[i], where `size` is answer_size() of the kind. Numbers are computed in
    /// binary64 and rounded once to binary32; -0 becomes 0. `answers` has places.size() * size
    /// elements; a kind with kUnknownAnswerSize resizes it and sets `sizes` to the number of
    /// numbers for each place.
    [[nodiscard]] virtual std::optional<EnvironmentFailure> answer(
        const SensedWord& word, std::vector<float>& answers, std::vector<std::uint32_t>& sizes) = 0;
    /// The data that the environment keeps from one word to the next, as bytes for a saved state.
    [[nodiscard]] virtual std::string state() const { return {}; }
    /// Appends the positions of the markers that no place has killed, for dumps and viewers.
    virtual void append_markers(std::vector<Vector3>& /*markers*/) const {}
    /// Continues from bytes of state(), after begin(). False: the bytes are not of this
    /// environment.
    [[nodiscard]] virtual bool restore(std::string_view state) { return state.empty(); }
};

/// The maker of each kind. `declared` and `files` outlive the result; `number` is the index of the
/// environment in Bytecode::environments, a part of the key of its draws.
[[nodiscard]] std::unique_ptr<Environment> make_shadow(const BytecodeEnvironment& declared,
                                                       const EnvironmentContext& context);
[[nodiscard]] std::unique_ptr<Environment> make_sky(const BytecodeEnvironment& declared,
                                                    const EnvironmentContext& context);
[[nodiscard]] std::unique_ptr<Environment> make_space(const BytecodeEnvironment& declared,
                                                      const EnvironmentFiles& files,
                                                      std::uint32_t number,
                                                      const EnvironmentContext& context);
[[nodiscard]] std::unique_ptr<Environment> make_crowd(const BytecodeEnvironment& declared,
                                                      const EnvironmentContext& context);
[[nodiscard]] std::unique_ptr<Environment> make_solid(const BytecodeEnvironment& declared,
                                                      const EnvironmentFiles& files,
                                                      const EnvironmentContext& context);
[[nodiscard]] std::unique_ptr<Environment> make_map(const BytecodeEnvironment& declared,
                                                    const EnvironmentFiles& files,
                                                    const EnvironmentContext& context);

} // namespace lsys
