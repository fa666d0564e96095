// SPDX-License-Identifier: MIT
#include "runtime/program/environment_program.h"

#include "runtime/platform/shell_program.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <system_error>
#include <utility>

namespace lsys {

namespace {

/// The last lines of the output of a program, without control characters.
std::string last_lines(std::string_view text) {
    constexpr std::size_t kMaxLines = 5;
    constexpr std::string_view kBlank = " \t\r\n";
    const std::size_t last = text.find_last_not_of(kBlank);
    text = text.substr(0, last == std::string_view::npos ? 0 : last + 1);
    std::size_t begin = text.size();
    for (std::size_t lines = 0; begin > 0 && (text[begin - 1] != '\n' || ++lines < kMaxLines);) {
        --begin;
    }
    std::string shown;
    for (const char character : text.substr(begin)) {
        const auto byte = static_cast<unsigned char>(character);
        const bool is_control = (byte < 0x20 && character != '\n') || byte == 0x7F;
        shown += is_control ? ' ' : character;
    }
    return shown;
}

class EnvironmentProgram final : public LineProgram {
public:
    EnvironmentProgram(double seconds, const std::atomic<bool>* cancelled)
        : seconds_(seconds), cancelled_(cancelled) {}

    /// Returns 0, or the reason for which the system did not start the program.
    int start(const std::string& command) { return program_.start(command); }

    std::optional<ProgramFailure>
    ask(const std::string& line, std::uint64_t max_bytes, std::string& answer) override {
        using Reply = platform::ShellProgram::Reply;
        ProgramFailure failure;
        switch (program_.ask(line, seconds_, max_bytes, cancelled_, answer)) {
        case Reply::Line:
            return std::nullopt;
        case Reply::Ended:
            failure.text = program_.exit_text().empty()
                               ? "its program has closed its output without an answer"
                               : fmt::format("its program has ended without an answer ({})",
                                             program_.exit_text());
            break;
        case Reply::TimedOut:
            failure.text = fmt::format("its program has not answered in {} seconds", seconds_);
            break;
        case Reply::TooLong:
            failure.text = fmt::format("its program sent a line of more than {} bytes", max_bytes);
            break;
        case Reply::Cancelled:
            failure.stop = Stop::Cancelled;
            break;
        case Reply::Failed:
            failure.text = "the connection to its program is broken";
            break;
        }
        failure.messages = last_lines(program_.messages());
        return failure;
    }

    std::string finish() override {
        program_.finish();
        return last_lines(program_.messages());
    }

private:
    platform::ShellProgram program_;
    double seconds_ = 0.0; // max time of an answer
    const std::atomic<bool>* cancelled_ = nullptr;
};

} // namespace

Result<std::unique_ptr<LineProgram>> start_environment_program(const std::string& command,
                                                               double seconds,
                                                               const std::atomic<bool>* cancelled) {
    auto program = std::make_unique<EnvironmentProgram>(seconds, cancelled);
    if (const int reason = program->start(command); reason != 0) {
        return Error{std::generic_category().message(reason)};
    }
    return std::unique_ptr<LineProgram>(std::move(program));
}

} // namespace lsys
