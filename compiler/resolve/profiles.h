// SPDX-License-Identifier: MIT
// The turtle profiles of docs/language.md section 7 as data: the commands of each profile. The
// names of the profiles are in turtle_profiles.def. SymbolTable and the checks read the commands;
// the runtime uses only their operations.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/bytecode/settings.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace lsys {

/// A turtle command of a profile: a module name, and the operation that the turtle executes for it.
struct TurtleCommand {
    constexpr TurtleCommand() = default;
    /// Takes the parameters from the row of the operation in turtle_operations.def.
    constexpr TurtleCommand(std::string_view module_name, TurtleOperation turtle_operation)
        : TurtleCommand(module_name,
                        turtle_operation,
                        info(turtle_operation).parameter_count,
                        info(turtle_operation).parameters) {}
    constexpr TurtleCommand(std::string_view module_name,
                            TurtleOperation turtle_operation,
                            std::uint8_t parameter_count,
                            std::string_view meanings)
        : name(module_name), operation(turtle_operation), max_parameters(parameter_count),
          parameters(meanings) {}

    std::string_view name;
    TurtleOperation operation = TurtleOperation::Nothing;
    std::uint8_t max_parameters = 0;
    std::string_view parameters; // meanings: "length, spring constant, mass"
};

/// The commands of a profile. If several rows have one name, the first row applies.
[[nodiscard]] std::span<const TurtleCommand> turtle_commands(TurtleProfile profile);
/// The command of that name, or null.
[[nodiscard]] const TurtleCommand* find_turtle_command(TurtleProfile profile,
                                                       std::string_view name);

/// The operation of the command with this number of parameters.
[[nodiscard]] TurtleOperation operation_of(const TurtleCommand& command,
                                           std::uint32_t parameter_count);

/// Whether `name` is a bracket or polygon module: `[ ]` in every profile, `{ } .` in profiles with
/// polygons (all except the profiles of L3D and Fractint). These modules take no parameters, and
/// #object cannot bind them, except `{` to a picture.
[[nodiscard]] bool is_structural(TurtleProfile profile, std::string_view name);
/// Whether a module of this name takes no parameters (docs/language.md section 3).
[[nodiscard]] bool takes_no_parameters(std::string_view name);
[[nodiscard]] SymbolKind kind_of(TurtleProfile profile, std::string_view name);

/// An object name that #object can bind to modules.
struct TurtleObject {
    std::string_view name;
    TurtleOperation operation;
};
[[nodiscard]] std::span<const TurtleObject> turtle_objects();
[[nodiscard]] std::optional<TurtleOperation> find_turtle_object(std::string_view name);

} // namespace lsys
