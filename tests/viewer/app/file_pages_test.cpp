// SPDX-License-Identifier: MIT
// Recent files, the gallery of samples, the dialog that opens a file, and their keys.
#include "tests/support/lsc_run.h"
#include "tests/viewer/lsview_run.h"
#include "viewer/app/controls.h"
#include "viewer/app/recent_files.h"
#include "viewer/gl/headless_context.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

/// A folder with files of several kinds.
void make_files(const ScratchFolder& folder) {
    for (const char* const name : {"b.lsys", "a.lsys", "wood.toml", "tree.l", "x.lsb", "notes.txt",
                                   ".hidden.lsys", "rose.l++", "list.rules"}) {
        write_text(folder / name, "#n = 0;\n#w : F;\n");
    }
    std::filesystem::create_directory(folder / "samples");
    std::filesystem::create_directory(folder / "saplings");
    write_text(folder / "samples/oak.lsys", "#n = 0;\n#w : F;\n");
}

std::vector<std::string> names_of(const FileBrowser& browser) {
    std::vector<std::string> names;
    for (const FolderEntry& each : browser.entries()) {
        names.push_back(each.name + (each.is_folder ? "/" : ""));
    }
    return names;
}

KeyPress pressed(Key key) {
    return {key, false, false, false};
}

WindowInput presses(const std::vector<KeyPress>& keys) {
    WindowInput input;
    input.presses = keys;
    input.has_events = true;
    return input;
}

/// A window's state without the window.
struct Run {
    explicit Run(const ViewOptions& options)
        : context(std::move(HeadlessContext::make().value())),
          console({in, out, err, false, nullptr, "lsview"}, options.messages),
          renderer(std::move(Renderer::make(built_in_shader).value())),
          switcher(options, console, *renderer, [] {}) {}

    void apply(const WindowInput& input) {
        controls.apply(input, 0.0, {0, 0, 64, 48}, switcher, panels);
    }

    std::unique_ptr<HeadlessContext> context;
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    Console console;
    std::unique_ptr<Renderer> renderer;
    ViewSwitcher switcher;
    Controls controls;
    PanelState panels;
};

} // namespace

TEST_CASE("the dialog lists folders and files that lsview can open") {
    const ScratchFolder folder;
    make_files(folder);
    FileBrowser browser;
    browser.show(folder.path().string());
    CHECK(names_of(browser) == std::vector<std::string>{"samples/", "saplings/", "a.lsys", "b.lsys",
                                                        "list.rules", "rose.l++", "tree.l",
                                                        "wood.toml", "x.lsb"});
    browser.set_text("RE"); // in any case, anywhere in the name
    CHECK(names_of(browser) == std::vector<std::string>{"tree.l"});
    CHECK(browser.accept() == folder / "tree.l");
    browser.set_text("nothing");
    CHECK(browser.accept().empty());
    CHECK(browser.mistake() == "There is no `nothing`");
    browser.erase_character();
    CHECK(browser.text() == "nothin");
    CHECK(browser.mistake().empty());
    browser.set_text("notes.txt"); // an exact name, although its kind is unknown
    CHECK(browser.accept() == folder / "notes.txt");
}

TEST_CASE("the dialog completes paths, and goes into folders and out of them") {
    const ScratchFolder folder;
    make_files(folder);
    FileBrowser browser;
    browser.show(folder.path().string());
    browser.set_text("s");
    browser.complete();
    CHECK(browser.text() == "sa"); // samples and saplings
    browser.set_text("sam");
    browser.complete();
    CHECK(browser.text() == "samples/");
    CHECK(names_of(browser) == std::vector<std::string>{"oak.lsys"});
    browser.complete();
    CHECK(browser.text() == "samples/oak.lsys");
    CHECK(browser.accept() == folder / "samples/oak.lsys");
    browser.show(folder.path().string());
    CHECK(browser.accept().empty()); // enters the first folder
    CHECK(browser.folder() == folder / "samples");
    browser.erase_character(); // without a text goes up
    CHECK(browser.folder() == folder.path().string());
    CHECK(browser.entries()[browser.selected()].name == "samples");
    browser.move(1);
    CHECK(browser.selected() == 1);
    browser.move(100);
    CHECK(browser.selected() == browser.entries().size() - 1);
    browser.move(-100);
    CHECK(browser.selected() == 0);
    browser.set_text(folder / "samples/");
    CHECK(names_of(browser) == std::vector<std::string>{"oak.lsys"});
    browser.set_text("\xC3\xA4"); // one character of two bytes
    browser.erase_character();
    CHECK(browser.text().empty());
    browser.set_text(folder / "none/");
    CHECK(browser.entries().empty());
}

