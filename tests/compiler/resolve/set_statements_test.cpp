// SPDX-License-Identifier: MIT
#include "compiler/bytecode/settings.h"
#include "tests/compiler/compile_text.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace {

using namespace lsys;

/// Compiles `#set KEY VALUE;` with an axiom.
test::Compiled set(std::string_view key, const std::string& value) {
    return test::compile_text(fmt::format("#set {} {};\n#w : F;\n", key, value));
}

bool is_refused(std::string_view key, const std::string& value) {
    return set(key, value).find(DiagnosticCode::BadSetting) != nullptr;
}

template <typename Value>
void check_number(std::string_view key, Value Settings::*field, float min, float max) {
    CAPTURE(std::string(key), min, max);
    const test::Compiled c = set(key, "7");
    CHECK(c.errors().empty());
    CHECK(c.outcome.program->settings.*field == static_cast<Value>(7));
    if (min > kLowestNumber) {
        CHECK_FALSE(is_refused(key, fmt::format("{}", min)));
        CHECK(is_refused(key, fmt::format("{}", min - 1.0F)));
    }
    if (max < -kLowestNumber) {
        CHECK_FALSE(is_refused(key, fmt::format("{}", max)));
        CHECK(is_refused(key, fmt::format("{}", max + 1.0F)));
        CHECK(is_refused(key, "7.5"));
    }
    CHECK(is_refused(key, "7 8"));
}

template <typename Enum>
void check_choice(std::string_view key, Enum Settings::*field, Enum initial) {
    CAPTURE(std::string(key));
    CHECK(Settings{}.*field == initial);
    for (const Enum value : enumerators_of<Enum>()) {
        const test::Compiled c = set(key, std::string(name_of(value)));
        CHECK(c.errors().empty());
        CHECK(c.outcome.program->settings.*field == value);
    }
    CHECK(is_refused(key, "7"));
}

} // namespace

