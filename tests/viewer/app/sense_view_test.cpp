// SPDX-License-Identifier: MIT
// Drawings of what plants sense, obstacles under the mouse, and plants that grow again when an
// obstacle moves.
#include "tests/support/lsc_run.h"
#include "tests/viewer/lsview_run.h"
#include "viewer/app/controls.h"
#include "viewer/app/plant_view.h"
#include "viewer/gl/headless_context.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>
#include <thread>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;
using namespace std::chrono_literals;

namespace {

/// Grows along -X in steps of 0.5 m, until it is at most 0.5 m from the wall at x = -2.
const char* const kToTheWall = "#n = 12;\n"
                               "#sense wall solid plane 1 0 0 2;\n"
                               "#w : F(1) -(90) A ?wall(9, 0, 0, 0);\n"
                               "#grow : A > ?wall(d, x, y, z) : d > 0.6 : F(0.5) A;\n";

class SensingView {
public:
    explicit SensingView(const std::string& file)
        : context_(std::move(HeadlessContext::make().value())),
          console_({in_, out_, err_, false, nullptr, "lsview"}, {}),
          renderer_(std::move(Renderer::make(built_in_shader).value())),
          view(options_of(file), console_, *renderer_, [] {}) {}

    /// Steps until `done`; returns false after 30 s.
    template <typename Condition>
    bool until(Condition&& done) {
        for (const auto start = SteadyClock::now(); SteadyClock::now() - start < 30s;) {
            step();
            if (done()) {
                return true;
            }
            std::this_thread::sleep_for(1ms);
        }
        return false;
    }
    bool until_segments(std::size_t count) {
        return until([&] {
            return view.document() != nullptr &&
                   view.document()->plant.skeleton.segments.size() == count;
        });
    }
    std::vector<std::uint8_t> picture() {
        step();
        std::vector<std::uint8_t> pixels;
        renderer_->read(pixels);
        return pixels;
    }

private:
    void step() {
        view.update();
        if (view.draw(kArea.width, kArea.height)) {
            view.picture_shown(0.0);
        }
    }
    static ViewOptions options_of(const std::string& file) {
        ViewOptions options;
        options.file = file;
        options.run.limits.max_bytes = std::uint64_t{1} << 30;
        return options;
    }

    std::unique_ptr<HeadlessContext> context_;
    std::istringstream in_;
    std::ostringstream out_;
    std::ostringstream err_;
    Console console_;
    std::unique_ptr<Renderer> renderer_;

public:
    static constexpr PixelArea kArea{0, 0, 160, 120};
    PlantView view;
    PanelState panels;
    Controls controls;
};

/// The event of the left button at a place of the picture, pixels from its upper left corner.
PointerEvent pointer(PointerEvent::Kind kind, float x, float y, bool shift) {
    PointerEvent event;
    event.kind = kind;
    event.place = {x, y};
    event.shift = shift;
    return event;
}

SenseGroup group_of(const SenseDrawing& drawing, SensePrimitive primitive) {
    for (const SenseGroup& group : drawing.groups) {
        if (group.primitive == primitive) {
            return group;
        }
    }
    return {};
}

} // namespace

TEST_CASE("lists of senses are read and written") {
    CHECK(parse_senses("all").value() == SenseLook{true, true, true, true});
    CHECK(parse_senses("none").value() == SenseLook{false, false, false, false});
    CHECK(parse_senses("light,markers").value() == SenseLook{false, true, true, false});
    CHECK_FALSE(parse_senses("light,"));
    CHECK_FALSE(parse_senses("shadow"));
    for (unsigned bits = 0; bits < 16; ++bits) {
        const SenseLook look{(bits & 1U) != 0, (bits & 2U) != 0, (bits & 4U) != 0,
                             (bits & 8U) != 0};
        CHECK(parse_senses(to_text(look)).value() == look);
    }
}

