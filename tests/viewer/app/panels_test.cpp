// SPDX-License-Identifier: MIT
// Panels and dialogs drawn without a window: ids and places of their widgets, and the way of the
// keyboard through them.
#include "tests/support/lsc_run.h"
#include "tests/viewer/lsview_run.h"
#include "viewer/app/panels.h"
#include "viewer/gl/headless_context.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <imgui.h>
#include <imgui_internal.h>
#include <map>
#include <set>
#include <sstream>
#include <thread>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;
using namespace std::chrono_literals;

namespace {

struct Widget {
    ImGuiWindow* window = nullptr;
    ImGuiID id = 0;
    ImRect place;
    bool is_used = false; // it can have the keyboard
};

std::vector<Widget>* drawn_widgets = nullptr; // of the frame being drawn; null: not recorded

} // namespace

// The linker option --wrap redirects ImGui's calls of ImGui::ItemAdd() to `__wrap_...`; `__real_...`
// is the original.
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
bool __real__ZN5ImGui7ItemAddERK6ImRectjPS1_i(const ImRect& place,
                                              ImGuiID id,
                                              const ImRect* nav_place,
                                              ImGuiItemFlags flags);
bool __wrap__ZN5ImGui7ItemAddERK6ImRectjPS1_i(const ImRect& place,
                                              ImGuiID id,
                                              const ImRect* nav_place,
                                              ImGuiItemFlags flags) {
    if (drawn_widgets != nullptr && id != 0) {
        const ImGuiContext& context = *ImGui::GetCurrentContext();
        const ImGuiItemFlags all = context.CurrentItemFlags | flags;
        drawn_widgets->push_back({context.CurrentWindow, id, place,
                                  (all & (ImGuiItemFlags_Disabled | ImGuiItemFlags_NoNav)) == 0});
    }
    return __real__ZN5ImGui7ItemAddERK6ImRectjPS1_i(place, id, nav_place, flags);
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
}

namespace {

/// The panels of a window of 1280 by 720 pixels that shows a file, without the window.
class DrawnPanels {
public:
    explicit DrawnPanels(const ViewOptions& options)
        : context_(std::move(HeadlessContext::make().value())),
          console_({in_, out_, err_, false, nullptr, "lsview"}, options.messages),
          renderer_(std::move(Renderer::make(built_in_shader).value())),
          switcher(options, console_, *renderer_, [] {}) {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {1280.0F, 720.0F};
        io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
        for (int key = 0; key < ImGuiKey_COUNT; ++key) {
            io.KeyMap[key] = key;
        }
        unsigned char* texels = nullptr;
        int width = 0;
        int height = 0;
        io.Fonts->GetTexDataAsRGBA32(&texels, &width, &height);
        panels.wake = [] {};
    }
    DrawnPanels(const DrawnPanels&) = delete;
    DrawnPanels& operator=(const DrawnPanels&) = delete;
    ~DrawnPanels() { ImGui::DestroyContext(); }

