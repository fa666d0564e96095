// SPDX-License-Identifier: MIT
#include "compiler/growth/growth.h"
#include "grammar/base/exponentials.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/derivation_report.h"
#include "runtime/derive/derive.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/plant.h"
#include "runtime/pipeline/senses.h"
#include "runtime/program/arguments.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"
#include "runtime/program/weight_report.h"
#include "runtime/turtle/plant_size.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <vector>

namespace lsys::lsc {

namespace {

/// Max rows of a table.
constexpr std::uint32_t kMaxRows = 10'000;

using Row = std::vector<std::string>;

std::string bounds_text(const Count& low, const Count& high) {
    const std::string low_text = to_text(low);
    const std::string high_text = to_text(high);
    return low_text == high_text ? low_text : low_text + " .. " + high_text;
}

/// The growth factor of the number of modules from one generation to the next; empty if `before` is
/// 0.
std::string factor_text(const Count& before, const Count& now) {
    if (!before.exceeds && before.value == 0) {
        return {};
    }
    if (!now.exceeds && now.value == 0) {
        return "0";
    }
    return fmt::format("{:.4g}", power_of_two(now.approximate_log2() - before.approximate_log2()));
}

std::string factor_bounds(const GrowthPrediction& growth, std::size_t generation) {
    if (generation == 0) {
        return {};
    }
    const std::string low =
        factor_text(growth.low[generation - 1].modules, growth.low[generation].modules);
    const std::string high =
        factor_text(growth.high[generation - 1].modules, growth.high[generation].modules);
    return low == high ? low : low + " .. " + high;
}

/// Lays out a table with right-aligned columns.
std::string lay_out(const std::vector<Row>& rows) {
    std::vector<std::size_t> widths(rows.front().size(), 0);
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            widths[i] = std::max(widths[i], row[i].size());
        }
    }
    std::string text;
    for (const Row& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            line += fmt::format("{}{:>{}}", i == 0 ? "" : "  ", row[i], widths[i]);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + '\n';
    }
    return text;
}

std::string make_table(const GrowthPrediction& growth, std::string_view note) {
    Row head{"generation", "modules", "parameters", "segments", "bytes", "growth"};
    if (growth.has_expected) {
        head.insert(head.begin() + 2, "expected");
    }
    std::vector<Row> rows{std::move(head)};
    for (std::size_t i = 0; i < growth.low.size(); ++i) {
        const GenerationSize& low = growth.low[i];
        const GenerationSize& high = growth.high[i];
        Row row{std::to_string(i),
                bounds_text(low.modules, high.modules),
                bounds_text(low.parameters, high.parameters),
                bounds_text(low.segments, high.segments),
                bounds_text(low.bytes, high.bytes),
                factor_bounds(growth, i)};
        if (growth.has_expected) {
            row.insert(row.begin() + 2, fmt::format("{:.6g}", growth.expected_modules[i]));
        }
        rows.push_back(std::move(row));
    }
    std::string text = lay_out(rows);
    text += note;
    return text;
}

std::string_view accuracy_note(const GrowthPrediction& growth) {
    return growth.exact ? "exact\n"
           : growth.has_expected
               ? "bounds and expected counts: the productions are chosen by chance\n"
               : "bounds: the productions depend on parameters, neighbours or chance\n";
}

/// A note that names the symbol whose answer or sweep decides the sizes of later generations, which
/// are not predicted.
std::string dependence_note(const Bytecode& bytecode, const GrowthPrediction& growth) {
    const BytecodeSymbol& symbol = bytecode.symbol(growth.depends_on);
    return fmt::format("no further: from generation {} on the counts depend on {} `{}`\n",
                       growth.low.size(),
                       symbol.senses() ? "what is answered to" : "the sweeps over", symbol.name);
}

/// The size of a derived word, counted in the same way as a GrowthPrediction.
GenerationSize size_of(const Bytecode& bytecode, const Word& word) {
    std::vector<std::uint64_t> census(bytecode.code_count(), 0);
    for (std::uint64_t i = 0; i < word.module_count(); ++i) {
        ++census[word.code(i)];
    }
    std::uint64_t segments = 0;
    for (Code code = 0; code < census.size(); ++code) {
        const BytecodeSymbol& symbol = bytecode.symbol(bytecode.symbol_of(code));
        segments += draws(symbol.turtle) ? census[code] : 0;
    }
    const auto count = [](std::uint64_t value) { return Count{value, false, 0.0}; };
    const std::uint64_t parameters = word.parameters().size();
    return {count(word.module_count()), count(parameters), count(segments),
            count(word.module_count() * code_width(bytecode.code_count()) + 4 * parameters)};
}

