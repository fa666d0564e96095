// SPDX-License-Identifier: MIT
// The default picture of a forest: trees are visible, with contrast, on grounds from 0.1 to 100 km.
#include "tests/viewer/lsview_run.h"
#include "tests/viewer/picture.h"
#include "viewer/scene/camera.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

using namespace lsys::tests;

namespace {

/// Measures of the lower two thirds of a picture.
struct PictureContrast {
    double contrast = 0.0; // RMS: standard deviation of the luma (Rec. 709), 0 to 1
    double trees = 0.0;    // fraction of pixels that trees or their shadows change
};

/// Pixels with trees differ in a channel by more than this, of 255.
constexpr int kTreeDifference = 24;

/// Measures `picture`. `bare`: the same picture without trees.
PictureContrast sight_of(const Picture& picture, const Picture& bare) {
    const std::size_t first = std::size_t{4} * picture.width * (picture.height / 3);
    double sum = 0.0;
    double squares = 0.0;
    double changed = 0.0;
    double count = 0.0;
    for (std::size_t i = first; i < picture.texels.size(); i += 4) {
        const auto channel = [&](std::size_t c) {
            return static_cast<double>(picture.texels[i + c]) / 255.0;
        };
        const double luma = 0.2126 * channel(0) + 0.7152 * channel(1) + 0.0722 * channel(2);
        sum += luma;
        squares += luma * luma;
        int max_difference = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            max_difference = std::max(
                max_difference, std::abs(int{picture.texels[i + c]} - int{bare.texels[i + c]}));
        }
        changed += max_difference > kTreeDifference ? 1.0 : 0.0;
        count += 1.0;
    }
    const double mean = sum / count;
    return {std::sqrt(std::max(squares / count - mean * mean, 0.0)), changed / count};
}

struct Shown {
    Picture picture;
    nlohmann::json stats;
};

Shown shown(std::vector<std::string> arguments) {
    const ScratchFolder folder;
    arguments.insert(arguments.end(),
                     {"--size", "320x180", "--screenshot", folder / "a.png", "--stats", "-"});
    const LscRun run = run_lsview(arguments);
    CAPTURE(run.err);
    REQUIRE(run.status == 0);
    return {read_picture(folder / "a.png"), nlohmann::json::parse(run.out)};
}

/// Draws the default picture with and without trees, and measures it. `files`: a scene, or a
/// grammar with options of the ground. `trees`: options of the placement.
PictureContrast first_sight(const std::vector<std::string>& files,
                            const std::vector<std::string>& trees) {
    std::vector<std::string> wooded = files;
    wooded.insert(wooded.end(), trees.begin(), trees.end());
    const Shown first = shown(wooded);
    std::vector<std::string> bare = files;
    bare.insert(bare.end(), {"--placement", "uniform", "--count", "1", "--camera",
                             first.stats["camera"].get<std::string>()});
    return sight_of(first.picture, shown(bare).picture);
}

std::string sample_scene(const std::string& name) {
    return LSYS_SOURCE_DIR "/samples/scenes/" + name + "/" + name + ".toml";
}

} // namespace

TEST_CASE("the default picture shows trees with contrast on grounds of 0.1 to 100 km") {
    struct Ground {
        const char* size;  // m, side of the ground
        const char* count; // of trees
        double contrast;   // min of PictureContrast::contrast
        double trees;      // min fraction of the pixels that show trees
    };
    const Ground ground = GENERATE(values<Ground>({
        {"100", "204", 0.08, 0.2},
        {"1000", "20000", 0.1, 0.4},
        {"3000", "100000", 0.1, 0.4},
        {"20000", "1000000", 0.1, 0.4},
        {"100000", "1000000", 0.04, 0.05}, // trees 100 m apart
        {"1000", "1000", 0.08, 0.25},      // the default count
    }));
    CAPTURE(ground.size, ground.count);
    const PictureContrast sight = first_sight(
        {sample("carey-type-0"), "--forest-size", ground.size}, {"--count", ground.count});
    CHECK(sight.contrast > ground.contrast);
    CHECK(sight.trees > ground.trees);
}

TEST_CASE("the default picture of each sample scene shows its trees with contrast") {
    struct Sample {
        const char* name;
        double contrast; // min of PictureContrast::contrast
        double trees;    // min fraction of the pixels that show trees
    };
    const Sample wood = GENERATE(values<Sample>({
        {"mixed-forest", 0.08, 0.3},
        {"pine-wood", 0.08, 0.25},
        {"meadow", 0.045, 0.04}, // mostly ground
    }));
    CAPTURE(wood.name);
    const PictureContrast sight = first_sight({sample_scene(wood.name)}, {});
    CHECK(sight.contrast > wood.contrast);
    CHECK(sight.trees > wood.trees);
}

TEST_CASE("no mountain hides the forest in the default picture") {
    const ScratchFolder folder;
    write_text(folder / "wood.toml",
               "[terrain]\nkind = \"noise\"\nsize = 5000\nfeature = 900\nheight = 600\n"
               "[placement]\nmethod = \"uniform\"\ncount = 100000\n[[species]]\ngrammar = \"" +
                   sample("carey-type-0") + "\"\n");
    const PictureContrast sight = first_sight({folder / "wood.toml"}, {});
    CHECK(sight.contrast > 0.06);
    CHECK(sight.trees > 0.3);
}

TEST_CASE("the visibility of air depends on --air, and by default on the size of the ground") {
    const std::vector<std::string> wood = {sample("carey-type-0"), "--forest-size", "1000",
                                           "--count", "2000"};
    const auto with_air = [&](const char* visibility) {
        std::vector<std::string> arguments = wood;
        arguments.insert(arguments.end(), {"--air", visibility});
        return shown(arguments);
    };
    const Shown usual = shown(wood);
    CHECK(usual.stats["air_km"] == Approx(12.0 * std::sqrt(2.0)));
    const Shown clear = with_air("1000");
    const Shown hazy = with_air("0.3");
    CHECK(hazy.stats["air_km"] == Approx(0.3));
    CHECK(hazy.stats["camera"] == usual.stats["camera"]);
    const double in_haze = sight_of(hazy.picture, usual.picture).contrast;
    const double by_default = sight_of(usual.picture, usual.picture).contrast;
    CHECK(in_haze < 0.6 * by_default);
    CHECK(by_default < sight_of(clear.picture, usual.picture).contrast);
    CHECK(difference_of(with_air("16.97056").picture, usual.picture).mean < 0.1);
    // On a small ground, the default visibility is 10 km.
    CHECK(shown({sample("abop-1-24a"), "--count", "4"}).stats["air_km"] == 10.0);
}

TEST_CASE("with another field of view the whole plant is visible from the same side") {
    const std::string bush = LSYS_SOURCE_DIR "/samples/abop-1-25-bush/abop-1-25-bush.lsys";
    const auto distance_with = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments = {bush};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto line = shown(arguments).stats["camera"].get<std::string>();
        const lsys::Result<lsys::view::Camera> camera = lsys::view::parse_camera(line, {});
        CAPTURE(line);
        REQUIRE(camera);
        return static_cast<double>(glm::distance(camera.value().eye, camera.value().target));
    };
    const double usual = distance_with({}); // field of view of 40 degrees
    CHECK(distance_with({"--camera", "fov 15"}) > 2.0 * usual);
    CHECK(distance_with({"--camera", "fov 90"}) < 0.7 * usual);
}
