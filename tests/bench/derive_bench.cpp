// SPDX-License-Identifier: MIT
// Compares derivation with hand-written programs for the same systems (tests/bench/limits.h), and
// measures whole runs of `lsc`, in one run on one machine. Prints two tables, and with
// --benchmark_out=FILE writes the JSON of Google Benchmark. Asserts nothing about time.
//
// "cold" is the first derivation of a process, whose memory comes fresh from the system. "warm" is
// a second derivation, which reuses the memory of the first.
#include "runtime/derive/derive.h"
#include "runtime/derive/fold_reached.h"
#include "tests/bench/limits.h"
#include "tests/bench/measure.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <utility>
#include <vector>

namespace {

using lsys::bench::compile_text;
using lsys::bench::fail;
using lsys::bench::FreshPages;
using lsys::bench::median;
using lsys::bench::PageSize;
using lsys::bench::seconds;

/// Derives into the code buffers `a` and `b` and the parameter buffers; returns a number other
/// than 0.
using LimitProgram = std::function<std::size_t(const FreshPages& a,
                                               const FreshPages& b,
                                               const FreshPages& parameters_a,
                                               const FreshPages& parameters_b)>;

struct Workload {
    const char* name;
    std::string grammar;
    std::uint32_t generations;
    std::size_t capacity; // number of modules for which the buffers have room
    LimitProgram limit;   // the hand-written program
};

/// Systems W1 to W6 and W8; W3 and W5 also with local values and if(). W7 twice: with one draw for
/// both parameters, as a local value, and with one draw for each parameter.
std::vector<Workload> workloads() {
    using namespace lsys::bench;
    using Pages = const FreshPages&;
    std::vector<Workload> all;
    const auto plain = [](PlainSystem system, int generations) {
        return [=](Pages a, Pages b, Pages, Pages) {
            return derive_plain(system, generations, a.as<std::uint8_t>(), b.as<std::uint8_t>());
        };
    };
    all.push_back({"W1/n=9", "#set names letters; #n = 9; #w : F; #p : F : * : F+F-F-F+F;", 9,
                   3'906'249, plain(koch_w1(), 9)});
    all.push_back({"W2/n=9",
                   "#set names letters; #n = 9; #w : X; #p : X : * : F-[[X]+X]+F[+FX]-X;"
                   "#q : F : * : FF;",
                   9, 1'615'783, plain(weed_w2(), 9)});
    all.push_back({"W3/n=11",
                   "#n = 11; #w : !(1.4)F(2)/(45)A; #p : A : * : !(1.4)F(2)[&(22.5)F(2)A]/(112.5)"
                   "[&(22.5)F(2)A]/(157.5)[&(22.5)F(2)A]; #q : F(l) : * : F(l*1.1);"
                   "#r : !(w) : * : !(w*1.4);",
                   11, 1'594'318, [](Pages a, Pages b, Pages c, Pages d) {
                       return derive_w3(11, a.as<std::uint8_t>(), b.as<std::uint8_t>(),
                                        c.as<float>(), d.as<float>());
                   }});
    all.push_back({"W4/n=10",
                   "#set names letters; #n = 10; #w : F; #p : F : ~ 0.33 : F[+F]F[-F]F;"
                   "#q : F : ~ 0.33 : F[+F]F; #r : F : ~ 0.34 : F[-F]F;",
                   10, std::size_t{16} << 20, [](Pages a, Pages b, Pages, Pages) {
                       return derive_w4(10, a.as<std::uint8_t>(), b.as<std::uint8_t>());
                   }});
    all.push_back({"W5/n=13",
                   "#n = 13; #w : A(12); #p : A(x) : x > 0 : F(1)[+(30)A(x-1)][-(30)A(x-1)]A(x-1);"
                   "#q : A(x) : x <= 0 : F(1);",
                   13, 2'391'481, [](Pages a, Pages b, Pages c, Pages d) {
                       return derive_w5(13, a.as<std::uint8_t>(), b.as<std::uint8_t>(),
                                        c.as<float>(), d.as<float>());
                   }});
    std::string axiom = "b";
    for (int i = 0; i < 100'000; ++i) {
        axiom += "a";
    }
    all.push_back(
        {"W6/n=200",
         "#set names letters; #n = 200; #w : " + axiom + "; #p : b < a : * : b; #q : b : * : a;",
         200, 100'002, [](Pages a, Pages b, Pages, Pages) {
             return derive_w6(200, 100'001, a.as<std::uint8_t>(), b.as<std::uint8_t>());
         }});
    std::string swept = "A(0)";
    for (int i = 0; i < 100'000; ++i) {
        swept += "A(0)";
    }
    all.push_back({"W8/n=200",
                   "#n = 200; #w : " + swept +
                       "; #down d : A(x) > A(y) : * : A(y+1); #up u : A(y) < A(x) : * : A(y-1);",
                   200, 100'002, [](Pages, Pages, Pages c, Pages) {
                       return derive_w8(200, 100'001, c.as<float>());
                   }});
    all.push_back({"W3-let/n=11",
                   "#n = 11; #w : !(1.4)F(2)/(45)A; #p : A : * : let l = 2, a = 22.5 :"
                   "!(1.4)F(l)[&(a)F(l)A]/(112.5)[&(a)F(l)A]/(157.5)[&(a)F(l)A];"
                   "#q : F(l) : * : let m = if(l > 0, l*1.1, 0) : F(m);"
                   "#r : !(w) : * : let v = w*1.4 : !(v);",
                   11, 1'594'318, all[2].limit});
    all.push_back({"W5-let/n=13",
                   "#n = 13; #w : A(12); #p : A(x) : if(x > 0, 1, 0) :"
                   "let y = if(x > 0, x - 1, 0), a = 30 : F(1)[+(a)A(y)][-(a)A(y)]A(y);"
                   "#q : A(x) : if(x > 0, 0, 1) : F(1);",
                   13, 2'391'481, all[4].limit});
    constexpr int kDoublings = 21;
    constexpr std::size_t kFirst = 5; // modules of the axiom
    const std::string random_axiom = "#n = 21; #w : A(1)A(1)A(1)A(1)A(1); #p : A(x) : * : ";
    const auto random = [](bool shared) {
        return [=](Pages a, Pages b, Pages c, Pages d) {
            return derive_w7(kDoublings, kFirst, shared, a.as<std::uint8_t>(), b.as<std::uint8_t>(),
                             c.as<float>(), d.as<float>());
        };
    };
    all.push_back({"W7-let/n=21", random_axiom + "let r = {0.5, 1} : A(x * r) A(x * r);",
                   kDoublings, kFirst << kDoublings, random(true)});
    all.push_back({"W7/n=21", random_axiom + "A(x * {0.5, 1}) A(x * {0.5, 1});", kDoublings,
                   kFirst << kDoublings, random(false)});
    return all;
}

/// Peak memory of this process so far, in bytes.
double peak_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024.0;
}

