#include "viewer/app/plant_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <imgui.h>
#include <numbers>
#include <string>
#include <utility>

namespace lsys::view {

namespace {

constexpr float kLabelWidth = 110.0F;

void line(const std::string& text) {
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
}

/// 1234567: 1,234,567
std::string grouped(std::uint64_t number) {
    std::string digits = fmt::format("{}", number);
    for (std::size_t at = digits.size(); at > 3;) {
        at -= 3;
        digits.insert(at, 1, ',');
    }
    return digits;
}

void draw_numbers(const LiveView& view) {
    line(std::filesystem::path(view.settings.file).filename().string());
    const PlantDocument* const document = view.document();
    if (document == nullptr) {
        line("no plant yet");
        return;
    }
    const lsc::Plant& plant = document->plant;
    line(fmt::format("{} modules, {} segments", grouped(plant.modules),
                     grouped(plant.skeleton.segments.size())));
    line(fmt::format("{} triangles; profile {}", grouped(document->mesh.indices.size() / 3),
                     name_of(document->grammar.bytecode->settings.turtle)));
}

void draw_growth(LiveView& view) {
    LiveSettings& settings = view.settings;
    auto generation = static_cast<int>(view.generations());
    const auto last =
        static_cast<int>(std::max(view.usual_generations(), std::max(view.generations(), 1U)));
    if (ImGui::SliderInt("generation", &generation, 0, last)) {
        settings.generations = static_cast<std::uint32_t>(std::max(generation, 0));
        settings.grows = false;
    }
    if (ImGui::Button(settings.grows ? "pause" : "play")) {
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
    ImGui::SetNextItemWidth(-kLabelWidth);
    ImGui::SliderFloat("a second", &settings.generations_per_second, 0.25F, 20.0F, "%.2f",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    std::uint64_t seed =
        settings.seed.value_or(view.document() == nullptr ? 0 : view.document()->plant.seed);
    ImGui::SetNextItemWidth(-kLabelWidth - 50.0F);
    if (ImGui::InputScalar("##seed", ImGuiDataType_U64, &seed, nullptr, nullptr, nullptr,
                           ImGuiInputTextFlags_EnterReturnsTrue)) {
        settings.seed = seed;
    }
    ImGui::SameLine();
    if (ImGui::Button("next")) {
        next_seed(view);
    }
    ImGui::SameLine();
    line("seed");
}

/// The place among the definitions of what is set here.
std::vector<Definition>::iterator find_definition(LiveSettings& settings, const std::string& name) {
    return std::find_if(settings.definitions.begin(), settings.definitions.end(),
                        [&name](const Definition& one) { return one.name == name; });
}

void draw_constant(LiveSettings& settings, const Constant& constant, const std::string& name) {
    const auto set = find_definition(settings, name);
    const bool is_set = set != settings.definitions.end();
    float value = is_set ? set->value : constant.value;
    ImGui::PushID(name.c_str());
    bool changed = false;
    if (constant.is_drawn && !is_set) {
        // Its value is another one in each run; a user may choose one.
        changed = ImGui::Button("drawn by chance: set");
        value = constant.is_param ? 0.5F * (constant.minimum + constant.maximum) : 0.0F;
        ImGui::SameLine();
    } else if (constant.is_param) {
        changed = ImGui::SliderFloat("##value", &value, constant.minimum, constant.maximum, "%.4g",
                                     ImGuiSliderFlags_AlwaysClamp);
    } else {
        const float speed = std::max(0.01F * std::abs(value), 0.001F);
        changed = ImGui::DragFloat("##value", &value, speed, 0.0F, 0.0F, "%.5g");
    }
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
    if (changed && std::isfinite(value)) {
        if (is_set) {
            set->value = value;
        } else {
            settings.definitions.push_back({name, value});
        }
    }
    ImGui::PopID();
}

void draw_constants(LiveView& view) {
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
                draw_constant(view.settings, constant,
                              std::string(document->grammar.names.text(constant.name)));
            }
        }
    }
}

void draw_look(LiveSettings& settings) {
    if (!ImGui::CollapsingHeader("Look", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    int style = static_cast<int>(settings.style);
    if (ImGui::Combo("style", &style, "surface\0wireframe\0none\0")) {
        settings.style = static_cast<PlantStyle>(style);
    }
    int lines = static_cast<int>(settings.lines);
    if (ImGui::Combo("lines", &lines, "none\0skeleton\0turtle path\0")) {
        settings.lines = static_cast<LineKind>(lines);
    }
    ImGui::Checkbox("shadows", &settings.shadows);
    ImGui::SameLine();
    ImGui::Checkbox("ground", &settings.ground);
    ImGui::SameLine();
    ImGui::Checkbox("smooth", &settings.smooth);
    // The camera's line can be selected, copied and written over.
    static_assert(sizeof(Camera) == 7 * sizeof(float)); // what the line below has room for
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(), "%s", to_text(settings.camera).c_str());
    if (ImGui::InputText("##camera", text.data(), text.size(),
                         ImGuiInputTextFlags_EnterReturnsTrue)) {
        if (const Result<Camera> camera = parse_camera(text.data(), settings.camera)) {
            settings.camera = camera.value();
        }
    }
    ImGui::SameLine();
    if (ImGui::Button("copy camera")) {
        ImGui::SetClipboardText(to_text(settings.camera).c_str());
    }
}

void draw_mesh(LiveSettings& settings) {
    if (!ImGui::CollapsingHeader("Mesh")) {
        return;
    }
    MeshOptions& mesh = settings.mesh;
    int method = static_cast<int>(mesh.method);
    if (ImGui::Combo("method", &method, "tubes\0cylinders\0boxes\0")) {
        mesh.method = static_cast<MeshMethod>(method);
    }
    const auto slide = [](const char* name, std::uint32_t& value, std::uint32_t most,
                          const char* format) {
        constexpr std::uint32_t kLeast = 0;
        ImGui::SliderScalar(name, ImGuiDataType_U32, &value, &kLeast, &most, format,
                            ImGuiSliderFlags_AlwaysClamp);
    };
    constexpr std::uint32_t kMostLevels = 5;
    constexpr std::uint32_t kMostSides = 64;
    slide("level", mesh.level, kMostLevels, "%u");
    slide("sides", mesh.sides, kMostSides, mesh.sides == 0 ? "of the grammar" : "%u");
    // A tube has three sides at least.
    mesh.sides = mesh.sides == 0 ? 0 : std::max(mesh.sides, 3U);
    ImGui::SliderFloat("bark noise", &mesh.bark_noise, 0.0F, 1.0F, "%.2f",
                       ImGuiSliderFlags_AlwaysClamp);
    ImGui::SliderFloat("droop", &mesh.droop, 0.0F, 1.0F, "%.2f", ImGuiSliderFlags_AlwaysClamp);
}

/// A wind by the direction it blows to, in degrees from +X to +Z, and its speed.
void draw_wind(Wind& wind) {
    constexpr float kDegrees = 180.0F / std::numbers::pi_v<float>;
    float speed = std::hypot(wind.velocity.x, wind.velocity.z);
    float direction = speed > 0.0F ? std::atan2(wind.velocity.z, wind.velocity.x) * kDegrees : 0.0F;
    // No wind has no direction: that of the slider is kept by a wind that is next to none.
    constexpr float kLeast = 1e-4F;
    bool changed = ImGui::SliderFloat("wind", &speed, 0.0F, 40.0F, "%.1f m/s");
    changed |= ImGui::SliderFloat("to", &direction, -180.0F, 180.0F, "%.0f deg from +X");
    if (changed) {
        speed = std::max(speed, kLeast);
        wind.velocity = {speed * std::cos(direction / kDegrees), wind.velocity.y,
                         speed * std::sin(direction / kDegrees)};
    }
    ImGui::SliderFloat("gusts", &wind.gust, 0.0F, 2.0F, "%.2f");
}

void draw_bending(LiveSettings& settings) {
    if (!ImGui::CollapsingHeader("Bending", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    PhysicsOptions& forces = settings.bending.forces;
    ImGui::Checkbox("gravity and wind bend it", &settings.bends);
    ImGui::SliderFloat("gravity", &forces.gravity, 0.0F, 30.0F, "%.2f m/s^2");
    draw_wind(forces.wind);
    ImGui::SliderFloat("stiffness", &settings.bending.stiffness, 0.01F, 100.0F, "%.3g times",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    ImGui::SliderFloat("damping", &forces.damping, 0.001F, 1000.0F, "%.3g N m s",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
}

} // namespace

void draw_plant_panel(LiveView& view, PanelState& panels) {
    draw_numbers(view);
    ImGui::PushItemWidth(-kLabelWidth);
    draw_growth(view);
    draw_constants(view);
    draw_look(view.settings);
    draw_mesh(view.settings);
    draw_bending(view.settings);
    ImGui::PopItemWidth();
    ImGui::Separator();
    ImGui::Checkbox("statistics", &panels.statistics);
    ImGui::SameLine();
    if (ImGui::Button("keys (F1)")) {
        panels.help = !panels.help;
    }
    ImGui::SameLine();
    if (ImGui::Button("all in view")) {
        view.frame_all();
    }
}

} // namespace lsys::view
