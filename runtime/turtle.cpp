#include "runtime/turtle.h"

#include "grammar/contract.h"
#include "runtime/turtle/actions.h"
#include "runtime/turtle/polygons.h"
#include "runtime/turtle/pose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>
#include <utility>

namespace lsys {

namespace {

constexpr std::size_t kModulesBetweenLooks = std::size_t{1} << 16;
constexpr double kMaxFloat = static_cast<double>(std::numeric_limits<float>::max());
/// Reduction of a segment's radius along it where the profile has one: DIALECTS.md 1.3.
constexpr float kRelativeTaper = 0.95F;
constexpr float kPercent = 0.01F;

bool is_relative(TurtleProfile profile) {
    return profile == TurtleProfile::L3d || profile == TurtleProfile::Lplus;
}

/// What `[` saves beside the pose.
struct Brush {
    float width = 0.0F; // m, diameter; of relative profiles radius / length
    float taper = 1.0F; // tip radius / base radius
    float step = 0.0F;  // m
    float angle = 0.0F; // degrees
    HalfAngle turn;     // of `angle`
    std::uint32_t segment = kNoSegment;
    std::uint16_t colour = 0;
    std::uint8_t sides = 0;
    bool moved = false; // since the segment was drawn
};

/// Two parts that are copied apart, since one of them lives in registers.
struct TurtleState : Brush {
    Pose pose;
};

} // namespace

struct Turtle::State {
    State(const Bytecode& program, TurtleOptions wanted)
        : bytecode(program), options(std::move(wanted)), table(make_actions(program, options)) {
        const Settings& settings = bytecode.settings;
        skeleton.mesh_files = table.mesh_files;
        relative = is_relative(settings.turtle);
        has_tropism = settings.has_tropism;
        lines_only = options.lines_only;
        now.width = settings.width;
        now.taper = relative ? kRelativeTaper : 1.0F;
        now.step = settings.step;
        now.angle = settings.angle;
        now.turn = half_angle(static_cast<double>(settings.angle));
        now.sides = static_cast<std::uint8_t>(std::clamp(settings.sides, kMinSides, kMaxSides));
    }

    template <typename C>
    TurtleStatus run(std::span<const C> codes, std::span<const float> parameters);
    template <typename C>
    TurtleStatus run_some(std::span<const C> codes, const float*& parameters);
    /// False: the drawing has ended as `status`.
    bool obey(const Action& action, const float* arguments);
    bool forward(const Action& action, const float* arguments, float part);
    bool tapered(const Action& action, const float* arguments);
    bool draw(double length, float base_width, float tip_width, float spring, const float* mass);
    bool draw_line(double length);
    float mass_of(double length, float base_width, float tip_width);
    bool place(const Action& action, const float* arguments);
    bool save();
    bool restore();
    bool skip(const Action& action);
    bool quick_forward(const Action& action, const float* arguments, Pose& pose);
    void close_polygon();
    void set_width(float width);
    void set_sides(float sides);
    void set_colour(double index);
    void scale_angle(float factor);

    void note(TurtleFaultKind kind);
    bool stop(TurtleStatus why) {
        status = why;
        return false;
    }
    bool fault(TurtleFaultKind kind) {
        note(kind);
        return stop(TurtleStatus::Fault);
    }
    /// Makes room in `items` for one more; false: the drawing has ended.
    template <typename Items>
    bool has_room(Items& items);
    bool is_fine_place();
    [[nodiscard]] std::uint16_t order() const {
        constexpr std::size_t kMost = std::numeric_limits<std::uint16_t>::max();
        return static_cast<std::uint16_t>(std::min(stack.size(), kMost));
    }

    const Bytecode& bytecode;
    TurtleOptions options;
    ActionTable table;
    Skeleton skeleton;
    TurtleState now;
    std::vector<TurtleState> stack;
    OpenPolygons polygons;
    std::array<TurtleFault, kTurtleFaultKinds> faults{};
    std::uint64_t position = 0; // of the module at hand
    Code code = 0;              // of that module
    std::uint64_t cut = 0;      // open brackets within a part that is cut off, and 1
    TurtleStatus status = TurtleStatus::Ok;
    LargeVector<Line> lines; // instead of segments, if only they are wanted
    bool lines_only = false;
    bool relative = false; // widths are factors of the length
    bool has_tropism = false;
    // The last segment whose mass was worked out.
    double massed_length = -1.0;
    float massed_base = -1.0F;
    float massed_tip = -1.0F;
    float massed = 0.0F;
};

void Turtle::State::note(TurtleFaultKind kind) {
    TurtleFault& known = faults[static_cast<std::size_t>(kind)];
    if (known.count++ == 0) {
        known.position = position;
        known.code = code;
    }
}

template <typename Items>
bool Turtle::State::has_room(Items& items) {
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
        return stop(TurtleStatus::Limit);
    }
    try {
        items.reserve(room);
    } catch (const std::bad_alloc&) {
        return stop(TurtleStatus::OutOfMemory);
    }
    return true;
}