/// Measured values of one derivation in a process of its own.
struct Run {
    double seconds = 0.0;
    double modules = 0.0;
    double bytes = 0.0; // size of the word
    double peak = 0.0;  // bytes that the derivation added to the peak of the process
};

void derive(lsys::Derivation& derivation, std::uint32_t generations) {
    if (derivation.start() || derivation.run_to(generations)) {
        fail("a workload does not derive");
    }
}

lsys::DeriveOptions options_for(const Workload& workload, std::uint32_t threads) {
    lsys::DeriveOptions options;
    options.generations = workload.generations;
    options.threads = threads;
    return options;
}

/// Folds modules, as `lsc` does before a derivation. Measured as a part of the derivation.
lsys::Bytecode folded(const lsys::Bytecode& bytecode, const Workload& workload) {
    return lsys::fold_reached(bytecode, 0, workload.generations).value_or(bytecode);
}

/// `derive_bench --child WORKLOAD THREADS`: derives once and prints the values of Run.
int derive_as_child(const std::string& name, const std::string& threads) {
    for (const Workload& workload : workloads()) {
        if (workload.name != name) {
            continue;
        }
        const lsys::Bytecode bytecode = compile_text(workload.grammar);
        const double before = peak_bytes();
        lsys::Bytecode program;
        std::optional<lsys::Derivation> derivation;
        const double spent = seconds([&] {
            program = folded(bytecode, workload);
            derivation.emplace(
                program, options_for(workload, static_cast<std::uint32_t>(std::stoul(threads))));
            derive(*derivation, workload.generations);
        });
        const lsys::Word& word = derivation->word();
        fmt::print("{} {} {} {}\n", spent, word.module_count(), word.byte_count(),
                   peak_bytes() - before);
        return 0;
    }
    return 2;
}

