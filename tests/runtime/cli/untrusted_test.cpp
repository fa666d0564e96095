// SPDX-License-Identifier: MIT
// `--untrusted`: files that grammars and scenes name. Links, pipes and devices, so not on Windows.
#include "runtime/platform/beneath.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace {

namespace fs = std::filesystem;

using lsys::tests::LscRun;
using lsys::tests::read_text;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;
using lsys::tests::write_text;

constexpr const char* kSecret = "root:x:0:0:secret\n";
constexpr const char* kLeaf = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A folder `home` with the grammars, and a file `secret` and a folder `other` beside it.
struct Site {
    ScratchFolder folder;

    Site() {
        fs::create_directories(folder.path() / "home/parts");
        fs::create_directories(folder.path() / "other");
        write_text(folder / "secret", kSecret);
        write_text(folder / "other/leaf.obj", kLeaf);
        write_text(folder / "other/part.lsys", "#w : F;\n");
        write_text(folder / "home/parts/part.lsys", "#w : F;\n");
        write_text(folder / "home/parts/leaf.obj", kLeaf);
        link("parts/part.lsys", "inside");
        link("../secret", "out");
        link(folder / "secret", "absolute");
        link("..", "up");
        link("/dev/zero", "zero");
        link("loop", "loop");
        REQUIRE(::mkfifo((folder / "home/pipe").c_str(), 0600) == 0);
    }
    void link(const std::string& target, const std::string& name) const {
        REQUIRE(::symlink(target.c_str(), (folder / ("home/" + name)).c_str()) == 0);
    }
    [[nodiscard]] std::string add(const std::string& name, const std::string& text) const {
        write_text(folder / ("home/" + name), text);
        return folder / ("home/" + name);
    }
};

/// Whether standard error or standard output shows a line of the secret file.
bool tells_secret(const LscRun& run) {
    return (run.out + run.err).find("root:x") != std::string::npos;
}

} // namespace

TEST_CASE("open_beneath opens only regular files below a folder") {
    const Site site;
    using lsys::platform::kOutside;
    const auto open = [&](const std::string& name) {
        lsys::platform::File file;
        const lsys::platform::Reason reason =
            lsys::platform::open_beneath(site.folder / "home", name, file);
        CHECK(file.is_open() == (reason == 0));
        return reason;
    };
    for (const char* const name : {"inside", "parts/part.lsys", "./parts//part.lsys",
                                   "parts/../parts/part.lsys", "parts/../inside"}) {
        INFO(name);
        CHECK(open(name) == 0);
    }
    for (const char* const name :
         {"../secret", "../home/inside", "/etc/passwd", "out", "absolute", "up/secret",
          "up/home/inside", "zero", "parts/../../secret", "..", "missing/../../secret"}) {
        INFO(name);
        CHECK((open(name) == kOutside || open(name) == ENOENT));
    }
    CHECK(open("pipe") == EINVAL);
    CHECK(open("loop") == ELOOP);
    CHECK(open("parts") == EISDIR);
    CHECK(open("inside/x") == ENOTDIR);
    CHECK(open("missing") == ENOENT);
    CHECK(lsys::platform::list_beneath(site.folder / "home", "parts", 10).size() == 2);
    CHECK(lsys::platform::list_beneath(site.folder / "home", "up", 10).empty());
}

TEST_CASE("an untrusted grammar includes files of its folder only") {
    const Site site;
    for (const char* const path : {"parts/part.lsys", "inside"}) {
        const std::string file =
            site.add("good.lsys", std::string("#n = 1;\n#include \"") + path + "\";\n");
        INFO(path);
        CHECK(run_lsc({"dump", file, "--untrusted"}, "").out == "F\n");
    }
    for (const std::string path : {"../secret", "out", "absolute", "up/secret", "zero", "pipe",
                                   "/etc/passwd", "/dev/null", "../other/part.lsys"}) {
        const std::string file =
            site.add("bad.lsys", "#n = 1;\n#include \"" + path + "\";\n#w : F;\n");
        INFO(path);
        const LscRun run = run_lsc({"check", file, "--untrusted"}, "");
        CHECK(run.status == 1);
        CHECK((run.err.find("only files in") != std::string::npos ||
               run.err.find("not a regular file") != std::string::npos));
        CHECK(!tells_secret(run));
    }
    const std::string fixed = site.add("fixed.lsys", "#n = 1;\n#include \"../secret\";\n#w : F;\n");
    CHECK(run_lsc({"check", "--fix", "--untrusted", fixed}, "").status == 1);
    CHECK(read_text(site.folder / "secret") == kSecret);
}

