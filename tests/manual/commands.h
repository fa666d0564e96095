// SPDX-License-Identifier: MIT
// Commands in documents: parsed as by a shell, run in-process.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::tests {

/// The words of a command line: '...' and "..." keep blanks; a word that begins with # begins a
/// comment.
[[nodiscard]] std::vector<std::string> words_of(std::string_view command);

/// A command of a `console` block and its output.
struct SessionStep {
    std::size_t line = 0; // within the block, from 0
    std::string command;
    std::vector<std::string> output;
};
/// Lines that begin with "$ " are commands; a line that ends with \ continues on the next.
[[nodiscard]] std::vector<SessionStep> steps_of(const std::vector<std::string>& lines);

/// The shell of a document: the commands of the document run one after the other in a folder that
/// contains the `samples` of the project.
class Session {
public:
    explicit Session(std::filesystem::path folder);
    /// Runs a command. Returns a message that begins with the command, or empty if its output is as
    /// expected.
    [[nodiscard]] std::string run(const SessionStep& step);
    /// Call after the last command. Returns a message if the last command failed and no `$ echo $?`
    /// followed it, else an empty text.
    [[nodiscard]] std::string finish() const;

    struct Result {
        int status = 0;
        std::string output; // both streams, in the order in which they are written
    };
    /// Runs lsc in the folder.
    [[nodiscard]] Result result_of(const std::vector<std::string>& arguments) const;

private:
    [[nodiscard]] std::string show_file(const SessionStep& step, const std::string& name) const;
    [[nodiscard]] std::string run_lsc(const SessionStep& step,
                                      const std::vector<std::string>& arguments);

    std::filesystem::path folder_;
    int status_ = 0; // of the last command
    std::string last_;
};

/// Checks the options of `lsc ...` or `lsview ...` without running it. Returns a message; empty for
/// correct options and for other programs.
[[nodiscard]] std::string check_options(const std::vector<std::string>& words);

/// Whether `expected` of a document matches `output`; a line `...` matches any lines.
[[nodiscard]] bool matches_output(const std::vector<std::string>& expected,
                                  const std::vector<std::string>& output);

} // namespace lsys::tests
