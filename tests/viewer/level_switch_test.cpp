// SPDX-License-Identifier: MIT
// A tree that changes its LOD band changes the picture little more than the step of the camera does.
#include "tests/viewer/picture.h"
#include "tests/viewer/wood.h"
#include "viewer/gl/headless_context.h"
#include "viewer/gl/renderer.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

constexpr float kStep = 0.002F;    // fraction of the distance of the camera
constexpr double kMaxFactor = 1.5; // max change of the picture divided by its usual change

/// A single tree in the middle of the picture.
struct LoneTree {
    std::unique_ptr<HeadlessContext> context = std::move(HeadlessContext::make().value());
    std::unique_ptr<Wood> wood = make_wood(1, 5.0F);
    std::unique_ptr<Renderer> renderer = std::move(Renderer::make(built_in_shader).value());
    Frame frame;
    glm::vec3 middle{};
    float height = 0.0F; // m

    explicit LoneTree(Quality quality) {
        REQUIRE(renderer->set_quality(quality));
        CHECK(renderer->quality() == quality);
        ForestModel model = wood->model;
        REQUIRE(renderer->show_forest(std::move(model)));
        static_cast<void>(renderer->bake_impostors(1e9));
        const Tree& tree = wood->forest.trees[0];
        const TreeForm& form = wood->model.forms[0];
        height = tree.scale * form.height();
        middle = tree.position;
        middle.y += 0.5F * tree.scale * (form.low + form.high);
        frame.width = 400;
        frame.height = 600;
        frame.samples = 1;
    }
    Picture draw(float pixels, float angle) {
        frame.camera.target = middle;
        frame.camera.field_of_view = 20.0F;
        const float focal = make_frustum(frame.camera, frame.width, frame.height).pixels;
        const float away = height * focal / pixels;
        frame.camera.eye = middle + away * glm::vec3(std::sin(angle), 0.0F, std::cos(angle));
        static_cast<void>(renderer->draw(frame, {0, 0, frame.width, frame.height}));
        Picture picture{frame.width, frame.height, {}};
        renderer->read(picture.texels);
        CHECK(renderer->errors().empty());
        return picture;
    }
    /// Mean change of the picture by a step towards the tree.
    double change_at(float pixels) {
        return difference_of(draw(pixels, 0.3F), draw(pixels * (1.0F + kStep), 0.3F)).mean;
    }
    /// Mean change of the picture by a step to the side.
    double change_around(float angle) {
        constexpr float kPixels = 140.0F; // an impostor
        return difference_of(draw(kPixels, angle), draw(kPixels, angle + kStep)).mean;
    }
    /// Mean of change_around() on a range of angles that begins at `angle`.
    double change_along(float angle) {
        double sum = 0.0;
        for (int i = 0; i < 4; ++i) {
            sum += 0.25 * change_around(angle + 0.01F * static_cast<float>(i));
        }
        return sum;
    }
};

/// Angle from which two views of the impostor of a tree are equally near.
float limit_of_views(const Tree& tree) {
    constexpr float kView = std::numbers::pi_v<float> / 4.0F;
    return tree.yaw + 0.5F * kView;
}

} // namespace

TEST_CASE("a tree changes levels without a jump of the picture") {
    LoneTree tree(Quality::Low);
    const LodOptions options;
    for (std::size_t level = 0; level < kTreeLevels; ++level) {
        const float limit = options.level_pixels[level];
        const float blend = level + 1 == kTreeLevels ? options.blend : options.level_blend;
        const double usual =
            0.5 * (tree.change_at(1.01F * blend * limit) + tree.change_at(0.985F * limit));
        for (const float at :
             {0.999F * limit, 0.5F * (1.0F + blend) * limit, 0.999F * blend * limit}) {
            const double change = tree.change_at(at);
            CAPTURE(level, at, usual, change);
            CHECK(change < kMaxFactor * usual);
        }
    }
}

