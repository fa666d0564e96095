// SPDX-License-Identifier: MIT
// Links, permissions and devices, which are missing or different on Windows.
#include "runtime/program/files.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <fcntl.h>
#include <filesystem>
#include <sstream>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

using namespace lsys;
using lsys::tests::read_text;
using lsys::tests::ScratchFolder;
using lsys::tests::write_text;

namespace {

struct PosixFixture {
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    ScratchFolder folder;
    Console console{{in, out, err}, {}};
};

} // namespace

TEST_CASE("devices are read to their end, up to the size limit") {
    PosixFixture f;
    const Result<std::string> device = read_file("/dev/null", {1000}, f.console);
    REQUIRE(device.ok());
    CHECK(device.value().empty());
    // A device without an end and without a size.
    CHECK(!read_file("/dev/zero", {3'000'000}, f.console).ok());
}

TEST_CASE("devices are written in place") {
    PosixFixture f;
    CHECK(write_file("/dev/full", "text", f.console).error().message ==
          "cannot write `/dev/full`: no space left on device");
    CHECK(write_file("/dev/null", "text", f.console).ok());
}

TEST_CASE("no writer removes the temporary file of another one") {
    PosixFixture f;
    constexpr int kWriters = 6;
    std::atomic<int> failures{0};
    std::vector<std::thread> writers;
    for (int writer = 0; writer < kWriters; ++writer) {
        writers.emplace_back([&f, &failures, writer] {
            std::ostringstream out;
            std::ostringstream err;
            const Console console{{f.in, out, err}, {}};
            const std::string text(1000, static_cast<char>('a' + writer));
            for (int i = 0; i < 300; ++i) {
                std::vector<Output> outputs; // committed by an exchange of names every second time
                Result<Output> output = Output::open(f.folder / "x", console);
                bool is_written = output.ok() && output.value().write(text).ok();
                if (is_written && i % 2 == 0) {
                    outputs.push_back(std::move(output.value()));
                    is_written = commit_all(outputs).ok();
                } else if (is_written) {
                    is_written = output.value().commit().ok();
                }
                failures += is_written ? 0 : 1;
            }
        });
    }
    for (std::thread& writer : writers) {
        writer.join();
    }
    CHECK(failures == 0);
    const std::string text = read_text(f.folder / "x");
    CHECK(text.size() == 1000);
    CHECK(text.find_first_not_of(text[0]) == std::string::npos);
    // A writer leaves a file that another one has locked just now; the next run removes it.
    CHECK(write_file(f.folder / "x", "last", f.console).ok());
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry :
         std::filesystem::directory_iterator(f.folder.path())) {
        ++count;
    }
    CHECK(count == 1);
}

TEST_CASE("a temporary file that is a link or a pipe is left") {
    PosixFixture f;
    write_text(f.folder / "precious", "text");
    REQUIRE(::symlink("precious", (f.folder / "x.lsys-0.tmp").c_str()) == 0);
    REQUIRE(::mkfifo((f.folder / "x.lsys-1.tmp").c_str(), 0600) == 0);
    CHECK(write_file(f.folder / "x", "first", f.console).ok());
    CHECK(std::filesystem::is_symlink(f.folder / "x.lsys-0.tmp"));
    CHECK(std::filesystem::is_fifo(f.folder / "x.lsys-1.tmp"));
    CHECK(read_text(f.folder / "precious") == "text");
    CHECK(read_text(f.folder / "x") == "first");
}

TEST_CASE("a file that must be new replaces no dangling link") {
    PosixFixture f;
    REQUIRE(::symlink("nowhere", (f.folder / "link").c_str()) == 0);
    CHECK(Output::create(f.folder / "link", f.console).error().message ==
          "cannot write `" + f.folder / "link" + "`: file exists");
}

TEST_CASE("a replaced file keeps its permissions, and a link stays a link") {
    PosixFixture f;
    write_text(f.folder / "x", "first");
    REQUIRE(::chmod((f.folder / "x").c_str(), 0640) == 0);
    REQUIRE(::symlink("x", (f.folder / "link").c_str()) == 0);
    CHECK(write_file(f.folder / "link", "second", f.console).ok());
    CHECK(read_text(f.folder / "x") == "second");
    CHECK(std::filesystem::is_symlink(f.folder / "link"));
    struct stat facts {};
    REQUIRE(::stat((f.folder / "x").c_str(), &facts) == 0);
    CHECK((facts.st_mode & 0777U) == 0640);
    // Writing other bytes must remove the setuid bit.
    REQUIRE(::chmod((f.folder / "x").c_str(), 04755) == 0);
    CHECK(write_file(f.folder / "x", "third", f.console).ok());
    REQUIRE(::stat((f.folder / "x").c_str(), &facts) == 0);
    CHECK((facts.st_mode & 07777U) == 0755);
    const mode_t mask = ::umask(022);
    CHECK(write_file(f.folder / "new", "", f.console).ok());
    ::umask(mask);
    REQUIRE(::stat((f.folder / "new").c_str(), &facts) == 0);
    CHECK((facts.st_mode & 0777U) == 0644);
}

TEST_CASE("writing never changes the umask of other threads") {
    PosixFixture f;
    const mode_t mask = ::umask(022);
    std::atomic<bool> ends{false};
    std::atomic<int> wrong{0};
    std::thread other([&] {
        const std::string name = f.folder / "other";
        while (!ends) {
            const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0666);
            struct stat facts {};
            wrong += ::fstat(descriptor, &facts) == 0 && (facts.st_mode & 0777U) == 0644 ? 0 : 1;
            ::close(descriptor);
            ::unlink(name.c_str());
        }
    });
    for (int i = 0; i < 5000; ++i) {
        REQUIRE(write_file(f.folder / "x", "", f.console).ok());
    }
    ends = true;
    other.join();
    ::umask(mask);
    CHECK(wrong == 0);
}
