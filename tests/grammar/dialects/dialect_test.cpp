// SPDX-License-Identifier: MIT
// The table of dialects: its columns, and the functions that read them.
#include "grammar/dialects/dialect.h"

#include <catch2/catch.hpp>

#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

using namespace lsys;

TEST_CASE("a dialect is found by its name") {
    std::set<std::string_view> names;
    for (const DialectRow& row : dialects()) {
        CHECK(names.insert(row.name).second);
        CHECK(find_dialect(row.name) == row.dialect);
        CHECK(&row_of(row.dialect) == &row);
    }
    CHECK(names.size() == 11);
    CHECK(dialects().front().dialect == Dialect::Lsys);
    CHECK(!find_dialect("none"));
    CHECK(!find_dialect(""));
}

TEST_CASE("the extension of a file determines the dialect if its text does not") {
    for (const DialectRow& row : dialects()) {
        std::istringstream extensions{std::string(row.extensions)};
        for (std::string extension; extensions >> extension;) {
            INFO(extension);
            CHECK(detect_dialect("plant" + extension, "").dialect == row.dialect);
        }
    }
    CHECK(!detect_dialect("plant", "").dialect);
    CHECK(!detect_dialect("plant.txt", "F\n").dialect);
}

TEST_CASE("the dialect of a text is recognised") {
    struct DialectCase {
        std::string path;
        std::string text;
        Dialect dialect;
    };
    const std::vector<DialectCase> texts{
        {"a", "\n LSYSTEM\n1\nA\n", Dialect::Sys},
        {"a", "premise: A\nA=FA\n", Dialect::Houdini},
        {"a.txt", "A\nA=FA\n", Dialect::Houdini},
        {"a.rules", "A\nA=FA\n", Dialect::Carey},
        {"a", "axiom: A\nangle: 30\nA=FA\n", Dialect::Carey},
        {"a.txt", "axiom: A\nangle: 30\nA -> FA\n", Dialect::Abop},
        {"a.l", "n=2\n\u03C9 : A\np1 : A \u2192 FA\n", Dialect::Abop},
        {"a.ls", "axiom: A\nA=FA\n", Dialect::Abop},
        {"a.txt", "Axiom: A\nproduction:\nA --> FA\nendlsystem\n", Dialect::Lpy},
        {"a.ls", "3\n90\n5\nA\nA=FA\n@\n", Dialect::Lparser},
        {"a.ls", "recursion 3\naxiom A\nangle 20\nrule A = FA\n", Dialect::Lparser},
        {"a.l", "3\n90\n5\nA\nA=FA\n@\n", Dialect::L3d},
        {"a.l", "#include <lpfgall.h>\nmodule A();\n", Dialect::Lsys},
        {"a.ls", "lsystem one {\n axiom : F;\n r: F -> FF;\n}\n", Dialect::Lsys},
        {"a.json", "{\n\"axiom\": \"F\"\n}\n", Dialect::Lsys},
        {"a.l", "Lsystem: 1\nAxiom: A\n", Dialect::Cpfg},
        {"a.l", "one { axiom A }\n", Dialect::Fractint},
        {"a.txt", "3 90 5\nA\nA=FA\n@\n", Dialect::L3d},
        {"a.l++", "3 90 5\nA\nA=FA\n@\n", Dialect::Lplus},
        {"a.txt", "#n = 1;\n#w : F;\n", Dialect::Lsys},
        {"stdin", "#w: F;", Dialect::Lsys},
        {"a.lsys", "3 90 5\nA\nA=FA\n@\n", Dialect::Lsys},
    };
    for (const DialectCase& sample : texts) {
        INFO(sample.path << " " << sample.text);
        CHECK(detect_dialect(sample.path, sample.text).dialect == sample.dialect);
    }
}

TEST_CASE("files of one dialect may hold several systems") {
    for (const DialectRow& row : dialects()) {
        const bool is_collection = row.dialect == Dialect::Fractint || row.dialect == Dialect::Cpfg;
        CHECK(has_systems(row.dialect) == is_collection);
    }
    CHECK(systems_in(Dialect::Cpfg, "Lsystem: 1\nAxiom: A\nendlsystem\nLsystem : main \n") ==
          std::vector<std::string>{"1", "main"});
    CHECK(systems_in(Dialect::Fractint, "one { }\ntwo { }\n") ==
          std::vector<std::string>{"one", "two"});
}
