// SPDX-License-Identifier: MIT
// PlantSenses: the inputs of the sense modules of a grammar (docs/language.md section 13): the
// meshes and pictures that its environments name, the sizes of its objects, and the programs that
// answer. Read once per grammar; each derivation then has an EnvironmentSense of its own.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/environment/word_sense.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/project.h"

#include <memory>
#include <string>
#include <vector>

namespace lsys {

struct PlantSenses {
    std::vector<EnvironmentFiles> files; // by index in Bytecode::environments
    SenseOptions options;                // SenseOptions::files is not set

    /// Makes the EnvironmentSense of a derivation with `bytecode`; null if the bytecode has no
    /// sense modules. This object and the bytecode must outlive the result.
    [[nodiscard]] std::unique_ptr<EnvironmentSense> make(const Bytecode& bytecode) const;
};

/// Reads the files of the environments, whose paths are absolute or relative to `grammar_file`.
/// Stop::Diagnosed: a file is missing or unusable, or no program is given for an environment of
/// kind Program. Stop::Failed: a command of the project is for an environment that the grammar does
/// not declare.
[[nodiscard]] Outcome<PlantSenses>
read_senses(const std::string& grammar_file, const Grammar& grammar, const Project& project);

/// Reads the files of the environments like read_senses(), and reports those that are missing or
/// unusable.
void check_environment_files(const std::string& grammar_file,
                             const Grammar& grammar,
                             const Project& project,
                             Diagnostics& diagnostics);

/// The names of the environments of kind Program.
[[nodiscard]] std::vector<std::string> program_names(const Bytecode& bytecode);
/// The error of a command for an environment that is none of `names`, those of kind Program.
[[nodiscard]] Result<void> check_commands(const std::vector<EnvironmentCommand>& commands,
                                          const std::vector<std::string>& names);

} // namespace lsys
