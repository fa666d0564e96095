// SPDX-License-Identifier: MIT
// Checks that every diagnostic has an explanation, in order, and that the examples give the
// diagnostics of their sections.
#include "grammar/base/diagnostic.h"
#include "runtime/cli/explanations.h"
#include "runtime/scene/scene.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using lsys::lsc::Example;
using lsys::lsc::Explanation;
using lsys::tests::LscRun;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;

std::vector<Explanation> all_explanations() {
    return lsys::lsc::parse_explanations(lsys::lsc::explanations_text());
}

struct Messages {
    int status = 0;
    std::set<std::string> codes;      // of all diagnostics
    std::set<std::string> severities; // of all diagnostics
    std::string text;                 // the whole standard error
};

Messages run_example(const Example& example) {
    const ScratchFolder folder;
    for (const auto& [name, text] : example.files) {
        lsys::tests::write_text(folder / name, text);
    }
    std::vector<std::string> arguments;
    std::istringstream words(example.arguments.empty() ? "check" : example.arguments);
    for (std::string word; words >> word;) {
        arguments.push_back(word);
    }
    arguments.insert(arguments.end(), {"--message-format", "json", folder / "example.lsys"});
    const LscRun run = run_lsc(arguments, "");
    Messages messages;
    messages.status = run.status;
    messages.text = run.err;
    std::istringstream lines(run.err);
    for (std::string line; std::getline(lines, line);) {
        const nlohmann::json object = nlohmann::json::parse(line);
        messages.severities.insert(object.value("severity", ""));
        messages.codes.insert(object.value("code", ""));
    }
    return messages;
}

} // namespace

TEST_CASE("every diagnostic has an explanation, in the same order") {
    std::vector<std::string> wanted;
    for (std::uint32_t i = 0; i < lsys::diagnostic_code_count(); ++i) {
        wanted.emplace_back(lsys::info(static_cast<lsys::DiagnosticCode>(i)).name);
    }
    std::vector<std::string> found;
    for (const Explanation& explanation : all_explanations()) {
        found.push_back(explanation.code);
        INFO(explanation.code);
        CHECK(explanation.text.size() > 20);
        REQUIRE(explanation.examples.size() >= 2);
        CHECK(!explanation.examples.front().is_correct);
        CHECK(explanation.examples.back().is_correct);
    }
    CHECK(found == wanted);
}

TEST_CASE("wrong examples give their diagnostic, correct ones give none") {
    for (const Explanation& explanation : all_explanations()) {
        for (const Example& example : explanation.examples) {
            if (example.is_sketch) {
                continue;
            }
            const Messages messages = run_example(example);
            INFO(explanation.code << (example.is_correct ? ", right:\n" : ", wrong:\n")
                                  << example.files.front().second << messages.text);
            CHECK(messages.codes.contains(explanation.code) == !example.is_correct);
            if (example.is_correct) {
                CHECK(messages.status == 0);
                CHECK(!messages.severities.contains("error"));
                CHECK(!messages.severities.contains("warning"));
            }
        }
    }
}

TEST_CASE("examples of scenes give their diagnostic, or none") {
    std::size_t scenes = 0;
    for (const Explanation& explanation : all_explanations()) {
        if (explanation.code.find("scene") == std::string::npos) {
            continue;
        }
        for (const Example& example : explanation.examples) {
            ++scenes;
            lsys::SourceMap sources;
            const lsys::FileId file = sources.add("example.toml", example.files.front().second);
            lsys::Diagnostics diagnostics;
            const bool fine = lsys::parse_scene(file, sources, diagnostics).has_value();
            INFO(explanation.code << "\n" << example.files.front().second);
            CHECK(fine == example.is_correct);
            std::set<std::string> codes;
            for (const lsys::Diagnostic& diagnostic : diagnostics.all()) {
                codes.emplace(lsys::info(diagnostic.code).name);
            }
            CHECK(codes.contains(explanation.code) == !example.is_correct);
        }
    }
    CHECK(scenes >= 10);
}
