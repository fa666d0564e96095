// SPDX-License-Identifier: MIT
#include "viewer/app/plant_panel.h"

#include "runtime/pipeline/constant_text.h"
#include "runtime/pipeline/setting_controls.h"
#include "viewer/app/sense_widgets.h"
#include "viewer/app/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <imgui.h>
#include <optional>
#include <string>
#include <utility>

namespace lsys::view {

namespace {

void draw_numbers(const PlantView& view) {
    line(std::filesystem::path(view.settings.file).filename().string());
    const PlantDocument* const document = view.document();
    if (document == nullptr) {
        line("No plant yet");
        line("");
        line("");
        return;
    }
    // Numbers of fixed width in a fixed number of lines, so that nothing moves while the plant
    // grows.
    const FilmMoment* const grown = view.grown();
    const std::uint64_t modules = grown != nullptr ? grown->modules : document->plant.modules;
    const Skeleton& skeleton = grown != nullptr ? grown->skeleton : document->plant.skeleton;
    const Mesh& mesh = grown != nullptr ? grown->mesh : document->mesh;
    const auto row = [](std::uint64_t count, const char* what, const std::string& beside) {
        line(fmt::format("{:>13} {:<9}  {}", grouped(count), what, beside));
    };
    row(modules, "modules",
        grown == nullptr
            ? fmt::format("{:.4g} m high", document->height)
            : fmt::format("generation {:5.2f}",
                          static_cast<double>(grown->moment.generation) + grown->moment.fraction));
    row(skeleton.segments.size(), "segments", "");
    row(mesh.indices.size() / 3, "triangles",
        fmt::format("turtle {}", name_of(document->grammar.bytecode.settings.turtle)));
}

void draw_growth(PlantView& view) {
    PlantViewSettings& settings = view.settings;
    auto generation = static_cast<int>(view.generations());
    const auto last =
        static_cast<int>(std::max(view.default_generations(), std::max(view.generations(), 1U)));
    if (ImGui::SliderInt("Generation", &generation, 0, last)) {
        settings.generations = static_cast<std::uint32_t>(std::max(generation, 0));
        settings.plays = false;
    }
    if (ImGui::Button(settings.plays ? "Pause" : "Play")) {
        view.play_or_pause();
    }
    ImGui::SameLine();
    if (ImGui::Button("-")) {
        step_generations(view, -1);
    }
    ImGui::SameLine();
    if (ImGui::Button("+")) {
        step_generations(view, 1);
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-label_width());
    ImGui::SliderFloat("Generations/s", &settings.generations_per_second, 0.25F, 20.0F, "%.2f",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    std::uint64_t seed =
        settings.seed.value_or(view.document() == nullptr ? 0 : view.document()->plant.seed);
    ImGui::SetNextItemWidth(-label_width() - scaled(50.0F));
    if (ImGui::InputScalar("##seed", ImGuiDataType_U64, &seed, nullptr, nullptr, nullptr,
                           ImGuiInputTextFlags_EnterReturnsTrue)) {
        settings.seed = seed;
    }
    ImGui::SameLine();
    if (ImGui::Button("Next")) {
        next_seed(view);
    }
    ImGui::SameLine();
    line("Seed");
}

/// Finds the value that the user has set for the constant `name`; end() if there is none.
std::vector<Definition>::iterator find_definition(PlantViewSettings& settings,
                                                  const std::string& name) {
    return std::find_if(settings.definitions.begin(), settings.definitions.end(),
                        [&name](const Definition& one) { return one.name == name; });
}

void draw_constant(PlantViewSettings& settings, const Constant& constant, const Grammar& grammar) {
    const std::string name(grammar.names.text(constant.name));
    const auto set = find_definition(settings, name);
    const bool is_set = set != settings.definitions.end();
    float value = is_set ? set->value : constant.value;
    ImGui::PushID(name.c_str());
    bool changed = false;
    if (constant.is_random && !is_set) {
        // The constant is random in each run unless the user sets its value.
        changed = ImGui::Button("Random: set");
        value = constant.is_param ? 0.5F * (constant.minimum + constant.maximum) : 0.0F;
        ImGui::SameLine();
    } else if (constant.is_param) {
        changed = ImGui::SliderFloat("##value", &value, constant.minimum, constant.maximum, "%.4g",
                                     ImGuiSliderFlags_AlwaysClamp);
    } else {
        const float speed = std::max(0.01F * std::abs(value), 0.001F);
        changed = ImGui::DragFloat("##value", &value, speed, 0.0F, 0.0F, "%.5g");
    }
    const bool is_pointed = is_pointed_at();
    ImGui::SameLine();
    if (is_set) {
        if (ImGui::SmallButton("x")) {
            settings.definitions.erase(set);
            ImGui::PopID();
            return;
        }
        ImGui::SameLine();
    }
    line(name);
    if (is_pointed || is_pointed_at()) {
        set_tooltip(describe_constant(constant, grammar, is_set));
    }
    if (changed && std::isfinite(value)) {
        if (is_set) {
            set->value = value;
        } else {
            settings.definitions.push_back({name, value});
        }
    }
    ImGui::PopID();
}

void draw_constants(PlantView& view) {
    const PlantDocument* const document = view.document();
    if (document == nullptr || !document->grammar.program) {
        return;
    }
    const Program& program = *document->grammar.program;
    if (program.constants.empty() ||
        !ImGui::CollapsingHeader("Constants", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    for (const bool params : {true, false}) {
        for (const Constant& constant : program.constants) {
            if (constant.is_param == params) {
                draw_constant(view.settings, constant, document->grammar);
            }
        }
    }
}

/// Draws the control of a setting that consists of numbers; returns whether they changed.
bool edit_numbers(const SettingControl& control, std::array<float, 4>& numbers) {
    if (control.kind == SettingKind::Vector) {
        return ImGui::SliderFloat4("##value", numbers.data(), control.min, control.max, "%.3g");
    }
    float& value = numbers[0];
    bool changed = false;
    const char* const format = control.kind == SettingKind::Count ? "%.0f" : "%.5g";
    if (control.min < control.max) {
        changed = ImGui::SliderFloat("##value", &value, control.min, control.max, format);
    } else {
        const float speed =
            control.kind == SettingKind::Count ? 1.0F : std::max(0.01F * std::abs(value), 0.001F);
        changed = ImGui::DragFloat("##value", &value, speed, 0.0F, 0.0F, format);
    }
    value = control.kind == SettingKind::Count ? std::round(value) : value;
    value = std::clamp(value, control.lowest, control.highest);
    return changed;
}

/// Draws the control of a setting; returns the new text of its values, or nullopt if unchanged.
std::optional<std::string> edit_setting(const SettingControl& control, const SettingText* set) {
    if (control.kind == SettingKind::Word) {
        std::optional<std::string> chosen;
        const std::string shown = set != nullptr ? set->values : std::string(control.word);
        if (ImGui::BeginCombo("##value", shown.c_str())) {
            for (const std::string_view word : control.words) {
                if (ImGui::Selectable(std::string(word).c_str(), word == shown)) {
                    chosen = word;
                }
            }
            ImGui::EndCombo();
        }
        return chosen;
    }
    const std::size_t count = control.kind == SettingKind::Vector ? 4 : 1;
    std::array<float, 4> numbers = control.numbers;
    if (set != nullptr) {
        numbers = numbers_of(set->values, count).value_or(numbers);
    }
    if (!edit_numbers(control, numbers) ||
        !std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); })) {
        return std::nullopt;
    }
    return setting_text({numbers.data(), count});
}

void draw_setting(PlantViewSettings& settings, const SettingControl& control) {
    const auto set = std::find_if(settings.set_values.begin(), settings.set_values.end(),
                                  [&](const SettingText& one) { return one.key == control.key; });
    const bool is_set = set != settings.set_values.end();
    const std::string key(control.key);
    ImGui::PushID(key.c_str());
    const std::optional<std::string> edited = edit_setting(control, is_set ? &*set : nullptr);
    const bool is_pointed = is_pointed_at();
    ImGui::SameLine();
    bool is_reset = false;
    if (is_set) {
        is_reset = ImGui::SmallButton("x");
        ImGui::SameLine();
    }
    line(key);
    if (is_pointed || is_pointed_at()) {
        set_tooltip(
            fmt::format("#set {}{}{}", key, control.accepts.empty() ? "" : ": ", control.accepts));
    }
    ImGui::PopID();
    if (is_reset) {
        settings.set_values.erase(set);
    } else if (edited && is_set) {
        set->values = *edited;
    } else if (edited) {
        settings.set_values.push_back({key, *edited});
    }
}

void draw_settings(PlantView& view) {
    const PlantDocument* const document = view.document();
    if (document == nullptr) {
        return;
    }
    ImGui::SetNextItemOpen(!view.settings.set_values.empty(), ImGuiCond_Once);
    if (!ImGui::CollapsingHeader("Settings")) {
        return;
    }
    for (const SettingControl& control : setting_controls(document->grammar)) {
        draw_setting(view.settings, control);
    }
}

void draw_look(PlantViewSettings& settings) {
    if (!ImGui::CollapsingHeader("Display", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    int style = static_cast<int>(settings.style);
    if (ImGui::Combo("Draw", &style, "Surface\0Wireframe\0None\0")) {
        settings.style = static_cast<PlantStyle>(style);
    }
    int lines = static_cast<int>(settings.lines);
    if (ImGui::Combo("Lines", &lines, "None\0Skeleton\0Turtle path\0")) {
        settings.lines = static_cast<LineKind>(lines);
    }
    if (settings.lines != LineKind::None) {
        ImGui::Checkbox("Dim surfaces", &settings.dims);
    }
    ImGui::Checkbox("Shadows", &settings.shadows);
    ImGui::SameLine();
    ImGui::Checkbox("Ground", &settings.ground);
    ImGui::SameLine();
    ImGui::Checkbox("Antialiasing", &settings.antialiasing);
    draw_quality(settings.quality);
    ImGui::Checkbox("Person", &settings.figure);
    draw_tooltip("A person of 1.8 m beside the plant (V): a scale, if the plant is in metres");
    draw_sun({}, settings.light);
    draw_camera(settings.camera);
}

void draw_senses(PlantView& view) {
    const PlantDocument* const document = view.document();
    if (document == nullptr || document->grammar.bytecode.environments.empty() ||
        document->plant.sensed == nullptr ||
        !ImGui::CollapsingHeader("Senses", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    draw_sense_look(true, view.settings.senses);
    for (const BytecodeEnvironment& environment : document->grammar.bytecode.environments) {
        draw_environment_move(environment.name, environment.kind, view.settings.moves);
    }
}

/// `default_droop`: droop of the plant's leaves if the user does not set it.
void draw_mesh(PlantViewSettings& settings, float default_droop) {
    if (!ImGui::CollapsingHeader("Mesh")) {
        return;
    }
    MeshOptions& mesh = settings.mesh;
    int method = static_cast<int>(mesh.method);
    if (ImGui::Combo("Method", &method, "Default\0Tubes\0Cylinders\0Boxes\0Solid\0")) {
        mesh.method = static_cast<MeshMethod>(method);
    }
    const auto slide = [](const char* name, std::uint32_t& value, std::uint32_t max,
                          const char* format) {
        constexpr std::uint32_t kMin = 0;
        ImGui::SliderScalar(name, ImGuiDataType_U32, &value, &kMin, &max, format,
                            ImGuiSliderFlags_AlwaysClamp);
    };
    constexpr std::uint32_t kMaxLevels = 5;
    constexpr std::uint32_t kMaxSides = 64;
    slide("Level", mesh.level, kMaxLevels, "%u");
    slide("Sides", mesh.sides, kMaxSides, mesh.sides == 0 ? "from grammar" : "%u");
    // A tube has at least three sides.
    mesh.sides = mesh.sides == 0 ? 0 : std::max(mesh.sides, 3U);
    ImGui::SliderFloat("Bark noise", &mesh.bark_noise, 0.0F, 1.0F, "%.2f",
                       ImGuiSliderFlags_AlwaysClamp);
    ImGui::SliderFloat("Grooves", &mesh.grooves, 0.0F, 1.0F, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    constexpr std::uint32_t kMaxSubdivisions = 5;
    std::uint32_t subdivisions = mesh.subdivisions.value_or(kSubdivisions);
    if (mesh.method == MeshMethod::Boxes) {
        const std::uint32_t before = subdivisions;
        slide("Subdivisions", subdivisions, kMaxSubdivisions, "%u");
        if (subdivisions != before) {
            mesh.subdivisions = subdivisions;
        }
    }
    float droop = mesh.droop.value_or(default_droop);
    if (ImGui::SliderFloat("Droop", &droop, 0.0F, 1.0F, "%.2f", ImGuiSliderFlags_AlwaysClamp)) {
        mesh.droop = droop;
    }
    if (mesh.method == MeshMethod::Tubes) {
        ImGui::Checkbox("Smooth joints", &mesh.smooth_joints);
    }
}

void draw_bending(PlantViewSettings& settings) {
    if (!ImGui::CollapsingHeader("Bending", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    PhysicsOptions& forces = settings.bending.forces;
    ImGui::Checkbox("Simulate", &settings.simulates);
    ImGui::SliderFloat("Gravity", &forces.gravity, 0.0F, 30.0F, "%.2f m/s^2");
    draw_wind(forces.wind);
    // Ten decades, from sagging trees to rigid stalks. ImGui derives the min of a logarithmic
    // slider from the number of digits in its format.
    ImGui::SliderFloat("Stiffness", &settings.bending.stiffness, 1e-5F, 1e5F, "x%.6g",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    ImGui::SliderFloat("Damping", &forces.damping, 0.001F, 1000.0F, "%.3g N m s/rad",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
}

} // namespace

void draw_plant_panel(PlantView& view) {
    draw_numbers(view);
    ImGui::PushItemWidth(-label_width());
    draw_growth(view);
    draw_constants(view);
    draw_settings(view);
    draw_senses(view);
    draw_look(view.settings);
    draw_mesh(view.settings,
              view.document() == nullptr ? 0.0F : view.document()->plant.skeleton.leaf_droop);
    draw_bending(view.settings);
    ImGui::PopItemWidth();
}

} // namespace lsys::view
