// SPDX-License-Identifier: MIT
// ForestView without a window: replacing forests, painting, the scene file.
#include "runtime/meshing/texture.h"
#include "tests/support/lsc_run.h"
#include "tests/viewer/lsview_run.h"
#include "viewer/app/controls.h"
#include "viewer/app/view_switcher.h"
#include "viewer/gl/headless_context.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <thread>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;
using namespace std::chrono_literals;

namespace {

constexpr std::uint32_t kWidth = 96;
constexpr std::uint32_t kHeight = 64;
constexpr const char* kBush = "#n = 3;\n#set names letters;\n#set angle 25;\n#w : A;\n"
                              "#p : A : ~ 0.5 : F[+A][-A]/A;\n#q : A : ~ 0.5 : F[+A]//A;\n";

std::string wood(int trees, const std::string& more = {}) {
    return "key = 3\n\n[terrain]\nkind = \"noise\"\nsize = 60\nheight = 6\nfeature = 30\n\n"
           "[placement]\nmethod = \"uniform\"\ncount = " +
           std::to_string(trees) +
           "\n\n[[species]]\nname = \"bush\"\ngrammar = \"bush.lsys\"\nheroes = 3\n" + more;
}

ViewOptions forest_options(const std::string& file) {
    ViewOptions options;
    options.file = file;
    options.is_forest = true;
    options.files = {file};
    options.run.limits.max_modules = std::uint64_t{1} << 24;
    options.run.limits.max_bytes = std::uint64_t{1} << 30;
    options.messages.verbose = true;
    return options;
}

/// The views of a window opened with a scene, and their output.
class ViewedForest {
public:
    explicit ViewedForest(const ViewOptions& options)
        : context_(std::move(HeadlessContext::make().value())),
          console_({in_, out_, err, false, nullptr, "lsview"}, options.messages),
          renderer(std::move(Renderer::make(built_in_shader).value())),
          views(options, console_, *renderer, [] {}) {}

    ForestView& forest() { return *views.forest(); }

