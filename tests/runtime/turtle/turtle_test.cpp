// SPDX-License-Identifier: MIT
#include "runtime/derive/derive.h"
#include "runtime/turtle/turtle.h"
#include "tests/support/bytecode_builder.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace lsys;
using test::BytecodeBuilder;

struct Drawing {
    std::optional<Stop> status;
    Skeleton skeleton;
    std::array<TurtleFault, kTurtleFaultKindCount> faults{};

    [[nodiscard]] const TurtleFault& fault(TurtleFaultKind kind) const {
        return faults[static_cast<std::size_t>(kind)];
    }
};

/// Gives each symbol whose name is in the table its operation: names of the profile `lsys`, and L,
/// S, D, T, R, H and J for operations that `lsys` has no name for.
void give_operations(Bytecode& bytecode) {
    using enum TurtleOperation;
    const std::vector<std::pair<std::string, TurtleOperation>> known{{"F", Forward},
                                                                     {"f", Move},
                                                                     {"+", YawRight},
                                                                     {"-", YawLeft},
                                                                     {"&", PitchDown},
                                                                     {"^", PitchUp},
                                                                     {"\\", RollLeft},
                                                                     {"/", RollRight},
                                                                     {"|", TurnAround},
                                                                     {"!", SetWidth},
                                                                     {"'", SetColour},
                                                                     {"[", Save},
                                                                     {"]", Restore},
                                                                     {"{", PolygonBegin},
                                                                     {".", PolygonVertex},
                                                                     {"}", PolygonEnd},
                                                                     {"%", Cut},
                                                                     {"L", Leaf},
                                                                     {"S", Sphere},
                                                                     {"D", Disk},
                                                                     {"T", TaperedForward},
                                                                     {"R", SetRelativeWidth},
                                                                     {"H", SecondaryForward},
                                                                     {"J", SecondaryMove}};
    for (BytecodeSymbol& symbol : bytecode.symbols) {
        for (const auto& [name, operation] : known) {
            if (symbol.name == name) {
                symbol.turtle = operation;
            }
        }
        if (symbol.turtle == SetColour && symbol.parameter_count == 3) {
            symbol.turtle = SetRgb;
        }
    }
}

Drawing draw(Bytecode bytecode, std::uint32_t generations, TurtleOptions options = {}) {
    give_operations(bytecode);
    DeriveOptions derive;
    derive.generations = generations;
    Derivation derivation(bytecode, derive);
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(generations) == std::nullopt);
    Turtle turtle(bytecode, std::move(options));
    Drawing drawing;
    drawing.status = turtle.feed(derivation.word());
    if (drawing.status == std::nullopt) {
        drawing.status = turtle.finish();
    }
    drawing.faults = turtle.end().faults;
    drawing.skeleton = turtle.take_skeleton();
    return drawing;
}

Drawing draw(const std::string& word) {
    return draw(BytecodeBuilder().axiom(word).build(), 0);
}

} // namespace

TEST_CASE("a colour without an index does not change the index") {
    const Drawing drawing = draw("'(3)F['(0.2,0.4,1)F'F]'(0,0,0)[F]F'F");
    CHECK(drawing.status == std::nullopt);
    const LargeVector<Segment>& segments = drawing.skeleton.segments;
    REQUIRE(segments.size() == 6);
    CHECK(segments[0].colour == 3);
    CHECK(segments[1].colour == kOwnColour + 0x3366FF);
    CHECK(segments[2].colour == 4);
    CHECK(segments[3].colour == kOwnColour);
    CHECK(segments[4].colour == kOwnColour);
    CHECK(segments[5].colour == 4);
    CHECK(text_of(segments[1].colour) == "#3366FF");
    CHECK(drawing.fault(TurtleFaultKind::RgbOutOfRange).count == 0);
}

TEST_CASE("parts of a colour are clamped to 0 and 1") {
    const Drawing drawing = draw("'(1.5,-2,0.5)F");
    CHECK(drawing.skeleton.segments[0].colour == kOwnColour + 0xFF0080);
    CHECK(drawing.fault(TurtleFaultKind::RgbOutOfRange).count == 1);
}