    void frame() {
        switcher.current().update();
        switcher.current().draw(64, 48);
        widgets.clear();
        drawn_widgets = &widgets;
        ImGui::NewFrame();
        draw_panels(switcher, panels, 1.0F);
        if (draw_more) {
            draw_more();
        }
        ImGui::Render();
        drawn_widgets = nullptr;
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i) {
            frame();
        }
    }
    template <typename Condition>
    bool until(Condition&& done) {
        for (const auto start = SteadyClock::now(); SteadyClock::now() - start < 60s;) {
            frame();
            if (done()) {
                return true;
            }
            std::this_thread::sleep_for(1ms);
        }
        return false;
    }
    /// Draws with all sections and tree nodes open.
    void open_all() {
        for (int depth = 0; depth < 4; ++depth) {
            frame();
            for (const Widget& each : widgets) {
                each.window->StateStorage.SetInt(each.id, 1);
            }
        }
        frame();
    }
    /// Presses and releases a key of the panels.
    void press(ImGuiKey key) {
        ImGuiIO& io = ImGui::GetIO();
        io.KeysDown[key] = true;
        if (key == ImGuiKey_Enter) { // as Window::begin_panels() does
            io.NavInputs[ImGuiNavInput_Activate] = 1.0F;
        }
        frame();
        io.KeysDown[key] = false;
        io.NavInputs[ImGuiNavInput_Activate] = 0.0F;
        frames(2);
    }
    /// Presses a key that the panels do not receive.
    void press_outside(const KeyPress& press) {
        WindowInput input;
        input.presses = {press};
        input.has_events = true;
        controls.apply(input, 0.0, {340, 0, 940, 720}, switcher, panels);
        frames(3);
    }
    /// Descriptions of the ids that more than one widget has.
    std::vector<std::string> twins() const {
        std::map<ImGuiID, int> counts;
        std::vector<std::string> found;
        for (const Widget& each : widgets) {
            if (++counts[each.id] == 2) {
                found.push_back(fmt::format("{:#x} in {}, at {}, {}", each.id, each.window->Name,
                                            each.place.Min.x, each.place.Min.y));
            }
        }
        return found;
    }
    /// The widgets of a window that can have the keyboard but that arrow keys do not reach.
    /// Precondition: the window has the keyboard.
    std::vector<std::string> unreached(const char* name) {
        const ImGuiContext& context = *ImGui::GetCurrentContext();
        for (ImGuiID last = 0; last != context.NavId;) {
            last = context.NavId;
            press(ImGuiKey_UpArrow);
        }
        std::set<ImGuiID> reached{context.NavId};
        while (true) {
            // To the end of the row, and back to its start. The left arrow would close a section.
            const ImGuiID first = context.NavId;
            const ImRect place = context.NavWindow->NavRectRel[0];
            for (ImGuiID last = 0; last != context.NavId;) {
                last = context.NavId;
                press(ImGuiKey_RightArrow);
                reached.insert(context.NavId);
            }
            ImGui::SetNavID(first, ImGuiNavLayer_Main, 0, place);
            press(ImGuiKey_DownArrow);
            reached.insert(context.NavId);
            if (context.NavId == first) {
                break;
            }
        }
        std::vector<std::string> missed;
        for (const Widget& each : widgets) {
            if (each.is_used && std::string(each.window->Name) == name &&
                reached.count(each.id) == 0) {
                missed.push_back(
                    fmt::format("{:#x} at {}, {}", each.id, each.place.Min.x, each.place.Min.y));
            }
        }
        return missed;
    }
    static std::string focused_window() {
        const ImGuiContext& context = *ImGui::GetCurrentContext();
        return context.NavWindow == nullptr || context.NavDisableHighlight
                   ? std::string()
                   : context.NavWindow->RootWindow->Name;
    }
    /// Whether all widgets of a window are inside it, and the window inside the display.
    bool shows_all_of(const std::string& name) const {
        const ImRect display({0.0F, 0.0F}, ImGui::GetIO().DisplaySize);
        bool any = false;
        for (const Widget& each : widgets) {
            if (each.window->Name == name) {
                any = true;
                if (!each.window->Rect().Contains(each.place) || !display.Contains(each.place)) {
                    return false;
                }
            }
        }
        return any;
    }

private:
    std::unique_ptr<HeadlessContext> context_;
    std::istringstream in_;
    std::ostringstream out_;
    std::ostringstream err_;
    Console console_;
    std::unique_ptr<Renderer> renderer_;

public:
    ViewSwitcher switcher;
    PanelState panels;
    Controls controls;
    std::vector<Widget> widgets; // of the last frame
    std::function<void()> draw_more;
};

ViewOptions panel_options(const std::string& file, bool is_forest = false) {
    ViewOptions options;
    options.file = file;
    if (!file.empty()) {
        options.files = {file};
    }
    options.is_forest = is_forest;
    options.run.limits.max_modules = std::uint64_t{1} << 24;
    options.run.limits.max_bytes = std::uint64_t{1} << 30;
    return options;
}

bool has_plant(DrawnPanels& drawn) {
    return drawn.until([&] { return drawn.switcher.plant()->document() != nullptr; });
}

const std::vector<std::string> kNoWidgets;

} // namespace

