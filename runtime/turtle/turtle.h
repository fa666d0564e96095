// SPDX-License-Identifier: MIT
// The turtle: reads modules of a derived word in order and draws the skeleton (docs/language.md
// section 7). No character has a meaning here: the compiler gives each symbol its operation. State
// is in double precision, so that the frame stays orthonormal through ten million rotations and a
// plant far from the origin is as exact as a near one.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "grammar/base/outcome.h"
#include "runtime/derive/derive.h"
#include "runtime/derive/word.h"
#include "runtime/turtle/skeleton.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace lsys {

/// Faults of a word that the turtle cannot draw, or only in part. Unbalanced, NotFinite, TooMany
/// and EndOutside end the drawing.
enum class TurtleFaultKind : std::uint8_t {
    Unbalanced,       // a `]` without its `[`
    NotFinite,        // position, length or width is infinite or not a number
    TooMany,          // more than kMaxSkeletonItems segments, objects or corners
    UnclosedBranch,   // a `[` without its `]`
    NegativeWidth,    // drawn as 0
    VertexOutside,    // a `.` outside of a polygon: ignored
    EndOutside,       // a `}` without its `{`
    FewCorners,       // a polygon with fewer than three corners: not drawn
    UnclosedPolygon,  // a `{` without its `}`: not drawn
    SidesOutOfRange,  // fewer than 3 or more than 64 sides: clamped
    ColourOutOfRange, // below 0 or above 65,535: clamped
    RgbOutOfRange,    // a part below 0 or above 1: clamped
    SurfaceOutside,   // a point or end of an organ that is not open: ignored
    SurfaceWithin,    // an organ that begins within another of the same branch: ignored
    SmallSurface,     // an organ whose points are all at one place: not drawn
};
inline constexpr std::size_t kTurtleFaultKindCount = 15;
inline constexpr std::uint64_t kMaxSkeletonItems = 0xFFFFFFF0u;
inline constexpr std::uint32_t kMinSides = 3;
inline constexpr std::uint32_t kMaxSides = 64;

struct TurtleFault {
    std::uint64_t count = 0;    // occurrences
    std::uint64_t position = 0; // index of the first module at fault; 0 at the end of a word
    Code code = 0;              // code of that module; 0 at the end of a word
};

/// The end of a drawing, as facts for messages: whether it is complete, or why it is not.
struct DrawingEnd {
    std::optional<Stop> stop;          // none: the drawing is complete, or may go on
    std::optional<RuntimeError> error; // a production of `#interpret` that cannot be applied
    std::array<TurtleFault, kTurtleFaultKindCount> faults{};
};

/// Position and state of the turtle between two modules.
struct TurtlePlace {
    glm::dvec3 position{}; // m
    glm::dquat frame{1.0, 0.0, 0.0, 0.0};
    float width = 0.0F;          // m, diameter; or radius / length (width_is_relative)
    float taper = 1.0F;          // tip radius / base radius
    float step = 0.0F;           // m
    float angle = 0.0F;          // degrees
    float second_heading = 0.0F; // degrees from the first heading to the left
    std::uint32_t sides = 0;
    ItemColour colour = 0;
    std::uint32_t colour_index = 0;     // the last index that was set, even if `colour` is no index
    std::uint32_t texture = 0;          // number of the texture
    std::uint32_t order = 0;            // open brackets
    std::uint32_t contour = kNoContour; // index in Bytecode::contours; kNoContour: a circle
    float tangent_before = 1.0F;        // tangent length of organ axes / chord length
    float tangent_after = 1.0F;
    RadiusTangents radii; // of organs
};

/// Counts of the items drawn so far.
struct DrawnCounts {
    std::uint32_t segments = 0;
    std::uint32_t objects = 0;
    std::uint32_t polygons = 0;

    friend bool operator==(const DrawnCounts&, const DrawnCounts&) = default;
};

/// A `[` that begins a valid branch in the word of an instanced system (docs/language.md section
/// 9).
struct BranchStart {
    bool has_instance = false; // whether an instance replaces the branch
    std::uint32_t age = 0;     // age and id as in docs/language.md section 9.1
    std::uint32_t id = 0;
    std::span<const float> formals; // values of the formals that the branch uses
    TurtlePlace place;
    std::uint32_t segment = kNoSegment; // the segment that ends at `place`
    DrawnCounts drawn;                  // items drawn before the branch
    Origin origin;                      // origin of its `[`, if the words had origins
};

/// Called for each valid branch of a word when the turtle reads its brackets.
class BranchWatcher {
public:
    virtual ~BranchWatcher() = default;
    /// Returns false to skip the branch; end() is then not called for it.
    virtual bool begin(const BranchStart& start) = 0;
    /// The branch ends. `drawn`: counts of the items drawn so far.
    virtual void end(const DrawnCounts& drawn) = 0;

protected:
    BranchWatcher() = default;
    BranchWatcher(const BranchWatcher&) = default;
    BranchWatcher& operator=(const BranchWatcher&) = default;
};

struct TurtleOptions {
    /// Lengths along +Y of the files of MeshFile symbols, by symbol; empty: 1 each.
    std::vector<float> mesh_lengths;
    std::shared_ptr<const Looks> looks;           // Skeleton::looks
    std::uint64_t max_bytes = ~std::uint64_t{0};  // limit of the skeleton
    const std::atomic<bool>* cancelled = nullptr; // becomes true to cancel; null: never
    /// Options of the derivation of the word, which productions of `#interpret` read.
    std::uint64_t seed = 0;
    std::uint32_t generations = 0;
    BranchWatcher* branches = nullptr; // outlives the turtle; null: every branch is drawn
};

/// Draws a word, given in pieces, after the productions of `#interpret` have rewritten it.
/// Positions of faults are indexes in the rewritten word. Functions that return a Stop return none
/// on success; end() has the facts.
class Turtle {
public:
    /// `bytecode` must outlive the turtle.
    Turtle(const Bytecode& bytecode, TurtleOptions options);
    ~Turtle();
    Turtle(const Turtle&) = delete;
    Turtle& operator=(const Turtle&) = delete;

    /// Reserves room for the drawing of `word`; optional.
    [[nodiscard]] std::optional<Stop> reserve(const Word& word);
    /// Draws the next modules of the word; has no effect after a Stop. If `origins` are given, or
    /// the word keeps them, the drawing has origins too; all pieces must then have origins.
    [[nodiscard]] std::optional<Stop> feed(const Word& word);
    [[nodiscard]] std::optional<Stop> feed(std::span<const Code> codes,
                                           std::span<const float> parameters);
    [[nodiscard]] std::optional<Stop> feed(std::span<const Code> codes,
                                           std::span<const float> parameters,
                                           std::span<const Origin> origins);
    /// Ends the word; called once, after its last piece.
    [[nodiscard]] std::optional<Stop> finish();
    /// Begins another word, derived with `seed`: the turtle returns to its start, and the skeleton
    /// keeps its items.
    /// Precondition: finish() was called, and no Stop was returned.
    void begin_word(std::uint64_t seed);
    /// Position and state of the turtle after the modules fed so far.
    [[nodiscard]] TurtlePlace place() const;
    /// Counts of the items that these modules have drawn.
    [[nodiscard]] DrawnCounts drawn() const;

    [[nodiscard]] const Skeleton& skeleton() const;
    [[nodiscard]] Skeleton take_skeleton();
    [[nodiscard]] const DrawingEnd& end() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys
