// SPDX-License-Identifier: MIT
// Grammars of other programs with one mistake: a character or part of a line is inserted, removed,
// replaced or repeated. None may crash or hang lsc, and one mistake may give at most three messages
// more than the grammar without it. Notes do not count.
#include "grammar/dialects/dialect.h"
#include "runtime/base/random.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/plant.h"
#include "runtime/program/host.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace lsys;
namespace fs = std::filesystem;

constexpr std::size_t kMaxNewMessages = 3;
constexpr double kMaxSeconds = 5.0; // of one text; the slowest takes some milliseconds
constexpr std::uintmax_t kMaxFileBytes = 4000;

/// A grammar without errors.
struct Original {
    std::string path;
    std::string text;
    Dialect dialect = Dialect::Lsys;
    std::string system;
    std::size_t message_count = 0;
};

struct Read {
    std::size_t message_count = 0;
    bool has_errors = true;
    std::string shown; // the messages
};

Read read(const Original& original, const std::string& text) {
    const Project project{make_file_host(nullptr), {}, 1, {}};
    GrammarOptions options;
    options.system = original.system;
    options.generations = 1;
    Result<CompiledText> made =
        compile_text(original.path, {text, original.dialect}, options, project.limits.max_modules,
                     make_loader(project, project.limits.max_bytes));
    REQUIRE(made);
    Read result;
    result.has_errors = made.value().diagnostics.has_errors();
    for (const Diagnostic& diagnostic : made.value().diagnostics.all()) {
        if (diagnostic.severity != Severity::Note) {
            ++result.message_count;
            result.shown += "    " + diagnostic.message + "\n";
        }
    }
    return result;
}

/// The correct grammars of a dialect among the samples and golden cases.
std::vector<Original> originals_of(const DialectRow& row) {
    std::vector<std::string> paths;
    for (const char* const folder : {"/samples/dialects", "/tests/ui"}) {
        for (const auto& entry :
             fs::recursive_directory_iterator(LSYS_SOURCE_DIR + std::string(folder))) {
            const std::string path = entry.path().string();
            if (entry.is_regular_file() && entry.file_size() <= kMaxFileBytes &&
                !path.ends_with(".lsys") && path.find("/runner/") == std::string::npos) {
                paths.push_back(path);
            }
        }
    }
    std::sort(paths.begin(), paths.end());
    std::vector<Original> originals;
    for (const std::string& path : paths) {
        Original original{path, tests::read_text(path), row.dialect, "", 0};
        if (detect_dialect(path, original.text).dialect != row.dialect) {
            continue;
        }
        const std::vector<std::string> systems = systems_in(row.dialect, original.text);
        original.system = systems.empty() ? "" : systems.front();
        const Read found = read(original, original.text);
        original.message_count = found.message_count;
        if (!found.has_errors) {
            originals.push_back(std::move(original));
        }
    }
    return originals;
}

/// The `number`-th mutation of a text, the same in every run.
std::string mutated(const std::string& text, std::uint64_t number) {
    std::uint32_t draw = 0;
    const auto below = [&](std::size_t bound) {
        const PhiloxBlock block =
            philox4x32({static_cast<std::uint32_t>(number), draw++, 0, 0}, {11, 0});
        return static_cast<std::size_t>(block[0]) % bound;
    };
    std::string result = text;
    const std::size_t at = below(text.size());
    constexpr std::size_t kMaxPart = 12;
    const std::size_t length = 1 + below(kMaxPart);
    const char other =
        below(2) == 0 ? text[below(text.size())] : static_cast<char>(' ' + below('~' - ' ' + 1));
    switch (below(6)) {
    case 0:
        result.insert(at, 1, other);
        break;
    case 1:
        result.erase(at, 1);
        break;
    case 2:
        result[at] = other;
        break;
    case 3:
        result.erase(at, length);
        break;
    case 4:
        result.insert(below(text.size()), text.substr(at, length));
        break;
    default:
        result.resize(at);
        break;
    }
    return result;
}

/// Reads the mutations `first` to `end` - 1 of the grammars of a dialect, in turn. Returns the
/// texts that give too many messages.
std::string check_dialect(const DialectRow& row, std::uint64_t first, std::uint64_t end) {
    const std::vector<Original> originals = originals_of(row);
    INFO(row.name);
    REQUIRE(!originals.empty());
    std::string found;
    for (std::uint64_t number = first; number < end; ++number) {
        const Original& original = originals[number % originals.size()];
        const std::string text = mutated(original.text, number);
        const auto begin = std::chrono::steady_clock::now();
        const Read result = read(original, text);
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
        CHECK(time.count() < kMaxSeconds);
        if (result.message_count > original.message_count + kMaxNewMessages) {
            found += std::string(row.name) + " " + std::to_string(number) + ", " + original.path +
                     "\n" + result.shown;
        }
    }
    return found;
}

} // namespace

TEST_CASE("one mistake in a grammar of another program gives few messages") {
    constexpr std::uint64_t kMutations = 10'000;
    for (const DialectRow& row : dialects()) {
        if (row.dialect != Dialect::Lsys) {
            const std::string found = check_dialect(row, 0, kMutations);
            INFO(found.substr(0, 4000));
            CHECK(found.empty());
        }
    }
}

// LSYS_MUTANTS is `FIRST-LAST`: the numbers of the mutations of each dialect instead of the first
// million.
TEST_CASE("mutations of all dialects", "[.]") {
    const char* const range_text = std::getenv("LSYS_MUTANTS");
    unsigned long long first = 0;
    unsigned long long last = 999'999;
    if (range_text != nullptr) {
        REQUIRE(std::sscanf(range_text, "%llu-%llu", &first, &last) == 2);
    }
    for (const DialectRow& row : dialects()) {
        if (row.dialect != Dialect::Lsys) {
            const std::string found = check_dialect(row, first, last + 1);
            std::printf("%s", found.c_str());
            CHECK(found.empty());
        }
    }
}
