// SPDX-License-Identifier: MIT
#include "viewer/app/start_page.h"

#include "grammar/base/paths.h"
#include "runtime/program/files.h"
#include "viewer/app/recent_files.h"
#include "viewer/app/widgets.h"

#include <algorithm>
#include <imgui.h>

namespace lsys::view {

namespace {

constexpr std::uint32_t kThumbnailSide = 180; // pixels
constexpr float kColumnWidth = 300.0F;        // width of the list of recent files, pixels
constexpr std::uint64_t kMaxPictureBytes = 16ULL << 20U; // max size of a picture file

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoTitleBar;

/// Uploads the picture of the next sample that has none yet.
void load_image(StartPage& page, const AddImage& add_image) {
    if (!is_loading(page)) {
        return;
    }
    const std::string& picture = page.samples[page.images.size()].picture;
    const Result<std::string> bytes =
        picture.empty() ? Result<std::string>(std::string())
                        : read_bytes(picture, FileKind::Regular, {kMaxPictureBytes}, nullptr);
    page.images.push_back(
        bytes && add_image ? add_image(thumbnail_of(bytes.value(), kThumbnailSide)) : 0);
}

/// Scrolls to the item drawn last if the keyboard has selected it.
void scroll_to_selection(StartPage& page, bool is_selected) {
    if (is_selected && page.wants_scroll) {
        ImGui::SetScrollHereY();
        page.wants_scroll = false;
    }
}

std::string draw_recent(StartPage& page) {
    std::string chosen;
    for (std::size_t i = 0; i < page.recent.size(); ++i) {
        const std::string& file = page.recent[i];
        const bool is_selected = page.in_recent && page.selected == i;
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable(std::string(name_of_path(file)).c_str(), is_selected)) {
            chosen = file;
        }
        scroll_to_selection(page, is_selected);
        draw_tooltip(file.c_str());
        ImGui::PopID();
    }
    if (page.recent.empty()) {
        ImGui::TextDisabled("None yet");
    }
    return chosen;
}

/// Draws a sample: picture, name and title. Returns whether it was clicked.
bool draw_sample(const GallerySample& sample, std::uintptr_t image, float side, bool is_selected) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float line_height = ImGui::GetTextLineHeight();
    const ImVec2 size{side, side + 2.0F * line_height};
    const bool is_clicked = ImGui::Selectable("##sample", is_selected, 0, size);
    if (ImGui::IsItemHovered() && !sample.title.empty()) {
        set_tooltip(sample.title);
    }
    if (!ImGui::IsItemVisible()) {
        return is_clicked;
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end{corner.x + side, corner.y + side};
    if (image != 0) {
        // ImTextureID is a pointer type whose value is the number of the texture.
        list.AddImage(reinterpret_cast<ImTextureID>(image), corner, end); // NOLINT
    } else {
        list.AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg));
    }
    const ImVec4 clip{corner.x, corner.y, end.x, corner.y + size.y};
    const auto text = [&](const std::string& words, float row, ImGuiCol colour) {
        list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {corner.x, end.y + row * line_height},
                     ImGui::GetColorU32(colour), words.c_str(), nullptr, 0.0F, &clip);
    };
    text(sample.name, 0.0F, ImGuiCol_Text);
    text(sample.title, 1.0F, is_selected ? ImGuiCol_Text : ImGuiCol_TextDisabled);
    return is_clicked;
}

std::string draw_gallery(StartPage& page) {
    std::string chosen;
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float side = static_cast<float>(kThumbnailSide);
    page.columns = static_cast<std::size_t>(
        std::max((ImGui::GetContentRegionAvail().x + gap) / (side + gap), 1.0F));
    for (std::size_t i = 0; i < page.samples.size(); ++i) {
        if (i % page.columns != 0) {
            ImGui::SameLine();
        }
        const bool is_selected = !page.in_recent && page.selected == i;
        ImGui::PushID(static_cast<int>(i));
        if (draw_sample(page.samples[i], i < page.images.size() ? page.images[i] : 0, side,
                        is_selected)) {
            chosen = page.samples[i].file;
        }
        scroll_to_selection(page, is_selected);
        ImGui::PopID();
    }
    return chosen;
}

} // namespace

void StartPage::load(const std::string& state, const std::string& folder) {
    recent = recent_files(state);
    samples_folder = folder;
    samples = find_samples(folder);
    images.clear();
    in_recent = !recent.empty();
    selected = 0;
    is_loaded = true;
}

