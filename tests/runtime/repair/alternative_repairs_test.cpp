// SPDX-License-Identifier: MIT
#include "runtime/repair/impl/alternative_repairs.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

using namespace lsys;
using namespace lsys::repair;

namespace {

std::vector<std::string> alternatives(DiagnosticCode code,
                                      std::string_view broken,
                                      std::string_view repaired,
                                      std::string_view file_text = {}) {
    const auto place =
        std::mismatch(broken.begin(), broken.end(), repaired.begin(), repaired.end()).first -
        broken.begin();
    return alternative_repairs(
        {code, broken, repaired, static_cast<std::uint32_t>(place), file_text});
}

bool has(const std::vector<std::string>& texts, std::string_view text) {
    return std::find(texts.begin(), texts.end(), text) != texts.end();
}

} // namespace

TEST_CASE("another place of a bracket with the same meaning is no alternative") {
    using Code = DiagnosticCode;
    CHECK(alternatives(Code::ExtraParenthesis, "#w : F(2));", "#w : F(2);").empty());
    CHECK(
        alternatives(Code::ExtraParenthesis, "#w : F(2*(k + 1)));", "#w : F(2*(k + 1));").empty());
    CHECK(alternatives(Code::UnclosedParenthesis, "#w : F(k + 1;", "#w : F(k + 1);").empty());
    CHECK(
        alternatives(Code::UnclosedParenthesis, "#w : F((k + 1)*2;", "#w : F((k + 1)*2);").empty());
}

TEST_CASE("every other place of a bracket with a different meaning is an alternative") {
    using Code = DiagnosticCode;
    CHECK(has(alternatives(Code::ExtraParenthesis, "#w : F(k/2*(k + 1)));", "#w : F(k/2*(k + 1));"),
              "#w : F(k/(2*(k + 1)));"));
    CHECK(has(alternatives(Code::ExtraParenthesis, "#w : Fsin(90));", "#w : Fsin(90);"),
              "#w : F(sin(90));"));
    CHECK(has(alternatives(Code::UnclosedParenthesis, "#w : F(k+(30);", "#w : F(k+(30));"),
              "#w : F(k)+(30);"));
    CHECK(has(alternatives(Code::BadRange, "#w : &(0, 9});", "#w : &(0, 9);"), "#w : &({0, 9});"));
    CHECK(alternatives(Code::UnclosedParenthesis, "#w : F({1, k*2);", "#w : F({1, k*2});") ==
          std::vector<std::string>{"#w : F({1, k}*2);"});
}

TEST_CASE("the second parenthesis of an empty pair may be a mistyped argument") {
    StatementRepair repair{
        DiagnosticCode::ExtraParenthesis, "#w : F())[G(2)];", "#w : F()[G(2)];", 8, {}};
    CHECK(!has(alternative_repairs(repair), "#w : F(1)[G(2)];"));
    repair.is_single = true;
    CHECK(has(alternative_repairs(repair), "#w : F(1)[G(2)];"));
}

TEST_CASE("an opening parenthesis may be mistyped") {
    StatementRepair digit{DiagnosticCode::UnclosedParenthesis, "#n = (6;", "#n = (6);", 7, {}};
    digit.is_single = true;
    CHECK(has(alternative_repairs(digit), "#n = 16;"));
    CHECK(has(alternatives(DiagnosticCode::UnclosedParenthesis, "#p : A(i) : i >=(8 && i : B;",
                           "#p : A(i) : i >=(8 && i) : B;"),
              "#p : A(i) : i >=8 && i : B;"));
}

TEST_CASE("a comma may stand for a product unless a number follows") {
    using Code = DiagnosticCode;
    CHECK(alternatives(Code::MissingComma, "#w : F(km 20);", "#w : F(km, 20);").empty());
    // A single character may have been typed by mistake.
    CHECK(has(alternatives(Code::MissingComma, "#w : F(km 2);", "#w : F(km, 2);"), "#w : F(km );"));
    CHECK(
        has(alternatives(Code::MissingComma, "#w : F(2 k);", "#w : F(2, k);"), "#w : F(2 *  k);"));
    CHECK(alternatives(Code::MissingComma, "#w : F({10 km});", "#w : F({10, km});").empty());
}

TEST_CASE("a statement is parsed with the setting `names` of its file") {
    // A text of more than 16 characters in back quotes is legal only with `names characters`.
    const std::string_view broken = "#w : `seventeen modules`(2));";
    const std::string_view repaired = "#w : `seventeen modules`(2);";
    CHECK(alternatives(DiagnosticCode::ExtraParenthesis, broken, repaired,
                       "#n = 1;\n#set names characters;\n")
              .empty());
    CHECK(alternatives(DiagnosticCode::ExtraParenthesis, broken, broken, "#n = 1;\n").empty());
}

TEST_CASE("a long statement is not compared") {
    const std::string modules(kMaxComparedStatement, 'F');
    CHECK(alternatives(DiagnosticCode::ExtraParenthesis, "#w : " + modules + "k/2*(k + 1)));",
                       "#w : " + modules + "k/2*(k + 1));")
              .empty());
}