TEST_CASE("no two widgets of the panels and dialogs of a plant have one id") {
    DrawnPanels drawn(panel_options(sample("teach-param")));
    REQUIRE(has_plant(drawn));
    PlantView& view = *drawn.switcher.plant();
    view.settings.definitions = {{"spread", 30.0F}};
    view.settings.set_values = {{"angle", "20"}};
    view.settings.mesh.method = MeshMethod::Boxes;
    view.settings.lines = LineKind::Skeleton;
    view.settings.light.turbidity = 4.0;
    drawn.panels.statistics = true;
    drawn.panels.help = true;
    drawn.panels.bookmarks.set(1, view.camera(), view.console());
    drawn.panels.bookmarks.set(2, view.camera(), view.console());
    drawn.open_all();
    CHECK(drawn.widgets.size() > 60);
    CHECK(drawn.twins() == kNoWidgets);
    for (const OpenDialog dialog :
         {OpenDialog::Picture, OpenDialog::Export, OpenDialog::File, OpenDialog::Unsaved}) {
        CAPTURE(static_cast<int>(dialog));
        drawn.panels.picture.is_film = dialog == OpenDialog::Picture;
        drawn.panels.dialog = dialog;
        if (dialog == OpenDialog::Unsaved) {
            drawn.switcher.open(sample("teach-bending"));
        }
        const std::size_t before = drawn.widgets.size();
        drawn.frames(3);
        CHECK(drawn.widgets.size() > before);
        CHECK(drawn.twins() == kNoWidgets);
        drawn.panels.dialog = OpenDialog::None;
        drawn.switcher.stay();
        drawn.frames(2);
    }
    show_sheet(view, drawn.panels);
    drawn.frames(3);
    CHECK(drawn.widgets.size() > kSheetCells);
    CHECK(drawn.twins() == kNoWidgets);
    close_sheet(drawn.panels);

    // The check finds two widgets of one id.
    drawn.draw_more = [] {
        ImGui::Begin("More");
        ImGui::Button("Twin");
        ImGui::Button("Twin");
        ImGui::End();
    };
    drawn.frames(2);
    CHECK(drawn.twins().size() == 1);
}

TEST_CASE("the panel of a plant that senses has a section for its senses") {
    DrawnPanels drawn(panel_options(LSYS_SOURCE_DIR "/tests/viewer/senses.lsys"));
    REQUIRE(has_plant(drawn));
    drawn.open_all();
    CHECK(drawn.twins() == kNoWidgets);
    const auto has_section = [&drawn] {
        const auto found =
            std::find_if(drawn.widgets.begin(), drawn.widgets.end(), [](const Widget& each) {
                return each.id == each.window->GetID("Senses");
            });
        return found != drawn.widgets.end();
    };
    CHECK(has_section());
    drawn.switcher.open(sample("teach-param"));
    REQUIRE(drawn.until([&] {
        const PlantDocument* const document = drawn.switcher.plant()->document();
        return document != nullptr && document->plant.sensed == nullptr;
    }));
    drawn.frames(2);
    CHECK_FALSE(has_section());
}

TEST_CASE("no two widgets of the panel of a forest have one id") {
    const ScratchFolder folder;
    write_text(folder / "tree.lsys", "#n = 2;\n#set names letters;\n#w : A;\n#p : A : * : F[+A]A;\n"
                                     "#param season 0.5 {0, 1};\n");
    // Species with names of sections and rows of the panel.
    write_text(folder / "wood.toml",
               "key = 1\nseason = 0.5\n\n[terrain]\nkind = \"noise\"\nsize = 40\nheight = 2\n"
               "feature = 20\n\n[placement]\nmethod = \"uniform\"\ncount = 20\n\n"
               "[[species]]\nname = \"Ground\"\ngrammar = \"tree.lsys\"\n\n"
               "[[species]]\nname = \"Placement\"\ngrammar = \"tree.lsys\"\n");
    DrawnPanels drawn(panel_options(folder / "wood.toml", true));
    REQUIRE(drawn.until([&] { return drawn.switcher.forest()->document() != nullptr; }));
    ForestViewSettings& settings = drawn.switcher.forest()->settings;
    settings.edits.key = 2;
    settings.colours = BranchColours::Id;
    settings.tool = PaintTool::Brush;
    drawn.open_all();
    CHECK(drawn.widgets.size() > 50);
    CHECK(drawn.twins() == kNoWidgets);
}

