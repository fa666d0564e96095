// SPDX-License-Identifier: MIT
#include "grammar/base/names.h"
#include "grammar/base/paths.h"
#include "grammar/base/trigonometry.h"
#include "runtime/scene/impl/table_reader.h"
#include "runtime/scene/impl/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace lsys {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kMaxInteger32 = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kMaxInteger63 = std::numeric_limits<std::int64_t>::max();
constexpr double kMaxFloat = static_cast<double>(std::numeric_limits<float>::max());
constexpr std::size_t kMaxStages = 256;
constexpr double kMaxSeedsPerYear = 254.0;
// In the order of the enumerators of StageStart.
constexpr std::array<std::string_view, 2> kStarts{"first", "random"};
constexpr std::array<std::string_view, 2> kSurroundingsChoices{"ignored", "sensed"};

/// The stem of a path: `pine` of `trees/pine.lsys`.
std::string stem_of(std::string_view path) {
    path = name_of_path(path);
    const std::size_t dot = path.find_last_of('.');
    return std::string(path.substr(0, dot == 0 ? std::string_view::npos : dot));
}

float float_of(double value) {
    return static_cast<float>(value);
}

/// A species that is being read, and the reader of its table.
struct SpeciesReader {
    TableReader reader;
    SceneSpecies& species;
    PlacementSpecies& placement;

    float number(std::string_view key, const NumberRange& range, float fallback) {
        const std::optional<double> value = reader.number(key, range);
        return value ? float_of(*value) : fallback;
    }
    std::uint32_t integer(std::string_view key, IntegerRange range, std::uint32_t fallback) {
        return static_cast<std::uint32_t>(reader.integer(key, range).value_or(fallback));
    }
};

/// The value as the text of a `#set`; nullopt for kinds of values that `#set` does not accept.
std::optional<std::string> setting_text(const SceneValue& value) {
    switch (value.kind) {
    case SceneValueKind::Text:
        return value.text;
    case SceneValueKind::Integer:
        return fmt::format("{}", value.integer);
    case SceneValueKind::Real:
        return fmt::format("{}", value.real);
    default:
        return std::nullopt;
    }
}

/// Reads one key of `[species.settings]`: a number, a text, or a list of numbers.
void read_setting(const SceneEntry& entry, SpeciesReader& from) {
    if (!is_identifier(entry.key)) {
        from.reader.report_bad_value(entry.key_span,
                                     fmt::format("`{}` is not the name of a setting", entry.key));
        return;
    }
    if (entry.key == "seed") {
        from.reader.report_bad_value(entry.key_span, "plants of a forest have seeds of their own")
            .help.emplace_back("write `seed` in `[[species]]`, the seed of the first hero");
        return;
    }
    std::optional<std::string> text = setting_text(entry.value);
    if (entry.value.kind == SceneValueKind::List && !entry.value.items.empty()) {
        text.emplace();
        for (const SceneValue& item : entry.value.items) {
            const std::optional<std::string> one = setting_text(item);
            if (!one) {
                text.reset();
                break;
            }
            *text += (text->empty() ? "" : " ") + *one;
        }
    }
    if (!text) {
        Diagnostic& error = from.reader.report_bad_value(
            entry.value.span,
            fmt::format("`{}` must be a number, a text, or a list of these", entry.key));
        error.label = fmt::format("this is {}", kind_text(entry.value.kind));
        return;
    }
    from.species.settings.emplace_back(entry.key, std::move(*text));
}

