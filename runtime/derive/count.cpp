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
    const float* const parameters = word.parameters;
    const std::uint32_t predecessor_count = plan.predecessor_count();
    const std::uint64_t end = request.end;
    const std::uint64_t room_modules = request.room_modules;
    const std::uint64_t room_parameters = request.room_parameters;
    CountResult result;
    std::uint64_t modules = 0;
    std::uint64_t written_parameters = 0;
    std::uint64_t copies = 0;
    std::uint64_t index = request.begin.index;
    std::uint64_t parameter = request.begin.parameter;
    while (index < end) {
        const C code = codes[index];
        const Row& row = rows[code];
        std::uint64_t wrote = row.code_count;
        std::uint64_t stored = row.parameter_count;
        std::uint32_t record = 0;
        if (row.kind != RowKind::Fixed) {
            if (row.kind == RowKind::Choice) {
                record = chooser.choose_by_chance(index, row);
            } else if (row.kind == RowKind::Tests) {
                record = chooser.choose_by_test(parameters + parameter, row);
            } else if (chooser.passes_guards(index, row) &&
                       !chooser.choose({index, parameter}, row, record)) {
                result.fault = true;
                break;
            }
            *records = static_cast<R>(record);
            const Entry& entry = entries[record == 0 ? code : row.base + record];
            wrote = entry.code_count;
            stored = entry.parameter_count;
        }
        if (wrote > room_modules - modules || stored > room_parameters - written_parameters) {
            break;
        }
        modules += wrote;
        written_parameters += stored;
        copies += row.copies ? 1 : 0;
        records += row.kind != RowKind::Fixed ? 1 : 0;
        parameter += row.stored;
        ++index;
        if (record != 0 && predecessor_count > 1) {
            for (std::uint32_t i = 1; i < predecessor_count; ++i, ++index) {
                parameter += rows[codes[index]].stored;
            }
        }
    }
    result.end = {index, parameter};
    result.modules = modules;
    result.parameters = written_parameters;
    result.copies = copies;
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