TEST_CASE("every setting of the table is read within its range") {
#define LSYS_CHOICE(type, field, initial, effect, group)                                           \
    check_choice(#field, &Settings::field, type::initial);
#define LSYS_NUMBER(field, initial, effect, group, min, wanted)                                    \
    check_number(#field, &Settings::field, min, -kLowestNumber);
#define LSYS_COUNT(field, initial, effect, group, min, max, wanted, misfit)                        \
    check_number(#field, &Settings::field, min, max);
#include "compiler/bytecode/settings.def"
}

TEST_CASE("the spring constant is one number for all joints or is computed for each") {
    const auto spring = [](const std::string& value) {
        const test::Compiled c = set("spring", value);
        CHECK(c.errors().empty());
        const Settings& settings = c.outcome.program->settings;
        return settings.has_spring ? settings.spring : -1.0F;
    };
    CHECK(spring("auto") == -1.0F);
    CHECK(spring("0") == 0.0F);
    CHECK(spring("7.5") == 7.5F);
    CHECK(is_refused("spring", "-1"));
    CHECK(is_refused("spring", "auto auto"));
    CHECK_FALSE(Settings{}.has_spring);
    const test::Compiled constant =
        test::compile_text("#define stiff 12;\n#set spring stiff;\n#w : F;\n");
    CHECK(constant.outcome.program->settings.spring == 12.0F);
}

TEST_CASE("a turtle profile sets the traits of the program") {
    CHECK(test::compile_text("#w : F;\n").outcome.program->settings.traits == TurtleTraits{});
    for (const TurtleProfile profile : enumerators_of<TurtleProfile>()) {
        const test::Compiled c = set("turtle", std::string(name_of(profile)));
        CAPTURE(std::string(name_of(profile)));
        CHECK(c.outcome.program->settings.traits == traits_of(profile));
    }
    CHECK_FALSE(traits_of(TurtleProfile::Houdini).leaf_moves);
    CHECK(traits_of(TurtleProfile::Lplus).width_is_relative);
    CHECK(traits_of(TurtleProfile::L3dBugCompatible).l3d_compatible_surface);
    CHECK(traits_of(TurtleProfile::Fractint).first_colour == 15);
    CHECK_FALSE(traits_of(TurtleProfile::Sidefx).object_moves);
}

TEST_CASE("a height is a number of metres") {
    const test::Compiled c = set("height", "20.5");
    CHECK(c.errors().empty());
    CHECK(c.outcome.program->settings.height == 20.5F);
    CHECK(set("width", "1").outcome.program->settings.height == 0.0F);
    CHECK(set("height", "0.000001").errors().empty());
    CHECK(set("height", "1000000").errors().empty());
    for (const char* value : {"0", "-1", "0.0000009", "1000001", "2 3", "tall"}) {
        CAPTURE(std::string(value));
        CHECK_FALSE(set("height", value).errors().empty());
    }
}

TEST_CASE("a pipe model is an exponent from 1 to 4 and a width") {
    const test::Compiled c = set("pipe", "2.5 0.01");
    CHECK(c.errors().empty());
    CHECK(c.outcome.program->settings.pipe == Pipe{2.5F, 0.01F});
    CHECK_FALSE(set("width", "1").outcome.program->settings.pipe.is_set());
    CHECK(set("pipe", "1 0").errors().empty());
    CHECK(set("pipe", "4 1").errors().empty());
    CHECK(set("pipe", "2 1 0.25").outcome.program->settings.pipe == Pipe{2.0F, 1.0F, 0.25F});
    for (const char* value :
         {"2", "0.9 1", "4.1 1", "2 -1", "2 1 1.1", "2 1 -0.1", "2 1 1 1", "wide 1"}) {
        CAPTURE(std::string(value));
        CHECK_FALSE(set("pipe", value).errors().empty());
    }
}

TEST_CASE("a flare is a factor, a height and perhaps a number of roots") {
    CHECK(set("flare", "1.8 1.2").outcome.program->settings.flare == Flare{1.8F, 1.2F, 0});
    CHECK(set("flare", "1 0.1 9").outcome.program->settings.flare == Flare{1.0F, 0.1F, 9});
    CHECK(set("width", "1").outcome.program->settings.flare == Flare{});
    for (const char* value : {"2", "0.9 1", "11 1", "2 0", "2 -1", "2 1 2", "2 1 0", "2 1 10",
                              "2 1 4.5", "2 1 4 4", "wide 1"}) {
        CAPTURE(std::string(value));
        CHECK(is_refused("flare", value) == (std::string(value) != "wide 1"));
        CHECK_FALSE(set("flare", value).errors().empty());
    }
}

TEST_CASE("tropisms are groups of a kind and numbers") {
    const test::Compiled c = set(
        "tropisms", "after 0 1 0 0.2 before 1 0 0 twist (1 / 2) 0 0 0.3 0.1 before 0 1 0 1 2 90");
    CHECK(c.errors().empty());
    const StepTropisms& tropisms = c.outcome.bytecode->settings.tropisms;
    CHECK(tropisms[0] == StepTropism{TropismKind::After, {0.0F, 1.0F, 0.0F}, 0.2F, 0.0F, 0.0F});
    CHECK(tropisms[1] == StepTropism{TropismKind::Before, {1.0F, 0.0F, 0.0F}, 0.0F, 0.0F, 0.0F});
    CHECK(tropisms[2] == StepTropism{TropismKind::Twist, {0.5F, 0.0F, 0.0F}, 0.3F, 0.1F, 0.0F});
    CHECK(tropisms[3] == StepTropism{TropismKind::Before, {0.0F, 1.0F, 0.0F}, 1.0F, 2.0F, 90.0F});
    CHECK(tropisms[4] == StepTropism{});
    for (const char* const value :
         {"0 1 0 0.2", "before", "before 0 1", "before 0 1 0 1 2 90 4", "twist 0 1 0 1 2 90",
          "after 0 1 0 after 0 1 0", "sideways 0 1 0",
          "before 0 1 0 before 0 1 0 before 0 1 0 before 0 1 0 before 0 1 0 before 0 1 0 "
          "before 0 1 0 before 0 1 0 before 0 1 0 before 0 1 0 before 0 1 0 before 0 1 0"}) {
        CAPTURE(std::string(value));
        CHECK_FALSE(set("tropisms", value).errors().empty());
    }
}

TEST_CASE("the help for an unknown key lists every setting") {
    const test::Compiled c = set("no_such_setting_at_all", "1");
    const Diagnostic* error = c.find(DiagnosticCode::UnknownKey);
    REQUIRE(error != nullptr);
    REQUIRE(error->help.size() == 1);
    CHECK(
        error->help[0] ==
        "the settings are `turtle`, `names`, `rewriting`, `choice`, `weights`, `random`, "
        "`tropism`, `seed`, `spring`, `load`, `at_depth`, `height`, `pipe`, `flare`, "
        "`tips`, `tropisms`, `width_unit`, `word_shape`, `angle`, `step`, "
        "`width`, "
        "`angle_scale`, `step_scale`, "
        "`width_scale`, `elasticity`, `density`, `damping`, `collar`, `width_increment`, `scale`, "
        "`sides`, `decompose_depth`, `interpret_depth`, `colour`, `colour_increment`");
}

TEST_CASE("the parser knows every setting, and adds a missing `set`") {
    constexpr auto kAll = std::to_array<std::string_view>({
#define LSYS_CHOICE(type, field, initial, effect, group) #field,
#define LSYS_STATEMENT(key) #key,
#define LSYS_NUMBER(field, initial, effect, group, min, wanted) #field,
#define LSYS_COUNT(field, initial, effect, group, min, max, wanted, misfit) #field,
#include "compiler/bytecode/settings.def"
    });
    for (const std::string_view key : kAll) {
        CAPTURE(key);
        const test::Compiled c = test::compile_text("#" + std::string(key) + " 1;\n#w : F;\n");
        const Diagnostic* const error = c.find(DiagnosticCode::UnknownStatement);
        REQUIRE(error != nullptr);
        REQUIRE(error->fixes.size() == 1);
        CHECK(error->fixes[0].edits[0].replacement == "set ");
    }
}
