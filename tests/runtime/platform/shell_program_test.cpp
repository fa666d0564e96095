// SPDX-License-Identifier: MIT
// Programs that answer lines: well-behaved, dead, silent and endless ones.
#include "runtime/platform/shell_program.h"

#include <catch2/catch.hpp>

#if !defined(_WIN32) && !defined(__EMSCRIPTEN__)

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <string>

using namespace lsys::platform;
using Reply = ShellProgram::Reply;

namespace {

constexpr double kLong = 30.0; // seconds
constexpr std::uint64_t kMaxBytes = 1 << 20;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

TEST_CASE("a program answers line by line") {
    ShellProgram program;
    REQUIRE(program.start("while read line; do echo \"got $line\"; done") == 0);
    std::string answer;
    CHECK(program.ask("one", kLong, kMaxBytes, nullptr, answer) == Reply::Line);
    CHECK(answer == "got one");
    CHECK(program.ask("two", kLong, kMaxBytes, nullptr, answer) == Reply::Line);
    CHECK(answer == "got two");
}

TEST_CASE("a line larger than the buffers of the pipes reaches a program and comes back") {
    ShellProgram program;
    REQUIRE(program.start("cat") == 0);
    const std::string line(5'000'000, 'x');
    std::string answer;
    CHECK(program.ask(line, kLong, 6'000'000, nullptr, answer) == Reply::Line);
    CHECK(answer == line);
}

TEST_CASE("a program that ends is reported with its status and its messages") {
    ShellProgram program;
    REQUIRE(program.start("read line; echo broken >&2; exit 3") == 0);
    std::string answer;
    CHECK(program.ask("question", kLong, kMaxBytes, nullptr, answer) == Reply::Ended);
    CHECK(program.exit_text() == "exit status 3");
    CHECK(program.messages() == "broken\n");
}

TEST_CASE("a program that a signal ends is reported") {
    ShellProgram program;
    REQUIRE(program.start("read line; kill -KILL $$") == 0);
    std::string answer;
    CHECK(program.ask("question", kLong, kMaxBytes, nullptr, answer) == Reply::Ended);
    CHECK(program.exit_text() == "signal 9");
}

TEST_CASE("a program that closes its output and runs on is not reported as ended by a signal") {
    ShellProgram program;
    REQUIRE(program.start("exec >&-; sleep 600") == 0);
    std::string answer;
    CHECK(program.ask("question", kLong, kMaxBytes, nullptr, answer) == Reply::Ended);
    CHECK(program.exit_text().empty());
}

TEST_CASE("a program that hangs is ended after the time") {
    ShellProgram program;
    REQUIRE(program.start("sleep 600") == 0);
    std::string answer;
    const auto start = std::chrono::steady_clock::now();
    CHECK(program.ask("question", 0.2, kMaxBytes, nullptr, answer) == Reply::TimedOut);
    CHECK(seconds_since(start) < 20.0);
}

TEST_CASE("a line without end is refused before it takes memory") {
    ShellProgram program;
    REQUIRE(program.start("read line; cat /dev/zero") == 0);
    std::string answer;
    CHECK(program.ask("question", kLong, kMaxBytes, nullptr, answer) == Reply::TooLong);
}

TEST_CASE("the flag ends a program that does not answer") {
    ShellProgram program;
    REQUIRE(program.start("sleep 600") == 0);
    const std::atomic<bool> cancelled{true};
    std::string answer;
    CHECK(program.ask("question", kLong, kMaxBytes, &cancelled, answer) == Reply::Cancelled);
}

TEST_CASE("the processes that a program has started end with it") {
    int started = 0;
    {
        ShellProgram program;
        REQUIRE(program.start("sleep 600 & echo $!; wait") == 0);
        std::string answer;
        REQUIRE(program.ask("", kLong, kMaxBytes, nullptr, answer) == Reply::Line);
        started = std::stoi(answer);
        REQUIRE(::kill(started, 0) == 0);
    }
    // The system may take a moment to remove it; a zombie of another parent counts as removed
    // only after that parent has read its status.
    const auto start = std::chrono::steady_clock::now();
    bool runs = true;
    while (runs && seconds_since(start) < 20.0) {
        runs = ::kill(started, 0) == 0;
    }
    CHECK_FALSE(runs);
}

#endif
