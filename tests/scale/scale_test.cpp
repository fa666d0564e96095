// SPDX-License-Identifier: MIT
// Runs `lsc` as a child on one extreme input and checks how it ends. Usage: scale_test LSC CASE
// FOLDER.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dirent.h>
#include <fcntl.h>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace {

constexpr long kMaxKib = 2L * 1024 * 1024; // 2 GiB
#ifdef LSYS_INSTRUMENTED
constexpr bool kInstrumented = true;
#else
constexpr bool kInstrumented = false;
#endif
// The slowest case takes about 7 s on a quiet machine; only a hang or a quadratic algorithm takes
// ten times as long.
constexpr double kMaxSeconds = 60.0;
// With sanitizers, runs take about three times as long; most runs still stay within the limit.
// Twice the limit suffices for the slower runs, also on a busy machine.
constexpr double kInstrumentedFactor = 2.0;

struct ProcessResult {
    int status = -1; // exit status, or -signal
    long peak_kib = 0;
    double seconds = 0.0; // processor time, which other processes do not lengthen
    std::string errors;   // standard error
};

double seconds_of(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

ProcessResult
run(const std::vector<std::string>& command, const std::string& folder, const char* out) {
    const std::string error_path = folder + "/stderr." + std::to_string(getpid());
    std::vector<char*> arguments;
    for (const std::string& argument : command) {
        arguments.push_back(const_cast<char*>(argument.c_str()));
    }
    arguments.push_back(nullptr);
    ProcessResult result;
    const pid_t child = fork();
    if (child == 0) {
        const int out_file = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const int error_file = open(error_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        dup2(out_file, 1);
        dup2(error_file, 2);
        execv(arguments[0], arguments.data());
        _exit(127);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    result.seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    result.peak_kib = usage.ru_maxrss;
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    std::ifstream errors(error_path, std::ios::binary);
    result.errors.assign(std::istreambuf_iterator<char>(errors), std::istreambuf_iterator<char>());
    unlink(error_path.c_str());
    return result;
}

/// Writes `before`, then `unit` `count` times, then `after`.
void write_repeated(const std::string& path,
                    const std::string& before,
                    const std::string& unit,
                    std::uint64_t count,
                    const std::string& after) {
    std::ofstream file(path, std::ios::binary);
    file << before;
    std::string block;
    while (block.size() < 1'000'000 && block.size() / unit.size() < count) {
        block += unit;
    }
    const std::uint64_t units = block.size() / unit.size();
    for (; count >= units; count -= units) {
        file << block;
    }
    for (; count > 0; --count) {
        file << unit;
    }
    file << after;
}

/// Writes `before`, then line(i) for i from 0 to `count` - 1.
void write_lines(const std::string& path,
                 const std::string& before,
                 std::uint64_t count,
                 const std::function<std::string(std::uint64_t)>& line) {
    std::ofstream file(path, std::ios::binary);
    file << before;
    for (std::uint64_t i = 0; i < count; ++i) {
        file << line(i);
    }
}

struct Case {
    std::function<void(const std::string& path)> make;
    std::vector<std::string> command; // % stands for the file
    int status = 0;
    std::string message; // must occur in standard error; may be empty
    const char* out = "/dev/null";
    std::string stray{}; // must occur in the command line of no process afterwards; empty: no check
    double max_seconds = kMaxSeconds; // processor time
    long max_kib = kMaxKib;           // peak of memory
};

/// Writes a flat grid of `side` * `side` squares, 1 m wide, around the origin.
void write_grid(const std::string& path, std::uint64_t side) {
    const std::uint64_t corners = side + 1;
    const auto place = [side](std::uint64_t i) {
        return std::to_string(static_cast<std::int64_t>(i) - static_cast<std::int64_t>(side / 2));
    };
    write_lines(path, "", corners * corners, [&](std::uint64_t i) {
        return "v " + place(i % corners) + " 0 " + place(i / corners) + "\n";
    });
    std::ofstream file(path, std::ios::app | std::ios::binary);
    for (std::uint64_t row = 0; row < side; ++row) {
        std::string faces;
        for (std::uint64_t column = 0; column < side; ++column) {
            const std::uint64_t corner = row * corners + column + 1;
            faces += "f " + std::to_string(corner) + ' ' + std::to_string(corner + corners) + ' ' +
                     std::to_string(corner + corners + 1) + ' ' + std::to_string(corner + 1) + '\n';
        }
        file << faces;
    }
}

/// A condition of `count` comparisons with different numbers.
std::string long_condition(const std::string& before, const std::string& after, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
        text += (i == 0 ? "" : after) + before + std::to_string(i);
    }
    return text;
}

/// Small grammars made to use much time or to read what they must not: each ends within two seconds
/// of processor time or at a limit.
void add_hostile_cases(std::map<std::string, Case>& all) {
    const auto text = [](const std::string& grammar) {
        return [=](const std::string& path) { write_repeated(path, grammar, " ", 1, ""); };
    };
    const auto add = [&](const char* name, const std::string& grammar,
                         const std::vector<std::string>& command, int status,
                         const std::string& message) {
        Case& added = all[std::string("hostile-") + name];
        added = {text(grammar), command, status, message};
        added.max_seconds = 2.5;
    };
    constexpr int kTerms = 30'000;
    const std::string head = "#n = 1;\n#w : A(1);\n#p : A(x) : ";
    const std::vector<std::string> check{"check", "%"};
    add("and", head + long_condition("x > -", " && ", kTerms) + " : A(x + 1);\n", check, 0, "");
    add("or", head + long_condition("x == ", " || ", kTerms) + " : A(x + 1);\n", check, 0, "");
    add("houdini-condition", "A(1)\nA(x):" + long_condition("x>-", "&", kTerms) + "=A(x+1)\n",
        {"check", "--dialect", "houdini", "-n", "1", "%"}, 0, "");
    std::string modules;
    for (int i = 0; i < 10'000; ++i) {
        modules += "A ";
    }
    add("context", "#n = 1;\n#w : " + modules + modules + ";\n#p : " + modules + "< A : * : B;\n",
        {"dump", "--count", "%"}, 0, "");
    const std::vector<std::string> one_second{"dump", "--count", "--max-time", "1", "%"};
    const std::string late = "the limit of `--max-time`";
    add("endless", "#n = 4294967294;\n#w : A;\n#p : A : * : A;\n", {"dump", "--max-time", "1", "%"},
        3, late);
    add("decompose",
        "#set decompose_depth 100000;\n#set at_depth stop;\n#n = 2;\n#w : A A A A;\n"
        "#decompose d : A : * : B A;\n",
        one_second, 3, late);
    add("interpret",
        "#n = 1;\n#set interpret_depth 100000;\n#set at_depth stop;\n#w : A(1);\n"
        "#interpret d : A(x) : * : F(1) A(x+1) A(x+2);\n",
        {"export", "--max-time", "1", "%", "-o", "/dev/null", "--format", "stl"}, 3, late);
    add("device", "#n = 0;\n#w : Q;\n#object Q \"/dev/zero\";\n",
        {"export", "--untrusted", "%", "-o", "/dev/null", "--format", "stl"}, 1, "only files in");
    add("trace", "#n = 1;\n#w : F(1);\n#p : F(x) : * : F(x+1);\n",
        {"trace", "--max-memory", "20M", "-n", "20000", "--at", "0", "--back", "%", "-o",
         "/dev/null"},
        0, "");
    all["hostile-trace"].max_kib = 100 * 1024;
    add("include-device", "#n = 0;\n#w : Q;\n#include \"/dev/zero\";\n",
        {"check", "--untrusted", "%"}, 1, "only files in");
}

/// Plants that sense: enormous meshes, tiny cells, many markers, programs that misbehave.
void add_sensing_cases(std::map<std::string, Case>& all) {
    constexpr std::uint64_t kSide = 2237; // 10,008,338 triangles
    const std::vector<std::string> count{"dump", "--count", "%"};
    const auto text = [](std::string grammar) {
        return [=](const std::string& path) {
            write_repeated(path, "#n = 0;\n" + grammar, " ", 1, "");
        };
    };
    const auto with_grid = [](std::string before, std::string after) {
        return [=](const std::string& path) {
            write_grid(path + ".obj", kSide);
            const std::string name = path.substr(path.rfind('/') + 1) + ".obj";
            write_repeated(path, "#n = 0;\n" + before + '"' + name + '"' + after, " ", 1, "");
        };
    };
    all["sense-mesh-10m-triangles"] = {
        with_grid("#sense s solid mesh ", ";\n#w : f(10) ?s(0, 0, 0, 0) f(3) ?s(0);"), count, 0,
        ""};
    all["sense-shape-10m-triangles"] = {
        with_grid("#sense s space shape ", " count 1000 radius 1 kill 0.1;\n#w : ?s(0);"), count, 1,
        "not closed"};
    all["sense-cell-1e-9"] = {text("#sense s shadow cell 1e-9;\n#w : ?s(0) f(10) ?s(0);"), count, 1,
                              "sense-failed"};
    all["sense-sky-cell-1e-9"] = {
        text("#object L LEAF;\n#sense s sky cell 1e-9;\n#w : L ?s(0) f(10) L ?s(0);"), count, 1,
        "sense-failed"};
    all["sense-shadow-many-voxels"] = {[](const std::string& path) {
                                           write_repeated(
                                               path, "#n = 0;\n#sense s shadow cell 0.001;\n#w : ",
                                               "f(1)+(77)&(3)?s(0,0,0,0)", 300'000, ";");
                                       },
                                       count, 0, ""};
    all["sense-sky-billion-voxels"] = {
        text("#object L LEAF;\n#sense s sky cell 1;\n"
             "#w : [f(1000) L][+(90) f(1000) L][&(90) f(1000) L ?s(0)] L ?s(0);"),
        count, 0, ""};
    all["sense-many-markers"] = {
        text("#sense s space shape box size 10 10 10 count 67108864 radius 1 kill 0.1;\n"
             "#w : ?s(0);"),
        {"dump", "--count", "--max-memory", "500M", "%"},
        3,
        "memory"};
    const auto program = [&](const std::string& commands, const std::string& message) {
        Case made{text("#sense s program;\n#w : ?s(0) ?s(0);"),
                  {"dump", "%", "--environment", "s=" + commands},
                  1,
                  message};
        return made;
    };
    all["sense-program-hangs"] = program("read q; sleep 7654321", "not answered in 60 seconds");
    all["sense-program-hangs"].stray = "7654321";
    all["sense-program-dies"] = program("read q; kill -9 $$", "signal 9");
    all["sense-program-1gb"] =
        program("read q; head -c 1000000000 /dev/zero; sleep 8765432", "sent a line of more than");
    all["sense-program-1gb"].stray = "8765432";
    all["sense-program-1gb-of-messages"] =
        program("read q; head -c 1000000000 /dev/zero >&2; exit 3", "exit status 3");
    all["sense-program-too-few"] =
        program("read q; echo '{\"answers\": [[1]]}'", "1 answer to 2 questions");
    all["sense-program-nan"] =
        program("read q; echo '{\"answers\": [[1], [NaN]]}'", "sense-failed");
}

/// Whether a process has `text` in its command line. Linux; elsewhere there is no /proc.
bool is_running(const std::string& text) {
    DIR* const processes = opendir("/proc");
    bool is_found = false;
    for (const dirent* each = processes == nullptr ? nullptr : readdir(processes); each != nullptr;
         each = readdir(processes)) {
        std::ifstream file(std::string("/proc/") + each->d_name + "/cmdline", std::ios::binary);
        const std::string command{std::istreambuf_iterator<char>(file),
                                  std::istreambuf_iterator<char>()};
        is_found = is_found || command.find(text) != std::string::npos;
    }
    if (processes != nullptr) {
        closedir(processes);
    }
    return is_found;
}

std::map<std::string, Case> cases() {
    const auto repeated = [](std::string before, std::string unit, std::uint64_t count,
                             std::string after) {
        return [=](const std::string& path) { write_repeated(path, before, unit, count, after); };
    };
    const std::vector<std::string> check{"check", "%"};
    const std::vector<std::string> count{"dump", "--count", "%"};
    std::map<std::string, Case> all;
    const std::string head = "#n = 1;\n";
    all["nested-parentheses"] = {repeated(head + "#w : F(", "(", 100'000, "1;"), check, 1, "nest"};
    all["nested-brackets"] = {repeated(head + "#w : F", "[", 100'000, "F;"), check, 1, "nest"};
    all["nested-ranges"] = {repeated(head + "#w : F(", "{1,", 100'000, "1;"), check, 1, "nest"};
    all["unary-chain"] = {repeated(head + "#w : F(", "-", 1'000'000, "1);"), check, 1, "nest"};
    all["power-chain"] = {repeated(head + "#w : F(1", "^1", 1'000'000, ");"), check, 1, "nest"};
    all["sum-chain"] = {repeated(head + "#w : F(1", "+1", 1'000'000, ");"), count, 0, ""};
    all["axiom-100mb"] = {repeated(head + "#w : ", "F+", 50'000'000, ";"), count, 0, ""};
    all["arguments-100mb"] = {repeated(head + "#w : ", "F(1)", 25'000'000, ";"), count, 0, ""};
    all["comment-100mb"] = {repeated(head + "#w : F; /*", "no\n", 33'000'000, "*/"), count, 0, ""};
    all["statements-100mb"] = {repeated(head + "#w : F;\n", "#ignore : + -;\n", 6'600'000, ""),
                               check, 0, ""};
    all["garbage-100mb"] = {repeated("", "a?(;=}", 16'600'000, ""), check, 1, "error"};
    all["zeros-100mb"] = {repeated("", std::string(1, '\0'), 100'000'000, ""), check, 1, "error"};
    all["names-100mb"] = {repeated(head + "#set names letters;\n#w : ", "FGFG", 25'000'000, ";"),
                          count, 0, ""};
    all["line-10mb"] = {repeated(head + "#w : F ?", " F + F", 1'700'000, " ?;"), check, 1,
                        "unknown-character"};
    all["identifier-10mb"] = {repeated(head + "#w : F ", "a", 10'000'000, ";"), count, 0, ""};
    all["number-10mb"] = {repeated(head + "#w : F(0.", "1", 10'000'000, ");"), count, 0, ""};
    all["nul-bytes"] = {repeated(head + "#w : F", std::string("\0F", 2), 1000, ";"), check, 1,
                        "this file is binary data"};
    all["few-nul-bytes"] = {
        repeated(head + "#w : F", std::string("\0F", 2) + std::string(38, 'F'), 100'000, ";"),
        check, 1, "unknown-character"};
    all["invalid-utf8"] = {repeated(head + "#w : F", "\xFF\xC0 F", 100'000, ";"), check, 1,
                           "invalid-utf8"};
    all["strays-10mb"] = {repeated(head + "#w : F;\n#p : ", "1 = ", 2'500'000, ": * : F : ;"),
                          check, 1, "a number is not a module"};
    all["typographic-3mb"] = {repeated(head + "#w : F", "\xE2\x88\x92 \xC3\xA9", 500'000, ";"),
                              check, 1, "look-alike"};
    all["unclosed-comment"] = {repeated(head + "#w : F; /*", "x", 10'000'000, ""), check, 1,
                               "unclosed-comment"};
    all["unclosed-quote"] = {repeated(head + "#w : F; #object F \"", "x", 10'000'000, ""), check, 1,
                             "unclosed-quote"};
    all["million-productions"] = {
        [head](const std::string& path) {
            write_lines(path, head + "#w : A0 A999999;\n", 1'000'000, [](std::uint64_t i) {
                return "#p" + std::to_string(i) + " : A" + std::to_string(i) + " : * : A" +
                       std::to_string((i + 1) % 1'000'000) + " F;\n";
            });
        },
        count, 0, ""};
    all["million-alternatives"] = {
        [head](const std::string& path) {
            write_lines(path, head + "#set weights any;\n#w : A(1);\n", 1'000'000,
                        [](std::uint64_t i) {
                            return "#p" + std::to_string(i) +
                                   " : A(x) : x == " + std::to_string(i) + " ~ 1 : A(x + 1) F;\n";
                        });
        },
        count, 0, ""};
    all["million-defines"] = {
        [head](const std::string& path) {
            write_lines(path, head + "#define c0 1;\n", 1'000'000, [](std::uint64_t i) {
                return "#define c" + std::to_string(i + 1) + " c" + std::to_string(i) + " + 1;\n";
            });
            std::ofstream(path, std::ios::app) << "#w : F(c1000000);\n";
        },
        count, 0, ""};
    all["million-errors"] = {repeated(head + "#w : F;\n", "#p : F : * : F(q);\n", 1'000'000, ""),
                             check, 1, "more error"};
    all["directory"] = {[](const std::string& path) { mkdir(path.c_str(), 0700); }, check, 2,
                        "directory"};
    all["missing-file"] = {[](const std::string&) {}, check, 2, "no such file"};
    all["unreadable-output"] = {repeated(head + "#w : F", "F", 3, ";"),
                                {"dump", "%", "-o", "/nowhere/at/all"},
                                2,
                                "/nowhere/at/all"};
    all["full-disk"] = {repeated(head + "#w : F;", " ", 3, "#p : F : * : F F F;"),
                        {"dump", "%", "-n", "12"},
                        2,
                        "no space left",
                        "/dev/full"};
    const std::vector<std::string> format{"fmt", "--check", "%"};
    const std::string not_formatted = "not formatted";
    all["format-arguments-100mb"] = {repeated(head + "#w : ", "F(1)", 25'000'000, ";"), format, 1,
                                     not_formatted};
    all["format-statements-100mb"] = {
        repeated(head + "#w : F;\n", "#ignore:+ -;// c\n", 5'800'000, ""), format, 1,
        not_formatted};
    all["format-brackets"] = {
        repeated(head, "#p : F : * : " + std::string(5000, '[') + std::string(5000, ']') + ";\n",
                 100, ""),
        format, 1, not_formatted};
    all["format-condition-10mb"] = {
        repeated(head + "#w : F;\n#p : F(x) : x > 1", "&& x > 2 ", 1'100'000, ": F(x);"), format, 1,
        not_formatted};
    // Longer than the prefix in which recognise_non_text() looks for binary data, 4096 bytes.
    const std::string text(5000, ' ');
    const std::vector<std::string> carey{"check", "--dialect", "carey", "%"};
    all["carey-line-10mb"] = {repeated("generations: 1\naxiom: F\nF=", "F+[&F]", 1'700'000, "\n"),
                              carey, 0, ""};
    all["carey-zeros-10mb"] = {repeated("axiom: F" + text, std::string(1, '\0'), 10'000'000, ""),
                               carey, 1, "foreign-syntax"};
    all["carey-garbage-10mb"] = {repeated("axiom: F\n", "a=(\xFF(:@\n:", 1'000'000, ""), carey, 1,
                                 "foreign-syntax"};
    const std::vector<std::string> l3d{"check", "--dialect", "l3d", "%"};
    all["l3d-line-10mb"] = {repeated("1\n30\n20\nA\nA=", "F+(20) [`A]", 1'000'000, "\n@\n"), l3d, 0,
                            ""};
    all["l3d-blanks-10mb"] = {repeated("1\n30\n20\nFA\nA=F", "     (", 1'700'000, "\n@\n"), l3d, 0,
                              "foreign-quirk"};
    all["l3d-zeros-10mb"] = {repeated("1\n30\n20\nF" + text, std::string(1, '\0'), 10'000'000, ""),
                             l3d, 1, "foreign-syntax"};
    all["l3d-rules"] = {[](const std::string& path) {
                            write_lines(path, "1\n30\n20\nF\n", 200'000, [](std::uint64_t i) {
                                return "A" + std::to_string(i) + "=F\n";
                            });
                            std::ofstream(path, std::ios::app) << "@\n";
                        },
                        l3d, 0, ""};
    const std::vector<std::string> fractint{"check", "--dialect", "fractint", "-n", "1", "%"};
    all["fractint-line-10mb"] = {
        repeated("A { angle 4\n axiom f\n f=", "f+[-@.5F]", 1'100'000, "\n}\n"), fractint, 0, ""};
    all["fractint-systems-10mb"] = {[](const std::string& path) {
                                        write_lines(path, "", 250'000, [](std::uint64_t i) {
                                            return "s" + std::to_string(i) +
                                                   " { angle 4\n axiom f\n f=f+f\n}\n";
                                        });
                                    },
                                    fractint, 1, "which-system"};
    all["fractint-zeros-10mb"] = {repeated("A {" + text, std::string(1, '\0'), 10'000'000, ""),
                                  fractint, 1, "foreign-syntax"};
    all["fractint-garbage-10mb"] = {repeated("A { axiom f\n", "=x=\xFF(@q\n:", 1'000'000, "}"),
                                    fractint, 1, "foreign-syntax"};
    const std::vector<std::string> houdini{"check", "--dialect", "houdini", "-n", "1", "%"};
    all["houdini-line-10mb"] = {repeated("F\nF=", "F+[&(1)F]", 1'100'000, "\n"), houdini, 0, ""};
    all["houdini-sum-10mb"] = {repeated("A(1)\nA(x)=F(", "x + ", 2'500'000, "1)\n"), houdini, 0,
                               ""};
    all["houdini-parentheses-10mb"] = {repeated("A(1)\nA(x)=F(", "(", 10'000'000, "\n"), houdini, 1,
                                       "foreign-syntax"};
    all["houdini-zeros-10mb"] = {repeated("F" + text, std::string(1, '\0'), 10'000'000, ""),
                                 houdini, 1, "foreign-syntax"};
    all["houdini-garbage-10mb"] = {repeated("A\n", "A=(\xFF:@\n:", 1'000'000, ""), houdini, 1,
                                   "foreign-syntax"};
    all["nested-word"] = {
        repeated("#n = 5000;\n#w : A;\n#p : A : * : [A];\n#q : F < A : * : A;\n", " ", 1, ""),
        {"dump", "--count", "%"},
        0,
        ""};
    add_sensing_cases(all);
    add_hostile_cases(all);
    return all;
}

} // namespace

int main(int argc, char** argv) {
    const auto all = cases();
    if (argc != 4 || !all.contains(argv[2])) {
        std::fprintf(stderr, "usage: scale_test LSC CASE FOLDER\n");
        return 2;
    }
    const Case& wanted = all.at(argv[2]);
    const std::string folder = argv[3];
    const std::string path = folder + "/" + argv[2] + ".lsys";
    wanted.make(path);
    std::vector<std::string> command{argv[1]};
    for (const std::string& word : wanted.command) {
        command.push_back(word == "%" ? path : word);
    }
    const ProcessResult result = run(command, folder, wanted.out);
    if (rmdir(path.c_str()) != 0) {
        unlink(path.c_str());
    }
    unlink((path + ".obj").c_str());
    std::printf("%s: status %d, %.2f s, peak %ld MiB\n%.600s\n", argv[2], result.status,
                result.seconds, result.peak_kib / 1024, result.errors.c_str());
    bool fine = true;
    const auto expect = [&](bool holds, const char* what) {
        if (!holds) {
            std::printf("FAILED: %s\n", what);
            fine = false;
        }
    };
    expect(result.status == wanted.status, "exit status");
    expect(result.errors.find(wanted.message) != std::string::npos, wanted.message.c_str());
    expect(kInstrumented || result.peak_kib <= wanted.max_kib, "peak memory");
    expect(wanted.stray.empty() || !is_running(wanted.stray), "a process is left");
    expect(result.seconds <= wanted.max_seconds * (kInstrumented ? kInstrumentedFactor : 1.0),
           "time");
    return fine ? 0 : 1;
}
