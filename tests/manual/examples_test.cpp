// SPDX-License-Identifier: MIT
// Every block of a document that begins with ```lsys ARGUMENTS is a grammar: `lsc ARGUMENTS` on it
// must succeed, write nothing to standard error, and print the ```text block that follows, if there
// is one.
#include "tests/manual/markdown.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <sstream>
#include <string>
#include <vector>

namespace lsys::tests {

namespace {

constexpr std::string_view kExample = "lsys ";

void check_example(const Fence& fence, const Fence* output, const ScratchFolder& folder) {
    const std::string file = folder / "example.lsys";
    write_text(file, fence.text());
    std::vector<std::string> arguments;
    std::istringstream words(fence.info.substr(kExample.size()));
    for (std::string word; words >> word;) {
        arguments.push_back(word);
    }
    arguments.push_back(file);
    const LscRun run = run_lsc(arguments, "");
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    if (output != nullptr) {
        CHECK(run.out == output->text());
    }
    // The example must be formatted as by `lsc fmt`.
    CHECK(run_lsc({"fmt", "--check", file}, "").status == 0);
}

} // namespace

TEST_CASE("the examples of the documents print the output stated there") {
    const ScratchFolder folder;
    std::size_t count = 0;
    for (const std::filesystem::path& document : all_documents()) {
        if (document == "grammar/explanations.md") { // tested by tests/explanations
            continue;
        }
        const std::vector<Fence> fences = fences_of(read_text(source_root() / document));
        for (std::size_t i = 0; i < fences.size(); ++i) {
            if (!fences[i].info.starts_with(kExample)) {
                continue;
            }
            INFO(document.string() << ":" << fences[i].line);
            const bool has_output = i + 1 < fences.size() && fences[i + 1].info == "text";
            check_example(fences[i], has_output ? &fences[i + 1] : nullptr, folder);
            ++count;
        }
    }
    CHECK(count >= 15);
}

} // namespace lsys::tests
