// SPDX-License-Identifier: MIT
#include "runtime/turtle/sensing_turtle.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/turtle/impl/sensing_state.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

namespace lsys {

namespace {

/// Modules between two checks for cancellation, and modules per piece of a word that is
/// interpreted.
constexpr std::size_t kPiece = std::size_t{1} << 16;

/// Area of an object of size 1, m^2.
double unit_area(const BytecodeSymbol& symbol, std::size_t index, const SensingOptions& options) {
    switch (symbol.turtle) {
    case TurtleOperation::Sphere:
    case TurtleOperation::Heterocyst:
    case TurtleOperation::Disk:
    case TurtleOperation::CentredSphere:
    case TurtleOperation::LevelDisk:
        return std::numbers::pi / 4.0;
    case TurtleOperation::Cube:
    case TurtleOperation::Cylinder:
        return 1.0;
    case TurtleOperation::Cone:
        return 0.5;
    case TurtleOperation::Leaf:
        return options.leaf_area;
    case TurtleOperation::Flower:
        return options.flower_area;
    case TurtleOperation::MeshFile:
        return index < options.mesh_areas.size() ? options.mesh_areas[index] : 0.0;
    default:
        return 0.0;
    }
}

SensingStep step_of(const Action& action, const Bytecode& bytecode) {
    const bool has_state = has_tropisms(bytecode.settings.tropisms);
    switch (action.quick) {
    case QuickAction::Yaw:
        return SensingStep::Yaw;
    case QuickAction::Pitch:
        return SensingStep::Pitch;
    case QuickAction::Roll:
        return SensingStep::Roll;
    case QuickAction::Forward:
        return bytecode.settings.has_tropism || has_state ? SensingStep::Other
                                                          : SensingStep::Forward;
    case QuickAction::Save:
        return has_state ? SensingStep::Other : SensingStep::Save;
    case QuickAction::Restore:
        return has_state ? SensingStep::Other : SensingStep::Restore;
    case QuickAction::NoEffect:
        return SensingStep::NoEffect;
    case QuickAction::None:
        return SensingStep::Other;
    }
    return SensingStep::Other;
}

/// Whether the operation turns opposite to yaw_right(), pitch_up() or roll_left(), so that its sine
/// is negated.
bool turns_back(TurtleOperation operation) {
    return operation == TurtleOperation::YawLeft || operation == TurtleOperation::PitchDown ||
           operation == TurtleOperation::RollRight;
}

TurtleOptions turtle_options(const SensingOptions& options) {
    TurtleOptions result;
    result.mesh_lengths = options.mesh_lengths;
    return result;
}

} // namespace

SensingTurtle::State::State(const Bytecode& program, SensingOptions wanted)
    : bytecode(program), options(std::move(wanted)),
      table(make_actions(program, turtle_options(options))),
      polygons(program.settings.traits.corners_are_ends), tropisms(program.settings.tropisms),
      interprets(program.has(Stage::Interpret)),
      has_second_heading(any_has(program, TurtleInfo::SecondHeading)) {
    actions.reserve(table.by_code.size());
    areas.reserve(table.by_code.size());
    for (Code each = 0; each < table.by_code.size(); ++each) {
        const Action& action = table.by_code[each];
        const auto symbol = static_cast<std::size_t>(bytecode.symbol_of(each));
        const bool senses = bytecode.symbols[symbol].senses();
        SensingAction& known = actions.emplace_back();
        known.step = !senses ? step_of(action, bytecode)
                             : (interprets ? SensingStep::NoEffect : SensingStep::Sense);
        known.argument_count = action.argument_count;
        known.stored = action.stored;
        known.constants = action.arguments.data();
        if (turns(action.operation)) {
            const bool is_given = action.stored == 0 && action.argument_count != 0;
            known.turn = exact_sine_cosine_of_degrees(
                static_cast<double>(is_given ? action.arguments[0] : bytecode.settings.angle));
            known.turn = turns_back(action.operation) ? inverse(known.turn) : known.turn;
        }
        areas.push_back(unit_area(bytecode.symbols[symbol], symbol, options));
    }
}

void SensingTurtle::State::begin() {
    const Settings& settings = bytecode.settings;
    now = {};
    now.step = static_cast<double>(settings.step);
    now.width = static_cast<double>(settings.width);
    set_angle(static_cast<double>(settings.angle));
    if (settings.traits.first_turn != 0.0F) {
        yaw_right(now.pose, inverse(exact_sine_cosine_of_degrees(
                                static_cast<double>(settings.traits.first_turn))));
    }
    stack.clear();
    tropisms.begin();
    polygons = SensingPolygons(settings.traits.corners_are_ends);
    pending = {};
    position = 0;
    stopped.reset();
}

void SensingTurtle::State::report_up_to(std::uint64_t index) {
    while (reported < waiting.size() && waiting[reported].position <= index) {
        SenseModule module = waiting[reported++];
        module.position += first_of_piece;
        sink->sense(module, now.pose);
    }
}

template <typename C>
bool SensingTurtle::State::run(std::span<const C> codes,
                               const float* parameters,
                               const Origin* origins) {
    const SensingAction* const known = actions.data();
    const float* const first_parameter = parameters;
    const C* const begin = codes.data();
    const std::uint64_t first = position;
    SenseModule sensed;
    for (const C* at = begin; at != begin + codes.size(); ++at) {
        const SensingAction& action = known[*at];
        const float* const arguments = action.stored != 0 ? parameters : action.constants;
        parameters += action.stored;
        if (origins != nullptr) {
            report_up_to(origins[at - begin].place);
        }
        switch (action.step) {
        case SensingStep::NoEffect:
            continue;
        case SensingStep::Yaw:
            yaw_right(now.pose, action.turn);
            continue;
        case SensingStep::Pitch:
            pitch_up(now.pose, action.turn);
            continue;
        case SensingStep::Roll:
            roll_left(now.pose, action.turn);
            continue;
        case SensingStep::Forward:
            if (polygons.any()) {
                break;
            }
            advance(now.pose,
                    action.argument_count > 0 ? static_cast<double>(arguments[0]) : now.step);
            continue;
        case SensingStep::Save:
            if (stack.size() < stack.capacity()) {
                stack.push_back(now);
                continue;
            }
            break;
        case SensingStep::Restore:
            if (!stack.empty()) {
                now = stack.back();
                stack.pop_back();
                continue;
            }
            break;
        case SensingStep::Sense:
            sensed.position = first + static_cast<std::uint64_t>(at - begin);
            sensed.first_parameter =
                walked_parameters + static_cast<std::uint64_t>(arguments - first_parameter);
            sensed.code = *at;
            sink->sense(sensed, now.pose);
            continue;
        case SensingStep::Other:
            break;
        }
        // Errors name the module of the word, not that of its interpretation.
        position = origins != nullptr ? first_of_piece + origins[at - begin].place
                                      : first + static_cast<std::uint64_t>(at - begin);
        code = *at;
        if (!execute(table.by_code[code], action.argument_count, arguments)) {
            return false;
        }
    }
    position = first + codes.size();
    walked_parameters += static_cast<std::uint64_t>(parameters - first_parameter);
    return true;
}

bool SensingTurtle::State::execute_pending() {
    pending.is_set = false;
    code = pending.code;
    return execute(table.by_code[code], pending.argument_count, pending.arguments.data());
}

/// Reads the next module of a word of L3D, whose parameters are characters in parentheses.
bool SensingTurtle::State::take_character(Code character, const float* arguments) {
    const Action& action = table.by_code[character];
    switch (pending.take(action)) {
    case TextStep::Text:
        return true;
    case TextStep::Parameter:
        if (const auto value = pending.parameter(table.by_code[pending.code].operation,
                                                 bytecode.settings.traits.l3d_compatible_surface)) {
            pending.argument_count = 1;
            pending.arguments[0] = *value;
        }
        return execute_pending();
    case TextStep::Command:
        break;
    }
    if (pending.is_set && !execute_pending()) {
        return false;
    }
    pending.is_set = true;
    pending.code = character;
    pending.argument_count = action.argument_count;
    std::copy_n(arguments, action.argument_count, pending.arguments.begin());
    return true;
}

template <typename C>
bool SensingTurtle::State::run_text(std::span<const C> codes,
                                    const float* parameters,
                                    const Origin* origins) {
    for (std::size_t i = 0; i < codes.size(); ++i, ++position) {
        const SensingAction& action = actions[codes[i]];
        const float* const arguments = action.stored != 0 ? parameters : action.constants;
        parameters += action.stored;
        const bool senses = action.step == SensingStep::Sense;
        if ((senses || origins != nullptr) && pending.is_set && !pending.in_parameter &&
            table.by_code[codes[i]].operation != TurtleOperation::ParameterBegin &&
            !execute_pending()) {
            return false;
        }
        if (origins != nullptr) {
            report_up_to(origins[i].place);
        }
        if (senses) {
            sink->sense({position, walked_parameters, codes[i]}, now.pose);
        } else if (!take_character(codes[i], arguments)) {
            return false;
        }
        walked_parameters += action.stored;
    }
    return true;
}

template <typename C>
std::optional<Stop> SensingTurtle::State::walk_plain(std::span<const C> codes,
                                                     const float* parameters) {
    while (!codes.empty()) {
        if (options.cancelled != nullptr && options.cancelled->load(std::memory_order_relaxed)) {
            return Stop::Cancelled;
        }
        const std::span<const C> piece = codes.first(std::min(codes.size(), kPiece));
        const float* const next = parameters + walked_parameters;
        if (!(table.reads_text ? run_text(piece, next, nullptr) : run(piece, next, nullptr))) {
            return stopped;
        }
        codes = codes.subspan(piece.size());
    }
    return std::nullopt;
}

template <typename C>
std::optional<Stop> SensingTurtle::State::walk_interpreted(std::span<const C> codes,
                                                           const Word& word) {
    const std::unique_ptr<Interpretation> interpretation = Interpretation::make(
        bytecode, {options.seed, age, options.max_bytes, options.cancelled}, true,
        [this](std::span<const Code> some, std::span<const float> values,
               std::span<const Origin> from) {
            return table.reads_text ? run_text(some, values.data(), from.data())
                                    : run(some, values.data(), from.data());
        });
    std::vector<Code> piece;
    std::vector<Origin> origins;
    std::uint64_t first_parameter = 0;
    for (std::uint64_t first = 0; first < codes.size(); first += kPiece) {
        const std::size_t count = std::min<std::size_t>(codes.size() - first, kPiece);
        piece.assign(codes.begin() + static_cast<std::ptrdiff_t>(first),
                     codes.begin() + static_cast<std::ptrdiff_t>(first + count));
        origins.resize(count);
        waiting.clear();
        reported = 0;
        std::uint64_t stored = 0;
        for (std::size_t i = 0; i < count; ++i) {
            // Modules that productions write for a followed module keep its index as Origin::place.
            origins[i] = {static_cast<std::uint32_t>(i), kFollowed};
            if (bytecode.symbol(bytecode.symbol_of(piece[i])).senses()) {
                waiting.push_back({i, first_parameter + stored, piece[i]});
            }
            stored += bytecode.stored_parameters(piece[i]);
        }
        first_of_piece = first;
        const std::optional<Stop> stop = interpretation->feed(
            piece, word.parameters().subspan(first_parameter, stored), origins);
        if (stopped) {
            return stopped;
        }
        if (stop == Stop::Diagnosed) {
            error = interpretation->error();
        }
        if (stop) {
            return stop;
        }
        report_up_to(count);
        first_parameter += stored;
    }
    return std::nullopt;
}

std::optional<Stop> SensingTurtle::State::walk(const Word& word, std::uint32_t word_age) {
    begin();
    age = word_age;
    walked_parameters = 0;
    const std::optional<Stop> stop = word.visit([&](auto codes) {
        return interprets ? walk_interpreted(codes, word)
                          : walk_plain(codes, word.parameters().data());
    });
    if (!stop && pending.is_set && !pending.in_parameter) {
        static_cast<void>(execute_pending()); // sets `stopped` if it fails
    }
    return stop ? stop : stopped;
}

SensingTurtle::SensingTurtle(const Bytecode& bytecode, SensingOptions options)
    : state_(std::make_unique<State>(bytecode, std::move(options))) {}
SensingTurtle::~SensingTurtle() = default;

std::optional<Stop> SensingTurtle::walk(const Word& word, std::uint32_t age, SenseSink& sink) {
    state_->sink = &sink;
    return catch_out_of_memory([&] { return state_->walk(word, age); },
                               [] { return std::optional(Stop::OutOfMemory); });
}

const RuntimeError& SensingTurtle::error() const {
    return state_->error;
}

} // namespace lsys
