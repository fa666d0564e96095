// SPDX-License-Identifier: MIT
// The state of a Turtle while it draws. The loop over the modules of a word is in turtle.cpp, the
// commands are in commands.cpp.
#pragma once

#include "runtime/base/out_of_memory.h"
#include "runtime/derive/interpretation.h"
#include "runtime/turtle/impl/actions.h"
#include "runtime/turtle/impl/open_organs.h"
#include "runtime/turtle/impl/polygons.h"
#include "runtime/turtle/impl/pose.h"
#include "runtime/turtle/impl/text_commands.h"
#include "runtime/turtle/impl/tropisms.h"
#include "runtime/turtle/plant_size.h"
#include "runtime/turtle/turtle.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>

namespace lsys {

/// Modules between two checks for cancellation.
inline constexpr std::size_t kModulesBetweenChecks = std::size_t{1} << 16;
inline constexpr double kMaxFloat = static_cast<double>(std::numeric_limits<float>::max());
inline constexpr float kPercent = 0.01F;
inline constexpr double kFullTurn = 360.0;
/// Number of colours of Fractint; colour 0 is the background.
inline constexpr double kColours = 256.0;
/// Colours per texture (SetTexture).
inline constexpr std::uint32_t kTextureColours = 256;
inline constexpr std::uint32_t kTextures = (kMaxColourIndex + 1) / kTextureColours;
/// Numbers of the textures that have a material.
[[nodiscard]] std::bitset<kTextures> textures_of(std::span<const BytecodeMaterial> materials);

/// Sides of a segment in the program L3D, by the ratio of radius to length.
[[nodiscard]] inline std::uint8_t l3d_sides(float thickness) {
    const auto value = static_cast<double>(thickness);
    return value < 0.2 ? 20 : value < 0.4 ? 40 : value < 0.6 ? 60 : value < 0.8 ? 80 : 100;
}

/// Whether an organ ends at the turtle's place, which becomes a point, or at its last point.
enum class OrganEnd : std::uint8_t { Here, LastPoint };

/// The part of the state that `[` saves with the pose.
struct Brush {
    float width = 0.0F;                 // m, diameter; or radius / length (width_is_relative)
    float taper = 1.0F;                 // tip radius / base radius
    float step = 0.0F;                  // m
    float angle = 0.0F;                 // degrees
    HalfAngle turn;                     // half of `angle`
    double second_heading = 0.0;        // degrees from the first heading to the left
    std::uint32_t segment = kNoSegment; // the last segment drawn on the path
    ItemColour colour = 0;
    std::uint16_t colour_index = 0;     // the last index that was set
    std::uint16_t texture = 0;          // number of the texture, 0: none
    std::uint32_t contour = kNoContour; // index in Bytecode::contours
    float tangent_before = 1.0F;        // tangent length of organ axes / chord length
    float tangent_after = 1.0F;
    RadiusTangents radii; // of organs
    std::uint8_t sides = 0;
    bool moved = false; // whether the turtle has moved since `segment` was drawn
};

/// The last command read from a word of L3D, executed when the text of its parameter is complete.
struct PendingCommand : TextCommand {
    Action action;
    std::uint64_t position = 0;
    Code code = 0;
    Origin origin;
};

/// Brush and pose. run_some() copies the two separately, because it keeps the pose in registers.
struct TurtleState : Brush {
    Pose pose;
};

struct Turtle::State {
    State(const Bytecode& program, TurtleOptions wanted)
        : bytecode(program), options(std::move(wanted)), table(make_actions(program, options)) {
        const Settings& settings = bytecode.settings;
        skeleton.mesh_files = table.mesh_files;
        skeleton.looks = options.looks;
        skeleton.contours = table.contours;
        interprets = program.has(Stage::Interpret);
        traits = settings.traits;
        has_tropism = settings.has_tropism;
        skeleton.l3d_compatible_surface = traits.l3d_compatible_surface;
        skeleton.leaf_droop = traits.leaf_droop;
        skeleton.box_segments = traits.box_segments;
        skeleton.tube_shape = {settings.flare, settings.collar, settings.tips};
        has_second_heading = any_has(bytecode, TurtleInfo::SecondHeading);
        begin();
    }

