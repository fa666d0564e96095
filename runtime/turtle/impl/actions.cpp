// SPDX-License-Identifier: MIT
#include "runtime/turtle/impl/actions.h"

#include "grammar/base/trigonometry.h"
#include "runtime/turtle/surface_name.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <system_error>

namespace lsys {

namespace {

constexpr double kHalfDegree = std::numbers::pi / 360.0;

constexpr bool is_consistent(TurtleOperation operation) {
    const TurtleInfo& row = info(operation);
    return (row.quick != QuickAction::Forward || row.drawn == DrawnKind::Segment) &&
           (row.quick != QuickAction::NoEffect || row.drawn == DrawnKind::Nothing) &&
           (!row.has(TurtleInfo::Inverse) || turns(operation)) &&
           (!row.has(TurtleInfo::HasNoLength) || row.drawn == DrawnKind::Object);
}
static_assert(std::ranges::all_of(enumerators_of<TurtleOperation>(), is_consistent),
              "a row of turtle_operations.def contradicts itself");

/// The quick action of the operation; None for a turn whose angle is not constant.
QuickAction quick_action(const Action& action, bool angle_is_constant) {
    const bool turn_is_constant =
        action.stored == 0 && (action.argument_count != 0 || angle_is_constant);
    return turns(action.operation) && !turn_is_constant ? QuickAction::None
                                                        : info(action.operation).quick;
}

Action action_of(const BytecodeSymbol& symbol, const Settings& settings) {
    const TurtleTraits& traits = settings.traits;
    Action action;
    action.operation = symbol.turtle;
    action.argument_count =
        static_cast<std::uint8_t>(std::min(symbol.parameter_count, kTurtleArguments));
    action.advances =
        symbol.turtle == TurtleOperation::Leaf ? traits.leaf_moves : traits.object_moves;
    action.default_size = traits.object_has_step_scale ? settings.step_scale : 1.0F;
    action.character = symbol.name.size() == 1 ? symbol.name[0] : '\0';
    action.unit_length = info(symbol.turtle).has(TurtleInfo::HasNoLength) ? 0.0F : 1.0F;
    return action;
}

/// The index of the contour with this name; kNoContour without a name.
std::uint32_t contour_of(const Bytecode& bytecode, const std::string& name) {
    const auto found = std::ranges::find(bytecode.contours, name, &BytecodeContour::name);
    return found == bytecode.contours.end()
               ? kNoContour
               : static_cast<std::uint32_t>(found - bytecode.contours.begin());
}

/// The contours whose names are `contour` and a number, by number.
std::map<std::uint32_t, std::uint32_t> numbered(const std::vector<BytecodeContour>& contours) {
    constexpr std::string_view kBegin = "contour";
    std::map<std::uint32_t, std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < contours.size(); ++i) {
        const std::string_view name = contours[i].name;
        std::uint32_t number = 0;
        if (!name.starts_with(kBegin)) {
            continue;
        }
        const char* const end = name.data() + name.size();
        const auto [rest, error] = std::from_chars(name.data() + kBegin.size(), end, number);
        if (error == std::errc() && rest == end) {
            numbers.emplace(number, i);
        }
    }
    return numbers;
}

} // namespace

HalfAngle half_angle(double degrees) {
    // Multiples of 720 degrees are removed; half turns and whole turns are exact.
    const double turn = std::remainder(degrees, 720.0);
    if (std::abs(turn) == 180.0) {
        return {0.0, turn > 0.0 ? 1.0 : -1.0};
    }
    if (std::abs(turn) == 360.0) {
        return {-1.0, 0.0};
    }
    const SineCosine half = sine_cosine(turn * kHalfDegree);
    return {half.cosine, half.sine};
}

bool any_has(const Bytecode& bytecode, TurtleInfo::Trait trait) {
    return std::any_of(bytecode.symbols.begin(), bytecode.symbols.end(),
                       [&](const auto& symbol) { return info(symbol.turtle).has(trait); });
}