/// Derives the words and counts their sizes, for grammars whose growth cannot be predicted.
ExitStatus count_words(const StatsCommand& command,
                       std::uint32_t generations,
                       const Grammar& grammar,
                       const Console& console,
                       GrowthPrediction& growth) {
    const Bytecode& bytecode = grammar.bytecode;
    DeriveOptions options;
    options.generations = generations;
    options.seed = bytecode.settings.seed;
    options.limits = command.run.limits;
    options.cancelled = console.io().interrupted;
    PlantSenses senses;
    const ExitStatus read = console.take(
        read_senses(command.file, grammar, make_project(console, command.run)), senses);
    if (read != ExitStatus::Ok) {
        return read;
    }
    const std::unique_ptr<EnvironmentSense> own_senses = senses.make(bytecode);
    options.senses = own_senses.get();
    Derivation derivation(bytecode, options);
    std::optional<Stop> stop = derivation.start();
    while (!stop) {
        growth.low.push_back(size_of(bytecode, derivation.word()));
        growth.high.push_back(growth.low.back());
        if (derivation.age() == generations) {
            break;
        }
        stop = derivation.step();
    }
    return report_derivation(derivation.end(), options.limits, grammar, console);
}

/// A JSON number if the count fits into 64 bits, else a JSON string.
nlohmann::ordered_json json_count(const Count& count) {
    if (count.at_most(std::numeric_limits<std::uint64_t>::max())) {
        return count.value.low;
    }
    std::string digits = to_text(count);
    digits.erase(std::remove(digits.begin(), digits.end(), ','), digits.end());
    return digits;
}

nlohmann::ordered_json json_size(const GenerationSize& size) {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    object["modules"] = json_count(size.modules);
    object["parameters"] = json_count(size.parameters);
    object["segments"] = json_count(size.segments);
    object["bytes"] = json_count(size.bytes);
    return object;
}

/// The height of the plant in m; nothing if the plant has too many modules, drawing fails or
/// nothing is visible. Folds the bytecode of the grammar (fold_modules()). Throws std::bad_alloc.
std::optional<double> find_height(const StatsCommand& command,
                                  const Count& modules,
                                  Grammar& grammar,
                                  const Console& console) {
    constexpr std::uint64_t kMaxModules = 1'000'000;
    if (!modules.at_most(kMaxModules)) {
        return std::nullopt;
    }
    PlantOptions options;
    options.file = command.file;
    options.generations = command.grammar.generations;
    options.height = command.height;
    const Outcome<Plant> plant = grow_plant(options, grammar, make_project(console, command.run));
    if (!plant && plant.stop() == Stop::OutOfMemory) {
        throw std::bad_alloc();
    }
    if (!plant || bounds_of(plant.value().skeleton).empty) {
        return std::nullopt;
    }
    return height_of(plant.value().skeleton);
}

/// Makes one JSON object per generation, each in a line. The last object has the height of the
/// plant, in m.
std::string
make_json(const GrowthPrediction& growth, bool predicted, std::optional<double> height) {
    std::string text;
    for (std::size_t i = 0; i < growth.low.size(); ++i) {
        nlohmann::ordered_json object = nlohmann::ordered_json::object();
        object["generation"] = i;
        object["exact"] = growth.exact;
        if (!predicted) {
            object["derived"] = true; // counted in words derived with one seed
        }
        object["low"] = json_size(growth.low[i]);
        object["high"] = json_size(growth.high[i]);
        if (growth.has_expected) {
            object["expected_modules"] = growth.expected_modules[i];
        }
        if (height && i + 1 == growth.low.size()) {
            object["height_m"] = *height;
        }
        text += object.dump() + '\n';
    }
    return text;
}

/// The shortest decimal text that reads back as `value`.
std::string shortest(float value) {
    return fmt::format("{}", value);
}

/// Makes a table with one row per #param and #define in source order. A random constant has no
/// value.
std::string parameter_table(const Grammar& grammar, std::uint32_t generations) {
    std::vector<Row> rows{{"name", "kind", "value", "min", "max"}};
    for (const Constant& constant : grammar.program->constants) {
        const bool bounded = constant.is_param;
        rows.push_back(
            {std::string(grammar.names.text(constant.name)), bounded ? "#param" : "#define",
             constant.is_random ? "random" : shortest(constant.value),
             bounded ? shortest(constant.minimum) : "", bounded ? shortest(constant.maximum) : ""});
    }
    std::string text = rows.size() > 1 ? lay_out(rows) : std::string("no #param or #define\n");
    text += fmt::format("generations {}, seed {}\n", generations, grammar.bytecode.settings.seed);
    return text;
}