    /// Updates and draws once, as a window does; returns whether it drew. `seconds`: reported draw
    /// time.
    bool step(double seconds = 0.0) {
        views.current().update();
        const bool drew = views.current().draw(kWidth, kHeight);
        if (drew) {
            views.current().picture_shown(seconds);
        }
        return drew;
    }
    /// Steps until `done`; returns false after 60 s.
    template <typename Condition>
    bool until(Condition&& done) {
        for (const auto start = SteadyClock::now(); SteadyClock::now() - start < 60s;) {
            step();
            if (done()) {
                return true;
            }
            std::this_thread::sleep_for(1ms);
        }
        return false;
    }
    bool until_swaps(std::uint64_t count) {
        return until(
            [&] { return forest().stats().swaps >= count && forest().has_all_impostors(); });
    }
    bool until_trees(std::uint64_t count) {
        return until([&] {
            return forest().painting().tree_count() == count && forest().has_all_impostors();
        });
    }
    std::vector<std::uint8_t> picture() {
        REQUIRE(until([&] { return !forest().is_coarse(); }));
        std::vector<std::uint8_t> pixels;
        renderer->read(pixels);
        return pixels;
    }
    /// Points the camera straight down on a place.
    void look_at(float x, float z) {
        forest().settings.camera = {{x, 60.0F, z + 0.1F}, {x, 0.0F, z}, 40.0F};
    }
    /// One press of the tool in the middle of the picture.
    void press() {
        forest().apply_tool({0.0F, 0.0F}, true, false);
        forest().end_stroke();
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
    ViewSwitcher views;
};

/// A scene and its grammar in a temporary folder.
struct WoodFolder {
    explicit WoodFolder(const std::string& text) : scene(folder / "wood.toml") {
        write_text(folder / "bush.lsys", kBush);
        write_text(scene, text);
    }
    ScratchFolder folder;
    std::string scene;
};

void wait_for_watch() {
    std::this_thread::sleep_for(100ms);
}

} // namespace

TEST_CASE("a scene is shown, and shown again after it has changed") {
    const WoodFolder files(wood(200));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    CHECK(viewed.err.str().find("wood.toml: 200 trees of 1 species") != std::string::npos);
    CHECK(viewed.forest().stats().drawn.triangles > 0);
    REQUIRE(viewed.forest().stats().caches.size() == 1);
    CHECK(viewed.forest().stats().caches[0].heroes == 3);
    CHECK(viewed.forest().stats().caches[0].hits > 0);
    const std::vector<std::uint8_t> before = viewed.picture();
    wait_for_watch();
    write_text(files.scene, wood(20));
    REQUIRE(viewed.until_trees(20));
    CHECK(viewed.picture() != before);
    // Change a grammar that the scene names.
    const std::uint64_t swaps = viewed.forest().stats().swaps;
    wait_for_watch();
    write_text(files.folder / "bush.lsys",
               "#n = 1;\n#set names letters;\n#w : A;\n#p : A : * : FFFF;\n");
    REQUIRE(viewed.until_swaps(swaps + 1));
    CHECK(viewed.forest().stats().caches[0].branches == 3);
    CHECK(viewed.renderer->errors().empty());
}

TEST_CASE("a scene or grammar with errors does not change the picture") {
    const WoodFolder files(wood(100));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    const std::vector<std::uint8_t> before = viewed.picture();
    wait_for_watch();
    write_text(files.scene, wood(100) + "colour = 3\n");
    REQUIRE(viewed.until([&] { return viewed.forest().failed(); }));
    const LscRun checked = run_lsc({"forest", files.scene, "--check"}, "");
    CHECK(checked.status == 1);
    CHECK(viewed.forest().messages() == checked.err);
    CHECK(viewed.picture() == before);
    write_text(files.scene, wood(100));
    REQUIRE(viewed.until([&] { return !viewed.forest().failed(); }));
    wait_for_watch();
    write_text(files.folder / "bush.lsys", "#n = 3;\n#w : F(;\n");
    REQUIRE(viewed.until([&] { return viewed.forest().failed(); }));
    CHECK(viewed.forest().messages().find("bush.lsys:2:") != std::string::npos);
    // Moving a slider does not hide the error in the grammar.
    viewed.forest().settings.edits.key = 9;
    for (int i = 0; i < 50; ++i) {
        viewed.step();
        std::this_thread::sleep_for(2ms);
    }
    CHECK(viewed.forest().failed());
    write_text(files.folder / "bush.lsys", kBush);
    REQUIRE(viewed.until([&] { return !viewed.forest().failed(); }));
    CHECK(viewed.forest().messages().find("error") == std::string::npos);
}

TEST_CASE("a scene that is deleted while it is shown is reported and shown again later") {
    const WoodFolder files(wood(50));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    const std::vector<std::uint8_t> before = viewed.picture();
    wait_for_watch();
    std::filesystem::remove(files.scene);
    REQUIRE(viewed.until([&] { return viewed.forest().failed(); }));
    CHECK(viewed.forest().messages().find("wood.toml") != std::string::npos);
    CHECK(viewed.picture() == before);
    viewed.look_at(30.0F, 30.0F);
    viewed.forest().settings.tool = PaintTool::OneTree;
    viewed.press();
    viewed.forest().save();
    CHECK(viewed.forest().note().find("not saved: ") == 0);
    CHECK(viewed.forest().is_unsaved());
    CHECK_FALSE(std::filesystem::exists(files.scene));
    write_text(files.scene, wood(60));
    REQUIRE(viewed.until_trees(61)); // painted trees stay
    CHECK_FALSE(viewed.forest().failed());
}

TEST_CASE("missing files of a scene are reported at their place and watched for") {
    const WoodFolder files(wood(20));
    std::filesystem::remove(files.folder / "bush.lsys");
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until([&] { return viewed.forest().failed(); }));
    CHECK(viewed.forest().document() == nullptr);
    CHECK(viewed.forest().messages().find("wood.toml:15:") != std::string::npos);
    wait_for_watch();
    write_text(files.folder / "bush.lsys", kBush);
    REQUIRE(viewed.until_trees(20));
    CHECK_FALSE(viewed.forest().failed());
    wait_for_watch();
    write_text(files.scene, wood(20) + "\n[[species]]\ngrammar = \"none.lsys\"\n");
    REQUIRE(viewed.until([&] { return viewed.forest().failed(); }));
    wait_for_watch();
    write_text(files.folder / "none.lsys", kBush);
    REQUIRE(viewed.until([&] { return viewed.forest().document()->scene.species.size() == 2; }));
}