void read_grammar(SpeciesReader& from) {
    if (auto grammar = from.reader.file("grammar")) {
        from.species.grammar = std::move(*grammar);
        from.species.name = stem_of(from.species.grammar.path);
    } else if (!from.reader.has("grammar")) {
        from.reader.report_missing("grammar", "the species")
            .help.emplace_back("name a grammar beside the scene: `grammar = \"pine.lsys\"`");
    }
    const auto optional_name = [&](std::string_view key, SceneName& name) {
        if (auto text = from.reader.text(key)) {
            name = {std::move(*text), from.reader.span_of(key)};
        }
    };
    optional_name("dialect", from.species.dialect);
    optional_name("system", from.species.system);
    if (!from.species.system.text.empty()) {
        from.species.name = from.species.system.text;
    }
    if (auto name = from.reader.text("name")) {
        from.species.name = std::move(*name);
    } else if (from.reader.has("name")) {
        from.species.name.clear(); // the wrong name has been reported
    }
    if (const SceneValue* const settings = from.reader.table("settings")) {
        for (const SceneEntry& entry : settings->entries) {
            read_setting(entry, from);
        }
    }
    if (const SceneValue* const define = from.reader.table("define")) {
        for (const SceneEntry& entry : define->entries) {
            if (const auto value =
                    from.reader.number_of(entry.value, fmt::format("`{}`", entry.key),
                                          {-kMaxFloat, kMaxFloat, false, {}})) {
                from.species.definitions.push_back({entry.key, float_of(*value), entry.key_span});
            }
        }
    }
}

void read_stage_list(SpeciesReader& from) {
    const SceneEntry* const list = from.reader.entry("stages");
    if (list == nullptr) {
        return;
    }
    const SceneValue& value = list->value;
    if (value.kind != SceneValueKind::List) {
        Diagnostic& error = from.reader.report_bad_value(
            value.span, "`stages` must be a list of numbers of generations");
        error.label = fmt::format("this is {}", kind_text(value.kind));
        return;
    }
    if (value.items.empty() || value.items.size() > kMaxStages) {
        from.reader.report_bad_value(value.span,
                                     fmt::format("`stages` has {} numbers; it takes 1 to {}",
                                                 value.items.size(), kMaxStages));
        return;
    }
    for (const SceneValue& item : value.items) {
        const auto stage = from.reader.integer_of(item, "a stage", {0, kMaxInteger32 - 1});
        if (!stage) {
            continue;
        }
        if (!from.species.stages.empty() && *stage <= from.species.stages.back()) {
            from.reader.report_bad_value(item.span,
                                         fmt::format("stages must ascend: {} is not above {}",
                                                     *stage, from.species.stages.back()));
            continue;
        }
        from.species.stages.push_back(static_cast<std::uint32_t>(*stage));
    }
}

/// Reads `n`, or `stages` with `starting_stage` and, if plants have an age, `years_of_stage`.
void read_stages(SpeciesReader& from, bool has_ages) {
    TableReader& reader = from.reader;
    const auto generations = reader.integer("n", {0, kMaxInteger32 - 1});
    read_stage_list(from);
    const auto years = reader.number("years_of_stage", {0.0, kMaxYears, true, "years"});
    const auto start = reader.choice("starting_stage", kStarts);
    if (!reader.has("stages")) {
        if (generations) {
            from.species.stages = {static_cast<std::uint32_t>(*generations)};
        }
        reader.report_conflicting_key("years_of_stage", "the species has no `stages`", {});
        reader.report_conflicting_key("starting_stage", "the species has no `stages`", {});
        return;
    }
    reader.report_conflicting_key("n", "`stages` says how many generations there are",
                                  reader.span_of("stages"));
    if (start) {
        from.species.start = static_cast<StageStart>(*start);
    }
    if (!has_ages) {
        reader.report_conflicting_key(
            "years_of_stage", "only with the method `domination` do plants have an age", {});
        return;
    }
    if (years) {
        from.species.years_of_stage = float_of(*years);
    } else if (!reader.has("years_of_stage") && from.species.stages.size() > 1) {
        reader.report_missing("years_of_stage", "the species has `stages` and")
            .help.emplace_back("say how many years a plant needs for each: `years_of_stage = 10`");
    }
}

