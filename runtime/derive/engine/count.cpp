// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/count.h"

#include "runtime/derive/engine/instantiate.h"

#include <algorithm>
#include <array>
#include <bit>

namespace lsys {

template <typename C, typename R>
CountResult count_modules(const Plan& plan,
                          Chooser<C>& chooser,
                          const WordView<C>& word,
                          const CountRequest& request,
                          R* records) {
    const Row* const rows = plan.rows().data();
    const Entry* const entries = plan.entries().data();
    const C* const codes = word.codes;
    const float* const parameters = word.parameters;
    const bool matches_several = plan.predecessor_count() > 1;
    const std::uint64_t end = request.end;
    const std::uint64_t room_modules = request.room_modules;
    const std::uint64_t room_parameters = request.room_parameters;
    CountResult result;
    std::uint64_t modules = 0;
    std::uint64_t written_parameters = 0;
    std::uint64_t index = request.begin.index;
    std::uint64_t parameter = request.begin.parameter;
    while (index < end) {
        const C code = codes[index];
        const Row& row = rows[code];
        std::uint64_t new_modules = row.code_count;
        std::uint64_t new_parameters = row.parameter_count;
        std::uint32_t record = 0;
        if (row.kind != RowKind::Fixed) {
            if (row.kind == RowKind::Choice) {
                record = chooser.choose_by_chance(chooser.module_draw(index), row);
            } else if (row.kind == RowKind::Tests) {
                record = chooser.choose_by_test(parameters + parameter, row);
            } else if (chooser.passes_guards(index, row) &&
                       !chooser.choose({index, parameter}, row, record)) {
                result.fault = true;
                break;
            }
            *records = static_cast<R>(record);
            const Entry& entry = entries[record == 0 ? code : row.base + record];
            new_modules = entry.code_count;
            new_parameters = entry.parameter_count;
        }
        if (new_modules > room_modules - modules ||
            new_parameters > room_parameters - written_parameters) {
            break;
        }
        modules += new_modules;
        written_parameters += new_parameters;
        records += row.kind != RowKind::Fixed ? 1 : 0;
        parameter += row.stored;
        ++index;
        if (record != 0 && matches_several) {
            const std::uint32_t replaced = plan.replaced_modules(entries[row.base + record]);
            for (std::uint32_t i = 1; i < replaced; ++i, ++index) {
                parameter += rows[codes[index]].stored;
            }
        }
    }
    result.end = {index, parameter};
    result.modules = modules;
    result.parameters = written_parameters;
    return result;
}

template <typename C, typename R>
CountResult count_active(const Plan& plan,
                         Chooser<C>& chooser,
                         const ActiveMask& mask,
                         const WordView<C>& word,
                         ModulePlace begin,
                         std::uint64_t end,
                         R* records) {
    constexpr std::size_t kBlock = ActiveMask::kBlock;
    const Row* const rows = plan.rows().data();
    const Entry* const entries = plan.entries().data();
    std::array<ActiveBits, ActiveMask::kModules / kBlock> bits; // NOLINT: filled before it is read
    std::array<std::uint64_t, kBlock> positions{};              // of modules of Choice rows
    std::array<float, kBlock> units{};
    CountResult result;
    while (begin.index < end) {
        const auto count = static_cast<std::size_t>(
            std::min<std::uint64_t>(end - begin.index, ActiveMask::kModules));
        result.modules +=
            count - mask.fill(word.codes, word.count, begin.index, count, bits.data());
        for (std::size_t first = 0; first < count; first += kBlock) {
            const ActiveBits& block = bits[first / kBlock];
            const std::uint64_t index = begin.index + first;
            const C* const codes = word.codes + index;
            result.parameters += mask.stored(codes, block.stores & ~block.active);
            if (block.active == 0) {
                begin.parameter += mask.stored(codes, block.stores);
                continue;
            }
            if (mask.has_choices()) {
                std::size_t draws = 0;
                for (std::uint64_t active = block.active; active != 0; active &= active - 1) {
                    const auto place = static_cast<std::uint64_t>(std::countr_zero(active));
                    positions[draws] = word.first_position + index + place;
                    draws += rows[codes[place]].kind == RowKind::Choice ? 1 : 0;
                }
                chooser.module_draws(positions.data(), draws, units.data());
            }
            const float* unit = units.data();
            std::uint64_t stores = block.stores; // bits of the modules not yet counted
            for (std::uint64_t active = block.active; active != 0; active &= active - 1) {
                const auto place = static_cast<std::uint64_t>(std::countr_zero(active));
                const C code = codes[place];
                const Row& row = rows[code];
                if (row.kind == RowKind::Fixed) {
                    result.modules += row.code_count;
                    result.parameters += row.parameter_count;
                    continue;
                }
                std::uint32_t record = 0;
                if (row.kind == RowKind::Choice) {
                    record = chooser.choose_by_chance(*unit++, row);
                } else {
                    const std::uint64_t below = (std::uint64_t{1} << place) - 1;
                    begin.parameter += mask.stored(codes, stores & below);
                    stores &= ~below;
                    const ModulePlace at{index + place, begin.parameter};
                    if (row.kind == RowKind::Tests) {
                        record = chooser.choose_by_test(word.parameters + at.parameter, row);
                    } else if (chooser.passes_guards(at.index, row) &&
                               !chooser.choose(at, row, record)) {
                        result.fault = true;
                        result.end = at;
                        return result;
                    }
                }
                *records++ = static_cast<R>(record);
                const Entry& entry = entries[record == 0 ? code : row.base + record];
                result.modules += entry.code_count;
                result.parameters += entry.parameter_count;
            }
            begin.parameter += mask.stored(codes, stores);
        }
        begin.index += count;
    }
    result.end = begin;
    return result;
}

#define LSYS_COUNT(C, R)                                                                           \
    template CountResult count_modules<C, R>(const Plan&, Chooser<C>&, const WordView<C>&,         \
                                             const CountRequest&, R*);                             \
    template CountResult count_active<C, R>(const Plan&, Chooser<C>&, const ActiveMask&,           \
                                            const WordView<C>&, ModulePlace, std::uint64_t, R*);
LSYS_FOR_CODES_AND_RECORDS(LSYS_COUNT)
#undef LSYS_COUNT

} // namespace lsys