TEST_CASE("values set in the window replace those of the scene") {
    const WoodFolder files(wood(100));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    SceneOverrides& edits = viewed.forest().settings.edits;
    edits.count = 40;
    REQUIRE(viewed.until_trees(40));
    edits.species["bush"].heroes = 5;
    REQUIRE(viewed.until([&] { return viewed.forest().stats().caches[0].heroes == 5; }));
    edits.species["bush"].min_scale = 2.0F;
    edits.species["bush"].max_scale = 2.0F;
    REQUIRE(viewed.until(
        [&] { return viewed.forest().document()->grown.forest.trees[0].scale == 2.0F; }));
    choose_method(edits, PlacementMethod::PoissonDisk, viewed.forest().document()->scene);
    REQUIRE(viewed.until([&] {
        return viewed.forest().document()->scene.placement.method == PlacementMethod::PoissonDisk;
    }));
    CHECK(viewed.forest().painting().tree_count() > 25); // about 40
    CHECK(viewed.forest().painting().tree_count() < 60);
    edits.terrain = TerrainKind::Flat;
    REQUIRE(viewed.until(
        [&] { return viewed.forest().document()->grown.forest.trees[0].position.y == 0.0F; }));
    edits.spacing = -1.0;
    REQUIRE(viewed.until([&] { return viewed.forest().failed(); }));
    CHECK(viewed.forest().messages().find("placement: ") != std::string::npos);
    edits = {};
    REQUIRE(viewed.until_trees(100));
    CHECK_FALSE(viewed.forest().failed());
}

TEST_CASE("after a change of season the picture, with its shadows, is that of a new view") {
    const std::string text = "season = 0.1\n" + wood(12);
    const std::string bush = "#param season 0.5 {0, 1};\n#n = 4;\n#set names letters;\n"
                             "#set width 0.1;\n#w : A;\n"
                             "#p : A : * : F(1)[+(50)F(4*season)][-(50)F(4*season)]/(90)A;\n";
    const WoodFolder files(text);
    write_text(files.folder / "bush.lsys", bush);
    ViewOptions options = forest_options(files.scene);
    options.quality = Quality::Medium; // with shadows of branches
    const auto settle = [](ViewedForest& viewed) {
        viewed.forest().settings.camera = {{30.0F, 12.0F, 62.0F}, {30.0F, 2.0F, 30.0F}, 40.0F};
        const SteadyClock::time_point start = SteadyClock::now();
        REQUIRE(viewed.until([&] { return SteadyClock::now() - start > 1s; }));
        return viewed.picture();
    };
    std::vector<std::uint8_t> changed;
    {
        ViewedForest viewed(options);
        REQUIRE(viewed.until_swaps(1));
        const std::vector<std::uint8_t> before = settle(viewed);
        viewed.forest().settings.edits.season = 0.9F;
        REQUIRE(viewed.until_swaps(2));
        changed = settle(viewed);
        CHECK(changed != before);
        // Writing the season to the scene changes one line, and not the picture.
        CHECK(viewed.forest().is_unsaved());
        viewed.forest().save();
        CAPTURE(viewed.forest().note());
        CHECK_FALSE(viewed.forest().is_unsaved());
        CHECK(read_text(files.scene) == "season = 0.9\n" + wood(12));
        REQUIRE(viewed.until_swaps(3));
        CHECK(viewed.forest().document()->season == 0.9F);
        CHECK(settle(viewed) == changed);
    }
    ViewedForest viewed(options);
    REQUIRE(viewed.until_swaps(1));
    CHECK(settle(viewed) == changed);
    // If `define` sets the constant `season`, the forest has no season.
    write_text(files.scene, wood(12, "define = { season = 0.3 }\n"));
    viewed.forest().reload();
    REQUIRE(viewed.until_swaps(2));
    CHECK_FALSE(viewed.forest().document()->season);
}

TEST_CASE("a forest grows from its first year to its last") {
    const WoodFolder files("key = 3\n[terrain]\nsize = 40\n[placement]\nmethod = \"domination\"\n"
                           "count = 60\nyears = 30\n[[species]]\nname = \"bush\"\n"
                           "grammar = \"bush.lsys\"\nstages = [1, 3]\nyears_of_stage = 10\n");
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    CHECK(viewed.forest().default_years() == 30);
    CHECK(viewed.forest().years() == 30);
    const std::uint64_t grown = viewed.forest().painting().tree_count();
    viewed.forest().set_years(1);
    REQUIRE(viewed.until([&] { return viewed.forest().painting().tree_count() != grown; }));
    viewed.forest().settings.years_per_second = 100.0F;
    viewed.forest().play_or_pause();
    REQUIRE(viewed.until([&] { return !viewed.forest().settings.plays; }));
    REQUIRE(viewed.until([&] { return viewed.forest().painting().tree_count() == grown; }));
    CHECK(viewed.forest().stats().swaps >= 3);
    CHECK(viewed.forest().stats().moments > 0);
    CHECK(viewed.forest().years() == 30);
    viewed.forest().play_or_pause();
    CHECK(viewed.forest().years() == 0);
}