void read_cache(SpeciesReader& from) {
    CacheOptions& cache = from.species.cache;
    cache.heroes = from.integer("heroes", {1, kMaxHeroes}, cache.heroes);
    cache.seed = from.reader.integer("seed", {0, kMaxInteger63}).value_or(cache.seed);
    cache.cap = from.integer("cache_cap", {0, kMaxInteger32}, cache.cap);
    cache.tolerance = from.number("tolerance", {0.0, 1.0, false, {}}, cache.tolerance);
    from.species.rho = from.number("rho", {0.0, 1.0, false, {}}, from.species.rho);
    from.species.explicit_instancing = {from.reader.has("heroes"), from.reader.has("rho"),
                                        from.reader.has("cache_cap")};
    if (const auto surroundings = from.reader.choice("surroundings", kSurroundingsChoices)) {
        from.species.senses_surroundings = *surroundings == 1;
        from.species.surroundings_span = from.reader.span_of("surroundings");
    }
}

void read_placement(SpeciesReader& from) {
    PlacementSpecies& placement = from.placement;
    placement.share =
        from.reader.number("share", {0.0, 1.0e9, false, {}}).value_or(placement.share);
    if (const auto scale = from.reader.ordered_pair("scale", {1.0e-3, 1000.0, false, {}})) {
        placement.min_scale = float_of((*scale)[0]);
        placement.max_scale = float_of((*scale)[1]);
    }
    // The range of `#set height`, wider than any plant needs.
    if (const auto height = from.reader.ordered_pair("height", {1.0e-6, 1.0e6, false, "m"})) {
        placement.min_height = float_of((*height)[0]);
        placement.max_height = float_of((*height)[1]);
        from.species.height_span = from.reader.span_of("height");
    }
    if (from.reader.has("height")) {
        from.reader.report_conflicting_key("scale", "`height` says how high the trees are",
                                           from.reader.span_of("height"));
    }
    if (const auto altitude =
            from.reader.ordered_pair("altitude", {-kUnbounded, kUnbounded, false, "m"})) {
        placement.lowest = float_of((*altitude)[0]);
        placement.highest = float_of((*altitude)[1]);
    }
    if (const auto slope = from.reader.number("slope", {0.0, 90.0, false, "degrees"});
        slope && *slope < 90.0) {
        const SineCosine turn = sine_cosine(*slope * (std::numbers::pi / 180.0));
        placement.steepest = float_of(turn.sine / turn.cosine);
    }
}

void read_growth(const SceneValue* table, PlacementSpecies& placement, Diagnostics& diagnostics) {
    SpeciesGrowth& growth = placement.growth;
    TableReader reader(table, "[species.growth]", diagnostics);
    const auto number = [&](std::string_view key, const NumberRange& range, float& value) {
        if (const auto found = reader.number(key, range)) {
            value = float_of(*found);
        }
    };
    const auto integer = [&](std::string_view key, IntegerRange range, std::uint32_t& value) {
        value = static_cast<std::uint32_t>(reader.integer(key, range).value_or(value));
    };
    number("greatest_radius", {0.01, 1000.0, false, "m"}, growth.max_radius);
    number("rate", {1.0e-4, 1000.0, false, "m a year"}, growth.rate);
    number("shade_tolerance", {0.0, 1.0, false, {}}, growth.tolerance);
    number("vigour_spread", {0.0, 0.9, false, {}}, growth.vigour_spread);
    integer("lifespan", {1, kMaxYears}, growth.lifespan);
    integer("maturity", {1, std::uint64_t{2} * kMaxYears}, growth.maturity);
    number("seeds", {0.0, kMaxSeedsPerYear, false, "a year"}, growth.seeds);
    number("seed_distance", {0.0, 1.0e5, false, "m"}, growth.seed_distance);
    if (growth.rate > growth.max_radius) {
        const SourceSpan at = reader.span_of(reader.has("rate") ? "rate" : "greatest_radius");
        reader.report_bad_value(at,
                                fmt::format("plants grow by {} m a year, more than their greatest "
                                            "radius of {} m",
                                            growth.rate, growth.max_radius));
    }
    reader.finish();
}

