// SPDX-License-Identifier: MIT
// PlantView without a window: replacing plants, pictures.
#include "tests/support/lsc_run.h"
#include "tests/viewer/lsview_run.h"
#include "viewer/app/controls.h"
#include "viewer/app/plant_view.h"
#include "viewer/app/source_pane.h"
#include "viewer/gl/headless_context.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <filesystem>
#include <sstream>
#include <thread>

#ifndef _WIN32
#include <sys/stat.h>
#endif

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;
using namespace std::chrono_literals;

namespace {

ViewOptions plant_options(const std::string& file) {
    ViewOptions options;
    options.file = file;
    options.run.limits.max_bytes = std::uint64_t{1} << 30;
    options.messages.verbose = true;
    return options;
}

/// A view of `file` and its output.
class ViewedPlant {
public:
    explicit ViewedPlant(const ViewOptions& options)
        : context_(std::move(HeadlessContext::make().value())),
          console_({in_, out_, err, false, nullptr, "lsview"}, options.messages),
          renderer(std::move(Renderer::make(built_in_shader).value())),
          view(options, console_, *renderer, [] {}) {}

    /// Updates and draws once, as a window does.
    void step() {
        view.update();
        if (view.draw(64, 48)) {
            view.picture_shown(0.0);
        }
    }
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
    bool until_swaps(std::uint64_t count) {
        return until([&] { return view.stats().swaps >= count; });
    }
    std::vector<std::uint8_t> picture() {
        std::vector<std::uint8_t> pixels;
        renderer->read(pixels);
        return pixels;
    }

private:
    std::unique_ptr<HeadlessContext> context_;
    std::istringstream in_;
    std::ostringstream out_;

public:
    std::ostringstream err;

private:
    Console console_;

public:
    std::unique_ptr<Renderer> renderer;
    PlantView view;
};

std::string plant(int segments) {
    return "#n = 1;\n#p : G : * : F;\n#w : G" +
           std::string(static_cast<std::size_t>(segments - 1), 'F') + ";\n" +
           "#set names letters;\n";
}

} // namespace

TEST_CASE("a hundred reloads leak no objects of the renderer") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    write_text(file, plant(1));
    ViewedPlant viewed(plant_options(file));
    REQUIRE(viewed.until_swaps(1));
    std::uint64_t objects = 0;
    for (int i = 1; i <= 100; ++i) {
        write_text(file, plant(1 + i % 7));
        viewed.view.reload();
        REQUIRE(viewed.until([&] {
            return viewed.view.document()->plant.modules == static_cast<std::uint64_t>(1 + i % 7);
        }));
        if (i == 10) {
            objects = viewed.renderer->live_objects();
        }
    }
    CHECK(viewed.renderer->live_objects() == objects);
    CHECK(viewed.renderer->errors().empty());
}

#ifndef _WIN32
TEST_CASE("a pipe in place of the file is reported, and the next file is shown") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    write_text(file, plant(2));
    ViewedPlant viewed(plant_options(file));
    REQUIRE(viewed.until_swaps(1));
    std::this_thread::sleep_for(100ms); // until the watch has begun
    std::filesystem::remove(file);
    REQUIRE(mkfifo(file.c_str(), 0600) == 0);
    viewed.view.reload();
    REQUIRE(viewed.until([&] {
        return viewed.view.messages().find("it is not a regular file") != std::string::npos;
    }));
    std::filesystem::remove(file);
    write_text(file, plant(9));
    REQUIRE(viewed.until([&] { return viewed.view.document()->plant.modules == 9; }));
    CHECK_FALSE(viewed.view.failed());
}
#endif

TEST_CASE("a changed file is shown, and a file with errors does not change the picture") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    write_text(file, plant(2));
    ViewedPlant viewed(plant_options(file));
    REQUIRE(viewed.until_swaps(1));
    CHECK(viewed.err.str().find("loaded " + file + ": 2 modules, 2 segments") != std::string::npos);
    const std::vector<std::uint8_t> before = viewed.picture();
    // Wait until the watch has begun.
    std::this_thread::sleep_for(100ms);
    write_text(file, plant(9));
    REQUIRE(viewed.until([&] { return viewed.view.document()->plant.modules == 9; }));
    const std::vector<std::uint8_t> after = viewed.picture();
    CHECK(before != after);
    write_text(file, "#n = 0;\n#w : F(;\n");
    REQUIRE(viewed.until([&] { return viewed.view.failed(); }));
    CHECK(viewed.view.messages() == run_lsc({"check", file}, "").err);
    CHECK(viewed.err.str().find(viewed.view.messages()) != std::string::npos);
    CHECK(viewed.view.document()->plant.modules == 9);
    CHECK(viewed.picture() == after);
    write_text(file, plant(2));
    REQUIRE(viewed.until([&] { return !viewed.view.failed(); }));
    CAPTURE(viewed.view.messages());
    CHECK(viewed.view.messages().empty());
}

