// SPDX-License-Identifier: MIT
#include "runtime/pipeline/senses.h"

#include "grammar/base/paths.h"
#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/pipeline/impl/environment_files.h"
#include "runtime/pipeline/impl/object_sizes.h"
#include "runtime/pipeline/step.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

namespace lsys {

namespace {

/// The function or command that answers an environment of kind Program, or none.
ProgramCommand command_of(const BytecodeEnvironment& environment, const Project& project) {
    const auto command =
        std::find_if(project.environments.begin(), project.environments.end(),
                     [&](const EnvironmentCommand& each) { return each.name == environment.name; });
    const auto function = project.host.environments.find(environment.name);
    return {project.host.start_program,
            command == project.environments.end() ? std::string() : command->command,
            project.answer_seconds,
            function == project.host.environments.end() ? AnswerPlaces() : function->second};
}

/// The error of an environment of kind Program that nothing answers.
Diagnostic no_program(std::uint32_t index, const Grammar& grammar, const Host& host) {
    RuntimeError error;
    error.kind = RuntimeErrorKind::SenseFailed;
    error.environment = index;
    error.site = grammar.bytecode.environments[index].site;
    const std::string& name = grammar.bytecode.environments[index].name;
    if (host.environment_help) {
        error.text = "nothing is given that answers it";
        error.help = host.environment_help(name);
    } else {
        error.text = "no program is given that answers it";
        error.help = program_help(name);
    }
    return runtime_diagnostic(error, grammar.bytecode, !grammar.is_module_file);
}

} // namespace

std::unique_ptr<EnvironmentSense> PlantSenses::make(const Bytecode& bytecode) const {
    if (!bytecode.has_senses()) {
        return nullptr;
    }
    SenseOptions with_files = options;
    with_files.files = &files;
    return std::make_unique<EnvironmentSense>(bytecode, std::move(with_files));
}

Outcome<PlantSenses>
read_senses(const std::string& grammar_file, const Grammar& grammar, const Project& project) {
    Step step(project);
    PlantSenses senses;
    const Bytecode& bytecode = grammar.bytecode;
    if (const Result<void> known = check_commands(project.environments, program_names(bytecode));
        !known) {
        return step.fail(known.error());
    }
    if (bytecode.environments.empty() && !bytecode.has_senses()) {
        return step.done(std::move(senses));
    }
    senses.options.threads = project.threads;
    senses.options.max_bytes = project.limits.max_bytes;
    senses.options.cancelled = project.host.cancelled;
    bool ok = true;
    for (std::uint32_t i = 0; i < bytecode.environments.size(); ++i) {
        ProgramCommand command = command_of(bytecode.environments[i], project);
        if (bytecode.environments[i].kind == EnvironmentKind::Program && command.command.empty() &&
            !command.answer) {
            ok = step.diagnose(no_program(i, grammar, project.host), grammar.sources) && ok;
        }
        senses.options.programs.push_back(std::move(command));
    }
    if (!ok) {
        return step.end(Stop::Diagnosed);
    }
    const std::filesystem::path folder = path_of(grammar_file).parent_path();
    FileBudget budget{project.limits.max_bytes};
    Diagnostics diagnostics;
    std::optional<std::vector<EnvironmentFiles>> files =
        read_environment_files(folder, grammar, project, budget, diagnostics);
    if (!step.diagnose(std::move(diagnostics), grammar.sources) || !files) {
        return step.end_diagnosed();
    }
    senses.files = std::move(*files);
    const bool has_sky =
        std::any_of(bytecode.environments.begin(), bytecode.environments.end(),
                    [](const auto& each) { return each.kind == EnvironmentKind::Sky; });
    if (bytecode.has_senses() &&
        !step.take(read_object_sizes(folder, bytecode, has_sky, project, budget),
                   senses.options.objects)) {
        return step.end();
    }
    return step.done(std::move(senses));
}

void check_environment_files(const std::string& grammar_file,
                             const Grammar& grammar,
                             const Project& project,
                             Diagnostics& diagnostics) {
    FileBudget budget{project.limits.max_bytes};
    static_cast<void>(read_environment_files(path_of(grammar_file).parent_path(), grammar, project,
                                             budget, diagnostics));
}

std::vector<std::string> program_names(const Bytecode& bytecode) {
    std::vector<std::string> names;
    for (const BytecodeEnvironment& environment : bytecode.environments) {
        if (environment.kind == EnvironmentKind::Program) {
            names.push_back(environment.name);
        }
    }
    return names;
}

Result<void> check_commands(const std::vector<EnvironmentCommand>& commands,
                            const std::vector<std::string>& names) {
    for (const EnvironmentCommand& command : commands) {
        if (std::find(names.begin(), names.end(), command.name) != names.end()) {
            continue;
        }
        std::string known;
        for (const std::string& name : names) {
            known += fmt::format("{}`{}`", known.empty() ? "" : ", ", name);
        }
        return Error{fmt::format("--environment {}: the grammar has no `#sense {} program`; {}",
                                 command.name, command.name,
                                 known.empty() ? "no program answers any environment of it"
                                               : "programs answer " + known)};
    }
    return {};
}

} // namespace lsys