std::uint32_t ActionTable::numbered_contour(float number) const {
    constexpr float kMax = 1e6F;
    if (!(number >= 0.0F && number <= kMax)) {
        return kNoContour;
    }
    const auto found = numbered_contours.find(static_cast<std::uint32_t>(number));
    return found == numbered_contours.end() ? kNoContour : found->second;
}

ActionTable make_actions(const Bytecode& bytecode, const TurtleOptions& options) {
    ActionTable table;
    const std::size_t symbol_count = bytecode.symbols.size();
    // A turn also changes the angle to the second heading, which quick actions do not update.
    const bool angle_is_constant = !any_has(bytecode, TurtleInfo::SecondHeading) &&
                                   !any_has(bytecode, TurtleInfo::ChangesAngle);
    if (!bytecode.contours.empty()) {
        table.contours = std::make_shared<const std::vector<BytecodeContour>>(bytecode.contours);
        table.numbered_contours = numbered(bytecode.contours);
    }
    std::vector<Action> symbol_actions;
    symbol_actions.reserve(symbol_count);
    for (std::size_t i = 0; i < symbol_count; ++i) {
        const BytecodeSymbol& symbol = bytecode.symbols[i];
        Action action = action_of(symbol, bytecode.settings);
        if (symbol.turtle == TurtleOperation::MeshFile) {
            action.mesh_file = static_cast<std::uint32_t>(table.mesh_files.size());
            action.unit_length = i < options.mesh_lengths.size() ? options.mesh_lengths[i] : 1.0F;
            table.mesh_files.push_back(symbol.mesh_file);
            const std::optional<SurfaceName> surface = surface_name(symbol.mesh_file);
            action.texture = surface ? surface->texture.value_or(kTurtleTexture) : kTurtleTexture;
        }
        if (symbol.turtle == TurtleOperation::PolygonBegin && !symbol.mesh_file.empty()) {
            action.picture = static_cast<std::uint32_t>(table.mesh_files.size());
            table.mesh_files.push_back(symbol.mesh_file);
        }
        if (symbol.turtle == TurtleOperation::SetContour) {
            action.contour = contour_of(bytecode, symbol.mesh_file);
        }
        table.draws_organs = table.draws_organs || symbol.turtle == TurtleOperation::SurfaceBegin;
        table.reads_text = table.reads_text || symbol.turtle == TurtleOperation::ParameterBegin;
        symbol_actions.push_back(action);
    }
    table.by_code.reserve(bytecode.code_count());
    for (Code code = 0; code < bytecode.code_count(); ++code) {
        Action action = symbol_actions[static_cast<std::size_t>(bytecode.symbol_of(code))];
        action.stored = bytecode.stored_parameters(code);
        if (code >= symbol_count && action.argument_count != 0) {
            const std::uint32_t first = bytecode.folded[code - symbol_count].first_constant;
            for (std::uint32_t i = 0; i < action.argument_count; ++i) {
                action.arguments[i] = bytecode.constants[first + i];
            }
        }
        const bool has_argument = code >= symbol_count && action.argument_count != 0;
        action.turn = half_angle(
            static_cast<double>(has_argument ? action.arguments[0] : bytecode.settings.angle));
        if (info(action.operation).has(TurtleInfo::Inverse)) {
            action.turn.sine = -action.turn.sine;
        }
        action.quick = quick_action(action, angle_is_constant);
        if (action.quick == QuickAction::Forward && action.argument_count > 1 &&
            bytecode.settings.traits.forward_has_width) {
            action.quick = QuickAction::None; // forward_with_width() reads the width
        }
        if (action.quick == QuickAction::Restore && options.branches != nullptr) {
            action.quick = QuickAction::None; // restore() calls the watcher
        }
        if (table.draws_organs &&
            (action.quick == QuickAction::Forward || action.quick == QuickAction::Save ||
             action.quick == QuickAction::Restore)) {
            action.quick = QuickAction::None; // `F`, `[`, `]` may change the open organ
        }
        table.by_code.push_back(action);
    }
    return table;
}

} // namespace lsys