TEST_CASE("a plant that draws nothing is reported, and a plant that draws is not") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    const std::string text = "lsview: the plant has nothing to draw after 1 generation\n";
    // A declared module is not drawn, and a segment without length is invisible.
    for (const char* const axiom : {"A", "f(1) F(0)"}) {
        write_text(file, std::string("#n = 1;\n#module A;\n#w : ") + axiom + ";\n");
        const LscRun run = run_lsview({file, "--screenshot", folder / "a.png", "--size", "8x8"});
        CAPTURE(axiom, run.err);
        CHECK(run.status == 0);
        CHECK(run.err.find(text) != std::string::npos);
    }
    ViewedPlant viewed(plant_options(file));
    REQUIRE(viewed.until_swaps(1));
    CHECK(viewed.view.messages().find(text) != std::string::npos);
    CHECK_FALSE(viewed.view.failed());
    CHECK_FALSE(viewed.view.entries().empty());
    write_text(file, plant(1));
    viewed.view.reload();
    REQUIRE(viewed.until([&] { return viewed.view.entries().empty(); }));
    CHECK(run_lsview({file, "--screenshot", folder / "a.png", "--size", "8x8"}).err.empty());
}

TEST_CASE("a note disappears after some seconds") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    write_text(file, plant(1));
    ViewedPlant viewed(plant_options(file));
    View& view = viewed.view;
    view.set_note("wrote plant-1.png");
    const SteadyClock::time_point now = SteadyClock::now();
    CHECK_FALSE(view.drop_old_note(now));
    CHECK(view.note() == "wrote plant-1.png");
    CHECK(view.drop_old_note(now + kNoteTime));
    CHECK(view.note().empty());
    CHECK_FALSE(view.drop_old_note(now + 2 * kNoteTime));
}

TEST_CASE("the plant appears when a missing included file is created") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    write_text(file, "#include \"axiom.lsys\";\n#n = 0;\n");
    ViewedPlant viewed(plant_options(file));
    REQUIRE(viewed.until([&] { return viewed.view.failed(); }));
    CHECK(viewed.view.document() == nullptr);
    std::this_thread::sleep_for(100ms);
    write_text(folder / "axiom.lsys", "#w : F;\n");
    REQUIRE(viewed.until_swaps(1));
    CHECK_FALSE(viewed.view.failed());
}

TEST_CASE("a changed setting makes a new plant, and values of removed constants are dropped") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    write_text(file, "#n = 3;\n#param a 2 {1, 5};\n#w : F(a) A;\n#p : A : * : F A;\n");
    ViewedPlant viewed(plant_options(file));
    REQUIRE(viewed.until_swaps(1));
    CHECK(viewed.view.generations() == 3);
    viewed.view.settings.definitions = {{"a", 4.0F}};
    viewed.view.settings.generations = 1;
    REQUIRE(viewed.until([&] { return viewed.view.document()->plant.generations == 1; }));
    REQUIRE(viewed.until(
        [&] { return viewed.view.document()->plant.skeleton.segments[0].length == 4.0F; }));
    CHECK(viewed.view.default_generations() == 3);
    // A value outside of the bounds is an error; a value within them ends it.
    viewed.view.settings.definitions[0].value = 9.0F;
    REQUIRE(viewed.until([&] { return viewed.view.failed(); }));
    viewed.view.settings.definitions[0].value = 3.0F;
    REQUIRE(viewed.until([&] { return !viewed.view.failed(); }));
    write_text(file, "#n = 0;\n#w : F(1);\n");
    REQUIRE(viewed.until([&] { return viewed.view.document()->plant.modules == 1; }));
    CHECK(viewed.view.settings.definitions.empty());
}

namespace {

/// Lines of `after` that `before` lacks, if all others are the same and in order; else an error.
std::vector<std::string> new_lines(const std::string& before, const std::string& after) {
    std::istringstream old(before);
    std::istringstream now(after);
    std::vector<std::string> added;
    std::string line;
    std::string expected;
    std::getline(old, expected);
    while (std::getline(now, line)) {
        if (line != expected) {
            added.push_back(line);
        } else if (!std::getline(old, expected)) {
            expected = "no more lines";
        }
    }
    return expected == "no more lines" ? added : std::vector<std::string>{"a line is missing"};
}

/// The vertices of the plant shown.
std::vector<glm::vec3> vertices_of(const PlantView& view) {
    const auto& positions = view.document()->mesh.positions;
    return {positions.begin(), positions.end()};
}

} // namespace

