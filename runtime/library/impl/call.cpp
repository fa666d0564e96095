// SPDX-License-Identifier: MIT
#include "runtime/library/impl/call.h"

#include "grammar/base/message_levels.h"
#include "runtime/library/impl/answers.h"
#include "runtime/library/impl/message_data.h"
#include "runtime/pipeline/recorded_host.h"
#include "runtime/program/host.h"
#include "runtime/program/memory_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace lsys::v0 {

namespace {

Result<std::string> checked(FileContents contents, const ReadLimit& limit) {
    if (!contents.found) {
        return Error{contents.reason.empty() ? "no such file" : std::move(contents.reason)};
    }
    const std::uint64_t size = contents.bytes.size();
    if (size > limit.max_bytes) {
        return Error{fmt::format("it is larger than {} bytes, the maximum", limit.max_bytes)};
    }
    if (size > limit.memory) {
        return Error{fmt::format("it has {} bytes, more than Limits::max_bytes leaves", size),
                     ErrorKind::Limit};
    }
    return std::move(contents.bytes);
}

constexpr std::uint64_t kUntrustedBytes = std::uint64_t{1} << 30U; // of memory, and of files
constexpr double kUntrustedSeconds = 60.0;

Policy combined(Policy policy, const Policy& inherited) {
    if (inherited.untrusted) {
        policy.untrusted = true;
        policy.root = policy.root.empty() ? inherited.root : policy.root;
    }
    return policy;
}

std::uint64_t max_output_of(const Policy& policy) {
    if (policy.max_output != 0) {
        return policy.max_output;
    }
    return policy.untrusted ? kUntrustedBytes : std::numeric_limits<std::uint64_t>::max();
}

} // namespace

Call::Call(const Project& project, std::vector<std::string> named, const Policy& inherited)
    : policy_(combined(project.policy, inherited)), output_budget_(max_output_of(policy_)) {
    if (project.host.cancelled != nullptr) {
        cancel_flag_ = project.host.cancelled;
    }
    apply_policy(std::move(named));
    if (project.host.read_file) {
        inner_.host.read_file =
            [this, read = project.host.read_file](const std::string& path,
                                                  const ReadLimit& limit) -> Result<std::string> {
            return checked(guarded([&] { return read(path); }, FileContents{}), limit);
        };
        inner_.host.read_referenced_file = inner_.host.read_file;
        inner_.host.file_exists = [this, read = project.host.read_file](const std::string& path) {
            return guarded([&] { return read(path).found; }, false);
        };
    }
    inner_.host = record_files(std::move(inner_.host), files_);
    if (project.host.progress) {
        inner_.host.progress =
            [this, report = project.host.progress](const DerivationProgress& progress) {
                const Progress shown{progress.generation, progress.generations, progress.modules};
                if (!guarded([&] { return report(shown); }, false)) {
                    cancel_flag_->store(true);
                }
            };
    }
    for (const auto& [name, function] : project.host.environments) {
        add_environment(name, function);
    }
    inner_.host.environment_help = [](const std::string& name) {
        return fmt::format("give a function that answers it, of Host::environments; in Python "
                           "`environment={{\"{}\": function}}`",
                           name);
    };
    inner_.limits.max_modules = project.limits.max_modules;
    inner_.limits.max_bytes = project.limits.max_bytes != 0 ? project.limits.max_bytes
                              : policy_.untrusted ? std::min(half_of_memory(), kUntrustedBytes)
                                                  : half_of_memory();
    inner_.threads = project.threads;
    const auto set_levels = [&](const std::vector<std::string>& codes, MessageLevel level) {
        for (const std::string& code : codes) {
            if (std::optional<std::string> mistake = inner_.levels.set(level, code)) {
                refusal_ = std::move(mistake);
            }
        }
    };
    set_levels(project.allow, MessageLevel::Allow);
    set_levels(project.deny, MessageLevel::Deny);
}

void Call::apply_policy(std::vector<std::string> named) {
    const Policy& policy = policy_;
    if (!(policy.max_seconds >= 0.0)) {
        refusal_ = "max_seconds is neither 0, for no limit, nor a number of seconds above 0";
        return;
    }
    max_seconds_ = policy.max_seconds > 0.0 ? policy.max_seconds
                   : policy.untrusted       ? kUntrustedSeconds
                                            : 0.0;
    if (max_seconds_ > 0.0) {
        deadline_.emplace(max_seconds_, cancel_flag_, std::function<void()>());
    }
    FilePolicy& files = inner_.files;
    if (policy.untrusted) {
        files.is_untrusted = true;
        files.root = policy.root;
        files.named = std::move(named);
        files.root_option = "root";
        files.max_included_files = kUntrustedIncludedFiles;
        files.max_included_bytes = kUntrustedIncludedBytes;
    }
    inner_.host = make_file_host(cancel_flag(), files);
}

bool Call::reached_limit() const {
    return output_budget_.is_exceeded() || (deadline_ && deadline_->has_passed());
}

std::string Call::limit_text() const {
    return output_budget_.is_exceeded()
               ? fmt::format("the files are larger than {} bytes, the limit `max_output`",
                             output_budget_.max_bytes())
               : fmt::format("the call takes longer than {:g} s, the limit `max_seconds`",
                             max_seconds_);
}

void Call::add_environment(const std::string& name, EnvironmentFunction function) {
    inner_.host.environments[name] =
        [this, function = std::move(function)](
            const SensedWord& word, std::vector<float>& answers,
            std::vector<std::uint32_t>& sizes) -> std::optional<EnvironmentFailure> {
        const std::lock_guard<std::mutex> lock(answer_mutex_);
        using Given = std::optional<EnvironmentAnswers>;
        const Given given = guarded<Given>([&] { return function(query_of(word)); }, std::nullopt);
        if (!given) {
            EnvironmentFailure failure;
            failure.stop = Stop::Cancelled;
            return failure;
        }
        return take_answers(*given, word.places.size(), answers, sizes);
    };
}

void Call::check_environments(const Bytecode& bytecode) {
    for (const auto& given : inner_.host.environments) {
        const std::string& name = given.first; // clang 14 captures no structured bindings
        const bool is_declared = std::any_of(
            bytecode.environments.begin(), bytecode.environments.end(), [&](const auto& each) {
                return each.name == name && each.kind == EnvironmentKind::Program;
            });
        if (!is_declared) {
            refusal_ =
                fmt::format("a function is given for the environment `{0}`, but the grammar has no "
                            "`#sense {0} program;`",
                            name);
        }
    }
}

Messages Call::error(std::string text) {
    ::lsys::Messages messages;
    messages.add_error(std::move(text));
    return public_messages(std::move(messages));
}

Messages Call::public_messages(::lsys::Messages messages) {
    return Messages(make_message_data(std::move(messages)));
}

Status Call::public_status(Stop stop) {
    switch (stop) {
    case Stop::Diagnosed:
        return Status::Diagnosed;
    case Stop::Failed:
        return Status::Failed;
    case Stop::Limit:
        return Status::Limit;
    case Stop::OutOfMemory:
        return Status::OutOfMemory;
    case Stop::Cancelled:
        break;
    }
    return Status::Cancelled;
}

} // namespace lsys::v0
