// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/write.h"

#include "runtime/derive/engine/instantiate.h"
#include "runtime/derive/engine/origins.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <utility>

namespace lsys {

namespace {

/// Four binary32 values computed together: a vector type of GCC and Clang, on any machine.
using Float4 = float __attribute__((vector_size(16)));

/// The parameters of a module that terms of entries may read.
enum class TermInputs : std::uint8_t {
    None,  // no parameters are written
    First, // the first only: no module stores more than one
    Any,
};

constexpr std::size_t kMaxWideBytes = 32;

bool all_finite(const float* values, std::size_t count) {
    constexpr std::uint32_t kExponent = 0x7F800000;
    std::uint32_t found = 0;
    for (std::size_t i = 0; i < count; ++i) {
        found |= (std::bit_cast<std::uint32_t>(values[i]) & kExponent) == kExponent ? 1U : 0U;
    }
    return found == 0;
}

/// Stores the first four parameters of an entry at once. `own`: the parameters of the rewritten
/// module.
template <TermInputs kInputs>
[[gnu::always_inline]] inline void store_terms(const Entry& entry, const float* own, float* out) {
    Float4 scale;
    Float4 offset;
    std::memcpy(&scale, entry.scale.data(), sizeof scale);
    std::memcpy(&offset, entry.offset.data(), sizeof offset);
    Float4 input;
    if constexpr (kInputs == TermInputs::First) {
        input = Float4{own[0], own[0], own[0], own[0]};
    } else {
        input = Float4{own[entry.input[0]], own[entry.input[1]], own[entry.input[2]],
                       own[entry.input[3]]};
    }
    const Float4 values = input * scale + offset;
    std::memcpy(out, &values, sizeof values);
}

/// The state of run_mixed().
template <typename C, typename R>
struct MixedRun {
    const Row* rows;
    const Entry* entries;
    const C* pool;
    const float* constants; // arguments of folded modules
    const C* in;            // the next module
    const C* end;
    std::uint64_t position; // position of `in` in the word
    const float* own;       // parameters of `in`
    const R* records;       // the next record
    C* codes;               // where the next code is written
    float* parameters;      // where the next parameter is written
};

/// Writes the modules of `run` up to the first one with a special entry that is not batched. A free
/// function like write_general(): fields of a Writer stay in registers if no call gets `this`.
template <typename C, typename R>
[[gnu::noinline]] void run_mixed(MixedRun<C, R>& run, Batches& batches) {
    MixedRun<C, R> at = run;
    for (; at.in != at.end; ++at.in, ++at.position) {
        const C code = *at.in;
        const Row& row = at.rows[code];
        const Entry* entry = at.entries + code;
        if (row.kind != RowKind::Fixed) {
            const std::uint32_t record = *at.records;
            entry = record == 0 ? entry : at.entries + row.base + record;
        }
        if (entry->batched) {
            batches.add(entry->terms_or_program,
                        row.constants == kNone ? at.own : at.constants + row.constants, at.position,
                        at.parameters);
        } else if (entry->special || row.slow) {
            break;
        } else {
            store_terms<TermInputs::Any>(*entry, at.own, at.parameters);
        }
        at.records += row.kind != RowKind::Fixed ? 1 : 0;
        std::memcpy(at.codes, at.pool + entry->first_code, kMaxWideBytes);
        at.codes += entry->code_count;
        at.parameters += entry->parameter_count;
        at.own += row.stored;
    }
    run = at;
}

/// Adds the parameters of a general entry to its batch, which computes them later, or evaluates
/// them now. Returns false if one cannot be evaluated to a finite value.
template <typename C>
[[gnu::noinline]] bool write_general(const Plan& plan,
                                     const PassKeys& keys,
                                     Matcher<C>& matcher,
                                     const WordView<C>& word,
                                     ModulePlace place,
                                     const Entry& entry,
                                     Batches& batches,
                                     float* parameters) {
    const std::uint64_t position = word.first_position + place.index;
    if (entry.terms_or_program == kNone) {
        EvalFault fault;
        return evaluate_entry(plan, keys, matcher, position, place, entry, parameters, fault);
    }
    const Candidate& candidate = plan.candidate(entry.candidate);
    const float* const formals = matcher.formals_after_search(candidate, place);
    if (candidate.gathers) {
        batches.add_copy(entry.terms_or_program, formals, position, parameters);
    } else {
        batches.add(entry.terms_or_program, formals, position, parameters);
    }
    return true;
}

template <typename C, typename R>
class Writer {
public:
    Writer(const Plan& plan,
           const PassKeys& keys,
           Matcher<C>& matcher,
           const WordView<C>& word,
           WriteRequest<C>& request,
           const R* records,
           Batches& batches)
        : plan_(plan), keys_(keys), matcher_(matcher), word_(word), request_(request),
          rows_(plan.rows().data()), entries_(plan.entries().data()),
          pool_(reinterpret_cast<const C*>(plan.pool())), records_(records), batches_(batches),
          place_(request.begin), codes_(request.codes), parameters_(request.parameters) {}

