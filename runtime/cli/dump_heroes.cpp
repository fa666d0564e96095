// SPDX-License-Identifier: MIT
#include "runtime/cli/dump_heroes.h"

#include "compiler/instancing/instance.h"
#include "runtime/cli/derivation_report.h"
#include "runtime/derive/derive.h"
#include "runtime/derive/word_text.h"
#include "runtime/forest/instance_cache.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/growth_forecast.h"
#include "runtime/pipeline/plant.h"
#include "runtime/pipeline/senses.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"
#include "runtime/scene/scene.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lsys::lsc {

namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 18;

/// Collects text in `text` and writes it in large pieces.
class PieceWriter {
public:
    explicit PieceWriter(Output output) : output_(std::move(output)) {}

    std::string text;

    /// Writes `text` if it has at least kPieceBytes bytes. Returns false after an interrupt or a
    /// failed write.
    [[nodiscard]] bool write_if_long(const Console& console) {
        return text.size() < kPieceBytes || (!console.interrupted() && write());
    }
    [[nodiscard]] ExitStatus finish(const Console& console) {
        if (console.interrupted()) {
            return ExitStatus::Interrupted;
        }
        static_cast<void>(write());
        return report_result(written_ ? output_.commit() : written_, console);
    }

private:
    bool write() {
        if (written_) {
            written_ = output_.write(text);
        }
        text.clear();
        return bool(written_);
    }

    Output output_;
    Result<void> written_;
};

/// Prints words of an instanced system: `@(id,age)[...]$` for a branch that is recorded,
/// `<(id,age)[...]>` for a branch that is replaced by a recorded one.
class HeroPrinter {
public:
    explicit HeroPrinter(const Bytecode& bytecode) : bytecode_(bytecode), printer_(bytecode) {}

    /// Returns false if the writer has stopped.
    [[nodiscard]] bool print(const Word& word, const Console& console, PieceWriter& writer) {
        std::string& text = writer.text;
        text += "@(0,0)";
        printer_.begin();
        const bool has_modules = word.module_count() != 0;
        text += has_modules ? printer_.quote() : "";
        std::size_t parameter = 0;
        open_.clear();
        for (std::uint64_t i = 0; i < word.module_count(); ++i) {
            const Code code = word.code(i);
            const std::size_t stored = bytecode_.stored_parameters(code);
            print_module(code, word.parameters().subspan(parameter, stored), text);
            parameter += stored;
            if (!writer.write_if_long(console)) {
                return false;
            }
        }
        text += has_modules ? printer_.quote() : "";
        text += "$\n";
        return true;
    }

private:
    void print_module(Code code, std::span<const float> parameters, std::string& text) {
        const BytecodeSymbol& symbol = bytecode_.symbol(bytecode_.symbol_of(code));
        if (symbol.turtle == TurtleOperation::SaveBranch) {
            const bool uses_recorded_branch = parameters[0] != 0.0F;
            fmt::format_to(std::back_inserter(text), "{}({},{})", uses_recorded_branch ? '<' : '@',
                           parameters[2], parameters[1]);
            text += spelled_name(symbol.name, bytecode_.settings.print_letters);
            printer_.begin();
            open_.push_back(uses_recorded_branch ? '>' : '$');
            return;
        }
        if (symbol.name == "$") { // quoted, since a `$` alone is an operation of instancing
            text += "`$`";
            for (std::size_t i = 0; i < parameters.size(); ++i) {
                text += i == 0 ? '(' : ',';
                append_number(parameters[i], text);
            }
            text += parameters.empty() ? "" : ")";
            printer_.begin();
            return;
        }
        printer_.append({&code, 1}, parameters, text);
        if (symbol.kind == SymbolKind::BranchOpen) {
            open_.push_back(kPlain);
        } else if (symbol.kind == SymbolKind::BranchClose && !open_.empty()) {
            if (open_.back() != kPlain) {
                text += open_.back();
                printer_.begin();
            }
            open_.pop_back();
        }
    }

    static constexpr char kPlain = ' ';

    const Bytecode& bytecode_;
    WordPrinter printer_;
    std::string open_; // by open bracket: the character to print after its `]`, or kPlain
};

/// Removes the notes that all plants are equal. With a single hero this is expected.
void drop_notes_on_variety(Diagnostics& diagnostics) {
    Diagnostics left;
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        if (diagnostic.code != DiagnosticCode::NoVariety) {
            left.add(diagnostic);
        }
    }
    diagnostics = std::move(left);
}