std::string output_of(const std::string& command) {
    std::FILE* const pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) {
        fail("cannot run " + command);
    }
    std::string text;
    std::array<char, 256> part{};
    while (std::fgets(part.data(), part.size(), pipe) != nullptr) {
        text += part.data();
    }
    if (pclose(pipe) != 0) {
        fail(command + " failed");
    }
    return text;
}

Run run_child(const std::string& self, const Workload& workload, std::uint32_t threads) {
    const std::string text =
        output_of(fmt::format("'{}' --child {} {}", self, workload.name, threads));
    Run run;
    if (std::sscanf(text.c_str(), "%lf %lf %lf %lf", &run.seconds, &run.modules, &run.bytes,
                    &run.peak) != 4) {
        fail("a child said: " + text);
    }
    return run;
}

void add(const std::string& name, std::function<void(benchmark::State&)> body) {
    benchmark::RegisterBenchmark(name.c_str(),
                                 [body = std::move(body)](benchmark::State& state) {
                                     for (auto _ : state) {
                                         body(state);
                                     }
                                 })
        ->UseManualTime()
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
}

void add_limit(const Workload& workload, const std::string& kind, PageSize pages, bool warm) {
    add(fmt::format("{}/limit {}", workload.name, kind), [=](benchmark::State& state) {
        const std::size_t codes = workload.capacity + 64;
        const std::size_t parameters = 4 * workload.capacity + 256;
        const FreshPages a(codes, pages);
        const FreshPages b(codes, pages);
        const FreshPages c(parameters, pages);
        const FreshPages d(parameters, pages);
        const auto work = [&] { benchmark::DoNotOptimize(workload.limit(a, b, c, d)); };
        if (warm) {
            work();
        }
        state.SetIterationTime(seconds(work));
    });
}

void add_lsc(const std::string& self, const Workload& workload, std::uint32_t threads) {
    add(fmt::format("{}/lsc cold {}", workload.name, threads), [=](benchmark::State& state) {
        const Run run = run_child(self, workload, threads);
        state.SetIterationTime(run.seconds);
        state.counters["modules"] = run.modules;
        state.counters["bytes_per_module"] = run.bytes / run.modules;
        state.counters["peak_bytes_per_module"] = run.peak / run.modules;
    });
    add(fmt::format("{}/lsc warm {}", workload.name, threads), [=](benchmark::State& state) {
        const lsys::Bytecode bytecode = compile_text(workload.grammar);
        const lsys::Bytecode program = folded(bytecode, workload);
        lsys::Derivation derivation(program, options_for(workload, threads));
        derive(derivation, workload.generations);
        state.SetIterationTime(seconds([&] {
            benchmark::DoNotOptimize(folded(bytecode, workload));
            derive(derivation, workload.generations);
        }));
    });
}

/// A run of `lsc` from start to exit, whose output is discarded.
struct WholeRun {
    std::string name;
    std::string grammar;
    std::string arguments; // of `lsc`; % is replaced by the file
    // Number of bytes that the run writes, from which the table computes the throughput; 0: the
    // table shows none.
    double bytes = 0.0;
};

std::vector<WholeRun> whole_runs(const std::vector<Workload>& all) {
    const std::string bush =
        "#n = 7; #set names letters; #w : A; #p : A : * : [&FL!A]/////'[&FL!A];"
        "#q : F : * : S/////F; #r : S : * : FL; #s : L : * : [^^{-f+f+f}];";
    return {
        {"start: check a sample", bush, "check -q %"},
        {"start: first module of a sample", bush, "dump -q -n 1 %"},
        {"read an axiom of 100,001 modules", all[5].grammar, "check -q %"},
        {"stats of W1, n=60", all[0].grammar, "stats -q -n 60 %"},
        {"count W1, n=14 (12.2 G)", all[0].grammar,
         "dump -q --count -n 14 --max-modules 100000000000 %"},
        {"count W3, n=17 (1.16 G), streamed", all[2].grammar, "dump -q --stream --count -n 17 %"},
        {"text of W1, n=11 (97.7 MB)", all[0].grammar, "dump -q -n 11 %", 97'656'249.0},
        {"text of W3, n=13 (118 MB)", all[2].grammar, "dump -q -n 13 %", 0.0},
    };
}

