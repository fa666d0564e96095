// SPDX-License-Identifier: MIT
#include "tests/reference/match.h"

namespace lsys::reference {

namespace {

bool agrees(const ModulePattern& pattern, const Module& module, Bindings& bindings) {
    if (pattern.name != module.name || pattern.formals.size() != module.values.size()) {
        return false;
    }
    for (std::size_t i = 0; i < pattern.formals.size(); ++i) {
        bindings[pattern.formals[i]] = module.values[i];
    }
    return true;
}

// The position just after the branch that begins with the `[` at `at`; the end of the word if no
// `]` closes it.
std::size_t after_branch(const Word& word, std::size_t at) {
    std::size_t depth = 0;
    for (; at < word.size(); ++at) {
        if (word[at].name == "[") {
            ++depth;
        } else if (word[at].name == "]") {
            --depth;
            if (depth == 0) {
                return at + 1;
            }
        }
    }
    return at;
}

// Moves `at` from a `]` to its `[`; returns false if there is none.
bool before_branch(const Word& word, std::size_t& at) {
    std::size_t depth = 0;
    for (std::size_t i = at + 1; i-- > 0;) {
        if (word[i].name == "]") {
            ++depth;
        } else if (word[i].name == "[") {
            --depth;
            if (depth == 0) {
                at = i;
                return true;
            }
        }
    }
    return false;
}

// Matches the pattern from its last module to its first along the path from `position` to the root.
bool matches_left(const Pattern& pattern,
                  const Word& word,
                  std::size_t position,
                  const std::set<std::string>& ignored,
                  Bindings& bindings) {
    std::size_t end = position; // word[end - 1] is the next module towards the root
    for (std::size_t i = pattern.size(); i-- > 0;) {
        while (true) {
            if (end == 0) {
                return false;
            }
            if (word[end - 1].name == "]") { // a finished branch is not on the path
                std::size_t bracket = end - 1;
                if (!before_branch(word, bracket)) {
                    return false;
                }
                end = bracket;
            } else if (word[end - 1].name == "[" || ignored.count(word[end - 1].name) != 0) {
                --end;
            } else {
                break;
            }
        }
        if (!agrees(pattern[i], word[end - 1], bindings)) {
            return false;
        }
        --end;
    }
    return true;
}

// The position of the `]` of the pattern that closes the `[` at `open`.
std::size_t closing(const Pattern& pattern, std::size_t open) {
    std::size_t depth = 0;
    std::size_t i = open;
    for (;; ++i) {
        if (pattern[i].name == "[") {
            ++depth;
        } else if (pattern[i].name == "]") {
            --depth;
            if (depth == 0) {
                return i;
            }
        }
    }
}

// Matches pattern[first] to pattern[last - 1] along the axis, from the position `at` on.
bool matches_axis(const Pattern& pattern,
                  std::size_t first,
                  std::size_t last,
                  const Word& word,
                  std::size_t at,
                  const std::set<std::string>& ignored,
                  Bindings& bindings) {
    while (first < last) {
        while (at < word.size() && ignored.count(word[at].name) != 0) {
            ++at;
        }
        if (pattern[first].name == "[") { // the next module must begin a branch
            if (at == word.size() || word[at].name != "[") {
                return false;
            }
            const std::size_t close = closing(pattern, first);
            if (!matches_axis(pattern, first + 1, close, word, at + 1, ignored, bindings)) {
                return false;
            }
            at = after_branch(word, at);
            first = close + 1;
        } else if (at == word.size() || word[at].name == "]") { // the axis ends here
            return false;
        } else if (word[at].name == "[") { // skip a branch that is not in the pattern
            at = after_branch(word, at);
        } else {
            if (!agrees(pattern[first], word[at], bindings)) {
                return false;
            }
            ++at;
            ++first;
        }
    }
    return true;
}

} // namespace

bool matches_around(const Production& production,
                    const Word& word,
                    std::size_t position,
                    const std::set<std::string>& ignored,
                    Bindings& bindings) {
    const std::size_t length = production.predecessor.size();
    if (word.size() - position < length) {
        return false;
    }
    for (std::size_t i = 0; i < length; ++i) { // neighbours: none may be skipped
        if (!agrees(production.predecessor[i], word[position + i], bindings)) {
            return false;
        }
    }
    if (production.left && !matches_left(*production.left, word, position, ignored, bindings)) {
        return false;
    }
    if (production.right) {
        const Pattern& right = *production.right;
        return matches_axis(right, 0, right.size(), word, position + length, ignored, bindings);
    }
    return true;
}

} // namespace lsys::reference
