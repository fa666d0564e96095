// SPDX-License-Identifier: MIT
// SensingTurtle: executes the modules of a complete word and reports the pose at each sense module
// `?NAME`, and the organs that cast shade (docs/language.md section 13). Position and frame are in
// binary64 with sines and cosines that are rounded correctly, so places are equal on every machine.
// The turtle that draws (turtle.h) is faster; its results may differ between machines.
//
// Turns change two axes: a yaw by a makes H' = cos(a) H + sin(a) R and R' = cos(a) R - sin(a) H,
// each product and sum rounded; frames are not normalised. Rotations about other axes (tropism, the
// operations Bend and PointAt) use the formula of Rodrigues for each of H, R, U: v' = (v cos(a) +
// (k x v) sin(a)) + k ((k . v) (1 - cos(a))). Cuts have no effect.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "grammar/base/outcome.h"
#include "runtime/derive/derive.h"
#include "runtime/derive/word.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace lsys {

/// Position in m, and axes, which are unit vectors up to rounding.
struct SensingPose {
    std::array<double, 3> position{};
    std::array<double, 3> heading{0.0, 1.0, 0.0};
    std::array<double, 3> right{1.0, 0.0, 0.0};
    std::array<double, 3> up{0.0, 0.0, 1.0};
};

/// A sense module of the word.
struct SenseModule {
    std::uint64_t position = 0;        // index in the word
    std::uint64_t first_parameter = 0; // index in Word::parameters()
    Code code = 0;
};

/// Receives the sense modules and organs of a word, in word order.
class SenseSink {
public:
    virtual ~SenseSink() = default;
    /// `pose`: pose of the turtle at the module.
    virtual void sense(const SenseModule& module, const SensingPose& pose) = 0;
    /// `area` in m^2, of an object or polygon whose middle is at `middle`.
    virtual void organ(const std::array<double, 3>& middle, double area) = 0;

protected:
    SenseSink() = default;
    SenseSink(const SenseSink&) = default;
    SenseSink& operator=(const SenseSink&) = default;
};

struct SensingOptions {
    std::uint64_t seed = 0; // seed of the draws of `#interpret`
    bool organs = false;    // whether to report organs
    /// Lengths along +Y of the files of MeshFile symbols, by symbol; empty: 1 each.
    std::vector<float> mesh_lengths;
    /// Half the areas of the triangles of the files of MeshFile symbols, by symbol, m^2 at size 1.
    std::vector<double> mesh_areas;
    /// Half the area of the triangles of LEAF, m^2 at size 1.
    double leaf_area = 0.0;
    /// Half the area of the triangles of FLOWER, m^2 at size 1.
    double flower_area = 0.0;
    std::uint64_t max_bytes = ~std::uint64_t{0};  // limit of the stack of `[`
    const std::atomic<bool>* cancelled = nullptr; // becomes true to cancel; null: never
};

class SensingTurtle {
public:
    /// `bytecode` must outlive the turtle.
    SensingTurtle(const Bytecode& bytecode, SensingOptions options);
    ~SensingTurtle();
    SensingTurtle(const SensingTurtle&) = delete;
    SensingTurtle& operator=(const SensingTurtle&) = delete;

    /// Executes a word of age `age` after the productions of `#interpret` have rewritten it. If a
    /// production replaces a sense module, the module is reported where its successor begins. Sense
    /// modules that productions write are skipped. Stop::Diagnosed: error() is set.
    [[nodiscard]] std::optional<Stop> walk(const Word& word, std::uint32_t age, SenseSink& sink);
    [[nodiscard]] const RuntimeError& error() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys
