// SPDX-License-Identifier: MIT
#include "runtime/cli/dump_word.h"

#include "grammar/base/counted_text.h"
#include "runtime/cli/derivation_report.h"
#include "runtime/cli/module_lines.h"
#include "runtime/cli/progress.h"
#include "runtime/derive/derive.h"
#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/derive/state_file.h"
#include "runtime/derive/stream.h"
#include "runtime/derive/word_text.h"
#include "runtime/pipeline/growth_forecast.h"
#include "runtime/pipeline/plant.h"
#include "runtime/pipeline/senses.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace lsys::lsc {

namespace {

constexpr std::size_t kWriteBufferBytes = std::size_t{1} << 18;

/// The derivation to run, as command line, grammar and saved state decide. The age of a word is its
/// generation.
struct Plan {
    DeriveOptions derive;
    std::uint32_t first_age = 0; // of the axiom or the saved word
    std::uint32_t last_age = 0;  // of the word at which the derivation ends
    std::string saved_bytes;     // contents of the file of --from; empty: start at the axiom
    PlantSenses senses;          // makes the EnvironmentSense of each derivation
};

Result<SavedState> read_saved(const Plan& plan, const std::string& path, const Bytecode& bytecode) {
    Result<SavedState> state = read_state(plan.saved_bytes, bytecode);
    if (!state) {
        return Error{fmt::format("cannot go on from `{}`: {}", path, state.error().message)};
    }
    return state;
}

/// Reads the saved state and takes generations, seed and age from it.
Result<void> plan_from_state(const DumpCommand& command,
                             const Bytecode& bytecode,
                             const Console& console,
                             Plan& plan) {
    Result<std::string> bytes =
        read_file(command.from, {~std::uint64_t{0}, command.run.limits.max_bytes}, console);
    if (!bytes) {
        return bytes.error();
    }
    plan.saved_bytes = std::move(bytes.value());
    const Result<SavedState> state = read_saved(plan, command.from, bytecode);
    if (!state) {
        return state.error();
    }
    const StateHeader& header = state.value().header;
    if (command.seed && *command.seed != header.seed) {
        return Error{
            fmt::format("`{}` was derived with --seed {}, so it cannot go on with --seed {}",
                        command.from, header.seed, *command.seed)};
    }
    plan.derive.seed = header.seed;
    plan.first_age = header.age;
    plan.derive.generations = command.grammar.generations.value_or(header.generations);
    if (bytecode.uses_steps && plan.derive.generations != header.generations) {
        return Error{
            fmt::format("`{}` was derived with -n {}, and the grammar's steps() depends on it",
                        command.from, header.generations)};
    }
    if (plan.derive.generations < header.age) {
        return Error{fmt::format("`{}` is of generation {}, past the -n {} that is asked for",
                                 command.from, header.age, plan.derive.generations)};
    }
    return {};
}

Result<Plan> make_plan(const DumpCommand& command, const Grammar& grammar, const Console& console) {
    const Bytecode& bytecode = grammar.bytecode;
    PlantOptions options;
    options.generations = command.grammar.generations;
    options.seed = command.seed;
    options.origins = command.origins;
    Plan plan;
    plan.derive = derive_options(options, bytecode, make_project(console, command.run));
    if (!command.from.empty()) {
        if (const Result<void> taken = plan_from_state(command, bytecode, console, plan); !taken) {
            return taken.error();
        }
    }
    const std::uint64_t steps = command.steps.value_or(plan.derive.generations);
    plan.last_age = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(plan.first_age + steps, plan.derive.generations));
    return plan;
}

/// An Output whose write() returns whether to continue, for callbacks. Keeps the first error.
class Writer {
public:
    explicit Writer(Output output) : output_(std::move(output)) {}

    [[nodiscard]] bool write(std::string_view text) {
        if (!failed_) {
            const Result<void> written = output_.write(text);
            if (!written) {
                failed_ = written.error();
            }
        }
        return !failed_;
    }
    /// The reason why write() returned false.
    [[nodiscard]] const std::optional<Error>& failure() const { return failed_; }
    [[nodiscard]] Result<void> commit() {
        return failed_ ? Result<void>(*failed_) : output_.commit();
    }

private:
    Output output_;
    std::optional<Error> failed_; // the first error of writing; unset: none
};

// --- stored words

using OnGeneration = std::function<bool(const Derivation&)>;

/// Runs the derivation of `plan`. Calls `on_generation` after the last generation, or with --all
/// after each generation. `on_generation` returns false to end the run.
ExitStatus derive(Derivation& derivation,
                  const DumpCommand& command,
                  const Plan& plan,
                  const Grammar& grammar,
                  const Console& console,
                  const OnGeneration& on_generation) {
    std::optional<Stop> stop;
    if (command.from.empty()) {
        stop = derivation.start();
    } else {
        Result<SavedState> state = read_saved(plan, command.from, grammar.bytecode);
        if (!state) {
            return report_error(state.error(), console);
        }
        stop = derivation.resume(std::move(state.value().word), state.value().header.age,
                                 state.value().sense_state);
    }
    while (!stop) {
        console.detail(fmt::format("generation {}: {}, {}", derivation.age(),
                                   counted(derivation.word().module_count(), "module"),
                                   counted(derivation.word().byte_count(), "byte")));
        const bool is_last = derivation.age() == plan.last_age;
        // Only the final word must have balanced brackets.
        if (is_last && derivation.age() == plan.derive.generations) {
            stop = derivation.check_brackets();
            if (stop) {
                break;
            }
        }
        if ((is_last || command.all) && !on_generation(derivation)) {
            return console.interrupted() ? ExitStatus::Interrupted : ExitStatus::Failure;
        }
        if (is_last) {
            return ExitStatus::Ok;
        }
        stop = derivation.step();
    }
    return report_derivation(derivation.end(), plan.derive.limits, grammar, console);
}

Result<void> save_state(const Plan& plan,
                        const Derivation& derivation,
                        const Bytecode& bytecode,
                        Writer& writer) {
    const StateHeader header{digest(bytecode), plan.derive.seed, plan.derive.generations,
                             derivation.age()};
    static_cast<void>(write_state(header, derivation.word(), derivation.sense_state(),
                                  [&](std::string_view bytes) { return writer.write(bytes); }));
    return writer.commit();
}

/// Opens the outputs before the derivation, to detect unwritable ones early.
Result<void> open_outputs(const DumpCommand& command,
                          const Console& console,
                          std::optional<Writer>& word,
                          std::optional<Writer>& state) {
    Result<Output> output = Output::open(command.output, console);
    if (!output) {
        return output.error();
    }
    word.emplace(std::move(output.value()));
    if (!command.save_state.empty()) {
        Result<Output> saved = Output::open(command.save_state, console);
        if (!saved) {
            return saved.error();
        }
        state.emplace(std::move(saved.value()));
    }
    return {};
}

ExitStatus dump_stored(const DumpCommand& command,
                       const Plan& plan,
                       Grammar& grammar,
                       const Console& console) {
    const Bytecode& bytecode = grammar.bytecode;
    const auto ignore = [](const Derivation&) { return true; };
    if (command.all && !command.count && command.output == "-") {
        // Written output cannot be undone, so a first run checks that the derivation succeeds.
        DeriveOptions options = plan.derive;
        const std::unique_ptr<EnvironmentSense> senses = plan.senses.make(bytecode);
        options.senses = senses.get();
        Derivation trial(bytecode, options);
        const ExitStatus status = derive(trial, command, plan, grammar, console, ignore);
        if (status != ExitStatus::Ok) {
            return status;
        }
    }
    std::optional<Writer> word_writer;
    std::optional<Writer> state_writer;
    if (const Result<void> opened = open_outputs(command, console, word_writer, state_writer);
        !opened) {
        return report_error(opened.error(), console);
    }
    Writer& writer = *word_writer;
    DeriveOptions options = plan.derive;
    const std::unique_ptr<EnvironmentSense> senses = plan.senses.make(bytecode);
    options.senses = senses.get();
    Derivation derivation(bytecode, options);
    std::string counts;
    const auto print = [&](const Derivation& current) {
        if (command.count) {
            counts += fmt::format("{}\n", current.word().module_count());
            return true;
        }
        const auto put = [&](std::string_view text) {
            return !console.interrupted() && writer.write(text);
        };
        if (command.origins) {
            const std::string head =
                command.all ? fmt::format("generation {}:\n", current.age()) : std::string();
            return put(head) && ModuleLines(bytecode).print(current.word(), put);
        }
        return WordPrinter(bytecode).print(current.word(), put) && writer.write("\n");
    };
    const ExitStatus status = derive(derivation, command, plan, grammar, console, print);
    if (writer.failure()) {
        return report_error(*writer.failure(), console);
    }
    if (status != ExitStatus::Ok) {
        return status;
    }
    static_cast<void>(writer.write(counts));
    Result<void> done = writer.commit();
    if (done && state_writer) {
        done = save_state(plan, derivation, bytecode, *state_writer);
    }
    return report_result(done, console);
}

// --- streamed words

/// Runs one streamed derivation, whose chunks `consumer` receives.
ExitStatus stream(const Plan& plan,
                  const Grammar& grammar,
                  const Console& console,
                  const StreamConsumer& consumer,
                  StreamOutcome& outcome) {
    outcome = derive_streamed(grammar.bytecode, plan.derive, consumer);
    return report_derivation(outcome.end, plan.derive.limits, grammar, console);
}