TEST_CASE("no two widgets of the start page have one id") {
    DrawnPanels drawn(panel_options(""));
    drawn.frames(3);
    CHECK(drawn.widgets.size() > 5);
    CHECK(drawn.twins() == kNoWidgets);
}

TEST_CASE("the buttons of the panel and of dialogs are in sight at 1280 by 720") {
    DrawnPanels drawn(panel_options(sample("teach-param")));
    REQUIRE(has_plant(drawn));
    drawn.open_all();
    CHECK(drawn.shows_all_of("Buttons"));
    CHECK_FALSE(drawn.shows_all_of("Panel")); // it scrolls
    drawn.panels.picture.is_film = true;
    drawn.panels.dialog = OpenDialog::Picture;
    drawn.frames(3);
    CHECK(drawn.shows_all_of("Picture or film"));
    drawn.panels.dialog = OpenDialog::Export;
    drawn.frames(3);
    CHECK(drawn.shows_all_of("Export the plant"));
}

TEST_CASE("F6 gives the keyboard to the panels in turn, and arrow keys reach all their controls") {
    DrawnPanels drawn(panel_options(sample("teach-param")));
    REQUIRE(has_plant(drawn));
    drawn.frames(3);
    CHECK_FALSE(drawn.panels.focus.has_keys());
    drawn.press_outside({Key::F6});
    CHECK(drawn.panels.focus.has_keys());
    CHECK(DrawnPanels::focused_window() == "Panel");
    drawn.open_all();
    CHECK(drawn.unreached("Panel") == kNoWidgets);
    drawn.press_outside({Key::F6});
    CHECK(DrawnPanels::focused_window() == "Buttons");
    CHECK(drawn.unreached("Buttons") == kNoWidgets);
    drawn.press_outside({Key::F6});
    CHECK(DrawnPanels::focused_window().empty());
    CHECK_FALSE(drawn.panels.focus.has_keys());
    drawn.press_outside({Key::F6});
    drawn.press_outside({Key::Escape});
    CHECK_FALSE(drawn.panels.focus.has_keys());
}

TEST_CASE("F6 reaches the buttons and the lines of the source pane") {
    DrawnPanels drawn(panel_options(sample("teach-param")));
    REQUIRE(has_plant(drawn));
    SourcePane& source = drawn.panels.source;
    source.look.is_shown = true;
    REQUIRE(drawn.until([&] {
        source.update(drawn.switcher.current(), [] {});
        return source.source() != nullptr;
    }));
    drawn.frames(3);
    drawn.press_outside({Key::F6});
    drawn.press_outside({Key::F6});
    CHECK(DrawnPanels::focused_window() == "Buttons");
    drawn.press_outside({Key::F6});
    CHECK(DrawnPanels::focused_window() == "Source");
    CHECK(drawn.panels.focus.has_keys());
    CHECK_FALSE(source.has_focus);
    // Its first button opens the editor; arrow keys reach the last one, which closes the pane.
    const auto close =
        std::find_if(drawn.widgets.begin(), drawn.widgets.end(), [](const Widget& w) {
            return std::string(w.window->Name).find("Source buttons") != std::string::npos &&
                   w.id == w.window->GetID("Close");
        });
    REQUIRE(close != drawn.widgets.end());
    const ImGuiID id = close->id;
    for (int i = 0; i < 6 && ImGui::GetCurrentContext()->NavId != id; ++i) {
        drawn.press(ImGuiKey_RightArrow);
    }
    CHECK(ImGui::GetCurrentContext()->NavId == id);
    drawn.press_outside({Key::F6});
    CHECK(source.has_focus);
    CHECK_FALSE(drawn.panels.focus.has_keys());
    drawn.press_outside({Key::Down});
    drawn.press_outside({Key::Down});
    CHECK(source.selected().first == 2);
    drawn.press_outside({Key::Escape});
    CHECK_FALSE(source.has_focus);
    CHECK(DrawnPanels::focused_window().empty());
}

