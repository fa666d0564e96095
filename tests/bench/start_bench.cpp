// SPDX-License-Identifier: MIT
// Compares whole runs of `lsc`, from start to exit, with a C++ program that prints one line and is
// linked in the same way. The programs run alternately, so that a slow moment of the machine affects
// all of them. Prints a table of medians. Asserts nothing about time.
// Usage: start_bench [RUNS]
#include "tests/bench/measure.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <fcntl.h>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace {

struct Program {
    const char* name;
    std::vector<std::string> arguments; // first the path of the program
    std::vector<double> times;          // seconds
};

/// Runs a program without a shell; its output is discarded.
void run(const Program& program) {
    std::vector<char*> arguments;
    for (const std::string& argument : program.arguments) {
        arguments.push_back(const_cast<char*>(argument.c_str())); // posix_spawn() takes char*
    }
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    int status = 1;
    const bool has_run =
        posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ) == 0 &&
        waitpid(child, &status, 0) == child;
    posix_spawn_file_actions_destroy(&actions);
    if (!has_run || status != 0) {
        lsys::bench::fail(program.arguments[0] + " failed");
    }
}

} // namespace

int main(int argc, char** argv) {
    constexpr int kRuns = 200;
    const int runs = argc > 1 ? std::atoi(argv[1]) : kRuns;
    std::array<Program, 4> programs{
        {{"a program that prints one line", {LSYS_ONE_LINE}, {}},
         {"the same, with the C++ library alone", {LSYS_ONE_LINE_ALONE}, {}},
         {"lsc --version", {LSYS_LSC, "--version"}, {}},
         {"lsc check of a sample", {LSYS_LSC, "check", LSYS_SAMPLE}, {}}}};
    for (int i = -1; i < runs; ++i) {
        for (Program& program : programs) {
            const double spent = lsys::bench::seconds([&] { run(program); });
            if (i >= 0) { // the first run only fills the file caches
                program.times.push_back(spent);
            }
        }
    }
    const double least = lsys::bench::median(programs[0].times);
    fmt::print("Start and end of a program, median of {} runs; in brackets the part of the first "
               "row.\n\n",
               runs);
    for (const Program& program : programs) {
        const double spent = lsys::bench::median(program.times);
        fmt::print("{:<36} {:>9.3f} ms [{:.2f}]\n", program.name, spent * 1000.0, spent / least);
    }
    return 0;
}