    bool run() {
        bool ok = true;
        if (plan_.predecessor_count() > 1) {
            ok = run_exactly(request_.end);
        } else if (!plan_.has_parameters() ||
                   !(request_.writes_parameters || plan_.checks_unstored())) {
            ok = run_with<TermInputs::None>();
        } else if (!plan_.has_several_parameters()) {
            ok = run_with<TermInputs::First>();
        } else {
            ok = run_with<TermInputs::Any>();
        }
        const float* const written = std::exchange(request_.parameters, parameters_);
        request_.begin = place_;
        request_.codes = codes_;
        return ok && batches_.finish() &&
               all_finite(written, static_cast<std::size_t>(parameters_ - written));
    }

private:
    template <TermInputs kInputs>
    bool run_with() {
        return request_.mask != nullptr ? run_masked<kInputs>() : run_wide<kInputs>();
    }

    template <TermInputs kInputs>
    bool run_wide() {
        if (kInputs != TermInputs::None && plan_.has_batched()) {
            return run_wide<kInputs, true, kMaxWideBytes, true>();
        }
        if (plan_.all_fixed()) {
            return plan_.wide_bytes() == 16 ? run_wide<kInputs, false, 16>()
                                            : run_wide<kInputs, false, 32>();
        }
        return plan_.wide_bytes() == 16 ? run_wide<kInputs, true, 16>()
                                        : run_wide<kInputs, true, 32>();
    }

    /// Writes in runs that are short enough to need no check of the limits per module. A module
    /// near a limit, or with a special entry, is written by run_exactly().
    template <TermInputs kInputs, bool kRecords, std::size_t kBytes, bool kMixed = false>
    bool run_wide() {
        while (place_.index < request_.end) {
            const auto code_room = static_cast<std::uint64_t>(request_.codes_limit - codes_);
            const auto parameter_room =
                static_cast<std::uint64_t>(request_.parameters_limit - parameters_);
            std::uint64_t length =
                std::min(request_.end - place_.index, code_room / (kBytes / sizeof(C)));
            if constexpr (kInputs != TermInputs::None) {
                length = std::min(length, parameter_room /
                                              (kMixed ? plan_.wide_parameters() : kEntryTerms));
            }
            if constexpr (kMixed) {
                if (length != 0 && write_mixed_run(length) == length) {
                    continue;
                }
            } else if (length != 0 && write_run<kInputs, kRecords, kBytes>(length) == length) {
                continue;
            }
            if (!run_exactly(place_.index + 1)) {
                return false;
            }
        }
        return true;
    }

    /// Writes up to `length` modules; returns their number: fewer if a module with a special entry
    /// comes next.
    template <TermInputs kInputs, bool kRecords, std::size_t kBytes>
    std::uint64_t write_run(std::uint64_t length) {
        const C* in = word_.codes + place_.index;
        const C* const begin = in;
        const C* const end = in + length;
        const float* own = word_.parameters + place_.parameter;
        const float* const first_own = own;
        const Row* const rows = rows_;
        const Entry* const entries = entries_;
        const C* const pool = pool_;
        const R* records = records_;
        C* codes = codes_;
        float* parameters = parameters_;
        for (; in != end; ++in) {
            const C code = *in;
            const Entry* entry = entries + code;
            [[maybe_unused]] const Row* row = rows + code;
            if constexpr (kRecords) {
                if (row->kind != RowKind::Fixed) {
                    const std::uint32_t record = *records;
                    entry = record == 0 ? entry : entries + row->base + record;
                    if (entry->special || row->slow) {
                        break;
                    }
                    ++records;
                } else if (entry->special) {
                    break;
                }
            } else if (entry->special) {
                break;
            }
            std::memcpy(codes, pool + entry->first_code, kBytes);
            codes += entry->code_count;
            if constexpr (kInputs != TermInputs::None) {
                store_terms<kInputs>(*entry, own, parameters);
                parameters += entry->parameter_count;
                own += row->stored;
            }
        }
        const auto done = static_cast<std::uint64_t>(in - begin);
        records_ = records;
        codes_ = codes;
        parameters_ = parameters;
        place_.index += done;
        place_.parameter += static_cast<std::uint64_t>(own - first_own);
        return done;
    }

