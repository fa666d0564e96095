// SPDX-License-Identifier: MIT
// The executable as a process: signals, closed standard streams, a full disk, limits of memory and
// of the size of files.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <fcntl.h>
#include <filesystem>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>
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
    std::string in = "/dev/null";
    rlim_t file_size = RLIM_INFINITY;
    int closed = -1;        // standard stream to close; -1: none
    int ignored_signal = 0; // signal to ignore, as nohup(1) does; 0: none
};

/// Starts lsc; returns after execv(), because the forked process has the signal handlers of Catch2
/// until then.
pid_t start(const Child& child) {
    std::vector<std::string> words{LSC_EXECUTABLE};
    words.insert(words.end(), child.arguments.begin(), child.arguments.end());
    std::vector<char*> raw;
    for (std::string& word : words) {
        raw.push_back(word.data());
    }
    raw.push_back(nullptr);
    int started[2]; // a pipe whose write end `execv` closes
    REQUIRE(::pipe2(started, O_CLOEXEC) == 0);
    const pid_t process = ::fork();
    if (process == 0) {
        ::dup2(::open(child.in.c_str(), O_RDONLY), STDIN_FILENO);
        ::dup2(::open(child.out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
        ::dup2(::open(child.err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
        if (child.memory != RLIM_INFINITY) {
            const rlimit limit{child.memory, child.memory};
            ::setrlimit(RLIMIT_AS, &limit);
        }
        if (child.file_size != RLIM_INFINITY) {
            const rlimit limit{child.file_size, child.file_size};
            ::setrlimit(RLIMIT_FSIZE, &limit);
        }
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
            std::signal(signal, signal == child.ignored_signal ? SIG_IGN : SIG_DFL);
        }
        if (child.closed >= 0) {
            ::close(child.closed);
        }
        ::execv(raw[0], raw.data());
        ::_exit(127);
    }
    ::close(started[1]);
    char none = 0;
    CHECK(::read(started[0], &none, 1) == 0);
    ::close(started[0]);
    return process;
}

struct Ended {
    int status = 0;    // exit status, or -signal
    long peak_kib = 0; // peak resident memory
};

Ended end_of(pid_t process) {
    int status = 0;
    rusage usage{};
    ::wait4(process, &status, 0, &usage);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), usage.ru_maxrss};
}

/// The exit status, or -signal.
int wait_for(pid_t process) {
    return end_of(process).status;
}

/// Waits until a condition holds, at most 30 seconds; returns whether it does.
template <typename Condition>
bool holds_soon(const Condition& condition) {
    const Clock::time_point end = Clock::now() + std::chrono::seconds(30);
    while (!condition() && Clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return condition();
}

/// Whether a process has a handler of its own for a signal.
bool handles(pid_t process, int signal) {
    std::istringstream status(read_text("/proc/" + std::to_string(process) + "/status"));
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("SigCgt:")) {
            return ((std::stoull(line.substr(7), nullptr, 16) >> (signal - 1)) & 1U) != 0;
        }
    }
    return false;
}

constexpr const char* kFourEndless = "#n = 4000000000; #w : F F F F; #p : F : * : F;";

} // namespace

TEST_CASE("Ctrl-C ends a derivation with status 130 and no file") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", kFourEndless);
    for (const char* option : {"--all", "--count"}) {
        const Clock::time_point begin = Clock::now();
        const pid_t process =
            start({{"dump", "-q", option, folder / "a.lsys", "-o", folder / "out"},
                   "/dev/null",
                   folder / "err"});
        CHECK(holds_soon([&] { return handles(process, SIGINT); }));
        REQUIRE(::kill(process, SIGINT) == 0);
        CHECK(wait_for(process) == 130);
        CHECK(Clock::now() - begin < std::chrono::seconds(10));
        CHECK(read_text(folder / "err") == "lsc: interrupted\n");
        CHECK(!std::filesystem::exists(folder / "out"));
    }
    CHECK(folder.file_count() == 2); // the grammar and the file of messages
}

TEST_CASE("SIGTERM and SIGHUP end a derivation like Ctrl-C, with status 143 and 129") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", kFourEndless);
    for (const auto& [signal, status] : {std::pair{SIGTERM, 143}, std::pair{SIGHUP, 129}}) {
        for (const int times : {1, 2}) { // timeout(1) sends its signal twice
            const Clock::time_point begin = Clock::now();
            const pid_t process = start({{"dump", "-q", folder / "a.lsys", "-o", folder / "out"},
                                         "/dev/null",
                                         folder / "err"});
            // The third file is the unfinished output.
            CHECK(holds_soon([&] { return folder.file_count() == 3; }));
            for (int i = 0; i < times; ++i) {
                REQUIRE(::kill(process, signal) == 0);
            }
            CHECK(wait_for(process) == status);
            CHECK(Clock::now() - begin < std::chrono::seconds(10));
            CHECK(read_text(folder / "err") == "lsc: interrupted\n");
            CHECK(folder.file_count() == 2);
        }
    }
}

