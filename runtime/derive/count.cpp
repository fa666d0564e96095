#include "runtime/derive/count.h"

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
    const std::uint32_t predecessor_count = plan.predecessor_count();
    CountResult result;
    ModulePlace place = request.begin;
    while (place.index < request.end) {
        const C code = codes[place.index];
        const Row& row = rows[code];
        std::uint64_t wrote = row.code_count;
        std::uint64_t stored = row.parameter_count;
        std::uint32_t record = 0;
        if (row.kind != RowKind::Fixed) {
            if (!chooser.choose(place, row, record)) {
                result.fault = true;
                break;
            }
            *records = static_cast<R>(record);
            const Entry& entry = entries[record == 0 ? code : row.base + record];
            wrote = entry.code_count;
            stored = entry.parameter_count;
        }
        if (wrote > request.room_modules - result.modules ||
            stored > request.room_parameters - result.parameters) {
            break;
        }
        result.modules += wrote;
        result.parameters += stored;
        result.copies += row.copies ? 1 : 0;
        records += row.kind != RowKind::Fixed ? 1 : 0;
        place.parameter += row.stored;
        ++place.index;
        if (record != 0 && predecessor_count > 1) {
            for (std::uint32_t i = 1; i < predecessor_count; ++i, ++place.index) {
                place.parameter += rows[codes[place.index]].stored;
            }
        }
    }
    result.end = place;
    return result;
}

#define LSYS_COUNT(C, R)                                                                           \
    template CountResult count_modules<C, R>(const Plan&, Chooser<C>&, const WordView<C>&,         \
                                             const CountRequest&, R*);
LSYS_COUNT(std::uint8_t, std::uint8_t)
LSYS_COUNT(std::uint8_t, std::uint32_t)
LSYS_COUNT(std::uint16_t, std::uint8_t)
LSYS_COUNT(std::uint16_t, std::uint32_t)
LSYS_COUNT(std::uint32_t, std::uint8_t)
LSYS_COUNT(std::uint32_t, std::uint32_t)
#undef LSYS_COUNT

} // namespace lsys
