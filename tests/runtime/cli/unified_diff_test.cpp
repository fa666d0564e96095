// SPDX-License-Identifier: MIT
#include "runtime/cli/unified_diff.h"

#include <catch2/catch.hpp>

#include <string>

using namespace lsys::lsc;

TEST_CASE("equal texts have no difference") {
    CHECK(unified_diff("a", "", "").empty());
    CHECK(unified_diff("a", "1\n2", "1\n2").empty());
}

TEST_CASE("a changed line is printed with its context") {
    const std::string before = "1\n2\n3\n4\n5\n6\n7\n8\n9\n";
    const std::string after = "1\n2\n3\n4\nfive\n6\n7\n8\n9\n";
    CHECK(unified_diff("a.lsys", before, after) ==
          "--- a.lsys\n+++ a.lsys\n@@ -2,7 +2,7 @@\n 2\n 3\n 4\n-5\n+five\n 6\n 7\n 8\n");
}

TEST_CASE("distant changes are separate hunks, near changes are one") {
    std::string before;
    for (int i = 1; i <= 30; ++i) {
        before += std::to_string(i) + "\n";
    }
    std::string after = before;
    after.replace(after.find("3\n"), 2, "");
    after.replace(after.find("\n20\n"), 4, "\n20\nnew\n");
    const std::string diff = unified_diff("a", before, after);
    CHECK(diff.find("@@ -1,6 +1,5 @@\n 1\n 2\n-3\n 4\n 5\n 6\n@@ -18,6 +17,7 @@\n 18\n 19\n 20\n"
                    "+new\n 21\n 22\n 23\n") != std::string::npos);
    const std::string near = unified_diff("a", "1\n2\n3\n4\n5\n", "x\n2\n3\n4\ny\n");
    CHECK(near == "--- a\n+++ a\n@@ -1,5 +1,5 @@\n-1\n+x\n 2\n 3\n 4\n-5\n+y\n");
}

TEST_CASE("a missing line end at the end of a text is noted") {
    CHECK(unified_diff("a", "1", "2\n") ==
          "--- a\n+++ a\n@@ -1 +1 @@\n-1\n\\ No newline at end of file\n+2\n");
    CHECK(unified_diff("a", "", "1\n") == "--- a\n+++ a\n@@ -0,0 +1 @@\n+1\n");
}
