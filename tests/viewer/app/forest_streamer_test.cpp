// SPDX-License-Identifier: MIT
// ForestStreamer: trees depend on their place alone, squares stay within the budget of memory, and
// a flight over a forest of a thousand million trees does not stutter.
#include "runtime/program/host.h"
#include "tests/support/lsc_run.h"
#include "tests/viewer/lsview_run.h"
#include "tests/viewer/picture.h"
#include "viewer/app/forest_streamer.h"
#include "viewer/app/forest_view.h"
#include "viewer/app/square_source.h"
#include "viewer/gl/headless_context.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <map>
#include <set>
#include <sstream>
#include <thread>
#include <vector>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

std::string endless_forest() {
    return LSYS_SOURCE_DIR "/samples/scenes/endless-forest/endless-forest.toml";
}

std::shared_ptr<const ForestDocument> make_endless_document() {
    ViewOptions options;
    options.file = endless_forest();
    options.files = {options.file};
    options.is_forest = true;
    const Project project{make_file_host(nullptr), options.run.limits, 1, {}};
    auto made = make_forest_document(options, project);
    REQUIRE(made);
    return made.value();
}

Camera flying_camera(double x, double z) {
    Camera camera;
    camera.origin = nearest_origin({x, 0.0, z});
    camera.eye = glm::vec3(glm::dvec3(x, 260.0, z) - camera.origin);
    camera.target = camera.eye + glm::vec3(1.0F, -0.2F, 0.0F);
    return camera;
}

/// The squares shown after all steps so far.
class ShownSquares {
public:
    void apply(const SquareChanges& changes) {
        for (const SquareId& id : changes.removed) {
            REQUIRE(squares.erase(id) == 1);
        }
        for (const auto& square : changes.added) {
            REQUIRE(squares.emplace(square->id, square).second);
        }
    }
    /// Shows the squares that a camera wants in a picture 720 pixels high.
    std::optional<float> settle(ForestStreamer& streamer, const Camera& camera) {
        return streamer.settle(
            camera, 720, [this](const SquareChanges& changes) { apply(changes); },
            [] { return false; });
    }

    std::map<SquareId, std::shared_ptr<const ForestSquare>> squares;
};

constexpr std::uint64_t kStreamerBytes = std::uint64_t{16} << 20;

} // namespace

TEST_CASE("squares have each tree of the ground exactly once") {
    const auto document = make_endless_document();
    REQUIRE(document->squares != nullptr);
    CHECK(document->grown.forest.trees.empty());
    const double side = document->model.streamed->layout.side;
    for (const glm::dvec2 corner : {glm::dvec2(-300.0), glm::dvec2(99'870.0, -120'333.0)}) {
        const Region region{corner.x, corner.y, 1.5 * side, 1.3 * side};
        std::vector<Tree> whole = document->squares->trees_of(region);
        REQUIRE(whole.size() > 4000);
        std::multiset<std::uint32_t> numbers;
        const SquareLayout& layout = document->model.streamed->layout;
        const SquareId low = layout.square_at(region.x, region.z);
        const SquareId high = layout.square_at(region.x + region.width, region.z + region.depth);
        for (std::int32_t row = low.row; row <= high.row; ++row) {
            for (std::int32_t column = low.column; column <= high.column; ++column) {
                for (const Tree& tree :
                     document->squares->trees_of(layout.region_of({row, column}))) {
                    if (region.contains(tree.position.x, tree.position.z)) {
                        numbers.insert(tree.number);
                    }
                }
            }
        }
        std::multiset<std::uint32_t> wanted;
        for (const Tree& tree : whole) {
            wanted.insert(tree.number);
        }
        CHECK(numbers == wanted);
    }
}

