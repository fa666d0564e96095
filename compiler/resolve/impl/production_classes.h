// SPDX-License-Identifier: MIT
// Numbers rules and groups (docs/language.md section 5). A rule is a set of productions with equal
// predecessors; a group is a set of productions of a rule with equal contexts. The hash tables
// store only production numbers and compare the productions in the Program, so that a million
// productions take a few megabytes.
#pragma once

#include "compiler/program/program.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// Finds productions with equal predecessors, and among these the productions with equal contexts.
class ProductionClasses {
public:
    explicit ProductionClasses(Program& program) : program_(program) {}

    /// Sets rule and group of the last production of the Program, numbered by first appearance.
    void classify_last();

private:
    /// The first production of each class, by hash; kNone in free slots.
    struct Table {
        std::vector<std::uint32_t> firsts = std::vector<std::uint32_t>(1024, kNone);
        std::uint32_t count = 0; // number of classes
    };
    using Hash = std::uint64_t (*)(const Production&);
    using Equal = bool (*)(const Production&, const Production&);
    /// The first production of the class that contains production `index`.
    [[nodiscard]] std::uint32_t
    first_equal(Table& table, std::uint32_t index, Hash hash, Equal equal);

    Program& program_;
    Table rules_;
    Table groups_;
};

} // namespace lsys
