// SPDX-License-Identifier: MIT
// The time of the year written to a scene file.
#include "runtime/scene/season.h"

#include <catch2/catch.hpp>

using namespace lsys;

namespace {
const std::string kBirch = "[[species]] # first\ngrammar = \"birch.lsys\"\nname = \"birch\"\n";
}

TEST_CASE("the season of a scene is replaced or added, and the rest of the text stays") {
    const auto text = [](const std::string& scene, float season) {
        const Result<std::string> written = with_season(scene, season);
        return written ? written.value() : "error: " + written.error().message;
    };
    CHECK(text("key = 7\nseason = 0.25 # May\n\n" + kBirch, 0.65F) ==
          "key = 7\nseason = 0.65 # May\n\n" + kBirch);
    CHECK(text("# A wood.\nkey = 7 # of the trees\n\n# The only species.\n" + kBirch, 0.1F) ==
          "# A wood.\nkey = 7 # of the trees\nseason = 0.1\n\n# The only species.\n" + kBirch);
    CHECK(text("# A wood.\n" + kBirch, 1.0F) == "# A wood.\nseason = 1\n" + kBirch);
    CHECK(text(kBirch, 0.5F) == "season = 0.5\n" + kBirch);
    CHECK(text("key = \n", 0.5F) == "error: the file is no longer valid TOML");
    CHECK(text("key = 7\n", 2.0F) == "error: `season` cannot be replaced in this file");
}