TEST_CASE("each sense that is shown is a group of the drawing") {
    SensingView viewed(LSYS_SOURCE_DIR "/tests/viewer/senses.lsys");
    REQUIRE(viewed.until([&] { return viewed.view.document() != nullptr; }));
    const SensedPlant& plant = *viewed.view.sensed();
    REQUIRE(plant.parts.size() == 3);
    const Bounds bounds = viewed.view.renderer().bounds();
    const auto drawn = [&](const char* senses) {
        return make_sense_drawing(plant, parse_senses(senses).value(), {}, bounds);
    };
    CHECK(drawn("none").groups.empty());
    // Two triangles of the plane, and two of the wall.
    CHECK(group_of(drawn("obstacles"), SensePrimitive::Triangles).count == 12);
    CHECK(group_of(drawn("light"), SensePrimitive::Points).count == plant.parts[1].voxels.size());
    CHECK(plant.parts[1].voxels.size() > 3);
    CHECK(group_of(drawn("markers"), SensePrimitive::Points).count ==
          plant.parts[2].markers.size());
    CHECK(plant.parts[2].markers.size() > 100);
    CHECK(plant.parts[2].markers.size() < 300); // some are gone
    // Three lines for each module with a direction.
    std::size_t directed = 0;
    for (const SensedPart& part : plant.parts) {
        for (const SensedModule& module : part.modules) {
            const bool is_directed =
                module.answer[1] != 0.0F || module.answer[2] != 0.0F || module.answer[3] != 0.0F;
            directed += is_directed ? 1U : 0U;
        }
    }
    std::size_t lines = 0;
    for (const SenseGroup& group : drawn("directions").groups) {
        CHECK(group.primitive == SensePrimitive::Lines);
        lines += group.count / 2;
    }
    CHECK(directed > 5);
    CHECK(lines == 3 * directed);
}

TEST_CASE("the toggles of senses change the picture, and back") {
    SensingView viewed(LSYS_SOURCE_DIR "/tests/viewer/senses.lsys");
    REQUIRE(viewed.until([&] { return viewed.view.document() != nullptr; }));
    const std::vector<std::uint8_t> plain = viewed.picture();
    for (const Key key : {Key::O, Key::Y, Key::X, Key::D}) {
        CAPTURE(static_cast<int>(key));
        WindowInput input;
        input.presses = {{key}};
        viewed.controls.apply(input, 0.0, 120.0F, viewed.view, viewed.panels);
        CHECK(viewed.picture() != plain);
        viewed.controls.apply(input, 0.0, 120.0F, viewed.view, viewed.panels);
        CHECK(viewed.picture() == plain);
    }
}

TEST_CASE("each generation shows what the plant has sensed by then") {
    SensingView viewed(LSYS_SOURCE_DIR "/tests/viewer/senses.lsys");
    REQUIRE(viewed.until([&] { return viewed.view.document() != nullptr; }));
    const std::size_t last = viewed.view.sensed()->parts[2].markers.size();
    CHECK(viewed.view.sensed()->generation == 9);
    viewed.view.settings.generations = 1;
    REQUIRE(viewed.until([&] { return viewed.view.sensed()->generation == 1; }));
    CHECK(viewed.view.sensed()->parts[2].markers.size() > last);
    viewed.view.settings.generations_per_second = 20.0F;
    viewed.view.play_or_pause();
    REQUIRE(viewed.until(
        [&] { return viewed.view.grown() != nullptr && viewed.view.sensed()->generation > 1; }));
}

TEST_CASE("a plant grows again when an obstacle is moved, and undo moves it back") {
    const ScratchFolder folder;
    write_text(folder / "plant.lsys", kToTheWall);
    SensingView viewed(folder / "plant.lsys");
    REQUIRE(viewed.until_segments(4));
    viewed.view.settings.moves = {{"wall", {-1.0F, 0.0F, 0.0F}}};
    REQUIRE(viewed.until_segments(6));
    CHECK_FALSE(viewed.view.is_unsaved());
    viewed.view.record_edits();
    viewed.view.undo();
    CHECK(viewed.view.settings.moves.empty());
    REQUIRE(viewed.until_segments(4));
}

TEST_CASE("a moved mesh is sensed at its new place") {
    const ScratchFolder folder;
    write_text(folder / "wall.obj", "v -2 -9 -9\nv -2 -9 9\nv -2 9 9\nv -2 9 -9\nf 1 2 3 4\n");
    std::string text = kToTheWall;
    const std::string plane = "plane 1 0 0 2";
    text.replace(text.find(plane), plane.size(), "mesh \"wall.obj\"");
    write_text(folder / "plant.lsys", text);
    SensingView viewed(folder / "plant.lsys");
    REQUIRE(viewed.until_segments(4));
    viewed.view.settings.moves = {{"wall", {-1.0F, 0.0F, 0.0F}}, {"unknown", {1.0F, 0.0F, 0.0F}}};
    REQUIRE(viewed.until_segments(6));
    const EnvironmentMesh& mesh = viewed.view.sensed()->parts[0].meshes[0];
    CHECK(mesh.vertices[0][0] == -3.0);
}