TEST_CASE("writing a changed setting to the file changes one line and not the plant") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    const std::string text = "// A fork.\r\n#n = 2;\r\n#set step 2; // metres\r\n"
                             "#w : F [ + F ] F;\r\n#p : F : * : F [ + F ] F;\r\n";
    write_text(file, text);
    ViewedPlant viewed(plant_options(file));
    REQUIRE(viewed.until_swaps(1));
    const std::vector<glm::vec3> square = vertices_of(viewed.view);
    CHECK_FALSE(viewed.view.has_changed_values());
    viewed.view.save();
    CHECK(viewed.view.note() == "no value differs from the file");

    viewed.view.settings.set_values = {{"angle", "32.5"}};
    viewed.view.save();
    CHECK(viewed.view.note() == "not written: the plant with these values is not made yet");
    CHECK(read_text(file) == text);
    const auto angle = [&] { return viewed.view.document()->grammar.bytecode.settings.angle; };
    REQUIRE(viewed.until([&] { return angle() == 32.5F; }));
    const std::vector<glm::vec3> turned = vertices_of(viewed.view);
    CHECK(turned != square);
    viewed.view.save();
    CHECK(viewed.view.note() == "wrote angle to " + file);
    CHECK(new_lines(text, read_text(file)) == std::vector<std::string>{"#set angle 32.5;\r"});
    CHECK_FALSE(viewed.view.has_changed_values());
    const std::uint64_t written = viewed.view.stats().swaps;
    REQUIRE(viewed.until_swaps(written + 1));
    CHECK(vertices_of(viewed.view) == turned);
    ViewedPlant again(plant_options(file));
    REQUIRE(again.until_swaps(1));
    CHECK(vertices_of(again.view) == turned);

    // Only the number of the statement changes.
    viewed.view.settings.set_values = {{"step", "0.5"}};
    REQUIRE(viewed.until(
        [&] { return viewed.view.document()->grammar.bytecode.settings.step == 0.5F; }));
    viewed.view.save();
    CHECK(read_text(file).find("#set step 0.5; // metres\r\n#set angle 32.5;\r\n") !=
          std::string::npos);
}

TEST_CASE("constants and a seed are written with the settings") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    write_text(file, "#n = 0;\n#param a 2 {1, 5};\n#define b 3;\n#w : F(a) F(b);\n");
    ViewedPlant viewed(plant_options(file));
    REQUIRE(viewed.until_swaps(1));
    viewed.view.settings.definitions = {{"a", 4.0F}, {"b", 0.1F}};
    viewed.view.settings.seed = 18446744073709551615U;
    REQUIRE(viewed.until([&] { return viewed.view.document()->plant.seed != 0; }));
    Controls controls;
    PanelState panels;
    WindowInput input;
    input.presses = {{Key::S, true}};
    controls.apply(input, 0.01, 600.0F, viewed.view, panels);
    CHECK(read_text(file) == "#set seed 18446744073709551615;\n#n = 0;\n#param a 4 {1, 5};\n"
                             "#define b 0.1;\n#w : F(a) F(b);\n");
    CHECK_FALSE(viewed.view.has_changed_values());
}

TEST_CASE("values are not written to a file that has changed or cannot hold them") {
    const ScratchFolder folder;
    const auto refused = [&](const std::string& name, const std::string& text,
                             const std::string& later) {
        write_text(folder / name, text);
        ViewOptions options = plant_options(folder / name);
        options.grammar.settings = {{"angle", "30"}};
        options.grammar.generations = 1;
        ViewedPlant viewed(options);
        REQUIRE(viewed.until_swaps(1));
        CHECK(viewed.view.document()->grammar.bytecode.settings.angle == 30.0F);
        write_text(folder / name, later);
        viewed.view.save();
        CHECK(read_text(folder / name) == later);
        CHECK(viewed.view.has_changed_values());
        return viewed.view.note();
    };
    write_text(folder / "part.lsys", "#set angle 25;\n");
    const std::string plain = "#w : F;\n";
    CHECK(refused("a.lsys", plain, plain + "// edited\n") ==
          "not written: `" + folder / "a.lsys" + "` has changed on disk since it was read");
    CHECK(refused("a.lsys", plain, "\xEF\xBB\xBF" + plain).find("changed on disk") !=
          std::string::npos);
    const std::string including = "#include \"part.lsys\";\n#w : F;\n";
    CHECK(refused("b.lsys", including, including).find("stands in the included file") !=
          std::string::npos);
    const std::string rules = "axiom: F\nF=F+F\n";
    CHECK(refused("c.rules", rules, rules).find("is not a .lsys file") != std::string::npos);
    REQUIRE(run_lsc({"compile", folder / "a.lsys", "-n", "1", "-o", folder / "d.lsb"}, "").status ==
            0);
    const std::string compiled = read_text(folder / "d.lsb");
    CHECK(refused("d.lsb", compiled, compiled).find("is compiled") != std::string::npos);
}

