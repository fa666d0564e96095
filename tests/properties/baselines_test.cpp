// SPDX-License-Identifier: MIT
// The benchmark systems W1 to W6: counts of modules and of each symbol, and digests, as computed by
// several independent programs.
#include "tests/support/lsc_run.h"
#include "tests/support/sha256.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace {

using lsys::tests::LscRun;
using lsys::tests::run_lsc;
using lsys::tests::sha256;

constexpr const char* kW1 = "#set names letters; #w : F; #p : F : * : F+F-F-F+F;";
constexpr const char* kW2 = "#set names letters; #w : X;"
                            "#p : X : * : F-[[X]+X]+F[+FX]-X; #q : F : * : FF;";
constexpr const char* kW3 =
    "#w : !(1.4)F(2)/(45)A;"
    "#p : A : * : !(1.4)F(2)[&(22.5)F(2)A]/(112.5)[&(22.5)F(2)A]/(157.5)[&(22.5)F(2)A];"
    "#q : F(l) : * : F(l*1.1); #r : !(w) : * : !(w*1.4);";
constexpr const char* kW4 = "#set names letters; #w : F;"
                            "#p : F : ~ 0.33 : F[+F]F[-F]F; #q : F : ~ 0.33 : F[+F]F;"
                            "#r : F : ~ 0.34 : F[-F]F;";
constexpr const char* kW5 =
    "#w : A(12);"
    "#p : A(x) : x > 0 : F(1)[+(30)A(x-1)][-(30)A(x-1)]A(x-1); #q : A(x) : x <= 0 : F(1);";

std::string w6() {
    return "#set names letters; #module a; #module b; #w : b" + std::string(100'000, 'a') +
           "; #p : b < a : * : b; #q : b : * : a;";
}

std::string dump(const std::string& grammar, std::vector<std::string> options) {
    options.insert(options.begin(), {"dump", "-", "--quiet"});
    const LscRun run = run_lsc(options, grammar);
    INFO(run.err);
    CHECK(run.status == 0);
    return run.out;
}

/// The names of the modules of a word as text, without parameters and blanks.
std::string symbols(const std::string& word) {
    std::string names;
    int depth = 0;
    for (const char c : word) {
        depth += c == '(' ? 1 : 0;
        if (depth == 0 && c != ' ' && c != '\n') {
            names += c;
        }
        depth -= c == ')' ? 1 : 0;
    }
    return names;
}

std::map<char, std::ptrdiff_t> count_symbols(const std::string& word) {
    std::map<char, std::ptrdiff_t> counts;
    for (const char c : symbols(word)) {
        ++counts[c];
    }
    return counts;
}

std::string digest(const std::string& grammar, const char* n) {
    return sha256(symbols(dump(grammar, {"-n", n}))).substr(0, 32);
}

} // namespace

TEST_CASE("the digest is SHA-256") {
    CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(sha256(std::string(1'000'000, 'a')) ==
          "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("the benchmark systems have the known numbers of modules") {
    CHECK(dump(kW1, {"-n", "9", "--all", "--count"}) ==
          "1\n9\n49\n249\n1249\n6249\n31249\n156249\n781249\n3906249\n");
    CHECK(dump(kW2, {"-n", "9", "--all", "--count"}) ==
          "1\n18\n89\n379\n1551\n6263\n25159\n100839\n403751\n1615783\n");
    CHECK(dump(kW3, {"-n", "11", "--all", "--count"}) ==
          "4\n22\n76\n238\n724\n2182\n6556\n19678\n59044\n177142\n531436\n1594318\n");
    CHECK(dump(kW5, {"-n", "13", "--all", "--count"}) ==
          "1\n10\n37\n118\n361\n1090\n3277\n9838\n29521\n88570\n265717\n797158\n2391481\n"
          "2391481\n");
}

TEST_CASE("the benchmark systems have the known symbols") {
    using Counts = std::map<char, std::ptrdiff_t>;
    CHECK(count_symbols(dump(kW1, {"-n", "9"})) ==
          Counts{{'F', 1'953'125}, {'+', 976'562}, {'-', 976'562}});
    CHECK(count_symbols(dump(kW2, {"-n", "9"})) == Counts{{'F', 392'448},
                                                          {'X', 262'144},
                                                          {'+', 262'143},
                                                          {'-', 174'762},
                                                          {'[', 262'143},
                                                          {']', 262'143}});
    CHECK(count_symbols(dump(kW3, {"-n", "11"})) == Counts{{'A', 177'147},
                                                           {'F', 354'293},
                                                           {'!', 88'574},
                                                           {'/', 177'147},
                                                           {'&', 265'719},
                                                           {'[', 265'719},
                                                           {']', 265'719}});
    CHECK(count_symbols(dump(kW5, {"-n", "13"})) ==
          Counts{{'F', 797'161}, {'+', 265'720}, {'-', 265'720}, {'[', 531'440}, {']', 531'440}});
}

TEST_CASE("the benchmark systems have the known digests") {
    CHECK(digest(kW1, "3") == "0ef8b324d3022d6c33cbbdcb432ebb30");
    CHECK(digest(kW1, "6") == "1b03e523a38979fb44a2722e772c2819");
    CHECK(digest(kW2, "3") == "7de7061203f8f4363bbf7148f30aefa0");
    CHECK(digest(kW3, "3") == "9adb87e399d85a2efbc8de39365e50e8");
    CHECK(digest(kW5, "3") == "40a7c922909e04cf82378de93a40982e");
}

TEST_CASE("the signal of W6 moves one module per generation") {
    const std::string grammar = w6();
    std::string counts;
    for (int i = 0; i <= 9; ++i) {
        counts += "100001\n";
    }
    CHECK(dump(grammar, {"-n", "9", "--all", "--count"}) == counts);
    for (const std::size_t n : {0U, 1U, 9U, 60U}) {
        const std::string word = symbols(dump(grammar, {"-n", std::to_string(n)}));
        CHECK(word.size() == 100'001);
        CHECK(word.find('b') == n);
        CHECK(std::count(word.begin(), word.end(), 'b') == 1);
    }
}

TEST_CASE("words of the stochastic W4 have balanced brackets and a turn per branch") {
    for (const char* seed : {"0", "1", "2"}) {
        std::map<char, std::ptrdiff_t> counts =
            count_symbols(dump(kW4, {"-n", "8", "--seed", seed}));
        CHECK(counts['['] == counts[']']);
        CHECK(counts['+'] + counts['-'] == counts['[']);
        CHECK(counts['F'] > counts['[']);
    }
}