TEST_CASE("links that change during a run lead nowhere") {
    const Site site;
    const std::string home = site.folder / "home";
    std::atomic<bool> ends{false};
    // A name that is a file, a link out and a folder in turn, in a folder that is a link in turn.
    std::thread changer([&] {
        const std::string name = home + "/parts/swap";
        const std::string folder = home + "/turn";
        while (!ends) {
            static_cast<void>(::symlink("../../secret", name.c_str()));
            static_cast<void>(::symlink("..", folder.c_str()));
            ::unlink(name.c_str());
            ::unlink(folder.c_str());
            write_text(name, "#w : F;\n");
            ::mkdir(folder.c_str(), 0700);
            ::unlink(name.c_str());
            ::rmdir(folder.c_str());
        }
    });
    std::size_t opened = 0;
    bool is_secret = false;
    for (int i = 0; i < 20'000; ++i) {
        for (const char* const path : {"parts/swap", "turn/secret"}) {
            lsys::platform::File file;
            std::array<char, 64> bytes{};
            if (lsys::platform::open_beneath(home, path, file) == 0) {
                ++opened;
                const auto read = lsys::platform::read_some(file, bytes.data(), bytes.size());
                is_secret = is_secret || std::string(bytes.data(), read.count) == kSecret;
            }
        }
    }
    ends = true;
    changer.join();
    CHECK(!is_secret);
    INFO(opened);
}

TEST_CASE("a compiled grammar contains no folder of the machine") {
    const Site site;
    const std::string file = site.add("a.lsys", "#n = 1;\n#include \"parts/part.lsys\";\n");
    const std::string output = site.folder / "other/a.lsb";
    REQUIRE(run_lsc({"compile", file, "-o", output}, "").status == 0);
    const std::string bytes = read_text(output);
    CHECK(bytes.find(site.folder.path().string()) == std::string::npos);
    CHECK(bytes.find("parts/part.lsys") != std::string::npos);
    CHECK(run_lsc({"dump", output}, "").out == "F\n");
}

TEST_CASE("a run waits for no pipe that a scene names") {
    const Site site;
    const auto checked = [&](const std::string& text) {
        return run_lsc({"forest", site.add("a.toml", text), "-o", site.folder / "a.json"}, "");
    };
    const std::string species = "[[species]]\ngrammar = \"parts/part.lsys\"\n";
    const std::string refusal = "it is not a regular file";
    CHECK(checked("[[species]]\ngrammar = \"pipe\"\ndialect = \"lsys\"\n").err.find(refusal) !=
          std::string::npos);
    CHECK(checked("[terrain]\nkind = \"height-map\"\nmap = \"pipe\"\nsize = 100\n" + species)
              .err.find(refusal) != std::string::npos);
}

TEST_CASE("the answer is the same whether an outside file exists") {
    const Site site;
    const auto answer = [&](const std::string& path) {
        const std::string file =
            site.add("a.lsys", "#n = 1;\n#include \"" + path + "\";\n#w : F;\n");
        std::string err =
            run_lsc({"check", file, "--untrusted", "--message-format", "short"}, "").err;
        for (std::size_t at = err.find(path); at != std::string::npos; at = err.find(path)) {
            err.replace(at, path.size(), "X");
        }
        return err;
    };
    CHECK(answer("../secret") == answer("../absent"));
    CHECK(answer("up/secret") == answer("up/absent"));
    CHECK(answer("/etc/passwd") == answer("/etc/absent/file"));
}

