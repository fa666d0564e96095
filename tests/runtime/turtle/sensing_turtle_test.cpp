// SPDX-License-Identifier: MIT
// Compares the turtle that senses with closed forms, and on random words with a slow reading of
// docs/language.md section 13 that knows no codes and no cached turns.
#include "runtime/base/exact_functions.h"
#include "runtime/derive/derive.h"
#include "runtime/turtle/sensing_turtle.h"
#include "tests/support/bytecode_builder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace lsys;
using test::BytecodeBuilder;
using Vector = std::array<double, 3>;

struct Organ {
    Vector middle{};
    double area = 0.0;
};

struct Senses final : SenseSink {
    std::vector<SenseModule> modules;
    std::vector<SensingPose> poses;
    std::vector<Organ> organs;

    void sense(const SenseModule& module, const SensingPose& pose) override {
        modules.push_back(module);
        poses.push_back(pose);
    }
    void organ(const std::array<double, 3>& middle, double area) override {
        organs.push_back({middle, area});
    }
};

const std::vector<std::pair<std::string, TurtleOperation>> kOperations{
    {"F", TurtleOperation::Forward},
    {"f", TurtleOperation::Move},
    {"h", TurtleOperation::HalfForward},
    {"+", TurtleOperation::YawRight},
    {"-", TurtleOperation::YawLeft},
    {"&", TurtleOperation::PitchDown},
    {"^", TurtleOperation::PitchUp},
    {"\\", TurtleOperation::RollLeft},
    {"/", TurtleOperation::RollRight},
    {"|", TurtleOperation::TurnAround},
    {"$", TurtleOperation::RollUpright},
    {"s", TurtleOperation::ScaleStep},
    {"a", TurtleOperation::ScaleAngle},
    {"[", TurtleOperation::Save},
    {"]", TurtleOperation::Restore},
    {"{", TurtleOperation::PolygonBegin},
    {".", TurtleOperation::PolygonVertex},
    {"}", TurtleOperation::PolygonEnd},
    {"S", TurtleOperation::Sphere},
    {"C", TurtleOperation::Cone},
    {"D", TurtleOperation::Disk},
    {"%", TurtleOperation::Cut},
    {"H", TurtleOperation::SecondaryForward},
    {"J", TurtleOperation::SecondaryMove}};

Bytecode with_operations(Bytecode bytecode) {
    for (BytecodeSymbol& symbol : bytecode.symbols) {
        for (const auto& [name, operation] : kOperations) {
            symbol.turtle = symbol.name == name ? operation : symbol.turtle;
        }
    }
    return bytecode;
}

/// Walks over the axiom. Module `P` senses.
Senses walked(const Bytecode& bytecode, std::optional<Stop> expected = std::nullopt) {
    struct NoSense final : WordSense {
        std::optional<Stop> begin(std::uint64_t /*seed*/,
                                  std::uint32_t /*generations*/,
                                  std::span<const float> /*globals*/,
                                  DerivationEnd& /*end*/) override {
            return std::nullopt;
        }
        std::optional<Stop>
        sense(Word& /*word*/, std::uint32_t /*age*/, DerivationEnd& /*end*/) override {
            return std::nullopt;
        }
        [[nodiscard]] std::string state() const override { return {}; }
        [[nodiscard]] bool restore(std::string_view state) override { return state.empty(); }
    } none;
    DeriveOptions derive;
    derive.senses = &none;
    Derivation derivation(bytecode, derive);
    REQUIRE(derivation.start() == std::nullopt);
    SensingOptions options;
    options.organs = true;
    options.leaf_area = 0.25;
    SensingTurtle turtle(bytecode, options);
    Senses senses;
    CHECK(turtle.walk(derivation.word(), 0, senses) == expected);
    if (expected == Stop::Diagnosed) {
        CHECK(turtle.error().kind == RuntimeErrorKind::Unbalanced);
    }
    return senses;
}

Senses walked(const std::string& axiom, std::optional<Stop> expected = std::nullopt) {
    BytecodeBuilder builder;
    return walked(with_operations(builder.axiom(axiom).sense("P").build()), expected);
}

