// The six workloads: derivation by the library, in a fresh Derivation each time (so its memory is
// fresh too), next to the limit program on fresh pages. Usage: derive_bench [RUNS]
#include "compiler/compile.h"
#include "grammar/parse.h"
#include "runtime/derive.h"
#include "tests/bench/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace {

using lsys::bench::FreshPages;

double milliseconds(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> spent =
        std::chrono::steady_clock::now() - start;
    return spent.count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

lsys::Bytecode compile(const std::string& text) {
    lsys::SourceMap sources;
    lsys::Names names;
    lsys::Diagnostics diagnostics;
    const lsys::FileLoader no_files = [](const std::string&) -> lsys::Result<std::string> {
        return lsys::Error{"no such file"};
    };
    const lsys::FileId file = sources.add("bench.lsys", text);
    lsys::Ast ast = lsys::parse_lsys(file, {sources, names, diagnostics, no_files});
    lsys::CompileOutcome outcome =
        lsys::compile(std::move(ast), names, sources, lsys::CompileOptions{}, diagnostics);
    if (!outcome.bytecode) {
        fmt::print("a workload does not compile\n");
        std::exit(1);
    }
    return std::move(*outcome.bytecode);
}

struct Workload {
    const char* name;
    std::string grammar;
    std::uint32_t generations;
    std::size_t capacity; // modules the limit program has room for
    std::function<std::size_t(const FreshPages& a,
                              const FreshPages& b,
                              const FreshPages& parameters_a,
                              const FreshPages& parameters_b)>
        limit;
};

std::vector<Workload> workloads() {
    using namespace lsys::bench;
    using Pages = const FreshPages&;
    std::vector<Workload> all;
    const auto plain = [](PlainSystem system, int generations) {
        return [=](Pages a, Pages b, Pages, Pages) {
            return derive_plain(system, generations, a.as<std::uint8_t>(), b.as<std::uint8_t>());
        };
    };
    all.push_back({"W1 n=9", "#set names letters; #n = 9; #w : F; #p : F : * : F+F-F-F+F;", 9,
                   3'906'249, plain(koch_w1(), 9)});
    all.push_back({"W2 n=9",
                   "#set names letters; #n = 9; #w : X; #p : X : * : F-[[X]+X]+F[+FX]-X;"
                   "#q : F : * : FF;",
                   9, 1'615'783, plain(weed_w2(), 9)});
    all.push_back({"W3 n=11",
                   "#n = 11; #w : !(1.4)F(2)/(45)A; #p : A : * : !(1.4)F(2)[&(22.5)F(2)A]/(112.5)"
                   "[&(22.5)F(2)A]/(157.5)[&(22.5)F(2)A]; #q : F(l) : * : F(l*1.1);"
                   "#r : !(w) : * : !(w*1.4);",
                   11, 1'594'318, [](Pages a, Pages b, Pages c, Pages d) {
                       return derive_w3(11, a.as<std::uint8_t>(), b.as<std::uint8_t>(),
                                        c.as<float>(), d.as<float>());
                   }});
    all.push_back({"W4 n=10",
                   "#set names letters; #n = 10; #w : F; #p : F : ~ 0.33 : F[+F]F[-F]F;"
                   "#q : F : ~ 0.33 : F[+F]F; #r : F : ~ 0.34 : F[-F]F;",
                   10, std::size_t{16} << 20, [](Pages a, Pages b, Pages, Pages) {
                       return derive_w4(10, a.as<std::uint8_t>(), b.as<std::uint8_t>());
                   }});
    all.push_back({"W5 n=13",
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
        {"W6 n=200",
         "#set names letters; #n = 200; #w : " + axiom + "; #p : b < a : * : b; #q : b : * : a;",
         200, 100'002, [](Pages a, Pages b, Pages, Pages) {
             return derive_w6(200, 100'001, a.as<std::uint8_t>(), b.as<std::uint8_t>());
         }});
    return all;
}

struct Measured {
    double first = 0.0;
    double again = 0.0;
    std::uint64_t modules = 0;
    std::uint64_t bytes = 0;
};

Measured
derive(const lsys::Bytecode& bytecode, std::uint32_t generations, std::uint32_t threads, int runs) {
    std::vector<double> times;
    Measured measured;
    for (int run = 0; run < runs; ++run) {
        times.push_back(milliseconds([&] {
            lsys::DeriveOptions options;
            options.generations = generations;
            options.threads = threads;
            lsys::Derivation derivation(bytecode, options);
            if (derivation.start() != lsys::DeriveStatus::Ok ||
                derivation.run_to(generations) != lsys::DeriveStatus::Ok) {
                fmt::print("a workload does not derive\n");
                std::exit(1);
            }
            measured.modules = derivation.word().module_count();
            measured.bytes = derivation.word().byte_count();
        }));
    }
    measured.first = times.front();
    measured.again = median(times);
    return measured;
}

} // namespace

int main(int argc, char** argv) {
    const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 11;
    fmt::print("{:<9} {:>9} {:>7} {:>10} {:>10} {:>8} {:>10} {:>8} {:>12}\n", "", "modules",
               "bytes/m", "limit ms", "1 thread", "ratio", "2 threads", "ratio", "M modules/s");
    for (const Workload& workload : workloads()) {
        const lsys::Bytecode bytecode = compile(workload.grammar);
        std::vector<double> limit_times;
        for (int run = 0; run < runs; ++run) {
            const FreshPages a(workload.capacity + 64);
            const FreshPages b(workload.capacity + 64);
            const FreshPages c(4 * workload.capacity + 256);
            const FreshPages d(4 * workload.capacity + 256);
            limit_times.push_back(milliseconds([&] {
                if (workload.limit(a, b, c, d) == 0) {
                    std::exit(1);
                }
            }));
        }
        const double limit = median(limit_times);
        const Measured one = derive(bytecode, workload.generations, 1, runs);
        const Measured two = derive(bytecode, workload.generations, 2, runs);
        fmt::print(
            "{:<9} {:>9} {:>7.2f} {:>10.3f} {:>10.3f} {:>8.2f} {:>10.3f} {:>8.2f} {:>12.0f}\n",
            workload.name, one.modules,
            static_cast<double>(one.bytes) / static_cast<double>(one.modules), limit, one.again,
            one.again / limit, two.again, two.again / limit,
            static_cast<double>(one.modules) / one.again / 1000.0);
    }
}