    /// write_run() for plans with batched entries.
    std::uint64_t write_mixed_run(std::uint64_t length) {
        MixedRun<C, R> run{rows_,
                           entries_,
                           pool_,
                           plan_.bytecode().constants.data(),
                           word_.codes + place_.index,
                           word_.codes + place_.index + length,
                           word_.first_position + place_.index,
                           word_.parameters + place_.parameter,
                           records_,
                           codes_,
                           parameters_};
        run_mixed(run, batches_);
        const auto done = static_cast<std::uint64_t>(run.in - (word_.codes + place_.index));
        records_ = run.records;
        codes_ = run.codes;
        parameters_ = run.parameters;
        place_.index += done;
        place_.parameter +=
            static_cast<std::uint64_t>(run.own - (word_.parameters + place_.parameter));
        return done;
    }

    template <TermInputs kInputs>
    bool run_masked() {
        constexpr std::size_t kBlock = ActiveMask::kBlock;
        const ActiveMask& mask = *request_.mask;
        std::array<ActiveBits, ActiveMask::kModules / kBlock>
            bits; // NOLINT: filled before it is read
        while (place_.index < request_.end) {
            const std::uint64_t begin = place_.index;
            const auto count = static_cast<std::size_t>(
                std::min<std::uint64_t>(request_.end - begin, ActiveMask::kModules));
            mask.fill(word_.codes, word_.count, begin, count, bits.data());
            for (std::size_t first = 0; first < count;) {
                std::size_t end = first; // end of the blocks without active modules
                while (end < count && bits[end / kBlock].active == 0) {
                    end += kBlock;
                }
                end = std::min(end, count);
                if (end > first + kBlock) {
                    copy_inactive<kInputs>(mask, &bits[first / kBlock], end - first);
                    first = end;
                    continue;
                }
                const auto size = static_cast<unsigned>(std::min(count - first, kBlock));
                if (!write_block<kInputs>(mask, bits[first / kBlock], size)) {
                    return false;
                }
                first += size;
            }
        }
        return true;
    }

    /// Copies the next `size` modules, which are several blocks without active modules.
    template <TermInputs kInputs>
    void copy_inactive(const ActiveMask& mask, const ActiveBits* bits, std::size_t size) {
        constexpr std::size_t kBlock = ActiveMask::kBlock;
        const C* const in = word_.codes + place_.index;
        codes_ = std::copy_n(in, size, codes_);
        place_.index += size;
        if constexpr (kInputs != TermInputs::None) {
            std::uint64_t stored = 0;
            for (std::size_t at = 0; at < size; at += kBlock) {
                stored += mask.stored(in + at, bits[at / kBlock].stores);
            }
            parameters_ = std::copy_n(word_.parameters + place_.parameter, stored, parameters_);
            place_.parameter += stored;
        }
    }

