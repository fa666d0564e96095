// SPDX-License-Identifier: MIT
#include "runtime/pipeline/senses.h"

#include "grammar/base/paths.h"
#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/pipeline/impl/environment_files.h"
#include "runtime/pipeline/impl/object_sizes.h"
#include "runtime/pipeline/step.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

namespace lsys {

namespace {

/// The function or command that answers an environment of kind Program, or none.
ProgramCommand command_of(const BytecodeEnvironment& environment, const Project& project) {
    const auto given =
        std::find_if(project.environments.begin(), project.environments.end(),
                     [&](const EnvironmentCommand& each) { return each.name == environment.name; });
    const auto function = project.host.environments.find(environment.name);
    return {project.host.start_program,
            given == project.environments.end() ? std::string() : given->command,
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
    SenseOptions own = options;
    own.files = &files;
    return std::make_unique<EnvironmentSense>(bytecode, std::move(own));
}

Outcome<PlantSenses>
read_senses(const std::string& grammar_file, const Grammar& grammar, const Project& project) {
    Step step(project);
    PlantSenses senses;
    const Bytecode& bytecode = grammar.bytecode;
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
    if (!step.take(read_environment_files(folder, grammar, project, budget), senses.files)) {
        return step.end();
    }
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

} // namespace lsys