ExitStatus dump_streamed(const DumpCommand& command,
                         const Plan& plan,
                         const Grammar& grammar,
                         const Console& console) {
    const Bytecode& bytecode = grammar.bytecode;
    if (const std::optional<std::string> reason = streaming_obstacle(bytecode)) {
        return report_error(Error{fmt::format("--stream: {}", *reason)}, console);
    }
    StreamOutcome outcome;
    const auto ignore = [&](const StreamChunk&) { return !console.interrupted(); };
    if (command.count || command.output == "-") {
        // A first run checks the derivation and counts its modules before anything is written.
        const ExitStatus status = stream(plan, grammar, console, ignore, outcome);
        if (status != ExitStatus::Ok) {
            return status;
        }
    }
    Result<Output> output = Output::open(command.output, console);
    if (!output) {
        return report_error(output.error(), console);
    }
    Writer writer(std::move(output.value()));
    if (command.count) {
        static_cast<void>(writer.write(fmt::format("{}\n", outcome.modules)));
    } else {
        WordPrinter printer(bytecode);
        ModuleLines lines(bytecode);
        std::string text;
        bool has_modules = false; // some module has been printed
        const auto print = [&](const StreamChunk& chunk) {
            if (command.origins) {
                lines.append(chunk, text);
            } else {
                text += has_modules || chunk.codes.empty() ? "" : printer.quote();
                has_modules = has_modules || !chunk.codes.empty();
                printer.append(chunk.codes, chunk.parameters, text);
            }
            if (text.size() < kWriteBufferBytes) {
                return !console.interrupted();
            }
            const bool written = writer.write(text);
            text.clear();
            return written && !console.interrupted();
        };
        const ExitStatus status = stream(plan, grammar, console, print, outcome);
        text += has_modules ? printer.quote() : "";
        text += command.origins ? "" : "\n";
        if (status == ExitStatus::Ok) {
            static_cast<void>(writer.write(text));
        } else if (!writer.failure()) {
            return status;
        }
    }
    return report_result(writer.commit(), console);
}

// --- counts without words

/// Prints the counts of modules if the growth matrix predicts them. Only starts the derivation, to
/// check the random constants.
std::optional<ExitStatus> print_predicted_counts(const DumpCommand& command,
                                                 const Plan& plan,
                                                 const Grammar& grammar,
                                                 const Console& console) {
    const std::optional<std::vector<std::uint64_t>> counts =
        predict_counts(grammar.bytecode, plan.last_age, plan.derive.limits);
    if (!counts) {
        return std::nullopt;
    }
    Derivation derivation(grammar.bytecode, plan.derive);
    static_cast<void>(derivation.start());
    const ExitStatus status =
        report_derivation(derivation.end(), plan.derive.limits, grammar, console);
    if (status != ExitStatus::Ok) {
        return status;
    }
    console.detail("counted by the growth matrix");
    std::string text;
    for (std::size_t i = command.all ? 0 : counts->size() - 1; i < counts->size(); ++i) {
        text += fmt::format("{}\n", (*counts)[i]);
    }
    return report_result(write_file(command.output, text, console), console);
}

} // namespace

ExitStatus dump_word(const DumpCommand& command, Grammar& grammar, const Console& console) {
    Result<Plan> planned = make_plan(command, grammar, console);
    if (!planned) {
        return report_error(planned.error(), console);
    }
    Plan& plan = planned.value();
    const ExitStatus read = console.take(
        read_senses(command.file, grammar, make_project(console, command.run)), plan.senses);
    if (read != ExitStatus::Ok) {
        return read;
    }
    console.detail(
        fmt::format("{} generations, seed {}", plan.derive.generations, plan.derive.seed));
    const bool from_axiom = command.from.empty();
    if (from_axiom && !command.stream) { // streaming stores no words
        const std::optional<LimitReport> limit =
            predict_limit(grammar.bytecode, plan.last_age, plan.derive.limits);
        if (limit) {
            return show_diagnostic(limit_diagnostic(*limit, plan.derive.limits, grammar.bytecode,
                                                    !grammar.is_module_file),
                                   ExitStatus::Limit, grammar, console);
        }
    }
    if (from_axiom && command.count && command.save_state.empty()) {
        if (const std::optional<ExitStatus> counted =
                print_predicted_counts(command, plan, grammar, console)) {
            return *counted;
        }
    }
    if (from_axiom && command.save_state.empty()) { // a state file stores the codes before folding
        fold_modules(plan.derive, grammar.bytecode);
    }
    const bool shows = console.shows_progress();
    Progress progress(shows ? &console.io().err : nullptr, plan.last_age, Progress::Clock::now(),
                      shows && from_axiom
                          ? predict_expected_modules(grammar.bytecode, plan.last_age)
                          : std::vector<double>());
    plan.derive.progress = [&](std::uint32_t generation, std::uint64_t modules) {
        progress.update(generation, modules, Progress::Clock::now());
    };
    if (command.stream) {
        return dump_streamed(command, plan, grammar, console);
    }
    return dump_stored(command, plan, grammar, console);
}

} // namespace lsys::lsc