TEST_CASE("growth plays from the axiom to the end, with moments between generations") {
    ViewedPlant viewed(plant_options(sample("teach-param")));
    REQUIRE(viewed.until_swaps(1));
    viewed.step();
    const std::vector<std::uint8_t> whole = viewed.picture();
    viewed.view.settings.generations_per_second = 20.0F;
    viewed.view.play_or_pause();
    CHECK(viewed.view.generations() == 0);
    bool was_between = false;
    REQUIRE(viewed.until([&] {
        const FilmMoment* const grown = viewed.view.grown();
        was_between = was_between || (grown != nullptr && grown->moment.fraction > 0.0);
        return !viewed.view.settings.plays;
    }));
    CHECK(was_between);
    CHECK(viewed.view.stats().moments >= 2);
    // At the end of the growth, the plant itself is shown.
    REQUIRE(viewed.until_swaps(2));
    viewed.step();
    CHECK(viewed.view.grown() == nullptr);
    CHECK(viewed.view.document()->plant.generations == 7);
    CHECK(viewed.picture() == whole);
}

TEST_CASE("growth can be paused and resumed, and ends if a generation is chosen") {
    ViewOptions options = plant_options(sample("teach-param"));
    options.grow = true; // growth starts to play
    ViewedPlant viewed(options);
    REQUIRE(viewed.until([&] {
        const FilmMoment* const grown = viewed.view.grown();
        return grown != nullptr && grown->moment.fraction > 0.0;
    }));
    viewed.view.play_or_pause();
    const GrowthMoment paused = viewed.view.grown()->moment;
    for (int i = 0; i < 20; ++i) {
        viewed.step();
    }
    REQUIRE(viewed.view.grown() != nullptr);
    CHECK(viewed.view.grown()->moment.fraction == paused.fraction);
    CHECK(viewed.view.stats().swaps == 1);
    viewed.view.play_or_pause();
    REQUIRE(viewed.until([&] {
        const GrowthMoment& now = viewed.view.grown()->moment;
        return now.generation > paused.generation || now.fraction > paused.fraction;
    }));
    step_generations(viewed.view, 1);
    REQUIRE(viewed.until_swaps(2));
    CHECK(viewed.view.grown() == nullptr);
    CHECK_FALSE(viewed.view.settings.plays);
    CHECK(viewed.view.document()->plant.generations == viewed.view.generations());
}

TEST_CASE("a plant bends in the wind and stands again without wind") {
    ViewedPlant viewed(plant_options(sample("teach-bending")));
    REQUIRE(viewed.until_swaps(1));
    viewed.step();
    const std::vector<std::uint8_t> still = viewed.picture();
    viewed.view.settings.simulates = true;
    viewed.view.settings.bending.forces.wind.velocity = {20.0F, 0.0F, 0.0F};
    REQUIRE(viewed.until([&] { return viewed.view.stats().bend_time > 0.5; }));
    CHECK(viewed.picture() != still);
    viewed.view.settings.bending.stiffness = 0.5F;
    viewed.step();
    REQUIRE(viewed.until([&] { return viewed.view.stats().bend_time < 0.5; }));
    viewed.view.settings.simulates = false;
    viewed.step();
    CHECK(viewed.picture() == still);
}

TEST_CASE("another file is opened with the whole plant in view, and without a person") {
    ViewOptions options = plant_options(sample("teach-param"));
    options.figure = true;
    ViewedPlant viewed(options);
    REQUIRE(viewed.until_swaps(1));
    const glm::vec3 first_direction = forward_of(viewed.view.settings.camera);
    viewed.view.show_from(StandardView::Top);
    const Camera before = viewed.view.settings.camera;
    CHECK(viewed.view.settings.figure);
    viewed.view.open(sample("teach-bending"));
    REQUIRE(viewed.until_swaps(2));
    CHECK_FALSE(viewed.view.settings.camera == before);
    CHECK(glm::distance(forward_of(viewed.view.settings.camera), first_direction) < 1e-3F);
    CHECK_FALSE(viewed.view.settings.figure);
    CHECK(viewed.view.document()->plant.generations == viewed.view.default_generations());
}

