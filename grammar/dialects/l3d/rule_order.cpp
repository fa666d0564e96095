// SPDX-License-Identifier: MIT
#include "grammar/dialects/l3d/rule_order.h"

#include "grammar/ast/reports.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace lsys {

namespace {

constexpr std::size_t kMaxKeys = 256;                  // max number of left sides
constexpr std::size_t kMaxText = std::size_t{1} << 16; // max characters of a word
constexpr std::size_t kMaxWork = std::size_t{1} << 20; // max characters read in one derivation
// Number of derivations to compare, each with other choices, if a key has several values.
constexpr std::uint32_t kChoices = 8;

/// A key and its values.
struct Key {
    std::string_view text;
    SourceSpan span; // first rule with this key
    std::vector<std::string_view> values;
};

/// Indices of keys, in the order in which a generation applies the rules of the keys.
using Order = std::vector<std::size_t>;

std::vector<Key> keys_of(const std::vector<L3dRule>& rules, const SourceMap& sources) {
    std::vector<Key> keys;
    std::map<std::string_view, std::size_t> numbers;
    for (const L3dRule& rule : rules) {
        const std::string_view text = sources.text(rule.key);
        const auto [at, is_new] = numbers.emplace(text, keys.size());
        if (is_new) {
            keys.push_back({text, rule.key, {}});
        }
        keys[at->second].values.push_back(sources.text(rule.value));
    }
    return keys;
}

/// The text with each `key` replaced by `value`.
std::string replaced(const std::string& text, std::string_view key, std::string_view value) {
    std::string out;
    std::size_t at = 0;
    for (std::size_t found = text.find(key); found != std::string::npos;
         found = text.find(key, at)) {
        out.append(text, at, found - at).append(value);
        at = found + key.size();
    }
    return out.append(text, at);
}

class Comparison {
public:
    Comparison(std::vector<Key> keys, std::string_view axiom, std::uint32_t generations)
        : keys_(std::move(keys)), axiom_(axiom), generations_(generations) {}

    [[nodiscard]] const Key& key(std::size_t number) const { return keys_[number]; }

    /// The first generation in which orders `a` and `b` give different words; nullopt if none does
    /// within the limits.
    [[nodiscard]] std::optional<std::uint32_t>
    first_difference(const Order& a, const Order& b, std::uint32_t choice) const {
        std::string first(axiom_);
        std::string second(axiom_);
        std::size_t work = 0;
        for (std::uint32_t i = 1; i <= generations_ && work < kMaxWork; ++i) {
            const std::string before = first;
            if (!rewrite(a, i, choice, first, work) || !rewrite(b, i, choice, second, work)) {
                return std::nullopt;
            }
            if (first != second) {
                return i;
            }
            if (first == before && !has_choice()) {
                return std::nullopt; // the word is a fixed point, so later words are equal too
            }
        }
        return std::nullopt;
    }

    [[nodiscard]] bool has_choice() const {
        return std::ranges::any_of(keys_, [](const Key& key) { return key.values.size() > 1; });
    }

private:
    /// Rewrites `text` once; returns false if it exceeds kMaxText.
    bool rewrite(const Order& order,
                 std::uint32_t generation,
                 std::uint32_t choice,
                 std::string& text,
                 std::size_t& work) const {
        for (const std::size_t number : order) {
            const Key& key = keys_[number];
            work += text.size() + 1;
            text = replaced(
                text, key.text,
                key.values[(std::size_t{generation} * choice + number) % key.values.size()]);
            if (text.size() > kMaxText) {
                return false;
            }
        }
        return true;
    }

    std::vector<Key> keys_;
    std::string_view axiom_;
    std::uint32_t generations_;
};

/// The swaps that an insertion sort of `order` makes, in sequence; a swap is the index of the first
/// of two neighbours.
std::vector<std::size_t> swaps_of_sort(Order order) {
    std::vector<std::size_t> places;
    for (std::size_t i = 1; i < order.size(); ++i) {
        for (std::size_t k = i; k > 0 && order[k - 1] > order[k]; --k) {
            std::swap(order[k - 1], order[k]);
            places.push_back(k - 1);
        }
    }
    return places;
}

/// The order after the first `count` of the swaps `places`.
Order exchanged(Order order, const std::vector<std::size_t>& places, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        std::swap(order[places[i]], order[places[i] + 1]);
    }
    return order;
}

} // namespace

void report_rule_order(const std::vector<L3dRule>& rules,
                       std::string_view axiom,
                       std::uint32_t generations,
                       const ParseContext& context) {
    std::vector<Key> keys = keys_of(rules, context.sources);
    if (keys.size() > kMaxKeys) {
        return;
    }
    Order sorted(keys.size());
    std::iota(sorted.begin(), sorted.end(), std::size_t{0});
    const Order by_line = sorted;
    std::ranges::sort(sorted,
                      [&](std::size_t a, std::size_t b) { return keys[a].text < keys[b].text; });
    if (sorted == by_line) {
        return;
    }
    const Comparison comparison(std::move(keys), axiom, generations);
    std::optional<std::uint32_t> generation;
    std::uint32_t choice = 0;
    for (; choice < (comparison.has_choice() ? kChoices : 1); ++choice) {
        if (generation = comparison.first_difference(sorted, by_line, choice); generation) {
            break;
        }
    }
    if (!generation) {
        return;
    }
    // Bisection finds a swap between the two orders that changes the word.
    const std::vector<std::size_t> places = swaps_of_sort(sorted);
    std::size_t same = 0;                // number of swaps after which the words are equal
    std::size_t differs = places.size(); // number of swaps after which a word differs
    while (differs - same > 1) {
        const std::size_t middle = same + (differs - same) / 2;
        const Order order = exchanged(sorted, places, middle);
        (comparison.first_difference(sorted, order, choice) ? differs : same) = middle;
    }
    const Order order = exchanged(sorted, places, same);
    const Key& early = comparison.key(order[places[same]]);
    const Key& late = comparison.key(order[places[same] + 1]);
    Diagnostic& note = context.diagnostics.add(
        DiagnosticCode::RuleOrder, early.span,
        "`" + shown(early.text) + "` is replaced before `" + shown(late.text) +
            "`, whose line comes first; in the order of the lines, generation " +
            std::to_string(*generation) + " would be a different word");
    note.labels.push_back({late.span, "replaced later, as L3D sorts its rules by these texts"});
    note.help.emplace_back("for the order of the lines, `lsc import` the file and put the "
                           "productions into that order");
}

} // namespace lsys