void read_one_species(const SceneValue& table, Scene& scene, Diagnostics& diagnostics) {
    SceneSpecies& species = scene.species.emplace_back();
    PlacementSpecies& placement = scene.placement.species.emplace_back();
    SpeciesReader from{TableReader(&table, "[[species]]", diagnostics), species, placement};
    species.span = table.span;
    const bool has_ages = scene.placement.method == PlacementMethod::Domination;
    read_grammar(from);
    read_stages(from, has_ages);
    read_cache(from);
    read_placement(from);
    read_growth(from.reader.table("growth"), placement, diagnostics);
    if (!has_ages) {
        from.reader.report_conflicting_key("growth",
                                           "only with the method `domination` do plants grow", {});
    }
    from.reader.finish();
}

void check_names(const SceneValue& list, const Scene& scene, Diagnostics& diagnostics) {
    std::map<std::string_view, std::size_t> first;
    for (std::size_t i = 0; i < scene.species.size(); ++i) {
        const SceneSpecies& species = scene.species[i];
        if (species.name.empty()) {
            continue; // the missing or wrong name has been reported
        }
        const auto [other, is_new] = first.try_emplace(species.name, i);
        if (is_new) {
            continue;
        }
        const auto place = [&](std::size_t index) {
            const SceneEntry* const name = find_entry(list.items[index], "name");
            return name != nullptr ? name->value.span : scene.species[index].grammar.span;
        };
        Diagnostic& error =
            diagnostics.add(DiagnosticCode::ConflictingSceneKeys, place(i),
                            fmt::format("two species have the name `{}`", species.name));
        error.labels.push_back({place(other->second), "the other"});
        error.help.emplace_back("give one of them another `name`");
    }
}

void check_shares(const SceneValue& list, const Scene& scene, Diagnostics& diagnostics) {
    const bool none = std::all_of(scene.placement.species.begin(), scene.placement.species.end(),
                                  [](const PlacementSpecies& one) { return one.share == 0.0; });
    if (none) {
        const SceneEntry* const share = find_entry(list.items.front(), "share");
        diagnostics.add(DiagnosticCode::BadSceneValue, share->value.span,
                        "the shares of all species are 0, so no tree has a species");
    }
}

} // namespace

void read_species_list(const SceneValue& root, Scene& scene, Diagnostics& diagnostics) {
    const SceneEntry* const entry = find_entry(root, "species");
    if (entry == nullptr ||
        (entry->value.kind == SceneValueKind::List && entry->value.items.empty())) {
        const SourceSpan at = entry == nullptr
                                  ? SourceSpan{root.span.file, root.span.begin, root.span.begin}
                                  : entry->value.span;
        diagnostics.add(DiagnosticCode::MissingSceneKey, at, "the scene has no `[[species]]`")
            .help.emplace_back("add one: `[[species]]`, and below it `grammar = \"pine.lsys\"`");
        return;
    }
    const SceneValue& list = entry->value;
    const auto is_table = [](const SceneValue& item) { return item.kind == SceneValueKind::Table; };
    if (list.kind != SceneValueKind::List ||
        !std::all_of(list.items.begin(), list.items.end(), is_table)) {
        Diagnostic& error =
            diagnostics.add(DiagnosticCode::BadSceneValue,
                            list.kind == SceneValueKind::Table ? list.span : entry->value.span,
                            "`species` must be a list of tables");
        error.label = fmt::format("this is {}", kind_text(list.kind));
        error.help.emplace_back("each species begins with `[[species]]`, in two pairs of brackets");
        return;
    }
    if (list.items.size() > kMaxSceneSpecies) {
        diagnostics.add(
            DiagnosticCode::BadSceneValue, list.items[kMaxSceneSpecies].span,
            fmt::format("{} species; a scene has at most {}", list.items.size(), kMaxSceneSpecies));
        return;
    }
    for (const SceneValue& item : list.items) {
        read_one_species(item, scene, diagnostics);
    }
    check_names(list, scene, diagnostics);
    check_shares(list, scene, diagnostics);
}

} // namespace lsys
