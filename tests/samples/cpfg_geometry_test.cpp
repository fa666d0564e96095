// SPDX-License-Identifier: MIT
// Geometry of cpfg models, compared with the formulas of cpfg's own turtle: random words, a surface
// and a generalised cylinder. Its turtle has a left and an up, which are -R and -U of lsc, and
// turns one axis to another by cosines and sines instead of quaternions.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using lsys::tests::LscRun;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kTolerance = 1e-3; // relative to the extent of a plant

/// The turtle of cpfg.
struct CpfgTurtle {
    glm::dvec3 position{0.0};
    glm::dvec3 heading{0.0, 1.0, 0.0};
    glm::dvec3 left{-1.0, 0.0, 0.0};
    glm::dvec3 up{0.0, 0.0, -1.0};
    double width = 0.0;
    double elasticity = 0.0;

    static void turn(glm::dvec3& from, glm::dvec3& to, double sine, double cosine) {
        const glm::dvec3 turned = cosine * from + sine * to;
        to = cosine * to - sine * from;
        from = turned;
    }
    void execute(char command, double degrees) {
        const double sine = std::sin(degrees * kRadians);
        const double cosine = std::cos(degrees * kRadians);
        switch (command) {
        case '+':
            return turn(heading, left, sine, cosine);
        case '-':
            return turn(heading, left, -sine, cosine);
        case '&':
            return turn(heading, up, sine, cosine);
        case '^':
            return turn(heading, up, -sine, cosine);
        case '/':
            return turn(left, up, sine, cosine);
        case '\\':
            return turn(left, up, -sine, cosine);
        case '|':
            return turn(heading, left, 0.0, -1.0);
        default:
            FAIL("no turn: " << command);
        }
    }
    /// Moves, and bends the heading towards `tropism` as `tropism direction:` does.
    void step(double length, const glm::dvec3& tropism) {
        position += length * heading;
        for (glm::dvec3* const axis : {&up, &left}) {
            const double sine = elasticity * glm::dot(tropism, *axis);
            turn(heading, *axis, sine, std::sqrt(1.0 - sine * sine));
        }
    }
    /// `@v`: the left becomes horizontal.
    void level() {
        if (heading.y < 1.0 && heading.y > -1.0) {
            left = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), heading));
            up = glm::cross(left, heading);
        }
    }
};

struct DrawnSegment {
    glm::dvec3 base{0.0};
    glm::dvec3 tip{0.0};
    double width = 0.0; // at the base
};
/// A sphere or disk: the axis of a sphere is 0.
struct DrawnObject {
    glm::dvec3 middle{0.0};
    glm::dvec3 axis{0.0};
    double diameter = 0.0;
};
struct Drawing {
    std::vector<DrawnSegment> segments;
    std::vector<DrawnObject> objects;
};

/// Random numbers of a linear congruential generator (Knuth, TAOCP 2, section 3.3.4).
class Chance {
public:
    explicit Chance(std::uint64_t seed) : state_(seed) {}
    /// A number from 0 to `count` - 1.
    unsigned below(unsigned count) {
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        return static_cast<unsigned>(state_ >> 33U) % count;
    }
    /// A number with two digits behind the point.
    double between(int low, int high) {
        return low + 0.01 * below(static_cast<unsigned>(100 * (high - low)));
    }

private:
    std::uint64_t state_;
};

struct RandomModel {
    std::string word;
    Drawing drawing;
};