TEST_CASE("the growth of a forest has no jumps between two moments and pauses at a whole year") {
    const WoodFolder files("key = 3\n[terrain]\nsize = 40\n[placement]\nmethod = \"domination\"\n"
                           "count = 60\nyears = 12\n[[species]]\nname = \"bush\"\n"
                           "grammar = \"bush.lsys\"\nstages = [1, 2, 3]\nyears_of_stage = 4\n"
                           "[species.growth]\nmaturity = 3\nseeds = 0.5\nseed_distance = 9\n");
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    ForestView& forest = viewed.forest();
    const auto heights = [&] {
        std::map<std::uint32_t, double> of_trees;
        for (const Tree& tree : forest.document()->grown.forest.trees) {
            const ForestModel& model = forest.document()->model;
            of_trees[tree.number] =
                static_cast<double>(tree.scale * model.forms[model.form_of(tree)].height());
        }
        return of_trees;
    };
    double tallest = 0.0;
    for (const auto& [number, height] : heights()) {
        tallest = std::max(tallest, height);
    }
    forest.settings.years_per_second = 4.0F; // at most a year per step
    forest.play_or_pause();
    std::map<std::uint32_t, double> before;
    double last = -1.0;
    double largest = 0.0; // m/year
    std::uint64_t moments = 0;
    const auto compare = [&] {
        if (!forest.grown() || forest.stats().moments == moments) {
            return false;
        }
        moments = forest.stats().moments;
        const double now =
            static_cast<double>(forest.grown()->generation) + forest.grown()->fraction;
        std::map<std::uint32_t, double> after = heights();
        if (last >= 0.0) {
            CHECK(now - last <= 1.0 + 1e-9);
            for (const auto& [number, height] : after) {
                before.try_emplace(number, 0.0);
            }
            for (const auto& [number, height] : before) {
                const auto at = after.find(number);
                const double change = std::abs((at == after.end() ? 0.0 : at->second) - height);
                if (change > 1e-6) {
                    largest = std::max(largest, change / std::max(now - last, 1e-3));
                }
            }
        }
        before = std::move(after);
        last = now;
        return last >= 9.0;
    };
    REQUIRE(viewed.until(compare));
    INFO(moments << " moments, at most " << largest << " m a year; trees up to " << tallest
                 << " m");
    CHECK(moments > 8);
    // Seedlings and dying trees change their height with easing, at most 1.5 times the mean rate; a
    // jump would be a whole tree at once.
    CHECK(largest < 1.5 * tallest);
    forest.play_or_pause();
    REQUIRE(viewed.until([&] { return !forest.grown() && !forest.is_busy(); }));
    CHECK(forest.years() >= static_cast<std::uint32_t>(last));
    CHECK(forest.years() <= 12);
    CHECK(forest.stats().swaps >= 2);
}

TEST_CASE("painted trees are undone, saved and read again") {
    const WoodFolder files(wood(50));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    ForestView& forest = viewed.forest();
    forest.settings.tool = PaintTool::OneTree;
    for (int i = 0; i < 10; ++i) {
        viewed.look_at(5.0F + 5.0F * static_cast<float>(i), 30.0F);
        viewed.press();
    }
    CHECK(forest.painting().tree_count() == 60);
    forest.undo();
    CHECK(forest.painting().tree_count() == 59);
    // The camera looks straight down on the painted tree at (30, 30).
    viewed.look_at(30.0F, 30.0F);
    const std::vector<std::uint8_t> painted = viewed.picture();
    const std::uint64_t swaps = forest.stats().swaps;
    CHECK(forest.is_unsaved());
    forest.save();
    CHECK(forest.note() == "saved " + files.scene);
    CHECK_FALSE(forest.is_unsaved());
    for (int i = 0; i < 100; ++i) {
        viewed.step();
        std::this_thread::sleep_for(3ms);
    }
    CHECK(forest.stats().swaps == swaps); // the view's own save does not reload the scene
    forest.redo();
    CHECK(forest.painting().tree_count() == 60);
    forest.undo();
    const std::string text = read_text(files.scene);
    CHECK(text.starts_with(wood(50)));
    ViewedForest again(forest_options(files.scene));
    REQUIRE(again.until_swaps(1));
    CHECK(again.forest().painting().tree_count() == 59);
    CHECK(again.forest().painting().painted_count() == 9);
    again.look_at(30.0F, 30.0F);
    CHECK(again.picture() == painted);
}

