#include "runtime/turtle/impl/actions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lsys {

namespace {

constexpr double kHalfDegree = std::numbers::pi / 360.0;

/// Profiles whose leaves are copied to the place of the turtle, which stays there.
bool leaves_stay(TurtleProfile profile) {
    return profile == TurtleProfile::Houdini || profile == TurtleProfile::L3d ||
           profile == TurtleProfile::Lplus || profile == TurtleProfile::Carey ||
           is_of_program(profile) || profile == TurtleProfile::Sidefx;
}

/// Rotations against the sense of yaw(), pitch() and roll().
bool turns_back(TurtleOperation operation) {
    return operation == TurtleOperation::YawRight || operation == TurtleOperation::PitchDown ||
           operation == TurtleOperation::RollLeft;
}

/// What the walk does itself, if the module's arguments are constant.
QuickAction quick_action(const Action& action, bool angle_is_constant) {
    const bool turn_is_constant = action.stored == 0 && (action.given != 0 || angle_is_constant);
    const auto if_constant = [&](QuickAction quick) {
        return turn_is_constant ? quick : QuickAction::None;
    };
    switch (action.operation) {
    case TurtleOperation::Nothing:
    case TurtleOperation::Text:
        return QuickAction::Nothing;
    case TurtleOperation::YawRight:
    case TurtleOperation::YawLeft:
        return if_constant(QuickAction::Yaw);
    case TurtleOperation::PitchDown:
    case TurtleOperation::PitchUp:
        return if_constant(QuickAction::Pitch);
    case TurtleOperation::RollLeft:
    case TurtleOperation::RollRight:
        return if_constant(QuickAction::Roll);
    case TurtleOperation::Forward:
    case TurtleOperation::Branch:
        return QuickAction::Forward;
    case TurtleOperation::Save:
        return QuickAction::Save;
    case TurtleOperation::Restore:
        return QuickAction::Restore;
    default:
        return QuickAction::None;
    }
}

Action action_of(const BytecodeSymbol& symbol, TurtleProfile profile, float step_scale) {
    Action action;
    action.operation = symbol.turtle;
    action.given = static_cast<std::uint8_t>(std::min(symbol.parameter_count, kTurtleArguments));
    // What Houdini places is bound to its leaf inputs.
    action.advances = profile != TurtleProfile::Sidefx &&
                      !(symbol.turtle == TurtleOperation::Leaf && leaves_stay(profile));
    action.usual_size = profile == TurtleProfile::Sidefx ? step_scale : 1.0F;
    action.character = symbol.name.size() == 1 ? symbol.name[0] : '\0';
    action.unit_length = symbol.turtle == TurtleOperation::Disk ? 0.0F : 1.0F;
    return action;
}

} // namespace

HalfAngle half_angle(double degrees) {
    // Whole turns drop out, and right angles are exact.
    const double turn = std::remainder(degrees, 720.0);
    if (std::abs(turn) == 180.0) {
        return {0.0, turn > 0.0 ? 1.0 : -1.0};
    }
    if (std::abs(turn) == 360.0) {
        return {-1.0, 0.0};
    }
    return {std::cos(turn * kHalfDegree), std::sin(turn * kHalfDegree)};
}

bool uses_aside(const Bytecode& bytecode) {
    return std::any_of(bytecode.symbols.begin(), bytecode.symbols.end(), [](const auto& symbol) {
        return symbol.turtle == TurtleOperation::AsideForward ||
               symbol.turtle == TurtleOperation::AsideMove;
    });
}

ActionTable make_actions(const Bytecode& bytecode, const TurtleOptions& options) {
    ActionTable table;
    const std::size_t symbol_count = bytecode.symbols.size();
    // Where a second heading is drawn along, turns of the first do not move it.
    const bool angle_is_constant =
        !uses_aside(bytecode) &&
        std::none_of(bytecode.symbols.begin(), bytecode.symbols.end(), [](const auto& symbol) {
            return symbol.turtle == TurtleOperation::ScaleAngle ||
                   symbol.turtle == TurtleOperation::DivideAngle;
        });
    std::vector<Action> of_symbol;
    of_symbol.reserve(symbol_count);
    for (std::size_t i = 0; i < symbol_count; ++i) {
        const BytecodeSymbol& symbol = bytecode.symbols[i];
        Action action = action_of(symbol, bytecode.settings.turtle, bytecode.settings.step_scale);
        if (symbol.turtle == TurtleOperation::MeshFile) {
            action.mesh_file = static_cast<std::uint32_t>(table.mesh_files.size());
            action.unit_length = i < options.mesh_lengths.size() ? options.mesh_lengths[i] : 1.0F;
            table.mesh_files.push_back(symbol.mesh_file);
        }
        table.reads_text = table.reads_text || symbol.turtle == TurtleOperation::ParameterBegin;
        of_symbol.push_back(action);
    }
    table.by_code.reserve(bytecode.code_count());
    for (Code code = 0; code < bytecode.code_count(); ++code) {
        Action action = of_symbol[static_cast<std::size_t>(bytecode.symbol_of(code))];
        action.stored = bytecode.stored_parameters(code);
        if (code >= symbol_count && action.given != 0) {
            const std::uint32_t first = bytecode.folded[code - symbol_count].first_constant;
            for (std::uint32_t i = 0; i < action.given; ++i) {
                action.arguments[i] = bytecode.constants[first + i];
            }
        }
        const bool has_argument = code >= symbol_count && action.given != 0;
        action.turn = half_angle(
            static_cast<double>(has_argument ? action.arguments[0] : bytecode.settings.angle));
        if (turns_back(action.operation)) {
            action.turn.sine = -action.turn.sine;
        }
        action.quick = quick_action(action, angle_is_constant);
        if (action.quick == QuickAction::Forward && action.given > 1 &&
            bytecode.settings.turtle == TurtleProfile::Sidefx) {
            action.quick = QuickAction::None; // the width is a parameter
        }
        if (action.quick == QuickAction::Restore && options.branches != nullptr) {
            action.quick = QuickAction::None; // the watcher is told
        }
        table.by_code.push_back(action);
    }
    return table;
}

} // namespace lsys