    /// Writes the next `size` modules: 64, or fewer at the end. A run between two active modules is
    /// copied as 64 codes at once. Works on local copies of the fields, because the compiler would
    /// reload the fields after each store of a code.
    template <TermInputs kInputs>
    bool write_block(const ActiveMask& mask, ActiveBits bits, unsigned size) {
        constexpr std::size_t kBlock = ActiveMask::kBlock;
        constexpr std::size_t kWide = kMaxWideBytes / sizeof(C);
        const std::uint64_t begin = place_.index;
        const C* const in = word_.codes + begin;
        if (bits.active == 0 && static_cast<std::size_t>(request_.codes_limit - codes_) >= kBlock) {
            std::memcpy(codes_, in, kBlock * sizeof(C));
            codes_ += size;
            place_.index += size;
            if constexpr (kInputs != TermInputs::None) {
                const std::uint64_t stored = mask.stored(in, bits.stores);
                copy_parameters(word_.parameters + place_.parameter, stored, parameters_,
                                request_.parameters_limit);
                parameters_ += stored;
                place_.parameter += stored;
            }
            return true;
        }
        const Row* const rows = rows_;
        const Entry* const entries = entries_;
        const C* const pool = pool_;
        const C* const codes_limit = request_.codes_limit;
        const float* const parameters_limit = request_.parameters_limit;
        const float* own = word_.parameters + place_.parameter;
        const R* records = records_;
        C* codes = codes_;
        float* parameters = parameters_;
        const auto keep = [&](unsigned done) {
            place_ = {begin + done, static_cast<std::uint64_t>(own - word_.parameters)};
            records_ = records;
            codes_ = codes;
            parameters_ = parameters;
        };
        unsigned from = 0;
        while (true) {
            const unsigned to =
                bits.active == 0 ? size : static_cast<unsigned>(std::countr_zero(bits.active));
            const unsigned run = to - from;
            if (static_cast<std::size_t>(codes_limit - codes) >= kBlock) {
                std::memcpy(codes, in + from, kBlock * sizeof(C));
            } else {
                std::copy_n(in + from, run, codes);
            }
            codes += run;
            if constexpr (kInputs != TermInputs::None) {
                const std::uint64_t before =
                    to == kBlock ? ~std::uint64_t{0} : (std::uint64_t{1} << to) - 1;
                const std::uint64_t parameter_count = mask.stored(in, bits.stores & before);
                bits.stores &= ~before;
                copy_parameters(own, parameter_count, parameters, parameters_limit);
                parameters += parameter_count;
                own += parameter_count;
            }
            if (bits.active == 0) {
                break;
            }
            bits.active &= bits.active - 1;
            const C code = in[to];
            const Row& row = rows[code];
            const Entry* entry = entries + code;
            if (row.kind != RowKind::Fixed) {
                const std::uint32_t record = *records++;
                entry = record == 0 ? entry : entries + row.base + record;
            }
            bool room = static_cast<std::size_t>(codes_limit - codes) >= kWide;
            if constexpr (kInputs != TermInputs::None) {
                room =
                    room && static_cast<std::size_t>(parameters_limit - parameters) >= kEntryTerms;
            }
            if (room && !entry->special && !row.slow) {
                std::memcpy(codes, pool + entry->first_code, kWide * sizeof(C));
                if constexpr (kInputs != TermInputs::None) {
                    store_terms<kInputs>(*entry, own, parameters);
                }
            } else {
                keep(to);
                if (!write_exactly(*entry)) {
                    return false;
                }
            }
            codes += entry->code_count;
            if constexpr (kInputs != TermInputs::None) {
                parameters += entry->parameter_count;
                own += row.stored;
            }
            bits.stores &= ~(std::uint64_t{1} << to);
            from = to + 1;
        }
        keep(size);
        return true;
    }

    static void
    copy_parameters(const float* own, std::uint64_t count, float* parameters, const float* limit) {
        if (static_cast<std::uint64_t>(limit - parameters) >= count + kEntryTerms) {
            for (std::uint64_t i = 0; i < count; i += kEntryTerms) {
                std::memcpy(parameters + i, own + i, kEntryTerms * sizeof(float));
            }
        } else {
            std::copy_n(own, count, parameters);
        }
    }

    /// Writes an entry without wide stores; does not advance.
    [[gnu::noinline]] bool write_exactly(const Entry& entry) {
        std::copy_n(pool_ + entry.first_code, entry.code_count, codes_);
        return write_parameters(entry);
    }

    /// Writes the modules up to `end` without wide stores.
    bool run_exactly(std::uint64_t end) {
        while (place_.index < end) {
            const C code = word_.codes[place_.index];
            const Row& row = rows_[code];
            const Entry* entry = entries_ + code;
            std::uint32_t modules = 1;
            if (row.kind != RowKind::Fixed) {
                const std::uint32_t record = *records_++;
                if (record != 0) {
                    entry = entries_ + row.base + record;
                    modules = plan_.replaced_modules(*entry);
                }
            }
            if (!write_exactly(*entry)) {
                return false;
            }
            codes_ += entry->code_count;
            parameters_ += entry->parameter_count;
            for (; modules != 0; --modules, ++place_.index) {
                place_.parameter += rows_[word_.codes[place_.index]].stored;
            }
        }
        return true;
    }

