// SPDX-License-Identifier: MIT
#include "grammar/base/contract.h"
#include "runtime/turtle/impl/state.h"

namespace lsys {

void Turtle::State::note_at(TurtleFaultKind kind, std::uint64_t place, Code module) {
    TurtleFault& known = end.faults[static_cast<std::size_t>(kind)];
    if (known.count++ == 0) {
        known.position = place;
        known.code = module;
    }
}

bool Turtle::State::check_finite_pose() {
    const Pose& p = now.pose;
    // The comparison is also false for NaN.
    if (std::abs(p.x) <= kMaxFloat && std::abs(p.y) <= kMaxFloat && std::abs(p.z) <= kMaxFloat) {
        return true;
    }
    return fault(TurtleFaultKind::NotFinite);
}

/// Draws a segment of `length` from the current pose. `spring` in N m / rad and `mass` in kg; null:
/// computed from the settings and the shape.
bool Turtle::State::draw(
    double length, float base_width, float tip_width, const float* spring, const float* mass) {
    if (has_tropism) {
        bend(now.pose, bytecode.settings.tropism);
    }
    if (organs.is_open_at(stack.size()) && !traits.organs_branch) {
        advance(now.pose, length);
        now.moved = true;
        return check_finite_pose() && add_organ_point();
    }
    if (!make_room(skeleton.segments)) {
        return false;
    }
    const Pose base = now.pose;
    advance(now.pose, length);
    if (!check_finite_pose()) {
        return false;
    }
    if (!(base_width <= std::numeric_limits<float>::max())) {
        return fault(TurtleFaultKind::NotFinite);
    }
    Segment& segment =
        put_segment(base, static_cast<float>(std::abs(length)), base_width, tip_width,
                    spring != nullptr ? *spring : spring_of(length, base_width, tip_width),
                    mass != nullptr ? *mass : mass_of(length, base_width, tip_width));
    if (length < 0.0) { // half a turn about the right axis
        segment.frame = segment.frame * glm::quat(0.0F, 1.0F, 0.0F, 0.0F);
    }
    return true;
}

/// Draws a segment of length `part` times the given one. Arguments: length, spring, mass.
bool Turtle::State::forward(const Action& action, const float* arguments, float part) {
    if (traits.forward_has_width) {
        return forward_with_width(action, arguments, part);
    }
    const float length = (action.argument_count > 0 ? arguments[0] : now.step) * part;
    const float width = traits.width_is_relative ? 2.0F * std::abs(length) * now.width : now.width;
    now.sides = traits.l3d_compatible_surface ? l3d_sides(now.width) : now.sides;
    const bool adds_corners = action.operation != TurtleOperation::ForwardWithoutVertex;
    if (adds_corners) {
        polygons.begin_step(now.pose);
    }
    if (!draw(static_cast<double>(length), width, width * now.taper,
              action.argument_count > 1 ? arguments + 1 : nullptr,
              action.argument_count > 2 ? arguments + 2 : nullptr)) {
        return false;
    }
    if (adds_corners) {
        polygons.end_step(now.pose);
    }
    return true;
}

bool Turtle::State::forward_with_tropisms(const Action& action,
                                          const float* arguments,
                                          float part) {
    if (!tropisms.any()) {
        return forward(action, arguments, part);
    }
    tropisms.before_step(now.pose);
    const bool is_drawn = forward(action, arguments, part);
    tropisms.after_step(now.pose, true);
    return is_drawn;
}

/// Moves ahead by `length` without drawing.
bool Turtle::State::move(double length, bool adds_corners) {
    if (tropisms.any()) {
        tropisms.before_step(now.pose);
    }
    if (adds_corners) {
        polygons.begin_step(now.pose);
    }
    advance(now.pose, length);
    if (adds_corners) {
        polygons.end_step(now.pose);
    }
    if (tropisms.any()) {
        tropisms.after_step(now.pose, false);
    }
    now.moved = true;
    return check_finite_pose();
}

/// Draws a tapered segment. Arguments: length, base width, tip width.
bool Turtle::State::draw_tapered(const Action& action, const float* arguments) {
    const float length = action.argument_count > 0 ? arguments[0] : now.step;
    const float base = action.argument_count > 1 ? arguments[1] : now.width;
    const float tip_width = action.argument_count > 2 ? arguments[2] : base;
    if (base < 0.0F || tip_width < 0.0F) {
        note(TurtleFaultKind::NegativeWidth);
    }
    polygons.begin_step(now.pose);
    if (!draw(static_cast<double>(length), std::max(base, 0.0F), std::max(tip_width, 0.0F), nullptr,
              nullptr)) {
        return false;
    }
    polygons.end_step(now.pose);
    return true;
}

/// Adds an object at `pose`. `size`: its length along the heading, or its diameter.
bool Turtle::State::put_object(TurtleOperation kind,
                               std::uint32_t mesh_file,
                               const Pose& pose,
                               float size) {
    if (!make_room(skeleton.objects)) {
        return false;
    }
    PlacedObject object;
    object.kind = kind;
    object.mesh_file = mesh_file;
    object.position = position_of(pose);
    object.size = size;
    object.frame = frame_of(pose);
    object.parent = now.segment;
    object.order = order();
    object.colour = now.colour;
    skeleton.objects.push_back(object);
    return true;
}

bool Turtle::State::place(const Action& action, const float* arguments) {
    const float size = action.argument_count > 0 ? arguments[0] : action.default_size;
    if (!put_object(action.operation, action.mesh_file, now.pose, size)) {
        return false;
    }
    if (action.texture != kTurtleTexture && !is_own(now.colour)) {
        skeleton.objects.back().colour = textured(action.texture);
    }
    if (action.advances) {
        advance(now.pose, static_cast<double>(size) * static_cast<double>(action.unit_length));
        now.moved = true;
        return check_finite_pose();
    }
    return true;
}

/// Places a sphere or disk around the position; the turtle does not move.
bool Turtle::State::place_centred(const Action& action, float diameter) {
    Pose pose = now.pose;
    if (action.operation == TurtleOperation::LevelDisk) {
        constexpr double kQuarterTurn = 90.0;
        pitch(pose, half_angle(kQuarterTurn)); // the axis of the disk is the turtle's up
        return put_object(TurtleOperation::Disk, action.mesh_file, pose, diameter);
    }
    advance(pose, -0.5 * static_cast<double>(diameter)); // a sphere begins at its lowest point
    return put_object(TurtleOperation::Sphere, action.mesh_file, pose, diameter);
}

bool Turtle::State::save() {
    const std::uint64_t bytes = skeleton.byte_count() + stack.size() * 2 * sizeof(TurtleState);
    if (stack.size() == stack.capacity() && bytes > options.max_bytes) {
        return stop(Stop::Limit);
    }
    const bool continues = traits.organs_branch && organs.is_open_at(stack.size());
    return within_memory([this] {
               stack.push_back(now);
               if (tropisms.any()) {
                   tropisms.save();
               }
           }) &&
           (!continues || continue_organ());
}

bool Turtle::State::restore() {
    if (stack.empty()) {
        return fault(TurtleFaultKind::Unbalanced);
    }
    if (organs.is_open_at(stack.size()) && !close_organ(organ_end())) {
        return false;
    }
    if (!watched.empty() && watched.back() == stack.size()) {
        watched.pop_back();
        options.branches->end(drawn());
    }
    now = stack.back();
    stack.pop_back();
    if (tropisms.any()) {
        tropisms.restore();
    }
    return true;
}

TurtlePlace Turtle::State::current_place() const {
    const Pose& pose = now.pose;
    TurtlePlace place;
    place.position = {pose.x, pose.y, pose.z};
    place.frame = glm::dquat(pose.qw, pose.qx, pose.qy, pose.qz);
    place.width = now.width;
    place.taper = now.taper;
    place.step = now.step;
    place.angle = now.angle;
    place.second_heading = static_cast<float>(now.second_heading);
    place.sides = now.sides;
    place.colour = now.colour;
    place.colour_index = now.colour_index;
    place.texture = now.texture;
    place.order = order();
    place.contour = now.contour;
    place.tangent_before = now.tangent_before;
    place.tangent_after = now.tangent_after;
    place.radii = now.radii;
    return place;
}

DrawnCounts Turtle::State::drawn() const {
    return {static_cast<std::uint32_t>(skeleton.segments.size()),
            static_cast<std::uint32_t>(skeleton.objects.size()),
            static_cast<std::uint32_t>(skeleton.polygons.size())};
}

bool Turtle::State::save_branch(const Action& action, const float* arguments) {
    if (!save()) {
        return false;
    }
    if (options.branches == nullptr) {
        return true;
    }
    BranchStart start;
    start.has_instance = arguments[0] != 0.0F;
    start.age = static_cast<std::uint32_t>(arguments[1]);
    start.id = static_cast<std::uint32_t>(arguments[2]);
    if (action.stored > kBranchArguments) {
        start.formals = {arguments + kBranchArguments, action.stored - kBranchArguments};
    }
    start.place = current_place();
    start.segment = now.moved ? kNoSegment : now.segment;
    start.drawn = drawn();
    start.origin = origin;
    if (options.branches->begin(start)) {
        watched.push_back(stack.size());
    } else {
        cut = 1; // skip the branch up to its `]`
    }
    return true;
}

bool Turtle::State::close_polygon() {
    if (!polygons.any()) {
        return fault(TurtleFaultKind::EndOutside);
    }
    const OpenPolygon open = polygons.top();
    polygon_origin = open.origin;
    const std::span<const glm::vec3> corners = polygons.corners();
    if (corners.size() < 3) {
        note(TurtleFaultKind::FewCorners);
    } else if (skeleton.corners.size() + corners.size() > kMaxSkeletonItems) {
        fault(TurtleFaultKind::TooMany);
    } else {
        Polygon polygon;
        polygon.first_corner = static_cast<std::uint32_t>(skeleton.corners.size());
        polygon.corner_count = static_cast<std::uint32_t>(corners.size());
        polygon.frame = open.frame;
        polygon.parent = now.segment;
        polygon.order = order();
        polygon.colour = now.colour;
        polygon.picture = open.picture;
        within_memory([&] {
            skeleton.corners.insert(skeleton.corners.end(), corners.begin(), corners.end());
            skeleton.polygons.push_back(polygon);
        });
        if (skeleton.byte_count() > options.max_bytes) {
            stop(Stop::Limit);
        }
    }
    polygons.close();
    return !end.stop;
}

void Turtle::State::set_width(float width) {
    if (width < 0.0F) {
        note(TurtleFaultKind::NegativeWidth);
        width = 0.0F;
    }
    now.width = width;
}

void Turtle::State::set_sides(float sides) {
    const float fitting =
        std::clamp(std::round(sides), static_cast<float>(kMinSides), static_cast<float>(kMaxSides));
    if (!(sides > static_cast<float>(kMinSides) - 0.5F &&
          sides < static_cast<float>(kMaxSides) + 0.5F)) {
        note(TurtleFaultKind::SidesOutOfRange);
    }
    now.sides = static_cast<std::uint8_t>(fitting);
}

/// The colour index `count` indices on; after 255 comes 0 if the colours wrap.
double Turtle::State::colour_after(double count) const {
    const double index = now.colour_index + count;
    return traits.colours_wrap && index >= kColours ? std::fmod(index, kColours) : index;
}

void Turtle::State::set_colour(double index) {
    const double fitting = std::clamp(std::round(index), 0.0, double{kMaxColourIndex});
    if (fitting != std::round(index)) {
        note(TurtleFaultKind::ColourOutOfRange);
    }
    now.colour_index = static_cast<std::uint16_t>(fitting);
    now.colour = textured(now.texture);
}

/// The current colour index with a texture; without it if no material has this texture.
ItemColour Turtle::State::textured(std::uint32_t texture) const {
    const std::uint32_t valid = texture < kTextures && textures[texture] ? texture : 0;
    return std::min(valid * kTextureColours + now.colour_index, kMaxColourIndex);
}

std::bitset<kTextures> textures_of(std::span<const BytecodeMaterial> materials) {
    std::bitset<kTextures> textures;
    for (const BytecodeMaterial& material : materials) {
        textures.set(material.index / kTextureColours);
    }
    return textures;
}

void Turtle::State::set_texture(double number) {
    const bool is_valid =
        number >= 0.0 && number < double{kTextures} && textures[static_cast<std::size_t>(number)];
    now.texture = is_valid ? static_cast<std::uint16_t>(number) : 0;
    set_colour(now.colour_index);
}

/// A colour without an index: red, green and blue in sRGB, 0 to 1.
void Turtle::State::set_rgb(const float* parts) {
    constexpr double kMaxByte = 255.0;
    ItemColour colour = 0;
    bool fits = true;
    for (int i = 0; i < 3; ++i) {
        const auto part = static_cast<double>(parts[i]);
        const double fitting = std::clamp(part, 0.0, 1.0);
        fits = fits && fitting == part;
        colour = colour << 8 | static_cast<ItemColour>(std::round(fitting * kMaxByte));
    }
    if (!fits) {
        note(TurtleFaultKind::RgbOutOfRange);
    }
    now.colour = kOwnColour + colour;
}

void Turtle::State::scale_angle(float factor) {
    now.angle *= factor;
    now.turn = half_angle(static_cast<double>(now.angle));
}

bool Turtle::State::execute(const Action& action, const float* arguments) {
    const Settings& settings = bytecode.settings;
    // The angle of a turn that is not constant: from the word, or the current angle.
    const auto turn = [&]() -> HalfAngle {
        return action.argument_count == 0 ? now.turn
                                          : half_angle(static_cast<double>(arguments[0]));
    };
    const auto argument = [&](float otherwise) {
        return action.argument_count != 0 ? arguments[0] : otherwise;
    };
    switch (action.operation) {
    case TurtleOperation::Nothing:
    case TurtleOperation::ParameterBegin:
    case TurtleOperation::ParameterEnd:
    case TurtleOperation::Text:
        return true;
    case TurtleOperation::Forward:
    case TurtleOperation::Branch:
    case TurtleOperation::ForwardWithoutVertex:
        return forward_with_tropisms(action, arguments, 1.0F);
    case TurtleOperation::HalfForward:
        return forward_with_tropisms(action, arguments, 0.5F);
    case TurtleOperation::TaperedForward:
        return draw_tapered(action, arguments);
    case TurtleOperation::Move:
        return move(static_cast<double>(argument(now.step)), true);
    case TurtleOperation::HalfMove:
        return move(static_cast<double>(argument(now.step) * 0.5F), true);
    case TurtleOperation::MoveWithoutVertex:
        return move(static_cast<double>(argument(now.step)), false);
    case TurtleOperation::Bend:
        bend(now.pose, {0.0F, -1.0F, 0.0F, argument(0.0F)});
        return true;
    case TurtleOperation::TurnBy:
        turn_by(action, arguments);
        return true;
    case TurtleOperation::PointAt:
        if (action.argument_count == 3) {
            aim(now.pose, {arguments[0], arguments[1], arguments[2]});
        }
        return true;
    case TurtleOperation::YawRight:
        yaw(now.pose, inverse(turn()));
        now.second_heading += has_second_heading ? static_cast<double>(now.angle) : 0.0;
        return true;
    case TurtleOperation::YawLeft:
        yaw(now.pose, turn());
        now.second_heading -= has_second_heading ? static_cast<double>(now.angle) : 0.0;
        return true;
    case TurtleOperation::PitchDown:
        pitch(now.pose, inverse(turn()));
        return true;
    case TurtleOperation::PitchUp:
        pitch(now.pose, turn());
        return true;
    case TurtleOperation::RollRight:
        roll(now.pose, turn());
        return true;
    case TurtleOperation::RollLeft:
        roll(now.pose, inverse(turn()));
        return true;
    case TurtleOperation::TurnAround:
        yaw(now.pose, {0.0, 1.0});
        return true;
    case TurtleOperation::TurnByPi:
        yaw(now.pose, inverse(half_angle(std::numbers::pi)));
        return true;
    case TurtleOperation::RollAround:
        roll(now.pose, {0.0, 1.0});
        return true;
    case TurtleOperation::HalfTurnSnapped:
        half_turn_snapped();
        return true;
    case TurtleOperation::Mirror:
        mirror();
        return true;
    case TurtleOperation::SecondaryForward:
    case TurtleOperation::SecondaryMove:
        return secondary_forward(action, arguments);
    case TurtleOperation::SecondaryLeft:
        now.second_heading += static_cast<double>(argument(0.0F));
        return true;
    case TurtleOperation::SecondaryRight:
        now.second_heading -= static_cast<double>(argument(0.0F));
        return true;
    case TurtleOperation::AddColour:
        add_colour(argument(0.0F), 1.0);
        return true;
    case TurtleOperation::SubtractColour:
        add_colour(argument(0.0F), -1.0);
        return true;
    case TurtleOperation::RollUpright:
        roll_upright(now.pose);
        return true;
    case TurtleOperation::SetWidth:
        set_width(action.argument_count != 0 ? arguments[0] : now.width * settings.width_scale);
        if (action.argument_count > 1) {
            set_sides(arguments[1]);
        }
        return true;
    case TurtleOperation::NarrowWidth:
        set_width(argument(std::max(0.0F, now.width - settings.width_increment)));
        return true;
    case TurtleOperation::WidenWidth:
        set_width(argument(now.width + settings.width_increment));
        return true;
    case TurtleOperation::ScaleWidth:
        set_width(now.width * argument(settings.width_scale));
        return true;
    case TurtleOperation::ThickenWidth:
        set_width(now.width * (1.0F + argument(settings.angle) * kPercent));
        return true;
    case TurtleOperation::ThinWidth:
        set_width(now.width * (1.0F - argument(settings.angle) * kPercent));
        return true;
    case TurtleOperation::SetRelativeWidth:
        set_width(argument(1.0F) * kPercent);
        return true;
    case TurtleOperation::SetTaper:
        now.taper = argument(1.0F) * kPercent;
        return true;
    case TurtleOperation::ScaleStep:
        now.step *= argument(settings.step_scale);
        return true;
    case TurtleOperation::ScaleAngle:
        scale_angle(argument(settings.angle_scale));
        return true;
    case TurtleOperation::DivideWidth:
        set_width(now.width / argument(settings.width_scale));
        return true;
    case TurtleOperation::DivideStep:
        now.step /= argument(settings.step_scale);
        return true;
    case TurtleOperation::DivideAngle:
        scale_angle(1.0F / argument(settings.angle_scale));
        return true;
    case TurtleOperation::SetColour:
        set_colour(action.argument_count != 0 ? static_cast<double>(arguments[0])
                                              : colour_after(settings.colour_increment));
        return true;
    case TurtleOperation::PreviousColour:
        set_colour(action.argument_count != 0 ? static_cast<double>(arguments[0])
                                              : colour_after(kColours - settings.colour_increment));
        return true;
    case TurtleOperation::SetRgb:
        set_rgb(arguments);
        return true;
    case TurtleOperation::SetTexture:
        set_texture(static_cast<double>(argument(0.0F)));
        return true;
    case TurtleOperation::Save:
        return save();
    case TurtleOperation::SaveBranch:
        return save_branch(action, arguments);
    case TurtleOperation::Restore:
        return restore();
    case TurtleOperation::PolygonBegin:
        polygons.open({0, 0, frame_of(now.pose), origin, position, code, action.picture});
        return true;
    case TurtleOperation::PolygonVertex:
        if (!polygons.any()) {
            note(TurtleFaultKind::VertexOutside);
            return true;
        }
        polygons.vertex(now.pose);
        return true;
    case TurtleOperation::PolygonEnd:
        return close_polygon();
    case TurtleOperation::SurfaceBegin:
        return begin_organ();
    case TurtleOperation::SurfacePoint:
    case TurtleOperation::SurfaceEnd:
        if (!organs.is_open_at(stack.size())) {
            note(TurtleFaultKind::SurfaceOutside);
            return true;
        }
        return action.operation == TurtleOperation::SurfacePoint ? add_organ_point()
                                                                 : close_organ(OrganEnd::Here);
    case TurtleOperation::SurfaceTangents:
        set_tangents(action, arguments);
        return true;
    case TurtleOperation::SurfaceRadii:
        set_radius_tangents(action, arguments);
        return true;
    case TurtleOperation::SetContour:
        now.contour = action.argument_count > 0 && action.contour == kNoContour
                          ? table.numbered_contour(arguments[0])
                          : action.contour;
        return true;
    case TurtleOperation::Cut:
        cut = 1;
        return true;
    case TurtleOperation::Leaf:
    case TurtleOperation::Sphere:
    case TurtleOperation::Heterocyst:
    case TurtleOperation::Flower:
    case TurtleOperation::Cylinder:
    case TurtleOperation::Cone:
    case TurtleOperation::Cube:
    case TurtleOperation::Disk:
    case TurtleOperation::MeshFile:
        return place(action, arguments);
    case TurtleOperation::SetSusceptibility:
    case TurtleOperation::SetTropism:
    case TurtleOperation::AddTropism:
    case TurtleOperation::SubtractTropism:
    case TurtleOperation::Untwist:
    case TurtleOperation::KeepTwist:
        tropisms.execute(action.operation, action.argument_count, arguments, now.pose);
        return true;
    case TurtleOperation::CentredSphere:
    case TurtleOperation::LevelDisk:
        return place_centred(action, argument(now.width));
    }
    LSYS_CHECK(false, static_cast<int>(action.operation));
    return true;
}

/// Counts the brackets of a part that is not drawn, after a `%` or in a skipped branch. The `]`
/// that ends the part restores the turtle.
bool Turtle::State::skip(const Action& action) {
    const bool opens = action.operation == TurtleOperation::Save ||
                       action.operation == TurtleOperation::SaveBranch;
    cut += opens ? 1 : 0;
    return action.operation != TurtleOperation::Restore || --cut != 0 || restore();
}

} // namespace lsys