TEST_CASE("a run that waits for a pipe ends soon after SIGTERM") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 12; #w : F; #p : F : * : F F F;");
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    // Opened for reading and writing, so that a full pipe makes the writer wait.
    const int both = ::open((folder / "pipe").c_str(), O_RDWR | O_CLOEXEC);
    REQUIRE(both >= 0);
    const Clock::time_point begin = Clock::now();
    const pid_t process =
        start({{"dump", folder / "a.lsys", "--save-state", folder / "state"}, folder / "pipe"});
    // The third file is the unfinished state.
    CHECK(holds_soon([&] { return folder.file_count() == 3; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(500)); // the pipe becomes full
    REQUIRE(::kill(process, SIGTERM) == 0);
    CHECK(wait_for(process) == 143);
    CHECK(Clock::now() - begin < std::chrono::seconds(10));
    CHECK(folder.file_count() == 2);
    ::close(both);
}

TEST_CASE("a second Ctrl-C ends the run at once and leaves no file either") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 12; #w : F; #p : F : * : F F F;");
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    const int both = ::open((folder / "pipe").c_str(), O_RDWR | O_CLOEXEC);
    REQUIRE(both >= 0);
    const pid_t process =
        start({{"dump", folder / "a.lsys", "--save-state", folder / "state"}, folder / "pipe"});
    CHECK(holds_soon([&] { return folder.file_count() == 3; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(500)); // the pipe becomes full
    for (int i = 0; i < 2; ++i) {
        REQUIRE(::kill(process, SIGINT) == 0);
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    CHECK(wait_for(process) == -SIGINT);
    CHECK(folder.file_count() == 2);
    ::close(both);
}

TEST_CASE("a run under nohup ignores SIGHUP") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", kFourEndless);
    Child child{{"dump", "-q", folder / "a.lsys", "-o", folder / "out"}};
    child.ignored_signal = SIGHUP;
    const pid_t process = start(child);
    CHECK(holds_soon([&] { return handles(process, SIGTERM); }));
    REQUIRE(::kill(process, SIGHUP) == 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    int status = 0;
    CHECK(::waitpid(process, &status, WNOHANG) == 0);
    REQUIRE(::kill(process, SIGTERM) == 0);
    CHECK(wait_for(process) == 143);
}

TEST_CASE("a closed standard stream is not replaced by an opened file") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 4; #w : F; #p : F : * : F + F;");
    const lsys::tests::LscRun word = lsys::tests::run_lsc({"dump", folder / "a.lsys"}, "");
    Child child{{"dump", "-v", folder / "a.lsys", "-o", folder / "out"}};
    child.closed = STDERR_FILENO;
    CHECK(wait_for(start(child)) == 0);
    CHECK(read_text(folder / "out") == word.out);

    child.arguments = {"dump", folder / "a.lsys", "--steps", "2", "--save-state", folder / "state"};
    child.err = folder / "err";
    child.closed = STDOUT_FILENO;
    CHECK(wait_for(start(child)) == 2);
    CHECK(read_text(folder / "err") == "lsc: error: cannot write standard output: it is closed\n");
    CHECK(!std::filesystem::exists(folder / "state"));

    child.arguments = {"dump", folder / "a.lsys", "-o", "/dev/stdout"};
    CHECK(wait_for(start(child)) == 2);

    child.arguments = {"check", folder / "a.lsys"}; // `check` prints nothing
    CHECK(wait_for(start(child)) == 0);

    child.arguments = {"check", "-"};
    child.closed = STDIN_FILENO;
    CHECK(wait_for(start(child)) == 2);
    CHECK(read_text(folder / "err") == "lsc: error: cannot read `<stdin>`: it is closed\n");
    child.arguments = {"check", "/dev/stdin"};
    CHECK(wait_for(start(child)) == 2);
}

TEST_CASE("every command reports that standard output is full") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 2; #w : F; #p : F : * : F [+F];");
    std::filesystem::create_directories(folder / "systems");
    write_text(folder / "systems/a.l", "a {\n angle 4\n axiom f\n f=f+f\n}\n");
    const std::string a = folder / "a.lsys";
    const std::vector<std::vector<std::string>> commands{
        {"--help"},
        {"--version"},
        {"check", "--help"},
        {"explain"},
        {"explain", "look-alike"},
        {"compile", a, "-o", "-"},
        {"dump", a},
        {"dump", a, "--all"},
        {"dump", a, "--count"},
        {"dump", a, "--stream"},
        {"dump", a, "--origins"},
        {"dump", a, "--save-state", "-", "-o", folder / "word"},
        {"dump", a, "--stage", "tokens"},
        {"dump", a, "--stage", "ast"},
        {"dump", a, "--stage", "program"},
        {"dump", a, "--stage", "bytecode"},
        {"dump", a, "--stage", "skeleton"},
        {"dump", a, "--stage", "mesh"},
        {"export", a, "-o", "-", "--format", "ply"},
        {"export", a, "-o", folder / "a.ply", "--stats"},
        {"export", a, "-o", folder / "a.ply", "--stats", "--message-format", "json"},
        {"forest", a, "--count", "3", "--stats"},
        {"forest", a, "--count", "3", "--stats", "--message-format", "json"},
        {"import", folder / "systems/a.l"},
        {"import", "--all", folder / "systems", "-o", folder / "imported"},
        {"import", folder / "systems/a.l", "-o", folder / "imported/"},
        {"stats", a},
        {"stats", a, "--message-format", "json"},
        {"fmt", "-"},
        {"check", "--fix", "-"},
    };
    for (const std::vector<std::string>& command : commands) {
        std::string line;
        for (const std::string& word : command) {
            line += word + ' ';
        }
        CAPTURE(line);
        Child child{command, "/dev/full", folder / "err"};
        child.in = a;
        CHECK(wait_for(start(child)) == 2);
        CHECK(read_text(folder / "err")
                  .find("cannot write standard output: no space left on "
                        "device") != std::string::npos);
    }
}

TEST_CASE("a limit on the size of files is an error that leaves no file") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 12; #w : F; #p : F : * : F F F;");
    Child child{{"dump", folder / "a.lsys", "-o", folder / "word"}, "/dev/null", folder / "err"};
    child.file_size = 100'000;
    CHECK(wait_for(start(child)) == 2);
    CHECK(read_text(folder / "err") ==
          "lsc: error: cannot write `" + folder / "word" + "`: file too large\n");
    CHECK(folder.file_count() == 2);
}