TEST_CASE("the mouse with Shift drags an obstacle instead of the camera") {
    const ScratchFolder folder;
    write_text(folder / "plant.lsys", kToTheWall);
    SensingView viewed(folder / "plant.lsys");
    REQUIRE(viewed.until_segments(4));
    Camera& camera = viewed.view.settings.camera;
    camera.eye = {1.0F, 1.0F, 3.0F};
    camera.target = {-2.0F, 1.0F, 0.0F};
    const Camera before = camera;
    static_cast<void>(viewed.picture());
    const auto drag = [&](bool shift) {
        WindowInput input;
        input.pointer_events = {pointer(PointerEvent::Kind::Press, 80.0F, 60.0F, shift)};
        CHECK(viewed.controls.move_obstacle(input, SensingView::kArea, viewed.view) == shift);
        viewed.view.record_edits(); // a drag is one step of undo
        input.pointer_events = {pointer(PointerEvent::Kind::Move, 60.0F, 60.0F, shift)};
        CHECK(viewed.controls.move_obstacle(input, SensingView::kArea, viewed.view) == shift);
        viewed.view.record_edits();
        input.pointer_events = {pointer(PointerEvent::Kind::Release, 50.0F, 60.0F, shift)};
        CHECK(viewed.controls.move_obstacle(input, SensingView::kArea, viewed.view) == shift);
        CHECK_FALSE(viewed.view.has_grabbed());
        viewed.view.record_edits();
    };
    drag(false);
    CHECK(viewed.view.settings.moves.empty());
    drag(true);
    REQUIRE(viewed.view.settings.moves.size() == 1);
    // The mouse has moved 30 pixels to the left, a quarter of the picture's height. The wall is
    // 3 sqrt(2) m away from the eye, and the view turned by 45 degrees.
    const double half = std::tan(0.5 * 40.0 * 3.14159265358979 / 180.0);
    CHECK(viewed.view.settings.moves[0].by[0] == Approx(-0.5 * half * 3.0).epsilon(1e-4));
    CHECK(viewed.view.settings.moves[0].by[1] == Approx(0.0).margin(1e-5));
    CHECK(viewed.view.settings.camera == before);
    REQUIRE(viewed.until_segments(5));
    viewed.view.undo();
    CHECK(viewed.view.settings.moves.empty());
}

TEST_CASE("another file has its obstacles at their own places") {
    const ScratchFolder folder;
    write_text(folder / "plant.lsys", kToTheWall);
    write_text(folder / "other.lsys", kToTheWall);
    SensingView viewed(folder / "plant.lsys");
    viewed.view.settings.moves = {{"wall", {-1.0F, 0.0F, 0.0F}}};
    REQUIRE(viewed.until_segments(6));
    viewed.view.open(folder / "other.lsys");
    CHECK(viewed.view.settings.moves.empty());
    REQUIRE(viewed.until_segments(4));
}

TEST_CASE("senses are drawn in the size of the plant") {
    const ScratchFolder folder;
    write_text(folder / "plant.lsys", std::string("#set height 2;\n") + kToTheWall);
    SensingView viewed(folder / "plant.lsys");
    REQUIRE(viewed.until_segments(4));
    const SensedPlant& plant = *viewed.view.sensed();
    CHECK(plant.scale == Approx(2.0).epsilon(1e-6));
    // The tip is at (-1.5, 1, 0) when it senses; the wall is to its left.
    const SenseDrawing drawing = make_sense_drawing(plant, parse_senses("directions").value(), {},
                                                    viewed.view.renderer().bounds());
    REQUIRE(drawing.vertices.size() == 6);
    CHECK(drawing.vertices[0].position.x == Approx(-3.0).epsilon(1e-5));
    CHECK(drawing.vertices[0].position.y == Approx(2.0).epsilon(1e-5));
    CHECK(drawing.vertices[1].position.x < -3.0F);
    // The wall stands at x = -4.
    const std::optional<ObstacleHit> hit = first_obstacle(
        plant, {}, viewed.view.renderer().bounds(), {{0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}});
    REQUIRE(hit);
    CHECK(hit->name == "wall");
    CHECK(hit->distance == Approx(4.0).epsilon(1e-5));
    CHECK_FALSE(first_obstacle(plant, {}, viewed.view.renderer().bounds(),
                               {{0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}}));
}