TEST_CASE("another file is opened without the options of the first") {
    ViewOptions options = plant_options(sample("teach-param"));
    options.grammar.dialect = "lsys";
    options.grammar.generations = 1;
    ViewedPlant viewed(options);
    REQUIRE(viewed.until_swaps(1));
    CHECK(viewed.view.generations() == 1);
    const ScratchFolder scratch;
    write_text(scratch / "figure.rules", "axiom: F\ngenerations: 3\nF=FF\n");
    viewed.view.open(scratch / "figure.rules");
    REQUIRE(viewed.until_swaps(2));
    CHECK(viewed.view.default_generations() == 3);
    CHECK(viewed.view.document()->plant.skeleton.segments.size() == 8);
}

TEST_CASE("keys change the display, and letters move the camera while flying") {
    ViewedPlant viewed(plant_options(sample("teach-param")));
    REQUIRE(viewed.until_swaps(1));
    PlantViewSettings& settings = viewed.view.settings;
    Controls controls;
    PanelState panels;
    const auto press = [&](Key key, bool control = false) {
        WindowInput input;
        input.presses = {{key, control}};
        controls.apply(input, 0.01, 600.0F, viewed.view, panels);
    };
    press(Key::W);
    CHECK(settings.style == PlantStyle::Wireframe);
    press(Key::I);
    CHECK(settings.style == PlantStyle::None);
    press(Key::L);
    CHECK(settings.lines == LineKind::Skeleton);
    press(Key::S);
    CHECK_FALSE(settings.shadows);
    press(Key::PageDown);
    CHECK(viewed.view.generations() == 6);
    press(Key::N);
    CHECK(settings.seed == 1);
    press(Key::F1);
    CHECK(panels.help);
    press(Key::Escape);
    CHECK_FALSE(panels.help);
    press(Key::Q);
    CHECK_FALSE(panels.wants_to_quit);
    const Camera before = settings.camera;
    press(Key::Tab);
    press(Key::G);
    CHECK(settings.ground);
    WindowInput flying;
    flying.held = {Key::W};
    controls.apply(flying, 0.1, 600.0F, viewed.view, panels);
    CHECK(glm::dot(settings.camera.eye - before.eye, forward_of(before)) > 0.0F);
    flying.held = {};
    flying.motion = {50.0F, 0.0F};
    const Camera before_turn = settings.camera;
    controls.apply(flying, 0.1, 600.0F, viewed.view, panels);
    CHECK(settings.camera.eye == before_turn.eye);
    CHECK_FALSE(settings.camera.target == before_turn.target);
    press(Key::Tab);
    CHECK_FALSE(panels.flies);
    press(Key::Q, true);
    CHECK(panels.wants_to_quit);
}

TEST_CASE("the mouse orbits, pans and zooms") {
    ViewedPlant viewed(plant_options(sample("teach-param")));
    REQUIRE(viewed.until_swaps(1));
    Camera& camera = viewed.view.settings.camera;
    Controls controls;
    PanelState panels;
    const auto apply = [&](const WindowInput& input) {
        controls.apply(input, 0.01, 600.0F, viewed.view, panels);
    };
    const Camera before = camera;
    WindowInput input;
    input.left_drag = {100.0F, 20.0F};
    apply(input);
    CHECK(camera.target == before.target);
    CHECK_FALSE(camera.eye == before.eye);
    camera = before;
    input = {};
    input.right_drag = {60.0F, 0.0F}; // the picture moves to the right with the mouse
    apply(input);
    CHECK(glm::dot(camera.target - before.target, right_of(before)) < 0.0F);
    camera = before;
    input = {};
    input.wheel = 1.0F;
    apply(input);
    CHECK(glm::distance(camera.eye, camera.target) < glm::distance(before.eye, before.target));
}

TEST_CASE("changed shaders are compiled, and shaders with mistakes do not change the picture") {
    const ScratchFolder folder;
    const std::string shaders = LSYS_SOURCE_DIR "/viewer/shaders/";
    for (const auto& entry : std::filesystem::directory_iterator(shaders)) {
        std::filesystem::copy(entry.path(), folder.path() / entry.path().filename());
    }
    ViewOptions options = plant_options(sample("teach-param"));
    options.shaders = folder / "";
    ViewedPlant viewed(options);
    REQUIRE(viewed.until_swaps(1));
    viewed.step();
    const std::vector<std::uint8_t> before = viewed.picture();
    std::this_thread::sleep_for(100ms); // wait until the watch has begun
    const std::string sky = read_text(folder / "sky.frag.glsl");
    write_text(folder / "sky.frag.glsl", "out vec4 colour;\nvoid main() { colour = x; }\n");
    REQUIRE(viewed.until([&] { return !viewed.view.shader_message().empty(); }));
    CHECK(viewed.view.shader_message().find("sky.frag.glsl:2") != std::string::npos);
    CHECK(viewed.picture() == before);
    write_text(folder / "sky.frag.glsl",
               "out vec4 colour;\nvoid main() { colour = vec4(1.0, 0.0, 0.0, 1.0); }\n");
    REQUIRE(viewed.until([&] { return viewed.view.shader_message().empty(); }));
    viewed.step();
    CHECK(viewed.picture() != before);
    CHECK(viewed.view.stats().swaps == 1);
}

