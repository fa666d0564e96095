#include "compiler/resolve/profiles.h"

#include "grammar/base/contract.h"

#include <array>

namespace lsys {

namespace {

using enum TurtleOperation;

constexpr TurtleCommand kSave{"[", Save, 0, ""};
constexpr TurtleCommand kRestore{"]", Restore, 0, ""};
constexpr TurtleCommand kPolygonBegin{"{", PolygonBegin, 0, ""};
constexpr TurtleCommand kPolygonVertex{".", PolygonVertex, 0, ""};
constexpr TurtleCommand kPolygonEnd{"}", PolygonEnd, 0, ""};
constexpr TurtleCommand kTurnAround{"|", TurnAround, 0, ""};
constexpr TurtleCommand kUpright{"$", RollUpright, 0, ""};
constexpr TurtleCommand kCut{"%", Cut, 0, ""};
constexpr TurtleCommand kForward{"F", Forward, 3, "length, spring constant, mass"};
constexpr TurtleCommand kMove{"f", Move, 2, "length, spring constant"};
constexpr TurtleCommand kSetWidth{"!", SetWidth, 2, "width, sides"};
constexpr TurtleCommand kScaleStep{"\"", ScaleStep, 1, "factor of the step"};
constexpr TurtleCommand kSetColour{"'", SetColour, 1, "index of a colour"};

constexpr TurtleCommand kParameterBegin{"(", ParameterBegin, 0, ""};
constexpr TurtleCommand kParameterEnd{")", ParameterEnd, 0, ""};
constexpr TurtleCommand text(std::string_view name) {
    return {name, Text, 0, ""};
}

constexpr TurtleCommand turn(std::string_view name, TurtleOperation operation) {
    return {name, operation, 1, "angle"};
}
constexpr TurtleCommand length(std::string_view name, TurtleOperation operation) {
    return {name, operation, 1, "length"};
}

constexpr std::array kLsys{
    kForward,
    kMove,
    turn("+", YawRight),
    turn("-", YawLeft),
    turn("&", PitchDown),
    turn("^", PitchUp),
    turn("\\", RollLeft),
    turn("/", RollRight),
    kTurnAround,
    kUpright,
    kSetWidth,
    kScaleStep,
    kSetColour,
    kSave,
    kRestore,
    kPolygonBegin,
    kPolygonVertex,
    kPolygonEnd,
    kCut,
};

// Crankshaw 2019, table 5.1.
constexpr std::array kThesis{
    kForward,
    kMove,
    turn("+", YawRight),
    turn("-", YawLeft),
    turn("/", PitchUp),
    turn("\\", PitchDown),
    turn("^", RollRight),
    turn("&", RollLeft),
    kSetWidth,
    kSave,
    kRestore,
    kPolygonBegin,
    kPolygonVertex,
    kPolygonEnd,
    kCut,
};

constexpr std::array kAbop{
    kForward,
    kMove,
    turn("+", YawLeft),
    turn("-", YawRight),
    turn("&", PitchDown),
    turn("^", PitchUp),
    turn("\\", RollLeft),
    turn("/", RollRight),
    kTurnAround,
    kUpright,
    kSetWidth,
    kScaleStep,
    kSetColour,
    kSave,
    kRestore,
    kPolygonBegin,
    kPolygonVertex,
    kPolygonEnd,
    kCut,
};

// Carey 2019, appendix, and what else Houdini has of the same kind.
constexpr std::array kHoudini{
    length("F", Forward),
    length("f", Move),
    length("H", HalfForward),
    length("h", HalfMove),
    length("G", Move),
    turn("+", YawRight),
    turn("-", YawLeft),
    turn("&", PitchUp),
    turn("^", PitchDown),
    turn("\\", RollLeft),
    turn("/", RollRight),
    kTurnAround,
    TurtleCommand{"*", RollAround, 0, ""},
    kUpright,
    TurtleCommand{"!", ScaleWidth, 1, "factor of the width"},
    kScaleStep,
    TurtleCommand{";", ScaleAngle, 1, "factor of the angle"},
    kSetColour,
    TurtleCommand{"J", Leaf, 1, "size"},
    TurtleCommand{"K", Leaf, 1, "size"},
    TurtleCommand{"M", Leaf, 1, "size"},
    kSave,
    kRestore,
    kPolygonBegin,
    kPolygonVertex,
    kPolygonEnd,
    kCut,
};

/// The rows of tables, one after the other.
template <std::size_t... sizes>
constexpr auto joined(const std::array<TurtleCommand, sizes>&... tables) {
    std::array<TurtleCommand, (sizes + ...)> rows{};
    std::size_t count = 0;
    const auto append = [&](const auto& table) {
        for (const TurtleCommand& row : table) {
            rows[count++] = row;
        }
    };
    (append(tables), ...);
    return rows;
}

// A word of L3D is a text: a parenthesis behind a command holds its parameter, character by
// character.
constexpr std::array kTextTurns{
    turn("+", YawLeft), turn("-", YawRight),  turn("&", PitchDown),
    turn("^", PitchUp), turn("\\", RollLeft), turn("/", RollRight),
};
constexpr std::array kTextOthers{
    kTurnAround, kSave,     kRestore,  kParameterBegin, kParameterEnd, text(" "),
    text("."),   text("0"), text("1"), text("2"),       text("3"),     text("4"),
    text("5"),   text("6"), text("7"), text("8"),       text("9"),
};

constexpr std::array kL3d =
    joined(std::array{length("F", Forward), length("f", Forward), length("g", Move)},
           kTextTurns,
           std::array{turn("<", RollLeft), turn(">", RollRight)},
           kTextOthers);

constexpr std::array kLplus = joined(
    std::array{length("F", Forward), length("f", Forward), length("g", Move), length("G", Move)},
    kTextTurns,
    std::array{
        TurtleCommand{"<", ThickenWidth, 1, "percent"},
        TurtleCommand{">", ThinWidth, 1, "percent"},
        TurtleCommand{"=", SetRelativeWidth, 1, "percent of the length"},
        TurtleCommand{"%", SetTaper, 1, "percent"},
        TurtleCommand{"*", Leaf, 1, "size"},
    },
    kTextOthers);

/// The same as the program has it, which takes pi for degrees.
template <std::size_t size>
constexpr std::array<TurtleCommand, size> of_program(std::array<TurtleCommand, size> commands) {
    for (TurtleCommand& command : commands) {
        command.operation = command.operation == TurnAround ? TurnByPi : command.operation;
    }
    return commands;
}
constexpr std::array kL3dProgram = of_program(kL3d);
constexpr std::array kLplusProgram = of_program(kLplus);

constexpr std::array kSys{
    TurtleCommand{"F", TaperedForward, 3, "length, base width, tip width"},
    turn("<", YawRight),
    turn(">", YawLeft),
    turn("&", PitchDown),
    turn("@", PitchUp),
    turn("%", RollRight),
    turn("#", RollLeft),
    kTurnAround,
    kSave,
    kRestore,
    kPolygonBegin,
    kPolygonVertex,
    kPolygonEnd,
};

// What of Houdini's symbols Carey's forest generator has.
constexpr std::array kCarey{
    length("F", Forward),
    length("f", Move),
    turn("+", YawRight),
    turn("-", YawLeft),
    turn("&", PitchUp),
    turn("^", PitchDown),
    turn("\\", RollLeft),
    turn("/", RollRight),
    TurtleCommand{"!", ScaleWidth, 1, "factor of the width"},
    kScaleStep,
    TurtleCommand{";", ScaleAngle, 1, "factor of the angle"},
    TurtleCommand{"J", Leaf, 1, "size"},
    kSave,
    kRestore,
    kPolygonBegin,
    kPolygonVertex,
    kPolygonEnd,
};

// Fractint's turtle in the plane: `F G + - |` have a heading of whole angles, `D M \\ /` another
// one.
constexpr std::array kFractint{
    TurtleCommand{"F", Forward, 0, ""},
    TurtleCommand{"G", Move, 0, ""},
    TurtleCommand{"D", SecondaryForward, 0, ""},
    TurtleCommand{"M", SecondaryMove, 0, ""},
    TurtleCommand{"+", YawLeft, 0, ""},
    TurtleCommand{"-", YawRight, 0, ""},
    TurtleCommand{"|", HalfTurnSnapped, 0, ""},
    turn("\\", SecondaryLeft),
    turn("/", SecondaryRight),
    TurtleCommand{"!", Mirror, 0, ""},
    TurtleCommand{"@", ScaleStep, 1, "factor of the step"},
    TurtleCommand{"C", SetColour, 1, "index of a colour"},
    TurtleCommand{"<", AddColour, 1, "number of colours"},
    TurtleCommand{">", SubtractColour, 1, "number of colours"},
    kSave,
    kRestore,
};

// Houdini's own turtle. All its turns are those of ABOP the other way round.
constexpr std::array kSidefx{
    TurtleCommand{"F", Forward, 4, "length, width, sections, sides"},
    TurtleCommand{"H", HalfForward, 4, "length, width, sections, sides"},
    TurtleCommand{"G", MoveWithoutVertex, 4, "length, width, sections, sides"},
    TurtleCommand{"f", Move, 4, "length, width, sections, sides"},
    TurtleCommand{"h", HalfMove, 4, "length, width, sections, sides"},
    TurtleCommand{"J", Leaf, 5, "size, nothing, three values"},
    TurtleCommand{"K", Leaf, 5, "size, nothing, three values"},
    TurtleCommand{"M", Leaf, 5, "size, nothing, three values"},
    TurtleCommand{"T", Bend, 1, "susceptibility"},
    turn("+", YawRight),
    turn("-", YawLeft),
    turn("&", PitchUp),
    turn("^", PitchDown),
    turn("\\", RollRight),
    turn("/", RollLeft),
    kTurnAround,
    TurtleCommand{"*", RollAround, 0, ""},
    TurtleCommand{"~", TurnBy, 3, "angles of pitch, roll and yaw"},
    kUpright,
    TurtleCommand{"aim", PointAt, 3, "a point"},
    kScaleStep,
    TurtleCommand{"!", ScaleWidth, 1, "factor of the width"},
    TurtleCommand{";", ScaleAngle, 1, "factor of the angle"},
    TurtleCommand{"_", DivideStep, 1, "divisor of the step"},
    TurtleCommand{"?", DivideWidth, 1, "divisor of the width"},
    TurtleCommand{"@", DivideAngle, 1, "divisor of the angle"},
    kSave,
    kRestore,
    kPolygonBegin,
    kPolygonVertex,
    kPolygonEnd,
    kCut,
};

bool has_polygons(TurtleProfile profile) {
    return find_turtle_command(profile, "{") != nullptr;
}

constexpr std::array<TurtleObject, 9> kObjects{{
    {"BRANCH", Branch},
    {"SPHERE", Sphere},
    {"HETEROCYST", Heterocyst},
    {"LEAF", Leaf},
    {"FLOWER", Flower},
    {"CYLINDER", Cylinder},
    {"CONE", Cone},
    {"CUBE", Cube},
    {"DISK", Disk},
}};

} // namespace

std::span<const TurtleCommand> turtle_commands(TurtleProfile profile) {
    switch (profile) {
    case TurtleProfile::Lsys:
        return kLsys;
    case TurtleProfile::Thesis:
        return kThesis;
    case TurtleProfile::Abop:
        return kAbop;
    case TurtleProfile::Houdini:
        return kHoudini;
    case TurtleProfile::L3d:
        return kL3d;
    case TurtleProfile::Lplus:
        return kLplus;
    case TurtleProfile::Sys:
        return kSys;
    case TurtleProfile::Carey:
        return kCarey;
    case TurtleProfile::L3dProgram:
        return kL3dProgram;
    case TurtleProfile::LplusProgram:
        return kLplusProgram;
    case TurtleProfile::Fractint:
        return kFractint;
    case TurtleProfile::Sidefx:
        return kSidefx;
    }
    LSYS_CHECK(false, static_cast<int>(profile));
    return {};
}

const TurtleCommand* find_turtle_command(TurtleProfile profile, std::string_view name) {
    for (const TurtleCommand& command : turtle_commands(profile)) {
        if (command.name == name) {
            return &command;
        }
    }
    return nullptr;
}

bool is_structural(TurtleProfile profile, std::string_view name) {
    const std::string_view names = has_polygons(profile) ? "[]{}." : "[]";
    return name.size() == 1 && names.find(name) != std::string_view::npos;
}

bool takes_no_parameters(std::string_view name) {
    return name.size() == 1 && std::string_view("[]{}.|$").find(name) != std::string_view::npos;
}

SymbolKind kind_of(TurtleProfile profile, std::string_view name) {
    if (name == "[") {
        return SymbolKind::BranchOpen;
    }
    if (name == "]") {
        return SymbolKind::BranchClose;
    }
    if (!has_polygons(profile)) {
        return SymbolKind::Plain;
    }
    if (name == "{") {
        return SymbolKind::PolygonOpen;
    }
    if (name == "}") {
        return SymbolKind::PolygonClose;
    }
    return SymbolKind::Plain;
}

std::span<const TurtleObject> turtle_objects() {
    return kObjects;
}

std::optional<TurtleOperation> find_turtle_object(std::string_view name) {
    for (const TurtleObject& object : kObjects) {
        if (object.name == name) {
            return object.operation;
        }
    }
    return std::nullopt;
}

} // namespace lsys
