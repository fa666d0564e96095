// SPDX-License-Identifier: MIT
// Commands in documents: read as a shell reads them, and run in-process.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::tests {

/// The words of a command line. Quotes '...' and "..." keep blanks; a word that begins with #
/// begins a comment.
[[nodiscard]] std::vector<std::string> words_of(std::string_view command);

/// A command of a `console` block and its output.
struct SessionStep {
    std::size_t line = 0; // within the block, from 0
    std::string command;
    std::vector<std::string> output;
};
/// The steps of a `console` block. Lines that begin with "$ " are commands; a command whose line
/// ends with a backslash continues on the next line.
[[nodiscard]] std::vector<SessionStep> steps_of(const std::vector<std::string>& lines);

/// The shell of a document. Commands of the document run one after the other in a folder that
/// contains the `samples` of the project.
class Session {
public:
    explicit Session(std::filesystem::path folder);
    /// Runs a command. Returns an empty text if the output is as expected, else a message that
    /// begins with the command.
    [[nodiscard]] std::string run(const SessionStep& step);
    /// Call it after the last command. If the last command failed and no `$ echo $?` followed,
    /// returns a message, else an empty text.
    [[nodiscard]] std::string finish() const;

    struct Result {
        int status = 0;
        std::string output; // both streams, in the order of writing
    };
    /// Runs lsc in the folder.
    [[nodiscard]] Result result_of(const std::vector<std::string>& arguments) const;

private:
    /// Runs `cat`: writes a file that is missing; an existing file must have the text that is
    /// shown.
    [[nodiscard]] std::string show_file(const SessionStep& step, const std::string& name) const;
    /// Runs lsc and compares its output with that of the step.
    [[nodiscard]] std::string run_lsc(const SessionStep& step,
                                      const std::vector<std::string>& arguments);

    std::filesystem::path folder_;
    int status_ = 0;   // exit status of the last command
    std::string last_; // the last command, for messages
};

/// Checks the options of `lsc ...` or `lsview ...` without running the program. Returns a message;
/// empty if the options are correct, or for other programs.
[[nodiscard]] std::string check_options(const std::vector<std::string>& words);

/// Whether `output` is as a document expects. A line `...` in `expected` matches any number of
/// lines.
[[nodiscard]] bool matches_output(const std::vector<std::string>& expected,
                                  const std::vector<std::string>& output);

} // namespace lsys::tests