void add_whole(const std::string& lsc, const WholeRun& whole) {
    add("lsc/" + whole.name, [=](benchmark::State& state) {
        const std::string path = fmt::format(
            "{}/lsys-bench-{}.lsys",
            std::getenv("TMPDIR") != nullptr ? std::getenv("TMPDIR") : "/tmp", getpid());
        std::ofstream(path) << whole.grammar;
        std::string arguments = whole.arguments;
        arguments.replace(arguments.find('%'), 1, path);
        const std::string command = fmt::format("'{}' {}", lsc, arguments);
        double bytes = 0.0;
        state.SetIterationTime(seconds([&] {
            if (std::system((command + " > /dev/null").c_str()) != 0) {
                fail(command + " failed");
            }
        }));
        bytes = whole.bytes;
        state.counters["bytes"] = bytes;
        std::remove(path.c_str());
    });
}

/// Collects the times of all repetitions and prints two tables of medians.
class Table : public benchmark::BenchmarkReporter {
public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration) {
                continue;
            }
            const std::string& name = run.run_name.function_name;
            if (!times_.contains(name)) {
                order_.push_back(name);
            }
            times_[name].push_back(run.real_accumulated_time * 1000.0);
            for (const auto& [counter, value] : run.counters) {
                counters_[name][counter] = value;
            }
        }
    }
    void Finalize() override {
        fmt::print(
            "Milliseconds, medians; in brackets the part of the limit program on fresh small "
            "pages.\n\n{:<11}",
            "");
        for (const char* head : {"limit", "huge pages", "warm", "lsc 1 thread", "2 threads",
                                 "warm 1", "warm 2", "M modules/s", "bytes/module", "at peak"}) {
            fmt::print(" {:>15}", head);
        }
        fmt::print("\n");
        for (const Workload& workload : workloads()) {
            const std::string name = workload.name;
            const double limit = time(name + "/limit cold");
            const std::map<std::string, double>& counters = counters_[name + "/lsc cold 1"];
            if (limit == 0.0 || counters.empty()) {
                continue; // --benchmark_filter excludes the workload
            }
            fmt::print("{:<11} {:>15.3f}", name, limit);
            for (const char* kind : {"limit cold huge", "limit warm", "lsc cold 1", "lsc cold 2",
                                     "lsc warm 1", "lsc warm 2"}) {
                const double spent = time(name + "/" + kind);
                fmt::print(" {:>15}", fmt::format("{:.3f} [{:.2f}]", spent, spent / limit));
            }
            const double best = std::min(time(name + "/lsc cold 1"), time(name + "/lsc cold 2"));
            // The words of W6 and W8 do not grow, so each generation rewrites the same number of
            // modules; W8 has two sweeps.
            const double modules =
                counters.at("modules") * (name.starts_with("W6")   ? workload.generations
                                          : name.starts_with("W8") ? 2.0 * workload.generations
                                                                   : 1.0);
            fmt::print(" {:>15.0f} {:>15.2f} {:>15.2f}\n", modules / best / 1000.0,
                       counters.at("bytes_per_module"), counters.at("peak_bytes_per_module"));
        }
        fmt::print("\n");
        for (const std::string& name : order_) {
            if (name.starts_with("lsc/")) {
                const double bytes = counters_[name]["bytes"];
                fmt::print("{:<36} {:>9.2f} ms {}\n", name.substr(4), time(name),
                           bytes == 0.0 ? ""
                                        : fmt::format("{:>8.2f} GB/s", bytes / time(name) / 1e6));
            }
        }
    }

private:
    double time(const std::string& name) const {
        const auto found = times_.find(name);
        return found == times_.end() ? 0.0 : median(found->second);
    }

    std::vector<std::string> order_;
    std::map<std::string, std::vector<double>> times_;
    std::map<std::string, std::map<std::string, double>> counters_;
};

} // namespace

int main(int argc, char** argv) {
    if (argc == 4 && std::string(argv[1]) == "--child") {
        return derive_as_child(argv[2], argv[3]);
    }
    std::vector<char*> arguments(argv, argv + argc);
    std::string repetitions = "--benchmark_repetitions=9";
    arguments.insert(arguments.begin() + 1, repetitions.data());
    int count = static_cast<int>(arguments.size());
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) {
        return 2;
    }
    const std::vector<Workload> all = workloads();
    for (const Workload& workload : all) {
        add_limit(workload, "cold", PageSize::Small, false);
        add_limit(workload, "cold huge", PageSize::Huge, false);
        add_limit(workload, "warm", PageSize::Small, true);
        add_lsc(argv[0], workload, 1);
        add_lsc(argv[0], workload, 2);
    }
    for (const WholeRun& whole : whole_runs(all)) {
        add_whole(LSYS_LSC, whole);
    }
    Table table;
    benchmark::RunSpecifiedBenchmarks(&table);
    return 0;
}