inline bool Turtle::State::is_fine_place() {
    const Pose& p = now.pose;
    // The comparison is false for what is not a number, too.
    if (std::abs(p.x) <= kMaxFloat && std::abs(p.y) <= kMaxFloat && std::abs(p.z) <= kMaxFloat) {
        return true;
    }
    return fault(TurtleFaultKind::NotFinite);
}

/// Volume of a truncated cone times the density.
float Turtle::State::mass_of(double length, float base_width, float tip_width) {
    if (length != massed_length || base_width != massed_base || tip_width != massed_tip) {
        massed_length = length;
        massed_base = base_width;
        massed_tip = tip_width;
        const double a = 0.5 * static_cast<double>(base_width);
        const double b = 0.5 * static_cast<double>(tip_width);
        const double volume = std::numbers::pi / 3.0 * std::abs(length) * (a * a + a * b + b * b);
        massed = static_cast<float>(
            std::min(volume * static_cast<double>(bytecode.settings.density), kMaxFloat));
    }
    return massed;
}

/// A segment of `length` from here on. `mass`: kg, or null where volume and density give it.
inline bool Turtle::State::draw(
    double length, float base_width, float tip_width, float spring, const float* mass) {
    if (has_tropism) {
        bend(now.pose, bytecode.settings.tropism);
    }
    if (lines_only) {
        return draw_line(length);
    }
    if (!has_room(skeleton.segments)) {
        return false;
    }
    const Pose base = now.pose;
    advance(now.pose, length);
    if (!is_fine_place()) {
        return false;
    }
    if (!(base_width <= std::numeric_limits<float>::max())) {
        return fault(TurtleFaultKind::NotFinite);
    }
    Segment& segment = skeleton.segments.emplace_back();
    segment.base = position_of(base);
    segment.length = static_cast<float>(length);
    segment.frame = frame_of(base);
    if (length < 0.0) { // half a turn about the right axis
        segment.length = -segment.length;
        segment.frame = segment.frame * glm::quat(0.0F, 1.0F, 0.0F, 0.0F);
    }
    segment.base_radius = base_width * 0.5F;
    segment.tip_radius = tip_width * 0.5F;
    segment.spring = spring;
    segment.mass = mass != nullptr ? *mass : mass_of(length, base_width, tip_width);
    segment.parent = now.segment;
    segment.order = order();
    segment.colour = now.colour;
    segment.sides = now.sides;
    segment.linked = now.segment != kNoSegment && !now.moved;
    now.segment = static_cast<std::uint32_t>(skeleton.segments.size() - 1);
    now.moved = false;
    return true;
}

bool Turtle::State::draw_line(double length) {
    if (!has_room(lines)) {
        return false;
    }
    const glm::vec3 from = position_of(now.pose);
    advance(now.pose, length);
    if (!is_fine_place()) {
        return false;
    }
    lines.push_back({from, position_of(now.pose)});
    return true;
}

/// F and H: a whole or half of the length, and the physics' spring and mass.
inline bool Turtle::State::forward(const Action& action, const float* arguments, float part) {
    const float length = (action.given > 0 ? arguments[0] : now.step) * part;
    const float spring = action.given > 1 ? arguments[1] : bytecode.settings.spring;
    const float width = relative ? 2.0F * std::abs(length) * now.width : now.width;
    polygons.path(now.pose);
    if (!draw(static_cast<double>(length), width, width * now.taper, spring,
              action.given > 2 ? arguments + 2 : nullptr)) {
        return false;
    }
    polygons.path(now.pose);
    return true;
}