TEST_CASE("saving reports erased trees that belong to another placement than the file's") {
    const WoodFolder files(wood(200));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    ForestView& forest = viewed.forest();
    viewed.look_at(30.0F, 30.0F);
    forest.settings.tool = PaintTool::Eraser;
    forest.settings.brush.radius = 10.0F;
    viewed.press();
    REQUIRE(forest.painting().tree_count() < 200);
    forest.save();
    CHECK(forest.note() == "saved " + files.scene);
    forest.settings.edits.key = 4;
    REQUIRE(viewed.until_swaps(2));
    forest.save();
    CHECK(forest.note().find("erased trees are saved by number") != std::string::npos);
}

TEST_CASE("painted trees are saved to the scene shown, not to a scene with errors opened later") {
    const WoodFolder files(wood(50));
    const std::string broken = files.folder / "broken.toml";
    const std::string broken_text = wood(70) + "colour = 3\n";
    write_text(broken, broken_text);
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    viewed.look_at(30.0F, 30.0F);
    viewed.forest().settings.tool = PaintTool::OneTree;
    viewed.press();
    REQUIRE(viewed.forest().painting().tree_count() == 51);
    viewed.views.open(broken);
    CHECK(viewed.forest().path() == files.scene); // it waits for the answer about unsaved changes
    CHECK_FALSE(viewed.views.leave());
    REQUIRE(viewed.until([&] { return viewed.forest().failed(); }));
    CHECK(viewed.forest().path() == broken);
    viewed.forest().save();
    CHECK(viewed.forest().note() == "saved " + files.scene);
    CHECK_FALSE(viewed.forest().is_unsaved());
    CHECK(read_text(broken) == broken_text);
    const std::string saved = read_text(files.scene);
    CHECK(saved.starts_with(wood(50)));
    CHECK(saved.find("[painted]") != std::string::npos);
    // The other scene does not have the trees painted in the first.
    wait_for_watch();
    write_text(broken, wood(70));
    REQUIRE(viewed.until_trees(70));
    viewed.press();
    viewed.forest().save();
    CHECK(viewed.forest().note() == "saved " + broken);
    CHECK(read_text(files.scene) == saved);
}

TEST_CASE("nothing is saved before a forest is shown") {
    const WoodFolder files(wood(50) + "colour = 3\n");
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until([&] { return viewed.forest().failed(); }));
    viewed.forest().save();
    CHECK(viewed.forest().note() == "no forest to save yet");
    CHECK(read_text(files.scene) == wood(50) + "colour = 3\n");
}

TEST_CASE("a brush and an eraser work along the path of the mouse") {
    const WoodFolder files(wood(1));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    ForestView& forest = viewed.forest();
    forest.settings.tool = PaintTool::Brush;
    forest.settings.brush.radius = 3.0F;
    forest.settings.brush.density = 0.3F;
    viewed.look_at(30.0F, 30.0F);
    forest.apply_tool({-0.8F, 0.0F}, true, false);
    const std::uint64_t first = forest.painting().tree_count();
    forest.apply_tool({0.8F, 0.0F}, false, false);
    forest.end_stroke();
    const std::uint64_t all = forest.painting().tree_count();
    CHECK(first > 2);
    CHECK(all > 2 * first);
    const std::vector<std::uint8_t> row = viewed.picture();
    forest.apply_tool({0.0F, 0.0F}, true, true);
    forest.end_stroke();
    CHECK(forest.painting().tree_count() < all);
    CHECK(viewed.picture() != row);
    forest.undo();
    CHECK(forest.painting().tree_count() == all);
    CHECK(viewed.picture() == row);
    forest.undo();
    CHECK(forest.painting().tree_count() == 1);
    // The tool does nothing where the picture shows the sky.
    forest.settings.camera = {{30.0F, 20.0F, 30.0F}, {30.0F, 40.0F, 0.0F}, 40.0F};
    forest.apply_tool({0.0F, 0.0F}, true, false);
    CHECK(forest.painting().tree_count() == 1);
}

