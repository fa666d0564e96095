// SPDX-License-Identifier: MIT
// Properties that hold for every grammar, tested on the samples of the gallery.
#include "grammar/lsys/parse.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/host.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace lsys;
using tests::all_samples;
using tests::LscRun;
using tests::run_lsc;
using tests::Sample;
using tests::ScratchFolder;

/// A number of generations that keeps a sample small enough to be derived many times.
std::string few_generations(const Sample& sample) {
    const LscRun stats = run_lsc(
        {"stats", "--quiet", "--message-format", "json", "-n", "6", sample.file.string()}, "");
    // One line per generation; the words of all samples grow.
    std::istringstream lines(stats.out);
    std::size_t n = 0;
    std::size_t index = 0;
    for (std::string line; std::getline(lines, line); ++index) {
        const std::size_t at = line.find("\"high\":{\"modules\":");
        if (at != std::string::npos && std::strtod(line.c_str() + at + 18, nullptr) < 20'000) {
            n = index;
        }
    }
    return std::to_string(n);
}

/// The text with the axiom `word` instead of all its axioms; nullopt if the axiom is in an included
/// file.
std::optional<std::string>
with_axiom(const std::filesystem::path& path, const std::string& text, const std::string& word) {
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    const FileLoader load =
        make_loader(Project{make_file_host(nullptr), {}, 0, {}}, ~std::uint64_t{0});
    const FileId root = sources.add(path.string(), text);
    const Ast ast = parse_lsys(root, {sources, names, diagnostics, load});
    std::string changed = text;
    std::optional<std::size_t> first;
    // From the last to the first, so that spans before a change stay valid.
    for (std::size_t i = ast.statements.size(); i-- > 0;) {
        const Statement& statement = ast.statements[i];
        if (statement.kind == StatementKind::Axiom && statement.span.file == root) {
            first = statement.span.begin;
            changed.erase(*first, statement.span.end - *first);
        }
    }
    if (!first) {
        return std::nullopt;
    }
    return changed.insert(*first, "#w : " + word + ";");
}

/// Whether the grammar declares an environment of kind space.
bool has_markers(const std::string& text) {
    const std::size_t sense = text.find("#sense ");
    return sense != std::string::npos && text.find(" space ", sense) < text.find(';', sense);
}

std::string dump(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"dump", "--quiet"});
    const LscRun run = run_lsc(arguments, "");
    INFO(run.err);
    CHECK(run.status == 0);
    return run.out;
}

} // namespace

TEST_CASE("a dumped word parses as the axiom of the same file and is dumped unchanged") {
    std::size_t tried = 0;
    for (const Sample& sample : all_samples()) {
        INFO(sample.file);
        const std::string n = few_generations(sample);
        const std::string word = dump({"-n", n, "--seed", "3", sample.file.string()});
        const std::string source = tests::read_text(sample.file);
        const std::optional<std::string> text =
            with_axiom(sample.file, source, word.substr(0, word.size() - 1));
        if (!text) {
            continue;
        }
        ++tried;
        const std::string folder = sample.file.parent_path().string();
        const LscRun again = run_lsc({"dump", "--quiet", "-n", "0", "--base", folder, "-"}, *text);
        if (has_markers(source)) {
            // An axiom senses all markers, also those that had vanished before the dump, so its
            // answers may differ.
            INFO(again.err);
            CHECK(again.status == 0);
            continue;
        }
        INFO(again.err);
        CHECK(again.out == word);
    }
    CHECK(tried > 40);
}

TEST_CASE("one thread and two derive the same word") {
    for (const Sample& sample : all_samples()) {
        INFO(sample.file);
        const std::string file = sample.file.string();
        CHECK(dump({"--seed", "5", "--threads", "1", file}) ==
              dump({"--seed", "5", "--threads", "2", file}));
    }
}

TEST_CASE("a streamed word equals the stored one") {
    std::size_t tried = 0;
    for (const Sample& sample : all_samples()) {
        INFO(sample.file);
        const std::string file = sample.file.string();
        const LscRun streamed = run_lsc({"dump", "--quiet", "--seed", "6", "--stream", file}, "");
        if (streamed.status == 2) {
            CHECK(streamed.err.find("--stream") != std::string::npos);
            continue;
        }
        ++tried;
        CHECK(streamed.status == 0);
        CHECK(streamed.out == dump({"--seed", "6", file}));
        CHECK(dump({"--stream", "--count", "--seed", "6", file}) ==
              dump({"--count", "--seed", "6", file}));
    }
    CHECK(tried > 20);
}

TEST_CASE("a derivation that is saved and continued gives the word of an uninterrupted one") {
    const ScratchFolder folder;
    for (const Sample& sample : all_samples()) {
        INFO(sample.file);
        const std::string n = few_generations(sample);
        const std::string whole = dump({"-n", n, "--seed", "7", sample.file.string()});
        const std::string state = folder / "half.lss";
        const std::string half = dump(
            {"-n", n, "--seed", "7", "--steps", "2", "--save-state", state, sample.file.string()});
        CHECK(half == dump({"-n", n, "--seed", "7", "--steps", "2", sample.file.string()}));
        CHECK(dump({"--from", state, sample.file.string()}) == whole);
    }
}

TEST_CASE("predicted counts are those of the words") {
    const ScratchFolder folder;
    for (const Sample& sample : all_samples()) {
        INFO(sample.file);
        const std::string file = sample.file.string();
        // A run with --save-state derives; without it, --count may predict instead.
        CHECK(dump({"--count", "--all", file}) ==
              dump({"--count", "--all", "--save-state", folder / "all.lss", file}));
    }
}

TEST_CASE("a compiled grammar derives the word of its source") {
    for (const Sample& sample : all_samples()) {
        INFO(sample.file);
        // Files that environments name must lie beside the compiled file.
        const ScratchFolder folder;
        std::filesystem::copy(sample.file.parent_path(), folder.path());
        const std::string compiled = folder / "sample.lsb";
        const std::string n = few_generations(sample);
        if (tests::read_text(sample.file).find("#sense ") != std::string::npos) {
            // The turtle walks during the derivation, and reads meshes beside the compiled file.
            std::filesystem::copy(sample.file.parent_path(), folder.path(),
                                  std::filesystem::copy_options::recursive |
                                      std::filesystem::copy_options::overwrite_existing);
        }
        CHECK(run_lsc({"compile", "--quiet", sample.file.string(), "-o", compiled}, "").status ==
              0);
        CHECK(dump({"-n", n, "--seed", "8", compiled}) ==
              dump({"-n", n, "--seed", "8", sample.file.string()}));
    }
}
