// SPDX-License-Identifier: MIT
// Step: a pipeline call in progress. Collects the messages of the call and makes its Outcome.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/pipeline/project.h"

#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace lsys {

class Step {
public:
    explicit Step(const Project& project) : project_(project) {}

    [[nodiscard]] const Project& project() const { return project_; }

    /// Reads a file that the user names, with Host::read_file. The Error names the file.
    [[nodiscard]] Result<std::string> read(const std::string& path, const ReadLimit& limit) const;
    /// Reads a file that another file names, with Host::read_referenced_file. The Error names the
    /// file.
    [[nodiscard]] Result<std::string> read_referenced(const std::string& path,
                                                      const ReadLimit& limit) const;

    /// Applies the levels of the project to the diagnostics and adds them to the messages. Returns
    /// whether the step may continue, because none of them is an error.
    bool diagnose(Diagnostics diagnostics, std::shared_ptr<const SourceMap> sources);
    bool diagnose(Diagnostic diagnostic, std::shared_ptr<const SourceMap> sources);
    /// Moves messages and value out of the outcome of an inner step. Returns whether there is a
    /// value.
    template <typename T>
    [[nodiscard]] bool take(Outcome<T> outcome, T& value) {
        messages.append(std::move(outcome.messages()));
        if (!outcome) {
            stop_ = outcome.stop();
            return false;
        }
        value = std::move(outcome.value());
        return true;
    }
    /// Overload for a step without a value.
    [[nodiscard]] bool take(Outcome<void> outcome) {
        messages.append(std::move(outcome.messages()));
        if (!outcome) {
            stop_ = outcome.stop();
        }
        return outcome.ok();
    }

    /// Ends the step: done() with a value, end(stop) without one, end() with the stop of the
    /// inner step for which take() returned false.
    template <typename T>
    [[nodiscard]] Outcome<T> done(T value) {
        return {std::move(value), std::move(messages)};
    }
    [[nodiscard]] Outcome<void> done() { return {std::move(messages)}; }

    /// An end without value; converts to any Outcome.
    struct Ended {
        Stop stop;
        Messages messages;

        template <typename T>
        operator Outcome<T>() {
            return {stop, std::move(messages)};
        }
    };
    [[nodiscard]] Ended end(Stop stop) { return {stop, std::move(messages)}; }
    [[nodiscard]] Ended end() { return end(stop_); }
    /// Ends with Stop::Limit if a diagnostic is about a limit, else with Stop::Diagnosed.
    [[nodiscard]] Ended end_diagnosed();
    /// Ends with Stop::Limit or Stop::OutOfMemory, because `what` ("the mesh") exceeds
    /// `limits.max_bytes` of the project (Stop::Limit) or the memory of the machine.
    [[nodiscard]] Ended end_too_large(Stop stop, std::string_view what);
    /// Ends with Stop::Failed, with Stop::Limit for ErrorKind::Limit, or with Stop::Cancelled if
    /// the host has cancelled the step.
    [[nodiscard]] Ended fail(Error error);
    [[nodiscard]] Ended fail(std::string message) { return fail(Error{std::move(message)}); }

    Messages messages;

private:
    const Project& project_;
    Stop stop_ = Stop::Failed; // stop of the last inner step for which take() returned false
};

} // namespace lsys
