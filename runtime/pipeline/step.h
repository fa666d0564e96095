// Step: a call of the pipeline in progress: collects its messages and makes its Outcome.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/pipeline/project.h"

#include <memory>
#include <string>
#include <utility>

namespace lsys {

class Step {
public:
    explicit Step(const Project& project) : project_(project) {}

    [[nodiscard]] const Project& project() const { return project_; }

    /// A file that the user names; its Error names the file.
    [[nodiscard]] Result<std::string> read(const std::string& path, const ReadLimit& limit) const;
    /// A file that another file names; its Error names the file.
    [[nodiscard]] Result<std::string> read_named(const std::string& path,
                                                 const ReadLimit& limit) const;

    /// Adds diagnostics, warnings as errors where the project denies them; returns whether the
    /// step may go on.
    bool diagnose(Diagnostics diagnostics, std::shared_ptr<const SourceMap> sources);
    bool diagnose(Diagnostic diagnostic, std::shared_ptr<const SourceMap> sources);
    /// Takes over the value of a step within this one; returns whether there is one.
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

    /// The end of a step whose value is `value`, without value, or as the step within it that
    /// take() found ended.
    template <typename T>
    [[nodiscard]] Outcome<T> done(T value) {
        return {std::move(value), std::move(messages)};
    }

    /// Converts to the Outcome of any type.
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
    /// Limit where a diagnostic says so, else Diagnosed.
    [[nodiscard]] Ended end_diagnosed();
    /// A failure of the environment, or a limit of memory; Cancelled where the host has cancelled
    /// the step.
    [[nodiscard]] Ended fail(Error error);
    [[nodiscard]] Ended fail(std::string message) { return fail(Error{std::move(message)}); }

    Messages messages;

private:
    const Project& project_;
    Stop stop_ = Stop::Failed;
};

} // namespace lsys
