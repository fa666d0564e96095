// SPDX-License-Identifier: MIT
// The contact sheet of seeds and parameters.
#include "tests/support/lsc_run.h"
#include "viewer/app/controls.h"
#include "viewer/gl/headless_context.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>
#include <thread>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;
using namespace std::chrono_literals;

TEST_CASE("a contact sheet has nine seeds, or values of one or two parameters") {
    Names names;
    Constant angle;
    angle.name = names.intern("angle");
    angle.is_param = true;
    angle.minimum = 10.0F;
    angle.maximum = 50.0F;
    Constant width = angle;
    width.name = names.intern("width");
    width.minimum = 0.0F;
    width.maximum = 1.0F;
    const auto seeds = sheet_cells(7, {}, names);
    CHECK(seeds[0].seed == 7);
    CHECK(seeds[8].seed == 15);
    CHECK(seeds[8].label == "seed 15");
    const auto angles = sheet_cells(7, {angle}, names);
    CHECK_FALSE(angles[0].seed);
    CHECK(angles[0].definitions == std::vector<Definition>{{"angle", 10.0F}});
    CHECK(angles[4].label == "angle 30");
    CHECK(angles[8].definitions == std::vector<Definition>{{"angle", 50.0F}});
    const auto both = sheet_cells(7, {angle, width}, names);
    CHECK(both[1].label == "angle 30, width 0");
    CHECK(both[3].label == "angle 10, width 0.5");
    PlantEdits edits;
    edits.definitions = {{"width", 0.3F}, {"other", 1.0F}};
    take_cell(both[8], edits);
    CHECK(edits.definitions ==
          std::vector<Definition>{{"width", 1.0F}, {"other", 1.0F}, {"angle", 50.0F}});
    CHECK_FALSE(edits.seed);
}

TEST_CASE("the contact sheet draws plants beside the window, and one is taken by keys and undone") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#param size 2 {1, 3};\n#n = 1;\n#w : A;\n"
                                  "#p : A : * : F({1, 9} * size) ;\n#set width 1;\n");
    const auto context = HeadlessContext::make();
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    ViewOptions options;
    options.file = folder / "a.lsys";
    options.files = {options.file};
    options.run.limits.max_bytes = std::uint64_t{1} << 30U;
    const Console console({in, out, err, false, nullptr, "lsview"}, options.messages);
    const std::unique_ptr<Renderer> renderer = std::move(Renderer::make(built_in_shader).value());
    ViewSwitcher switcher(options, console, *renderer, [] {});
    PlantView& view = *switcher.plant();
    Controls controls;
    PanelState panels;
    panels.wake = [] {};
    panels.window_width = 3 * 32 + 42;
    panels.window_height = 3 * 24 + 66;
    const auto press = [&](Key key) {
        WindowInput input;
        input.presses = {{key, false, false, false}};
        controls.apply(input, 0.0, {0, 0, 64, 48}, switcher, panels);
    };
    const auto until = [&](const auto& done) {
        for (const auto start = SteadyClock::now(); SteadyClock::now() - start < 30s;) {
            view.update();
            view.draw(64, 48);
            if (done()) {
                return true;
            }
            std::this_thread::sleep_for(1ms);
        }
        return false;
    };
    press(Key::K);
    CHECK(panels.dialog == OpenDialog::None);
    CHECK(view.note() == "There is no plant for a contact sheet");
    CAPTURE(err.str());
    REQUIRE(until([&] { return view.document() != nullptr; }));
    view.record_edits();
    press(Key::K);
    REQUIRE(panels.dialog == OpenDialog::Sheet);
    std::vector<std::pair<std::size_t, Texture>> drawn;
    REQUIRE(until([&] {
        for (auto& each : panels.sheet.take()) {
            drawn.push_back(std::move(each));
        }
        return drawn.size() == kSheetCells;
    }));
    for (std::size_t i = 0; i < kSheetCells; ++i) {
        CHECK(drawn[i].first == i);
        CHECK(drawn[i].second.width == 32);
        CHECK(drawn[i].second.height == 24);
        CHECK(panels.sheet.done.at(i));
    }
    CHECK(drawn[0].second.texels != drawn[1].second.texels);
    CHECK_FALSE(panels.sheet.are_alike());
    press(Key::Escape);
    CHECK(panels.dialog == OpenDialog::None);
    CHECK_FALSE(view.settings.seed);

    panels.sheet.varied = {"size"};
    press(Key::K);
    take_from_sheet(7, view, panels);
    CHECK(panels.dialog == OpenDialog::None);
    REQUIRE(view.settings.definitions.size() == 1);
    CHECK(view.settings.definitions[0].value == Approx(2.75));
    view.record_edits();
    view.undo();
    CHECK(view.settings.definitions.empty());
    CHECK(renderer->errors().empty());
}