/// Makes a JSON object: `generations`, `seed`, and `parameters` with name, kind, value, min and
/// max.
std::string parameter_json(const Grammar& grammar, std::uint32_t generations) {
    // A float written as a double would show digits that the grammar does not have.
    const auto number = [](float value) { return nlohmann::ordered_json::parse(shortest(value)); };
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    object["generations"] = generations;
    object["seed"] = grammar.bytecode.settings.seed;
    object["parameters"] = nlohmann::ordered_json::array();
    if (grammar.program) {
        for (const Constant& constant : grammar.program->constants) {
            nlohmann::ordered_json entry = nlohmann::ordered_json::object();
            entry["name"] = std::string(grammar.names.text(constant.name));
            entry["kind"] = constant.is_param ? "param" : "define";
            if (constant.is_random) {
                entry["random"] = true;
            } else {
                entry["value"] = number(constant.value);
            }
            if (constant.is_param) {
                entry["min"] = number(constant.minimum);
                entry["max"] = number(constant.maximum);
            }
            object["parameters"].push_back(std::move(entry));
        }
    }
    return object.dump() + '\n';
}

/// Lists the constants of a grammar. A .lsb file has no constants that -D could change.
ExitStatus
list_parameters(const StatsCommand& command, const Grammar& grammar, const Console& console) {
    const std::uint32_t generations =
        command.grammar.generations.value_or(grammar.bytecode.generations.value_or(0));
    std::string text;
    if (command.messages.format == MessageFormat::Json) {
        text = parameter_json(grammar, generations);
    } else if (grammar.program) {
        text = parameter_table(grammar, generations);
    } else {
        text = fmt::format("a compiled grammar takes no -D\ngenerations {}, seed {}\n", generations,
                           grammar.bytecode.settings.seed);
    }
    const Result<void> written = write_file("-", text, console);
    return written ? ExitStatus::Ok : report_error(written.error(), console);
}

/// Grows the plant and reports how it bends under its weight.
ExitStatus report_weight(const StatsCommand& command,
                         const Project& project,
                         Grammar& grammar,
                         const Console& console) {
    PlantOptions options;
    options.file = command.file;
    options.generations = command.grammar.generations;
    Plant plant;
    const ExitStatus status = console.take(grow_plant(options, grammar, project), plant);
    if (status != ExitStatus::Ok) {
        return status;
    }
    const Settings& settings = grammar.bytecode.settings;
    PhysicsOptions forces;
    forces.gravity = *command.gravity;
    forces.load = settings.load;
    forces.threads = command.run.threads;
    const WeightReport report = make_weight_report(plant.skeleton, settings, forces);
    const std::string text =
        command.messages.format == MessageFormat::Json ? weight_json(report) : weight_text(report);
    if (const Result<void> written = write_file("-", text, console); !written) {
        return report_error(written.error(), console);
    }
    return warn_of_fall(report, grammar, console);
}

} // namespace

ExitStatus run_command(const StatsCommand& command, const Console& console) {
    if (command.parameters && command.gravity) {
        return report_error(Error{"--parameters draws nothing, so --gravity does not go with it"},
                            console);
    }
    Grammar grammar;
    const Project project = make_project(console, command.run);
    const ExitStatus status =
        console.take(load_grammar(command.file, command.grammar, project), grammar);
    if (status != ExitStatus::Ok) {
        return status;
    }
    if (command.parameters) {
        return list_parameters(command, grammar, console);
    }
    const std::uint32_t wanted =
        command.grammar.generations.value_or(grammar.bytecode.generations.value_or(0));
    const std::uint32_t shown = std::min(wanted, kMaxRows);
    const bool known = is_growth_known(grammar.bytecode);
    GrowthPrediction growth;
    ExitStatus count_status = ExitStatus::Ok;
    std::string note;
    if (known) {
        growth = predict_growth(grammar.bytecode, shown);
        note = accuracy_note(growth);
        if (growth.depends_on != kNoSymbol) {
            note += dependence_note(grammar.bytecode, growth);
        }
    } else {
        count_status = count_words(command, shown, grammar, console, growth);
        note = fmt::format("counted in the words of seed {}, which were derived: the grammar {}\n",
                           grammar.bytecode.settings.seed,
                           grammar.bytecode.has_cuts() ? "cuts branches off with `%`"
                                                       : "has `#decompose`");
        if (growth.low.empty()) {
            return count_status;
        }
    }
    std::optional<double> height;
    const bool has_last = shown == wanted && growth.depends_on == kNoSymbol;
    if (has_last && count_status == ExitStatus::Ok) {
        height = find_height(command, growth.high.back().modules, grammar, console);
    }
    if (height) {
        note += fmt::format("height of the plant: {:.4g} m\n", *height);
    }
    const std::string text = command.messages.format == MessageFormat::Json
                                 ? make_json(growth, known, height)
                                 : make_table(growth, note);
    if (const Result<void> written = write_file("-", text, console); !written) {
        return report_error(written.error(), console);
    }
    if (shown < wanted) {
        console.info(fmt::format("only the first {} of {} generations are shown", shown, wanted));
    }
    if (command.gravity && count_status == ExitStatus::Ok) {
        return report_weight(command, project, grammar, console);
    }
    return count_status;
}

} // namespace lsys::lsc
