// SPDX-License-Identifier: MIT
#include "compiler/program/program.h"

namespace lsys {

std::vector<ValueId> expressions_of(const Program& program, const Production& production) {
    std::vector<ValueId> roots{production.condition, production.weight_value};
    for (const LocalValue& local : production.locals) {
        roots.push_back(local.value);
    }
    for_each_module(program, production.successor,
                    [&](std::size_t, std::size_t argument, const ProgramModule& module) {
                        const std::uint32_t count = program.symbol(module.symbol).parameter_count;
                        for (std::uint32_t i = 0; i < count; ++i) {
                            roots.push_back(program.arguments[argument + i]);
                        }
                    });
    return roots;
}

GroupedLists rewriters_of(const Program& program) {
    return GroupedLists(program.symbols.size(), [&](auto&& add) {
        for (std::uint32_t p = 0; p < program.productions.size(); ++p) {
            for (const ProgramPatternItem& item : program.productions[p].predecessor.items) {
                add(static_cast<std::size_t>(item.symbol), p);
            }
        }
    });
}

GroupedLists writers_of(const Program& program) {
    struct Writer {
        std::size_t symbol;
        std::uint32_t production;
    };
    std::vector<Writer> writers;
    std::vector<std::uint32_t> last(program.symbols.size(), kNone); // last writer of each symbol
    for (std::uint32_t p = 0; p < program.productions.size(); ++p) {
        for_each_symbol(program, program.productions[p].successor, [&](std::size_t, SymbolId id) {
            const auto symbol = static_cast<std::size_t>(id);
            if (last[symbol] != p) {
                last[symbol] = p;
                writers.push_back({symbol, p});
            }
        });
    }
    return GroupedLists(program.symbols.size(), [&](auto&& add) {
        for (const Writer& writer : writers) {
            add(writer.symbol, writer.production);
        }
    });
}

} // namespace lsys
