// Commands that documents show: read as a shell does, run in-process.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::tests {

/// The words of a command line: '...' and "..." keep blanks, a word that begins with # ends it.
[[nodiscard]] std::vector<std::string> words_of(std::string_view command);

/// A command of a block `console`, and what the terminal shows for it.
struct SessionStep {
    std::size_t line = 0; // within the block, from 0
    std::string command;
    std::vector<std::string> output;
};
/// Lines that begin with "$ " are commands; one that ends with \ goes on in the next line.
[[nodiscard]] std::vector<SessionStep> steps_of(const std::vector<std::string>& lines);

/// The shell of a document: its commands run one after the other in a folder of its own, in which
/// `samples` is that of the project.
class Session {
public:
    explicit Session(std::filesystem::path folder);
    /// A message that begins with the command, or an empty one.
    [[nodiscard]] std::string run(const SessionStep& step);
    /// The same at the end of the document.
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

/// What is wrong with the options of `lsc ...` or `lsview ...`, which does not run; empty: nothing.
/// Commands of other programs are fine.
[[nodiscard]] std::string check_options(const std::vector<std::string>& words);

/// Whether a terminal shows `output` where a document shows `expected`: a line `...` stands for any
/// lines.
[[nodiscard]] bool shows(const std::vector<std::string>& expected,
                         const std::vector<std::string>& output);

} // namespace lsys::tests
