// SPDX-License-Identifier: MIT
// Call runs one public function: it converts the caller's project to a project of the pipeline, and
// the outcome of the pipeline to a public outcome.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "grammar/base/outcome.h"
#include "runtime/base/deadline.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/pipeline/project.h"
#include "runtime/program/output_budget.h"

#include <atomic>
#include <exception>
#include <lsys/outcome.h>
#include <lsys/project.h>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys::v0 {

class Call {
public:
    /// `named`: the files that the caller names, see FilePolicy. `inherited`: the policy with which
    /// the grammar or forest of the call was read: what was not trusted then is not trusted now.
    Call(const Project& project, std::vector<std::string> named, const Policy& inherited);
    ~Call() = default;
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    [[nodiscard]] ::lsys::Project& project() { return inner_; }
    /// The flag that is set to true to end the call.
    [[nodiscard]] const std::atomic<bool>* cancel_flag() const {
        return deadline_ ? deadline_->stop() : cancel_flag_;
    }
    [[nodiscard]] const Policy& policy() const { return policy_; }
    /// The paths of the files that the call has requested so far.
    [[nodiscard]] const std::vector<std::string>& files() const { return files_; }
    /// The bytes that the call may still write into files.
    [[nodiscard]] OutputBudget& output_budget() { return output_budget_; }

    /// Makes a public outcome. `work` returns an outcome of the pipeline, and `make` converts its
    /// value to a public value. Rethrows an exception that a function of the host has thrown.
    template <typename T, typename Work, typename Make>
    [[nodiscard]] Outcome<T> run(const Work& work, const Make& make) {
        const auto make_outcome = [&]() -> Outcome<T> {
            if (refusal_) {
                return {Status::Failed, error(*refusal_)};
            }
            auto outcome = work();
            throw_caught();
            const bool is_over = !outcome && reached_limit();
            if (is_over) {
                outcome.messages().add_error(limit_text());
            }
            Messages messages = public_messages(std::move(outcome.messages()));
            if (is_over) {
                return {Status::Limit, std::move(messages)};
            }
            if (!outcome) {
                return {public_status(outcome.stop()), std::move(messages)};
            }
            return {make(std::move(outcome.value())), std::move(messages)};
        };
        return catch_out_of_memory(make_outcome, [&]() -> Outcome<T> {
            throw_caught();
            return {Status::OutOfMemory, error("there is not enough memory")};
        });
    }

    /// A sink for an export that calls `write`, with exceptions handled by guarded().
    template <typename Write>
    [[nodiscard]] auto guarded_sink(Write write) {
        return [this, write = std::move(write)](const auto& piece) {
            return guarded([&] { return write(piece); }, false);
        };
    }

    /// Makes run() fail if a function of the host answers an environment that `bytecode` does not
    /// declare with the kind `program`.
    void check_environments(const Bytecode& bytecode);

private:
    void apply_policy(std::vector<std::string> named);
    /// Makes a function of the host answer for an environment.
    void add_environment(const std::string& name, EnvironmentFunction function);
    /// Whether a limit of Policy has ended the call.
    [[nodiscard]] bool reached_limit() const;
    [[nodiscard]] std::string limit_text() const;
    [[nodiscard]] static Messages error(std::string text);
    [[nodiscard]] static Messages public_messages(::lsys::Messages messages);
    [[nodiscard]] static Status public_status(Stop stop);

    /// Calls `function`; if it throws, stores the exception, cancels the call and returns
    /// `otherwise`.
    template <typename T, typename Function>
    [[nodiscard]] T guarded(const Function& function, T otherwise) {
        try {
            return function();
        } catch (...) {
            caught_ = std::current_exception();
            cancel_flag_->store(true);
            return otherwise;
        }
    }
    /// Rethrows the exception that guarded() has stored, if any.
    void throw_caught() const {
        if (caught_) {
            std::rethrow_exception(caught_);
        }
    }

    ::lsys::Project inner_;
    std::vector<std::string> files_; // that the call has requested
    /// Error if Project::allow or Project::deny has an unknown code of a diagnostic, or the host
    /// answers for an environment that the grammar lacks.
    std::optional<std::string> refusal_;
    std::mutex answer_mutex_; // functions of the host are called one at a time
    std::atomic<bool> own_cancel_flag_{false};
    std::atomic<bool>* cancel_flag_ = &own_cancel_flag_; // or Host::cancelled
    std::exception_ptr caught_;                          // thrown by a function of the host
    Policy policy_;                                      // of the project, with `inherited`
    double max_seconds_ = 0.0;
    OutputBudget output_budget_;
    std::optional<Deadline> deadline_; // declared last: it reads the flags above
};

} // namespace lsys::v0
