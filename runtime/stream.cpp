#include "runtime/stream.h"

#include "grammar/contract.h"
#include "runtime/derive/brackets.h"
#include "runtime/derive/choose.h"
#include "runtime/derive/count.h"
#include "runtime/derive/faults.h"
#include "runtime/derive/origins.h"
#include "runtime/derive/plan.h"
#include "runtime/derive/start.h"
#include "runtime/derive/write.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint64_t kMaxBlock = 4096;
constexpr std::uint64_t kMinBlock = 32;
/// The blocks of all generations together, where templates do not ask for more.
constexpr std::uint64_t kBlocksBytes = std::uint64_t{8} << 20;
constexpr std::uint64_t kProgressStride = std::uint64_t{1} << 24;

/// A block of modules of one generation's word: what is left of it is rewritten piece by piece
/// into the next generation's block, depth first.
template <typename C>
struct Level {
    std::unique_ptr<C[]> codes; // not initialised
    std::unique_ptr<float[]> parameters;
    std::unique_ptr<Origin[]> origins; // null if nobody asks for them
    std::uint64_t count = 0;           // modules in the block
    ModulePlace next;                  // to be rewritten
    std::uint64_t first_position = 0;  // of the block in its generation's word
};

template <typename C, typename R>
class Streamer {
public:
    Streamer(const Bytecode& bytecode,
             const Plan& plan,
             const DeriveOptions& options,
             const StreamConsumer& consumer)
        : plan_(plan), options_(options), consumer_(consumer), brackets_(bytecode),
          bytecode_(bytecode), chooser_(plan, keys_, view_, nullptr) {
        std::uint64_t most_codes = bytecode.axiom.codes.count;
        std::uint64_t most_parameters = bytecode.axiom.parameter_count;
        for (const Entry& entry : plan.entries()) {
            most_codes = std::max<std::uint64_t>(most_codes, entry.code_count);
            most_parameters = std::max<std::uint64_t>(most_parameters, entry.parameter_count);
        }
        const std::uint64_t levels = std::uint64_t{options.generations} + 1;
        const std::uint64_t block =
            std::clamp(kBlocksBytes / levels / (sizeof(C) + sizeof(float)), kMinBlock, kMaxBlock);
        room_codes_ = std::max(block, most_codes);
        room_parameters_ = std::max(plan.has_parameters() ? block : 0, most_parameters);
        records_.resize(room_codes_);
    }

    StreamOutcome run(const std::vector<float>& axiom_parameters) {
        if (!add_level()) {
            return std::move(outcome_);
        }
        Level<C>& first = levels_[0];
        copy_axiom_codes(bytecode_, first.codes.get());
        std::copy(axiom_parameters.begin(), axiom_parameters.end(), first.parameters.get());
        if (options_.origins) {
            copy_axiom_origins(bytecode_, first.origins.get());
        }
        first.count = bytecode_.axiom.codes.count;
        std::size_t age = 0;
        while (true) {
            if (options_.cancelled != nullptr &&
                options_.cancelled->load(std::memory_order_relaxed)) {
                outcome_.status = DeriveStatus::Cancelled;
                break;
            }
            Level<C>& level = levels_[age];
            if (age == options_.generations && level.next.index < level.count) {
                if (!emit(level)) {
                    break;
                }
                level.next.index = level.count;
            }
            if (level.next.index == level.count) {
                level.first_position += level.count;
                level.count = 0;
                level.next = {};
                if (age == 0) {
                    break;
                }
                --age;
                continue;
            }
            if (age + 1 == levels_.size() && !add_level()) {
                break;
            }
            if (!descend(levels_[age], levels_[age + 1], static_cast<std::uint32_t>(age))) {
                break;
            }
            if (levels_[age + 1].count != 0) {
                ++age;
            }
        }
        return std::move(outcome_);
    }

private:
    /// Rewrites as much of `level` as fits into `below`.
    bool descend(Level<C>& level, Level<C>& below, std::uint32_t age) {
        view_ = {level.codes.get(), level.parameters.get(), level.count, level.first_position,
                 level.origins.get()};
        keys_ = {plan_.inputs().seed, age, 0};
        const ModulePlace begin = level.next;
        const CountRequest request{begin, level.count, room_codes_, room_parameters_};
        const CountResult counted = count_modules(plan_, chooser_, view_, request, records_.data());
        WriteRequest<C> write;
        write.begin = begin;
        write.end = counted.end.index;
        write.codes = below.codes.get();
        write.codes_limit = write.codes + room_codes_ + kWordSlack / sizeof(C);
        write.writes_parameters = counted.parameters != 0;
        write.parameters = below.parameters.get();
        write.parameters_limit = write.parameters + room_parameters_ + kWordSlack / sizeof(float);
        write.origins = below.origins.get();
        const bool written = write_modules(plan_, keys_, chooser_.matcher(), view_, write,
                                           static_cast<const R*>(records_.data()));
        if (counted.fault || !written) {
            std::optional<RuntimeError> error = find_fault(
                plan_, keys_, view_, nullptr, begin, counted.end.index + (counted.fault ? 1 : 0));
            LSYS_CHECK(error.has_value(), age, view_.first_position);
            outcome_.error = std::move(*error);
            outcome_.status = DeriveStatus::Error;
            return false;
        }
        level.next = counted.end;
        below.count = counted.modules;
        return true;
    }