TEST_CASE("painted trees stay when a grammar changes, and can still be undone") {
    const WoodFolder files(wood(50));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    ForestView& forest = viewed.forest();
    forest.settings.tool = PaintTool::OneTree;
    viewed.look_at(30.0F, 30.0F);
    viewed.press();
    wait_for_watch();
    write_text(files.folder / "bush.lsys",
               "#n = 1;\n#set names letters;\n#w : A;\n#p : A : * : FFFF;\n");
    REQUIRE(viewed.until_swaps(2));
    CHECK(forest.painting().tree_count() == 51);
    CHECK(forest.is_unsaved());
    forest.undo();
    CHECK(forest.painting().tree_count() == 50);
    forest.redo();
    // After other trees were placed, painted trees stay.
    forest.settings.edits.count = 70;
    REQUIRE(viewed.until_trees(71));
    CHECK(forest.is_unsaved());
    // Another program writes painted trees to the scene file.
    wait_for_watch();
    write_text(files.scene, wood(50) + "\n[painted]\ntrees = [[\"bush\", 1, 1, 0, 1]]\n");
    REQUIRE(viewed.until([&] { return forest.note().find("has changed") != std::string::npos; }));
    CHECK(forest.painting().tree_count() == 71);
    forest.save();
    CHECK(read_text(files.scene).find("\"bush\", 1, 1, 0, 1") == std::string::npos);
}

TEST_CASE(
    "the ground shows a changed picture and keeps its picture if only values of the scene change") {
    const WoodFolder files(wood(50));
    const auto paint = [&](std::uint8_t red, std::uint8_t blue) {
        write_text(files.folder / "ground.png",
                   encode_png(Texture{2, 1, {red, 0, blue, 255, red, 9, blue, 255}}));
    };
    paint(200, 0);
    std::string text = wood(50);
    text.insert(text.find("size = 60"), "colour = \"ground.png\"\ntile = 3\n");
    write_text(files.scene, text);
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    viewed.look_at(30.0F, 30.0F);
    const std::vector<std::uint8_t> before = viewed.picture();
    const std::shared_ptr<const Texture> shown = viewed.forest().document()->grown.ground.colour;
    REQUIRE(shown != nullptr);
    viewed.forest().settings.edits.count = 0;
    REQUIRE(viewed.until_trees(0));
    CHECK(viewed.forest().document()->grown.ground.colour == shown);
    viewed.forest().settings.edits.count.reset();
    REQUIRE(viewed.until_trees(50));
    const std::uint64_t swaps = viewed.forest().stats().swaps;
    wait_for_watch();
    paint(0, 200);
    REQUIRE(viewed.until_swaps(swaps + 1));
    viewed.look_at(30.0F, 30.0F);
    const std::vector<std::uint8_t> after = viewed.picture();
    const std::size_t corner = 0;
    CHECK(before[corner] > before[corner + 2]);
    CHECK(after[corner] < after[corner + 2]);
}

TEST_CASE("slow pictures are coarse while something moves and have full resolution at rest") {
    const WoodFolder files(wood(50));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    ForestView& forest = viewed.forest();
    viewed.look_at(30.0F, 30.0F);
    const std::vector<std::uint8_t> whole = viewed.picture();
    forest.settings.camera = moved(forest.settings.camera, 1.0F, 0.0F, 0.0F);
    REQUIRE(viewed.step(1.0));
    CHECK_FALSE(forest.is_coarse()); // no earlier picture was slow
    viewed.look_at(30.0F, 30.0F);
    REQUIRE(viewed.step(1.0));
    CHECK(forest.is_coarse());
    CHECK(forest.is_busy());
    CHECK(viewed.picture() == whole);
    CHECK_FALSE(forest.is_coarse());
}

TEST_CASE("opening another scene drops the options, heroes and painting of the first") {
    const WoodFolder first(wood(50));
    write_text(first.folder / "bush.lsys", std::string("#define size 1;\n") + kBush);
    const WoodFolder second(wood(40));
    write_text(second.folder / "bush.lsys",
               "#n = 2;\n#set names letters;\n#w : A;\n#p : A : * : F[+A]A;\n");
    ViewOptions options = forest_options(first.scene);
    options.grammar.definitions = {{"size", 2.0F}};
    options.grammar.generations = 1;
    options.seed = 5;
    ViewedForest viewed(options);
    REQUIRE(viewed.until_swaps(1));
    ForestView& forest = viewed.forest();
    CHECK(forest.document()->grown.forest.species[0].stages[0].generations == 1);
    CHECK(forest.document()->scene.species[0].cache.seed == 5);
    viewed.look_at(30.0F, 30.0F);
    forest.settings.tool = PaintTool::OneTree;
    viewed.press();
    REQUIRE(forest.is_unsaved());
    viewed.views.open(second.scene);
    REQUIRE(viewed.views.leaving());
    CHECK(viewed.views.leaving()->file == second.scene);
    CHECK_FALSE(viewed.views.leave());
    REQUIRE(viewed.until_trees(40));
    const SceneSpecies& species = forest.document()->scene.species[0];
    CHECK(species.definitions.empty());
    CHECK(species.cache.seed == 0);
    CHECK(forest.document()->grown.forest.species[0].stages[0].generations == 2);
    CHECK_FALSE(forest.document()->grown.reused_species[0]);
    CHECK_FALSE(forest.is_unsaved());
    CHECK_FALSE(forest.failed());
    // A scene in another folder does not reuse the heroes of the previous scene.
    forest.open(first.scene);
    REQUIRE(viewed.until_trees(50));
    CHECK_FALSE(forest.document()->grown.reused_species[0]);
}