TEST_CASE("ten million rotations leave the frame orthonormal and exact") {
    // Each repetition of the word restores the frame, so the last F has the direction of the first.
    Bytecode bytecode = BytecodeBuilder().axiom("F+(17)&(23)/(31)\\(31)^(23)-(17)").build();
    give_operations(bytecode);
    DeriveOptions derive;
    Derivation derivation(bytecode, derive);
    REQUIRE(derivation.start() == std::nullopt);
    std::vector<Code> once;
    for (const std::uint8_t code : derivation.word().codes<std::uint8_t>()) {
        once.push_back(code);
    }
    std::vector<Code> turns;
    while (turns.size() < 6000) {
        turns.insert(turns.end(), once.begin() + 1, once.end());
    }
    Turtle turtle(bytecode, {});
    REQUIRE(turtle.feed(once, {}) == std::nullopt);
    for (int i = 0; i < 1667; ++i) {
        REQUIRE(turtle.feed(turns, {}) == std::nullopt);
    }
    REQUIRE(turtle.feed(once, {}) == std::nullopt);
    const Segment& last = turtle.skeleton().segments.back();
    CHECK(std::abs(glm::length(last.frame) - 1.0F) < 1e-5F);
    CHECK(std::abs(last.frame.w - 1.0F) < 1e-5F);
    CHECK(glm::length(heading(last.frame) - glm::vec3(0, 1, 0)) < 1e-5F);
}

TEST_CASE("parents, orders and links follow the branches") {
    const Drawing drawing = draw("F[+F[F]f F]F f F");
    const auto& s = drawing.skeleton.segments;
    REQUIRE(s.size() == 6);
    CHECK(s[0].parent == kNoSegment);
    CHECK_FALSE(s[0].linked);
    CHECK(s[1].parent == 0);
    CHECK(s[1].order == 1);
    CHECK(s[1].linked);
    CHECK(s[2].parent == 1);
    CHECK(s[2].order == 2);
    CHECK(s[3].parent == 1); // the `f` between segments 1 and 3 is not drawn
    CHECK_FALSE(s[3].linked);
    CHECK(s[4].parent == 0);
    CHECK(s[4].order == 0);
    CHECK(s[4].linked);
    CHECK_FALSE(s[5].linked);
}

TEST_CASE("length, width, spring and mass of a segment are its parameters") {
    const Drawing drawing = draw("!(0.5)F(2)F(2,7)F(2,7,9)T(3,1,0.5)F(-2)");
    const auto& s = drawing.skeleton.segments;
    REQUIRE(s.size() == 5);
    CHECK(s[0].length == 2.0F);
    CHECK(s[0].base_radius == 0.25F);
    CHECK(s[0].spring == Approx(9e9 * 3.14159265 / 64.0 * 0.0625 / 2.0)); // E I / l
    CHECK(s[0].mass == Approx(3.14159265 * 0.0625 * 2.0 * 500.0));
    CHECK(s[1].spring == 7.0F);
    CHECK(s[2].mass == 9.0F);
    CHECK(s[3].base_radius == 0.5F);
    CHECK(s[3].tip_radius == 0.25F);
    // Without a width of the tip, a segment is as wide at its tip as at its base.
    CHECK(draw("!(0.5)T(3,1)").skeleton.segments[0].tip_radius == 0.5F);
    CHECK(s[3].spring == Approx(9e9 * 3.14159265 / 64.0 * std::pow(0.75, 4) / 3.0));
    // A negative length draws backwards from the turtle's position.
    CHECK(s[4].length == 2.0F);
    CHECK(heading(s[4].frame).y == Approx(-1.0F));
    CHECK(s[4].base.y == Approx(9.0F));
}

TEST_CASE("objects advance by their length") {
    Bytecode bytecode = BytecodeBuilder().axiom("S(2)S L(3)D(5)S").build();
    const auto objects = draw(bytecode, 0).skeleton.objects;
    REQUIRE(objects.size() == 5);
    CHECK(objects[1].position.y == 2.0F);
    CHECK(objects[2].position.y == 3.0F);
    CHECK(objects[2].size == 3.0F);
    CHECK(objects[3].position.y == 6.0F);
    CHECK(objects[4].position.y == 6.0F); // a disk has no length
    CHECK(objects[3].kind == TurtleOperation::Disk);
    CHECK(draw("F F").skeleton.segments[1].linked);
    CHECK_FALSE(draw("F L(1)F").skeleton.segments[1].linked);
}