TEST_CASE("changed settings are undone and redone") {
    ViewedPlant viewed(plant_options(sample("teach-param")));
    REQUIRE(viewed.until_swaps(1));
    PlantView& view = viewed.view;
    view.record_edits();
    view.undo();
    CHECK(view.note() == "Nothing to undo"); // loading is no step
    // A drag passes several values before the control is released.
    view.settings.generations = 3;
    view.settings.generations = 2;
    view.record_edits();
    view.settings.shadows = false;
    view.record_edits();
    const Camera camera = view.settings.camera = orbited(view.settings.camera, 0.5F, 0.0F);
    view.record_edits();
    view.undo();
    CHECK(view.settings.shadows);
    CHECK(view.generations() == 2);
    view.undo();
    CHECK(view.generations() == view.default_generations());
    CHECK(view.settings.camera == camera);
    view.undo();
    CHECK(view.note() == "Nothing to undo");
    view.redo();
    view.redo();
    CHECK(view.generations() == 2);
    CHECK_FALSE(view.settings.shadows);
    view.redo();
    CHECK(view.note() == "Nothing to redo");
    REQUIRE(viewed.until([&] { return view.document()->plant.generations == 2; }));
    // A new step ends what can be redone.
    view.undo();
    view.settings.ground = false;
    view.redo();
    CHECK(view.settings.shadows);
    CHECK(view.note() == "Nothing to redo");
}

TEST_CASE("a plant that takes long is reported, and cancelled together with its settings") {
    const ScratchFolder scratch;
    const std::string file = scratch / "doubling.lsys";
    write_text(file, "#n = 3;\n#w : A(0);\n#p : A(x) : x >= 0 : A(x) F A(x);\n");
    ViewOptions options = plant_options(file);
    options.run.limits.max_bytes = std::uint64_t{1} << 40;
    options.run.limits.max_modules = std::uint64_t{1} << 42;
    ViewedPlant viewed(options);
    REQUIRE(viewed.until_swaps(1));
    PlantView& view = viewed.view;
    CHECK_FALSE(view.making());
    view.settings.generations = 40;
    REQUIRE(viewed.until([&] {
        const std::optional<MakingState> making = view.making();
        return making && making->text.starts_with("Deriving generation ") &&
               making->text.find(" of 40: ") != std::string::npos;
    }));
    REQUIRE(view.making()->fraction);
    CHECK(*view.making()->fraction < 0.5F);
    Controls controls;
    PanelState panels;
    WindowInput input;
    input.presses = {{Key::Escape}};
    controls.apply(input, 0.01, 600.0F, view, panels);
    CHECK_FALSE(view.making());
    CHECK(view.note() == "Cancelled: the last plant is shown");
    CHECK(view.generations() == 3);
    REQUIRE(viewed.until([&] { return !view.is_busy(); }));
    CHECK(view.stats().swaps == 1);
    CHECK(view.document()->plant.generations == 3);
    view.reload();
    REQUIRE(viewed.until_swaps(2));
    CHECK(view.document()->plant.generations == 3);

    // After the plant of a changed file was cancelled, the next change of a setting reads the file.
    write_text(file, "#n = 40;\n#w : A(0);\n#p : A(x) : x >= 0 : A(x) F F A(x);\n");
    REQUIRE(viewed.until([&] { return view.making().has_value(); }));
    view.cancel_making();
    view.settings.generations = 2;
    REQUIRE(viewed.until_swaps(3));
    CHECK(view.document()->plant.modules == 10);

    // If the plant of another file is cancelled, the first file stays open.
    const std::string other = scratch / "other.lsys";
    write_text(other, "#n = 40;\n#w : A(0);\n#p : A(x) : x >= 0 : A(x) F A(x);\n");
    view.open(other);
    REQUIRE(viewed.until([&] { return view.making().has_value(); }));
    view.cancel_making();
    CHECK(view.path() == file);
    CHECK(view.generations() == 2);
    REQUIRE(viewed.until([&] { return !view.is_busy(); }));
    CHECK(view.stats().swaps == 3);
}