/// F of the .sys profile: length, base width, tip width.
bool Turtle::State::tapered(const Action& action, const float* arguments) {
    const float length = action.given > 0 ? arguments[0] : now.step;
    const float base = action.given > 1 ? arguments[1] : now.width;
    const float tip_width = action.given > 2 ? arguments[2] : base;
    if (base < 0.0F || tip_width < 0.0F) {
        note(TurtleFaultKind::NegativeWidth);
    }
    polygons.path(now.pose);
    if (!draw(static_cast<double>(length), std::max(base, 0.0F), std::max(tip_width, 0.0F),
              bytecode.settings.spring, nullptr)) {
        return false;
    }
    polygons.path(now.pose);
    return true;
}

bool Turtle::State::place(const Action& action, const float* arguments) {
    if (!has_room(skeleton.objects)) {
        return false;
    }
    const float size = action.given > 0 ? arguments[0] : 1.0F;
    PlacedObject object;
    object.kind = action.operation;
    object.mesh_file = action.mesh_file;
    object.position = position_of(now.pose);
    object.size = size;
    object.frame = frame_of(now.pose);
    object.parent = now.segment;
    object.order = order();
    object.colour = now.colour;
    skeleton.objects.push_back(object);
    if (action.advances) {
        advance(now.pose, static_cast<double>(size) * static_cast<double>(action.unit_length));
        now.moved = true;
        return is_fine_place();
    }
    return true;
}

bool Turtle::State::save() {
    const std::uint64_t bytes = skeleton.byte_count() + stack.size() * 2 * sizeof(TurtleState);
    if (stack.size() == stack.capacity() && bytes > options.max_bytes) {
        return stop(TurtleStatus::Limit);
    }
    try {
        stack.push_back(now);
    } catch (const std::bad_alloc&) {
        return stop(TurtleStatus::OutOfMemory);
    }
    return true;
}

bool Turtle::State::restore() {
    if (stack.empty()) {
        return fault(TurtleFaultKind::Unbalanced);
    }
    now = stack.back();
    stack.pop_back();
    return true;
}

void Turtle::State::close_polygon() {
    if (!polygons.any()) {
        note(TurtleFaultKind::EndOutside);
        return;
    }
    const OpenPolygon open = polygons.top();
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
        try {
            skeleton.corners.insert(skeleton.corners.end(), corners.begin(), corners.end());
            skeleton.polygons.push_back(polygon);
        } catch (const std::bad_alloc&) {
            stop(TurtleStatus::OutOfMemory);
        }
        if (skeleton.byte_count() > options.max_bytes) {
            stop(TurtleStatus::Limit);
        }
    }
    polygons.close();
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

void Turtle::State::set_colour(double index) {
    constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
    const double fitting = std::clamp(std::round(index), 0.0, kMost);
    if (fitting != std::round(index)) {
        note(TurtleFaultKind::ColourOutOfRange);
    }
    now.colour = static_cast<std::uint16_t>(fitting);
}

void Turtle::State::scale_angle(float factor) {
    now.angle *= factor;
    now.turn = half_angle(static_cast<double>(now.angle));
}

inline bool Turtle::State::obey(const Action& action, const float* arguments) {
    const Settings& settings = bytecode.settings;
    // The angle of a turn that is not constant: from the word, or the setting as it is now.
    const auto turn = [&]() -> HalfAngle {
        return action.given == 0 ? now.turn : half_angle(static_cast<double>(arguments[0]));
    };
    const auto argument = [&](float otherwise) {
        return action.given != 0 ? arguments[0] : otherwise;
    };
    switch (action.operation) {
    case TurtleOperation::Nothing:
        return true;
    case TurtleOperation::Forward:
    case TurtleOperation::Branch:
        return forward(action, arguments, 1.0F);
    case TurtleOperation::HalfForward:
        return forward(action, arguments, 0.5F);
    case TurtleOperation::TaperedForward:
        return tapered(action, arguments);
    case TurtleOperation::Move:
    case TurtleOperation::HalfMove: {
        const float part = action.operation == TurtleOperation::HalfMove ? 0.5F : 1.0F;
        polygons.path(now.pose);
        advance(now.pose, static_cast<double>(argument(now.step) * part));
        polygons.path(now.pose);
        now.moved = true;
        return is_fine_place();
    }
    case TurtleOperation::YawRight:
        yaw(now.pose, inverse(turn()));
        return true;
    case TurtleOperation::YawLeft:
        yaw(now.pose, turn());
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
    case TurtleOperation::RollAround:
        roll(now.pose, {0.0, 1.0});
        return true;
    case TurtleOperation::RollUpright:
        roll_upright(now.pose);
        return true;
    case TurtleOperation::SetWidth:
        set_width(action.given != 0 ? arguments[0] : now.width * settings.width_scale);
        if (action.given > 1) {
            set_sides(arguments[1]);
        }
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
    case TurtleOperation::SetColour:
        set_colour(action.given != 0 ? static_cast<double>(arguments[0]) : now.colour + 1.0);
        return true;
    case TurtleOperation::Save:
        return save();
    case TurtleOperation::Restore:
        return restore();
    case TurtleOperation::PolygonBegin:
        polygons.open(frame_of(now.pose));
        return true;
    case TurtleOperation::PolygonVertex:
        if (!polygons.any()) {
            note(TurtleFaultKind::VertexOutside);
            return true;
        }
        polygons.vertex(now.pose);
        return true;
    case TurtleOperation::PolygonEnd:
        close_polygon();
        return status == TurtleStatus::Ok;
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
    }
    LSYS_CHECK(false, static_cast<int>(action.operation));
    return true;
}