Vector sum(const Vector& a, double factor, const Vector& b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

/// The slow reading: one module after the other, by name.
class SlowTurtle {
public:
    explicit SlowTurtle(const Settings& settings) : settings_(settings) {
        now_.step = static_cast<double>(settings.step);
        now_.angle = static_cast<double>(settings.angle);
    }

    void read(const std::string& name, const std::vector<float>& arguments) {
        const bool has_argument = !arguments.empty();
        const double first = has_argument ? static_cast<double>(arguments[0]) : 0.0;
        const double angle = has_argument ? first : now_.angle;
        if (name == "F" || name == "f" || name == "h") {
            step(name, (has_argument ? first : now_.step) * (name == "h" ? 0.5 : 1.0));
        } else if (name == "+" || name == "-") {
            turn(now_.heading, now_.right, name == "+" ? angle : -angle);
        } else if (name == "^" || name == "&") {
            turn(now_.heading, now_.up, name == "^" ? angle : -angle);
        } else if (name == "\\" || name == "/") {
            turn(now_.right, now_.up, name == "\\" ? angle : -angle);
        } else if (name == "|") {
            turn(now_.heading, now_.right, 180.0);
        } else if (name == "$") {
            upright();
        } else if (name == "s") {
            now_.step *= has_argument ? first : static_cast<double>(settings_.step_scale);
        } else if (name == "a") {
            now_.angle *= has_argument ? first : static_cast<double>(settings_.angle_scale);
        } else if (name == "[") {
            saved_.push_back(now_);
        } else if (name == "]") {
            now_ = saved_.back();
            saved_.pop_back();
        } else if (name == "S" || name == "C" || name == "D") {
            object(name, has_argument ? first : 1.0);
        } else if (name == "P") {
            places.push_back({now_.position, now_.heading, now_.right, now_.up});
        }
    }

    std::vector<SensingPose> places;
    std::vector<Organ> organs;

private:
    struct State {
        Vector position{0.0, 0.0, 0.0};
        Vector heading{0.0, 1.0, 0.0};
        Vector right{1.0, 0.0, 0.0};
        Vector up{0.0, 0.0, 1.0};
        double step = 0.0;
        double angle = 0.0;
    };

    static void turn(Vector& from, Vector& to, double degrees) {
        const double c = exact_cosine_of_degrees(degrees);
        const double s = exact_sine_of_degrees(degrees);
        const Vector a = from;
        const Vector b = to;
        for (std::size_t i = 0; i < 3; ++i) {
            from[i] = c * a[i] + s * b[i];
            to[i] = c * b[i] - s * a[i];
        }
    }
    void step(const std::string& name, double length) {
        if (name != "f" && settings_.has_tropism) {
            bend();
        }
        now_.position = sum(now_.position, length, now_.heading);
    }
    void upright() {
        const Vector& h = now_.heading;
        const double length = std::sqrt(h[2] * h[2] + h[0] * h[0]);
        if (length <= 1e-9) {
            return;
        }
        now_.right = {-h[2] / length, 0.0, h[0] / length};
        const Vector& r = now_.right;
        now_.up = {r[1] * h[2] - r[2] * h[1], r[2] * h[0] - r[0] * h[2], r[0] * h[1] - r[1] * h[0]};
    }
    void bend() {
        const Vector h = now_.heading;
        const auto t = [&](std::size_t i) { return static_cast<double>(settings_.tropism[i]); };
        Vector k{h[1] * t(2) - h[2] * t(1), h[2] * t(0) - h[0] * t(2), h[0] * t(1) - h[1] * t(0)};
        const double length = std::sqrt(k[0] * k[0] + k[1] * k[1] + k[2] * k[2]);
        if (length == 0.0) {
            return;
        }
        k = {k[0] / length, k[1] / length, k[2] / length};
        const double c = exact_cosine(t(3) * length);
        const double s = exact_sine(t(3) * length);
        for (Vector* const axis : {&now_.heading, &now_.right, &now_.up}) {
            const Vector v = *axis;
            const Vector across{k[1] * v[2] - k[2] * v[1], k[2] * v[0] - k[0] * v[2],
                                k[0] * v[1] - k[1] * v[0]};
            const double along = (k[0] * v[0] + k[1] * v[1] + k[2] * v[2]) * (1.0 - c);
            for (std::size_t i = 0; i < 3; ++i) {
                (*axis)[i] = (v[i] * c + across[i] * s) + k[i] * along;
            }
        }
    }
    void object(const std::string& name, double wide) {
        const double length = name == "D" ? 0.0 : wide;
        const double unit = name == "C" ? 0.5 : std::numbers::pi / 4.0;
        organs.push_back({sum(now_.position, length / 2.0, now_.heading), unit * (wide * wide)});
        now_.position = sum(now_.position, length, now_.heading);
    }

    Settings settings_;
    State now_;
    std::vector<State> saved_;
};

bool same_bits(const Vector& a, const Vector& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        // A zero of either sign is the same place.
        if (std::bit_cast<std::uint64_t>(a[i] + 0.0) != std::bit_cast<std::uint64_t>(b[i] + 0.0)) {
            return false;
        }
    }
    return true;
}

} // namespace

