// SPDX-License-Identifier: MIT
// Project: input that all steps of the pipeline share: the host, which reads files and shows
// progress, and the limits of a run.
#pragma once

#include "grammar/base/counted_enum.h"
#include "grammar/base/message_levels.h"
#include "grammar/base/result.h"
#include "runtime/base/limits.h"
#include "runtime/environment/program.h"
#include "runtime/pipeline/file_policy.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace lsys {

/// Progress of a derivation.
struct DerivationProgress {
    std::uint32_t generation = 0;  // generation being derived
    std::uint32_t generations = 0; // number of generations to derive
    std::uint64_t modules = 0;     // modules of `generation` written so far
    /// Expected number of modules per generation from 0 on; empty if unknown.
    const std::vector<double>& expected;
};

/// The steps of the pipeline that may take long.
LSYS_COUNTED_ENUM(LongStep,
                  Read,         // read and compile files
                  Derive,       // derive a plant
                  Draw,         // make the skeleton of a plant
                  Mesh,         // make meshes of a plant or of heroes
                  ChooseHeroes, // find the number of heroes for a goal of a scene
                  GrowHeroes,   // derive and draw the heroes of a forest
                  Place         // place the trees of a forest
);

/// Limits of reading a file.
struct ReadLimit {
    std::uint64_t max_bytes = 0;              // max size of a file of this kind
    std::uint64_t memory = ~std::uint64_t{0}; // free bytes; ErrorKind::Limit for a larger file
};

/// Services of the program that calls the pipeline. The functions may be called from any thread,
/// but never from two at once.
struct Host {
    /// Reads a file that the user names, which may be a pipe. The Error is only the reason: "no
    /// such file or directory".
    std::function<Result<std::string>(const std::string& path, const ReadLimit& limit)> read_file;
    /// Reads a file that another file names. Refuses pipes, so that the program never blocks.
    std::function<Result<std::string>(const std::string& path, const ReadLimit& limit)>
        read_referenced_file;
    std::function<bool(const std::string& path)> file_exists;
    /// Names of the files of a folder, sorted. May be empty.
    std::function<std::vector<std::string>(const std::string& folder)> list_folder{};
    /// A flag that the caller sets to true to stop the call; may be null.
    const std::atomic<bool>* cancelled = nullptr;
    /// Reports progress. May be empty.
    std::function<void(const DerivationProgress& progress)> progress;
    /// Starts the programs of `--environment`. Empty: none can be started.
    StartProgram start_program;
    /// Functions that answer environments of kind Program, by name, in place of programs.
    std::map<std::string, AnswerPlaces, std::less<>> environments{};
    /// The help for an environment of kind Program that nothing answers. Empty: the option
    /// `--environment`.
    std::function<std::string(const std::string& name)> environment_help{};
    /// Reports that a step begins. May be empty.
    std::function<void(LongStep step)> step_begins;
};

/// The program that answers an environment of kind Program: `--environment NAME=COMMAND`.
struct EnvironmentCommand {
    std::string name;    // name of the environment, without the `?`
    std::string command; // a command line of the shell

    friend bool operator==(const EnvironmentCommand&, const EnvironmentCommand&) = default;
};

struct Project {
    Host host;
    Limits limits;             // max modules per word; max bytes per word, skeleton, mesh and file
    std::uint32_t threads = 0; // 0: as many as the machine has
    MessageLevels levels;      // levels of diagnostics, from --allow, --warn and --deny
    std::vector<EnvironmentCommand> environments{};
    FilePolicy files{};           // the host refuses files that it forbids
    double answer_seconds = 60.0; // max time of an answer of a program of `environments`

    [[nodiscard]] bool is_cancelled() const {
        return host.cancelled != nullptr && host.cancelled->load(std::memory_order_relaxed);
    }
    /// Reports to the host that a step begins.
    void begin(LongStep step) const {
        if (host.step_begins) {
            host.step_begins(step);
        }
    }
};

} // namespace lsys