/// Draws if nothing is in the way; false: nothing has happened, and forward() finds out why.
[[gnu::always_inline]] inline bool
Turtle::State::quick_forward(const Action& action, const float* arguments, Pose& pose) {
    const float length = action.given > 0 ? arguments[0] : now.step;
    Pose end = pose;
    advance(end, static_cast<double>(length));
    // Also false for what is not a number.
    const bool fits = std::abs(end.x) + std::abs(end.y) + std::abs(end.z) <= kMaxFloat &&
                      now.width <= std::numeric_limits<float>::max() && length >= 0.0F;
    if (lines_only) {
        if (!fits || lines.size() == lines.capacity()) {
            return false;
        }
        lines.emplace_back(Line{position_of(pose), position_of(end)});
        pose = end;
        return true;
    }
    LargeVector<Segment>& segments = skeleton.segments;
    if (!fits || segments.size() == segments.capacity()) {
        return false;
    }
    const auto index = static_cast<std::uint32_t>(segments.size());
    Segment& segment = segments.emplace_back();
    segment.base = position_of(pose);
    segment.length = length;
    segment.frame = frame_of(pose);
    segment.base_radius = now.width * 0.5F;
    segment.tip_radius = now.width * now.taper * 0.5F;
    segment.spring = action.given > 1 ? arguments[1] : bytecode.settings.spring;
    segment.mass = action.given > 2
                       ? arguments[2]
                       : mass_of(static_cast<double>(length), now.width, now.width * now.taper);
    segment.parent = now.segment;
    segment.order = order();
    segment.colour = now.colour;
    segment.sides = now.sides;
    segment.linked = now.segment != kNoSegment && !now.moved;
    now.segment = index;
    now.moved = false;
    pose = end;
    return true;
}

/// After a `%`, until the `]` of its branch.
bool Turtle::State::skip(const Action& action) {
    cut += action.operation == TurtleOperation::Save ? 1 : 0;
    return action.operation != TurtleOperation::Restore || --cut != 0 || restore();
}

template <typename C>
TurtleStatus Turtle::State::run_some(std::span<const C> codes, const float*& parameters) {
    const Action* const actions = table.by_code.data();
    const std::uint64_t first = position;
    const C* const begin = codes.data();
    const bool plain = !has_tropism && !relative;
    Pose pose = now.pose; // in registers; now.pose is kept for all that is not quick
    for (const C* at = begin; at != begin + codes.size(); ++at) {
        const Action& action = actions[*at];
        const float* const arguments = action.stored != 0 ? parameters : action.arguments.data();
        parameters += action.stored;
        if (cut == 0) {
            switch (action.quick) {
            case QuickAction::Nothing:
                continue;
            case QuickAction::Yaw:
                yaw(pose, action.turn);
                continue;
            case QuickAction::Pitch:
                pitch(pose, action.turn);
                continue;
            case QuickAction::Roll:
                roll(pose, action.turn);
                continue;
            case QuickAction::Forward:
                if (plain && !polygons.any() && quick_forward(action, arguments, pose)) {
                    continue;
                }
                break;
            case QuickAction::Save:
                if (stack.size() < stack.capacity()) {
                    TurtleState& saved = stack.emplace_back();
                    static_cast<Brush&>(saved) = now;
                    saved.pose = pose;
                    continue;
                }
                break;
            case QuickAction::Restore:
                if (!stack.empty()) {
                    static_cast<Brush&>(now) = stack.back();
                    pose = stack.back().pose;
                    stack.pop_back();
                    continue;
                }
                break;
            case QuickAction::None:
                break;
            }
        }
        position = first + static_cast<std::uint64_t>(at - begin);
        code = *at;
        now.pose = pose;
        if (cut != 0 ? !skip(action) : !obey(action, arguments)) {
            return status;
        }
        pose = now.pose;
    }
    now.pose = pose;
    position = first + codes.size();
    return TurtleStatus::Ok;
}

