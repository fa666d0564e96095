// SPDX-License-Identifier: MIT
#include "runtime/turtle/turtle.h"

#include "grammar/base/contract.h"
#include "runtime/turtle/impl/state.h"

namespace lsys {

/// Draws a segment of the common case. Returns false, without effect, if forward() has to check
/// faults and limits.
[[gnu::always_inline]] inline bool
Turtle::State::quick_forward(const Action& action, const float* arguments, Pose& pose) {
    const float length = action.argument_count > 0 ? arguments[0] : now.step;
    Pose tip = pose;
    advance(tip, static_cast<double>(length));
    // `fits` is also false if a value is NaN.
    const bool fits = std::abs(tip.x) + std::abs(tip.y) + std::abs(tip.z) <= kMaxFloat &&
                      now.width <= std::numeric_limits<float>::max() && length >= 0.0F;
    if (!fits || skeleton.segments.size() == skeleton.segments.capacity()) {
        return false;
    }
    const float tip_width = now.width * now.taper;
    put_segment(
        pose, length, now.width, tip_width,
        action.argument_count > 1 ? arguments[1]
                                  : spring_of(static_cast<double>(length), now.width, tip_width),
        action.argument_count > 2 ? arguments[2]
                                  : mass_of(static_cast<double>(length), now.width, tip_width));
    pose = tip;
    return true;
}

/// Stores the origin of the item that the current module has drawn, if it has drawn one.
[[gnu::always_inline]] inline bool Turtle::State::add_origin(const Origin& from) {
    const auto add = [this](const auto& items, LargeVector<Origin>& origins, const Origin& each) {
        if (origins.size() == items.size()) {
            return true;
        }
        if (!make_room(origins)) {
            return false;
        }
        origins.push_back(each);
        return true;
    };
    return add(skeleton.segments, skeleton.segment_origins, from) &&
           add(skeleton.objects, skeleton.object_origins, from) &&
           add(skeleton.polygons, skeleton.polygon_origins, polygon_origin);
}

template <bool kOrigins, typename C>
void Turtle::State::run_some(std::span<const C> codes,
                             const float*& parameters,
                             const Origin* origins) {
    const Action* const actions = table.by_code.data();
    const std::uint64_t first = position;
    const C* const begin = codes.data();
    const bool has_tropisms = tropisms.any();
    const bool plain = !has_tropism && !has_tropisms && !traits.width_is_relative;
    Pose pose = now.pose; // kept in registers; now.pose is set before actions that are not quick
    for (const C* at = begin; at != begin + codes.size(); ++at) {
        const Action& action = actions[*at];
        const float* const arguments = action.stored != 0 ? parameters : action.arguments.data();
        parameters += action.stored;
        if (cut == 0) {
            switch (action.quick) {
            case QuickAction::NoEffect:
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
                    if constexpr (kOrigins) {
                        if (!add_origin(origins[at - begin])) {
                            return;
                        }
                    }
                    continue;
                }
                break;
            case QuickAction::Save:
                if (stack.size() < stack.capacity() && !has_tropisms) {
                    TurtleState& saved = stack.emplace_back();
                    static_cast<Brush&>(saved) = now;
                    saved.pose = pose;
                    continue;
                }
                break;
            case QuickAction::Restore:
                if (!stack.empty() && !has_tropisms) {
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
        if constexpr (kOrigins) {
            origin = origins[at - begin];
        }
        if (cut != 0 ? !skip(action) : !execute(action, arguments)) {
            return;
        }
        if constexpr (kOrigins) {
            if (!add_origin(origin)) {
                return;
            }
        }
        pose = now.pose;
    }
    now.pose = pose;
    position = first + codes.size();
}

/// Executes the modules of a word of L3D, whose parameters are characters in parentheses. A command
/// is executed when its parameter has been read, one or more modules later.
template <typename C>
void Turtle::State::run_text(std::span<const C> codes,
                             const float*& parameters,
                             const Origin* origins) {
    const std::uint64_t first = position;
    keeps_origins = origins != nullptr;
    for (std::size_t i = 0; i < codes.size(); ++i) {
        const Action& action = table.by_code[codes[i]];
        const float* const arguments = action.stored != 0 ? parameters : action.arguments.data();
        parameters += action.stored;
        position = first + i;
        const Origin here = origins != nullptr ? origins[i] : Origin{};
        const Origin before = pending.origin;
        origin = here;
        if (!take_character(action, codes[i], arguments) ||
            (origins != nullptr && !add_origin(before))) {
            return;
        }
    }
    position = first + codes.size();
}

template <typename C>
std::optional<Stop> Turtle::State::run(std::span<const C> codes,
                                       std::span<const float> parameters,
                                       std::span<const Origin> origins) {
    LSYS_CHECK(origins.empty() || origins.size() == codes.size(), origins.size(), codes.size());
    if (end.stop) {
        return end.stop;
    }
    has_origins = !origins.empty();
    const float* next = parameters.data();
    while (!codes.empty()) {
        if (options.cancelled != nullptr && options.cancelled->load(std::memory_order_relaxed)) {
            return end.stop = Stop::Cancelled;
        }
        const std::size_t count = std::min(codes.size(), kModulesBetweenChecks);
        if (table.reads_text) {
            run_text(codes.first(count), next, origins.empty() ? nullptr : origins.data());
            origins = origins.empty() ? origins : origins.subspan(count);
        } else if (origins.empty()) {
            run_some<false>(codes.first(count), next, nullptr);
        } else {
            run_some<true>(codes.first(count), next, origins.data());
            origins = origins.subspan(count);
        }
        if (end.stop) {
            return end.stop;
        }
        codes = codes.subspan(count);
    }
    return end.stop;
}

/// Rewrites the modules by the productions of `#interpret` and draws the result.
template <typename C>
std::optional<Stop> Turtle::State::interpret(std::span<const C> codes,
                                             std::span<const float> parameters,
                                             std::span<const Origin> origins) {
    if (end.stop) {
        return end.stop;
    }
    if (!interpretation) {
        interpretation = Interpretation::make(
            bytecode, {options.seed, options.generations, options.max_bytes, options.cancelled},
            !origins.empty(),
            [this](std::span<const Code> some, std::span<const float> values,
                   std::span<const Origin> from) { return !run(some, values, from); });
    }
    while (!codes.empty() && !end.stop) {
        const std::size_t count = std::min(codes.size(), kModulesBetweenChecks);
        piece.assign(codes.begin(), codes.begin() + static_cast<std::ptrdiff_t>(count));
        std::size_t stored = 0;
        for (const Code each : piece) {
            stored += bytecode.stored_parameters(each);
        }
        const std::optional<Stop> stop = interpretation->feed(
            piece, parameters.first(stored), origins.empty() ? origins : origins.first(count));
        if (stop && !end.stop) { // otherwise run() has set end.stop
            end.stop = stop;
            if (stop == Stop::Diagnosed) {
                end.error = interpretation->error();
            }
        }
        codes = codes.subspan(count);
        parameters = parameters.subspan(stored);
        origins = origins.empty() ? origins : origins.subspan(count);
    }
    return end.stop;
}

Turtle::Turtle(const Bytecode& bytecode, TurtleOptions options)
    : state_(std::make_unique<State>(bytecode, std::move(options))) {}
Turtle::~Turtle() = default;

std::optional<Stop> Turtle::reserve(const Word& word) {
    State& state = *state_;
    if (state.interprets || state.table.draws_organs) {
        return std::nullopt; // productions of #interpret, or organs, decide how much is drawn
    }
    std::uint64_t segments = 0;
    std::uint64_t objects = 0;
    const auto count = [&](auto codes) {
        std::vector<std::uint64_t> census(state.table.by_code.size(), 0);
        for (const auto code : codes) {
            ++census[code];
        }
        for (Code code = 0; code < census.size(); ++code) {
            const DrawnKind drawn = info(state.table.by_code[code].operation).drawn;
            segments += drawn == DrawnKind::Segment ? census[code] : 0;
            objects += drawn == DrawnKind::Object ? census[code] : 0;
        }
    };
    word.visit(count);
    const bool keeps_origins = word.keeps_origins();
    const std::uint64_t bytes = segments * sizeof(Segment) + objects * sizeof(PlacedObject) +
                                (keeps_origins ? (segments + objects) * sizeof(Origin) : 0);
    if (bytes > state.options.max_bytes) {
        return state.end.stop = Stop::Limit;
    }
    state.within_memory([&] {
        state.skeleton.segments.reserve(std::min(segments, kMaxSkeletonItems));
        state.skeleton.objects.reserve(std::min(objects, kMaxSkeletonItems));
        if (keeps_origins) {
            state.skeleton.segment_origins.reserve(std::min(segments, kMaxSkeletonItems));
            state.skeleton.object_origins.reserve(std::min(objects, kMaxSkeletonItems));
        }
    });
    return state.end.stop;
}

std::optional<Stop> Turtle::feed(const Word& word) {
    return word.visit(
        [&](auto codes) { return state_->feed(codes, word.parameters(), word.origins()); });
}

std::optional<Stop> Turtle::feed(std::span<const Code> codes, std::span<const float> parameters) {
    return state_->feed(codes, parameters, {});
}

std::optional<Stop> Turtle::feed(std::span<const Code> codes,
                                 std::span<const float> parameters,
                                 std::span<const Origin> origins) {
    return state_->feed(codes, parameters, origins);
}

std::optional<Stop> Turtle::finish() {
    State& state = *state_;
    if (!state.end.stop && state.pending.is_set && !state.pending.in_parameter) {
        if (state.execute_pending() && state.keeps_origins) {
            static_cast<void>(state.add_origin(state.pending.origin));
        }
    }
    if (!state.end.stop) {
        if (!state.stack.empty()) {
            state.note_end(TurtleFaultKind::UnclosedBranch, state.stack.size());
        }
        for (const OpenPolygon& open : state.polygons.all()) {
            state.note_at(TurtleFaultKind::UnclosedPolygon, open.position, open.code);
        }
        static_cast<void>(state.close_all_organs()); // returns false if it sets `stop`
    }
    return state.end.stop;
}

void Turtle::begin_word(std::uint64_t seed) {
    State& state = *state_;
    state.options.seed = seed;
    LSYS_CHECK(!state.end.stop);
    state.begin();
    state.stack.clear();
    state.watched.clear();
    state.polygons = OpenPolygons(state.traits.corners_are_ends);
    state.organs = {};
    state.pending = {};
    state.position = 0;
    state.cut = 0;
    state.interpretation.reset();
}
TurtlePlace Turtle::place() const {
    return state_->current_place();
}
DrawnCounts Turtle::drawn() const {
    return state_->drawn();
}
const Skeleton& Turtle::skeleton() const {
    return state_->skeleton;
}
Skeleton Turtle::take_skeleton() {
    return std::move(state_->skeleton);
}
const DrawingEnd& Turtle::end() const {
    return state_->end;
}

} // namespace lsys