/// The value, or 0 if it is so small that it is a rounding error of sums of sines and cosines.
float without_noise(float value) {
    constexpr float kNoise = 1e-9F;
    return std::abs(value) < kNoise ? 0.0F : value;
}
std::string vector_text(const glm::vec3& v) {
    return fmt::format("({}, {}, {})", without_noise(v.x), without_noise(v.y), without_noise(v.z));
}
std::string frame_text(const glm::quat& q) {
    return fmt::format("({}, {}, {}, {})", without_noise(q.w), without_noise(q.x),
                       without_noise(q.y), without_noise(q.z));
}

/// Appends the range [begin, end) of a kind of parts as `kind first-last`; nothing if it is empty.
void append_range(const char* kind, std::uint32_t begin, std::uint32_t end, std::string& text) {
    if (end == begin + 1) {
        fmt::format_to(std::back_inserter(text), " {} {}", kind, begin);
    } else if (end > begin) {
        fmt::format_to(std::back_inserter(text), " {} {}-{}", kind, begin, end - 1);
    }
}

/// Prints caches as text.
class CachePrinter {
public:
    CachePrinter(const InstanceCache& cache, std::string& text) : cache_(cache), text_(text) {}

    void slot(std::uint32_t index) {
        const InstanceSlot& slot = cache_.slots[index];
        put("key {}: id {} age {}", index, slot.id, slot.age);
        if (index == 0) {
            put(", whole plants");
        } else {
            key(cache_.keys[index]);
        }
        put("\n  instances {} hits {} misses {} recorded {} dropped {}\n", slot.variant_count,
            slot.hits, slot.misses, slot.recorded, slot.dropped);
    }
    void instance(std::uint32_t index) {
        const Instance& instance = cache_.instances[index];
        put("  instance {}: hero {} order {} at {} frame {}", index, instance.hero, instance.order,
            vector_text(glm::vec3(instance.position)), frame_text(glm::quat(instance.frame)));
        for (std::uint32_t r = 0; r < instance.range_count; ++r) {
            const DrawnRange& range = cache_.ranges[instance.first_range + r];
            append_range("segments", range.begin.segments, range.end.segments, text_);
            append_range("objects", range.begin.objects, range.end.objects, text_);
            append_range("polygons", range.begin.polygons, range.end.polygons, text_);
        }
        text_ += '\n';
        for (std::uint32_t e = 0; e < instance.exit_count; ++e) {
            const InstanceExit& exit = cache_.exits[instance.first_exit + e];
            const InstanceSlot& to = cache_.slots[exit.slot];
            put("    exit to key {}: id {} age {} order {} at {} frame {}\n", exit.slot, to.id,
                to.age, exit.order, vector_text(exit.position), frame_text(exit.rotation));
        }
    }

private:
    template <typename... Values>
    void put(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    }

    void key(const InstanceKey& key) {
        for (std::size_t i = 0; i < key.formals.size(); ++i) {
            put("{}{}", i == 0 ? " values (" : ", ", key.formals[i]);
        }
        put("{} width {} taper {} step {} angle {} sides {} colour {}",
            key.formals.empty() ? "" : ")", key.place.width, key.place.taper, key.place.step,
            key.place.angle, key.place.sides, key.place.colour);
        if (key.place.second_heading != 0.0F) {
            put(" second heading {}", key.place.second_heading);
        }
        if (key.place.texture != 0) {
            put(" texture {}", key.place.texture);
        }
        if (key.place.contour != kNoContour) {
            put(" contour {}", (*cache_.skeleton.contours)[key.place.contour].name);
        }
        const std::array tangents{key.place.tangent_before, key.place.tangent_after};
        if (tangents != std::array{1.0F, 1.0F}) {
            put(" tangents {} {}", tangents[0], tangents[1]);
        }
        const RadiusTangents& radii = key.place.radii;
        if (radii.part_before != 0.0F || radii.radius_before != 0.0F) {
            put(" radius tangents {} {} {} {}{}", radii.part_before, radii.radius_before,
                radii.part_after, radii.radius_after, radii.per_chord ? " per chord" : "");
        }
        if (key.has_vertical) {
            put(" elevation {} roll {}", without_noise(key.elevation), without_noise(key.roll));
        }
    }

    const InstanceCache& cache_;
    std::string& text_;
};

} // namespace