TEST_CASE("a sense module stands where the turtle stands") {
    const Senses senses = walked("P F(2) P [ +(90) F P ] P f P");
    REQUIRE(senses.poses.size() == 5);
    CHECK(senses.poses[0].position == Vector{0.0, 0.0, 0.0});
    CHECK(senses.poses[1].position == Vector{0.0, 2.0, 0.0});
    CHECK(senses.poses[2].position == Vector{1.0, 2.0, 0.0}); // to the right, exactly
    CHECK(senses.poses[2].heading == Vector{1.0, 0.0, 0.0});
    CHECK(senses.poses[2].right == Vector{0.0, -1.0, 0.0});
    CHECK(senses.poses[3].position == Vector{0.0, 2.0, 0.0});
    CHECK(senses.poses[4].position == Vector{0.0, 3.0, 0.0});
    CHECK(senses.modules[2].position == 6);
}

TEST_CASE("a sense module knows its first parameter") {
    const Senses senses = walked("P(1, 2) F(2) A(4) P(7)");
    REQUIRE(senses.modules.size() == 2);
    CHECK(senses.modules[0].first_parameter == 0);
    CHECK(senses.modules[1].position == 3);
}

TEST_CASE("turns by the angle of the settings are rounded correctly") {
    BytecodeBuilder builder;
    builder.settings.angle = 25.7F;
    const Bytecode bytecode = with_operations(builder.axiom("+ + P").sense("P").build());
    const Senses senses = walked(bytecode);
    const ExactSineCosine turn = exact_sine_cosine_of_degrees(static_cast<double>(25.7F));
    REQUIRE(senses.poses.size() == 1);
    CHECK(senses.poses[0].heading[0] == turn.cosine * turn.sine + turn.sine * turn.cosine);
    CHECK(senses.poses[0].heading[1] == turn.cosine * turn.cosine + turn.sine * -turn.sine);
}

TEST_CASE("the second heading of a sensing turtle keeps its direction in turns") {
    for (const char* const axiom : {"+ H P", "- H P", "+ + + - J P"}) {
        const Senses senses = walked(axiom);
        REQUIRE(senses.poses.size() == 1);
        CHECK(senses.poses[0].position[0] == Approx(0.0).margin(1e-12));
        CHECK(senses.poses[0].position[1] == Approx(1.0));
    }
}

TEST_CASE("what a cut will cut off is walked") {
    const Senses senses = walked("F % F P [ F % ] P");
    REQUIRE(senses.poses.size() == 2);
    CHECK(senses.poses[0].position == Vector{0.0, 2.0, 0.0});
    CHECK(senses.poses[1].position == Vector{0.0, 2.0, 0.0});
}

TEST_CASE("a bracket or polygon that ends without its beginning is an error") {
    walked("F P ] P", Stop::Diagnosed);
    walked("F P } P", Stop::Diagnosed);
    CHECK(walked("[ F P { P").poses.size() == 2);
}

