// SPDX-License-Identifier: MIT
// Pictures of forests whose trees are chosen by compute shaders equal those whose trees the CPU
// chooses, within the tolerance of stored pictures.
#include "tests/viewer/lsview_run.h"
#include "tests/viewer/picture.h"
#include "tests/viewer/wood.h"
#include "viewer/gl/headless_context.h"
#include "viewer/gl/renderer.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;

namespace {

std::string scene_file(const std::string& name) {
    return LSYS_SOURCE_DIR "/samples/scenes/" + name + "/" + name + ".toml";
}

/// Output of lsview for `arguments` with trees chosen as `culling` says.
LscRun run_culled(std::vector<std::string> arguments, const std::string& culling) {
    arguments.insert(arguments.end(), {"--size", "320x240", "--culling", culling});
    LscRun run = run_lsview(arguments);
    CAPTURE(run.err);
    REQUIRE(run.status == 0);
    return run;
}

void check_alike(const Picture& a, const Picture& b) {
    REQUIRE(a.width == b.width);
    REQUIRE(a.height == b.height);
    const PictureDifference difference = difference_of(a, b);
    CHECK(difference.mean < 0.05);       // the tolerance of stored pictures is 1.0
    CHECK(difference.differing < 0.001); // the tolerance of stored pictures is 0.01
}

/// A renderer of a wood, and its pictures.
struct DrawnWood {
    std::unique_ptr<Renderer> renderer = std::move(Renderer::make(built_in_shader).value());
    Frame frame;

    DrawnWood(const Wood& wood, Culling culling) {
        renderer->set_culling(culling);
        ForestModel model = wood.model;
        REQUIRE(renderer->show_forest(std::move(model)));
        static_cast<void>(renderer->bake_impostors(1e9));
        frame.width = 160;
        frame.height = 120;
        frame.camera = {{20, 2, 20}, {40, 1, 40}, 60.0F};
    }
    Picture draw() {
        static_cast<void>(renderer->draw(frame, {0, 0, frame.width, frame.height}));
        Picture picture{frame.width, frame.height, {}};
        renderer->read(picture.texels);
        CHECK(renderer->errors().empty());
        return picture;
    }
};

} // namespace

TEST_CASE("compute shaders do not change pictures of forests") {
    const std::string ten_thousand = LSYS_SOURCE_DIR "/tests/bench/view-forest.toml";
    const std::vector<std::string> arguments = GENERATE_COPY(values<std::vector<std::string>>({
        {scene_file("mixed-forest"), "--camera", "eye 120,20,120 target 60,20,60 fov 60"},
        {ten_thousand, "--camera", "eye 350,0,350 target 290,0,290 fov 60", "--triangles",
         "300000"},
        {ten_thousand, "--camera", "eye 350,140,-500 target 350,0,350 fov 40"},
        {ten_thousand, "--camera", "eye 350,9,350 target 290,6,290 fov 60", "--wireframe",
         "--samples", "1", "--count", "2500"},
        {scene_file("stone-field"), "--camera", "eye 16,2.6,24 target 18,1.2,20 fov 60"},
        {LSYS_SOURCE_DIR "/tests/viewer/painted.toml", "--camera",
         "eye 40,30,72 target 40,2,40 fov 50", "--colours", "id"},
        {scene_file("mixed-forest"), "--camera", "eye 120,20,120 target 110,23,110 fov 60",
         "--wind", "12,0,0,0.5", "--time", "1.4"},
    }));
    CAPTURE(arguments);
    std::vector<std::string> drawn = arguments;
    drawn.insert(drawn.end(), {"--screenshot", "-"});
    check_alike(decode_picture(run_culled(drawn, "cpu").out),
                decode_picture(run_culled(drawn, "gpu").out));
}

