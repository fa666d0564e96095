// SPDX-License-Identifier: MIT
#include "grammar/base/paths.h"
#include "runtime/program/files.h"
#include "runtime/program/run_files.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace lsys;
using lsys::tests::read_text;
using lsys::tests::ScratchFolder;
using lsys::tests::write_text;

namespace {

constexpr std::uint64_t kMany = std::uint64_t{1} << 40;

struct Fixture {
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    ScratchFolder folder;
    Console console{{in, out, err}, {}};

    std::size_t file_count() const {
        std::size_t count = 0;
        for ([[maybe_unused]] const auto& entry :
             std::filesystem::directory_iterator(folder.path())) {
            ++count;
        }
        return count;
    }
};

} // namespace

TEST_CASE("files with any bytes are read completely") {
    Fixture f;
    std::string bytes("a\0b\xFF", 4);
    for (const std::size_t size : {0U, 4U, 1U << 20U, (3U << 20U) + 1U}) {
        bytes.resize(size, 'x');
        write_text(f.folder / "x", bytes);
        const Result<std::string> read = read_file(f.folder / "x", {kMany}, f.console);
        REQUIRE(read.ok());
        CHECK(read.value() == bytes);
    }
}

TEST_CASE("the message about an unreadable file has the reason") {
    Fixture f;
    CHECK(read_file(f.folder / "none", {kMany}, f.console).error().message ==
          "cannot read `" + f.folder / "none" + "`: no such file or directory");
    CHECK(read_file(f.folder.path().string(), {kMany}, f.console).error().message ==
          "cannot read `" + f.folder.path().string() + "`: it is a directory");
    write_text(f.folder / "large", "12345");
    CHECK(read_file(f.folder / "large", {4}, f.console).error().message ==
          "cannot read `" + f.folder / "large" + "`: it is larger than 4 bytes, the maximum");
    CHECK(read_file(f.folder / "large", {5}, f.console).value() == "12345");
}

TEST_CASE("standard input has the name -") {
    Fixture f;
    f.in.str(std::string(3'000'000, 'x'));
    CHECK(read_file("-", {kMany}, f.console).value().size() == 3'000'000);
    Fixture too_long;
    too_long.in.str("12345");
    CHECK(!read_file("-", {4}, too_long.console).ok());
}

TEST_CASE("a written file appears only when it is complete") {
    Fixture f;
    {
        Result<Output> output = Output::open(f.folder / "x", f.console);
        REQUIRE(output.ok());
        CHECK(output.value().write("first").ok());
        CHECK(!std::filesystem::exists(f.folder / "x"));
    }
    CHECK(f.file_count() == 0); // the file was not committed
    CHECK(write_file(f.folder / "x", "first", f.console).ok());
    {
        Result<Output> output = Output::open(f.folder / "x", f.console);
        REQUIRE(output.ok());
        CHECK(output.value().write("second").ok());
        CHECK(read_text(f.folder / "x") == "first");
        CHECK(output.value().commit().ok());
    }
    CHECK(read_text(f.folder / "x") == "second");
    CHECK(f.file_count() == 1);
}

TEST_CASE("temporary files of ended processes are removed by the next run") {
    Fixture f;
    Result<Output> sibling = Output::open(f.folder / "x", f.console); // as if of another process
    REQUIRE(sibling.ok());
    REQUIRE(sibling.value().write("sibling").ok());
    REQUIRE(sibling.value().finish().ok()); // closed, and without its name yet
    CHECK(std::filesystem::exists(f.folder / "x.lsys-0.tmp"));
    for (const char* const left : {"x.lsys-1.tmp", "x.lsys-3.tmp"}) {
        write_text(f.folder / left, "incomplete");
    }
    std::filesystem::create_directory(path_of(f.folder / "x.lsys-2.tmp"));
    write_text(f.folder / "x.backup", "of the user");
    write_text(f.folder / "y.lsys-0.tmp", "of another output");
    CHECK(write_file(f.folder / "x", "first", f.console).ok());
    CHECK(f.file_count() == 5); // x, the file of the sibling, the folder and the last two
    CHECK(read_text(f.folder / "x") == "first");
    CHECK(sibling.value().commit().ok());
    CHECK(read_text(f.folder / "x") == "sibling");
    CHECK(f.file_count() == 4);
}

TEST_CASE("files with names of 255 bytes can be written and replaced") {
    Fixture f;
    const std::string letters(239, 'a');
    std::vector<std::string> names{letters + std::string(16, 'b'), std::string(250, 'c')};
    std::string accented = "d";
    while (accented.size() < 255) {
        accented += "\u00E9"; // two bytes
    }
    names.push_back(accented);
    for (const std::string& name : names) {
        REQUIRE(name.size() <= 255);
        CHECK(write_file(f.folder / name, "first", f.console).ok());
        CHECK(write_file(f.folder / name, "second", f.console).ok());
        CHECK(read_text(f.folder / name) == "second");
    }
    CHECK(f.file_count() == names.size());
    // Two names that differ only behind the part that temporary names keep.
    Result<Output> first = Output::open(f.folder / names[0], f.console);
    const std::string other = letters + std::string(16, 'e');
    Result<Output> second = Output::open(f.folder / other, f.console);
    REQUIRE(first.ok());
    REQUIRE(second.ok());
    CHECK(first.value().write("of the first").ok());
    CHECK(second.value().write("of the second").ok());
    CHECK(first.value().commit().ok());
    CHECK(second.value().commit().ok());
    CHECK(read_text(f.folder / names[0]) == "of the first");
    CHECK(read_text(f.folder / other) == "of the second");
    CHECK(f.file_count() == names.size() + 1);
}

