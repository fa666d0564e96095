// SPDX-License-Identifier: MIT
#include "runtime/program/console.h"
#include "tests/support/lsc_run.h"
#include "tests/viewer/lsview_run.h"
#include "viewer/app/plant_loader.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <thread>

using namespace lsys;
using namespace lsys::tests;
using namespace lsys::view;
using namespace std::chrono_literals;

namespace {

ViewOptions options_of(const std::string& file) {
    ViewOptions options;
    options.file = file;
    options.run.limits.max_bytes = std::uint64_t{1} << 30;
    return options;
}

/// The next outcome; an empty one after 60 s.
LoadOutcome wait_for(PlantLoader& loader) {
    for (const auto start = SteadyClock::now(); SteadyClock::now() - start < 60s;) {
        if (std::optional<LoadOutcome> outcome = loader.take()) {
            return std::move(*outcome);
        }
        std::this_thread::sleep_for(1ms);
    }
    FAIL("nothing was made");
    return {};
}

// A derivation too long to finish: the word doubles in each of 40 generations, and each module
// evaluates a condition.
constexpr const char* kEndless = "#n = 40;\n#w : A(0);\n#p : A(x) : x >= 0 : A(x) F A(x);\n"
                                 "#q : A(x) : x < 0 : F;\n";

} // namespace

TEST_CASE("a loader makes the plant and lists the files that the plant depends on") {
    PlantLoader loader([] {});
    loader.request(options_of(sample("teach-include")), SteadyClock::now());
    const LoadOutcome outcome = wait_for(loader);
    REQUIRE(outcome.document != nullptr);
    CHECK(outcome.messages.all().empty());
    CHECK(outcome.document->plant.modules > 0);
    CHECK_FALSE(outcome.document->mesh.indices.empty());
    REQUIRE(outcome.files.size() == 2);
    CHECK(outcome.files[0] == sample("teach-include"));
    CHECK(outcome.files[1].ends_with("leaf.lsys"));
    CHECK_FALSE(loader.is_busy());
}

TEST_CASE("messages are those of lsc, and missing files are listed") {
    const ScratchFolder folder;
    write_text(folder / "bad.lsys", "#n = 2;\n#include \"none.lsys\";\n#w : F(;\n");
    PlantLoader loader([] {});
    loader.request(options_of(folder / "bad.lsys"), SteadyClock::now());
    const LoadOutcome outcome = wait_for(loader);
    CHECK(outcome.document == nullptr);
    CHECK(outcome.messages.has_errors());
    CHECK(messages_text(outcome.messages, {}, "lsc") ==
          run_lsc({"check", folder / "bad.lsys"}, "").err);
    CHECK(outcome.files == std::vector<std::string>{folder / "bad.lsys", folder / "none.lsys"});
}

TEST_CASE("the limit --max-time ends a loading in a window and the pictures of a command") {
    const ScratchFolder folder;
    write_text(folder / "endless.lsys", kEndless);
    ViewOptions endless = options_of(folder / "endless.lsys");
    endless.run.limits.max_bytes = std::uint64_t{1} << 40;
    endless.run.limits.max_modules = std::uint64_t{1} << 42;
    endless.run.max_seconds = 0.1;
    PlantLoader loader([] {});
    loader.request(endless, SteadyClock::now());
    const LoadOutcome late = wait_for(loader);
    CHECK(late.document == nullptr);
    CHECK_THAT(messages_text(late.messages, {}, "lsview"),
               Catch::Contains("this takes longer than 0.1 s, the limit of `--max-time`"));
    endless.file = sample("teach-include");
    endless.run.max_seconds = 3600;
    loader.request(endless, SteadyClock::now());
    CHECK(wait_for(loader).document != nullptr);

    const LscRun pictures =
        run_lsview({folder / "endless.lsys", "--screenshot", folder / "x.png", "--max-time", "0.1",
                    "--max-memory", "1T", "--max-modules", "4000000000000"});
    CHECK(pictures.status == 3);
    CHECK_THAT(pictures.err,
               Catch::Contains("the command takes longer than 0.1 s, the limit of `--max-time`"));
    CHECK_FALSE(std::filesystem::exists(folder / "x.png"));
}

TEST_CASE("the newest request counts, and a slow earlier one is cancelled") {
    const ScratchFolder folder;
    write_text(folder / "endless.lsys", kEndless);
    ViewOptions endless = options_of(folder / "endless.lsys");
    endless.run.limits.max_bytes = std::uint64_t{1} << 40;
    endless.run.limits.max_modules = std::uint64_t{1} << 42;
    PlantLoader loader([] {});
    loader.request(endless, SteadyClock::now());
    std::this_thread::sleep_for(50ms); // wait until the request runs
    ViewOptions newer = options_of(sample("teach-param"));
    for (std::uint32_t n = 1; n <= 4; ++n) {
        newer.grammar.generations = n;
        loader.request(newer, SteadyClock::now());
    }
    const LoadOutcome outcome = wait_for(loader);
    REQUIRE(outcome.document != nullptr);
    CHECK(outcome.document->plant.generations == 4);
    CHECK_FALSE(loader.take());
}

TEST_CASE("destroying a loader cancels its work") {
    const ScratchFolder folder;
    write_text(folder / "endless.lsys", kEndless);
    ViewOptions endless = options_of(folder / "endless.lsys");
    endless.run.limits.max_bytes = std::uint64_t{1} << 40;
    endless.run.limits.max_modules = std::uint64_t{1} << 42;
    const auto start = SteadyClock::now();
    {
        PlantLoader loader([] {});
        loader.request(endless, SteadyClock::now());
        std::this_thread::sleep_for(20ms);
    }
    CHECK(SteadyClock::now() - start < 30s);
}

TEST_CASE("a repeated request reads the file again") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    write_text(file, "#n = 0;\n#w : F;\n");
    PlantLoader loader([] {});
    loader.repeat(SteadyClock::now());
    CHECK_FALSE(loader.is_busy());
    loader.request(options_of(file), SteadyClock::now());
    CHECK(wait_for(loader).document->plant.modules == 1);
    write_text(file, "#n = 0;\n#w : F F F;\n");
    const auto since = SteadyClock::now();
    loader.repeat(since);
    const LoadOutcome outcome = wait_for(loader);
    CHECK(outcome.document->plant.modules == 3);
    CHECK(outcome.changed_at == since);
}