TEST_CASE("compute shaders count what the CPU counts") {
    const ScratchFolder folder;
    const auto stats_of = [&](const std::string& culling) {
        const LscRun run = run_culled({LSYS_SOURCE_DIR "/tests/bench/view-forest.toml", "--count",
                                       "4000", "--camera", "eye 350,0,350 target 290,0,290 fov 60",
                                       "--screenshot", folder / "a.png", "--stats", "-"},
                                      culling);
        return nlohmann::json::parse(run.out);
    };
    const nlohmann::json cpu = stats_of("cpu");
    const nlohmann::json gpu = stats_of("gpu");
    CHECK(cpu["culling"] == "cpu");
    CHECK(gpu["culling"] == "gpu");
    CHECK(gpu["draws"] <= 16);
    CHECK(stats_of("auto")["culling"] == "cpu"); // a software renderer
    for (const char* name :
         {"trees", "branches_drawn", "trees_expanded", "detail", "cells_drawn"}) {
        CAPTURE(name);
        CHECK(gpu[name] == cpu[name]);
    }
    CHECK(gpu["trees_drawn"] == cpu["trees_drawn"]);
    CHECK(gpu["passes"]["branches"]["triangles"] == cpu["passes"]["branches"]["triangles"]);
    CHECK(gpu["passes"]["impostors"]["triangles"] == cpu["passes"]["impostors"]["triangles"]);
    CHECK(cpu["passes"]["branches"]["triangles"] > 0);
    // Triangles without those of the shadow map, whose casters are chosen and counted differently.
    const auto lit = [](const nlohmann::json& stats) {
        return stats["triangles"].get<std::uint64_t>() -
               stats["passes"]["shadow"]["triangles"].get<std::uint64_t>();
    };
    CHECK(lit(gpu) == lit(cpu));
    CHECK(gpu["bytes"]["culling"] > 0);
    CHECK(gpu["milliseconds"]["cull_gpu"] > 0.0);
    for (const nlohmann::json* stats : {&cpu, &gpu}) {
        CHECK((*stats)["milliseconds"]["draw_gpu"] > 0.0);
        CHECK((*stats)["milliseconds"]["draw_cpu"] > 0.0);
        CHECK((*stats)["milliseconds"]["cull_cpu"] > 0.0);
    }
}

TEST_CASE("picking finds the same part with compute shaders") {
    const auto context = std::move(HeadlessContext::make().value());
    const auto wood = make_wood(3000, 120.0F);
    DrawnWood cpu(*wood, Culling::Cpu);
    DrawnWood gpu(*wood, Culling::Gpu);
    std::uint32_t branches = 0;
    std::uint32_t impostors = 0;
    for (std::uint32_t y = 2; y < 120; y += 9) {
        for (std::uint32_t x = 2; x < 160; x += 9) {
            const Result<Picked> one = cpu.renderer->pick(cpu.frame, x, y);
            const Result<Picked> other = gpu.renderer->pick(gpu.frame, x, y);
            REQUIRE(one);
            REQUIRE(other);
            CHECK(one.value().kind == other.value().kind);
            CHECK(one.value().tree.number == other.value().tree.number);
            CHECK(one.value().instance == other.value().instance);
            CHECK(one.value().trees == other.value().trees);
            branches += one.value().kind == PickedKind::Branch ? 1U : 0U;
            impostors += one.value().kind == PickedKind::Impostor ? 1U : 0U;
        }
    }
    CHECK(branches > 0);
    CHECK(impostors > 0);
}

TEST_CASE("painted and removed trees are drawn alike with compute shaders") {
    const auto context = std::move(HeadlessContext::make().value());
    const auto wood = make_wood(800, 60.0F);
    DrawnWood cpu(*wood, Culling::Cpu);
    DrawnWood gpu(*wood, Culling::Gpu);
    const Picture before = gpu.draw();
    check_alike(cpu.draw(), before);
    const auto change = [&](std::uint32_t index, const Tree& tree, bool alive) {
        cpu.renderer->change_tree(index, tree, alive);
        gpu.renderer->change_tree(index, tree, alive);
    };
    for (std::uint32_t i = 0; i < 800; i += 3) {
        change(i, wood->forest.trees[i], false);
    }
    for (std::uint32_t i = 0; i < 300; ++i) {
        Tree tree = wood->forest.trees[i];
        tree.position = {30.0F + 0.5F * static_cast<float>(i % 20), 0.0F,
                         30.0F + 0.5F * static_cast<float>(i / 20)};
        tree.number = 10'000 + i;
        change(800 + i, tree, true);
    }
    const Picture painted = gpu.draw();
    check_alike(cpu.draw(), painted);
    CHECK(difference_of(before, painted).differing > 0.02);
    for (std::uint32_t i = 0; i < 800; i += 3) {
        change(i, wood->forest.trees[i], true);
    }
    for (std::uint32_t i = 0; i < 300; ++i) {
        change(800 + i, wood->forest.trees[i], false);
    }
    const Picture undone = gpu.draw();
    check_alike(before, undone);
    // update_trees() rebuilds a forest from its changed trees.
    cpu.renderer->update_trees();
    gpu.renderer->update_trees();
    static_cast<void>(cpu.renderer->bake_impostors(1e9));
    static_cast<void>(gpu.renderer->bake_impostors(1e9));
    check_alike(cpu.draw(), gpu.draw());
}
