// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/origins.h"

#include "runtime/derive/engine/instantiate.h"

#include <algorithm>
#include <array>
#include <bit>

namespace lsys {

namespace {

template <typename C, typename R>
class Tracer {
public:
    Tracer(const Plan& plan,
           const WordView<C>& word,
           const OriginRequest& request,
           const R* records,
           Origin* out)
        : plan_(plan), word_(word), request_(request), rows_(plan.rows().data()),
          entries_(plan.entries().data()), records_(records), out_(out), index_(request.begin) {}

    Origin* run() {
        if (request_.mask != nullptr) {
            run_masked();
        } else {
            while (index_ < request_.end) {
                trace_next();
            }
        }
        return out_;
    }

private:
    /// Traces the module at index_, or all modules of the match that begins there.
    void trace_next() {
        const C code = word_.codes[index_];
        const Row& row = rows_[code];
        const Entry* entry = entries_ + code;
        std::uint32_t used = 1;
        if (row.kind != RowKind::Fixed) {
            const std::uint32_t record = *records_++;
            if (record != 0) {
                entry = entries_ + row.base + record;
                used = plan_.replaced_modules(*entry);
            }
        }
        if (entry->candidate == kNone) {
            *out_++ = word_.origins[index_];
        } else if ((word_.origins[index_].generation & kFollowed) != 0) {
            const Origin followed{word_.origins[index_].place, request_.generation | kFollowed};
            out_ = std::fill_n(out_, entry->code_count, followed);
        } else {
            for (std::uint32_t i = 0; i < entry->code_count; ++i) {
                out_[i] = {entry->first_place + i, request_.generation};
            }
            out_ += entry->code_count;
        }
        index_ += used;
    }

    /// Traces active modules and copies the runs between them.
    void run_masked() {
        constexpr std::size_t kBlock = ActiveMask::kBlock;
        std::array<ActiveBits, ActiveMask::kModules / kBlock>
            bits; // NOLINT: filled before it is read
        while (index_ < request_.end) {
            const std::uint64_t begin = index_;
            const auto count = static_cast<std::size_t>(
                std::min<std::uint64_t>(request_.end - begin, ActiveMask::kModules));
            request_.mask->fill(word_.codes, word_.count, begin, count, bits.data());
            for (std::size_t first = 0; first < count; first += kBlock) {
                const std::uint64_t block = begin + first;
                for (std::uint64_t active = bits[first / kBlock].active; active != 0;
                     active &= active - 1) {
                    copy_to(block + static_cast<std::uint64_t>(std::countr_zero(active)));
                    trace_next();
                }
                copy_to(block + std::min(count - first, kBlock));
            }
        }
    }

    void copy_to(std::uint64_t end) {
        out_ = std::copy(word_.origins + index_, word_.origins + end, out_);
        index_ = end;
    }

    const Plan& plan_;
    const WordView<C>& word_;
    const OriginRequest& request_;
    const Row* rows_;
    const Entry* entries_;
    const R* records_;    // the next record
    Origin* out_;         // where the next origin is written
    std::uint64_t index_; // the next module
};

} // namespace

template <typename C, typename R>
Origin* trace_origins(const Plan& plan,
                      const WordView<C>& word,
                      const OriginRequest& request,
                      const R* records,
                      Origin* out) {
    return Tracer<C, R>(plan, word, request, records, out).run();
}

void copy_axiom_origins(const BytecodeAxiom& axiom, Origin* out) {
    for (std::uint32_t i = 0; i < axiom.word.codes.count; ++i) {
        out[i] = {axiom.word.codes.first + i, 0};
    }
}

#define LSYS_TRACE(C, R)                                                                           \
    template Origin* trace_origins<C, R>(const Plan&, const WordView<C>&, const OriginRequest&,    \
                                         const R*, Origin*);
LSYS_FOR_CODES_AND_RECORDS(LSYS_TRACE)
#undef LSYS_TRACE

} // namespace lsys
