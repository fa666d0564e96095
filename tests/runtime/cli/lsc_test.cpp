// SPDX-License-Identifier: MIT
// Behaviour of lsc that golden cases cannot test: interrupts, terminals, failing streams, exhausted
// memory.
#include "runtime/cli/command_line.h"
#include "runtime/cli/lsc.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <new>
#include <sstream>
#include <streambuf>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <variant>
#include <vector>

namespace {

using lsys::tests::LscRun;
using lsys::tests::read_text;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;
using lsys::tests::write_text;

constexpr const char* kEndless = "#n = 4000000000; #w : F; #p : F : * : F;";
constexpr const char* kWrong = "#n = 1; #w : F(x);";

int run(const std::vector<std::string>& arguments, const lsys::Io& io) {
    return lsys::lsc::run(arguments, io);
}

/// A stream whose reads run out of memory.
class NoMemory : public std::streambuf {
protected:
    int_type underflow() override { throw std::bad_alloc(); }
    std::streamsize xsgetn(char*, std::streamsize) override { throw std::bad_alloc(); }
};

} // namespace

TEST_CASE("an interrupted run ends with status 130 and leaves no file") {
    const ScratchFolder folder;
    const std::atomic<bool> interrupted{true};
    for (const std::vector<std::string>& options : {std::vector<std::string>{"dump", "-"},
                                                    {"dump", "-", "--stream"},
                                                    {"dump", "-", "-o", folder / "word"},
                                                    {"dump", "-", "--all", "--count"},
                                                    {"dump", "-", "--save-state", folder / "state"},
                                                    {"check", "--fix", "-"},
                                                    {"compile", "-", "-o", folder / "x.lsb"}}) {
        std::istringstream in(kEndless);
        std::ostringstream out;
        std::ostringstream err;
        CHECK(run(options, {in, out, err, false, &interrupted}) == 130);
        CHECK(out.str().empty());
        CHECK(err.str().ends_with("lsc: interrupted\n"));
    }
    CHECK(folder.file_count() == 0);
}

TEST_CASE("no output replaces an input or another output") {
    const ScratchFolder folder;
    const std::string grammar = folder / "a.lsys";
    const std::string part = folder / "part.lsys";
    const std::string picture = folder / "a.bark.png";
    const std::string text = "#include \"part.lsys\";\n#material 0 colour 1 0 0 picture "
                             "\"a.bark.png\";\n#n = 1; #w : F;\n";
    write_text(grammar, text);
    write_text(part, "#define c 1;\n");
    std::filesystem::copy_file(
        std::filesystem::path(LSYS_SOURCE_DIR) / "samples/scenes/park/lawn.png", picture);
    const std::string bytes = read_text(picture);
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{"dump", grammar, "-o", grammar},
          {"dump", grammar, "-o", part},
          {"dump", grammar, "--save-state", grammar, "--steps", "1"},
          {"dump", grammar, "-o",
           folder / "." + "/../" + folder.path().filename().string() + "/a.lsys"},
          {"compile", grammar, "-o", grammar},
          {"compile", grammar, "-o", picture},
          {"dump", grammar, "-o", picture},
          {"export", grammar, "-o", grammar, "--format", "stl"},
          {"export", grammar, "-o", folder / "a.obj"}}) {
        INFO(options[0] << ' ' << options[3]);
        const LscRun refused = run_lsc(options, "");
        CHECK(refused.status == 2);
        CHECK(refused.err.find("it is an input of this command") != std::string::npos);
        CHECK(read_text(grammar) == text);
        CHECK(read_text(part) == "#define c 1;\n");
        CHECK(read_text(picture) == bytes);
    }
    // These commands do not read the picture, but must not replace it either.
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"dump", grammar, "--stage", "tokens", "-o", picture},
             {"dump", grammar, "--stage", "ast", "-o", picture},
             {"dump", grammar, "--stage", "tokens", "-o", part}}) {
        const LscRun refused = run_lsc(command, "");
        CHECK(refused.status == 2);
        CHECK(refused.err.find("it is an input of this command") != std::string::npos);
        CHECK(read_text(picture) == bytes);
        CHECK(read_text(part) == "#define c 1;\n");
    }
    write_text(grammar, text + "#p : A : * : F(;\n"); // with a mistake
    CHECK(run_lsc({"dump", grammar, "--stage", "tokens", "-o", picture}, "").status == 2);
    write_text(grammar, text);
    CHECK(folder.file_count() == 3);
    for (const char* const name : {"birch.l", "birch.v", "birch.rgb"}) {
        std::filesystem::copy_file(std::filesystem::path(LSYS_SOURCE_DIR) /
                                       "samples/dialects/cpfg" / name,
                                   folder.path() / name);
    }
    const std::string leaf = read_text(folder / "birch.rgb");
    const LscRun imported = run_lsc({"import", folder / "birch.l", "-o", folder / "birch.rgb"}, "");
    CHECK(imported.status == 2);
    CHECK(imported.err.find("it is an input of this command") != std::string::npos);
    CHECK(read_text(folder / "birch.rgb") == leaf);
    const std::string both = folder / "both";
    const LscRun twice =
        run_lsc({"dump", grammar, "--steps", "1", "--save-state", both, "-o", both}, "");
    CHECK(twice.status == 2);
    CHECK(twice.err.find("it is another output of this command") != std::string::npos);
}