TEST_CASE("values changed in the window are unsaved until they are written or taken back") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    write_text(file, "#param size 1 {0.5, 2};\n#n = 0;\n#w : F(size);\n");
    ViewOptions options = plant_options(file);
    options.seed = 3; // of the command line: not a change of the user
    ViewedPlant viewed(options);
    REQUIRE(viewed.until_swaps(1));
    CHECK_FALSE(viewed.view.is_unsaved());
    viewed.view.settings.definitions = {{"size", 2.0F}};
    CHECK(viewed.view.is_unsaved());
    viewed.view.undo();
    CHECK_FALSE(viewed.view.is_unsaved());
    viewed.view.redo();
    REQUIRE(viewed.until_swaps(2));
    CHECK(viewed.view.is_unsaved());
    viewed.view.save();
    CAPTURE(viewed.view.note());
    CHECK_FALSE(viewed.view.is_unsaved());
    CHECK(read_text(file).find("#param size 2 {0.5, 2}") != std::string::npos);
    viewed.view.settings.set_values = {{"angle", "30"}};
    CHECK(viewed.view.is_unsaved());
    viewed.view.open(sample("teach-param"));
    CHECK_FALSE(viewed.view.is_unsaved());
}

TEST_CASE("the plant shown is exported with its values, or the reason is reported") {
    const ScratchFolder scratch;
    ViewedPlant viewed(plant_options(sample("teach-param")));
    REQUIRE(viewed.until_swaps(1));
    PlantView& view = viewed.view;
    CHECK(view.settings.output.file == "teach-param.glb");
    view.settings.generations = 2;
    view.settings.seed = 5;
    view.settings.mesh.sides = 4;
    REQUIRE(viewed.until_swaps(2));
    view.settings.output.file = scratch / "shown.obj";
    view.export_shown();
    REQUIRE(viewed.until([&] { return view.note().starts_with("Wrote "); }));
    CHECK(view.note().ends_with("shown.obj"));
    CHECK(std::filesystem::exists(scratch / "shown.mtl"));
    const LscRun run = run_lsc({"export", sample("teach-param"), "-n", "2", "--seed", "5",
                                "--sides", "4", "-o", scratch / "same.obj", "-q"},
                               "");
    REQUIRE(run.status == 0);
    const auto vertices = [](const std::string& file) {
        const std::string text = read_text(file);
        return text.substr(text.find("\nv "), text.rfind("\nv ") - text.find("\nv "));
    };
    CHECK(vertices(scratch / "shown.obj") == vertices(scratch / "same.obj"));

    view.settings.output = {scratch / "plant.glb", "web", 0};
    view.export_shown();
    REQUIRE(viewed.until([&] { return view.note().find("plant.glb") != std::string::npos; }));
    CHECK(read_text(scratch / "plant.glb").find("EXT_meshopt_compression") != std::string::npos);

    view.settings.output = {scratch / "plant.doc", "", 0};
    view.export_shown();
    REQUIRE(viewed.until([&] { return view.note().find("plant.doc") != std::string::npos; }));
    CHECK(view.note().find("no extension of a known format") != std::string::npos);
    view.settings.output = {scratch / "plant.stl", "web", 0};
    view.export_shown();
    REQUIRE(viewed.until([&] { return view.note().find("web") != std::string::npos; }));
    CHECK_FALSE(std::filesystem::exists(scratch / "plant.stl"));
}

TEST_CASE("an export of the window does not replace a file that the grammar names") {
    const ScratchFolder folder;
    const std::string leaf = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    write_text(folder / "leaf.obj", leaf);
    write_text(folder / "plant.lsys", "#object L \"leaf.obj\";\n#n = 1;\n#w : !(0.1) F L;\n");
    ViewedPlant viewed(plant_options(folder / "plant.lsys"));
    REQUIRE(viewed.until_swaps(1));
    viewed.view.settings.output.file = folder / "leaf.obj";
    viewed.view.export_shown();
    REQUIRE(viewed.until([&] { return !viewed.view.note().empty(); }));
    CHECK(viewed.view.note().find("it is an input") != std::string::npos);
    CHECK(read_text(folder / "leaf.obj") == leaf);
    CHECK_FALSE(std::filesystem::exists(folder / "leaf.mtl"));
}