TEST_CASE("vertices of a polygon are its dots, or without dots the ends of its steps") {
    const Drawing dots = draw("{.f(1).-(90)f(1).}");
    REQUIRE(dots.skeleton.polygons.size() == 1);
    CHECK(dots.skeleton.corners.size() == 3);
    const Drawing steps = draw("{-(60)f(1)+(120)f(1)+(120)f(1)}");
    REQUIRE(steps.skeleton.polygons.size() == 1);
    CHECK(steps.skeleton.corners.size() == 3); // the last step ends at the first corner
    const Drawing nested = draw("{.f(1).{.+(90)f(1).+(90)f(1).}+(90)f(1).f(1).}");
    REQUIRE(nested.skeleton.polygons.size() == 2);
    CHECK(nested.skeleton.polygons[0].corner_count == 3);
    CHECK(nested.skeleton.polygons[1].corner_count == 4);
}

TEST_CASE("turns by the angle of the settings keep the direction of the second heading") {
    for (const char* const word : {"+ H", "- H", "+ + + - H"}) {
        const glm::vec3 along = heading(draw(word).skeleton.segments[0].frame);
        CHECK(glm::distance(along, glm::vec3(0.0F, 1.0F, 0.0F)) < 1e-6F);
    }
    CHECK(draw("F H F").skeleton.segments[2].linked);
    CHECK_FALSE(draw("F J F").skeleton.segments[1].linked);
}

TEST_CASE("a polygon has the colour of its end") {
    const Drawing drawing = draw("'(2){.f(1).-(90)'(3)f(1).}'(4)");
    REQUIRE(drawing.skeleton.polygons.size() == 1);
    CHECK(drawing.skeleton.polygons[0].colour == 3);
}

TEST_CASE("polygons open and close along the word, apart from branches") {
    // A polygon begun before a branch and ended in it, and one begun in a branch and ended after
    // it.
    const Drawing into = draw("{.f(1).[+(90)f(1).}]f(1).");
    REQUIRE(into.skeleton.polygons.size() == 1);
    CHECK(into.skeleton.polygons[0].corner_count == 3);
    const Drawing out = draw("[f(1){.]f(1)+(90)f(1).f(1).}");
    REQUIRE(out.skeleton.polygons.size() == 1);
    CHECK(out.skeleton.corners[0].y == Approx(1.0F));
    CHECK(out.skeleton.corners.size() == 3);
}

TEST_CASE("modules that cannot be drawn are counted, with the first place") {
    const Drawing outside = draw("F.F.F}F.");
    CHECK(outside.status == Stop::Diagnosed);
    CHECK(outside.fault(TurtleFaultKind::VertexOutside).count == 2);
    CHECK(outside.fault(TurtleFaultKind::VertexOutside).position == 1);
    CHECK(outside.fault(TurtleFaultKind::EndOutside).count == 1);
    CHECK(draw("{.f(1).}").fault(TurtleFaultKind::FewCorners).count == 1);
    const Drawing unclosed = draw("F{.f(1).{.");
    CHECK(unclosed.status == std::nullopt);
    CHECK(unclosed.fault(TurtleFaultKind::UnclosedPolygon).count == 2);
    CHECK(unclosed.fault(TurtleFaultKind::UnclosedPolygon).position == 1);
    CHECK(draw("F[F").fault(TurtleFaultKind::UnclosedBranch).count == 1);
    CHECK(draw("F[F[F]F[F").fault(TurtleFaultKind::UnclosedBranch).count == 2);
    CHECK(draw("!(-1)F").fault(TurtleFaultKind::NegativeWidth).count == 1);
    CHECK(draw("!(-1)F").skeleton.segments[0].base_radius == 0.0F);
    CHECK(draw("!(1,65)F").fault(TurtleFaultKind::SidesOutOfRange).count == 1);
    CHECK(draw("!(1,65)F").skeleton.segments[0].sides == 64);
    CHECK(draw("!(1,64)F").fault(TurtleFaultKind::SidesOutOfRange).count == 0);
    CHECK(draw("'(70000)F").fault(TurtleFaultKind::ColourOutOfRange).count == 1);
    const Drawing unbalanced = draw("F]F");
    CHECK(unbalanced.status == Stop::Diagnosed);
    CHECK(unbalanced.fault(TurtleFaultKind::Unbalanced).position == 1);
    const Drawing endless = draw("F(3e38)F(3e38)F");
    CHECK(endless.status == Stop::Diagnosed);
    CHECK(endless.fault(TurtleFaultKind::NotFinite).position == 1);
    const Drawing wide = draw("R(3e38)F(1e10)"); // width 3e36 m
    CHECK(wide.fault(TurtleFaultKind::NotFinite).count == 0);
    Bytecode relative = BytecodeBuilder().axiom("R(3e38)F(1e10)").build();
    relative.settings.traits.width_is_relative = true; // width 2 * 3e36 * 1e10 m
    const Drawing too_wide = draw(std::move(relative), 0);
    CHECK(too_wide.status == Stop::Diagnosed);
    CHECK(too_wide.fault(TurtleFaultKind::NotFinite).position == 1);
}

