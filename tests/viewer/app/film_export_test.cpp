// SPDX-License-Identifier: MIT
// Pictures and films that the window writes.
#include "tests/support/lsc_run.h"
#include "tests/viewer/lsview_run.h"
#include "viewer/app/controls.h"
#include "viewer/app/film_export.h"
#include "viewer/gl/headless_context.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;
using namespace std::chrono_literals;

namespace {

constexpr const char* kGrowing = "#n = 2;\n#w : F;\n#p : F : * : F[+F]F;\n#set width 0.3;\n";

/// A film of 3 pictures of a plant in `folder`.
FilmExportRequest film_in(const ScratchFolder& folder) {
    FilmExportRequest request;
    ViewOptions options;
    options.file = folder / "plant.lsys";
    options.files = {options.file};
    options.run.limits.max_bytes = std::uint64_t{1} << 30U;
    write_text(options.file, kGrowing);
    request.options = std::make_shared<const ViewOptions>(options);
    request.settings.folder = folder.path().string();
    request.settings.name = "turn";
    request.settings.width = 32;
    request.settings.height = 24;
    request.settings.samples = 1;
    request.settings.is_film = true;
    request.settings.seconds = 1.0F;
    request.settings.frames_per_second = 3.0F;
    request.finished_pictures = std::make_shared<std::atomic<std::uint32_t>>(0);
    return request;
}

Texture picture_in(const std::string& path) {
    return read_picture(read_text(path), std::uint64_t{1} << 30U).value();
}

const std::atomic<bool> kNotCancelled{false};

} // namespace

TEST_CASE("a film of numbered pictures appears as a whole") {
    const ScratchFolder folder;
    FilmExportRequest request = film_in(folder);
    write_text(folder / "turn.0002.png", "old");
    CHECK(export_film(request, kNotCancelled) ==
          fmt::format("Wrote {} to {}", folder / "turn.0001.png", folder / "turn.0003.png"));
    CHECK(*request.finished_pictures == 3);
    CHECK(folder.file_count() == 4); // with the grammar
    const Texture second = picture_in(folder / "turn.0002.png");
    CHECK(second.width == 32);
    CHECK(second.height == 24);
    CHECK(second.texels != picture_in(folder / "turn.0001.png").texels);
    request.settings.name = "grow";
    request.settings.kind = FilmKind::Growth;
    CHECK(export_film(request, kNotCancelled).starts_with("Wrote "));
    CHECK(picture_in(folder / "grow.0001.png").texels !=
          picture_in(folder / "grow.0003.png").texels);
}

TEST_CASE("a film that fails or is cancelled changes no file") {
    const ScratchFolder folder;
    FilmExportRequest request = film_in(folder);
    write_text(folder / "turn.0001.png", "old");
    request.settings.width = 1;
    request.settings.height = 1;
    request.settings.seconds = 3600.0F;
    std::atomic<bool> cancelled{false};
    std::thread canceller([&] {
        while (*request.finished_pictures == 0) {
            std::this_thread::sleep_for(1ms);
        }
        cancelled = true;
    });
    CHECK_FALSE(export_film(request, cancelled).starts_with("Wrote "));
    canceller.join();
    CHECK(*request.finished_pictures < request.settings.frames());
    CHECK(read_text(folder / "turn.0001.png") == "old");
    CHECK(folder.file_count() == 2);
    write_text(request.options->file, "#n = 1;\n#w : F(;\n");
    CHECK(export_film(request, kNotCancelled).find("error") != std::string::npos);
    CHECK(read_text(folder / "turn.0001.png") == "old");
    CHECK(folder.file_count() == 2);
}

#ifndef _WIN32
TEST_CASE("ffmpeg makes a .mp4 file of a film, and its errors are reported") {
    const ScratchFolder folder;
    FilmExportRequest request = film_in(folder);
    request.settings.as_mp4 = true;
    const std::string tools = folder / "tools";
    std::filesystem::create_directory(tools);
    const std::string path = std::getenv("PATH");
    const auto install = [&](const std::string& script) {
        write_text(tools + "/ffmpeg", "#!/bin/sh\n" + script);
        std::filesystem::permissions(tools + "/ffmpeg", std::filesystem::perms::owner_all);
    };
    setenv("PATH", (tools + ":" + path).c_str(), 1);
    // Writes the names of the pictures into the film, which is the last argument.
    install("for last; do :; done; ls \"$(dirname \"$last\")\" | grep film > \"$last\"\n");
    CHECK(export_film(request, kNotCancelled) ==
          fmt::format("Wrote {}, 3 pictures", folder / "turn.mp4"));
    CHECK(read_text(folder / "turn.mp4").find("film.0003.png\n") != std::string::npos);
    CHECK(folder.file_count() == 3); // the grammar, the tools and the film
    install("echo first >&2; echo no such codec >&2; exit 1\n");
    CHECK(export_film(request, kNotCancelled).find("ffmpeg: no such codec") != std::string::npos);
    CHECK(read_text(folder / "turn.mp4").find("film.0003.png\n") != std::string::npos);
    setenv("PATH", (folder / "nowhere").c_str(), 1);
    CHECK(export_film(request, kNotCancelled).find("ffmpeg is not installed") != std::string::npos);
    setenv("PATH", path.c_str(), 1);
    CHECK(folder.file_count() == 3);
}
#endif