/// A word of random commands, and what cpfg draws for it. `tropism`: a unit vector.
RandomModel random_model(Chance& chance, const glm::dvec3& tropism, double angle) {
    RandomModel model;
    CpfgTurtle turtle;
    turtle.width = 0.1;
    std::vector<CpfgTurtle> stack;
    for (int i = 0; i < 80; ++i) {
        model.word += ' '; // two `/` in a row begin a comment
        const unsigned choice = chance.below(20);
        if (choice < 6) {
            const char command = "+-&^/\\"[chance.below(6)];
            const bool has_angle = chance.below(4) != 0;
            const double degrees = has_angle ? chance.between(-180, 180) : angle;
            model.word +=
                has_angle ? fmt::format("{}({:.2f})", command, degrees) : std::string(1, command);
            turtle.execute(command, degrees);
        } else if (choice < 12) {
            const char command = "FFFGfg"[chance.below(6)];
            const double length = chance.between(0, 3);
            model.word += fmt::format("{}({:.2f})", command, length);
            const glm::dvec3 base = turtle.position;
            turtle.step(length, tropism);
            if (command == 'F' || command == 'G') {
                model.drawing.segments.push_back({base, turtle.position, turtle.width});
            }
        } else if (choice == 12) {
            turtle.width = chance.between(1, 3);
            model.word += fmt::format("{}({:.2f})", "#!"[chance.below(2)], turtle.width);
        } else if (choice == 13) {
            turtle.elasticity = 0.1 * chance.between(-3, 3);
            model.word += fmt::format("_({:.3f})", turtle.elasticity);
        } else if (choice == 14) {
            model.word += "@v";
            turtle.level();
        } else if (choice == 15) {
            const double diameter = chance.between(1, 2);
            const bool is_sphere = chance.below(2) == 0;
            model.word += fmt::format("@{}({:.2f})", is_sphere ? 'O' : 'c', diameter);
            model.drawing.objects.push_back(
                {turtle.position, is_sphere ? glm::dvec3(0.0) : turtle.up, diameter});
        } else if (choice == 16) {
            model.word += "|";
            turtle.execute('|', 0.0);
        } else if (choice < 19 || stack.empty()) {
            model.word += "[";
            stack.push_back(turtle);
        } else {
            model.word += "]";
            turtle = stack.back();
            stack.pop_back();
        }
    }
    model.word += std::string(stack.size(), ']');
    return model;
}

glm::dvec3 vector_after(const std::string& line, const std::string& label) {
    glm::dvec3 vector(0.0);
    const std::size_t at = line.find(label + " (");
    REQUIRE(at != std::string::npos);
    REQUIRE(std::sscanf(line.c_str() + at + label.size(), " (%lf, %lf, %lf)", &vector.x, &vector.y,
                        &vector.z) == 3);
    return vector;
}

double number_after(const std::string& line, const std::string& label) {
    double number = 0.0;
    const std::size_t at = line.find(" " + label + " ");
    REQUIRE(at != std::string::npos);
    REQUIRE(std::sscanf(line.c_str() + at + label.size() + 2, "%lf", &number) == 1);
    return number;
}

glm::dvec3 heading_of(const std::string& line) {
    glm::dquat frame(1.0, 0.0, 0.0, 0.0);
    REQUIRE(std::sscanf(line.c_str() + line.find("frame ("), "frame (%lf, %lf, %lf, %lf)", &frame.w,
                        &frame.x, &frame.y, &frame.z) == 4);
    return glm::normalize(frame) * glm::dvec3(0.0, 1.0, 0.0);
}

/// What lsc draws, from the text of a skeleton.
Drawing drawing_of(const std::string& skeleton) {
    Drawing drawing;
    std::istringstream lines(skeleton);
    for (std::string line; std::getline(lines, line);) {
        const glm::dvec3 heading = heading_of(line);
        if (line.starts_with("segment")) {
            const glm::dvec3 base = vector_after(line, "base");
            drawing.segments.push_back({base, base + number_after(line, "length") * heading,
                                        2.0 * number_after(line, "radius")});
            continue;
        }
        const double size = number_after(line, "size");
        const bool is_sphere = line.find(" sphere ") != std::string::npos;
        drawing.objects.push_back(
            {vector_after(line, "at") + (is_sphere ? 0.5 * size : 0.0) * heading,
             is_sphere ? glm::dvec3(0.0) : heading, size});
    }
    return drawing;
}

