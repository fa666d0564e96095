// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/shader_log.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using lsys::view::name_files;

TEST_CASE("numbers of sources in the log of a shader are replaced by file names") {
    const std::vector<std::string> files{"plant.glsl", "light.glsl"};
    CHECK(name_files("", files).empty());
    CHECK(name_files("0:12(3): error: no `x`\n1(4) : error C1008\n", files) ==
          "plant.glsl:12(3): error: no `x`\nlight.glsl:4: error C1008");
    CHECK(name_files("2:1(1): error\nerror\n0\n1 error\n:1\n1(4 : x\n1(4)", files) ==
          "2:1(1): error\nerror\n0\n1 error\n:1\n1(4 : x\n1(4)");
}

TEST_CASE("a number in a log that is too large for an integer stays unchanged") {
    const std::string row = "99999999999999999999999:1(1): error";
    CHECK(name_files(row, std::vector<std::string>{"plant.glsl"}) == row);
}