    /// Sets the state at the start of a word.
    void begin() {
        const Settings& settings = bytecode.settings;
        now = {};
        tropisms.begin();
        now.width = settings.width;
        now.taper = traits.taper;
        now.step = settings.step;
        now.angle = settings.angle;
        now.turn = half_angle(static_cast<double>(settings.angle));
        now.sides = static_cast<std::uint8_t>(std::clamp(settings.sides, kMinSides, kMaxSides));
        now.tangent_before = traits.organ_tangent;
        now.tangent_after = traits.organ_tangent;
        now.colour_index = settings.colour != 0 ? static_cast<std::uint16_t>(settings.colour)
                                                : traits.first_colour;
        now.colour = now.colour_index;
        if (traits.first_turn != 0.0F) {
            yaw(now.pose, half_angle(static_cast<double>(traits.first_turn)));
        }
    }

    /// Executes modules.
    template <typename C>
    std::optional<Stop> run(std::span<const C> codes,
                            std::span<const float> parameters,
                            std::span<const Origin> origins);
    /// Executes modules after the productions of `#interpret` have rewritten them.
    template <typename C>
    std::optional<Stop> interpret(std::span<const C> codes,
                                  std::span<const float> parameters,
                                  std::span<const Origin> origins);
    template <typename C>
    std::optional<Stop> feed(std::span<const C> codes,
                             std::span<const float> parameters,
                             std::span<const Origin> origins) {
        return interprets ? interpret(codes, parameters, origins) : run(codes, parameters, origins);
    }
    /// The loop of run() for all words but those of L3D.
    template <bool kOrigins, typename C>
    void run_some(std::span<const C> codes, const float*& parameters, const Origin* origins);
    /// run() for a word of L3D.
    template <typename C>
    void run_text(std::span<const C> codes, const float*& parameters, const Origin* origins);
    /// Reads a module of a word of L3D.
    bool take_character(const Action& action, Code character, const float* arguments);
    bool execute_pending(); // executes the waiting command of L3D
    /// Stores the origin of the item that the current module has drawn, if any.
    bool add_origin(const Origin& origin);
    /// Executes one action. Returns false if the drawing has ended; `end.stop` is the reason.
    bool execute(const Action& action, const float* arguments);
    // `part`: factor of the length.
    bool forward(const Action& action, const float* arguments, float part);
    /// forward() with the setting `tropisms`.
    bool forward_with_tropisms(const Action& action, const float* arguments, float part);
    bool move(double length, bool adds_corners); // without drawing
    /// Arguments: length, base width, tip width.
    bool draw_tapered(const Action& action, const float* arguments);
    bool
    draw(double length, float base_width, float tip_width, const float* spring, const float* mass);
    /// Adds a segment at `base`; the turtle does not move.
    Segment& put_segment(const Pose& base,
                         float length,
                         float base_width,
                         float tip_width,
                         float spring,
                         float mass);
    /// Sets the cached mass and spring for this shape.
    void cache_shape(double length, float base_width, float tip_width);
    float mass_of(double length, float base_width, float tip_width);
    float spring_of(double length, float base_width, float tip_width);
    bool put_object(TurtleOperation kind, std::uint32_t mesh_file, const Pose& pose, float size);
    bool place(const Action& action, const float* arguments); // puts an object at the pose
    bool place_centred(const Action& action, float diameter); // the turtle does not move
    bool save();                                              // `[`
    bool restore();                                           // `]`
    /// Skips a module after a `%` or in a skipped branch. The `]` of that branch restores the
    /// turtle.
    bool skip(const Action& action);
    /// Executes `[` of a branch and reports the branch to options.branches.
    bool save_branch(const Action& action, const float* arguments);
    [[nodiscard]] TurtlePlace current_place() const;
    [[nodiscard]] DrawnCounts drawn() const;
    /// Draws a segment of the common case and moves `pose` to its tip. Returns false, without any
    /// effect, in other cases.
    bool quick_forward(const Action& action, const float* arguments, Pose& pose);
    bool close_polygon(); // adds the polygon that was opened last
    bool begin_organ();
    bool add_organ_point();           // adds the place of the turtle
    bool close_organ(OrganEnd place); // adds the open organ
    bool close_all_organs();          // at the end of the word
    /// Where organs end that are open at the end of their branch.
    [[nodiscard]] OrganEnd organ_end() const {
        return traits.organs_branch ? OrganEnd::LastPoint : OrganEnd::Here;
    }
    bool continue_organ(); // in the branch that begins
    /// Sets Brush::tangent_before and tangent_after.
    void set_tangents(const Action& action, const float* arguments);
    void set_radius_tangents(const Action& action, const float* arguments);
    void set_width(float width);
    void set_sides(float sides);
    [[nodiscard]] double colour_after(double count) const;
    void set_colour(double index);
    void set_texture(double number); // sets 0 if no material has this number
    [[nodiscard]] ItemColour textured(std::uint32_t texture) const;
    void set_rgb(const float* parts);
    void scale_angle(float factor);
    void turn_left(double degrees);
    /// Turns by half of a full turn, rounded down to whole steps of the current angle.
    void half_turn_snapped();
    void mirror(); // exchanges left and right
    /// forward() with the parameters of Houdini: length, width, sections (ignored), sides.
    bool forward_with_width(const Action& action, const float* arguments, float part);
    void turn_by(const Action& action, const float* arguments);
    /// Moves along the second heading.
    bool secondary_forward(const Action& action, const float* arguments);
    void add_colour(float number, double sign); // to Brush::colour_index

