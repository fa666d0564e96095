// SPDX-License-Identifier: MIT
// Compares the turtle with a slow, direct implementation of docs/language.md section 7: rotation
// matrices in long double over the text of the word, sharing no code with the runtime.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

using lsys::tests::LscRun;
using lsys::tests::run_lsc;

using Real = long double;
using Vector = std::array<Real, 3>;

struct Line {
    Vector from{};
    Vector to{};
    Real width = 0.0L;
};

/// Operation of each character of a profile: r R (yaw right, left), d u (pitch down, up), l L (roll
/// left, right), | (turn around), $ (level), f (move), F (draw), ! (set width, or scale it), n (set
/// width, or subtract the increment, which is 0), and * " ; (scale width, step, angle).
using Profile = std::map<char, char>;

const std::map<std::string, Profile>& profiles() {
    static const std::map<std::string, Profile> all{
        {"lsys",
         {{'F', 'F'},
          {'f', 'f'},
          {'+', 'r'},
          {'-', 'R'},
          {'&', 'd'},
          {'^', 'u'},
          {'\\', 'l'},
          {'/', 'L'},
          {'|', '|'},
          {'$', '$'},
          {'!', '!'},
          {'"', '"'}}},
        {"thesis",
         {{'F', 'F'},
          {'f', 'f'},
          {'+', 'r'},
          {'-', 'R'},
          {'\\', 'd'},
          {'/', 'u'},
          {'&', 'l'},
          {'^', 'L'},
          {'!', '!'}}},
        {"abop",
         {{'F', 'F'},
          {'f', 'f'},
          {'+', 'R'},
          {'-', 'r'},
          {'&', 'd'},
          {'^', 'u'},
          {'\\', 'l'},
          {'/', 'L'},
          {'|', '|'},
          {'$', '$'},
          {'!', '!'},
          {'"', '"'}}},
        {"cpfg",
         {{'F', 'F'},
          {'f', 'f'},
          {'+', 'R'},
          {'-', 'r'},
          {'&', 'd'},
          {'^', 'u'},
          {'\\', 'L'},
          {'/', 'l'},
          {'|', '|'},
          {'$', '$'},
          {'!', 'n'},
          {'"', '"'}}},
        {"houdini",
         {{'F', 'F'},
          {'f', 'f'},
          {'+', 'r'},
          {'-', 'R'},
          {'&', 'u'},
          {'^', 'd'},
          {'\\', 'l'},
          {'/', 'L'},
          {'|', '|'},
          {'$', '$'},
          {'!', '*'},
          {'"', '"'},
          {';', ';'}}},
    };
    return all;
}

struct Turtle {
    Vector at{};
    Vector right{1, 0, 0};
    Vector heading{0, 1, 0};
    Vector up{0, 0, 1};
    Real width = 0.1L;
    Real step = 1.0L;
    Real angle = 90.0L; // degrees
};