TEST_CASE("organs have the areas of their shapes, at their middles") {
    const Senses senses = walked("F S(2) C(3) D(2) { . +(90) F(2) . -(90) F(2) . } P");
    REQUIRE(senses.organs.size() == 4);
    CHECK(senses.organs[0].middle == Vector{0.0, 2.0, 0.0}); // from y = 1 to 3
    CHECK(senses.organs[0].area == std::numbers::pi);
    CHECK(senses.organs[1].middle == Vector{0.0, 4.5, 0.0});
    CHECK(senses.organs[1].area == 4.5);
    CHECK(senses.organs[2].middle == Vector{0.0, 6.0, 0.0});
    CHECK(senses.organs[3].area == 2.0);
    CHECK(senses.organs[3].middle[0] == Approx(4.0 / 3.0));
    CHECK(senses.organs[3].middle[1] == Approx(6.0 + 2.0 / 3.0));
}

TEST_CASE("a sense module that interpretation replaces stands before what replaces it") {
    BytecodeBuilder builder;
    builder.axiom("F P(1) B P(2)")
        .sense("P")
        .production(Stage::Interpret, "i : P(x) : x == 1 : F(5)")
        .production(Stage::Interpret, "j : B : * : F(7) P(3)");
    const Senses senses = walked(with_operations(builder.build()));
    REQUIRE(senses.poses.size() == 2); // the one that interpretation writes is skipped
    CHECK(senses.poses[0].position == Vector{0.0, 1.0, 0.0});
    CHECK(senses.poses[1].position == Vector{0.0, 13.0, 0.0});
    CHECK(senses.modules[1].position == 3);
    CHECK(senses.modules[1].first_parameter == 1);
}

TEST_CASE("random words are walked as the slow reading walks them") {
    std::mt19937 random(17); // whose numbers the standard fixes
    const auto below = [&](std::uint32_t end) {
        return static_cast<std::uint32_t>(random() % end);
    };
    constexpr std::array<const char*, 17> kNames{"F", "f", "h", "+", "-", "&", "^", "\\", "/",
                                                 "|", "$", "s", "a", "S", "C", "D", "P"};
    for (int round = 0; round < 200; ++round) {
        BytecodeBuilder builder;
        builder.fold = below(2) == 0;
        builder.settings.angle = static_cast<float>(below(2000)) / 16.0F;
        builder.settings.step = 0.75F;
        builder.settings.has_tropism = below(3) == 0;
        builder.settings.tropism = {0.25F, -1.0F, 0.5F, 0.125F};
        SlowTurtle slow(builder.settings);
        std::string axiom;
        int open = 0;
        const auto add = [&](const std::string& name, const std::vector<float>& arguments) {
            axiom += name;
            axiom += arguments.empty() ? " " : fmt::format("({}) ", arguments[0]);
            slow.read(name, arguments);
        };
        for (int i = 0; i < 120; ++i) {
            const std::uint32_t choice = below(22);
            if (choice < kNames.size()) {
                const std::string name = kNames[choice];
                const bool plain = name == "|" || name == "$" || name == "P" || below(2) == 0;
                const float value = name == "s" || name == "a"
                                        ? 0.5F + static_cast<float>(below(64)) / 64.0F
                                        : static_cast<float>(below(4096)) / 64.0F;
                add(name, plain ? std::vector<float>{} : std::vector<float>{value});
            } else if (choice < 20) {
                add("[", {});
                ++open;
            } else if (open > 0) {
                add("]", {});
                --open;
            }
        }
        const Senses senses = walked(with_operations(builder.axiom(axiom).sense("P").build()));
        INFO(axiom);
        REQUIRE(senses.poses.size() == slow.places.size());
        for (std::size_t i = 0; i < senses.poses.size(); ++i) {
            REQUIRE(same_bits(senses.poses[i].position, slow.places[i].position));
            REQUIRE(same_bits(senses.poses[i].heading, slow.places[i].heading));
            REQUIRE(same_bits(senses.poses[i].right, slow.places[i].right));
            REQUIRE(same_bits(senses.poses[i].up, slow.places[i].up));
        }
        REQUIRE(senses.organs.size() == slow.organs.size());
        for (std::size_t i = 0; i < senses.organs.size(); ++i) {
            REQUIRE(same_bits(senses.organs[i].middle, slow.organs[i].middle));
            REQUIRE(senses.organs[i].area == slow.organs[i].area);
        }
    }
}
