// SPDX-License-Identifier: MIT
// Drawings of what trees of a forest sense, obstacles under the mouse, and plants that grow again
// when an obstacle moves.
#include "tests/support/lsc_run.h"
#include "tests/viewer/lsview_run.h"
#include "viewer/app/controls.h"
#include "viewer/app/forest_view.h"
#include "viewer/gl/headless_context.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <sstream>
#include <thread>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;
using namespace std::chrono_literals;

namespace {

/// Grows along -X in steps of 0.5 m, until it is at most 0.6 m from the wall at x = -2.
const char* const kToTheWall = "#n = 12;\n"
                               "#sense wall solid plane 1 0 0 2;\n"
                               "#sense light sky;\n"
                               "#w : F(1) -(90) A ?wall(9, 0, 0, 0) ?light(1);\n"
                               "#grow : A > ?wall(d, x, y, z) : d > 0.6 : F(0.5) A;\n";

/// `painted`: trees of the species "plant"; the placed one is erased.
std::string wood_of(const std::string& painted) {
    return "[terrain]\nsize = 20\n[placement]\nmethod = \"uniform\"\ncount = 1\n"
           "[[species]]\nname = \"plant\"\ngrammar = \"plant.lsys\"\nheroes = 1\n"
           "[painted]\nerased = [0]\ntrees = [" +
           painted + "]\n";
}

ViewOptions options_of(const std::string& file) {
    ViewOptions options;
    options.file = file;
    options.files = {file};
    options.is_forest = true;
    options.run.limits.max_bytes = std::uint64_t{1} << 30;
    return options;
}

class SensingForest {
public:
    explicit SensingForest(const std::string& painted)
        : context_(std::move(HeadlessContext::make().value())),
          console_({in_, out_, err_, false, nullptr, "lsview"}, {}),
          renderer_(std::move(Renderer::make(built_in_shader).value())) {
        write_text(folder_ / "plant.lsys", kToTheWall);
        write_text(folder_ / "wood.toml", wood_of(painted));
        view.emplace(options_of(folder_ / "wood.toml"), console_, *renderer_, [] {});
    }

    /// Steps until the heroes have `count` segments; returns false after 60 s.
    bool until_segments(std::size_t count) {
        for (const auto start = SteadyClock::now(); SteadyClock::now() - start < 60s;) {
            step();
            if (view->document() != nullptr && view->document()
                                                       ->grown.forest.species[0]
                                                       .stages[0]
                                                       .cache.skeleton.segments.size() == count) {
                return true;
            }
            std::this_thread::sleep_for(1ms);
        }
        return false;
    }
    void step() {
        view->update();
        if (view->draw(kArea.width, kArea.height)) {
            view->picture_shown(0.0);
        }
    }
    std::vector<std::uint8_t> picture() {
        for (int i = 0; i < 3; ++i) {
            step();
        }
        std::vector<std::uint8_t> pixels;
        renderer_->read(pixels);
        return pixels;
    }

private:
    ScratchFolder folder_;
    std::unique_ptr<HeadlessContext> context_;
    std::istringstream in_;
    std::ostringstream out_;
    std::ostringstream err_;
    Console console_;
    std::unique_ptr<Renderer> renderer_;

public:
    static constexpr PixelArea kArea{0, 0, 160, 120};
    std::optional<ForestView> view;
    Controls controls;
};

PointerEvent pointer(PointerEvent::Kind kind, float x, bool shift) {
    PointerEvent event;
    event.kind = kind;
    event.place = {x, 60.0F};
    event.shift = shift;
    return event;
}

} // namespace