TEST_CASE("the files of a folder follow each other in a circle") {
    const ScratchFolder folder;
    make_files(folder);
    CHECK(neighbour_file(folder / "a.lsys", 1) == folder / "b.lsys");
    CHECK(neighbour_file(folder / "a.lsys", -1) == folder / "x.lsb");
    CHECK(neighbour_file(folder / "x.lsb", 1) == folder / "a.lsys");
    CHECK(neighbour_file(folder / "notes.txt", 1) == folder / "a.lsys");
    CHECK(neighbour_file(folder / "samples/oak.lsys", 1).empty());
}

TEST_CASE("recent files are the last twelve that exist, newest first") {
    const ScratchFolder folder;
    const std::string state = folder / "state/lsview";
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    const Console console({in, out, err, false, nullptr, "lsview"}, {});
    CHECK(recent_files(state).empty());
    CHECK(recent_files("").empty());
    for (int i = 0; i < 15; ++i) {
        const std::string file = folder / fmt::format("{}.lsys", i);
        write_text(file, "");
        remember_file(state, file, console);
    }
    remember_file(state, folder / "5.lsys", console);
    std::filesystem::remove(folder / "13.lsys");
    const std::vector<std::string> files = recent_files(state);
    REQUIRE(files.size() == kMaxRecentFiles - 1);
    CHECK(files[0] == folder / "5.lsys");
    CHECK(files[1] == folder / "14.lsys");
    CHECK(files[2] == folder / "12.lsys");
    CHECK(std::count(files.begin(), files.end(), folder / "5.lsys") == 1);
    remember_file("", folder / "5.lsys", console); // no state folder: does nothing
    CHECK(err.str().empty());
    write_text(folder / "file", "");
    remember_file(folder / "file/lsview", folder / "5.lsys", console); // no folder can be made
    CHECK(err.str().empty());
}

TEST_CASE("the look of the window is kept") {
    const ScratchFolder folder;
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    const Console console({in, out, err, false, nullptr, "lsview"}, {});
    CHECK(read_look(folder.path().string()) == WindowLook{});
    CHECK(read_look("") == WindowLook{});
    write_look(folder.path().string(), {1.5F, true}, console);
    CHECK(read_look(folder.path().string()) == WindowLook{1.5F, true});
    write_look(folder.path().string(), {2.0F, false}, console);
    CHECK(read_look(folder.path().string()) == WindowLook{2.0F, false});
    for (const char* const wrong : {"", "99 dark\n", "big\n"}) {
        CAPTURE(wrong);
        write_text(folder / "look", wrong);
        CHECK(read_look(folder.path().string()) == WindowLook{});
    }
    CHECK(err.str().empty());
}

TEST_CASE("samples have the first sentence of their file as title") {
    CHECK(title_of_text("// A tree, of\n//  two lines. More.\n#n = 1;\n") ==
          "A tree, of two lines");
    CHECK(title_of_text("# A wood.\n\n[terrain]\n") == "A wood");
    CHECK(title_of_text("#n = 1;\n").empty());
    CHECK(title_of_text("").empty());
    CHECK(samples_folder() == LSYS_SOURCE_DIR "/samples");
    const std::vector<GallerySample> samples = find_samples(samples_folder());
    REQUIRE(samples.size() > 100);
    CHECK(samples.front().file == LSYS_SOURCE_DIR "/samples/species/apple/apple.lsys");
    CHECK(samples.front().title == "Apple tree, Malus domestica Borkh");
    CHECK(std::all_of(samples.begin(), samples.end(), [](const GallerySample& each) {
        CAPTURE(each.file);
        CHECK_FALSE(each.title.empty());
        return !each.title.empty();
    }));
    CHECK(std::any_of(samples.begin(), samples.end(), [](const GallerySample& each) {
        return each.name == "mixed-forest" && each.file.ends_with("mixed-forest.toml");
    }));
    // The picture of a scene is a view of it, and not its map.
    CHECK(std::any_of(samples.begin(), samples.end(), [](const GallerySample& each) {
        return each.name == "meadow" && each.picture.ends_with("meadow-inside.png");
    }));
    const Texture small = thumbnail_of(read_text(samples.front().picture), 100);
    CHECK(std::max(small.width, small.height) <= 100);
    CHECK(std::max(small.width, small.height) > 50);
    CHECK(small.texels.size() == std::size_t{4} * small.width * small.height);
    CHECK(thumbnail_of("no picture", 100).texels.empty());
    CHECK(find_samples("").empty());
}

