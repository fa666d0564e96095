// SPDX-License-Identifier: MIT
#include "viewer/app/forest_panel.h"

#include "viewer/app/sense_widgets.h"
#include "viewer/app/widgets.h"

#include <fmt/format.h>
#include <glm/exponential.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <imgui.h>

namespace lsys::view {

namespace {

/// Draws a widget for `edit`, or for `shown` while `edit` is not set. A change sets `edit` and adds
/// a button that resets it.
template <typename Value, typename Draw>
void draw_edit(const char* name, Value shown, std::optional<Value>& edit, const Draw& draw) {
    ImGui::PushID(name);
    Value value = edit.value_or(shown);
    if (draw(value)) {
        edit = value;
    }
    if (edit) {
        ImGui::SameLine();
        if (ImGui::SmallButton("x")) {
            edit.reset();
        }
    }
    ImGui::SameLine();
    line(name);
    ImGui::PopID();
}

void edit_integer(const char* name,
                  std::uint64_t shown,
                  std::optional<std::uint64_t>& edit,
                  std::uint64_t min,
                  std::uint64_t max) {
    draw_edit(name, shown, edit, [&](std::uint64_t& value) {
        const float speed = std::max(0.01F * static_cast<float>(value), 0.2F);
        return ImGui::DragScalar("##value", ImGuiDataType_U64, &value, speed, &min, &max, nullptr,
                                 ImGuiSliderFlags_AlwaysClamp);
    });
}

void edit_integer(const char* name,
                  std::uint32_t shown,
                  std::optional<std::uint32_t>& edit,
                  std::uint32_t min,
                  std::uint32_t max,
                  const char* format = "%u") {
    draw_edit(name, shown, edit, [&](std::uint32_t& value) {
        return ImGui::SliderScalar("##value", ImGuiDataType_U32, &value, &min, &max, format,
                                   ImGuiSliderFlags_AlwaysClamp);
    });
}

void edit_length(const char* name,
                 double shown,
                 std::optional<double>& edit,
                 double min,
                 double max,
                 const char* format) {
    draw_edit(name, shown, edit, [&](double& value) {
        const float speed = std::max(0.01F * static_cast<float>(value), 1e-4F);
        return ImGui::DragScalar("##value", ImGuiDataType_Double, &value, speed, &min, &max, format,
                                 ImGuiSliderFlags_AlwaysClamp);
    });
}

void draw_numbers(const ForestView& view) {
    line(std::filesystem::path(view.path()).filename().string());
    const ForestDocument* const document = view.document();
    if (document == nullptr) {
        line("No forest yet");
        return;
    }
    const Region& region = document->scene.terrain.region;
    const std::optional<StreamStats> streaming = view.stream_stats();
    line(fmt::format("{} trees on {:.0f} x {:.0f} m",
                     grouped(streaming ? tree_count(*document) : view.painting().tree_count()),
                     region.width, region.depth));
    if (streaming) {
        constexpr double kMebibyte = 1'048'576.0;
        line(fmt::format("{} of {} squares, {:.0f} MiB", streaming->shown, streaming->wanted,
                         static_cast<double>(streaming->bytes) / kMebibyte));
    }
    if (document->tallest) {
        line(fmt::format("Tallest placed tree: {:.3g} m", *document->tallest));
    }
    const PlacementReport& placed = document->grown.placed;
    if (placed.refused != 0) {
        line(fmt::format("{} places without a species that grows there", grouped(placed.refused)));
    }
}

void draw_years(ForestView& view) {
    const std::uint32_t default_years = view.default_years();
    if (default_years == 0) {
        return;
    }
    ForestViewSettings& settings = view.settings;
    auto years = static_cast<int>(view.years());
    const bool is_domination =
        view.document() != nullptr &&
        view.document()->scene.placement.method == PlacementMethod::Domination;
    const std::uint32_t max_years = is_domination ? 2 * default_years : default_years;
    if (ImGui::SliderInt(is_domination ? "Years" : "Stages on", &years, 0,
                         static_cast<int>(std::max({max_years, view.years(), 1U})))) {
        view.set_years(static_cast<std::uint32_t>(std::max(years, 0)));
    }
    if (ImGui::Button(settings.plays ? "Pause" : "Play")) {
        view.play_or_pause();
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-label_width());
    ImGui::SliderFloat("Years/s", &settings.years_per_second, 0.5F, 100.0F, "%.1f",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
}

void draw_painting(ForestView& view) {
    if (!ImGui::CollapsingHeader("Painting", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    ForestViewSettings& settings = view.settings;
    Brush& brush = settings.brush;
    constexpr std::array<std::pair<const char*, PaintTool>, 4> kTools = {
        {{"None", PaintTool::None},
         {"Brush", PaintTool::Brush},
         {"Single tree", PaintTool::OneTree},
         {"Eraser", PaintTool::Eraser}}};
    for (std::size_t i = 0; i < kTools.size(); ++i) {
        if (i != 0) {
            ImGui::SameLine();
        }
        if (ImGui::RadioButton(kTools[i].first, settings.tool == kTools[i].second)) {
            settings.tool = kTools[i].second;
        }
    }
    constexpr ImGuiSliderFlags kLogarithmic =
        ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp;
    ImGui::SliderFloat("Radius", &brush.radius, 0.1F, kMaxBrush, "%.1f m", kLogarithmic);
    ImGui::SliderFloat("Density", &brush.density, 0.0001F, 10.0F, "%.4g /m^2", kLogarithmic);
    if (const ForestDocument* const document = view.document()) {
        const std::vector<SceneSpecies>& species = document->scene.species;
        const std::string& name = species[brush.species].name;
        if (ImGui::BeginCombo("Species##brush", name.c_str())) {
            for (std::size_t i = 0; i < species.size(); ++i) {
                if (ImGui::Selectable(species[i].name.c_str(), i == brush.species)) {
                    brush.species = static_cast<std::uint16_t>(i);
                    brush.min_scale = document->scene.placement.species[i].min_scale;
                    brush.max_scale = document->scene.placement.species[i].max_scale;
                }
            }
            ImGui::EndCombo();
        }
    }
    ImGui::DragFloatRange2("Scale", &brush.min_scale, &brush.max_scale, 0.005F, 0.01F, 100.0F,
                           "%.2f", nullptr, ImGuiSliderFlags_AlwaysClamp);
    line(fmt::format("{:>11} painted{}", grouped(view.painting().painted_count()),
                     view.is_unsaved() ? ", not saved" : ""));
}

/// Draws the species; returns the path of a grammar that the user wants to open, or an empty text.
std::string draw_species(ForestView& view) {
    std::string wanted;
    const ForestDocument* const document = view.document();
    if (document == nullptr ||
        !ImGui::CollapsingHeader("Species", ImGuiTreeNodeFlags_DefaultOpen)) {
        return wanted;
    }
    const std::filesystem::path folder = std::filesystem::path(view.path()).parent_path();
    for (std::size_t i = 0; i < document->scene.species.size(); ++i) {
        const SceneSpecies& species = document->scene.species[i];
        const PlacementSpecies& placed = document->scene.placement.species[i];
        // The name of a species may be equal to the title of a section of the panel.
        if (!ImGui::TreeNodeEx(("species " + species.name).c_str(),
                               i < 2 ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None,
                               "%s", species.name.c_str())) {
            continue;
        }
        SpeciesOverrides& edit = view.settings.edits.species[species.name];
        edit_length("Share", placed.share, edit.share, 0.0, 1000.0, "%.3g");
        const auto scale = [](float& value) {
            return ImGui::DragFloat("##value", &value, 0.005F, 0.01F, 100.0F, "%.3g",
                                    ImGuiSliderFlags_AlwaysClamp);
        };
        const auto height = [](float& value) {
            return ImGui::DragFloat("##value", &value, 0.05F, 0.01F, 200.0F, "%.3g m",
                                    ImGuiSliderFlags_AlwaysClamp);
        };
        if (placed.max_height > 0.0F) {
            draw_edit("Height min", placed.min_height, edit.min_height, height);
            draw_edit("Height max", placed.max_height, edit.max_height, height);
        } else {
            draw_edit("Scale min", placed.min_scale, edit.min_scale, scale);
            draw_edit("Scale max", placed.max_scale, edit.max_scale, scale);
        }
        edit_integer("Heroes", species.cache.heroes, edit.heroes, 1U, 50U);
        draw_edit("Reuse (rho)", species.rho, edit.rho, [](float& value) {
            return ImGui::SliderFloat("##value", &value, 0.0F, 1.0F, "%.2f",
                                      ImGuiSliderFlags_AlwaysClamp);
        });
        draw_edit("Senses its surroundings", species.senses_surroundings, edit.senses_surroundings,
                  [](bool& value) { return ImGui::Checkbox("##value", &value); });
        if (ImGui::SmallButton("Show plant")) {
            const std::filesystem::path grammar(species.grammar.path);
            wanted = (view.path() == species.grammar.path ? grammar : folder / grammar).string();
        }
        ImGui::TreePop();
    }
    // Removes species without edits, so that equal edits compare equal.
    std::erase_if(view.settings.edits.species,
                  [](const auto& each) { return each.second == SpeciesOverrides{}; });
    return wanted;
}

void draw_senses(ForestView& view) {
    const ForestDocument* const document = view.document();
    if (document == nullptr || !has_senses(*document) ||
        !ImGui::CollapsingHeader("Senses", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    draw_sense_look(false, view.settings.senses);
    for (std::size_t i = 0; i < document->grown.sensed.size(); ++i) {
        if (document->grown.sensed[i] == nullptr) {
            continue;
        }
        const std::string& name = document->scene.species[i].name;
        const auto edit = view.settings.edits.species.find(name);
        std::vector<EnvironmentMove> moves;
        if (edit != view.settings.edits.species.end()) {
            moves = edit->second.moves;
        }
        const std::vector<EnvironmentMove> before = moves;
        ImGui::PushID(name.c_str());
        for (const SensedPart& part : document->grown.sensed[i]->stages[0].heroes.at(0).parts) {
            draw_environment_move(part.name, part.kind, moves);
        }
        ImGui::PopID();
        if (moves != before) {
            view.settings.edits.species[name].moves = std::move(moves);
        }
    }
}

void draw_placement(ForestView& view) {
    const ForestDocument* const document = view.document();
    if (document == nullptr || !ImGui::CollapsingHeader("Placement")) {
        return;
    }
    SceneOverrides& edits = view.settings.edits;
    const PlacementOptions& placement = document->scene.placement;
    auto method = static_cast<int>(edits.method.value_or(placement.method));
    if (ImGui::Combo("Method", &method,
                     "uniform\0poisson-disk\0density-map\0domination\0jittered\0uniform-cells\0"
                     "poisson-cells\0density-cells\0")) {
        choose_method(edits, static_cast<PlacementMethod>(method), document->scene);
    }
    constexpr std::uint64_t kMaxKeys = ~std::uint64_t{0};
    constexpr double kMaxDistance = 10'000.0;
    if (reads_count(placement.method)) {
        edit_integer("Trees", placement.count, edits.count, 0, kMaxTrees);
    }
    if (reads_spacing(placement.method)) {
        edit_length("Spacing", placement.spacing, edits.spacing, 0.05, kMaxDistance, "%.3g m");
    }
    if (reads_density(placement.method)) {
        edit_length("Trees per m^2", placement.density, edits.density, 1e-6, 100.0, "%.3g");
    }
    edit_integer("Key", placement.key, edits.key, 0, kMaxKeys);
}

void draw_ground(ForestView& view) {
    const ForestDocument* const document = view.document();
    if (document == nullptr || !ImGui::CollapsingHeader("Ground")) {
        return;
    }
    const SceneTerrain& terrain = document->scene.terrain;
    if (terrain.kind == TerrainKind::HeightMap) {
        line("Height map: " + terrain.map.path);
        return;
    }
    SceneOverrides& edits = view.settings.edits;
    int kind = static_cast<int>(edits.terrain.value_or(terrain.kind));
    if (ImGui::Combo("Kind", &kind, "Flat\0Hills\0")) {
        edits.terrain = static_cast<TerrainKind>(kind);
    }
    if (terrain.kind == TerrainKind::Noise) {
        constexpr std::uint64_t kMaxSeeds = ~std::uint64_t{0};
        edit_length("Height", terrain.noise.height, edits.hill_height, 0.0, 5000.0, "%.3g m");
        edit_length("Hill spacing", terrain.noise.feature, edits.hill_spacing, 1.0, 50'000.0,
                    "%.3g m");
        edit_integer("Seed", terrain.noise.seed, edits.hill_seed, 0, kMaxSeeds);
    }
}

void draw_cache(ForestView& view) {
    const ForestDocument* const document = view.document();
    if (document == nullptr || !ImGui::CollapsingHeader("Branch reuse")) {
        return;
    }
    constexpr std::uint32_t kMaxCacheCap = 64;
    edit_integer("Max per key", document->scene.species.front().cache.cap,
                 view.settings.edits.cache_cap, 0U, kMaxCacheCap,
                 document->scene.species.front().cache.cap == 0 ? "no limit" : "%u");
    for (const CacheStats& each : view.stats().caches) {
        line(fmt::format("{}, {} generations:", each.species, each.generations));
        line(fmt::format("  {} heroes, {} branches", each.heroes, grouped(each.branches)));
        line(fmt::format("  {} keys, {} kB", grouped(each.keys), grouped(each.bytes / 1000)));
        line(fmt::format("  {} hits, {} misses", grouped(each.hits), grouped(each.misses)));
        if (each.dropped != 0) {
            line(fmt::format("  {} dropped", grouped(each.dropped)));
        }
    }
}

/// Draws the colours of the legend with their values, several per row.
void draw_legend(const ForestView& view) {
    const std::vector<LegendEntry>& legend = view.legend();
    constexpr std::size_t kMaxShown = 60;
    constexpr std::size_t kInRow = 5;
    const std::size_t shown = std::min(legend.size(), kMaxShown);
    for (std::size_t i = 0; i < shown; ++i) {
        if (i % kInRow != 0) {
            ImGui::SameLine(static_cast<float>(i % kInRow) * 0.19F *
                            ImGui::GetContentRegionAvail().x);
        }
        const glm::vec3 root = glm::sqrt(legend[i].colour); // the display's gamma is about 2
        ImGui::PushID(static_cast<int>(i));
        ImGui::ColorButton("##colour", {root.x, root.y, root.z, 1.0F},
                           ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoPicker,
                           {ImGui::GetFontSize(), ImGui::GetFontSize()});
        ImGui::PopID();
        ImGui::SameLine(0.0F, 4.0F);
        line(fmt::format("{}", legend[i].value));
    }
    if (shown < legend.size()) {
        line(fmt::format("and {} more", legend.size() - shown));
    }
}

void draw_colours(ForestView& view) {
    BranchColours& colours = view.settings.colours;
    if (colours != BranchColours::Natural) {
        ImGui::SetNextItemOpen(true, ImGuiCond_Once);
    }
    if (!ImGui::CollapsingHeader("Colours of branches")) {
        return;
    }
    constexpr std::array<std::pair<const char*, BranchColours>, 4> kChoices = {
        {{"Natural", BranchColours::Natural},
         {"Id", BranchColours::Id},
         {"Age", BranchColours::Age},
         {"Hero", BranchColours::Hero}}};
    for (std::size_t i = 0; i < kChoices.size(); ++i) {
        if (i != 0) {
            ImGui::SameLine();
        }
        if (ImGui::RadioButton(kChoices[i].first, colours == kChoices[i].second)) {
            colours = kChoices[i].second;
        }
    }
    draw_legend(view);
}

/// `scene`: ForestDocument::season. `edit`: the value that the user has set.
void draw_season(const std::optional<float>& scene, std::optional<float>& edit) {
    ImGui::BeginDisabled(!scene);
    draw_edit("Season", scene.value_or(0.0F), edit, [&scene](float& value) {
        const bool changed =
            ImGui::SliderFloat("##value", &value, 0.0F, 1.0F, "%.2f", ImGuiSliderFlags_AlwaysClamp);
        draw_tooltip(scene ? "Time of the year, from March to March; Ctrl+S writes it to the scene"
                           : "No species here has a constant `season` that the scene leaves open");
        return changed;
    });
    ImGui::EndDisabled();
}

void draw_look(ForestView& view) {
    if (!ImGui::CollapsingHeader("Display")) {
        return;
    }
    ForestViewSettings& settings = view.settings;
    ImGui::Checkbox("Shadows", &settings.shadows);
    ImGui::SameLine();
    ImGui::Checkbox("Antialiasing", &settings.antialiasing);
    draw_quality(settings.quality);
    ImGui::SameLine();
    ImGui::Checkbox("Wireframe", &settings.wireframe);
    ImGui::Checkbox("Person", &settings.figure);
    draw_tooltip("A person of 1.8 m where the camera looks (V): a scale, if trees are in metres");
    ImGui::SameLine();
    ImGui::Checkbox("Wind", &settings.windy);
    draw_wind(settings.wind);
    if (view.document() != nullptr) {
        draw_season(view.document()->season, settings.edits.season);
        draw_sun(view.document()->scene.light, settings.light);
        edit_length("Visibility", default_visibility(*view.document()), settings.visibility, 0.01,
                    1e6, "%.3g km");
    }
    constexpr std::uint64_t kMin = 50'000; // with fewer, impostors of near trees would show
    constexpr std::uint64_t kMax = 20'000'000;
    ImGui::SliderScalar("Max triangles", ImGuiDataType_U64, &settings.max_triangles, &kMin, &kMax,
                        nullptr, ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    draw_camera(settings.camera);
}

} // namespace

std::string draw_forest_panel(ForestView& view) {
    draw_numbers(view);
    ImGui::PushItemWidth(-label_width());
    draw_years(view);
    draw_painting(view);
    const std::string wanted = draw_species(view);
    draw_placement(view);
    draw_ground(view);
    draw_cache(view);
    draw_colours(view);
    draw_senses(view);
    draw_look(view);
    ImGui::PopItemWidth();
    return wanted;
}

} // namespace lsys::view
