// SPDX-License-Identifier: MIT
// EnvironmentSense: answers the sense modules of words (docs/language.md section 13). Runs a
// SensingTurtle over a word, gives each environment all places of its modules, and writes the
// answers of the environments and the answers to `?P ?H ?U ?R ?L` into the parameters of the word.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/base/workers.h"
#include "runtime/derive/derive.h"
#include "runtime/environment/environment.h"
#include "runtime/environment/program.h"
#include "runtime/turtle/sensing_turtle.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

struct Neighbours;

struct SenseOptions {
    /// Contents of files, by index in Bytecode::environments. Outlives the object.
    const std::vector<EnvironmentFiles>* files = nullptr;
    /// Programs of environments of kind Program, by index in Bytecode::environments.
    std::vector<ProgramCommand> programs;
    /// Lengths and areas of objects; EnvironmentSense sets the other members.
    SensingOptions objects;
    /// Plants that shade the sensing plant (neighbours.h); null: none. Outlives the object.
    const Neighbours* neighbours = nullptr;
    std::uint32_t threads = 0; // 0: as many as the machine has
    /// Max bytes of places, answers and environments together.
    std::uint64_t max_bytes = ~std::uint64_t{0};
    const std::atomic<bool>* cancelled = nullptr; // becomes true to cancel; null: never
};

/// The places of an environment in a word, and its answers.
struct SensedEnvironment {
    std::vector<SenseModule> modules; // sense modules in word order
    std::vector<SensePlace> places;   // the places of `modules`
    std::vector<float> answers;       // answers to `modules`, one after the other
    std::vector<std::uint32_t> sizes; // numbers of each answer, if the kind has no fixed number
};

class EnvironmentSense final : public WordSense {
public:
    /// `bytecode`, that of the derivation, outlives the object.
    EnvironmentSense(const Bytecode& bytecode, SenseOptions options);
    ~EnvironmentSense() override;

    [[nodiscard]] std::optional<Stop> begin(std::uint64_t seed,
                                            std::uint32_t generations,
                                            std::span<const float> globals,
                                            DerivationEnd& end) override;
    [[nodiscard]] std::optional<Stop>
    sense(Word& word, std::uint32_t age, DerivationEnd& end) override;
    [[nodiscard]] std::string state() const override;
    [[nodiscard]] bool restore(std::string_view state) override;

    /// Places and answers of the last word that sensed, by index in Bytecode::environments. Empty
    /// before the first such word.
    [[nodiscard]] const std::vector<SensedEnvironment>& sensed() const { return sensed_; }
    /// Organs of that word.
    [[nodiscard]] const std::vector<SensedOrgan>& organs() const { return organs_; }
    /// The environment number `index`, after begin().
    [[nodiscard]] const Environment& environment(std::size_t index) const {
        return *environments_[index];
    }
    [[nodiscard]] std::uint32_t age() const { return age_; } // age of the last sensed word

private:
    class Sink;

    /// Asks environment `index` for its answers, and stores them in sensed_.
    [[nodiscard]] std::optional<Stop>
    ask(std::size_t index, Word& word, std::uint32_t age, DerivationEnd& end);
    /// Writes the answers into the first parameters of the modules.
    [[nodiscard]] std::optional<Stop>
    write_answers(std::size_t index, Word& word, std::uint32_t age, DerivationEnd& end) const;
    /// Sets `end` to a failure of environment `index`. `word`: null before the first word.
    [[nodiscard]] std::optional<Stop> end_failed(std::size_t index,
                                                 EnvironmentFailure failure,
                                                 const Word* word,
                                                 std::uint32_t age,
                                                 DerivationEnd& end) const;

    const Bytecode& bytecode_;
    SenseOptions options_;
    Workers workers_;
    EnvironmentContext context_;
    std::vector<EnvironmentFiles> no_files_; // used if SenseOptions::files is null
    std::vector<std::unique_ptr<Environment>> environments_;
    std::unique_ptr<SensingTurtle> turtle_;
    std::vector<SensedEnvironment> sensed_;
    std::vector<SensedOrgan> organs_;
    std::uint32_t age_ = 0;
};

} // namespace lsys