TEST_CASE("meshes, pictures, maps and views of an untrusted grammar lie in its folder") {
    const Site site;
    write_text(site.folder / "home/lib.obj", std::string("mtllib ../secret\n") + kLeaf);
    write_text(site.folder / "home/map.obj", std::string("mtllib map.mtl\nvt 0 0\nusemtl m\n") +
                                                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/1 3/1\n");
    write_text(site.folder / "home/map.mtl", "newmtl m\nmap_Kd ../secret\n");
    const auto exported = [&](const std::string& statements) {
        const std::string file = site.add("a.lsys", "#n = 1;\n#w : F Q;\n" + statements);
        return run_lsc({"export", file, "--untrusted", "-o", site.folder / "a.glb"}, "");
    };
    CHECK(exported("#object Q \"parts/leaf.obj\";\n").status == 0);
    for (const char* const path : {"../other/leaf.obj", "/etc/passwd", "out", "zero", "pipe"}) {
        INFO(path);
        const LscRun run = exported(std::string("#object Q \"") + path + "\";\n");
        CHECK(run.status != 0);
        CHECK((run.err.find("only files in") != std::string::npos ||
               run.err.find("not a regular file") != std::string::npos));
        CHECK(!tells_secret(run));
    }
    for (const char* const path : {"lib.obj", "map.obj"}) {
        INFO(path);
        const LscRun run = exported(std::string("#object Q \"") + path + "\";\n");
        CHECK(run.err.find("only files in") != std::string::npos);
        CHECK(!tells_secret(run));
    }
    const LscRun material = exported("#object Q \"parts/leaf.obj\";\n"
                                     "#material 1 colour 1 1 1 picture \"../secret\";\n");
    CHECK(material.err.find("only files in") != std::string::npos);
    const std::string sensing = site.add(
        "s.lsys",
        "#n = 1;\n#sense M map size 1 1 file \"../secret\";\n#w : A ?M(0);\n#p : A : * : F;\n");
    CHECK(!tells_secret(run_lsc({"dump", sensing, "--untrusted"}, "")));
    CHECK(run_lsc({"dump", sensing, "--untrusted"}, "").status != 0);
}

TEST_CASE("an untrusted scene names files of its folder only, or of --root") {
    const Site site;
    write_text(site.folder / "other/tree.lsys", "#n = 1;\n#w : F;\n");
    const auto checked = [&](const std::string& grammar, std::vector<std::string> options) {
        const std::string file =
            site.add("a.toml", "[[species]]\ngrammar = \"" + grammar + "\"\ndialect = \"lsys\"\n");
        options.insert(options.begin(), {"forest", file, "--check", "--untrusted"});
        return run_lsc(options, "");
    };
    for (const char* const path :
         {"../other/tree.lsys", "../secret", "out", "/etc/passwd", "pipe"}) {
        INFO(path);
        const LscRun run = checked(path, {});
        CHECK(run.status == 2);
        CHECK((run.err.find("only files in") != std::string::npos ||
               run.err.find("not a regular file") != std::string::npos));
        CHECK(!tells_secret(run));
    }
    CHECK(checked("../other/tree.lsys", {"--root", site.folder.path().string()}).status == 0);
    CHECK(run_lsc({"forest", site.folder / "home/a.toml", "--check", "--root", "."}, "").status ==
          2);
}

TEST_CASE("lsc serve does not trust its scene, unless an option says so") {
    const Site site;
    const std::string scene =
        site.add("a.toml", "[[species]]\ngrammar = \"../other/absent.lsys\"\n"
                           "[placement]\nmethod = \"jittered\"\nspacing = 5\n");
    const auto served = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"serve", scene, "--listen", "0"});
        return run_lsc(options, "").err;
    };
    // A server that trusts its scene looks for the grammar.
    const std::string next = "no such file";
    CHECK(served({}).find("only files in") != std::string::npos);
    CHECK(served({"--trusted"}).find(next) != std::string::npos);
    CHECK(served({"--root", site.folder.path().string()}).find(next) != std::string::npos);
    CHECK(run_lsc({"serve", scene, "--trusted", "--untrusted"}, "").status == 2);
}