TEST_CASE("F8 and Ctrl+Enter apply a fix, and a line without one says so") {
    const ScratchFolder folder;
    const std::string file = folder / "tree.lsys";
    const std::string wrong = "#n = 1;\n#w : F F\n#q : F : * : F F;\n";
    write_text(file, wrong);
    DrawnPanels drawn(panel_options(file));
    SourcePane& source = drawn.panels.source;
    PlantView& view = *drawn.switcher.plant();
    source.look.is_shown = true;
    REQUIRE(drawn.until([&] {
        source.update(view, [] {});
        return source.source() != nullptr && !source.source()->messages.empty();
    }));
    KeyPress apply;
    apply.key = Key::Enter;
    apply.control = true;
    source.select_line(1, false);
    CHECK(source.fix_here() == nullptr);
    drawn.press_outside(apply);
    CHECK(read_text(file) == wrong);
    drawn.press_outside({Key::F8});
    REQUIRE(source.fix_here() != nullptr);
    CHECK(source.fix_here()->is_certain);
    drawn.press_outside(apply);
    CHECK(read_text(file) == "#n = 1;\n#w : F F;\n#q : F : * : F F;\n");
    KeyPress undo;
    undo.key = Key::Z;
    undo.control = true;
    drawn.press_outside(undo);
    CHECK(read_text(file) == wrong);
}

TEST_CASE("keys alone change a value") {
    DrawnPanels drawn(panel_options(sample("teach-param")));
    REQUIRE(has_plant(drawn));
    drawn.frames(3);
    PlantView& view = *drawn.switcher.plant();
    const std::uint32_t before = view.generations();
    drawn.press_outside({Key::F6}); // to the slider of generations
    drawn.press(ImGuiKey_Space);
    drawn.press(ImGuiKey_LeftArrow);
    CHECK(view.generations() == before - 1);
    CHECK(ImGui::IsAnyItemActive());
    drawn.press(ImGuiKey_Space);
    CHECK_FALSE(ImGui::IsAnyItemActive());
    // Enter types a number.
    drawn.press(ImGuiKey_Enter);
    CHECK(ImGui::GetIO().WantTextInput);
    ImGui::GetIO().AddInputCharacter('3');
    drawn.frame();
    drawn.press(ImGuiKey_Enter);
    CHECK_FALSE(ImGui::IsAnyItemActive());
    CHECK(view.generations() == 3);
}

TEST_CASE("a dialog takes the keyboard, writes with one Enter and gives the keyboard back") {
    const ScratchFolder folder;
    DrawnPanels drawn(panel_options(sample("teach-param")));
    REQUIRE(has_plant(drawn));
    PlantView& view = *drawn.switcher.plant();
    view.settings.output.file = folder / "none/plant.obj";
    drawn.press_outside({Key::F6});
    drawn.press_outside({Key::E});
    REQUIRE(drawn.panels.dialog == OpenDialog::Export);
    CHECK(drawn.panels.focus.has_keys());
    CHECK(DrawnPanels::focused_window() == "Export the plant");
    CHECK(ImGui::GetIO().WantTextInput);
    // A folder that does not exist is reported before anything is written.
    CHECK(problem_of_export(view.settings.output.file) ==
          fmt::format("there is no folder `{}`", folder / "none/"));
    drawn.press(ImGuiKey_Enter);
    CHECK(drawn.panels.dialog == OpenDialog::Export);
    drawn.press_outside({Key::Escape});
    CHECK(drawn.panels.dialog == OpenDialog::None);
    CHECK(DrawnPanels::focused_window() == "Panel");

    view.settings.output.file = folder / "plant.obj";
    drawn.press_outside({Key::Escape}); // the picture has the keyboard
    drawn.press_outside({Key::E});
    drawn.press(ImGuiKey_Enter);
    CHECK(drawn.panels.dialog == OpenDialog::None);
    CHECK_FALSE(drawn.panels.focus.has_keys());
    REQUIRE(drawn.until([&] { return std::filesystem::exists(folder / "plant.obj"); }));

    const ImVec2 eye{view.camera().eye.x, view.camera().eye.z};
    drawn.panels.picture.folder = folder.path().string();
    drawn.press_outside({Key::P});
    REQUIRE(drawn.panels.dialog == OpenDialog::Picture);
    drawn.press(ImGuiKey_Enter);
    CHECK(drawn.panels.dialog == OpenDialog::None);
    CHECK(std::filesystem::exists(folder / "teach-param-1.png"));
    CHECK(view.camera().eye.x == eye.x);
    drawn.panels.picture.folder = folder / "none";
    drawn.press_outside({Key::P});
    drawn.press(ImGuiKey_Enter);
    CHECK(drawn.panels.dialog == OpenDialog::Picture);
}

