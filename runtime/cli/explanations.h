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

/// A grammar of an explanation.
struct Example {
    bool right = false;     // a correct grammar; else a wrong one
    bool is_sketch = false; // not to be run
    std::string arguments;  // of `lsc`; `check` if empty
    /// Name and text of the grammar, `example.lsys`, and of the files beside it.
    std::vector<std::pair<std::string, std::string>> files;
};

struct Explanation {
    std::string code;
    std::string text; // paragraphs
    std::vector<Example> examples;
};

/// The explanations of `markdown` in order. The head of grammar/explanations.md describes the
/// format.
[[nodiscard]] std::vector<Explanation> parse_explanations(std::string_view markdown);

} // namespace lsys::lsc