ExitStatus dump_heroes(const DumpCommand& command, Grammar& grammar, const Console& console) {
    const std::uint32_t heroes = command.heroes.value_or(CacheOptions{}.heroes);
    Diagnostics diagnostics;
    std::optional<InstancedSystem> system =
        compile_instanced(std::move(*grammar.program), grammar.names, *grammar.sources,
                          command.rho.value_or(kSceneRho), diagnostics);
    if (heroes == 1) {
        drop_notes_on_variety(diagnostics);
    }
    const ExitStatus compiled = console.show(diagnostics, *grammar.sources);
    if (!system || compiled != ExitStatus::Ok) {
        return compiled;
    }
    grammar.program.reset();
    grammar.bytecode = std::move(system->bytecode);
    const Bytecode& bytecode = grammar.bytecode;
    PlantOptions options;
    options.generations = command.grammar.generations;
    options.seed = command.seed.value_or(0); // default seed of the heroes of a forest
    const Project project = make_project(console, command.run);
    PlantSenses senses;
    const ExitStatus read = console.take(read_senses(command.file, grammar, project), senses);
    if (read != ExitStatus::Ok) {
        return read;
    }
    const std::unique_ptr<EnvironmentSense> own_senses = senses.make(bytecode);
    DeriveOptions derive = derive_options(options, bytecode, project);
    derive.senses = own_senses.get();
    const std::uint64_t seed = derive.seed;
    const auto derive_hero = [&](std::uint32_t hero, std::optional<Derivation>& derivation) {
        derive.seed = seed + hero;
        derivation.emplace(bytecode, derive);
        return derivation->derive()
                   ? report_derivation(derivation->end(), derive.limits, grammar, console)
                   : ExitStatus::Ok;
    };
    if (command.output == "-" && heroes > 1) {
        // Written output cannot be undone, so a first run checks that all heroes can be derived.
        for (std::uint32_t hero = 0; hero < heroes; ++hero) {
            std::optional<Derivation> derivation;
            if (const ExitStatus status = derive_hero(hero, derivation); status != ExitStatus::Ok) {
                return status;
            }
        }
    }
    Result<Output> output = Output::open(command.output, console);
    if (!output) {
        return report_error(output.error(), console);
    }
    PieceWriter writer(std::move(output.value()));
    HeroPrinter printer(bytecode);
    for (std::uint32_t hero = 0; hero < heroes; ++hero) {
        std::optional<Derivation> derivation;
        if (const ExitStatus status = derive_hero(hero, derivation); status != ExitStatus::Ok) {
            return status;
        }
        if (command.count) {
            writer.text += fmt::format("{}\n", derivation->word().module_count());
            continue;
        }
        writer.text += fmt::format("hero {}, seed {}:\n", hero, derive.seed);
        if (!printer.print(derivation->word(), console, writer)) {
            break;
        }
    }
    return writer.finish(console);
}

ExitStatus dump_cache(const DumpCommand& command, const Console& console) {
    Project project = make_project(console, command.run);
    const auto exists = project.host.file_exists;
    project.host.file_exists = [&](const std::string& path) {
        return is_standard_input(path) || exists(path);
    };
    SceneOverrides overrides;
    overrides.grammar = command.grammar;
    overrides.seed = command.seed;
    overrides.heroes = command.heroes;
    overrides.rho = command.rho;
    overrides.cache_cap = command.cache_cap;
    overrides.tolerance = command.tolerance;
    LoadedScene loaded;
    if (const ExitStatus status =
            console.take(load_scene({command.file}, overrides, project), loaded);
        status != ExitStatus::Ok) {
        return status;
    }
    for (SceneSpecies& species : loaded.scene.species) {
        species.cache.keep_keys = true;
    }
    GrownForest grown;
    if (const ExitStatus status = console.take(grow_species(loaded, project, {}), grown);
        status != ExitStatus::Ok) {
        return status;
    }
    Result<Output> output = Output::open(command.output, console);
    if (!output) {
        return report_error(output.error(), console);
    }
    PieceWriter writer(std::move(output.value()));
    for (std::size_t s = 0; s < loaded.scene.species.size(); ++s) {
        const SceneSpecies& species = loaded.scene.species[s];
        for (const ForestStage& stage : grown.forest.species[s].stages) {
            const InstanceCache& cache = stage.cache;
            writer.text += fmt::format(
                "{}: {} generations, heroes {} rho {} seed {} cap {} tolerance {}\n"
                "keys {} instances {} exits {} segments {} objects {} polygons {}\n",
                species.name, stage.generations, cache.heroes, species.rho, species.cache.seed,
                species.cache.cap, species.cache.tolerance, cache.slots.size(),
                cache.instances.size(), cache.exits.size(), cache.skeleton.segments.size(),
                cache.skeleton.objects.size(), cache.skeleton.polygons.size());
            CachePrinter printer(cache, writer.text);
            bool wanted = true;
            for (std::uint32_t k = 0; k < cache.slots.size() && wanted; ++k) {
                printer.slot(k);
                const InstanceSlot& slot = cache.slots[k];
                for (std::uint32_t v = 0; v < slot.variant_count && wanted; ++v) {
                    printer.instance(cache.variants[slot.first_variant + v]);
                    wanted = writer.write_if_long(console);
                }
            }
        }
    }
    return writer.finish(console);
}

} // namespace lsys::lsc