TEST_CASE("files that belong together are written together or not at all") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 6; #set names letters; #w : A; #object L LEAF;"
                                  "#p : A : ~ 0.5 : F[+A][-A]/A L; #q : A : ~ 0.5 : F[+A]//A L;");
    // The limit of the file size admits the pictures, but not the forest or plant.
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"forest", folder / "a.lsys", "--count", "100"},
          {"export", folder / "a.lsys", "-n", "8"}}) {
        Child child{command, "/dev/null", folder / "err"};
        child.arguments.insert(child.arguments.end(), {"-o", folder / "x.usda"});
        child.file_size = 200'000;
        CHECK(wait_for(start(child)) == 2);
        CHECK(read_text(folder / "err") ==
              "lsc: error: cannot write `" + folder / "x.usda" + "`: file too large\n");
        CHECK(folder.file_count() == 2);
        child.file_size = RLIM_INFINITY;
        CHECK(wait_for(start(child)) == 0);
        CHECK(folder.file_count() > 3);
        for (const char* name : {"x.usda", "x.bark.png", "x.bark_normals.png", "x.leaf.png"}) {
            std::filesystem::remove(folder / name);
        }
        CHECK(folder.file_count() == 2);
    }
}

TEST_CASE("a series that ends early lists its complete files") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 3; #w : F; #p : F : * : F [+F];");
    Child child{{"forest", folder / "a.lsys", "--placement", "domination", "--count", "100",
                 "--years", "40", "--frames", "10", "-o", folder / "x.json"},
                "/dev/null",
                folder / "err"};
    std::filesystem::create_directory(folder / "x.0003.json");
    CHECK(wait_for(start(child)) == 2);
    CHECK(read_text(folder / "err")
              .ends_with("lsc: error: cannot write `" + folder / "x.0003.json" +
                         "`: is a directory\nlsc: 2 of 10 frames are complete, the last of them `" +
                         folder / "x.0002.json" + "`\n"));
}

TEST_CASE("a full disk is reported and ends with status 2") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 10; #w : F; #p : F : * : F F;");
    CHECK(wait_for(start({{"dump", folder / "a.lsys"}, "/dev/full", folder / "err"})) == 2);
    CHECK(read_text(folder / "err") ==
          "lsc: error: cannot write standard output: no space left on device\n");
}