    void note(TurtleFaultKind kind) { note_at(kind, position, code); }
    /// Notes a fault of the module with code `module` at index `place` of the word.
    void note_at(TurtleFaultKind kind, std::uint64_t place, Code module);
    /// Notes `count` faults at the end of a word, which belong to no module.
    void note_end(TurtleFaultKind kind, std::uint64_t count) {
        end.faults[static_cast<std::size_t>(kind)].count += count;
    }
    bool stop(Stop why) {
        end.stop = why;
        return false;
    }
    bool fault(TurtleFaultKind kind) {
        note(kind);
        return stop(Stop::Diagnosed);
    }
    /// Runs work(); if that runs out of memory, ends the drawing and returns false.
    template <typename Work>
    bool within_memory(const Work& work) {
        const auto run = [&] {
            work();
            return true;
        };
        return catch_out_of_memory(run, [this] { return stop(Stop::OutOfMemory); });
    }
    /// Makes room in `items` for one more; otherwise ends the drawing and returns false.
    template <typename Items>
    bool make_room(Items& items);
    bool check_finite_pose();
    [[nodiscard]] std::uint16_t order() const {
        constexpr std::size_t kMaxOrder = std::numeric_limits<std::uint16_t>::max();
        return static_cast<std::uint16_t>(std::min(stack.size(), kMaxOrder));
    }

