// SPDX-License-Identifier: MIT
#include "viewer/app/contact_sheet.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/program/host.h"
#include "viewer/app/picture_series.h"
#include "viewer/app/shader_folder.h"
#include "viewer/app/widgets.h"
#include "viewer/gl/headless_context.h"

#include <fmt/format.h>

#include <algorithm>
#include <imgui.h>
#include <sstream>

namespace lsys::view {

namespace {

/// The value of a parameter at step `index`, where `count` equal steps go from its minimum to its
/// maximum.
float value_at(const Constant& param, std::size_t index, std::size_t count) {
    return param.minimum + (param.maximum - param.minimum) * static_cast<float>(index) /
                               static_cast<float>(count - 1);
}

/// Draws the plants of a request one after the other; returns false after an error of OpenGL.
bool draw_plants(const SheetRequest& request, const std::atomic<bool>& cancelled) {
    const Result<std::unique_ptr<HeadlessContext>> context = HeadlessContext::make_without_window();
    if (!context) {
        return false;
    }
    std::istringstream in;
    std::ostringstream out;
    const Console quiet({in, out, out, false, &cancelled, "lsview"}, {});
    const Result<std::unique_ptr<Renderer>> renderer =
        Renderer::make(shaders_of(request.options.shaders, quiet));
    if (!renderer) {
        return false;
    }
    ViewOptions options = request.options;
    for (std::size_t i = 0; i < kSheetCells && !cancelled; ++i) {
        options.grammar.optional_definitions = request.edits.at(i).definitions;
        options.seed = request.edits.at(i).seed;
        const Project project{make_file_host(&cancelled, options.run.files),
                              options.run.limits,
                              options.run.threads,
                              {},
                              options.run.environments,
                              options.run.files};
        const Outcome<std::shared_ptr<const PlantDocument>> plant =
            make_plant_document(options, project);
        if (cancelled) {
            break;
        }
        Texture picture;
        if (plant) {
            Renderer& device = *renderer.value();
            device.show_plant(plant.value()->mesh);
            device.show_lines(make_lines(plant.value()->plant.skeleton, options.lines));
            device.show_senses(plant.value()->plant.sensed == nullptr
                                   ? SenseDrawing{}
                                   : make_sense_drawing(*plant.value()->plant.sensed,
                                                        options.senses, {}, device.bounds()));
            const float aspect =
                static_cast<float>(request.width) / static_cast<float>(request.height);
            const Camera from = with_parts(options.camera, Camera{});
            Frame frame = frame_of(options, framing(from, device.bounds(), aspect));
            frame.width = request.width;
            frame.height = request.height;
            FrameStats stats;
            double milliseconds = 0.0;
            picture = draw_picture(frame, device, stats, milliseconds);
        }
        {
            const std::lock_guard lock(request.pictures->mutex);
            request.pictures->drawn.emplace_back(i, std::move(picture));
        }
        request.wake();
    }
    return renderer.value()->errors().empty();
}

bool run_sheet(const SheetRequest& request, const std::atomic<bool>& cancelled) {
    return catch_out_of_memory([&] { return draw_plants(request, cancelled); },
                               [] { return false; });
}

/// The parameters of the plant that `sheet` varies, in the order of ContactSheet::varied.
std::vector<Constant> varied_params(const ContactSheet& sheet, const Grammar& grammar) {
    std::vector<Constant> params;
    if (grammar.program) {
        for (const std::string& name : sheet.varied) {
            for (const Constant& each : grammar.program->constants) {
                if (each.is_param && grammar.names.text(each.name) == name) {
                    params.push_back(each);
                }
            }
        }
    }
    return params;
}

/// Draws the list in which the user chooses the parameter at index `place` of ContactSheet::varied.
/// Returns whether the choice changed.
bool choose_param(ContactSheet& sheet, const PlantView& view, std::size_t place) {
    const char* const none = place == 0 ? "seeds" : "nothing else";
    const std::string shown = place < sheet.varied.size() ? sheet.varied[place] : none;
    const std::vector<std::string> before = sheet.varied;
    ImGui::SetNextItemWidth(scaled(200.0F));
    if (ImGui::BeginCombo(place == 0 ? "##first" : "##second", shown.c_str())) {
        if (ImGui::Selectable(none, place >= sheet.varied.size())) {
            sheet.varied.resize(place);
        }
        const Grammar& grammar = view.document()->grammar;
        for (const Constant& each : grammar.program->constants) {
            const std::string name(grammar.names.text(each.name));
            const bool is_other = std::find(before.begin(), before.end(), name) != before.end();
            if (each.is_param && (!is_other || name == shown) &&
                ImGui::Selectable(name.c_str(), name == shown)) {
                sheet.varied.resize(std::max(sheet.varied.size(), place + 1));
                sheet.varied[place] = name;
            }
        }
        ImGui::EndCombo();
    }
    return sheet.varied != before;
}

} // namespace

std::array<SheetCell, kSheetCells>
sheet_cells(std::uint64_t seed, const std::vector<Constant>& params, const Names& names) {
    std::array<SheetCell, kSheetCells> cells;
    for (std::size_t i = 0; i < kSheetCells; ++i) {
        SheetCell& cell = cells.at(i);
        if (params.empty()) {
            cell.seed = seed + i;
            cell.label = fmt::format("seed {}", seed + i);
            continue;
        }
        for (std::size_t place = 0; place < std::min<std::size_t>(params.size(), 2); ++place) {
            const std::size_t step = place == 0 ? i % kSheetSide : i / kSheetSide;
            const float value = params.size() == 1 ? value_at(params[0], i, kSheetCells)
                                                   : value_at(params[place], step, kSheetSide);
            const std::string name(names.text(params[place].name));
            cell.definitions.push_back({name, value});
            cell.label += fmt::format("{}{} {:.4g}", place == 0 ? "" : ", ", name, value);
        }
    }
    return cells;
}

SheetSize sheet_cell_size(std::uint32_t window_width, std::uint32_t window_height) {
    constexpr std::uint32_t kBorderWidth = 42;  // width of borders and gaps, pixels
    constexpr std::uint32_t kHeaderHeight = 66; // borders, gaps and the line of text, pixels
    constexpr auto kSide = static_cast<std::uint32_t>(kSheetSide);
    return {std::max(window_width, kBorderWidth + kSide) / kSide - kBorderWidth / kSide,
            std::max(window_height, kHeaderHeight + kSide) / kSide - kHeaderHeight / kSide};
}

void take_cell(const SheetCell& cell, PlantEdits& edits) {
    if (cell.seed) {
        edits.seed = cell.seed;
    }
    for (const Definition& each : cell.definitions) {
        const auto known =
            std::find_if(edits.definitions.begin(), edits.definitions.end(),
                         [&](const Definition& one) { return one.name == each.name; });
        if (known == edits.definitions.end()) {
            edits.definitions.push_back(each);
        } else {
            known->value = each.value;
        }
    }
}

void ContactSheet::show(const PlantView& view,
                        std::uint32_t width,
                        std::uint32_t height,
                        const std::function<void()>& wake) {
    if (view.document() == nullptr) {
        return;
    }
    const Grammar& grammar = view.document()->grammar;
    const std::uint64_t seed = view.settings.seed.value_or(view.document()->plant.seed);
    cells = sheet_cells(seed, varied_params(*this, grammar), grammar.names);
    images = {};
    done = {};
    first_texels_.clear();
    are_alike_ = true;
    pictures_ = std::make_shared<SheetPictures>();
    SheetRequest request;
    for (std::size_t i = 0; i < kSheetCells; ++i) {
        request.edits.at(i) = view.settings;
        take_cell(cells.at(i), request.edits.at(i));
    }
    request.options = view.picture_options(FilmKind::Turntable);
    request.options.samples = 1;
    request.width = std::max(width, 1U);
    request.height = std::max(height, 1U);
    request.pictures = pictures_;
    request.wake = wake;
    request.changed_at = SteadyClock::now();
    if (worker_ == nullptr) {
        worker_ = std::make_unique<LatestRequestWorker<SheetRequest, bool>>(run_sheet, wake);
    }
    worker_->cancel();
    worker_->request(std::move(request));
}

void ContactSheet::close() {
    if (worker_ != nullptr) {
        worker_->cancel();
        static_cast<void>(worker_->take());
    }
    pictures_.reset();
    images = {};
    done = {};
}

bool ContactSheet::has_pictures() const {
    if (pictures_ == nullptr) {
        return false;
    }
    const std::lock_guard lock(pictures_->mutex);
    return !pictures_->drawn.empty();
}

std::vector<std::pair<std::size_t, Texture>> ContactSheet::take() {
    if (worker_ != nullptr) {
        static_cast<void>(worker_->take());
    }
    std::vector<std::pair<std::size_t, Texture>> drawn;
    if (pictures_ != nullptr) {
        const std::lock_guard lock(pictures_->mutex);
        drawn.swap(pictures_->drawn);
    }
    for (const auto& [cell, picture] : drawn) {
        done.at(cell) = true;
        if (first_texels_.empty()) {
            first_texels_ = picture.texels;
        }
        are_alike_ = are_alike_ && picture.texels == first_texels_;
    }
    return drawn;
}

SheetAction draw_contact_sheet(ContactSheet& sheet, const PlantView& view) {
    SheetAction action;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::SetNextWindowSize(size);
    ImGui::SetNextWindowBgAlpha(1.0F);
    if (ImGui::Begin("Contact sheet", nullptr,
                     ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoScrollbar)) {
        line("Contact sheet of");
        ImGui::SameLine();
        if (view.document() != nullptr && view.document()->grammar.program) {
            action.varies = choose_param(sheet, view, 0);
            if (!sheet.varied.empty()) {
                ImGui::SameLine();
                action.varies = choose_param(sheet, view, 1) || action.varies;
            }
        } else {
            line("seeds");
        }
        ImGui::SameLine();
        action.closes = ImGui::Button("Close (Esc)");
        ImGui::SameLine();
        const bool are_done =
            std::all_of(sheet.done.begin(), sheet.done.end(), [](bool is_done) { return is_done; });
        if (are_done && sheet.are_alike()) {
            line("All nine are alike: choose a constant from the list");
        } else {
            ImGui::TextDisabled("Arrow keys and Enter, or a click, take a plant");
        }
        const ImVec2 room = ImGui::GetContentRegionAvail();
        const ImVec2 gap = ImGui::GetStyle().ItemSpacing;
        constexpr auto kSide = static_cast<float>(kSheetSide);
        const ImVec2 cell{room.x / kSide - gap.x, room.y / kSide - gap.y};
        for (std::size_t i = 0; i < kSheetCells; ++i) {
            if (i % kSheetSide != 0) {
                ImGui::SameLine();
            }
            const ImVec2 corner = ImGui::GetCursorScreenPos();
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable("##cell", false, 0, cell)) {
                action.chosen_cell = i;
            }
            if (i == 0) {
                ImGui::SetItemDefaultFocus();
            }
            ImGui::PopID();
            ImDrawList& list = *ImGui::GetWindowDrawList();
            constexpr float kBorder = 3.0F;
            if (sheet.images.at(i) != 0) {
                // ImTextureID is a pointer type whose value is the number of the texture.
                list.AddImage(reinterpret_cast<ImTextureID>(sheet.images.at(i)), // NOLINT
                              {corner.x + kBorder, corner.y + kBorder},
                              {corner.x + cell.x - kBorder, corner.y + cell.y - kBorder});
            }
            const std::string text = sheet.cells.at(i).label + (sheet.images.at(i) != 0 ? ""
                                                                : sheet.done.at(i) ? ": no plant"
                                                                                   : " ...");
            const ImVec2 place{corner.x + 2.0F * kBorder, corner.y + 2.0F * kBorder};
            const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
            list.AddRectFilled(place, {place.x + extent.x, place.y + extent.y},
                               IM_COL32(0, 0, 0, 140));
            list.AddText(place, IM_COL32(255, 255, 255, 255), text.c_str());
        }
    }
    ImGui::End();
    return action;
}

} // namespace lsys::view