double extent_of(const Drawing& drawing) {
    double extent = 1.0;
    for (const DrawnSegment& segment : drawing.segments) {
        extent = std::max({extent, glm::length(segment.base), glm::length(segment.tip)});
    }
    return extent;
}

/// Positions of the vertices of a mesh, from its text.
std::vector<glm::dvec3> vertices_of(const std::string& mesh) {
    std::vector<glm::dvec3> vertices;
    std::istringstream lines(mesh);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("vertex")) {
            vertices.push_back(vector_after(line, "at"));
        }
    }
    return vertices;
}

double distance_to(const std::vector<glm::dvec3>& vertices, const glm::dvec3& point) {
    double nearest = 1e30;
    for (const glm::dvec3& vertex : vertices) {
        nearest = std::min(nearest, glm::distance(vertex, point));
    }
    return nearest;
}

constexpr const char* kPatch = "0 3   0 3   0 1\nPRECISION S: 3 T: 3\n"
                               "CONTACT POINT  X: 1.00 Y: 0.50 Z: 0.25\n"
                               "END POINT  X: 0.00 Y: 0.00 Z: 0.00\n"
                               "HEADING  X: 0.60 Y: 0.80 Z: 0.00\nUP  X: 0.00 Y: 0.00 Z: -1.00\n"
                               "SIZE: 3.00\nleaf\n"
                               "TOP COLOR: 0 DIFFUSE: 0.00 BOTTOM COLOR: 0 DIFFUSE: 0.00\n"
                               "AL: ~ A: ~ AR: ~\nL: ~ R: ~\nBL: ~ B: ~ BR: ~\n"
                               "0 0 0  0 1 0  0 2 0  0 3 0.5\n1 0 0  1 1 0  1 2 0  1 3 0\n"
                               "2 0 0  2 1 0  2 2 0  2 3 0\n3 0 1  3 1 0  3 2 0  3 3 0\n";

} // namespace

TEST_CASE("random words are drawn as the turtle of cpfg draws them") {
    Chance chance(26);
    const ScratchFolder scratch;
    for (int i = 0; i < 60; ++i) {
        const glm::dvec3 tropism =
            glm::normalize(glm::dvec3(chance.between(-1, 1), -1.0, chance.between(-1, 1)));
        const double angle = chance.between(5, 90);
        const RandomModel model = random_model(chance, tropism, angle);
        INFO(model.word);
        lsys::tests::write_text(scratch / "a.l",
                                "Lsystem: 1\nderivation length: 1\nAxiom: X\nX --> " + model.word +
                                    "\nendlsystem\n");
        lsys::tests::write_text(
            scratch / "a.v",
            fmt::format("angle increment: {:.2f}\nline style: cylinder\ninitial line width: 0.1\n"
                        "tropism direction: {:.9f},{:.9f},{:.9f}\n",
                        angle, tropism.x, tropism.y, tropism.z));
        const LscRun run = run_lsc({"dump", scratch / "a.l", "--stage", "skeleton"}, "");
        REQUIRE(run.status == 0);
        const Drawing drawn = drawing_of(run.out);
        REQUIRE(drawn.segments.size() == model.drawing.segments.size());
        REQUIRE(drawn.objects.size() == model.drawing.objects.size());
        const double tolerance = kTolerance * extent_of(model.drawing);
        for (std::size_t k = 0; k < drawn.segments.size(); ++k) {
            const DrawnSegment& expected = model.drawing.segments[k];
            CHECK(glm::distance(drawn.segments[k].base, expected.base) < tolerance);
            CHECK(glm::distance(drawn.segments[k].tip, expected.tip) < tolerance);
            CHECK(drawn.segments[k].width == Approx(expected.width).epsilon(kTolerance));
        }
        for (std::size_t k = 0; k < drawn.objects.size(); ++k) {
            const DrawnObject& expected = model.drawing.objects[k];
            CHECK(glm::distance(drawn.objects[k].middle, expected.middle) < tolerance);
            CHECK(glm::length(glm::cross(drawn.objects[k].axis, expected.axis)) < kTolerance);
            CHECK(drawn.objects[k].diameter == Approx(expected.diameter).epsilon(kTolerance));
        }
    }
}