TEST_CASE("dropped files show plants and forests in turn") {
    const WoodFolder files(wood(50));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    Controls controls;
    PanelState panels;
    const PixelArea area{0, 0, kWidth, kHeight};
    const auto drop = [&](const std::string& file) {
        WindowInput input;
        input.dropped = {file};
        controls.apply(input, 0.01, area, viewed.views, panels);
    };
    drop(files.folder / "bush.lsys");
    REQUIRE(viewed.views.plant() != nullptr);
    REQUIRE(viewed.until([&] { return viewed.views.plant()->document() != nullptr; }));
    CHECK(viewed.views.last_scene() == files.scene);
    drop(files.scene);
    REQUIRE(viewed.views.forest() != nullptr);
    REQUIRE(viewed.until_swaps(1));
    // With unsaved trees, a dropped file or a request to close asks first.
    viewed.look_at(30.0F, 30.0F);
    viewed.forest().settings.tool = PaintTool::OneTree;
    viewed.press();
    drop(files.folder / "bush.lsys");
    REQUIRE(viewed.views.forest() != nullptr);
    CHECK(panels.dialog == OpenDialog::Unsaved);
    const auto press = [&](Key key) {
        WindowInput input;
        input.presses = {{key}};
        controls.apply(input, 0.01, area, viewed.views, panels);
    };
    press(Key::Escape);
    CHECK(panels.dialog == OpenDialog::None);
    CHECK_FALSE(viewed.views.leaving());
    WindowInput closing;
    closing.close_requested = true;
    for (int i = 0; i < 2; ++i) { // the second request does not close the window either
        controls.apply(closing, 0.01, area, viewed.views, panels);
        CHECK_FALSE(panels.quits);
        CHECK(panels.dialog == OpenDialog::Unsaved);
    }
    answer_unsaved(UnsavedAnswer::Cancel, viewed.views, panels);
    drop(files.folder / "bush.lsys");
    REQUIRE(viewed.views.forest() != nullptr);
    answer_unsaved(UnsavedAnswer::Discard, viewed.views, panels);
    CHECK_FALSE(panels.quits);
    CHECK(panels.dialog == OpenDialog::None);
    REQUIRE(viewed.views.plant() != nullptr);
    CHECK(read_text(files.scene).find("[painted]") == std::string::npos);
    CHECK(viewed.renderer->errors().empty());
}

TEST_CASE("keys and mouse choose and use the tools of a forest") {
    const WoodFolder files(wood(10));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    viewed.look_at(30.0F, 30.0F);
    ForestViewSettings& settings = viewed.forest().settings;
    Controls controls;
    PanelState panels;
    const PixelArea area{100, 0, kWidth, kHeight};
    const auto press = [&](Key key, bool control = false) {
        WindowInput input;
        input.presses = {{key, control, false}};
        controls.apply(input, 0.01, area, viewed.views, panels);
    };
    press(Key::B);
    CHECK(settings.tool == PaintTool::Brush);
    const float radius = settings.brush.radius;
    press(Key::PageUp);
    CHECK(settings.brush.radius > radius);
    press(Key::O);
    CHECK(settings.tool == PaintTool::OneTree);
    WindowInput input;
    // The middle of the picture, which begins 100 pixels from the left.
    input.pointer_events = {{{148.0F, 32.0F}, PointerEvent::Kind::Press, false},
                            {{149.0F, 32.0F}, PointerEvent::Kind::Move, false},
                            {{149.0F, 32.0F}, PointerEvent::Kind::Release, false}};
    controls.apply(input, 0.01, area, viewed.views, panels);
    CHECK(viewed.forest().painting().painted_count() == 1);
    CHECK(viewed.forest().note() == "added 1 tree, removed 0; 11 trees");
    input.pointer_events[0].shift = true;
    settings.brush.radius = 1.0F;
    controls.apply(input, 0.01, area, viewed.views, panels);
    CHECK(viewed.forest().painting().painted_count() == 0);
    press(Key::Z, true);
    CHECK(viewed.forest().painting().painted_count() == 1);
    press(Key::Y, true);
    CHECK(viewed.forest().painting().painted_count() == 0);
    press(Key::X);
    CHECK(settings.tool == PaintTool::Eraser);
    const Camera before = settings.camera;
    WindowInput drag;
    drag.left_drag = {30.0F, 0.0F};
    controls.apply(drag, 0.01, area, viewed.views, panels);
    CHECK(settings.camera == before);
    press(Key::Escape);
    CHECK(settings.tool == PaintTool::None);
    controls.apply(drag, 0.01, area, viewed.views, panels);
    CHECK_FALSE(settings.camera == before);
    press(Key::N);
    CHECK(settings.edits.key == 4);
    press(Key::S, true);
    CHECK(viewed.forest().note().find("saved ") == 0);
    press(Key::Q, true);
    CHECK(panels.quits);
}

