// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/splitting.h"

#include "grammar/base/cancellation.h"

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

/// Per NameId: whether a module of the Ast has this name.
std::vector<std::uint8_t> names_of_modules(const Resolution& resolution) {
    std::vector<std::uint8_t> used(resolution.names.count());
    const ChunkedVector<ModuleNode>& modules = resolution.ast.modules;
    for (std::size_t first = 0; first < modules.size();) {
        stop_if_cancelled();
        const std::span<const ModuleNode> row = modules.row(first, modules.size() - first);
        for (const ModuleNode& module : row) {
            used[index_of(module.name())] = 1;
        }
        first += row.size();
    }
    return used;
}

} // namespace

NameSplitter::NameSplitter(Resolution& resolution, const std::vector<bool>& known)
    : resolution_(resolution), unknown_(resolution.names.count()) {
    bool may_split = false;
    const std::vector<std::uint8_t> used = names_of_modules(resolution);
    for (std::size_t name = 0; name < used.size(); ++name) {
        const std::string_view text = resolution.text(static_cast<NameId>(name));
        if (used[name] != 0 && !known[name] && is_identifier(text)) {
            unknown_[name] = true;
            may_split = may_split || text.size() > 1;
        }
    }
    if (!may_split) {
        unknown_.assign(unknown_.size(), false);
        return;
    }
    for (std::size_t name = 0; name < known.size(); ++name) {
        const std::string_view text = resolution.text(static_cast<NameId>(name));
        if (known[name] && is_identifier(text)) {
            known_sorted_.push_back(text);
        }
    }
    std::sort(known_sorted_.begin(), known_sorted_.end());
    collect_uses();
}

void NameSplitter::collect_uses() {
    for (const Statement& statement : resolution_.ast.statements) {
        if (statement.kind == StatementKind::Axiom) {
            add_uses(resolution_.ast.axioms[statement.index].modules);
        } else if (statement.kind == StatementKind::Production) {
            const ProductionNode& production = resolution_.ast.productions[statement.index];
            add_uses(production.left);
            add_uses(production.right);
            add_uses(production.successor);
        }
    }
}

void NameSplitter::add_uses(ModuleList list) {
    ModuleCursor cursor(resolution_.ast, resolution_.names, resolution_.sources, list);
    for (; !cursor.done(); cursor.next()) {
        stop_if_cancelled();
        if (unknown_[index_of(cursor.name())]) {
            const ModuleView module = cursor.view();
            uses_.insert({module.name, module.arguments.count, module.name_span.file});
            use_lengths_.insert(resolution_.text(module.name).size());
        }
    }
}

std::span<const NamePart>
NameSplitter::parts(NameId name, std::uint32_t parameter_count, FileId file) {
    if (!unknown_[index_of(name)]) {
        return {};
    }
    const Use whole{name, parameter_count, file};
    const auto [found, is_new] = splits_.try_emplace(whole);
    std::vector<NamePart>& parts = found->second;
    if (is_new) {
        parts = split(whole); // recursive: may invalidate `found`, not `parts`
    }
    return parts;
}

template <typename Function>
void NameSplitter::for_each_known_prefix(std::string_view text, Function found) {
    // [first, last) are the known names that begin with the first `length` characters.
    auto first = known_sorted_.cbegin();
    auto last = known_sorted_.cend();
    for (std::size_t length = 0; length < text.size() && work_left_ > 0; --work_left_) {
        if (first != last && first->size() == length) {
            ++first;
        }
        if (first == last) {
            return;
        }
        const char next = text[length];
        // If the first and last of the sorted names have character `next`, all have it, and no
        // search is needed.
        if ((*first)[length] != next || (*(last - 1))[length] != next) {
            first = std::lower_bound(first, last, next, [length](std::string_view name, char c) {
                return name[length] < c;
            });
            last = std::upper_bound(first, last, next, [length](char c, std::string_view name) {
                return c < name[length];
            });
            if (first == last) {
                return;
            }
        }
        ++length;
        if (first->size() == length) {
            found(length);
        }
    }
}

std::vector<NamePart> NameSplitter::split(const Use& whole) {
    const std::string_view text = resolution_.text(whole.name);
    // ways[i]: number of ways, up to two, to split the first i characters into known names;
    // from[i]: offset of the last of these names.
    std::vector<std::uint8_t> ways(text.size() + 1);
    std::vector<std::uint32_t> from(text.size() + 1);
    ways[0] = 1;
    const auto add = [&](std::size_t begin, std::size_t end) {
        ways[end] = static_cast<std::uint8_t>(std::min(2, ways[end] + ways[begin]));
        from[end] = static_cast<std::uint32_t>(begin);
    };
    for (std::size_t begin = 0; begin < text.size(); ++begin) {
        if (ways[begin] == 0) {
            continue;
        }
        for_each_known_prefix(text.substr(begin),
                              [&](std::size_t length) { add(begin, begin + length); });
        const std::size_t length = text.size() - begin;
        if (begin == 0 || work_left_ < length || !use_lengths_.contains(length)) {
            continue;
        }
        // The last part may also be an unknown name, if the name stands alone elsewhere in the file
        // and is not split there.
        work_left_ -= length;
        const NameId rest = resolution_.names.find(text.substr(begin));
        if (rest != kNoName && unknown_[index_of(rest)] &&
            uses_.contains({rest, whole.parameter_count, whole.file}) &&
            parts(rest, whole.parameter_count, whole.file).empty()) {
            add(begin, text.size());
        }
    }
    std::vector<NamePart> parts;
    if (ways[text.size()] != 1) {
        return parts;
    }
    for (std::size_t end = text.size(); end > 0; end = from[end]) {
        const std::string_view part = text.substr(from[end], end - from[end]);
        parts.push_back({resolution_.names.intern(part), from[end]});
    }
    std::reverse(parts.begin(), parts.end());
    return parts;
}

} // namespace lsys