TEST_CASE("a transparent picture has no sky and no ground, and edges keep their colour") {
    const ScratchFolder folder;
    write_text(folder / "plant.lsys", "#n = 0;\n#w : F F F;\n#set width 1;\n");
    const std::string file = folder / "a.png";
    const LscRun run = run_lsview({folder / "plant.lsys", "--screenshot", file, "--size", "64x48",
                                   "--transparent", "--lines", "none"});
    REQUIRE(run.status == 0);
    const Texture picture = picture_in(file);
    std::size_t clear = 0;
    std::size_t opaque = 0;
    std::size_t between = 0;
    unsigned darkest_opaque = 255;
    unsigned darkest_between = 255;
    for (std::size_t at = 0; at < picture.texels.size(); at += 4) {
        const unsigned opacity = picture.texels[at + 3];
        const unsigned red = picture.texels[at];
        clear += opacity == 0 ? 1 : 0;
        opaque += opacity == 255 ? 1 : 0;
        darkest_opaque = opacity == 255 ? std::min(darkest_opaque, red) : darkest_opaque;
        if (opacity != 0 && opacity != 255) {
            ++between;
            darkest_between = std::min(darkest_between, red);
        }
    }
    CHECK(clear > 1000);
    CHECK(opaque > 50);
    CHECK(between > 10);
    CHECK(darkest_between + 30 > darkest_opaque); // not mixed with black
    CHECK(picture.texels[3] == 0);
    CHECK(run_lsview({folder / "plant.lsys", "--transparent"})
              .err.find("--transparent belongs to pictures") != std::string::npos);
    CHECK(run_lsview({folder / "plant.lsys", "--count", "2", "--transparent", "--screenshot", file})
              .err.find("--transparent is for a picture of a plant") != std::string::npos);
}

TEST_CASE("the picture dialog writes a picture of another size, and films") {
    const ScratchFolder folder;
    write_text(folder / "plant.lsys", kGrowing);
    const auto context = HeadlessContext::make();
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    ViewOptions options;
    options.file = folder / "plant.lsys";
    options.files = {options.file};
    options.run.limits.max_bytes = std::uint64_t{1} << 30U;
    const Console console({in, out, err, false, nullptr, "lsview"}, options.messages);
    const std::unique_ptr<Renderer> renderer = std::move(Renderer::make(built_in_shader).value());
    ViewSwitcher switcher(options, console, *renderer, [] {});
    Controls controls;
    PanelState panels;
    panels.wake = [] {};
    const auto press = [&](const KeyPress& key) {
        WindowInput input;
        input.presses = {key};
        controls.apply(input, 0.0, {0, 0, 64, 48}, switcher, panels);
    };
    const auto until = [&](const auto& done) {
        for (const auto start = SteadyClock::now(); SteadyClock::now() - start < 30s;) {
            switcher.current().update();
            switcher.current().draw(64, 48);
            if (done()) {
                return true;
            }
            std::this_thread::sleep_for(1ms);
        }
        return false;
    };
    REQUIRE(until([&] { return switcher.plant()->document() != nullptr; }));
    press({Key::P, false, false, false});
    REQUIRE(panels.dialog == OpenDialog::Picture);
    CHECK(panels.picture.name == "plant-1");
    press({Key::W, false, false, false}); // the dialog keeps keys from the view
    CHECK(switcher.plant()->settings.style == PlantStyle::Surface);
    press({Key::Escape, false, false, false});
    CHECK(panels.dialog == OpenDialog::None);
    panels.picture.folder = folder.path().string();
    press({Key::P, false, false, false});
    panels.picture.width = 100;
    panels.picture.height = 40;
    panels.picture.transparent = true;
    press({Key::Enter, false, false, false});
    CHECK(switcher.current().note() == "wrote " + (folder / "plant-1.png"));
    const Texture picture = picture_in(folder / "plant-1.png");
    CHECK(picture.width == 100);
    CHECK(picture.height == 40);
    CHECK(picture.texels[3] == 0);
    CHECK(switcher.current().draw(64, 48)); // the window's picture is drawn again

    const std::string bark = read_text(folder / "plant-1.png");
    write_text(folder / "bark.png", bark);
    const auto show = [&](const std::string& grammar) {
        write_text(folder / "plant.lsys", grammar);
        const std::uint64_t before = switcher.current().taken_request_count();
        switcher.current().reload();
        return until([&] { return switcher.current().taken_request_count() > before; });
    };
    REQUIRE(show(std::string("#material 0 picture \"bark.png\";") + kGrowing));
    press({Key::P, false, false, false});
    panels.picture.name = "bark";
    press({Key::Enter, false, false, false});
    CHECK(switcher.current().note().find("it is an input") != std::string::npos);
    CHECK(read_text(folder / "bark.png") == bark);
    REQUIRE(show(kGrowing));

    press({Key::P, false, false, false});
    CHECK(panels.picture.name == "plant-2");
    panels.picture.is_film = true;
    panels.picture.kind = FilmKind::Growth;
    panels.picture.seconds = 1.0F;
    panels.picture.frames_per_second = 2.0F;
    press({Key::Enter, false, false, false});
    CHECK(panels.film.is_busy());
    std::optional<std::string> outcome;
    REQUIRE(until([&] {
        outcome = panels.film.take();
        return outcome.has_value();
    }));
    CHECK(*outcome ==
          fmt::format("Wrote {} to {}", folder / "plant-2.0001.png", folder / "plant-2.0002.png"));
    CHECK_FALSE(panels.film.is_busy());
    CHECK(picture_in(folder / "plant-2.0001.png").width == 100);
    write_text(folder / "plant.lsys", "#n = 0;\n#w : F;\n");
    switcher.current().reload();
    REQUIRE(until([&] { return !switcher.current().has_growth(); }));
    press({Key::P, false, false, false});
    press({Key::Enter, false, false, false});
    CHECK(switcher.current().note() == "not written: nothing grows here");
    CHECK(renderer->errors().empty());
}
