// SPDX-License-Identifier: MIT
// The explanations of diagnostics, grammar/explanations.md, compiled into the program. Used by `lsc
// explain` and the test that runs all examples.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys::lsc {

/// The text of grammar/explanations.md.
[[nodiscard]] std::string_view explanations_text();

/// An example grammar of an explanation.
struct Example {
    bool is_correct = false; // false: the example has the mistake
    bool is_sketch = false;  // too incomplete to be run by the test
    std::string arguments;   // command line of `lsc`; `check` if empty
    /// Names and texts of the grammar, `example.lsys`, and of the files that it needs.
    std::vector<std::pair<std::string, std::string>> files;
};

struct Explanation {
    std::string code;
    std::string text; // paragraphs, separated by blank lines
    std::vector<Example> examples;
};

/// The explanations of `markdown` in order. The head of grammar/explanations.md describes the
/// format.
[[nodiscard]] std::vector<Explanation> parse_explanations(std::string_view markdown);

} // namespace lsys::lsc
