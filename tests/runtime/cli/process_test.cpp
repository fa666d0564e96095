// The executable as a process: Ctrl-C, a full disk, a limit on memory.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace {

using lsys::tests::read_text;
using lsys::tests::ScratchFolder;
using lsys::tests::write_text;
using Clock = std::chrono::steady_clock;

struct Child {
    std::vector<std::string> arguments;
    std::string out = "/dev/null";
    std::string err = "/dev/null";
    rlim_t memory = RLIM_INFINITY;
};

pid_t start(const Child& child) {
    std::vector<std::string> words{LSC_EXECUTABLE};
    words.insert(words.end(), child.arguments.begin(), child.arguments.end());
    std::vector<char*> raw;
    for (std::string& word : words) {
        raw.push_back(word.data());
    }
    raw.push_back(nullptr);
    const pid_t process = ::fork();
    if (process == 0) {
        ::dup2(::open(child.out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
        ::dup2(::open(child.err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
        if (child.memory != RLIM_INFINITY) {
            const rlimit limit{child.memory, child.memory};
            ::setrlimit(RLIMIT_AS, &limit);
        }
        ::execv(raw[0], raw.data());
        ::_exit(127);
    }
    return process;
}

/// The exit status, or -signal.
int wait_for(pid_t process) {
    int status = 0;
    ::waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

} // namespace

TEST_CASE("Ctrl-C ends a derivation with 130 and no file") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 4000000000; #w : F F F F; #p : F : * : F;");
    for (const char* option : {"--all", "--count"}) {
        const Clock::time_point begin = Clock::now();
        const pid_t process =
            start({{"dump", "-q", option, folder / "a.lsys", "-o", folder / "out"},
                   "/dev/null",
                   folder / "err"});
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        REQUIRE(::kill(process, SIGINT) == 0);
        CHECK(wait_for(process) == 130);
        CHECK(Clock::now() - begin < std::chrono::seconds(10));
        CHECK(read_text(folder / "err") == "lsc: interrupted\n");
        CHECK(!std::filesystem::exists(folder / "out"));
    }
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        ++files;
    }
    CHECK(files == 2); // the grammar and the messages
}

TEST_CASE("a full disk is told and ends with 2") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 10; #w : F; #p : F : * : F F;");
    CHECK(wait_for(start({{"dump", folder / "a.lsys"}, "/dev/full", folder / "err"})) == 2);
    CHECK(read_text(folder / "err") ==
          "lsc: error: cannot write standard output: no space left on device\n");
}

#ifndef LSYS_INSTRUMENTED
TEST_CASE("a grammar that does not fit into memory ends with 3") {
    const ScratchFolder folder;
    std::string text = "#n = 1; #w :";
    for (int i = 0; i < 3'000'000; ++i) {
        text += " F(1+2+3)";
    }
    write_text(folder / "a.lsys", text + ";");
    constexpr rlim_t kLittle = rlim_t{160} << 20;
    CHECK(wait_for(start({{"check", folder / "a.lsys"}, "/dev/null", folder / "err", kLittle})) ==
          3);
    CHECK(read_text(folder / "err") == "lsc: error: out of memory\n");
}

TEST_CASE("a word that the system has no memory for ends with 3") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 40; #w : F; #p : F : * : F F;");
    constexpr rlim_t kLittle = rlim_t{400} << 20;
    CHECK(wait_for(start(
              {{"dump", "-n", "31", "--threads", "1", "--max-memory", "1T", folder / "a.lsys"},
               "/dev/null",
               folder / "err",
               kLittle})) == 3);
    CHECK(read_text(folder / "err").find("memory") != std::string::npos);
}
#endif