TEST_CASE("a cut drops the rest of its branch") {
    const Drawing drawing = draw("F[F%F[F]F]F");
    REQUIRE(drawing.skeleton.segments.size() == 3);
    CHECK(drawing.skeleton.segments[2].parent == 0);
    CHECK(draw("F%F[F]F").skeleton.segments.size() == 1);
}

TEST_CASE("a word in pieces and with codes of any width gives the same drawing") {
    const char* const axiom = "F(1)[+(25)F(2)A]!(0.05)/(40)F{.f(1).&(20)f(1).}S(0.2)";
    const char* const production = "p : A : * : F(0.5)[^(30)F A]-(10)A";
    const Skeleton whole =
        draw(BytecodeBuilder().axiom(axiom).production(production).build(), 6).skeleton;
    REQUIRE(whole.segments.size() > 100);
    const auto same = [&](const Skeleton& other) {
        std::string a;
        std::string b;
        REQUIRE(line_count(other) == line_count(whole));
        for (std::uint64_t i = 0; i < line_count(whole); ++i) {
            append_line(whole, i, nullptr, a);
            append_line(other, i, nullptr, b);
        }
        CHECK(a == b);
    };
    for (const std::uint32_t unused : {300U, 70'000U}) {
        same(draw(BytecodeBuilder()
                      .axiom(axiom)
                      .production(production)
                      .unused_symbols(unused)
                      .build(),
                  6)
                 .skeleton);
    }
    BytecodeBuilder stored;
    stored.fold = false; // every parameter comes from the word
    same(draw(stored.axiom(axiom).production(production).build(), 6).skeleton);
}

TEST_CASE("too little memory for a plant is an outcome") {
    TurtleOptions options;
    options.max_bytes = 100'000;
    const Bytecode bytecode = BytecodeBuilder().axiom("A").production("p : A : * : F A A").build();
    CHECK(draw(bytecode, 14, options).status == Stop::Limit);
}

TEST_CASE("nothing is read after the limit of memory") {
    Bytecode bytecode = BytecodeBuilder().axiom("F]").build();
    give_operations(bytecode);
    TurtleOptions options;
    options.max_bytes = 100'000;
    Turtle turtle(bytecode, options);
    std::vector<Code> codes(10'000, 0); // segments, then a `]` without its `[`
    codes.push_back(1);
    CHECK(turtle.feed(codes, {}) == Stop::Limit);
    CHECK(turtle.end().faults[static_cast<std::size_t>(TurtleFaultKind::Unbalanced)].count == 0);
}

TEST_CASE("open branches count as memory of a plant") {
    TurtleOptions options;
    options.max_bytes = 100'000;
    const Bytecode bytecode = BytecodeBuilder().axiom("A").production("p : A : * : [ A A").build();
    CHECK(draw(bytecode, 4, options).status == std::nullopt);
    CHECK(draw(bytecode, 14, options).status == Stop::Limit);
}

TEST_CASE("a million nested branches are drawn") {
    std::string word;
    for (int i = 0; i < 1'000'000; ++i) {
        word += "[F";
    }
    Bytecode bytecode = BytecodeBuilder().axiom("[F").build();
    give_operations(bytecode);
    Turtle turtle(bytecode, {});
    const std::vector<Code> pair{0, 1};
    for (int i = 0; i < 1'000'000; ++i) {
        REQUIRE(turtle.feed(pair, {}) == std::nullopt);
    }
    REQUIRE(turtle.finish() == std::nullopt);
    CHECK(turtle.skeleton().segments.size() == 1'000'000);
    CHECK(turtle.skeleton().segments.back().order == 65'535);
}

TEST_CASE("statistics of a skeleton are closed forms") {
    const Skeleton skeleton = draw("!(2)F(3)[+(90)F(4)]F(1)").skeleton;
    const SkeletonStats stats = measure(skeleton);
    CHECK(stats.height == Approx(4.0));
    CHECK(stats.crown_width == Approx(8.0));
    CHECK(stats.length == Approx(8.0));
    CHECK(stats.volume == Approx(8.0 * 3.14159265));
    CHECK(stats.mass == Approx(8.0 * 3.14159265 * 500.0));
    CHECK(stats.segments_by_order == std::vector<std::uint64_t>{2, 1});
    CHECK(glm::length(skeleton.segments[2].frame - skeleton.segments[0].frame) < 1e-6F);
}

TEST_CASE("the turtle follows the traits of the program, not the name of its profile") {
    const auto draw_with = [](const std::string& word, const TurtleTraits& traits) {
        Bytecode bytecode = BytecodeBuilder().axiom(word).build();
        bytecode.settings.traits = traits;
        bytecode.settings.step_scale = 0.5F;
        return draw(std::move(bytecode), 0).skeleton;
    };
    const auto second = [&](const std::string& word, const TurtleTraits& traits) {
        const Skeleton skeleton = draw_with(word, traits);
        REQUIRE(skeleton.objects.size() == 2);
        return skeleton.objects[1].position.y;
    };
    CHECK(second("L(2)S", {}) == 2.0F);
    CHECK(second("L(2)S", {.leaf_moves = false}) == 0.0F);
    CHECK(second("S(2)L", {.leaf_moves = false}) == 2.0F);
    CHECK(second("S(2)L", {.object_moves = false}) == 0.0F);
    CHECK(draw_with("L", {.object_has_step_scale = true}).objects[0].size == 0.5F);
    CHECK(draw_with("L", {}).objects[0].size == 1.0F);

    const Skeleton wide = draw_with("F(2,3,9,5)", {.forward_has_width = true});
    CHECK(wide.segments[0].base_radius == 1.5F);
    CHECK(wide.segments[0].sides == 5);
    const Skeleton relative = draw_with("R(25)F(2)", {.width_is_relative = true, .taper = 0.5F});
    CHECK(relative.segments[0].base_radius == 0.5F);
    CHECK(relative.segments[0].tip_radius == 0.25F);
    const Skeleton l3d =
        draw_with("R(25)F(2)", {.width_is_relative = true, .l3d_compatible_surface = true});
    CHECK(l3d.l3d_compatible_surface);
    CHECK(l3d.segments[0].sides == 40);
    const Skeleton turned = draw_with("F(2)F", {.first_turn = -90.0F, .first_colour = 15});
    CHECK(glm::distance(turned.segments[1].base, glm::vec3(2.0F, 0.0F, 0.0F)) < 1e-6F);
    CHECK(turned.segments[1].colour == 15);
}

TEST_CASE("memory is reserved for exactly the parts that the word draws") {
    Bytecode bytecode = BytecodeBuilder().axiom("F F T f + [ L ] S { . F . f . }").build();
    give_operations(bytecode);
    Derivation derivation(bytecode, {});
    REQUIRE_FALSE(derivation.start());
    Turtle turtle(bytecode, {});
    REQUIRE(turtle.reserve(derivation.word()) == std::nullopt);
    CHECK(turtle.skeleton().segments.capacity() == 4);
    CHECK(turtle.skeleton().objects.capacity() == 2);
}
