// SPDX-License-Identifier: MIT
#include "tests/bench/measure.h"

#include "compiler/compile.h"
#include "grammar/base/hash.h"
#include "grammar/lsys/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace lsys::bench {

double seconds(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

void fail(const std::string& what) {
    fmt::print(stderr, "bench: {}\n", what);
    std::exit(1);
}

std::uint64_t hash(const std::vector<float>& numbers) {
    std::uint64_t state = 0;
    for (const float number : numbers) {
        state = combine_numbers(state, number);
    }
    return finish(state);
}

Bytecode compile_text(const std::string& text) {
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    const FileLoader no_files = [](const std::string&) -> Result<std::string> {
        return Error{"no such file"};
    };
    const FileId file = sources.add("bench.lsys", text);
    Ast ast = parse_lsys(file, {sources, names, diagnostics, no_files});
    CompileOutcome outcome = compile(std::move(ast), names, sources, {}, diagnostics);
    if (!outcome.bytecode) {
        fail("a grammar does not compile");
    }
    return std::move(*outcome.bytecode);
}

} // namespace lsys::bench
