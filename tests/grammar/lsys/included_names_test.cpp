// SPDX-License-Identifier: MIT
#include "grammar/lsys/included_names.h"

#include <catch2/catch.hpp>

#include <string_view>
#include <vector>

using namespace lsys;

TEST_CASE("names of included files are found without scanning") {
    CHECK(included_names("").empty());
    CHECK(included_names("#include").empty());
    CHECK(included_names("#include \"a").empty());
    CHECK(included_names("#include \"a\n\";").empty());
    CHECK(included_names("#include parts.lsys;").empty());
    CHECK(included_names("#n = 1;\n#include \"a.lsys\";\n#include\n\"b/c.lsys\" ;") ==
          std::vector<std::string_view>{"a.lsys", "b/c.lsys"});
}
