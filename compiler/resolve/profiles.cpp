// SPDX-License-Identifier: MIT
#include "compiler/resolve/profiles.h"

#include "grammar/base/contract.h"

#include <algorithm>
#include <array>

namespace lsys {

namespace {

using enum TurtleOperation;

template <std::size_t size>
using Commands = std::array<TurtleCommand, size>;

template <std::size_t size>
constexpr Commands<size> commands(const TurtleCommand (&rows)[size]) {
    return std::to_array(rows);
}

/// Concatenates tables.
template <std::size_t... sizes>
constexpr Commands<(sizes + ...)> joined(const Commands<sizes>&... tables) {
    Commands<(sizes + ...)> rows{};
    auto next = rows.begin();
    ((next = std::copy(tables.begin(), tables.end(), next)), ...);
    return rows;
}

// These functions make rows whose parameters differ from the row of their operation in
// turtle_operations.def.

constexpr TurtleCommand bare(std::string_view name, TurtleOperation operation) {
    return {name, operation, 0, ""};
}
constexpr TurtleCommand length(std::string_view name, TurtleOperation operation) {
    return {name, operation, 1, "length"};
}
constexpr TurtleCommand segment(std::string_view name, TurtleOperation operation) {
    return {name, operation, 4, "length, width, sections, sides"};
}
constexpr TurtleCommand leaf(std::string_view name) {
    return {name, Leaf, 5, "size, nothing, three values"};
}

/// operation_of() turns the command into SetRgb if it has three or more parameters.
constexpr TurtleCommand kColour{"'", SetColour, 3, "index of a colour, or red, green and blue"};

/// A row for each character of `names`.
template <std::size_t size>
constexpr Commands<size> characters(std::string_view names,
                                    const std::array<TurtleOperation, size>& operations) {
    Commands<size> rows{};
    for (std::size_t i = 0; i < size; ++i) {
        rows[i] = {names.substr(i, 1), operations[i]};
    }
    return rows;
}
constexpr Commands<6> turns(const std::array<TurtleOperation, 6>& operations) {
    return characters("+-&^\\/", operations);
}
constexpr auto kTurnsLeft = turns({YawLeft, YawRight, PitchDown, PitchUp, RollLeft, RollRight});

constexpr auto kBranches = commands({{"[", Save}, {"]", Restore}});
constexpr auto kPolygons =
    joined(kBranches, commands({{"{", PolygonBegin}, {".", PolygonVertex}, {"}", PolygonEnd}}));
constexpr auto kPolygonsAndCut = joined(kPolygons, commands({{"%", Cut}}));

constexpr auto kForwardAndMove = commands({{"F", Forward}, {"f", Move}});
// The commands that the profiles `lsys` and `abop` share, except turns.
constexpr auto kCommandsExceptTurns = joined(
    commands({{"|", TurnAround}, {"$", RollUpright}, {"!", SetWidth}, {"\"", ScaleStep}, kColour}),
    kPolygonsAndCut);

constexpr auto kLsys = joined(kForwardAndMove,
                              turns({YawRight, YawLeft, PitchDown, PitchUp, RollLeft, RollRight}),
                              kCommandsExceptTurns);
constexpr auto kAbop = joined(kForwardAndMove, kTurnsLeft, kCommandsExceptTurns);

// Crankshaw 2019, table 5.1.
constexpr auto kThesis = joined(kForwardAndMove,
                                turns({YawRight, YawLeft, RollLeft, RollRight, PitchDown, PitchUp}),
                                commands({{"!", SetWidth}}),
                                kPolygonsAndCut);

// Carey 2019. kCarey has the symbols of Houdini that Carey's forest generator reads. kHoudini also
// has the other symbols of Carey's appendix, and similar symbols of Houdini.
constexpr auto kCarey =
    joined(commands({length("F", Forward), length("f", Move)}),
           turns({YawRight, YawLeft, PitchUp, PitchDown, RollLeft, RollRight}),
           commands({{"!", ScaleWidth}, {"\"", ScaleStep}, {";", ScaleAngle}, {"J", Leaf}}),
           kPolygons);
constexpr auto kHoudini = joined(kCarey,
                                 commands({length("H", HalfForward),
                                           length("h", HalfMove),
                                           length("G", Move),
                                           {"|", TurnAround},
                                           {"*", RollAround},
                                           {"$", RollUpright},
                                           {"'", SetColour},
                                           {"K", Leaf},
                                           {"M", Leaf},
                                           {"%", Cut}}));

// L3D rewrites text: each character of the parameter of a command, with its parentheses, is a
// module.
constexpr std::array<TurtleOperation, 12> kTextOperations{Text, Text, Text, Text, Text, Text,
                                                          Text, Text, Text, Text, Text, Text};
constexpr auto kParameterText = joined(kBranches,
                                       commands({{"(", ParameterBegin}, {")", ParameterEnd}}),
                                       characters(" .0123456789", kTextOperations));
constexpr auto kL3dTurtle =
    joined(commands({length("F", Forward), length("f", Forward), length("g", Move)}),
           kTurnsLeft,
           kParameterText);
constexpr auto kL3dTurns = commands({{"<", RollLeft}, {">", RollRight}});
constexpr auto kLplusWidths = commands({length("G", Move),
                                        {"<", ThickenWidth},
                                        {">", ThinWidth},
                                        {"=", SetRelativeWidth},
                                        {"%", SetTaper},
                                        {"*", Leaf}});
// For `|` the program L3D turns by pi degrees instead of 180 degrees.
constexpr auto kTurn = commands({{"|", TurnAround}});
constexpr auto kBuggyTurn = commands({{"|", TurnByPi}});
constexpr auto kL3d = joined(kL3dTurtle, kL3dTurns, kTurn);
constexpr auto kLplus = joined(kL3dTurtle, kLplusWidths, kTurn);
constexpr auto kL3dBugCompatible = joined(kL3dTurtle, kL3dTurns, kBuggyTurn);
constexpr auto kLplusBugCompatible = joined(kL3dTurtle, kLplusWidths, kBuggyTurn);

constexpr auto kSys = joined(commands({{"F", TaperedForward},
                                       {"<", YawRight},
                                       {">", YawLeft},
                                       {"&", PitchDown},
                                       {"@", PitchUp},
                                       {"%", RollRight},
                                       {"#", RollLeft},
                                       {"|", TurnAround}}),
                             kPolygons);

// Fractint's turtle in the plane: `F G + - |` use a heading of whole angles, `D M \ /` a second
// heading.
constexpr auto kFractint = joined(commands({bare("F", Forward),
                                            bare("G", Move),
                                            {"D", SecondaryForward},
                                            {"M", SecondaryMove},
                                            bare("+", YawLeft),
                                            bare("-", YawRight),
                                            {"|", HalfTurnSnapped},
                                            {"\\", SecondaryLeft},
                                            {"/", SecondaryRight},
                                            {"!", Mirror},
                                            {"@", ScaleStep},
                                            {"C", SetColour},
                                            {"<", AddColour},
                                            {">", SubtractColour}}),
                                  kBranches);

// The turtle of SideFX Houdini. All its turns are opposite to those of ABOP.
constexpr auto kSidefx = joined(
    commands({segment("F", Forward), segment("H", HalfForward), segment("G", MoveWithoutVertex),
              segment("f", Move), segment("h", HalfMove), leaf("J"), leaf("K"), leaf("M")}),
    turns({YawRight, YawLeft, PitchUp, PitchDown, RollRight, RollLeft}),
    commands({{"T", Bend},
              {"|", TurnAround},
              {"*", RollAround},
              {"~", TurnBy},
              {"$", RollUpright},
              {"aim", PointAt},
              {"\"", ScaleStep},
              {"!", ScaleWidth},
              {";", ScaleAngle},
              {"_", DivideStep},
              {"?", DivideWidth},
              {"@", DivideAngle}}),
    kPolygonsAndCut);

// cpfg rolls as the matrices of ABOP 1.5 do: `\\` rolls about the heading, from the up vector
// towards the right vector.
constexpr auto kCpfg =
    joined(kForwardAndMove,
           turns({YawLeft, YawRight, PitchDown, PitchUp, RollRight, RollLeft}),
           commands({{"|", TurnAround}, {"$", RollUpright}, {"\"", ScaleStep}, kColour}),
           kPolygonsAndCut,
           commands({{"G", ForwardWithoutVertex},
                     {"g", MoveWithoutVertex},
                     {"@O", CentredSphere},
                     {"@o", LevelDisk},
                     {"@c", LevelDisk},
                     {"@Gs", SurfaceBegin},
                     {"@Gc", SurfacePoint, 1, "rings, not read"},
                     {"@Ge", SurfaceEnd, 1, "rings, not read"},
                     {"@Gt", SurfaceTangents},
                     {"@Gr", SurfaceRadii},
                     {"@Tx", SetTexture},
                     {"@#", SetContour, 1, "number of the contour"},
                     {"!", NarrowWidth},
                     {"#", WidenWidth},
                     {",", PreviousColour},
                     {"_", SetSusceptibility},
                     {"@Ts", SetTropism},
                     {"@Ti", AddTropism},
                     {"@Td", SubtractTropism},
                     {"@Tp", Untwist},
                     {"@Tf", KeepTwist}}));

constexpr std::array<std::span<const TurtleCommand>, kCountOf<TurtleProfile>> kProfiles{
#define LSYS_TURTLE_PROFILE(identifier, ...) std::span<const TurtleCommand>(k##identifier),
#include "compiler/bytecode/turtle_profiles.def"
};

constexpr std::array<TurtleObject, 16> kObjects{{
    {"BRANCH", Branch},
    {"SPHERE", Sphere},
    {"HETEROCYST", Heterocyst},
    {"LEAF", Leaf},
    {"FLOWER", Flower},
    {"CYLINDER", Cylinder},
    {"CONE", Cone},
    {"CUBE", Cube},
    {"DISK", Disk},
    {"SURFACE_BEGIN", SurfaceBegin},
    {"SURFACE_POINT", SurfacePoint},
    {"SURFACE_END", SurfaceEnd},
    {"SURFACE_TANGENTS", SurfaceTangents},
    {"SURFACE_RADII", SurfaceRadii},
    {"CONTOUR", SetContour},
    {"BEND", Bend},
}};
/// Whether #object has a name for an operation that places an object. True for operations that need
/// no name: mesh files, objects that are commands of a profile, and operations without an object.
constexpr bool has_name_if_object(TurtleOperation operation) {
    const auto has_command = [operation](std::span<const TurtleCommand> profile) {
        return std::ranges::find(profile, operation, &TurtleCommand::operation) != profile.end();
    };
    return info(operation).drawn != DrawnKind::Object || operation == MeshFile ||
           std::ranges::any_of(kProfiles, has_command) ||
           std::ranges::find(kObjects, operation, &TurtleObject::operation) != kObjects.end();
}
static_assert(std::ranges::all_of(enumerators_of<TurtleOperation>(), has_name_if_object),
              "an operation that places an object has no name for #object");

bool has_polygons(TurtleProfile profile) {
    return find_turtle_command(profile, "{") != nullptr;
}

} // namespace

std::span<const TurtleCommand> turtle_commands(TurtleProfile profile) {
    const auto index = static_cast<std::size_t>(profile);
    LSYS_CHECK(index < kProfiles.size(), index);
    return kProfiles[index];
}

const TurtleCommand* find_turtle_command(TurtleProfile profile, std::string_view name) {
    for (const TurtleCommand& command : turtle_commands(profile)) {
        if (command.name == name) {
            return &command;
        }
    }
    return nullptr;
}

TurtleOperation operation_of(const TurtleCommand& command, std::uint32_t parameter_count) {
    constexpr std::uint32_t kRgb = 3;
    const bool is_rgb =
        command.operation == SetColour && command.max_parameters >= kRgb && parameter_count >= kRgb;
    return is_rgb ? SetRgb : command.operation;
}

bool is_structural(TurtleProfile profile, std::string_view name) {
    const std::string_view names = has_polygons(profile) ? "[]{}." : "[]";
    return name.size() == 1 && names.find(name) != std::string_view::npos;
}

bool takes_no_parameters(std::string_view name) {
    return name.size() == 1 && std::string_view("[]{}.|$").find(name) != std::string_view::npos;
}

SymbolKind kind_of(TurtleProfile profile, std::string_view name) {
    if (!is_structural(profile, name)) {
        return SymbolKind::Plain;
    }
    return name == "["   ? SymbolKind::BranchOpen
           : name == "]" ? SymbolKind::BranchClose
           : name == "{" ? SymbolKind::PolygonOpen
           : name == "}" ? SymbolKind::PolygonClose
                         : SymbolKind::Plain;
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
