// SPDX-License-Identifier: MIT
// The state of a SensingTurtle. The loop over the modules of a word is in sensing_turtle.cpp, the
// operations are in sensing_operations.cpp.
#pragma once

#include "runtime/base/exact_functions.h"
#include "runtime/derive/interpretation.h"
#include "runtime/turtle/impl/actions.h"
#include "runtime/turtle/impl/sensing_polygons.h"
#include "runtime/turtle/impl/sensing_pose.h"
#include "runtime/turtle/impl/text_commands.h"
#include "runtime/turtle/impl/tropisms.h"
#include "runtime/turtle/sensing_turtle.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lsys {

enum class SensingStep : std::uint8_t {
    NoEffect,
    Yaw, // Yaw, Pitch and Roll: by a constant angle
    Pitch,
    Roll,
    Forward, // a move without tropism
    Save,
    Restore,
    Sense,
    Other, // State::execute()
};

/// A code of a word with its constants.
struct SensingAction {
    SensingStep step = SensingStep::Other;
    std::uint8_t argument_count = 0;  // number of arguments
    std::uint32_t stored = 0;         // number of parameters in the word
    const float* constants = nullptr; // arguments, if the word stores none
    ExactSineCosine turn;             // the constant angle of a turn; signed
};

/// The state that `[` saves.
struct SensingBrush {
    SensingPose pose;
    double step = 0.0;           // m, length of an F without argument
    double angle = 0.0;          // degrees
    double width = 0.0;          // m, or radius / length (TurtleTraits::width_is_relative)
    ExactSineCosine turn;        // of `angle`
    double second_heading = 0.0; // degrees from the first heading to the left
};

/// The last command read from a word of L3D, executed when the text of its parameter is complete.
struct PendingSensing : TextCommand {
    Code code = 0;
    std::uint8_t argument_count = 0;
    std::array<float, kTurtleArguments> arguments{};
};

struct SensingTurtle::State {
    State(const Bytecode& program, SensingOptions wanted);

    /// Puts the turtle at the start, without open branches and polygons.
    void begin();
    std::optional<Stop> walk(const Word& word, std::uint32_t age); // executes a whole word
    /// walk() of a program without productions of `#interpret`.
    template <typename C>
    std::optional<Stop> walk_plain(std::span<const C> codes, const float* parameters);
    /// walk() of a program with productions of `#interpret`.
    template <typename C>
    std::optional<Stop> walk_interpreted(std::span<const C> codes, const Word& word);
    /// Executes modules. `origins`: for modules written by `#interpret`; Origin::place is then the
    /// index of the interpreted module in its piece of the word. Null for modules of the word
    /// itself. Returns false after a Stop.
    template <typename C>
    bool run(std::span<const C> codes, const float* parameters, const Origin* origins);
    /// run() for a word of L3D.
    template <typename C>
    bool run_text(std::span<const C> codes, const float* parameters, const Origin* origins);
    /// Executes an action for which run() has no case of its own (SensingStep::Other). Returns
    /// false after a Stop.
    bool execute(const Action& action, std::uint8_t argument_count, const float* arguments);
    bool take_character(Code code, const float* arguments); // reads a module of a word of L3D
    bool execute_pending();                                 // executes the waiting command of L3D

    /// Reports the waiting sense modules up to index `index` of the piece.
    void report_up_to(std::uint64_t index);
    void forward(double length, bool adds_corners); // draws a segment, which first bends
    void move(double length, bool adds_corners);    // moves without drawing
    /// Moves along the second heading; the frame stays unchanged.
    void move_secondary(const Action& action, std::uint8_t argument_count, const float* arguments);
    void turn_by(std::uint8_t argument_count, const float* arguments); // pitches, rolls and yaws
    void turn_left(double degrees);
    /// Turns by half of a full turn, rounded down to whole steps of the current angle.
    void half_turn_snapped();
    void set_angle(double angle);
    /// Reports an object at the place of the turtle to `sink`.
    void place(const Action& action, std::uint8_t argument_count, const float* arguments);
    bool save();    // `[`
    bool restore(); // `]`
    bool close_polygon();
    bool stop_unbalanced(); // stops with the error of an unmatched bracket
    bool stop(Stop why) {
        stopped = why;
        return false;
    }

    const Bytecode& bytecode;
    SensingOptions options;
    ActionTable table;
    std::vector<SensingAction> actions; // by code
    std::vector<double> areas;          // by code: m^2, of an object of size 1
    SensingBrush now;                   // state at the module being executed
    std::vector<SensingBrush> stack;    // states saved by the open `[`, the innermost last
    SensingPolygons polygons;
    Tropisms tropisms;
    std::vector<SenseModule> waiting; // sense modules of the piece being interpreted
    std::size_t reported = 0;         // number of modules in `waiting` that have been reported
    PendingSensing pending;
    SenseSink* sink = nullptr;
    std::uint32_t age = 0; // of the word
    /// Index of the next module; after an error, index of the faulty module in the word.
    std::uint64_t position = 0;
    Code code = 0;                       // of the current module
    std::uint64_t walked_parameters = 0; // parameters of the modules before the current piece
    std::uint64_t first_of_piece = 0;    // index in the word of the piece that is interpreted
    std::optional<Stop> stopped;         // why a module ended the walk, if one did
    RuntimeError error;
    bool interprets = false; // the program has productions of #interpret
    bool has_second_heading = false;
};

} // namespace lsys
