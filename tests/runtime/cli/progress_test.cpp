// SPDX-License-Identifier: MIT
#include "runtime/cli/progress.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <sstream>

using lsys::lsc::Progress;
using namespace std::chrono_literals;

TEST_CASE("progress is drawn after a second, not too often, and erased at the end") {
    const Progress::Clock::time_point begin{};
    std::ostringstream terminal;
    {
        Progress progress(&terminal, 8, begin, {});
        progress.update(1, 10, begin + 900ms);
        CHECK(terminal.str().empty());
        progress.update(2, 20, begin + 1s);
        CHECK(terminal.str() ==
              "\r\x1b[K[======                  ] generation 2 of 8, 20 modules, 30/s");
        terminal.str("");
        progress.update(2, 30, begin + 1050ms);
        CHECK(terminal.str().empty());
        progress.update(8, 40, begin + 2s);
        CHECK(terminal.str() ==
              "\r\x1b[K[========================] generation 8 of 8, 40 modules, 40/s");
        terminal.str("");
    }
    CHECK(terminal.str() == "\r\x1b[K");
}

TEST_CASE("short work and no terminal show no progress") {
    const Progress::Clock::time_point begin{};
    std::ostringstream terminal;
    {
        Progress progress(&terminal, 0, begin, {});
        progress.update(0, 1, begin + 10ms);
    }
    CHECK(terminal.str().empty());
    Progress none(nullptr, 8, begin, {});
    none.update(1, 10, begin + 10s);
    none.clear();
}

TEST_CASE("the remaining time is estimated from the predicted number of modules") {
    const Progress::Clock::time_point begin{};
    std::ostringstream terminal;
    Progress progress(&terminal, 3, begin, {1, 1e6, 3e6, 6e6});
    progress.update(1, 1'000'000, begin + 500ms);
    progress.update(2, 1'500'000, begin + 5s); // 2.5 of 10 million modules are done
    CHECK(terminal.str() == "\r\x1b[K[================        ] generation 2 of 3, 1500000 "
                            "modules, 500 k/s, 15 s left");
    terminal.str("");
    progress.update(3, 1'000'000, begin + 500s); // 5 of 10 million modules are done
    CHECK(terminal.str() == "\r\x1b[K[========================] generation 3 of 3, 1000000 "
                            "modules, 7 k/s, 8:20 min left");
    progress.clear();
}
