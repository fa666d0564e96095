// SPDX-License-Identifier: MIT
// Cameras kept for each file.
#include "tests/support/lsc_run.h"
#include "viewer/app/camera_bookmarks.h"
#include "viewer/app/controls.h"
#include "viewer/gl/headless_context.h"

#include <catch2/catch.hpp>

#include <sstream>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

TEST_CASE("cameras are kept for each file, by number and name") {
    const ScratchFolder folder;
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    const Console console({in, out, err, false, nullptr, "lsview"}, {});
    const std::string state = folder / "state";
    const std::string file = folder / "a.lsys";
    Camera camera;
    camera.eye = {1.5F, 2.25F, -3.0F};
    CameraBookmarks bookmarks;
    bookmarks.show(state, file);
    bookmarks.set(0, camera, console);
    bookmarks.set(8, Camera{}, console);
    bookmarks.rename(0, "From the path", console);
    bookmarks.show(state, folder / "b.lsys");
    CHECK_FALSE(bookmarks.all()[0]);
    CameraBookmarks later;
    later.show(state, folder / "none/../a.lsys"); // the same file
    REQUIRE(later.all()[0]);
    CHECK(later.all()[0]->name == "From the path");
    CHECK(later.all()[0]->camera == camera);
    REQUIRE(later.all()[8]);
    CHECK(later.all()[8]->name == "Camera 9");
    CHECK_FALSE(later.all()[1]);
    later.set(0, Camera{}, console); // keeps its name
    CHECK(later.all()[0]->name == "From the path");
    later.remove(0, console);
    later.remove(8, console);
    CameraBookmarks last;
    last.show(state, file);
    CHECK_FALSE(last.all()[8]);
    CameraBookmarks unstored;
    unstored.show("", file);
    unstored.set(3, camera, console);
    CHECK(unstored.all()[3]->camera == camera);
    CHECK(err.str().empty());
}

TEST_CASE("keys set a camera and go back to it") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 0;\n#w : F;\n");
    const auto context = HeadlessContext::make();
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    ViewOptions options;
    options.file = folder / "a.lsys";
    const Console console({in, out, err, false, nullptr, "lsview"}, options.messages);
    const std::unique_ptr<Renderer> renderer = std::move(Renderer::make(built_in_shader).value());
    ViewSwitcher switcher(options, console, *renderer, [] {});
    Controls controls;
    PanelState panels;
    panels.state_folder = folder / "state";
    const auto press = [&](const KeyPress& key) {
        WindowInput input;
        input.presses = {key};
        controls.apply(input, 0.0, {0, 0, 64, 48}, switcher, panels);
    };
    Camera camera;
    camera.eye = {9.0F, 8.0F, 7.0F};
    switcher.current().camera() = camera;
    press({Key::Four, true, false, false});
    CHECK(switcher.current().note() == "Camera 4 is set: Alt+4 goes to it");
    switcher.current().camera() = Camera{};
    press({Key::Five, false, false, true});
    CHECK(switcher.current().camera() == Camera{});
    CHECK(switcher.current().note() == "There is no camera 5: Ctrl+5 sets it");
    press({Key::Four, false, false, true});
    CHECK(switcher.current().camera() == camera);
    CHECK(std::filesystem::exists(folder / "state/cameras"));
}
