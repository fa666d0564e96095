// SPDX-License-Identifier: MIT
// Contours and surfaces of cpfg's view files.
#include "grammar/dialects/cpfg/organs.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <optional>
#include <string>

using namespace lsys;

namespace {

Result<std::string> no_file(std::string_view /*name*/) {
    return Error{"no such file"};
}

} // namespace

TEST_CASE("a closed contour is sampled at equal distances from the axis on") {
    const auto points = contour_points("4 2 closed\n1 0\n0 1\n-1 0\n0 -1\n", 12);
    REQUIRE(points.size() == 13);
    CHECK(points.front().x == points.back().x);
    CHECK(points.front().y == points.back().y);
    CHECK(points.front().x == Approx(0.0).margin(1e-9)); // +X of cpfg is -Y here
    CHECK(points.front().y == Approx(-1.0 / 3.0));       // half of the spline's (0 + 4 * 1 + 0) / 6
    double shortest = 1e9;
    double longest = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double side =
            std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
        shortest = std::min(shortest, side);
        longest = std::max(longest, side);
    }
    CHECK(longest < 1.02 * shortest);
}

TEST_CASE("an open contour begins and ends at points that stand three times") {
    const std::string text = "cver 1 3\nname: a.con\npoints: 3 7\ntype: or\nsamples: 8\n"
                             "-1 0 0 3\n0 0 0 1\n1 0 0 3\n";
    const auto points = contour_points(text, 4);
    REQUIRE(points.size() == 5);
    CHECK(points.front().y == Approx(-0.5));
    CHECK(points.back().y == Approx(0.5));
    CHECK(points[2].y == Approx(0.0).margin(1e-6));
    CHECK(points[2].x == Approx(0.0).margin(1e-9));
}

TEST_CASE("a text that is no contour has no points") {
    CHECK(contour_points("", 8).empty());
    CHECK(contour_points("4 2 closed\n1 0\n", 8).empty());
    CHECK(contour_points("1000000000 2 open\n", 8).empty());
    CHECK(contour_points("4 2 closed\n1 nan\n0 1\n-1 0\n0 -1\n", 8).empty());
    CHECK(contour_points("cver 1 3\npoints: 2 9\ntype: or\n1 1 0 1000000\n1 1 0 3\n", 8).empty());
    CHECK(contour_points("4 2 open\n1 1\n1 1\n1 1\n1 1\n", 8).empty()); // without extent
}

TEST_CASE("a contour has at most 64 points") {
    CHECK(contour_points("4 2 closed\n1 0\n0 1\n-1 0\n0 -1\n", 1000).size() == 64);
}

TEST_CASE("surfaces and contours are listed in the view file") {
    const CpfgOrgans organs = read_organs(FileId{3},
                                          "contour sides: 12\ncontour: 2 leaf.con\n"
                                          "surface: l leaf.s 0.25 5 5\r\nsurface: m other.s\n"
                                          "surface: long other.s 1\n",
                                          no_file);
    CHECK(organs.sides == 12);
    REQUIRE(organs.contours.count(2) == 1);
    CHECK(organs.contours.at(2).points.empty());
    REQUIRE(organs.surfaces.size() == 2);
    CHECK(object_text(organs.surfaces.at("l")) == "\"leaf.s#0.25 steps 5 5\"");
    CHECK(object_text(organs.surfaces.at("m")) == "\"other.s\"");
    CHECK(organs.surfaces.at("l").failure == "no such file");
    CHECK(organs.surfaces.at("l").span.file == FileId{3});
    CHECK(organs.surfaces.at("l").span.begin == 49);
    CHECK(organs.contours.at(2).span.begin == 29);
    CHECK(organs.contours.at(2).span.end == 37);
    CHECK(organs.contours.at(2).failure == "no such file");
    CHECK(read_organs(FileId{3}, "contour sides: 1\n", no_file).sides == 3);
    CHECK(read_organs(FileId{3}, "polygonization level: 0\n", no_file).sides == 3);
    CHECK(read_organs(FileId{3}, "polygonization level: 3\n", no_file).sides == 16);
    CHECK(read_organs(FileId{3}, "contour sides: 1000\n", no_file).sides == 63);
    CHECK(read_organs(FileId{3}, "projection: parallel\n", no_file).sides == 0);
}

TEST_CASE("the numbers behind the scale of a surface are steps and a texture") {
    const CpfgOrgans organs =
        read_organs(FileId{3},
                    "surface: a l.s 2 3\nsurface: b l.s 1 4 6 0\nsurface: c l.s 1 0 0 -1\n"
                    "surface: d l.s 1 40 -2 300\nsurface: e l.s 1 0 5\n",
                    no_file);
    CHECK(object_text(organs.surfaces.at("a")) == "\"l.s#2 texture 3\"");
    CHECK(object_text(organs.surfaces.at("b")) == "\"l.s#steps 4 6 texture 0\"");
    CHECK(object_text(organs.surfaces.at("c")) == "\"l.s\"");
    CHECK(object_text(organs.surfaces.at("d")) == "\"l.s#steps 10 1 texture 0\"");
    CHECK(object_text(organs.surfaces.at("e")) == "\"l.s\"");
}