    const Bytecode& bytecode;
    TurtleOptions options;
    ActionTable table;
    Skeleton skeleton;
    TurtleState now;                  // state at the module being executed
    std::vector<TurtleState> stack;   // states saved by the open `[`, the innermost last
    std::vector<std::size_t> watched; // stack size within each open branch that has a watcher
    OpenPolygons polygons{bytecode.settings.traits.corners_are_ends};
    OpenOrgans organs;
    Tropisms tropisms{bytecode.settings.tropisms};
    std::bitset<kTextures> textures = textures_of(bytecode.materials); // valid numbers
    DrawingEnd end;
    std::uint64_t position = 0; // index of the current module
    Code code = 0;              // code of the current module
    Origin origin;              // origin of the current module, if the word has origins
    Origin polygon_origin;      // origin of the `{` of the polygon closed last
    std::uint64_t cut = 0;      // in a skipped part: 1 + its number of open brackets; else 0
    bool has_origins = false;   // the words fed last have origins
    bool interprets = false;    // the program has productions of #interpret
    std::unique_ptr<Interpretation> interpretation; // made with the first piece
    std::vector<Code> piece;                        // codes that are interpreted, widened to Code
    PendingCommand pending;
    bool keeps_origins = false; // the word of L3D has origins; not used for other words
    TurtleTraits traits;
    bool has_tropism = false;        // Settings::has_tropism
    bool has_second_heading = false; // a module of the bytecode uses the second heading
    // Mass and spring of the last segment, cached for segments of equal shape.
    double cached_length = -1.0;
    float cached_base = -1.0F; // width at the base, m
    float cached_tip = -1.0F;  // width at the tip, m
    float cached_mass = 0.0F;
    float cached_spring = 0.0F;
};

template <typename Items>
bool Turtle::State::make_room(Items& items) {
    if (items.size() < items.capacity()) {
        return true;
    }
    if (items.size() >= kMaxSkeletonItems) {
        return fault(TurtleFaultKind::TooMany);
    }
    constexpr std::size_t kFirst = 256;
    const std::uint64_t room =
        std::min<std::uint64_t>(std::max(kFirst, items.size() * 2), kMaxSkeletonItems);
    const std::uint64_t item = sizeof(typename Items::value_type);
    if (skeleton.byte_count() + (room - items.size()) * item > options.max_bytes) {
        return stop(Stop::Limit);
    }
    return within_memory([&] { items.reserve(room); });
}

/// Computes mass and spring of a segment, unless the last one had the same shape.
inline void Turtle::State::cache_shape(double length, float base_width, float tip_width) {
    if (length == cached_length && base_width == cached_base && tip_width == cached_tip) {
        return;
    }
    cached_length = length;
    cached_base = base_width;
    cached_tip = tip_width;
    const double a = 0.5 * static_cast<double>(base_width);
    const double b = 0.5 * static_cast<double>(tip_width);
    const Settings& settings = bytecode.settings;
    cached_mass = mass_of_cone(length, a, b, static_cast<double>(settings.density));
    cached_spring = spring_of_beam(length, a, b, static_cast<double>(settings.elasticity));
}

/// Mass of a segment if the author gives none: volume of a truncated cone times the density.
inline float Turtle::State::mass_of(double length, float base_width, float tip_width) {
    cache_shape(length, base_width, tip_width);
    return cached_mass;
}

/// Spring constant of a segment if the author gives none.
inline float Turtle::State::spring_of(double length, float base_width, float tip_width) {
    if (bytecode.settings.has_spring) {
        return bytecode.settings.spring;
    }
    cache_shape(length, base_width, tip_width);
    return cached_spring;
}

/// Appends the next segment of the path. Precondition: make_room(skeleton.segments).
[[gnu::always_inline]] inline Segment& Turtle::State::put_segment(
    const Pose& base, float length, float base_width, float tip_width, float spring, float mass) {
    const auto index = static_cast<std::uint32_t>(skeleton.segments.size());
    Segment& segment = skeleton.segments.emplace_back();
    segment.base = position_of(base);
    segment.length = length;
    segment.frame = frame_of(base);
    segment.base_radius = base_width * 0.5F;
    segment.tip_radius = tip_width * 0.5F;
    segment.spring = spring;
    segment.mass = mass;
    segment.parent = now.segment;
    segment.order = order();
    segment.colour = now.colour;
    segment.sides = now.sides;
    segment.linked = now.segment != kNoSegment && !now.moved;
    now.segment = index;
    now.moved = false;
    return segment;
}

} // namespace lsys
