// SPDX-License-Identifier: MIT
// Environments of kind Program, whose answers come from a program that the user names
// (docs/language.md section 13). Each sensed word is one line of JSON to its standard input,
//
//   {"generation": g, "queries": [{"position": [x, y, z], "heading": [..], "up": [..],
//     "parameters": [..]}, ...]}
//
// with a query for each module, in word order, and one line back from its standard output:
// {"answers": [[..], ...]}, with an array of numbers for each query.
#pragma once

#include "grammar/base/result.h"
#include "runtime/environment/environment.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The reason why a program has sent no line.
struct ProgramFailure {
    Stop stop = Stop::Diagnosed; // or Cancelled, OutOfMemory
    std::string text;            // the reason, such as "its program has ended with exit status 1"
    std::string messages;        // the last lines of the program's standard error
};

/// A running program that answers lines with lines. The destructor ends the program and all
/// processes that it started.
class LineProgram {
public:
    LineProgram() = default;
    virtual ~LineProgram() = default;
    LineProgram(const LineProgram&) = delete;
    LineProgram& operator=(const LineProgram&) = delete;

    /// Sends `line`, which has no line break, and waits for a line of at most `max_bytes`.
    [[nodiscard]] virtual std::optional<ProgramFailure>
    ask(const std::string& line, std::uint64_t max_bytes, std::string& answer) = 0;
    /// Ends the program and returns the last lines of its standard error.
    [[nodiscard]] virtual std::string finish() = 0;
};

/// Starts the command line `command` of a shell. `seconds`: max time of an answer.
using StartProgram = std::function<Result<std::unique_ptr<LineProgram>>(
    const std::string& command, double seconds, const std::atomic<bool>* cancelled)>;

/// A function of the host that answers in place of a program. The word has at least one place; the
/// function sets `answers` and `sizes` as Environment::answer() does.
using AnswerPlaces = std::function<std::optional<EnvironmentFailure>(
    const SensedWord& word, std::vector<float>& answers, std::vector<std::uint32_t>& sizes)>;

/// The program or function that answers for an environment of kind Program.
struct ProgramCommand {
    StartProgram start;    // empty: this system starts no programs
    std::string command;   // empty: not given
    double seconds = 60.0; // maximum time of an answer
    AnswerPlaces answer{}; // if set, this function answers, and no program is started
};

/// `declared` outlives the result.
[[nodiscard]] std::unique_ptr<Environment> make_program(const BytecodeEnvironment& declared,
                                                        ProgramCommand command,
                                                        const EnvironmentContext& context);

/// The line with the queries of a word.
[[nodiscard]] std::string query_line(const SensedWord& word);
/// Reads the answers to `count` queries from `line`. Returns what is wrong with the line, or
/// nothing.
[[nodiscard]] std::optional<std::string> read_answers(std::string_view line,
                                                      std::size_t count,
                                                      std::vector<float>& answers,
                                                      std::vector<std::uint32_t>& sizes);

/// The help text for an environment that has no command.
[[nodiscard]] std::string program_help(std::string_view name);

} // namespace lsys