TEST_CASE("the contact sheet is used by keys") {
    DrawnPanels drawn(panel_options(sample("teach-param")));
    REQUIRE(has_plant(drawn));
    drawn.panels.window_width = 1280;
    drawn.panels.window_height = 720;
    drawn.press_outside({Key::K});
    REQUIRE(drawn.panels.dialog == OpenDialog::Sheet);
    CHECK(drawn.unreached("Contact sheet") == kNoWidgets);
    drawn.press_outside({Key::Escape});
    drawn.press_outside({Key::K});
    drawn.press(ImGuiKey_RightArrow);
    drawn.press(ImGuiKey_DownArrow);
    drawn.press(ImGuiKey_Enter);
    CHECK(drawn.panels.dialog == OpenDialog::None);
    CHECK(drawn.switcher.plant()->settings.seed == 4);
}

TEST_CASE("unsaved values are saved, given up or kept by keys") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#param size 1 {0.5, 2};\n#n = 0;\n#w : F(size);\n");
    write_text(folder / "b.lsys", "#n = 0;\n#w : F;\n");
    DrawnPanels drawn(panel_options(folder / "a.lsys"));
    REQUIRE(has_plant(drawn));
    PlantView& view = *drawn.switcher.plant();
    view.settings.definitions = {{"size", 2.0F}};
    REQUIRE(drawn.until([&] { return view.stats().swaps == 2; }));
    drawn.press_outside({Key::Q, true});
    CHECK_FALSE(drawn.panels.quits);
    CHECK(drawn.panels.dialog == OpenDialog::Unsaved);
    drawn.press_outside({Key::Escape});
    CHECK(drawn.panels.dialog == OpenDialog::None);
    CHECK(view.is_unsaved());
    drawn.press_outside({Key::Q, true});
    drawn.press(ImGuiKey_Enter);
    CHECK(drawn.panels.quits);
    CHECK(read_text(folder / "a.lsys").find("size 2 {") != std::string::npos);

    // A file that has changed on disk is not overwritten: the dialog says so, and stays.
    drawn.panels.quits = false;
    view.settings.seed = 5;
    REQUIRE(drawn.until([&] { return view.stats().swaps == 3; }));
    drawn.press_outside({Key::Right, false, false, true}); // Alt+Right: the next file
    REQUIRE(drawn.panels.dialog == OpenDialog::Unsaved);
    view.settings.seed = 6; // no plant of this seed is made yet
    answer_unsaved(UnsavedAnswer::Save, drawn.switcher, drawn.panels);
    CHECK(drawn.panels.dialog == OpenDialog::Unsaved);
    CHECK(drawn.panels.save_failure.find("not written: ") == 0);
    drawn.frames(3);
    drawn.press(ImGuiKey_RightArrow); // to Discard
    drawn.press(ImGuiKey_Enter);
    CHECK(drawn.panels.dialog == OpenDialog::None);
    CHECK(view.path() == folder / "b.lsys");
    CHECK(read_text(folder / "a.lsys").find("seed") == std::string::npos);
}

TEST_CASE("the panel does not move while a plant grows") {
    DrawnPanels drawn(panel_options(sample("teach-param")));
    REQUIRE(has_plant(drawn));
    drawn.frames(2);
    const auto top = [&] {
        for (const Widget& each : drawn.widgets) {
            if (std::string(each.window->Name) == "Panel") {
                return each.place.Min.y; // the slider of generations
            }
        }
        return -1.0F;
    };
    const float before = top();
    CHECK(before > 0.0F);
    PlantView& view = *drawn.switcher.plant();
    view.play_or_pause();
    REQUIRE(drawn.until([&] { return view.grown() != nullptr; }));
    drawn.frame();
    CHECK(top() == before);
}
