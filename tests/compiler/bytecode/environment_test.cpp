// SPDX-License-Identifier: MIT
#include "compiler/bytecode/environment_keys.h"
#include "compiler/bytecode/module_file.h"
#include "compiler/bytecode/verify.h"
#include "tests/compiler/small_bytecode.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>

using namespace lsys;

namespace {

/// The small program with an environment of each kind; modules of symbol 1 ask the last of them.
Bytecode sensing_bytecode() {
    Bytecode bytecode = test::small_bytecode();
    for (const EnvironmentKind kind : enumerators_of<EnvironmentKind>()) {
        BytecodeEnvironment& environment = bytecode.environments.emplace_back();
        environment.name = name_of(kind);
        environment.kind = kind;
        environment.site = 0;
        if (kind == EnvironmentKind::Space || kind == EnvironmentKind::Map) {
            environment.size = {2.0F, 3.0F, kind == EnvironmentKind::Map ? 0.0F : 4.0F};
        }
        if (kind == EnvironmentKind::Solid) {
            environment.surfaces = {{"", {0.0F, 1.0F, 0.0F, -0.5F}, 0}, {"wall.obj", {}, 0}};
        } else if (kind == EnvironmentKind::Map) {
            environment.surfaces = {{"soil.png", {}, 0}};
        }
    }
    return bytecode;
}

BytecodeEnvironment& of_kind(Bytecode& bytecode, EnvironmentKind kind) {
    return bytecode.environments[static_cast<std::size_t>(kind)];
}

/// The message of verify() after a change; empty if the program verifies.
std::string verdict(const std::function<void(Bytecode&)>& change) {
    Bytecode bytecode = sensing_bytecode();
    change(bytecode);
    return verify(bytecode).value_or("");
}

} // namespace

TEST_CASE("environments are read back from a module file as they were written") {
    const Bytecode bytecode = sensing_bytecode();
    REQUIRE(verify(bytecode) == std::nullopt);
    const std::string bytes = write_module_file(bytecode);
    const Result<Bytecode> read = read_module_file(bytes);
    REQUIRE(read.ok());
    REQUIRE(read.value().environments.size() == bytecode.environments.size());
    for (std::size_t i = 0; i < bytecode.environments.size(); ++i) {
        CHECK(environment_text(read.value().environments[i]) ==
              environment_text(bytecode.environments[i]));
    }
    CHECK(digest(read.value()) == digest(bytecode));
    CHECK(write_module_file(read.value()) == bytes);
}

TEST_CASE("damaged environments are refused") {
    using enum EnvironmentKind;
    CHECK(verdict([](Bytecode&) {}).empty());
    CHECK(verdict([](Bytecode& b) { of_kind(b, Sky).name.clear(); }) ==
          "an environment has no name, place or kind");
    CHECK(verdict([](Bytecode& b) { of_kind(b, Sky).site = 1U << 30; }) ==
          "an environment has no name, place or kind");
    CHECK(verdict([](Bytecode& b) { of_kind(b, Solid).surfaces.clear(); }) ==
          "a surface of environment solid is malformed");
    CHECK(verdict([](Bytecode& b) { of_kind(b, Solid).surfaces[0].plane = {}; }) ==
          "a surface of environment solid is malformed");
    CHECK(verdict([](Bytecode& b) {
              std::swap(of_kind(b, Solid).surfaces[0], of_kind(b, Solid).surfaces[1]);
          }) == "a surface of environment solid is malformed");
    CHECK(verdict([](Bytecode& b) { of_kind(b, Shadow).surfaces = of_kind(b, Map).surfaces; }) ==
          "a surface of environment shadow is malformed");
    CHECK(verdict([](Bytecode& b) {
              b.environments.resize(kMaxEnvironments + 1, b.environments.front());
          }) == "256 environments");
}

TEST_CASE("the verifier refuses what the keys of an environment refuse") {
    for (const EnvironmentKey& key : environment_keys()) {
        INFO(key.word);
        const float below = key.above_min ? key.min : std::nextafter(key.min, -HUGE_VALF);
        for (const float wrong : {below, std::numeric_limits<float>::quiet_NaN(), HUGE_VALF}) {
            if (key.number != nullptr &&
                (key.min != -std::numeric_limits<float>::max() || !std::isfinite(wrong))) {
                CHECK(!key.admits(wrong));
                CHECK(verdict([&](Bytecode& b) { b.environments[0].*key.number = wrong; }) ==
                      "a number of environment shadow is out of its range");
            }
        }
        if (key.whole != nullptr) {
            const auto above = static_cast<std::uint32_t>(key.max) + 1;
            CHECK(!key.admits(std::nextafter(key.max, HUGE_VALF)));
            CHECK(!key.admits(key.min + 0.5F));
            CHECK(verdict([&](Bytecode& b) { b.environments[0].*key.whole = above; }) ==
                  "a number of environment shadow is out of its range");
        }
    }
}

TEST_CASE("defaults of keys are values that the keys take") {
    const BytecodeEnvironment initial;
    for (const EnvironmentKey& key : environment_keys()) {
        INFO(key.word);
        if (key.number != nullptr) {
            CHECK(key.admits(initial.*key.number));
        }
        if (key.whole != nullptr) {
            CHECK(key.admits(static_cast<float>(initial.*key.whole)));
        }
        CHECK(find_environment_key(key.word) == &key);
    }
    CHECK(default_text(*find_environment_key("cell")) == "0.5");
    CHECK(default_text(*find_environment_key("radius")).empty());
}