#ifndef LSYS_INSTRUMENTED
TEST_CASE("a grammar that does not fit into memory ends with status 3") {
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

TEST_CASE("a word that does not fit into the memory of the system ends with status 3") {
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

TEST_CASE("the message about a plant over the memory of the system does not mention the limit") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 23; #w : F; #p : F : * : F F;");
    constexpr rlim_t kLittle = rlim_t{400} << 20;
    CHECK(wait_for(start({{"export", folder / "a.lsys", "--threads", "1", "--max-memory", "1T",
                           "-o", folder / "a.stl"},
                          "/dev/null",
                          folder / "err",
                          kLittle})) == 3);
    CHECK(read_text(folder / "err") ==
          "lsc: error: the system has no memory for the skeleton [limit-reached]\n"
          "help: ask for fewer generations with `-n`\n");
    CHECK(folder.file_count() == 2);
}

TEST_CASE("picture files and mesh files count towards the limit on memory") {
    const ScratchFolder folder;
    // The picture of 8192 by 8192 pixels has 8 KB as a file and 256 MiB in memory.
    write_text(folder / "card.mtl",
               "newmtl card\nmap_Kd " LSYS_SOURCE_DIR "/tests/ui/objects/parts/large.png\n");
    write_text(folder / "card.obj", "mtllib card.mtl\nusemtl card\nv -1 0 0\nv 1 0 0\nv 0 2 0\n"
                                    "vt 0 0\nvt 1 0\nvt 0.5 1\nf 1/1 2/2 3/3\n");
    std::string objects;
    std::string word;
    for (char name = 'A'; name < 'M'; ++name) {
        objects += std::string("#object ") + name + " \"card.obj\";\n";
        word += std::string(" ") + name;
    }
    write_text(folder / "a.lsys", "#n = 1;\n" + objects + "#w :" + word + ";\n");
    const auto run = [&](const char* limit, const char* output) {
        return end_of(
            start({{"export", "--max-memory", limit, folder / "a.lsys", "-o", folder / output},
                   "/dev/null",
                   folder / "err"}));
    };
    const Ended refused = run("50M", "a.glb");
    CHECK(refused.status == 3);
    CHECK(refused.peak_kib < 200L << 10);
    CHECK(read_text(folder / "err").find("limit-reached") != std::string::npos);
    // STL has no pictures, so the peak is the memory for reading them: one picture, shared by all
    // objects.
    const Ended read = run("300M", "a.stl");
    CHECK(read.status == 0);
    CHECK(read.peak_kib < 450L << 10);
}

TEST_CASE("an endless pipe is read up to the limit on memory") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 1; #w : F;");
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    const std::vector<std::vector<std::string>> commands{
        {"dump", "--from", folder / "pipe", folder / "a.lsys"},
        {"dump", folder / "pipe", "--dialect", "lsys"},
        {"forest", folder / "a.lsys", "--placement", "density-map", "--density", "1",
         "--density-map", folder / "pipe", "--check"}};
    for (const std::vector<std::string>& command : commands) {
        Child child{command, "/dev/null", folder / "err"};
        child.arguments.insert(child.arguments.end(), {"--max-memory", "20M"});
        const pid_t process = start(child);
        const pid_t writer = ::fork();
        if (writer == 0) {
            const int pipe = ::open((folder / "pipe").c_str(), O_WRONLY | O_CLOEXEC);
            const std::string piece(1 << 16, ' ');
            while (::write(pipe, piece.data(), piece.size()) > 0) {
            }
            ::_exit(0);
        }
        const Ended ended = end_of(process);
        ::kill(writer, SIGKILL);
        static_cast<void>(end_of(writer));
        CAPTURE(command.front(), read_text(folder / "err"));
        CHECK(ended.status == 3);
        CHECK(ended.peak_kib < 200L << 10);
        CHECK(read_text(folder / "err").find("of the memory limit") != std::string::npos);
    }
}

TEST_CASE("a run does not wait for a pipe that a grammar names") {
    const ScratchFolder folder;
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    write_text(folder / "a.lsys", "#n = 1;\n#include \"pipe\";\n#w : F;\n");
    write_text(folder / "b.lsys", "#n = 1;\n#object Q \"pipe\";\n#w : Q;\n");
    CHECK(wait_for(start({{"check", folder / "a.lsys"}, "/dev/null", folder / "err"})) == 1);
    CHECK(read_text(folder / "err").find("it is not a regular file") != std::string::npos);
    CHECK(wait_for(start({{"export", folder / "b.lsys", "-o", folder / "b.glb"},
                          "/dev/null",
                          folder / "err"})) == 1);
    const std::string err = read_text(folder / "err");
    CHECK(err.find("b.lsys:2:11: error: cannot read `") != std::string::npos);
    CHECK(err.find("it is not a regular file") != std::string::npos);
}
#endif