TEST_CASE("obstacles are drawn at their trees, and light at the nearest tree alone") {
    SensingForest viewed("[\"plant\", 5, 10, 0, 1], [\"plant\", 15, 10, 90, 2]");
    REQUIRE(viewed.until_segments(4));
    const ForestDocument& document = *viewed.view->document();
    REQUIRE(has_senses(document));
    NearestSensing nearest(document, {14.0, 0.0, 10.0});
    viewed.view->painting().for_each_tree([&](const Tree& tree) { nearest.add(tree); });
    const std::vector<Tree> trees = nearest.take();
    REQUIRE(trees.size() == 2);
    CHECK(trees[0].position.x == 15.0F);
    const SenseDrawing walls =
        make_forest_sense_drawing(document, trees, {true, false, false, false}, {});
    REQUIRE(walls.vertices.size() == 12); // two squares
    for (std::size_t i = 0; i < 6; ++i) {
        // -X turns to +Z at yaw 90: the wall, 2 m away, is 4 m away at scale 2.
        CHECK(walls.vertices[i].position.z == Approx(14.0F).epsilon(1e-5));
        CHECK(walls.vertices[i + 6].position.x == Approx(3.0F).epsilon(1e-5));
    }
    const SenseDrawing light =
        make_forest_sense_drawing(document, trees, {false, true, false, false}, {});
    REQUIRE(light.vertices.size() == 1);
    CHECK(light.vertices[0].position.x == Approx(15.0F).epsilon(1e-5));
    CHECK(light.vertices[0].position.y == Approx(2.0F).epsilon(1e-5));
    CHECK(light.vertices[0].position.z == Approx(13.0F).epsilon(1e-5));
    const SenseDrawing moved = make_forest_sense_drawing(
        document, trees, {true, false, false, false}, {{{"wall", {-1.0F, 0.0F, 0.0F}}}});
    CHECK(moved.vertices[6].position.x == Approx(2.0F).epsilon(1e-5));
    const glm::dvec3 in_tree = in_sensing_metres(document, trees[0], {0.0, 0.0, -2.0});
    CHECK(in_tree.x == Approx(1.0).epsilon(1e-6));
    CHECK(in_tree.z == Approx(0.0).margin(1e-6));
    // A ray from the small tree along -X meets its own wall, not that of the other tree.
    const auto hit =
        first_forest_obstacle(document, trees, {}, {{5.0, 1.0, 10.0}, {-1.0, 0.0, 0.0}});
    REQUIRE(hit);
    CHECK(hit->tree.position.x == 5.0F);
    CHECK(hit->obstacle.distance == Approx(2.0).epsilon(1e-5));
}

TEST_CASE("senses of a forest change its picture, and back") {
    SensingForest viewed("[\"plant\", 10, 10, 0, 1]");
    REQUIRE(viewed.until_segments(4));
    viewed.view->settings.camera = {{11.0F, 1.0F, 13.0F}, {9.0F, 1.0F, 10.0F}, 40.0F, {}};
    const std::vector<std::uint8_t> plain = viewed.picture();
    viewed.view->settings.senses = {false, false, false, false};
    CHECK(viewed.picture() != plain);
    viewed.view->settings.senses = {};
    CHECK(viewed.picture() == plain);
}

TEST_CASE("plants of a forest grow again while the mouse drags their obstacle") {
    SensingForest viewed("[\"plant\", 10, 10, 0, 1]");
    REQUIRE(viewed.until_segments(4));
    Camera& camera = viewed.view->settings.camera;
    camera = {{11.0F, 1.0F, 13.0F}, {8.0F, 1.0F, 10.0F}, 40.0F, {}};
    const Camera before = camera;
    viewed.step();
    viewed.view->record_edits();
    const auto drag = [&](bool shift) {
        WindowInput input;
        input.pointer_events = {pointer(PointerEvent::Kind::Press, 80.0F, shift)};
        CHECK(viewed.controls.move_obstacle(input, SensingForest::kArea, *viewed.view) == shift);
        viewed.view->record_edits(); // a drag is one step of undo
        input.pointer_events = {pointer(PointerEvent::Kind::Move, 60.0F, shift)};
        CHECK(viewed.controls.move_obstacle(input, SensingForest::kArea, *viewed.view) == shift);
        viewed.view->record_edits();
        viewed.step();
        input.pointer_events = {pointer(PointerEvent::Kind::Release, 50.0F, shift)};
        CHECK(viewed.controls.move_obstacle(input, SensingForest::kArea, *viewed.view) == shift);
        CHECK_FALSE(viewed.view->has_grabbed());
        viewed.view->record_edits();
    };
    drag(false);
    CHECK(viewed.view->settings.edits.species["plant"].moves.empty());
    drag(true);
    const std::vector<EnvironmentMove>& moves = viewed.view->settings.edits.species["plant"].moves;
    REQUIRE(moves.size() == 1);
    CHECK(moves[0].name == "wall");
    // The mouse has moved 30 pixels to the left, a quarter of the picture's height. The wall is
    // 3 sqrt(2) m away from the eye, and the view turned by 45 degrees.
    const double half = std::tan(0.5 * 40.0 * std::numbers::pi / 180.0);
    CHECK(moves[0].by[0] == Approx(-0.5 * half * 3.0).epsilon(1e-3));
    CHECK(camera == before);
    REQUIRE(viewed.until_segments(5));
    viewed.view->undo();
    CHECK(viewed.view->settings.edits.species["plant"].moves.empty());
    REQUIRE(viewed.until_segments(4));
    viewed.view->settings.tool = PaintTool::Brush; // Shift erases
    CHECK_FALSE(viewed.view->grab_obstacle({0.0F, 0.0F}));
}