    bool write_parameters(const Entry& entry) {
        if (entry.parameter_count == 0 && !entry.general) {
            return true;
        }
        if (entry.general) {
            return write_general(plan_, keys_, matcher_, word_, place_, entry, batches_,
                                 parameters_);
        }
        const float* const own = matcher_.own_parameters(place_);
        if (entry.parameter_count > kEntryTerms) {
            const AffineTerm* const terms = plan_.terms().data() + entry.terms_or_program;
            for (std::uint32_t i = 0; i < entry.parameter_count; ++i) {
                parameters_[i] = value_of(terms[i], own);
            }
            return true;
        }
        for (std::uint32_t i = 0; i < entry.parameter_count; ++i) {
            parameters_[i] = own[entry.input[i]] * entry.scale[i] + entry.offset[i];
        }
        return true;
    }

    const Plan& plan_;
    const PassKeys& keys_;
    Matcher<C>& matcher_;
    const WordView<C>& word_;
    WriteRequest<C>& request_;
    const Row* rows_;
    const Entry* entries_;
    const C* pool_;
    const R* records_; // the next record
    Batches& batches_;
    ModulePlace place_; // the next module
    C* codes_;          // where the next code is written
    float* parameters_; // where the next parameter is written
};

} // namespace

template <typename C, typename R>
bool write_modules(const Plan& plan,
                   const PassKeys& keys,
                   Matcher<C>& matcher,
                   const WordView<C>& word,
                   WriteRequest<C>& request,
                   const R* records) {
    const std::uint64_t begin = request.begin.index;
    Batches batches(
        plan.bytecode(), plan.batch_programs(),
        {plan.inputs().globals, plan.inputs().steps, keys.seed, keys.generation, keys.first_draw});
    if (!Writer<C, R>(plan, keys, matcher, word, request, records, batches).run()) {
        return false;
    }
    if (request.origins != nullptr) {
        const OriginRequest traced{begin, request.begin.index,
                                   keys.generation + (keys.keeps_age ? 0 : 1), request.mask};
        request.origins = trace_origins(plan, word, traced, records, request.origins);
    }
    return true;
}

template <typename C>
bool evaluate_entry(const Plan& plan,
                    const PassKeys& keys,
                    Matcher<C>& matcher,
                    std::uint64_t position,
                    ModulePlace place,
                    const Entry& entry,
                    float* out,
                    EvalFault& fault) {
    const Bytecode& bytecode = plan.bytecode();
    const Candidate& candidate = plan.candidate(entry.candidate);
    const BytecodeProduction& production = bytecode.productions[candidate.production];
    if (production.successor.arguments == kNone && production.successor.locals == kNone) {
        return true;
    }
    const PlanInputs& inputs = plan.inputs();
    const EvalFrame frame{matcher.formals_after_search(candidate, place), inputs.globals,
                          static_cast<float>(keys.generation), inputs.steps};
    const bool draws_choice =
        candidate.stochastic && bytecode.settings.choice == ChoiceScope::Module;
    RangeDraws draws = RangeDraws::of_module(keys.seed, keys.generation, position,
                                             keys.first_draw + (draws_choice ? 1 : 0));
    return evaluate(bytecode, production.successor, frame, &draws, out, fault);
}

#define LSYS_WRITE(C, R)                                                                           \
    template bool write_modules<C, R>(const Plan&, const PassKeys&, Matcher<C>&,                   \
                                      const WordView<C>&, WriteRequest<C>&, const R*);
LSYS_FOR_CODES_AND_RECORDS(LSYS_WRITE)
#undef LSYS_WRITE
#define LSYS_EVALUATE(C)                                                                           \
    template bool evaluate_entry<C>(const Plan&, const PassKeys&, Matcher<C>&, std::uint64_t,      \
                                    ModulePlace, const Entry&, float*, EvalFault&);
LSYS_FOR_CODES(LSYS_EVALUATE)
#undef LSYS_EVALUATE

} // namespace lsys