TEST_CASE("undo takes back fixes of the file in turn with settings") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    const std::string before = plant(2);
    const std::string after = plant(3);
    write_text(file, before);
    ViewedPlant viewed(plant_options(file));
    REQUIRE(viewed.until_swaps(1));
    viewed.view.settings.generations = 0;
    viewed.view.record_edits();
    viewed.view.change_files({{file, before, after}}, "fixed it");
    CHECK(viewed.view.note() == "fixed it");
    CHECK(read_text(file) == after);
    viewed.view.settings.shadows = false;
    viewed.view.undo();
    CHECK(viewed.view.settings.shadows);
    CHECK(read_text(file) == after);
    viewed.view.undo();
    CHECK(read_text(file) == before);
    CHECK(viewed.view.settings.generations == 0);
    viewed.view.undo();
    CHECK_FALSE(viewed.view.settings.generations);
    viewed.view.redo();
    viewed.view.redo();
    CHECK(read_text(file) == after);
    // A change by another program stays, and earlier steps can still be undone.
    write_text(file, after + "\n");
    viewed.view.undo();
    CHECK(viewed.view.note() ==
          "not taken back: `" + file + "` has changed on disk since it was read");
    CHECK(read_text(file) == after + "\n");
    viewed.view.undo();
    CHECK_FALSE(viewed.view.settings.generations);
    // A fix of a text that is no longer there is not written.
    viewed.view.change_files({{file, before, after}}, "fixed it");
    CHECK(viewed.view.note() ==
          "not written: `" + file + "` has changed on disk since it was read");
    CHECK(read_text(file) == after + "\n");
}

TEST_CASE("the source pane follows loads, picks, messages and keys") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    write_text(file, "#n = 1;\n#w : F\n  F;\n#set width 0.5;\n");
    ViewedPlant viewed(plant_options(file));
    PlantView& view = viewed.view;
    SourcePane pane;
    std::size_t news = 0;
    const auto until_pane = [&](const auto& done) {
        return viewed.until([&] {
            if (pane.update(view, [] {})) {
                ++news;
            }
            return done();
        });
    };
    REQUIRE(viewed.until_swaps(1));
    CHECK_FALSE(pane.update(view, [] {})); // it is not shown
    pane.look.is_shown = true;
    REQUIRE(until_pane([&] { return pane.source() != nullptr; }));
    CHECK(news == 1);
    pane.lay_out(40);
    CHECK(pane.rows().size() == 5);
    CHECK(pane.place_to_open(view).line == 1);

    // A pick selects and marks the lines of the statement.
    for (std::uint32_t x = 20; x < 44 && !view.picked().place; ++x) {
        view.pick({x, 24});
        REQUIRE(viewed.until([&] { return !view.is_busy(); }));
    }
    REQUIRE(view.picked().place);
    REQUIRE(until_pane([&] { return pane.highlighted().first != 0; }));
    CHECK(pane.highlighted().first == 2);
    CHECK(pane.highlighted().last == 3);
    CHECK(pane.selected().first == view.picked().place->line);
    CHECK(pane.take_target() == view.picked().place->line);
    CHECK(pane.place_to_open(view).line == view.picked().place->line);
    view.forget_picked();
    REQUIRE(until_pane([&] { return pane.highlighted().first == 0; }));

    // Keys move the selection, and Shift extends it.
    const auto press = [&pane](Key key, bool shift) {
        KeyPress one;
        one.key = key;
        one.shift = shift;
        return pane.press(one);
    };
    CHECK(press(Key::Home, false));
    CHECK(press(Key::Up, false));
    CHECK(press(Key::Down, false));
    CHECK(press(Key::Down, true));
    CHECK(pane.selected_text() == "#w : F\n  F;\n");
    CHECK(press(Key::End, false));
    CHECK(pane.selected().first == 5);
    CHECK(press(Key::PageUp, false));
    CHECK(pane.selected().first == 1);
    CHECK_FALSE(press(Key::N, false));

    // The new text is shown with its mistakes, beside the old plant.
    write_text(file, "#n = 1;\n#w : F(k);\n#set width 0.5;\n\n#q : F : * : F(m);\n");
    view.reload();
    REQUIRE(viewed.until([&] { return view.failed(); }));
    REQUIRE(until_pane([&] { return pane.source()->messages.size() == 2; }));
    CHECK(pane.take_target() == 2U);
    pane.lay_out(80);
    CHECK(pane.rows()[2].kind == SourceRow::Kind::Marks);
    CHECK(pane.rows()[2].line == 2);
    CHECK(plain_text(pane.texts().at(pane.rows()[3].index)).starts_with("error: "));
    pane.lay_out(40); // the label needs a row of its own
    CHECK(plain_text(pane.texts().at(pane.rows()[3].index)) ==
          "no constant of this name is defined");
    pane.go_to_message(1, view);
    CHECK(pane.selected().first == 2);
    pane.go_to_message(1, view);
    CHECK(pane.selected().first == 5);
    pane.go_to_message(1, view);
    CHECK(pane.selected().first == 2);
    pane.go_to_message(-1, view);
    CHECK(pane.selected().first == 5);
    CHECK(pane.place_to_open(view).column == pane.source()->messages[1].column);
}