TEST_CASE("a surface lies as in cpfg") {
    const ScratchFolder scratch;
    lsys::tests::write_text(scratch / "a.l", "Lsystem: 1\nderivation length: 1\nAxiom: X\n"
                                             "X --> f(1)&(50)/(20)+(30)~l(1.5)\nendlsystem\n");
    lsys::tests::write_text(scratch / "a.v", "line style: cylinder\nsurface: l leaf.s 2\n");
    lsys::tests::write_text(scratch / "leaf.s", kPatch);
    const LscRun run = run_lsc({"dump", scratch / "a.l", "--stage", "mesh"}, "");
    REQUIRE(run.status == 0);
    const std::vector<glm::dvec3> vertices = vertices_of(run.out);
    CHECK(vertices.size() == 16);
    CpfgTurtle turtle;
    turtle.step(1.0, glm::dvec3(0.0));
    turtle.execute('&', 50.0);
    turtle.execute('/', 20.0);
    turtle.execute('+', 30.0);
    // Axes of leaf.s; its corners are measured along them from the contact point.
    const glm::dvec3 heading(0.6, 0.8, 0.0);
    const glm::dvec3 left = glm::cross(heading, glm::dvec3(0.0, 0.0, -1.0));
    const glm::dvec3 up = glm::cross(left, heading);
    for (const glm::dvec3& corner :
         {glm::dvec3(0, 0, 0), glm::dvec3(0, 3, 0.5), glm::dvec3(3, 0, 1), glm::dvec3(3, 3, 0)}) {
        const glm::dvec3 at = (corner - glm::dvec3(1.0, 0.5, 0.25)) * (2.0 / 3.0);
        const glm::dvec3 turned = 1.5 * (at.x * left + at.y * heading + at.z * up);
        const glm::dvec3 expected = turtle.position + turned.x * turtle.left +
                                    turned.y * turtle.heading + turned.z * turtle.up;
        CHECK(distance_to(vertices, expected) < 1e-4);
    }
}

TEST_CASE("the contour of a generalised cylinder lies as in cpfg") {
    const ScratchFolder scratch;
    lsys::tests::write_text(scratch / "a.l",
                            "Lsystem: 1\nderivation length: 1\nAxiom: X\n"
                            "X --> f(1)&(50)/(20)@#(1)#(0.4)@Gs f(2)#(0.8)@Ge(1)\nendlsystem\n");
    lsys::tests::write_text(scratch / "a.v", "line style: cylinder\ncontour: 1 gutter.con\n");
    lsys::tests::write_text(scratch / "gutter.con",
                            "cver 1 3\nname: gutter.con\npoints: 3 7\ntype: or\nsamples: 8\n"
                            "0.8 -1 0 3\n0 0 0 1\n-0.3 1 0 3\n");
    const LscRun run = run_lsc({"dump", scratch / "a.l", "--stage", "mesh"}, "");
    REQUIRE(run.status == 0);
    const std::vector<glm::dvec3> vertices = vertices_of(run.out);
    CpfgTurtle turtle;
    turtle.step(1.0, glm::dvec3(0.0));
    turtle.execute('&', 50.0);
    turtle.execute('/', 20.0);
    for (const auto& [length, radius] : {std::pair(0.0, 0.2), std::pair(2.0, 0.4)}) {
        // The ends of the contour, which begin and end at control points that stand three times.
        for (const auto& [x, y] : {std::pair(0.8, -1.0), std::pair(-0.3, 1.0)}) {
            const glm::dvec3 expected = turtle.position + length * turtle.heading +
                                        radius * (x * turtle.up - y * turtle.left);
            CHECK(distance_to(vertices, expected) < 1e-4);
        }
    }
}
