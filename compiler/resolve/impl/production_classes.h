// Rules and groups (docs/language.md section 5): productions with equal predecessors, and of these
// the ones with equal contexts. Two hash tables of production numbers that look the productions up
// in the Program, so that a million of them take a few megabytes.
#pragma once

#include "compiler/program/program.h"

#include <cstdint>
#include <vector>

namespace lsys {

class ProductionClasses {
public:
    explicit ProductionClasses(Program& program) : program_(program) {}

    /// Gives the last production of the Program its rule and its group, numbered by first
    /// appearance.
    void classify_last();

private:
    /// The first production of each class, by hash; kNone where a slot is free.
    struct Table {
        std::vector<std::uint32_t> firsts = std::vector<std::uint32_t>(1024, kNone);
        std::uint32_t count = 0;
    };
    using Hash = std::uint64_t (*)(const Production&);
    using Equal = bool (*)(const Production&, const Production&);
    /// The first production that is equal to production `index`; itself if it is the first.
    [[nodiscard]] std::uint32_t
    first_equal(Table& table, std::uint32_t index, Hash hash, Equal equal);

    Program& program_;
    Table rules_;
    Table groups_;
};

} // namespace lsys
