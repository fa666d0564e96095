// SPDX-License-Identifier: MIT
// The words for syntax files of editors are those of the compiler, and each has a text for hovers.
#include "runtime/languageserver/impl/vocabulary.h"
#include "runtime/languageserver/language_words.h"

#include <catch2/catch.hpp>

#include <algorithm>

namespace lsys::tests {

namespace {

bool has(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

} // namespace

TEST_CASE("the words of the language are sorted, and come from all tables") {
    const LanguageWords words = language_words();
    for (const std::vector<std::string>* const list :
         {&words.statements, &words.functions, &words.settings, &words.values, &words.material_keys,
          &words.objects, &words.commands}) {
        CHECK_FALSE(list->empty());
        CHECK(std::is_sorted(list->begin(), list->end()));
        CHECK(std::adjacent_find(list->begin(), list->end()) == list->end());
    }
    CHECK(has(words.statements, "decompose"));
    CHECK(has(words.functions, "binomial"));
    CHECK(has(words.settings, "tropism"));
    CHECK(has(words.values, "leftmost"));
    CHECK(has(words.material_keys, "two_sided"));
    CHECK(has(words.objects, "LEAF"));
    CHECK(words.commands == std::vector<std::string>{"F", "f"});
}

TEST_CASE("every statement, function and setting has a text for hovers") {
    const LanguageWords words = language_words();
    CHECK(statement_helps().size() == words.statements.size());
    for (const std::string& name : words.statements) {
        INFO(name);
        CHECK(find_statement_help("#" + name) != nullptr);
    }
    CHECK(function_helps().size() == words.functions.size());
    for (const std::string& name : words.functions) {
        INFO(name);
        CHECK(find_function_help(name) != nullptr);
    }
    for (const std::string& name : words.settings) {
        INFO(name);
        CHECK_FALSE(find_setting_help(name)->meaning.empty());
    }
}

} // namespace lsys::tests