TEST_CASE("the squares shown do not depend on the way of the camera") {
    const auto document = make_endless_document();
    const Camera end = flying_camera(40'000.0, -25'000.0);
    ForestStreamer direct(*document, kStreamerBytes, 1, [] {});
    ShownSquares wanted;
    REQUIRE(wanted.settle(direct, end));
    REQUIRE(wanted.squares.size() > 20);
    ForestStreamer flown(*document, kStreamerBytes, 2, [] {});
    ShownSquares shown;
    for (int i = 0; i < 40; ++i) {
        shown.apply(flown.step(flying_camera(38'000.0 + 50.0 * i, -25'000.0), 720, 20'000).changes);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    REQUIRE(shown.settle(flown, end));
    CHECK(flown.step(end, 720, 1).is_ready);
    REQUIRE(shown.squares.size() == wanted.squares.size());
    for (const auto& [id, square] : wanted.squares) {
        REQUIRE(shown.squares.count(id) == 1);
        const std::vector<Tree>& trees = shown.squares[id]->trees;
        CHECK(std::equal(trees.begin(), trees.end(), square->trees.begin(), square->trees.end(),
                         [](const Tree& a, const Tree& b) {
                             return a.number == b.number && a.position == b.position;
                         }));
    }
}

TEST_CASE("a flight of 100 km keeps the budget and never waits for trees") {
    const auto document = make_endless_document();
    std::atomic<std::uint64_t> wakes{0};
    ForestStreamer streamer(*document, kStreamerBytes, 1, [&] { ++wakes; });
    ShownSquares shown;
    constexpr int kSteps = 1000;
    std::uint64_t most_shown = 0;
    std::vector<double> steps; // s
    for (int i = 0; i <= kSteps; ++i) {
        const auto start = SteadyClock::now();
        const StreamStep step =
            streamer.step(flying_camera(-50'000.0 + 100.0 * i, 20'000.0), 720, 16'384);
        steps.push_back(seconds_since(start));
        shown.apply(step.changes);
        std::uint64_t bytes = 0;
        for (const auto& [id, square] : shown.squares) {
            bytes += square->trees.size() * kBytesPerStreamedTree +
                     square->cells.size() * kBytesPerStreamedCell;
        }
        most_shown = std::max(most_shown, bytes);
        std::this_thread::sleep_for(std::chrono::milliseconds(4));
    }
    const StreamStats stats = streamer.stats();
    CHECK(most_shown > 0);
    CHECK(most_shown <= kStreamerBytes);
    CHECK(stats.peak_bytes <= kStreamerBytes);
    CHECK(stats.made > 100);
    CHECK(stats.made == wakes);
    std::sort(steps.begin(), steps.end());
    INFO("slowest step " << 1e3 * steps.back() << " ms, squares made " << stats.made);
    // Two frames of a display are 33 ms; other processes may stop a test for longer now and then.
    CHECK(steps[steps.size() * 99 / 100] < 0.033);
}

TEST_CASE("a square that is not wanted any more is kept for a camera that turns back") {
    const auto document = make_endless_document();
    ForestStreamer streamer(*document, kStreamerBytes, 1, [] {});
    ShownSquares shown;
    const Camera first = flying_camera(0.0, 0.0);
    REQUIRE(shown.settle(streamer, first));
    const auto first_squares = shown.squares;
    const std::uint64_t made_at_first = streamer.stats().made;
    REQUIRE(shown.settle(streamer, flying_camera(600.0, 0.0)));
    CHECK(shown.squares != first_squares);
    const std::uint64_t made_in_total = streamer.stats().made;
    CHECK(made_in_total > made_at_first);
    REQUIRE(shown.settle(streamer, first));
    CHECK(shown.squares == first_squares);
    CHECK(streamer.stats().made == made_in_total);
}

TEST_CASE("a camera that jumps keeps the budget") {
    const auto document = make_endless_document();
    ForestStreamer streamer(*document, kStreamerBytes, 2, [] {});
    ShownSquares shown;
    std::uint64_t jumps_without_squares = 0;
    for (int i = 0; i < 4; ++i) {
        const std::optional<float> range = streamer.settle(
            flying_camera(30'000.0 * i, 0.0), 720,
            [&](const SquareChanges& changes) {
                shown.apply(changes);
                jumps_without_squares += shown.squares.empty() ? 1U : 0U;
            },
            [] { return false; });
        REQUIRE(range);
        CHECK(*range > 0.0F);
        CHECK(shown.squares.size() > 20);
    }
    CHECK(jumps_without_squares == 4); // old squares are hidden before new ones are made
    CHECK(streamer.stats().peak_bytes <= kStreamerBytes);
}

TEST_CASE("a picture by a flight equals the picture at its end", "[window]") {
    const ScratchFolder folder;
    const std::string eye = "eye 100010,240,70010 target 99900,150,69850 fov 50";
    const std::vector<std::string> common = {endless_forest(), "--size", "160x120",
                                             "--stream-memory", "16"};
    std::vector<std::string> direct = common;
    for (const std::string& more :
         {std::string("--camera"), eye, std::string("--screenshot"), folder / "direct.png"}) {
        direct.push_back(more);
    }
    const LscRun one = run_lsview(direct);
    REQUIRE(one.status == 0);
    std::vector<std::string> flown = common;
    for (const std::string& more :
         {std::string("--camera"), std::string("eye 0,240,0 target -110,150,-160 fov 50"),
          std::string("--fly-to"), eye, std::string("--frames"), std::string("5"),
          std::string("--screenshot"), folder / "flown.png", std::string("--stats"),
          std::string("-")}) {
        flown.push_back(more);
    }
    const LscRun five = run_lsview(flown);
    REQUIRE(five.status == 0);
    const nlohmann::json stats = nlohmann::json::parse(five.out);
    CHECK(stats["streaming"]["peak_bytes"] <= kStreamerBytes);
    CHECK(stats["streaming"]["trees"] > 900'000'000);
    const Picture a = tests::read_picture(folder / "direct.png");
    const Picture b = tests::read_picture(folder / "flown.0005.png");
    CHECK(a.texels == b.texels);
    const Picture start = tests::read_picture(folder / "flown.0001.png");
    CHECK(difference_of(a, start).mean > 1.0);
}

// Not part of the tests: prints times of the thread of a window, with a picture so small that the
// time to shade pixels does not matter. docs/notes/streamed-forests.md has them.
TEST_CASE("times of the frames of a flight of 15 km", "[.flight]") {
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    const Console console({in, out, err, false, nullptr, "lsview"}, {});
    const auto context = std::move(HeadlessContext::make().value());
    const auto renderer = std::move(Renderer::make(built_in_shader).value());
    ViewOptions options;
    options.file = endless_forest();
    options.files = {options.file};
    options.is_forest = true;
    ForestView view(options, console, *renderer, [] {});
    const auto frame = [&] {
        static_cast<void>(view.update());
        const auto start = SteadyClock::now();
        static_cast<void>(view.draw(64, 36));
        return seconds_since(start);
    };
    while (view.document() == nullptr || !view.has_all_impostors()) {
        static_cast<void>(frame());
    }
    std::vector<double> times;
    std::vector<double> culls;
    constexpr int kFrames = 300; // each 50 m after the last
    for (int i = 0; i <= kFrames; ++i) {
        view.camera() = flying_camera(-50'000.0 + 50.0 * i, 20'000.0);
        const double seconds = frame();
        if (i > 20) { // not the jump to the start
            times.push_back(seconds);
            culls.push_back(1e-3 * renderer->forest_stats().cull_milliseconds);
        }
    }
    const auto print = [](const char* what, std::vector<double> all) {
        std::sort(all.begin(), all.end());
        std::printf("%s: median %.1f ms, 99 %% %.1f ms, most %.1f ms\n", what,
                    1e3 * all[all.size() / 2], 1e3 * all[all.size() * 99 / 100], 1e3 * all.back());
    };
    print("frame", times);
    print("of which choice of trees and heights of the ground", culls);
    const StreamStats stats = view.stream_stats().value();
    std::printf("slowest step %.2f ms, %llu squares made, at most %.1f MiB\n",
                1e3 * stats.slowest_step, static_cast<unsigned long long>(stats.made),
                static_cast<double>(stats.peak_bytes) / 1'048'576.0);
}
