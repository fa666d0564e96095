// SPDX-License-Identifier: MIT
// Expressions of other languages as one tree. A parser adds the nodes of its file; a front end adds
// the equivalent nodes of .lsys and writes them with the place of each part in the original file.
// Nodes are numbered, children before parents. A local value is one node however often it is read,
// so each use writes only its name, and its random numbers are drawn once.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/base/source.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class ForeignId : std::uint32_t {};
inline constexpr ForeignId kNoForeign{0xFFFFFFFFU};

enum class ForeignKind : std::uint8_t {
    // --- in both languages; `text` is the literal, name, operator or function
    Number,
    Name,
    Unary,
    Binary,
    Call,
    // --- only in the other language
    Text,    // a text in quotes
    Missing, // an omitted argument
    Address, // `&name`
    Choose,  // a ? b : c
    Index,   // text: the array
    // --- only in .lsys
    Range, // {a, b}
    Draw,  // random number `index` of a production, from 0 to 1
    Local, // local value `index`
};

struct ForeignNode {
    ForeignKind kind = ForeignKind::Number;
    std::string text{};
    std::vector<ForeignId> parts{}; // operands, arguments or indices
    SourceSpan span{};              // place of the node with its operands
    SourceSpan token{};             // the operator or name
    std::uint32_t index = 0;        // Draw: which random number; Local: index in locals()
    std::uint32_t depth = 1;        // set by ForeignExpressions::add()
};

/// A value with a name: a `let` of a production or a `#define`.
struct ForeignLocal {
    std::string name{}; // proposed; ForeignExpressions::name_locals() makes it unique
    ForeignId value = kNoForeign;
    SourceSpan span{};
    bool is_final = false;    // written as a `let` even if it is read only once
    bool is_inline = false;   // the value is written in place of the name
    bool is_constant = false; // a `#define`, whose name conditions can read
    std::uint32_t reads = 0;  // reads by other written values; set by count_reads()
};

/// Options for writing the nodes of one statement.
struct ForeignWriting {
    bool expands_locals =
        false; // values replace the names of locals: a condition cannot read locals
    std::span<const std::string> draws{}; // parameters that hold the draws; empty: `{0, 1}`
};

class ForeignExpressions {
public:
    ForeignId add(ForeignNode node);
    [[nodiscard]] const ForeignNode& operator[](ForeignId id) const {
        return nodes_[static_cast<std::size_t>(id)];
    }
    [[nodiscard]] std::size_t size() const { return nodes_.size(); }

    // --- nodes of .lsys
    /// `text`: a literal, perhaps with a sign.
    ForeignId number(std::string_view text, SourceSpan span);
    ForeignId name(std::string_view text, SourceSpan span);
    ForeignId unary(std::string_view operation, ForeignId a, SourceSpan token);
    ForeignId binary(std::string_view operation, ForeignId a, ForeignId b, SourceSpan token);
    ForeignId call(std::string_view function, std::vector<ForeignId> arguments, SourceSpan token);
    ForeignId range(ForeignId low, ForeignId high, SourceSpan token);
    ForeignId draw(std::uint32_t index, SourceSpan span);
    /// Adds a local value and returns a node that reads it.
    ForeignId local(ForeignLocal local);

    // --- local values
    [[nodiscard]] std::vector<ForeignLocal>& locals() { return locals_; }
    [[nodiscard]] const std::vector<ForeignLocal>& locals() const { return locals_; }
    /// Counts how often the written expressions `roots` and other written values read each local
    /// value; a value that is read once and is not final becomes inline. In `expanded` expressions
    /// only constants keep their names. Precondition: the local values before `first` have been
    /// counted.
    void count_reads(std::span<const ForeignId> roots,
                     std::span<const ForeignId> expanded,
                     std::size_t first);
    /// Gives the written local values from `first` to `end` names that are not in `taken`, and adds
    /// the names to `taken`.
    void name_locals(std::size_t first, std::size_t end, std::set<std::string>& taken);
    [[nodiscard]] static bool is_written(const ForeignLocal& local) {
        return local.reads != 0 && !local.is_inline;
    }

    // --- queries
    /// The literal of a number, or of the number that a local value stands for; else empty.
    [[nodiscard]] std::string_view literal(ForeignId id) const;
    /// Whether the expression, with the local values that it reads, has a node for which `wanted`
    /// holds.
    template <typename Predicate>
    [[nodiscard]] bool has(ForeignId root, const Predicate& wanted) const {
        std::vector<ForeignId> open{root};
        std::set<std::uint32_t> seen_locals; // indices of local values
        while (!open.empty()) {
            const ForeignNode& node = (*this)[open.back()];
            open.pop_back();
            if (wanted(node)) {
                return true;
            }
            open.insert(open.end(), node.parts.begin(), node.parts.end());
            if (node.kind == ForeignKind::Local && seen_locals.insert(node.index).second) {
                open.push_back(locals_[node.index].value);
            }
        }
        return false;
    }
    /// Whether the expression has a random number.
    [[nodiscard]] bool has_draw(ForeignId root) const;
    /// Count of nodes written for `root` when local values are expanded, at most about 2^32.
    [[nodiscard]] std::uint64_t expanded_size(ForeignId root) const;
    /// The nodes of the expression, children before parents. A local value counts as one node; the
    /// nodes of its expression are left out.
    [[nodiscard]] std::vector<ForeignId> subtree(ForeignId root) const;

    void write(ForeignId root, const ForeignWriting& how, Translation& out) const;
    /// Writes `before` and `let a = ..., b = ...`, the local values from `first` to `end`; nothing
    /// if is_written() is false for all.
    void write_locals(std::string_view before,
                      std::size_t first,
                      std::size_t end,
                      const ForeignWriting& how,
                      Translation& out) const;
    /// Writes `#define` statements of the local values from `first` to `end`.
    void write_constants(std::size_t first, std::size_t end, Translation& out) const;

private:
    struct Item;
    void write_node(const ForeignNode& node,
                    const ForeignWriting& how,
                    std::deque<Item>& items,
                    Translation& out) const;
    /// Whether the value of a local is written in place of its name.
    [[nodiscard]] bool is_expanded(const ForeignNode& node, const ForeignWriting& how) const {
        return node.kind == ForeignKind::Local &&
               (locals_[node.index].is_inline ||
                (how.expands_locals && !locals_[node.index].is_constant));
    }

    std::deque<ForeignNode> nodes_; // a deque: millions of nodes, without spare capacity
    std::vector<ForeignLocal> locals_;
};

/// A name that is not in `taken`: `wanted`, or `wanted` and a number. Adds it to `taken`.
[[nodiscard]] std::string unique_name(std::string_view wanted, std::set<std::string>& taken);

/// The statement that defines `int(x)`, x truncated to an integer, which .lsys lacks.
inline constexpr std::string_view kIntegerPart = "#function int(x) if(x < 0, ceil(x), floor(x));\n";

} // namespace lsys