TEST_CASE("replacing the forest a hundred times leaks no objects of the renderer") {
    const WoodFolder files(wood(20));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    std::uint64_t objects = 0;
    for (std::uint64_t i = 1; i <= 100; ++i) {
        viewed.forest().settings.edits.count = 20 + i % 5;
        REQUIRE(viewed.until_trees(20 + i % 5));
        if (i == 10) {
            objects = viewed.renderer->live_objects();
        }
    }
    CHECK(viewed.renderer->live_objects() == objects);
    CHECK(viewed.renderer->errors().empty());
}

TEST_CASE("strokes and settings are undone in the order in which they were made") {
    const WoodFolder files(wood(50));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    ForestView& forest = viewed.forest();
    forest.settings.tool = PaintTool::OneTree;
    viewed.look_at(5.0F, 30.0F);
    viewed.press();
    forest.settings.wireframe = true;
    forest.record_edits();
    viewed.look_at(15.0F, 30.0F);
    viewed.press();
    CHECK(forest.painting().tree_count() == 52);
    forest.undo();
    CHECK(forest.painting().tree_count() == 51);
    CHECK(forest.settings.wireframe);
    forest.undo();
    CHECK_FALSE(forest.settings.wireframe);
    CHECK(forest.painting().tree_count() == 51);
    forest.undo();
    CHECK(forest.painting().tree_count() == 50);
    forest.undo();
    CHECK(forest.note() == "Nothing to undo");
    forest.redo();
    forest.redo();
    CHECK(forest.painting().tree_count() == 51);
    CHECK(forest.settings.wireframe);
    forest.settings.shadows = false;
    forest.redo();
    CHECK(forest.note() == "Nothing to redo");
    CHECK(forest.painting().tree_count() == 51);
}

TEST_CASE("a forest that takes long is reported and cancelled") {
    const WoodFolder files(wood(50));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until_swaps(1));
    ForestView& forest = viewed.forest();
    forest.settings.edits.heroes = 100'000;
    REQUIRE(viewed.until([&] { return forest.making().has_value(); }));
    CHECK(forest.making()->text == "Growing heroes");
    forest.cancel_making();
    CHECK(forest.note() == "Cancelled: the last forest is shown");
    CHECK_FALSE(forest.settings.edits.heroes);
    REQUIRE(viewed.until([&] { return !forest.making() && forest.stats().swaps == 1; }));
    CHECK(forest.painting().tree_count() == 50);
}

TEST_CASE("all trees are drawn long before each has an impostor of its own") {
    const WoodFolder files(wood(500));
    ViewedForest viewed(forest_options(files.scene));
    REQUIRE(viewed.until(
        [&] { return viewed.renderer->has_stand_ins() && viewed.forest().stats().swaps == 1; }));
    CHECK_FALSE(viewed.forest().has_all_impostors());
    viewed.forest().settings.max_triangles = 0; // impostors only
    viewed.step();
    const std::vector<std::uint8_t> early = viewed.picture();
    REQUIRE(viewed.until([&] { return viewed.forest().has_all_impostors(); }));
    viewed.step();
    const std::vector<std::uint8_t> late = viewed.picture();
    // Without impostors, only ground and sky would be drawn.
    const auto dark = [](const std::vector<std::uint8_t>& picture) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < picture.size(); i += 4) {
            count += picture[i] + picture[i + 1] + picture[i + 2] < 200 ? 1U : 0U;
        }
        return static_cast<double>(count);
    };
    CHECK(dark(late) > 0.0);
    CHECK(dark(early) == Approx(dark(late)).epsilon(0.2));
}