/// Turns `a` towards `b` and `b` towards `-a`.
void rotate(Vector& a, Vector& b, Real degrees) {
    const Real t = degrees * acosl(-1.0L) / 180.0L;
    for (std::size_t i = 0; i < 3; ++i) {
        const Real x = a[i];
        const Real y = b[i];
        a[i] = x * cosl(t) + y * sinl(t);
        b[i] = y * cosl(t) - x * sinl(t);
    }
}

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real length(const Vector& a) {
    return sqrtl(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

struct Tropism {
    Vector towards{};
    Real strength = 0.0L;
};

/// Rotates the frame so that the heading H turns by e |H x T| radians towards T, by Rodrigues'
/// formula.
void bend(Turtle& turtle, const Tropism& tropism) {
    Vector axis = cross(turtle.heading, tropism.towards);
    const Real sine = length(axis);
    if (sine == 0.0L || tropism.strength == 0.0L) {
        return;
    }
    for (Real& x : axis) {
        x /= sine;
    }
    const Real angle = tropism.strength * sine;
    for (Vector* const v : {&turtle.right, &turtle.heading, &turtle.up}) {
        const Vector w = cross(axis, *v);
        const Real dot = axis[0] * (*v)[0] + axis[1] * (*v)[1] + axis[2] * (*v)[2];
        for (std::size_t i = 0; i < 3; ++i) {
            (*v)[i] =
                (*v)[i] * cosl(angle) + w[i] * sinl(angle) + axis[i] * dot * (1.0L - cosl(angle));
        }
    }
}

void walk(Turtle& turtle, Real by) {
    for (std::size_t i = 0; i < 3; ++i) {
        turtle.at[i] += by * turtle.heading[i];
    }
}

/// The lines that a word of one-character modules draws.
std::vector<Line> read_word(const std::string& word, const Profile& profile, const Tropism& bends) {
    std::vector<Line> lines;
    Turtle turtle;
    std::vector<Turtle> saved;
    for (std::size_t i = 0; i < word.size(); ++i) {
        const char name = word[i];
        bool has_value = false;
        Real value = 0.0L;
        if (i + 1 < word.size() && word[i + 1] == '(') {
            has_value = true;
            value = static_cast<Real>(std::strtof(word.c_str() + i + 2, nullptr));
            i = word.find(')', i);
        }
        if (name == '[') {
            saved.push_back(turtle);
        } else if (name == ']') {
            turtle = saved.back();
            saved.pop_back();
        }
        const auto known = profile.find(name);
        if (known == profile.end()) {
            continue;
        }
        const Real turn = has_value ? value : turtle.angle;
        switch (known->second) {
        case 'F': {
            bend(turtle, bends);
            Line line;
            line.from = turtle.at;
            line.width = turtle.width;
            walk(turtle, has_value ? value : turtle.step);
            line.to = turtle.at;
            lines.push_back(line);
            break;
        }
        case 'f':
            walk(turtle, has_value ? value : turtle.step);
            break;
        case 'r':
            rotate(turtle.heading, turtle.right, turn);
            break;
        case 'R':
            rotate(turtle.heading, turtle.right, -turn);
            break;
        case 'd':
            rotate(turtle.heading, turtle.up, -turn);
            break;
        case 'u':
            rotate(turtle.heading, turtle.up, turn);
            break;
        case 'l':
            rotate(turtle.right, turtle.up, turn);
            break;
        case 'L':
            rotate(turtle.right, turtle.up, -turn);
            break;
        case '|':
            rotate(turtle.heading, turtle.right, 180.0L);
            break;
        case '$': {
            Vector level = cross(turtle.heading, {0, 1, 0});
            const Real size = length(level);
            if (size > 1e-9L) {
                turtle.right = {level[0] / size, level[1] / size, level[2] / size};
                turtle.up = cross(turtle.right, turtle.heading);
            }
            break;
        }
        case '!':
            turtle.width = has_value ? value : turtle.width * 0.7L;
            break;
        case 'n':
            turtle.width = has_value ? value : turtle.width;
            break;
        case '*':
            turtle.width *= has_value ? value : 0.7L;
            break;
        case '"':
            turtle.step *= has_value ? value : 0.9L;
            break;
        case ';':
            turtle.angle *= has_value ? value : 0.9L;
            break;
        default:
            FAIL("a profile of the test is wrong");
        }
    }
    return lines;
}

struct DrawnSegment {
    Vector base{};
    std::array<Real, 4> frame{}; // w x y z
    Real length = 0.0L;
    Real radius = 0.0L;
};

std::vector<DrawnSegment> read_skeleton(const std::string& text) {
    std::vector<DrawnSegment> segments;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("segment ", 0) != 0) {
            continue;
        }
        DrawnSegment s;
        REQUIRE(std::sscanf(line.c_str() + line.find("base"),
                            "base (%Lf, %Lf, %Lf) frame (%Lf, %Lf, %Lf, %Lf) length %Lf radius %Lf",
                            &s.base[0], &s.base[1], &s.base[2], &s.frame[0], &s.frame[1],
                            &s.frame[2], &s.frame[3], &s.length, &s.radius) == 9);
        segments.push_back(s);
    }
    return segments;
}

Vector tip_of(const DrawnSegment& s) {
    const auto [w, x, y, z] = s.frame;
    return {s.base[0] + s.length * 2.0L * (x * y - w * z),
            s.base[1] + s.length * (1.0L - 2.0L * (x * x + z * z)),
            s.base[2] + s.length * 2.0L * (y * z + w * x)};
}

