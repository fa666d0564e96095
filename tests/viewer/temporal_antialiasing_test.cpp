// SPDX-License-Identifier: MIT
// Temporal antialiasing compared with means of many samples: of a still view, of a moving camera,
// and of trees in the wind.
#include "tests/viewer/picture.h"
#include "tests/viewer/wood.h"
#include "viewer/gl/headless_context.h"
#include "viewer/gl/renderer.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

/// Root of the mean squared difference, 0 to 255.
double error_of(const Picture& picture, const Picture& truth) {
    REQUIRE(picture.texels.size() == truth.texels.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.texels.size(); ++i) {
        const int difference = picture.texels[i] - truth.texels[i];
        sum += static_cast<double>(difference * difference);
    }
    return std::sqrt(sum / static_cast<double>(truth.texels.size()));
}

struct Wooded {
    std::unique_ptr<HeadlessContext> context = std::move(HeadlessContext::make().value());
    std::unique_ptr<Wood> wood = make_wood(40, 30.0F);
    std::unique_ptr<Renderer> renderer = std::move(Renderer::make(built_in_shader).value());
    Frame frame;

    Wooded() {
        REQUIRE(renderer->set_quality(Quality::High));
        ForestModel model = wood->model;
        REQUIRE(renderer->show_forest(std::move(model)));
        static_cast<void>(renderer->bake_impostors(1e9));
        frame.width = 160;
        frame.height = 120;
        look(0.0F);
    }
    /// Moves the camera along the edge of the wood.
    void look(float along) {
        frame.camera.eye = {along, 3.0F, -12.0F};
        frame.camera.target = {along + 8.0F, 2.0F, 15.0F};
    }
    Picture draw(bool temporal) {
        frame.samples = 1;
        frame.temporal = temporal;
        static_cast<void>(renderer->draw(frame, {0, 0, frame.width, frame.height}));
        Picture picture{frame.width, frame.height, {}};
        renderer->read(picture.texels);
        CHECK(renderer->errors().empty());
        return picture;
    }
    /// Mean of `count` pictures of the frame, up to 17, with `samples` per pixel.
    Picture mean_of(int count, std::uint32_t samples) {
        frame.samples = samples;
        frame.temporal = false;
        static_cast<void>(renderer->draw(frame, {0, 0, frame.width, frame.height}));
        for (int i = 1; i < count; ++i) {
            REQUIRE(renderer->refine());
        }
        Picture picture{frame.width, frame.height, {}};
        renderer->read_shown(picture.texels);
        return picture;
    }
};

} // namespace

TEST_CASE("eight pictures of a still view are as smooth as eight samples per pixel") {
    Wooded view;
    const Picture truth = view.mean_of(17, 4);
    const double one = error_of(view.mean_of(1, 1), truth);
    const double eight = error_of(view.mean_of(8, 1), truth);
    const Picture first = view.draw(true);
    CHECK(error_of(first, truth) == one); // without a picture before it, nothing is mixed
    double temporal = one;
    for (int i = 1; i < 8; ++i) {
        temporal = error_of(view.draw(true), truth);
    }
    CAPTURE(one, eight, temporal);
    CHECK(eight < 0.6 * one);
    CHECK(temporal < 1.3 * eight);
    // A picture without temporal antialiasing ends the use of earlier pictures.
    CHECK(error_of(view.draw(false), truth) == one);
    CHECK(view.draw(true).texels == first.texels);
}

TEST_CASE("a moving camera leaves no trail with temporal antialiasing") {
    Wooded view;
    for (int i = 0; i < 10; ++i) {
        view.look(0.1F * static_cast<float>(i)); // 3 to 4 pixels per picture
        static_cast<void>(view.draw(true));
    }
    view.look(1.0F);
    const Picture last = view.draw(true);
    const Picture truth = view.mean_of(17, 4);
    const double temporal = error_of(last, truth);
    const double one = error_of(view.mean_of(1, 1), truth);
    view.look(0.9F);
    const double of_before = error_of(view.mean_of(4, 4), truth);
    CAPTURE(one, temporal, of_before);
    CHECK(temporal < 0.85 * one);
    CHECK(temporal < 0.6 * of_before);
}

TEST_CASE("trees in the wind leave no trail with temporal antialiasing") {
    Wooded view;
    view.frame.wind.velocity = {9.0F, 0.0F, 3.0F};
    view.frame.wind.gust = 0.5F;
    for (int i = 0; i < 9; ++i) {
        view.frame.time = 0.05 * i;
        static_cast<void>(view.draw(true));
    }
    view.frame.time = 0.45;
    const Picture last = view.draw(true);
    const Picture truth = view.mean_of(17, 4);
    const double temporal = error_of(last, truth);
    const double one = error_of(view.mean_of(1, 1), truth);
    CAPTURE(one, temporal);
    CHECK(temporal < 0.85 * one);
}