TEST_CASE(
    "without a file the start page opens a sample by keys, and dialogs keep keys to themselves") {
    const ScratchFolder folder;
    make_files(folder);
    Run run({});
    CHECK(run.switcher.current().path().empty());
    CHECK(run.switcher.plant() == nullptr);
    CHECK(run.switcher.current().draw(64, 48));
    StartPage& start = run.panels.start;
    start.samples = {{"a", folder / "a.lsys", "A", ""},
                     {"b", folder / "b.lsys", "B", ""},
                     {"oak", folder / "samples/oak.lsys", "Oak", ""}};
    start.recent = {folder / "tree.l", folder / "wood.toml"};
    start.columns = 2;
    start.in_recent = true;
    CHECK(start.selected_file() == folder / "tree.l");
    run.apply(presses({pressed(Key::Down), pressed(Key::Down)}));
    CHECK(start.selected_file() == folder / "wood.toml");
    run.apply(presses({pressed(Key::Right), pressed(Key::Down)}));
    CHECK(start.selected_file() == folder / "samples/oak.lsys");
    run.apply(presses({pressed(Key::Left)}));
    CHECK(start.in_recent);
    const auto type = [&run](const char* letter) {
        WindowInput input;
        input.text = letter;
        run.apply(input);
    };
    type("k");
    CHECK(start.selected_file() == folder / "samples/oak.lsys");
    type("b"); // no name contains "kb"
    CHECK(start.selected_file() == folder / "b.lsys");
    run.apply(presses({pressed(Key::F1)}));
    CHECK(run.panels.help);
    run.apply(presses({pressed(Key::F1), pressed(Key::Left), pressed(Key::Left)}));
    CHECK_FALSE(run.panels.help);
    CHECK(start.in_recent);
    run.apply(presses({pressed(Key::Right), pressed(Key::Right), pressed(Key::Enter)}));
    REQUIRE(run.switcher.plant() != nullptr);
    CHECK(run.switcher.current().path() == folder / "b.lsys");

    // Alt+Left opens the previous file; Ctrl+O a dialog, which takes letters.
    run.apply(presses({{Key::Left, false, false, true}}));
    CHECK(run.switcher.current().path() == folder / "a.lsys");
    run.apply(presses({{Key::O, true, false, false}}));
    REQUIRE(run.panels.dialog == OpenDialog::File);
    CHECK(run.panels.browser.folder() == folder.path().string());
    WindowInput typed = presses({pressed(Key::W)});
    typed.text = "w";
    run.apply(typed);
    CHECK(run.switcher.plant()->settings.style == PlantStyle::Surface);
    CHECK(names_of(run.panels.browser) == std::vector<std::string>{"wood.toml"});
    run.apply(presses({pressed(Key::Escape)}));
    CHECK(run.panels.dialog == OpenDialog::None);
    CHECK(run.switcher.current().path() == folder / "a.lsys");
    run.apply(presses({{Key::O, true, false, false}}));
    run.apply(typed);
    run.apply(presses({pressed(Key::Enter)}));
    CHECK(run.panels.dialog == OpenDialog::None);
    REQUIRE(run.switcher.forest() != nullptr);
    CHECK(run.switcher.current().path() == folder / "wood.toml");
    run.apply(presses({{Key::Q, true, false, false}}));
    CHECK(run.panels.quits);
}