template <typename C>
TurtleStatus Turtle::State::run(std::span<const C> codes, std::span<const float> parameters) {
    if (status != TurtleStatus::Ok) {
        return status;
    }
    const float* next = parameters.data();
    while (!codes.empty()) {
        if (options.cancelled != nullptr && options.cancelled->load(std::memory_order_relaxed)) {
            return status = TurtleStatus::Cancelled;
        }
        const std::size_t count = std::min(codes.size(), kModulesBetweenLooks);
        if (run_some(codes.first(count), next) != TurtleStatus::Ok) {
            return status;
        }
        codes = codes.subspan(count);
    }
    return status;
}

Turtle::Turtle(const Bytecode& bytecode, TurtleOptions options)
    : state_(std::make_unique<State>(bytecode, std::move(options))) {}
Turtle::~Turtle() = default;

TurtleStatus Turtle::reserve(const Word& word) {
    State& state = *state_;
    std::uint64_t segments = 0;
    std::uint64_t objects = 0;
    const auto count = [&](auto codes) {
        std::vector<std::uint64_t> census(state.table.by_code.size(), 0);
        for (const auto code : codes) {
            ++census[code];
        }
        for (Code code = 0; code < census.size(); ++code) {
            switch (state.table.by_code[code].operation) {
            case TurtleOperation::Forward:
            case TurtleOperation::Branch:
            case TurtleOperation::HalfForward:
            case TurtleOperation::TaperedForward:
                segments += census[code];
                break;
            default:
                objects +=
                    draws(state.table.by_code[code].operation) &&
                            state.table.by_code[code].operation != TurtleOperation::PolygonEnd
                        ? census[code]
                        : 0;
            }
        }
    };
    switch (word.code_width()) {
    case 1:
        count(word.codes<std::uint8_t>());
        break;
    case 2:
        count(word.codes<std::uint16_t>());
        break;
    default:
        count(word.codes<std::uint32_t>());
        break;
    }
    if (segments * sizeof(Segment) + objects * sizeof(PlacedObject) > state.options.max_bytes) {
        return state.status = TurtleStatus::Limit;
    }
    try {
        if (state.lines_only) {
            state.lines.reserve(std::min(segments, kMaxSkeletonItems));
        } else {
            state.skeleton.segments.reserve(std::min(segments, kMaxSkeletonItems));
        }
        state.skeleton.objects.reserve(std::min(objects, kMaxSkeletonItems));
    } catch (const std::bad_alloc&) {
        return state.status = TurtleStatus::OutOfMemory;
    }
    return TurtleStatus::Ok;
}

TurtleStatus Turtle::feed(const Word& word) {
    switch (word.code_width()) {
    case 1:
        return state_->run(word.codes<std::uint8_t>(), word.parameters());
    case 2:
        return state_->run(word.codes<std::uint16_t>(), word.parameters());
    default:
        return state_->run(word.codes<std::uint32_t>(), word.parameters());
    }
}

TurtleStatus Turtle::feed(std::span<const Code> codes, std::span<const float> parameters) {
    return state_->run(codes, parameters);
}

TurtleStatus Turtle::finish() {
    State& state = *state_;
    if (state.status == TurtleStatus::Ok) {
        if (!state.stack.empty()) {
            state.note(TurtleFaultKind::UnclosedBranch);
        }
        if (state.polygons.any()) {
            state.note(TurtleFaultKind::UnclosedPolygon);
        }
    }
    return state.status;
}

const Skeleton& Turtle::skeleton() const {
    return state_->skeleton;
}
Skeleton Turtle::take_skeleton() {
    return std::move(state_->skeleton);
}
LargeVector<Line> Turtle::take_lines() {
    return std::move(state_->lines);
}
const std::array<TurtleFault, kTurtleFaultKinds>& Turtle::faults() const {
    return state_->faults;
}

} // namespace lsys