TEST_CASE("messages about options name the range, and what is wrong") {
    const auto has = [](std::initializer_list<const char*> arguments, std::string_view message) {
        const LscRun run = run_lsc({arguments.begin(), arguments.end()}, "");
        CAPTURE(run.err);
        CHECK(run.status == 2);
        CHECK(run.err.find(message) != std::string::npos);
    };
    has({"forest", "a.lsys", "-o", "a.glb", "--tile", "2147483647,1,100"},
        "`2147483647,1,100` is not column,row,size: two whole numbers from -1000000 to 1000000 and "
        "metres up to 1e+06");
    has({"tiles", "a.lsys", "-o", "a", "--part", "1/99999999999"},
        "is not I/N, with I from 1 to N and N up to 1000000");
    has({"dump", "a.lsys", "-n", "1", "-n", "2"},
        "--generations is given 2 times, and may be given once");
    has({"check", "--diff", "a.lsys"}, "--diff requires --fix");
    has({"export", "--", "-a.lsys", "-o", "a.glb"}, "behind `--` stand names of files only");
}

TEST_CASE("a file name is no part of an imported grammar") {
    const ScratchFolder folder;
    const std::string path = folder / "a\n#w : X;.sys";
    write_text(path, "LSYSTEM\n1\nF\nF F[>F]F 1\n");
    const LscRun imported = run_lsc({"import", path}, "");
    CHECK(imported.status == 0);
    CHECK(imported.out.starts_with("// Imported from `a?#w : X;.sys`"));
    CHECK(run_lsc({"check", "-"}, imported.out).status == 0);
}

TEST_CASE("an error of standard output ends with status 2") {
    for (const std::vector<std::string>& options : {std::vector<std::string>{"dump", "-"},
                                                    {"dump", "-", "--all"},
                                                    {"dump", "-", "--count"},
                                                    {"dump", "-", "--stream"},
                                                    {"dump", "-", "--stage", "bytecode"},
                                                    {"stats", "-"},
                                                    {"explain"},
                                                    {"explain", "look-alike"},
                                                    {"--help"},
                                                    {"--version"},
                                                    {"compile", "-", "-o", "-"}}) {
        INFO(options.back());
        std::istringstream in("#n = 1; #w : F;");
        std::ostringstream out;
        std::ostringstream err;
        out.setstate(std::ios::badbit);
        CHECK(run(options, {in, out, err}) == 2);
        CHECK(err.str().find("cannot write standard output") != std::string::npos);
    }
}

TEST_CASE("the option --version --verbose tells how the program was built") {
    const auto version = [](const std::vector<std::string>& arguments) {
        std::istringstream in;
        std::ostringstream out;
        std::ostringstream err;
        lsys::Io io{in, out, err};
        io.revision = "0123abcd of 2026-01-31";
        CHECK(run(arguments, io) == 0);
        CHECK(err.str().empty());
        return out.str();
    };
    const std::string text = version({"--version", "--verbose"});
    INFO(text);
    CHECK(text.starts_with(version({"--version"})));
    for (const char* const row : {"\ncommit        0123abcd of 2026-01-31\n", "\ncompiler      ",
                                  "\nC++ library   ", "\nprocessor     ", "\nthreads       "}) {
        CHECK(text.find(row) != std::string::npos);
    }
    for (const char* const library :
         {"CLI11", "fmt", "GLM", "libpng", "meshoptimizer", "nlohmann-json", "stb_image",
          "stb_perlin", "toml++", "utf8proc", "zlib"}) {
        const std::size_t at = text.find(library + std::string(" "));
        REQUIRE(at != std::string::npos);
        const char digit = text[at + std::string(library).size() + 1];
        INFO(library);
        CHECK((digit >= '0' && digit <= '9'));
    }
    CHECK(version({"-v", "--version"}) == text);
    CHECK(version({"dump", "--version", "-v"}) == text);
}

