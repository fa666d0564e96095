// SPDX-License-Identifier: MIT
#include "runtime/turtle/surface_name.h"

#include <catch2/catch.hpp>

using namespace lsys;

TEST_CASE("the name of a surface file may have a scale") {
    REQUIRE(surface_name("a/leaf.s"));
    CHECK(surface_name("a/leaf.s")->scale == 1.0F);
    REQUIRE(surface_name("leaf.S#0.5"));
    CHECK(surface_name("leaf.S#0.5")->path == "leaf.S");
    CHECK(surface_name("leaf.S#0.5")->scale == 0.5F);
    CHECK_FALSE(surface_name("leaf.s#0"));
    CHECK_FALSE(surface_name("leaf.s#-1"));
    CHECK_FALSE(surface_name("leaf.s#inf"));
    CHECK_FALSE(surface_name("leaf.s#"));
    CHECK_FALSE(surface_name("leaf.obj#2"));
    CHECK_FALSE(surface_name("leaf.obj"));
}

TEST_CASE("the name of a surface file may have steps and a texture") {
    const auto name = surface_name("b/leaf.s#0.4 steps 8 5 texture 2 whole");
    REQUIRE(name);
    CHECK(name->path == "b/leaf.s");
    CHECK(name->scale == 0.4F);
    CHECK(name->row_steps == 8);
    CHECK(name->column_steps == 5);
    CHECK(name->texture == 2U);
    CHECK(name->is_whole);
    REQUIRE(surface_name("leaf.s#texture 0"));
    CHECK(surface_name("leaf.s#texture 0")->texture == 0U);
    CHECK_FALSE(surface_name("leaf.s#texture 0")->is_whole);
    CHECK_FALSE(surface_name("leaf.s#whole")->texture);
    for (const char* const wrong : {"leaf.s#texture", "leaf.s#texture 256", "leaf.s#texture -1",
                                    "leaf.s#steps 4", "leaf.s#steps 0 4", "leaf.s#steps 65 4",
                                    "leaf.s#0.4  whole", "leaf.s#part", "leaf.s#whole 2"}) {
        CAPTURE(wrong);
        CHECK_FALSE(surface_name(wrong));
    }
}

TEST_CASE("the path of an object is its name without what is behind the #") {
    CHECK(path_of_object("leaf.s#0.5 whole") == "leaf.s");
    CHECK(path_of_object("a#2.obj") == "a#2.obj");
}
