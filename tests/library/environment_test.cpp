// SPDX-License-Identifier: MIT
// Environments of kind `program`, answered by functions of the caller.
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <lsys.h>
#include <lsys/forest.h>
#include <lsys/grammar.h>
#include <lsys/plant.h>
#include <lsys/word.h>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

const char* const kLight = "#n = 2; #sense light program;\n"
                           "#w : F ?light(0, 7) ?P(0, 0, 0) A;\n"
                           "#p : A : * : F +(90) f ?light(0, 5) A;";

lsys::Grammar grammar_of(const char* text) {
    const auto grammar = lsys::compile_text(text);
    REQUIRE(grammar);
    return *grammar;
}

lsys::Project project_with(lsys::EnvironmentFunction function) {
    lsys::Project project;
    project.host.environments["light"] = std::move(function);
    return project;
}

/// Answers each place with `answers`.
lsys::EnvironmentFunction constant(std::vector<double> answers) {
    return [answers = std::move(answers)](const lsys::EnvironmentQuery& query) {
        lsys::EnvironmentAnswers given{answers.size(), {}, {}};
        for (std::size_t i = 0; i < query.places.size(); ++i) {
            given.numbers.insert(given.numbers.end(), answers.begin(), answers.end());
        }
        return given;
    };
}

std::string failure_of(const char* text, const lsys::Project& project) {
    const auto word = lsys::derive(grammar_of(text), {}, project);
    REQUIRE_FALSE(word);
    return word.messages().text();
}

} // namespace

TEST_CASE("a function answers an environment") {
    std::vector<std::uint32_t> generations;
    const lsys::Project project = project_with([&](const lsys::EnvironmentQuery& query) {
        generations.push_back(query.generation);
        CHECK(query.offsets.size() == query.places.size() + 1);
        CHECK(query.parameters.size() == query.offsets.back());
        lsys::EnvironmentAnswers answers{1, {}, {}};
        for (std::size_t i = 0; i < query.places.size(); ++i) {
            CHECK(query.places[i].heading[0] == Approx(i == 0 ? 0.0 : i % 2 == 0 ? 0.0 : 1.0));
            CHECK(query.parameters[query.offsets[i] + 1] == (i == 0 ? 7.0F : 5.0F));
            answers.numbers.push_back(query.places[i].position[1] + 0.25);
        }
        return answers;
    });
    const auto word = lsys::derive(grammar_of(kLight), {}, project);
    REQUIRE(word);
    CHECK(word->text() == "F ?light(1.25,7)?P(0,1,0)F+(90)f ?light(2.25,5)F+(90)f ?light(1.25,5)A");
    CHECK(generations == std::vector<std::uint32_t>{0, 1, 2});
}

TEST_CASE("a function answers for a plant and for the heroes of a forest") {
    int calls = 0;
    lsys::Project project = project_with([&](const lsys::EnvironmentQuery& query) {
        ++calls;
        return constant({1.0})(query);
    });
    const auto plant = lsys::grow(grammar_of(kLight), {}, project);
    REQUIRE(plant);
    CHECK(plant->segments().size() == 3);
    CHECK(calls == 3);
    project.host.read_file = [](const std::string&) {
        return lsys::FileContents{true, kLight, {}};
    };
    lsys::ForestOptions options;
    options.scene = {{"count", "3"}, {"heroes", "2"}};
    REQUIRE(lsys::grow_forest({"tree.lsys"}, options, project));
    CHECK(calls >= 9);
}

TEST_CASE("an environment without a function names what is missing") {
    const std::string text = failure_of(kLight, {});
    CHECK(text.find("nothing is given that answers it") != std::string::npos);
    CHECK(text.find("Host::environments") != std::string::npos);
    CHECK(text.find("environment={\"light\": function}") != std::string::npos);
}

TEST_CASE("wrong answers of a function are errors") {
    const auto missing = [](const lsys::EnvironmentQuery&) {
        return lsys::EnvironmentAnswers{2, {1.0, 2.0, 3.0}, {}};
    };
    CHECK(failure_of(kLight, project_with(missing)).find("3 numbers to 1 queries, 2 for each") !=
          std::string::npos);
    const auto failed = [](const lsys::EnvironmentQuery&) {
        return lsys::EnvironmentAnswers{0, {}, "no sun"};
    };
    CHECK(failure_of(kLight, project_with(failed)).find("has failed: no sun") != std::string::npos);
    for (const double number : {std::numeric_limits<double>::quiet_NaN(), 1e300}) {
        const std::string text = failure_of(kLight, project_with(constant({number})));
        CHECK(text.find("sense-not-finite") != std::string::npos);
        CHECK(text.find("`?light`") != std::string::npos);
        CHECK(text.find("module 1 of generation 0") != std::string::npos);
    }
}

TEST_CASE("a function for an environment that is not declared is refused") {
    const char* const kOther = "#n = 0; #sense light shadow; #w : ?light(0);";
    CHECK(failure_of(kOther, project_with(constant({1.0}))).find("no `#sense light program;`") !=
          std::string::npos);
    CHECK(failure_of("#n = 0; #w : F;", project_with(constant({}))).find("`light`") !=
          std::string::npos);
}

TEST_CASE("an exception of a function ends the call") {
    const lsys::Project project = project_with([](const lsys::EnvironmentQuery&) {
        throw std::runtime_error("dark");
        return lsys::EnvironmentAnswers{};
    });
    CHECK_THROWS_WITH(lsys::derive(grammar_of(kLight), {}, project), "dark");
}

namespace {

/// The numbers with which answer_height() answers, and the status that it returns.
struct HeightAnswer {
    std::vector<double> numbers;
    int status = 0;
};

int answer_height(void* user,
                  const lsys_environment_query* query,
                  const double** numbers,
                  size_t* size) {
    HeightAnswer& answer = *static_cast<HeightAnswer*>(user);
    answer.numbers.clear();
    for (size_t i = 0; i < query->place_count; ++i) {
        answer.numbers.push_back(query->places[i].position[1]);
        answer.numbers.push_back(query->parameters[query->offsets[i] + 1] * 2.0);
    }
    *numbers = answer.numbers.data();
    *size = 2;
    return answer.status;
}

} // namespace

TEST_CASE("a function of C answers an environment") {
    HeightAnswer answer;
    const lsys_environment environment{"light", answer_height, &answer};
    lsys_project project = LSYS_PROJECT_DEFAULTS;
    project.environments = &environment;
    project.environment_count = 1;
    const std::string text = kLight;
    lsys_grammar* grammar = nullptr;
    REQUIRE(lsys_compile_text(text.data(), text.size(), nullptr, nullptr, nullptr, &grammar,
                              nullptr) == LSYS_OK);
    lsys_word* word = nullptr;
    REQUIRE(lsys_derive(grammar, 0, nullptr, &project, &word, nullptr) == LSYS_OK);
    CHECK(answer.numbers == std::vector<double>{1.0, 14.0});
    lsys_word_free(word);
    answer.status = 3;
    lsys_messages* messages = nullptr;
    CHECK(lsys_derive(grammar, 0, nullptr, &project, &word, &messages) == LSYS_DIAGNOSED);
    CHECK(std::string(lsys_messages_text(messages)).find("it returned 3") != std::string::npos);
    lsys_messages_free(messages);
    lsys_grammar_free(grammar);
}