Real distance(const Vector& a, const Vector& b) {
    return length({a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

/// A random word of modules of the profile, with matching brackets.
std::string random_word(std::mt19937& random, const Profile& profile) {
    std::string names;
    for (const auto& [name, meaning] : profile) {
        names += std::string(meaning == 'F' ? 4 : 1, name);
    }
    const auto below = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
    std::string word;
    unsigned open = 0;
    for (unsigned i = 0; i < 120; ++i) {
        const unsigned kind = below(10);
        if (kind == 0) {
            word += "[ ";
            ++open;
        } else if (kind == 1 && open > 0) {
            word += "] ";
            --open;
        } else {
            const char name = names[below(static_cast<unsigned>(names.size()))];
            word += name == ';' ? std::string("`;`") : std::string(1, name);
            const char meaning = profile.at(name);
            if (meaning != '|' && meaning != '$' && below(2) == 0) {
                const bool turns = std::string("rRdulL").find(meaning) != std::string::npos;
                const double value = turns ? static_cast<double>(below(7200)) / 10.0 - 360.0
                                           : static_cast<double>(1 + below(20)) / 10.0;
                word += "(" + std::to_string(value) + ")";
            }
            word += ' ';
        }
    }
    for (; open > 0; --open) {
        word += "] ";
    }
    return word;
}

void compare(const std::string& grammar, const Profile& profile, const Tropism& tropism) {
    INFO(grammar);
    const LscRun word = run_lsc({"dump", "-q", "-"}, grammar);
    const LscRun drawn = run_lsc({"dump", "-q", "--stage", "skeleton", "-"}, grammar);
    REQUIRE(word.status == 0);
    REQUIRE(drawn.status == 0);
    std::string plain;
    for (const char c : word.out) {
        plain += c == ' ' || c == '\n' || c == '`' ? std::string() : std::string(1, c);
    }
    const std::vector<Line> lines = read_word(plain, profile, tropism);
    const std::vector<DrawnSegment> segments = read_skeleton(drawn.out);
    REQUIRE(segments.size() == lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        INFO("segment " << i);
        REQUIRE(distance(segments[i].base, lines[i].from) < 2e-5L);
        REQUIRE(distance(tip_of(segments[i]), lines[i].to) < 2e-5L);
        REQUIRE(fabsl(segments[i].radius - lines[i].width / 2.0L) <
                1e-5L * (1.0L + lines[i].width));
    }
}

} // namespace

TEST_CASE("random words are drawn as specified by docs/language.md section 7, in four profiles") {
    std::mt19937 random(7); // NOLINT: the same words every time
    for (const auto& [name, profile] : profiles()) {
        for (int i = 0; i < 60; ++i) {
            compare("#n = 0; #set turtle " + name + "; #w : " + random_word(random, profile) + ";",
                    profile, {});
        }
    }
}

TEST_CASE("tropism bends every drawn segment") {
    std::mt19937 random(8); // NOLINT
    const Profile& profile = profiles().at("lsys");
    for (int i = 0; i < 60; ++i) {
        compare("#n = 0; #set tropism 0.5 -1 0.25 0.22; #w : " + random_word(random, profile) + ";",
                profile, {{0.5L, -1.0L, 0.25L}, static_cast<Real>(0.22F)});
    }
}

TEST_CASE("the Koch island is closed and level") {
    const LscRun drawn = run_lsc({"dump", "-q", "--stage", "skeleton", "-"},
                                 "#n = 3; #w : F - F - F - F;"
                                 "#p : F : * : F - F + F + F F - F - F + F;");
    REQUIRE(drawn.status == 0);
    const std::vector<DrawnSegment> segments = read_skeleton(drawn.out);
    REQUIRE(segments.size() == 4 * 512);
    CHECK(distance(tip_of(segments.back()), {0, 0, 0}) < 1e-6L);
    for (const DrawnSegment& segment : segments) {
        // Segments begin at points of a square lattice in the plane.
        for (const Real x : segment.base) {
            REQUIRE(fabsl(x - roundl(x)) < 1e-6L);
        }
        REQUIRE(segment.base[2] == 0.0L);
    }
}
