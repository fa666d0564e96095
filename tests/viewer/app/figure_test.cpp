// SPDX-License-Identifier: MIT
// The person of 1.8 m beside plants and in forests.
#include "tests/support/lsc_run.h"
#include "tests/viewer/lsview_run.h"
#include "tests/viewer/picture.h"
#include "viewer/app/plant_view.h"
#include "viewer/gl/headless_context.h"
#include "viewer/scene/figure.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cstdlib>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

/// Whether a texel of a picture with the person differs clearly from the picture without.
bool differs(const Picture& a, const Picture& b, std::uint32_t x, std::uint32_t y) {
    int sum = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        sum += std::abs(texel(a, x, y).at(channel) - texel(b, x, y).at(channel));
    }
    return sum > 60;
}

/// First and last row with texels that differ, and the count of these texels.
struct Difference {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    std::uint32_t count = 0;
};
Difference difference_between(const std::string& a, const std::string& b) {
    const Picture one = tests::read_picture(a);
    const Picture other = tests::read_picture(b);
    Difference difference;
    for (std::uint32_t y = 0; y < one.height; ++y) {
        for (std::uint32_t x = 0; x < one.width; ++x) {
            if (differs(one, other, x, y)) {
                difference.first = difference.count++ == 0 ? y : difference.first;
                difference.last = y;
            }
        }
    }
    return difference;
}

} // namespace

TEST_CASE("a person stands to the right of a plant, on its ground") {
    Bounds plant;
    plant.add({-1.0F, 0.0F, -2.0F});
    plant.add({3.0F, 5.0F, 2.0F});
    CHECK(figure_beside(plant) == glm::vec3(3.5F, 0.0F, 0.0F));
    CHECK(with_figure(plant).high.y == 5.0F);
    CHECK(with_figure(plant).high.x == Approx(3.8));
    Bounds small;
    small.add({0.0F, 0.1F, 0.0F});
    CHECK(with_figure(small).high.y == Approx(1.8));
    CHECK(figure_beside(small).y == 0.0F);
}

TEST_CASE("the option --figure draws a person as high as a plant of 1.8 m") {
    const ScratchFolder folder;
    write_text(folder / "pole.lsys", "#n = 1;\n#w : G;\n#p : G : * : F(1.8);\n#set width 0.1;\n");
    const auto draw = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {folder / "pole.lsys",
                                              "--size",
                                              "96x96",
                                              "--no-shadows",
                                              "--no-ground",
                                              "--samples",
                                              "1",
                                              "--camera",
                                              "eye 0,0.9,30 target 0,0.9,0 fov 4",
                                              "--screenshot",
                                              folder / name};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const LscRun run = run_lsview(arguments);
        CAPTURE(run.err);
        REQUIRE(run.status == 0);
    };
    draw("without.png", {});
    draw("with.png", {"--figure"});
    draw("nothing.png", {"--style", "none"});
    const Difference person = difference_between(folder / "without.png", folder / "with.png");
    const Difference pole = difference_between(folder / "without.png", folder / "nothing.png");
    CHECK(person.count > 300);
    CHECK(std::abs(static_cast<int>(person.first) - static_cast<int>(pole.first)) <= 3);
    CHECK(std::abs(static_cast<int>(person.last) - static_cast<int>(pole.last)) <= 3);
}

TEST_CASE("surfaces fade while lines are shown, and the lines do not") {
    const auto context = HeadlessContext::make();
    const std::unique_ptr<Renderer> renderer = std::move(Renderer::make(built_in_shader).value());
    const std::vector<LineVertex> lines = {{{-9.0F, 1.0F, 0.0F}, {255, 0, 0, 255}},
                                           {{9.0F, 1.0F, 0.0F}, {255, 0, 0, 255}}};
    renderer->show_lines(lines);
    Frame frame;
    frame.width = 64;
    frame.height = 48;
    frame.samples = 1;
    frame.figure = glm::dvec3(0.0, 0.0, 0.0);
    frame.camera.eye = {0.0F, 1.0F, 6.0F};
    const auto pixels = [&](bool dims) {
        frame.dims = dims;
        renderer->draw(frame, {0, 0, frame.width, frame.height});
        std::vector<std::uint8_t> texels;
        renderer->read(texels);
        return texels;
    };
    const std::vector<std::uint8_t> clear = pixels(false);
    const std::vector<std::uint8_t> faded = pixels(true);
    std::uint64_t brighter = 0;
    std::uint64_t red = 0;
    for (std::size_t at = 0; at < clear.size(); at += 4) {
        brighter += faded[at] > clear[at] + 15 ? 1U : 0U;
        if (clear[at] == 255 && clear[at + 1] == 0) {
            ++red;
            CHECK(faded[at] == 255);
            CHECK(faded[at + 1] == 0);
        }
    }
    CHECK(brighter > 15); // pixels of the dark person, over whom the sky is drawn with alpha
    CHECK(red > 30);
    CHECK(renderer->errors().empty());
}

TEST_CASE("a person stands on the ground of a forest, where the camera looks") {
    const ScratchFolder folder;
    write_text(folder / "wood.toml", "[terrain]\nkind = \"flat\"\nsize = 40\n[placement]\n"
                                     "method = \"uniform\"\ncount = 1\n[[species]]\n"
                                     "name = \"grass\"\ngrammar = \"grass.lsys\"\n");
    write_text(folder / "grass.lsys", "#n = 1;\n#w : G;\n#p : G : * : F(0.05);\n");
    const auto draw = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {
            folder / "wood.toml", "--size",     "96x96",    "--no-shadows",
            "--samples",          "1",          "--camera", "eye 20,1.8,40 target 20,0.9,20 fov 8",
            "--screenshot",       folder / name};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const LscRun run = run_lsview(arguments);
        CAPTURE(run.err);
        REQUIRE(run.status == 0);
    };
    draw("without.png", {});
    draw("with.png", {"--figure"});
    const Difference person = difference_between(folder / "without.png", folder / "with.png");
    CHECK(person.count > 300);
    CHECK(person.first > 10); // 1.8 m of the 2.8 m that the picture shows, in its middle
    CHECK(person.first < 30);
    CHECK(person.last > 66);
    CHECK(person.last < 86);
}
