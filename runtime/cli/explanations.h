// The explanations of diagnostics, grammar/explanations.md, which is part of the program. Read by
// `lsc explain` and by the test that runs every example.
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
    bool right = false;     // else wrong
    bool is_sketch = false; // not to be run
    std::string arguments;  // of `lsc`; empty: `check`
    /// Name and text of the grammar, `example.lsys`, and of what stands beside it.
    std::vector<std::pair<std::string, std::string>> files;
};

struct Explanation {
    std::string code;
    std::string text; // paragraphs
    std::vector<Example> examples;
};

/// All of `markdown`, in its order; its head says which form it has.
[[nodiscard]] std::vector<Explanation> parse_explanations(std::string_view markdown);

} // namespace lsys::lsc
