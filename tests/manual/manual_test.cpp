// Every fenced block of grammar/language.md that begins with ```lsys ARGUMENTS is a grammar; `lsc
// ARGUMENTS` on it must succeed, say nothing on standard error, and print the ```text block that
// follows, if one does.
#include "runtime/cli/lsc.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Example {
    std::size_t line = 0;
    std::vector<std::string> arguments;
    std::string grammar;
    bool has_output = false;
    std::string output;
};

std::string read_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    REQUIRE(file);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<Example> examples(const std::string& manual) {
    std::vector<Example> found;
    std::istringstream lines(manual);
    std::string line;
    std::string* block = nullptr;
    for (std::size_t number = 1; std::getline(lines, line); ++number) {
        if (block != nullptr) {
            if (line == "```") {
                block = nullptr;
            } else {
                *block += line + "\n";
            }
        } else if (line.starts_with("```lsys ")) {
            Example& example = found.emplace_back();
            example.line = number;
            std::istringstream words(line.substr(8));
            for (std::string word; words >> word;) {
                example.arguments.push_back(word);
            }
            block = &example.grammar;
        } else if (line == "```text" && !found.empty() && !found.back().has_output) {
            found.back().has_output = true;
            block = &found.back().output;
        }
    }
    return found;
}

} // namespace

TEST_CASE("the examples of the language manual print what it says") {
    const std::filesystem::path root = LSYS_SOURCE_DIR;
    const std::vector<Example> all = examples(read_file(root / "grammar/language.md"));
    REQUIRE(all.size() >= 7);
    const std::filesystem::path grammar =
        std::filesystem::temp_directory_path() / "lsc-manual-example.lsys";
    for (const Example& example : all) {
        INFO("grammar/language.md:" << example.line);
        std::ofstream(grammar, std::ios::binary) << example.grammar;
        std::vector<std::string> arguments = example.arguments;
        arguments.push_back(grammar.string());
        std::istringstream in;
        std::ostringstream out;
        std::ostringstream err;
        CHECK(lsys::lsc::run(arguments, {in, out, err}) == 0);
        CHECK(err.str().empty());
        if (example.has_output) {
            CHECK(out.str() == example.output);
        }
        // Laid out as `lsc fmt` does it.
        arguments = {"fmt", "--check", grammar.string()};
        CHECK(lsys::lsc::run(arguments, {in, out, err}) == 0);
    }
    std::filesystem::remove(grammar);
}