    /// Hands a block of the last word to the consumer.
    bool emit(const Level<C>& level) {
        if (level.count > options_.limits.max_modules - outcome_.modules) {
            outcome_.limit.kind = LimitKind::Modules;
            outcome_.limit.generation = options_.generations;
            outcome_.limit.modules = outcome_.modules;
            outcome_.limit.predicted_modules = outcome_.modules + level.count;
            outcome_.limit.exact = false;
            outcome_.limit.streamed = true;
            outcome_.status = DeriveStatus::Limit;
            return false;
        }
        const std::optional<std::uint64_t> unmatched =
            brackets_.feed(level.codes.get(), level.count);
        if (unmatched) {
            outcome_.error =
                unmatched_bracket(bytecode_, level.codes[*unmatched],
                                  level.first_position + *unmatched, options_.generations);
            outcome_.status = DeriveStatus::Error;
            return false;
        }
        std::uint64_t parameters = 0;
        if (plan_.has_parameters()) {
            for (std::uint64_t i = 0; i < level.count; ++i) {
                parameters += plan_.row(level.codes[i]).stored;
            }
        }
        emitted_.assign(level.codes.get(), level.codes.get() + level.count);
        const std::size_t origins = options_.origins ? emitted_.size() : 0;
        if (!consumer_(
                {emitted_, {level.parameters.get(), parameters}, {level.origins.get(), origins}})) {
            outcome_.status = DeriveStatus::Cancelled;
            return false;
        }
        const std::uint64_t before = outcome_.modules;
        outcome_.modules += level.count;
        outcome_.parameters += parameters;
        if (options_.progress && before / kProgressStride != outcome_.modules / kProgressStride) {
            options_.progress(options_.generations, outcome_.modules);
        }
        return true;
    }

    bool add_level() {
        const std::uint64_t code_bytes = room_codes_ * sizeof(C) + kWordSlack;
        const std::uint64_t parameter_bytes = room_parameters_ * sizeof(float) + kWordSlack;
        const std::uint64_t origin_bytes = options_.origins ? room_codes_ * sizeof(Origin) : 0;
        held_bytes_ += sizeof(Level<C>) + code_bytes + parameter_bytes + origin_bytes;
        if (held_bytes_ > options_.limits.max_bytes) {
            outcome_.limit.kind = LimitKind::Memory;
            outcome_.limit.generation = options_.generations;
            outcome_.limit.modules = outcome_.modules;
            outcome_.limit.predicted_modules = outcome_.modules;
            outcome_.limit.predicted_bytes = held_bytes_;
            outcome_.limit.exact = false;
            outcome_.limit.streamed = true;
            outcome_.status = DeriveStatus::Limit;
            return false;
        }
        Level<C>& level = levels_.emplace_back();
        level.codes = std::make_unique_for_overwrite<C[]>(code_bytes / sizeof(C));
        level.parameters = std::make_unique_for_overwrite<float[]>(parameter_bytes / sizeof(float));
        if (options_.origins) {
            level.origins = std::make_unique_for_overwrite<Origin[]>(room_codes_);
        }
        // lanes read past the last parameter, and then need finite numbers
        std::fill_n(level.parameters.get(), parameter_bytes / sizeof(float), 0.0F);
        return true;
    }

    const Plan& plan_;
    const DeriveOptions& options_;
    const StreamConsumer& consumer_;
    BracketCounter brackets_;
    const Bytecode& bytecode_;
    WordView<C> view_; // of the block that is rewritten
    PassKeys keys_;
    Chooser<C> chooser_; // reads the two above
    std::vector<Level<C>> levels_;
    std::vector<R> records_;
    std::vector<Code> emitted_;
    std::uint64_t room_codes_ = 0;
    std::uint64_t room_parameters_ = 0;
    std::uint64_t held_bytes_ = 0;
    StreamOutcome outcome_;
};

template <typename C>
StreamOutcome stream(const Bytecode& bytecode,
                     const Plan& plan,
                     const DeriveOptions& options,
                     const StreamConsumer& consumer,
                     const std::vector<float>& axiom) {
    return plan.record_width() == 1
               ? Streamer<C, std::uint8_t>(bytecode, plan, options, consumer).run(axiom)
               : Streamer<C, std::uint32_t>(bytecode, plan, options, consumer).run(axiom);
}

} // namespace

std::optional<std::string> why_not_streamable(const Bytecode& bytecode) {
    if (bytecode.settings.rewriting != RewritingMode::Parallel) {
        return "`rewriting " + std::string(name_of(bytecode.settings.rewriting)) +
               "` needs the whole word";
    }
    for (const BytecodeProduction& production : bytecode.productions) {
        if (production.has_left || production.has_right) {
            return "production `" + production.name + "` has a context, which needs the whole word";
        }
    }
    return std::nullopt;
}

StreamOutcome derive_streamed(const Bytecode& bytecode,
                              const DeriveOptions& options,
                              const StreamConsumer& consumer) {
    StreamOutcome outcome;
    std::vector<float> globals;
    std::vector<float> axiom;
    std::optional<RuntimeError> wrong = draw_globals(bytecode, options.seed, globals);
    if (!wrong) {
        wrong = axiom_parameters(bytecode, options.seed, globals, axiom);
    }
    if (wrong) {
        outcome.error = std::move(*wrong);
        outcome.status = DeriveStatus::Error;
        return outcome;
    }
    const PlanInputs inputs{globals.data(), options.seed, static_cast<float>(options.generations)};
    const Plan plan(bytecode, inputs, false);
    switch (plan.code_width()) {
    case 1:
        return stream<std::uint8_t>(bytecode, plan, options, consumer, axiom);
    case 2:
        return stream<std::uint16_t>(bytecode, plan, options, consumer, axiom);
    default:
        return stream<std::uint32_t>(bytecode, plan, options, consumer, axiom);
    }
}

} // namespace lsys