void StartPage::move(int right, int down) {
    wants_scroll = true;
    letters.clear();
    const bool at_edge = selected % columns == 0;
    if (in_recent ? right > 0 && !samples.empty() : right < 0 && at_edge && !recent.empty()) {
        in_recent = !in_recent;
        selected = 0;
        return;
    }
    const auto count = static_cast<std::ptrdiff_t>(in_recent ? recent.size() : samples.size());
    const std::ptrdiff_t wanted =
        static_cast<std::ptrdiff_t>(selected) +
        (in_recent ? down : right + down * static_cast<std::ptrdiff_t>(columns));
    if (wanted >= 0 && wanted < count) {
        selected = static_cast<std::size_t>(wanted);
    }
}

void StartPage::find(const std::string& text) {
    if (text.empty()) {
        return;
    }
    const auto select = [this](const std::string& part, std::size_t first) {
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const std::size_t number = (first + i) % samples.size();
            if (samples[number].name.find(part) != std::string::npos) {
                selected = number;
                in_recent = false;
                wants_scroll = true;
                return true;
            }
        }
        return false;
    };
    letters += text;
    if (!select(letters, 0)) {
        letters = text;
        select(letters, in_recent ? 0 : selected + 1);
    }
}

std::string StartPage::selected_file() const {
    if (in_recent) {
        return selected < recent.size() ? recent[selected] : std::string();
    }
    return selected < samples.size() ? samples[selected].file : std::string();
}

bool is_loading(const StartPage& page) {
    return page.is_loaded && page.images.size() < page.samples.size();
}

std::string draw_start_page(StartPage& page, const AddImage& add_image, bool& wants_dialog) {
    load_image(page, add_image);
    std::string chosen;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::SetNextWindowSize(size);
    if (ImGui::Begin("Start", nullptr, kFixed | ImGuiWindowFlags_NoBringToFrontOnFocus)) {
        if (ImGui::BeginChild("Files", {scaled(kColumnWidth), 0.0F})) {
            wants_dialog = ImGui::Button("Open a file (Ctrl+O)");
            ImGui::TextDisabled("or drop it on the window");
            ImGui::Separator();
            line("Recent files");
            chosen = draw_recent(page);
        }
        ImGui::EndChild();
        ImGui::SameLine();
        if (ImGui::BeginChild("Gallery")) {
            if (page.samples.empty()) {
                ImGui::TextWrapped("No samples are installed. They are searched for in "
                                   "share/lsc/samples beside lsview, and in the data folders of "
                                   "the system.");
            } else {
                line("Samples: arrow keys, letters and Enter, or a click (F1: keys)");
                const std::string sample = draw_gallery(page);
                chosen = sample.empty() ? chosen : sample;
            }
        }
        ImGui::EndChild();
    }
    ImGui::End();
    return chosen;
}

std::string draw_open_dialog(FileBrowser& browser, bool& is_open) {
    std::string chosen;
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    constexpr float kPart = 0.7F; // size of the dialog as a fraction of the window
    ImGui::SetNextWindowPos({0.5F * all.x, 0.5F * all.y}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({kPart * all.x, kPart * all.y});
    ImGui::SetNextWindowFocus();
    if (ImGui::Begin("Open a file", &is_open,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize)) {
        if (ImGui::Button("Up (Alt+Up)")) {
            browser.go_up();
        }
        ImGui::SameLine();
        if (ImGui::Button("Home (Alt+Home)")) {
            browser.go_home();
        }
        ImGui::SameLine();
        line(browser.folder());
        line("Name or path: " + browser.text() + '_');
        const float below = 2.0F * ImGui::GetFrameHeightWithSpacing();
        if (ImGui::BeginChild("Entries", {0.0F, -below}, true)) {
            for (std::size_t i = 0; i < browser.entries().size(); ++i) {
                const FolderEntry entry = browser.entries()[i];
                const bool is_selected = i == browser.selected();
                if (ImGui::Selectable((entry.name + (entry.is_folder ? "/" : "")).c_str(),
                                      is_selected, ImGuiSelectableFlags_AllowDoubleClick)) {
                    browser.select(i);
                    if (entry.is_folder || ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
                        chosen = browser.accept();
                        break;
                    }
                }
                if (is_selected && browser.take_scroll_request()) {
                    ImGui::SetScrollHereY();
                }
            }
        }
        ImGui::EndChild();
        line(browser.mistake().empty() ? "Type to filter, or a path; Tab completes it"
                                       : browser.mistake());
        if (ImGui::Button("Open (Enter)")) {
            chosen = browser.accept();
        }
        ImGui::SameLine();
        if (ImGui::Button("Cancel (Esc)")) {
            is_open = false;
        }
    }
    ImGui::End();
    return chosen;
}

} // namespace lsys::view
