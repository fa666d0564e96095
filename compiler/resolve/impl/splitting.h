// SPDX-License-Identifier: MIT
// Name splitting (docs/language.md section 3): an unknown module name that is a sequence of known
// names in exactly one way is read as that sequence, `AS(1)` as `A S(1)`. The decision is made
// after all statements are parsed, from the name, the number of parameters and the file.
#pragma once

#include "compiler/resolve/impl/resolution.h"
#include "grammar/base/hash.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace lsys {

/// A part of a name and its offset in the name.
struct NamePart {
    NameId name = kNoName;
    std::uint32_t offset = 0;
};

class NameSplitter {
public:
    /// `known`, by name: predecessors, declared and bound modules, commands of the turtle profile.
    /// Precondition: no module of the Ast is released yet.
    NameSplitter(Resolution& resolution, const std::vector<bool>& known);

    /// Whether the name is an unknown identifier, which parts() may split.
    [[nodiscard]] bool may_split(NameId name) const { return unknown_[index_of(name)]; }
    /// The parts of a name, or nothing if it is one module. Precondition: not in back quotes.
    [[nodiscard]] std::span<const NamePart>
    parts(NameId name, std::uint32_t parameter_count, FileId file);

private:
    /// A use of a name in a file.
    struct Use {
        NameId name = kNoName;
        std::uint32_t parameter_count = 0;
        FileId file = kNoFile;

        friend bool operator==(const Use&, const Use&) = default;
    };
    struct UseHash {
        std::size_t operator()(const Use& use) const {
            const auto name = static_cast<std::uint64_t>(use.name);
            const auto file = static_cast<std::uint64_t>(use.file);
            return mix64(combine(name ^ file << 40, use.parameter_count));
        }
    };

    void collect_uses();
    void add_uses(ModuleList list);
    /// The parts of a name if there is exactly one way to split it, else nothing.
    [[nodiscard]] std::vector<NamePart> split(const Use& whole);
    /// Calls found(length) for every known name that `text` begins with.
    template <typename Function>
    void for_each_known_prefix(std::string_view text, Function found);

    Resolution& resolution_;
    std::vector<bool> unknown_; // per name: whether it is an unknown identifier that occurs
    std::vector<std::string_view> known_sorted_;  // known identifiers
    std::unordered_set<Use, UseHash> uses_;       // uses of unknown identifiers
    std::unordered_set<std::size_t> use_lengths_; // lengths of the names in uses_, bytes
    std::unordered_map<Use, std::vector<NamePart>, UseHash> splits_; // results of split()
    /// Characters that splitting may still compare. At 0 names that are costly to split stay whole.
    std::uint64_t work_left_ = std::uint64_t{1} << 28;
};

} // namespace lsys