TEST_CASE("an impostor changes its view without a jump of the picture") {
    for (const Quality quality : {Quality::Low, Quality::Medium}) {
        LoneTree tree(quality);
        const float limit = limit_of_views(tree.wood->forest.trees[0]);
        const double usual =
            0.5 * (tree.change_along(limit + 0.15F) + tree.change_along(limit - 0.2F));
        const double change = tree.change_around(limit - 0.5F * kStep);
        CAPTURE(quality, usual, change);
        if (quality == Quality::Low) {
            CHECK(change > kMaxFactor * usual); // the view changes at once
            continue;
        }
        CHECK(change < kMaxFactor * usual);
        CHECK(tree.change_along(limit - 0.07F) < kMaxFactor * usual);
        CHECK(tree.change_along(limit + 0.03F) < kMaxFactor * usual);
    }
}

TEST_CASE("shadows near the eye are a function of the frame alone") {
    LoneTree tree(Quality::Medium);
    tree.frame.wind.velocity = {8.0F, 0.0F, 0.0F};
    const Picture first = tree.draw(300.0F, 0.3F);
    tree.frame.time = 1.0;
    CHECK(difference_of(first, tree.draw(300.0F, 0.3F)).mean > 0.0);
    static_cast<void>(tree.draw(500.0F, 1.0F));
    tree.frame.time = 0.0;
    CHECK(tree.draw(300.0F, 0.3F).texels == first.texels);
    tree.frame.shadows = false;
    CHECK(difference_of(first, tree.draw(300.0F, 0.3F)).mean > 0.1);
}

TEST_CASE("refined pictures are smoother, and a new picture begins anew") {
    LoneTree tree(Quality::Low);
    tree.frame.width = 100;
    tree.frame.height = 150;
    tree.frame.samples = 4;
    const Picture plain = tree.draw(130.0F, 0.3F);
    const auto shown = [&] {
        Picture picture{tree.frame.width, tree.frame.height, {}};
        tree.renderer->read_shown(picture.texels);
        return picture;
    };
    CHECK(shown().texels == plain.texels);
    int refinements = 0;
    while (tree.renderer->refine()) {
        ++refinements;
        REQUIRE(refinements <= 16);
    }
    CHECK(refinements == 16);
    const Picture refined = shown();
    CHECK(tree.renderer->errors().empty());
    // The mean of 64 times as many pixels is the limit that samples approach.
    const auto with_pixels = [&](std::uint32_t factor) {
        tree.frame.width *= factor;
        tree.frame.height *= factor;
        const Picture large = tree.draw(130.0F * static_cast<float>(factor), 0.3F);
        tree.frame.width /= factor;
        tree.frame.height /= factor;
        Picture mean{tree.frame.width, tree.frame.height, {}};
        for (std::size_t y = 0; y < mean.height; ++y) {
            for (std::size_t x = 0; x < std::size_t{4} * mean.width; ++x) {
                std::size_t sum = 0;
                for (std::size_t k = 0; k < std::size_t{factor} * factor; ++k) {
                    const std::size_t row = y * factor + k / factor;
                    const std::size_t column = x / 4 * factor + k % factor;
                    sum += large.texels[4 * (row * large.width + column) + x % 4];
                }
                mean.texels.push_back(static_cast<std::uint8_t>(sum / (factor * factor)));
            }
        }
        return mean;
    };
    const Picture limit = with_pixels(4);
    CAPTURE(difference_of(plain, limit).mean, difference_of(refined, limit).mean);
    CHECK(difference_of(refined, limit).mean < difference_of(plain, limit).mean);
    CHECK(shown().texels != refined.texels); // draw() has begun a new picture
    // read() returns the picture without refinement.
    const Picture again = tree.draw(130.0F, 0.3F);
    CHECK(tree.renderer->refine());
    Picture read{tree.frame.width, tree.frame.height, {}};
    tree.renderer->read(read.texels);
    CHECK(read.texels == plain.texels);
    CHECK(again.texels == plain.texels);
    CHECK(shown().texels == plain.texels);
}