TEST_CASE("an untrusted grammar from standard input reads no file") {
    const Site site;
    const std::string text = "#n = 1;\n#include \"inside\";\n";
    const std::string home = site.folder / "home";
    CHECK(run_lsc({"dump", "-", "--untrusted"}, text).status == 1);
    CHECK(run_lsc({"dump", "-", "--untrusted", "--base", home}, text).out == "F\n");
    CHECK(run_lsc({"dump", "-", "--untrusted", "--root", home, "--base", home}, text).out == "F\n");
}

TEST_CASE("an untrusted grammar starts no program") {
    const Site site;
    const std::string file =
        site.add("a.lsys", "#n = 1;\n#sense E program;\n#w : A ?E(0);\n#p : A : * : F;\n");
    CHECK(run_lsc({"dump", file, "--untrusted"}, "").status != 0);
    const LscRun run = run_lsc({"dump", file, "--untrusted", "--environment", "E=touch x"}, "");
    CHECK(run.status == 2);
    CHECK(run.err.find("--environment starts a program") != std::string::npos);
}

TEST_CASE("an untrusted grammar includes a bounded number of files") {
    const Site site;
    std::string text = "#n = 1;\n#w : F;\n";
    for (int i = 0; i <= 1000; ++i) {
        write_text(site.folder / ("home/parts/" + std::to_string(i)), "// a part\n");
        text += "#include \"parts/" + std::to_string(i) + "\";\n";
    }
    const std::string file = site.add("a.lsys", text);
    CHECK(run_lsc({"check", file}, "").status == 0);
    const LscRun run = run_lsc({"check", file, "--untrusted"}, "");
    CHECK(run.status == 3);
    CHECK(run.err.find("more than 1000 files are included") != std::string::npos);
}

TEST_CASE("the limit --max-output bounds all files and standard output, and leaves no file") {
    const Site site;
    const std::string file = site.add("a.lsys", "#n = 10;\n#w : F;\n#p : F : * : F [+ F] F;\n");
    const LscRun run =
        run_lsc({"export", file, "--max-output", "10K", "-o", site.folder / "other/a.obj"}, "");
    CHECK(run.status == 3);
    CHECK(run.err.find("the limit of `--max-output`") != std::string::npos);
    CHECK(!fs::exists(site.folder.path() / "other/a.obj"));
    CHECK(!fs::exists(site.folder.path() / "other/a.mtl"));
    CHECK(fs::exists(site.folder.path() / "other/leaf.obj"));
    const LscRun word = run_lsc({"dump", file, "--max-output", "1K"}, "");
    CHECK(word.status == 3);
    CHECK(word.out.size() <= 1024);
    CHECK(run_lsc({"dump", file, "--max-output", "10M"}, "").status == 0);
}

TEST_CASE("the limit --max-time ends a run with status 3") {
    const Site site;
    const std::string endless = "#n = 4294967294;\n#w : A;\n#p : A : * : A;\n";
    const std::string deep = "#set decompose_depth 100000;\n#set at_depth stop;\n#n = 2;\n"
                             "#w : A A A A;\n#decompose d : A : * : B A;\n";
    for (const std::string& text : {endless, deep}) {
        const LscRun run = run_lsc({"dump", site.add("a.lsys", text), "--max-time", "0.2"}, "");
        CHECK(run.status == 3);
        CHECK(run.err.find("longer than 0.2 s, the limit of `--max-time`") != std::string::npos);
    }
    CHECK(run_lsc({"dump", site.add("b.lsys", "#n = 1;\n#w : F;\n"), "--max-time", "60"}, "").out ==
          "F\n");
}