TEST_CASE("running out of memory ends like a limit, without a crash") {
    NoMemory nothing;
    std::istream in(&nothing);
    in.exceptions(std::ios::badbit);
    std::ostringstream out;
    std::ostringstream err;
    CHECK(run({"check", "-"}, {in, out, err}) == 3);
    CHECK(err.str() == "lsc: error: out of memory\n");
}

TEST_CASE("colour follows the terminal, the option and NO_COLOR") {
    const auto is_coloured = [](bool terminal, const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"check", "-"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        std::istringstream in(kWrong);
        std::ostringstream out;
        std::ostringstream err;
        CHECK(run(arguments, {in, out, err, terminal}) == 1);
        return err.str().find('\x1b') != std::string::npos;
    };
    ::unsetenv("NO_COLOR");
    CHECK(is_coloured(true, {}));
    CHECK(!is_coloured(false, {}));
    CHECK(is_coloured(false, {"--color", "always"}));
    CHECK(!is_coloured(true, {"--color", "never"}));
    CHECK(!is_coloured(true, {"--message-format", "json"}));
    ::setenv("NO_COLOR", "1", 1);
    CHECK(!is_coloured(true, {}));
    CHECK(is_coloured(true, {"--color", "always"}));
    ::unsetenv("NO_COLOR");
}

TEST_CASE("a limit or an error does not change an earlier output file") {
    const ScratchFolder folder;
    write_text(folder / "word", "before");
    const std::string grows = "#n = 9; #w : F; #p : F : * : F F;";
    const std::string fails = "#n = 3; #w : A(1); #p : A(x) : * : A(x - 1) F(1 / x);";
    for (const char* option : {"--all", "--stream", "--count"}) {
        CHECK(lsys::tests::run_lsc(
                  {"dump", "-", option, "-o", folder / "word", "--max-modules", "100"}, grows)
                  .status == 3);
        CHECK(lsys::tests::run_lsc({"dump", "-", option, "-o", folder / "word"}, fails).status ==
              1);
    }
    CHECK(read_text(folder / "word") == "before");
    CHECK(folder.file_count() == 1);
}

TEST_CASE("check --fix writes the file once and as a whole") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 1\n#w : F(3 \u2212 1);\n#include \"b.lsys\";\n");
    write_text(folder / "b.lsys", "#p : F(x) : * : F(x \u2212 1)\n");
    const lsys::tests::LscRun fixed =
        lsys::tests::run_lsc({"check", "--fix", folder / "a.lsys"}, "");
    CHECK(fixed.status == 0);
    CHECK(fixed.err.find("fixed: ") != std::string::npos);
    CHECK(read_text(folder / "a.lsys") == "#n = 1;\n#w : F(3 - 1);\n#include \"b.lsys\";\n");
    CHECK(read_text(folder / "b.lsys") == "#p : F(x) : * : F(x - 1);\n");
    CHECK(folder.file_count() == 2);
    const lsys::tests::LscRun again = lsys::tests::run_lsc({"check", folder / "a.lsys"}, "");
    CHECK(again.status == 0);
    CHECK(again.err == "");
}

