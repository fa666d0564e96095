// SPDX-License-Identifier: MIT
// `lsc fmt` on files with byte order marks and with CRLF line ends.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <string>

using lsys::tests::LscRun;
using lsys::tests::read_text;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;
using lsys::tests::write_text;

TEST_CASE("fmt keeps a byte order mark and the line ends of a file") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
        for (const std::string end : {"\n", "\r\n"}) {
            const std::string laid_out =
                mark + "#n = 1;" + end + "#w : F;  // axiom" + end + "#p : F : * : F F;" + end;
            write_text(file, mark + "#n=1;" + end + "#w:F; // axiom" + end + "#p:F:*:F  F;" + end);
            CHECK(run_lsc({"fmt", "--check", file}, "").status == 1);
            CHECK(run_lsc({"fmt", file}, "").status == 0);
            CHECK(read_text(file) == laid_out);
            CHECK(run_lsc({"fmt", "--check", file}, "").status == 0);
            CHECK(run_lsc({"fmt", "-"}, laid_out).out == laid_out);
        }
    }
}