TEST_CASE("a file is recognised as written by a relative path, too") {
    Fixture f;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(f.folder.path());
    RunFiles files;
    CHECK(files.begin_write("new").empty());
    write_text("new", "first");
    CHECK_FALSE(files.begin_write("new").empty());
    CHECK_FALSE(files.begin_write(f.folder / "new").empty());
    std::filesystem::current_path(before);
}

TEST_CASE("any number of writers may write one file at once") {
    Fixture f;
    std::vector<Output> writers;
    for (int i = 0; i < 12; ++i) {
        Result<Output> output = Output::open(f.folder / "x", f.console);
        REQUIRE(output.ok());
        REQUIRE(output.value().write(std::to_string(i)).ok());
        writers.push_back(std::move(output.value()));
    }
    for (Output& writer : writers) {
        CHECK(writer.commit().ok());
    }
    CHECK(read_text(f.folder / "x") == "11");
    CHECK(f.file_count() == 1);
}

TEST_CASE("a file that must be new replaces no other") {
    Fixture f;
    write_text(f.folder / "old", "first");
    CHECK(Output::create(f.folder / "old", f.console).error().message ==
          "cannot write `" + f.folder / "old" + "`: file exists");
    Result<Output> late = Output::create(f.folder / "late", f.console);
    REQUIRE(late.ok());
    write_text(f.folder / "late", "first"); // as if by another program
    CHECK(late.value().commit().error().message ==
          "cannot write `" + f.folder / "late" + "`: file exists");
    CHECK(read_text(f.folder / "late") == "first");
    Result<Output> output = Output::create(f.folder / "new", f.console);
    REQUIRE(output.ok());
    CHECK(output.value().write("text").ok());
    CHECK(output.value().commit().ok());
    CHECK(read_text(f.folder / "new") == "text");
}

TEST_CASE("files that belong together appear together") {
    Fixture f;
    write_text(f.folder / "old", "first");
    std::vector<Output> outputs;
    for (const char* name : {"new", "old", "-"}) {
        Result<Output> output = Output::open(name[0] == '-' ? name : f.folder / name, f.console);
        REQUIRE(output.ok());
        CHECK(output.value().write("second").ok());
        outputs.push_back(std::move(output.value()));
    }
    CHECK(read_text(f.folder / "old") == "first");
    CHECK(commit_all(outputs).ok());
    CHECK(read_text(f.folder / "new") == "second");
    CHECK(read_text(f.folder / "old") == "second");
    CHECK(f.out.str() == "second");
    CHECK(f.file_count() == 2);
}

TEST_CASE("if one of several files that belong together cannot be written, none appears") {
    Fixture f;
    write_text(f.folder / "old", "first");
    std::vector<Output> outputs;
    for (const char* name : {"new", "old", "last"}) {
        Result<Output> output = Output::open(f.folder / name, f.console);
        REQUIRE(output.ok());
        CHECK(output.value().write("second").ok());
        outputs.push_back(std::move(output.value()));
    }
    std::filesystem::create_directory(f.folder / "last"); // as if by another program
    CHECK(commit_all(outputs).error().message ==
          "cannot write `" + f.folder / "last" + "`: is a directory");
    outputs.clear();
    CHECK(read_text(f.folder / "old") == "first");
    CHECK(f.file_count() == 2); // `old` and the directory
}

TEST_CASE("the message about an unwritable file has the reason, and no file is left") {
    Fixture f;
    CHECK(write_file(f.folder / "none/x", "text", f.console).error().message ==
          "cannot write `" + f.folder / "none/x" + "`: no such file or directory");
    CHECK(write_file(f.folder.path().string(), "text", f.console).error().message ==
          "cannot write `" + f.folder.path().string() + "`: is a directory");
    CHECK(f.file_count() == 0);
}

TEST_CASE("standard output that fails is an error") {
    Fixture f;
    CHECK(write_file("-", "text", f.console).ok());
    CHECK(f.out.str() == "text");
    f.out.setstate(std::ios::badbit);
    CHECK(write_file("-", "text", f.console)
              .error()
              .message.starts_with("cannot write standard output"));
}

TEST_CASE("names of files are UTF-8") {
    Fixture f;
    const std::filesystem::path file = u8"\u00E4hre \u9EA6.lsys"; // German and Chinese words
    const std::string name = f.folder / path_text(file);
    CHECK(write_file(name, "text", f.console).ok());
    CHECK(f.file_count() == 1);
    CHECK(read_file(name, {kMany}, f.console).value() == "text");
    CHECK(std::filesystem::exists(f.folder.path() / file));
}

TEST_CASE("lines keep their ends") {
    Fixture f;
    const std::string text = "one\ntwo\r\nthree\x1A four\n";
    CHECK(write_file(f.folder / "x", text, f.console).ok());
    CHECK(read_text(f.folder / "x") == text);
    CHECK(read_file(f.folder / "x", {kMany}, f.console).value() == text);
}
