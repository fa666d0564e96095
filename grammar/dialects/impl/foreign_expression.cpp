// SPDX-License-Identifier: MIT
#include "grammar/dialects/impl/foreign_expression.h"

#include <algorithm>
#include <map>
#include <utility>

namespace lsys {

namespace {

/// Precedence levels in .lsys, from loose to tight.
enum Level : std::uint8_t { Any, Or, And, Equal, Compare, Sum, Product, Sign, Power, Single };

Level level_of(const ForeignNode& node) {
    if (node.kind == ForeignKind::Unary) {
        return Sign;
    }
    if (node.kind != ForeignKind::Binary) {
        return Single;
    }
    switch (node.text[0]) {
    case '|':
        return Or;
    case '&':
        return And;
    case '=':
    case '!':
        return Equal;
    case '<':
    case '>':
        return Compare;
    case '+':
    case '-':
        return Sum;
    case '^':
        return Power;
    default:
        return Product;
    }
}

/// The loosest left operand that needs no parentheses. A comparison as an operand of another
/// comparison needs them.
Level left_level(Level level) {
    return level == Equal || level == Compare ? Sum : level == Power ? Single : level;
}
/// The loosest right operand that needs no parentheses.
Level right_level(Level level) {
    return level == Equal || level == Compare ? Sum
           : level == Power                   ? Power
                                              : static_cast<Level>(level + 1);
}

} // namespace

/// A part to be written: a node, or a text with its place.
struct ForeignExpressions::Item {
    ForeignId node = kNoForeign;
    Level loosest = Any; // the loosest operator that needs no parentheses here
    bool leads = true;   // stands at the beginning, where a sign needs no parentheses
    std::string_view text{};
    SourceSpan span{};
    bool is_operator = false; // written between blanks
};

ForeignId ForeignExpressions::add(ForeignNode node) {
    for (const ForeignId part : node.parts) {
        node.depth = std::max(node.depth, (*this)[part].depth + 1);
    }
    nodes_.push_back(std::move(node));
    return static_cast<ForeignId>(nodes_.size() - 1);
}

ForeignId ForeignExpressions::number(std::string_view text, SourceSpan span) {
    if (text.starts_with('-')) {
        return unary("-", number(text.substr(1), span), span);
    }
    return add(
        {.kind = ForeignKind::Number, .text = std::string(text), .span = span, .token = span});
}

ForeignId ForeignExpressions::name(std::string_view text, SourceSpan span) {
    return add({.kind = ForeignKind::Name, .text = std::string(text), .span = span, .token = span});
}

ForeignId ForeignExpressions::unary(std::string_view operation, ForeignId a, SourceSpan token) {
    return add({.kind = ForeignKind::Unary,
                .text = std::string(operation),
                .parts = {a},
                .span = token,
                .token = token});
}

ForeignId
ForeignExpressions::binary(std::string_view operation, ForeignId a, ForeignId b, SourceSpan token) {
    return add({.kind = ForeignKind::Binary,
                .text = std::string(operation),
                .parts = {a, b},
                .span = token,
                .token = token});
}

ForeignId ForeignExpressions::call(std::string_view function,
                                   std::vector<ForeignId> arguments,
                                   SourceSpan token) {
    return add({.kind = ForeignKind::Call,
                .text = std::string(function),
                .parts = std::move(arguments),
                .span = token,
                .token = token});
}

ForeignId ForeignExpressions::range(ForeignId low, ForeignId high, SourceSpan token) {
    return add({.kind = ForeignKind::Range, .parts = {low, high}, .span = token, .token = token});
}

ForeignId ForeignExpressions::draw(std::uint32_t index, SourceSpan span) {
    return add({.kind = ForeignKind::Draw, .span = span, .token = span, .index = index});
}

ForeignId ForeignExpressions::local(ForeignLocal local) {
    const SourceSpan span = local.span;
    locals_.push_back(std::move(local));
    return add({.kind = ForeignKind::Local,
                .span = span,
                .token = span,
                .index = static_cast<std::uint32_t>(locals_.size() - 1)});
}

void ForeignExpressions::count_reads(std::span<const ForeignId> roots,
                                     std::span<const ForeignId> expanded,
                                     std::size_t first) {
    const auto count = [&](ForeignId root) {
        for (const ForeignId id : subtree(root)) {
            const ForeignNode& node = (*this)[id];
            if (node.kind == ForeignKind::Local) {
                ++locals_[node.index].reads;
            }
        }
    };
    for (const ForeignId root : roots) {
        count(root);
    }
    for (const ForeignId root : expanded) {
        static_cast<void>(has(root, [&](const ForeignNode& node) {
            if (node.kind == ForeignKind::Local && locals_[node.index].is_constant) {
                ++locals_[node.index].reads;
            }
            return false;
        }));
    }
    for (std::size_t i = locals_.size(); i-- > first;) { // a value reads only earlier ones
        ForeignLocal& local = locals_[i];
        if (local.reads != 0) {
            local.is_inline = local.is_inline || (local.reads == 1 && !local.is_final);
            count(local.value);
        }
    }
}

void ForeignExpressions::name_locals(std::size_t first,
                                     std::size_t end,
                                     std::set<std::string>& taken) {
    for (const bool final : {true, false}) { // the last value of a variable keeps its name
        for (std::size_t i = first; i < end; ++i) {
            if (is_written(locals_[i]) && locals_[i].is_final == final) {
                locals_[i].name = unique_name(locals_[i].name, taken);
            }
        }
    }
}

std::string_view ForeignExpressions::literal(ForeignId id) const {
    const ForeignNode* node = &(*this)[id];
    while (node->kind == ForeignKind::Local) {
        node = &(*this)[locals_[node->index].value];
    }
    return node->kind == ForeignKind::Number ? std::string_view(node->text) : std::string_view();
}

bool ForeignExpressions::has_draw(ForeignId root) const {
    return has(root, [](const ForeignNode& node) {
        return node.kind == ForeignKind::Draw || node.kind == ForeignKind::Range;
    });
}

std::uint64_t ForeignExpressions::expanded_size(ForeignId root) const {
    constexpr std::uint64_t kMax = std::uint64_t{1} << 32U;
    std::map<ForeignId, std::uint64_t> sizes; // sizes of the values of local values
    std::vector<ForeignId> open{root};
    while (!open.empty()) {
        const ForeignId id = open.back();
        std::uint64_t size = 0;
        const std::size_t before = open.size();
        for (const ForeignId part : subtree(id)) {
            const ForeignNode& node = (*this)[part];
            if (node.kind != ForeignKind::Local) {
                ++size;
            } else if (const auto known = sizes.find(locals_[node.index].value);
                       known != sizes.end()) {
                size = std::min(kMax, size + known->second);
            } else {
                open.push_back(locals_[node.index].value);
            }
        }
        if (open.size() == before) {
            sizes[id] = size;
            open.pop_back();
        }
    }
    return sizes[root];
}

std::vector<ForeignId> ForeignExpressions::subtree(ForeignId root) const {
    std::vector<ForeignId> all;
    std::vector<ForeignId> open{root};
    while (!open.empty()) {
        all.push_back(open.back());
        open.pop_back();
        const std::vector<ForeignId>& parts = (*this)[all.back()].parts;
        open.insert(open.end(), parts.begin(), parts.end());
    }
    std::sort(all.begin(), all.end());
    return all;
}

void ForeignExpressions::write(ForeignId root, const ForeignWriting& how, Translation& out) const {
    std::deque<Item> items{{.node = root}};
    while (!items.empty()) {
        Item item = items.back();
        items.pop_back();
        if (item.node == kNoForeign) {
            out.put(item.is_operator ? " " : "", item.span);
            out.put(item.text, item.span);
            out.put(item.is_operator ? " " : "", item.span);
            continue;
        }
        while (is_expanded((*this)[item.node], how)) {
            item.node = locals_[(*this)[item.node].index].value;
        }
        const ForeignNode& node = (*this)[item.node];
        const Level level = level_of(node);
        if (level < item.loosest || (level == Sign && !item.leads)) {
            out.put("(", node.token);
            items.push_back({.text = ")", .span = node.token});
        }
        write_node(node, how, items, out);
    }
}

void ForeignExpressions::write_node(const ForeignNode& node,
                                    const ForeignWriting& how,
                                    std::deque<Item>& items,
                                    Translation& out) const {
    const Level level = level_of(node);
    switch (node.kind) {
    case ForeignKind::Unary:
        out.put(node.text, node.token);
        items.push_back({.node = node.parts[0], .loosest = Power});
        return;
    case ForeignKind::Binary:
        items.push_back({.node = node.parts[1], .loosest = right_level(level), .leads = false});
        items.push_back({.text = node.text, .span = node.token, .is_operator = true});
        items.push_back({.node = node.parts[0], .loosest = left_level(level)});
        return;
    case ForeignKind::Draw:
        out.put(how.draws.empty() ? "{0, 1}" : std::string_view(how.draws[node.index]), node.token);
        return;
    case ForeignKind::Local:
        out.put(locals_[node.index].name, node.token);
        return;
    case ForeignKind::Call:
    case ForeignKind::Range: {
        const bool is_call = node.kind == ForeignKind::Call;
        out.put(node.text, node.token);
        out.put(is_call ? "(" : "{", node.token);
        items.push_back({.text = is_call ? ")" : "}", .span = node.token});
        for (std::size_t i = node.parts.size(); i-- > 0;) {
            items.push_back({.node = node.parts[i]});
            if (i != 0) {
                items.push_back({.text = ", ", .span = node.token});
            }
        }
        return;
    }
    default: // a number or a name
        out.put(node.text, node.token);
        return;
    }
}

void ForeignExpressions::write_locals(std::string_view before,
                                      std::size_t first,
                                      std::size_t end,
                                      const ForeignWriting& how,
                                      Translation& out) const {
    const char* begin = "let ";
    for (std::size_t i = first; i < end; ++i) {
        const ForeignLocal& local = locals_[i];
        if (is_written(local)) {
            out.put(before, local.span);
            out.put(begin + local.name + " = ", local.span);
            write(local.value, how, out);
            begin = ", ";
            before = {};
        }
    }
}

void ForeignExpressions::write_constants(std::size_t first,
                                         std::size_t end,
                                         Translation& out) const {
    for (std::size_t i = first; i < end; ++i) {
        const ForeignLocal& constant = locals_[i];
        if (is_written(constant)) {
            out.put("#define " + constant.name + " ", constant.span);
            write(constant.value, {}, out);
            out.put(";\n", constant.span);
        }
    }
}

std::string unique_name(std::string_view wanted, std::set<std::string>& taken) {
    std::string name(wanted);
    for (int i = 2; !taken.insert(name).second; ++i) {
        name = std::string(wanted) + "_" + std::to_string(i);
    }
    return name;
}

} // namespace lsys