TEST_CASE("check --fix does not change included files outside the folder of the grammar") {
    const ScratchFolder folder;
    const auto wrong = [](const std::string& name) {
        return "#" + std::filesystem::path(name).stem().string() + " : F(x) : * : F(x \u2212 1)\n";
    };
    const auto right = [](const std::string& name) {
        return "#" + std::filesystem::path(name).stem().string() + " : F(x) : * : F(x - 1);\n";
    };
    std::filesystem::create_directories(folder / "home/parts");
    std::filesystem::create_directories(folder / "homely");
    write_text(folder / "home/a.lsys", "#n = 1;\n#w : F(3);\n#include \"parts/below.lsys\";\n"
                                       "#include \"../homely/outside.lsys\";\n"
                                       "#include \"../home/parts/../around.lsys\";\n"
                                       "#include \"parts/link.lsys\";\n#include \"" +
                                           folder / "absolute.lsys" + "\";\n");
    for (const char* name : {"home/parts/below.lsys", "home/around.lsys", "homely/outside.lsys",
                             "target.lsys", "absolute.lsys"}) {
        write_text(folder / name, wrong(name));
    }
    std::filesystem::create_symlink(folder / "target.lsys", folder / "home/parts/link.lsys");
    std::filesystem::create_symlink(folder / "home", folder / "way");

    const auto fix = [&](const std::vector<std::string>& files) {
        std::vector<std::string> arguments{"check", "--fix", "--message-format", "short"};
        arguments.insert(arguments.end(), files.begin(), files.end());
        return lsys::tests::run_lsc(arguments, "");
    };
    const lsys::tests::LscRun fixed = fix({folder / "way/a.lsys"});
    CHECK(fixed.status == 1);
    CHECK(read_text(folder / "home/parts/below.lsys") == right("below"));
    CHECK(read_text(folder / "home/around.lsys") == right("around"));
    for (const char* name : {"homely/outside.lsys", "target.lsys", "absolute.lsys"}) {
        CHECK(read_text(folder / name) == wrong(name));
    }
    for (const char* name :
         {"way/../homely/outside.lsys", "way/parts/link.lsys", "absolute.lsys"}) {
        const std::string path = folder / name;
        CHECK(fixed.err.find("lsc: `" + path +
                             "` is left as it is: it lies outside the folder of `" +
                             folder / "way/a.lsys" + "`\n") != std::string::npos);
        CHECK(fixed.err.find(path + ":1:") != std::string::npos); // its diagnostics are shown
    }
    // A file named on the command line is written, wherever it lies.
    CHECK(fix({folder / "home/a.lsys", folder / "absolute.lsys"}).status == 1);
    CHECK(read_text(folder / "absolute.lsys") == right("absolute"));
    CHECK(read_text(folder / "target.lsys") == wrong("target"));
}

TEST_CASE("check --fix writes all files of a grammar or none") {
    const ScratchFolder folder;
    std::filesystem::create_directories(folder / "closed");
    const std::string first = "#n = 1\n#w : F(3);\n#include \"closed/b.lsys\";\n";
    const std::string second = "#p : F(x) : * : F(x \u2212 1)\n";
    write_text(folder / "a.lsys", first);
    write_text(folder / "closed/b.lsys", second);
    write_text(folder / "err", "");
    for (const char* name : {"", "a.lsys", "closed", "closed/b.lsys", "err"}) {
        REQUIRE(::chmod((folder / name).c_str(), 0777) == 0);
    }
    REQUIRE(::chmod((folder / "closed/b.lsys").c_str(), 0444) == 0);
    const pid_t process = ::fork();
    if (process == 0) { // run as another user, since root ignores permissions
        std::istringstream in;
        std::ostringstream out;
        std::ofstream err(folder / "err");
        const int nobody = 65534;
        const bool is_bound = ::geteuid() != 0 || (::setgid(nobody) == 0 && ::setuid(nobody) == 0);
        const int status =
            is_bound ? run({"check", "--fix", folder / "a.lsys"}, {in, out, err}) : 99;
        err.close();
        ::_exit(status);
    }
    int status = 0;
    REQUIRE(::waitpid(process, &status, 0) == process);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 2);
    CHECK(read_text(folder / "err") ==
          "lsc: error: cannot write `" + folder / "closed/b.lsys" + "`: permission denied\n" +
              "lsc: help: `" + folder / "a.lsys" +
              "` and the files that it includes are as they were: either all of them are written "
              "or none\n");
    CHECK(read_text(folder / "a.lsys") == first);
    CHECK(read_text(folder / "closed/b.lsys") == second);
    CHECK(folder.file_count() == 3);
}

TEST_CASE("check of files without options means the same as with the end of options") {
    for (const std::vector<std::string>& files :
         {std::vector<std::string>{"a.lsys"}, {"a.lsys", "-", "check"}}) {
        std::vector<std::string> plain{"check"};
        plain.insert(plain.end(), files.begin(), files.end());
        std::vector<std::string> full{"check", "--"};
        full.insert(full.end(), files.begin(), files.end());
        const lsys::lsc::CommandLine without = lsys::lsc::parse_command_line(plain);
        const lsys::lsc::CommandLine with = lsys::lsc::parse_command_line(full);
        REQUIRE(std::holds_alternative<lsys::lsc::CheckCommand>(without));
        CHECK(std::get<lsys::lsc::CheckCommand>(without) ==
              std::get<lsys::lsc::CheckCommand>(with));
    }
}
