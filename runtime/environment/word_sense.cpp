// SPDX-License-Identifier: MIT
#include "runtime/environment/word_sense.h"

#include "grammar/base/contract.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/base/random.h"
#include "runtime/environment/impl/input_checks.h"
#include "runtime/environment/neighbours.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsys {

namespace {

bool is_finite(const Vector3& vector) {
    return std::isfinite(vector[0]) && std::isfinite(vector[1]) && std::isfinite(vector[2]);
}

/// An error about a module of a word.
RuntimeError error_at(RuntimeErrorKind kind,
                      const Bytecode& bytecode,
                      const SenseModule& module,
                      const Word& word,
                      std::uint32_t age) {
    RuntimeError error;
    error.kind = kind;
    error.generation = age;
    error.position = module.position;
    error.symbol = bytecode.symbol_of(module.code);
    const std::span<const float> parameters =
        word.parameters().subspan(module.first_parameter, bytecode.stored_parameters(module.code));
    error.parameters.assign(parameters.begin(), parameters.end());
    return error;
}

/// The failure of `work`, also if it runs out of memory.
template <typename Work>
std::optional<EnvironmentFailure> caught(const Work& work) {
    return catch_out_of_memory(
        [&]() -> std::optional<EnvironmentFailure> { return work(); },
        []() -> std::optional<EnvironmentFailure> { return stopped(Stop::OutOfMemory); });
}

void append_size(std::uint64_t size, std::string& bytes) {
    for (unsigned shift = 0; shift < 64; shift += 8) {
        bytes += static_cast<char>((size >> shift) & 0xFFU);
    }
}

/// Removes a 64-bit little-endian size from the front of `bytes`; nullopt if there are fewer than
/// eight bytes.
std::optional<std::uint64_t> take_size(std::string_view& bytes) {
    if (bytes.size() < 8) {
        return std::nullopt;
    }
    std::uint64_t size = 0;
    for (unsigned i = 0; i < 8; ++i) {
        size |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
    }
    bytes.remove_prefix(8);
    return size;
}

} // namespace

/// Collects the places of a word for its environments, and writes the answers to `?P ?H ?U ?R ?L`
/// directly.
class EnvironmentSense::Sink final : public SenseSink {
public:
    Sink(EnvironmentSense& owner, Word& word)
        : owner_(owner), bytecode_(owner.bytecode_), parameters_(word.parameters()) {
        senses_.reserve(bytecode_.code_count());
        for (Code code = 0; code < bytecode_.code_count(); ++code) {
            senses_.push_back({bytecode_.symbol(bytecode_.symbol_of(code)).sense,
                               std::min(bytecode_.stored_parameters(code), 3U)});
        }
    }

    void sense(const SenseModule& module, const SensingPose& pose) override {
        const SenseOfCode sense_of_code = senses_[module.code];
        switch (sense_of_code.sense) {
        case Sense::Position:
            return write_vector(module, sense_of_code.count, pose.position, 1.0);
        case Sense::Heading:
            return write_vector(module, sense_of_code.count, pose.heading, 1.0);
        case Sense::Up:
            return write_vector(module, sense_of_code.count, pose.up, 1.0);
        case Sense::Right:
            return write_vector(module, sense_of_code.count, pose.right, 1.0);
        case Sense::Left:
            return write_vector(module, sense_of_code.count, pose.right, -1.0);
        default:
            break;
        }
        SensedEnvironment& environment =
            owner_.sensed_[static_cast<std::size_t>(sense_of_code.sense)];
        environment.modules.push_back(module);
        environment.places.push_back({pose.position, pose.heading, pose.up});
    }
    void organ(const std::array<double, 3>& middle, double area) override {
        owner_.organs_.push_back({middle, area});
    }

    /// The first module with an answer that is not finite.
    std::optional<SenseModule> failed;
    float value = 0.0F; // the first value of that answer that is not finite

private:
    struct SenseOfCode {
        Sense sense = Sense::Nothing;
        std::uint32_t count = 0; // numbers of the answer for which the module has parameters
    };

    void write_vector(const SenseModule& module,
                      std::uint32_t count,
                      const std::array<double, 3>& vector,
                      double sign) {
        float* const parameters = parameters_.data() + module.first_parameter;
        for (std::uint32_t i = 0; i < count; ++i) {
            parameters[i] = static_cast<float>(sign * vector[i]) + 0.0F; // -0 becomes 0
            if (!std::isfinite(parameters[i]) && !failed) {
                failed = module;
                value = parameters[i];
            }
        }
    }

    EnvironmentSense& owner_;
    const Bytecode& bytecode_;
    std::span<float> parameters_;
    std::vector<SenseOfCode> senses_; // by code
};

EnvironmentSense::EnvironmentSense(const Bytecode& bytecode, SenseOptions options)
    : bytecode_(bytecode), options_(std::move(options)),
      workers_(options_.threads), context_{&workers_, options_.cancelled, options_.max_bytes},
      no_files_(options_.files == nullptr ? bytecode.environments.size() : 0) {
    const std::vector<EnvironmentFiles>& files =
        options_.files == nullptr ? no_files_ : *options_.files;
    LSYS_CHECK(files.size() == bytecode.environments.size(), files.size());
    options_.programs.resize(bytecode.environments.size());
    for (std::size_t i = 0; i < bytecode.environments.size(); ++i) {
        const BytecodeEnvironment& declared = bytecode.environments[i];
        switch (declared.kind) {
        case EnvironmentKind::Shadow:
            environments_.push_back(make_shadow(declared, context_));
            break;
        case EnvironmentKind::Sky:
            environments_.push_back(make_sky(declared, context_));
            options_.objects.organs = true;
            break;
        case EnvironmentKind::Space:
            environments_.push_back(
                make_space(declared, files[i], static_cast<std::uint32_t>(i), context_));
            break;
        case EnvironmentKind::Crowd:
            environments_.push_back(make_crowd(declared, context_));
            break;
        case EnvironmentKind::Solid:
            environments_.push_back(make_solid(declared, files[i], context_));
            break;
        case EnvironmentKind::Map:
            environments_.push_back(make_map(declared, files[i], context_));
            break;
        case EnvironmentKind::Program:
            environments_.push_back(make_program(declared, options_.programs[i], context_));
            break;
        }
    }
    options_.objects.max_bytes = options_.max_bytes;
    options_.objects.cancelled = options_.cancelled;
}

EnvironmentSense::~EnvironmentSense() = default;

std::optional<Stop> EnvironmentSense::begin(std::uint64_t seed,
                                            std::uint32_t /*generations*/,
                                            std::span<const float> /*globals*/,
                                            DerivationEnd& end) {
    options_.objects.seed = seed;
    turtle_ = std::make_unique<SensingTurtle>(bytecode_, options_.objects);
    sensed_.clear();
    organs_.clear();
    for (std::size_t i = 0; i < environments_.size(); ++i) {
        if (auto failure = caught([&] { return environments_[i]->begin(seed); })) {
            return end_failed(i, std::move(*failure), nullptr, 0, end);
        }
    }
    return std::nullopt;
}

std::optional<Stop> EnvironmentSense::end_failed(std::size_t index,
                                                 EnvironmentFailure failure,
                                                 const Word* word,
                                                 std::uint32_t age,
                                                 DerivationEnd& end) const {
    if (failure.stop == Stop::Diagnosed) {
        const bool has_module =
            word != nullptr && failure.failed_place < sensed_[index].modules.size();
        end.error = has_module ? error_at(RuntimeErrorKind::SenseFailed, bytecode_,
                                          sensed_[index].modules[failure.failed_place], *word, age)
                               : RuntimeError{};
        end.error.kind = RuntimeErrorKind::SenseFailed;
        end.error.generation = word == nullptr ? kStartGeneration : age;
        end.error.environment = static_cast<std::uint32_t>(index);
        end.error.site = bytecode_.environments[index].site;
        end.error.text = std::move(failure.text);
        end.error.help = std::move(failure.help);
    } else {
        end.limit.kind = LimitKind::Memory;
        end.limit.generation = age == 0 ? 0 : age - 1;
        end.limit.predicted_bytes = failure.bytes;
    }
    return failure.stop;
}

std::optional<Stop> EnvironmentSense::sense(Word& word, std::uint32_t age, DerivationEnd& end) {
    const auto work = [&]() -> std::optional<Stop> {
        age_ = age;
        sensed_.resize(bytecode_.environments.size());
        for (SensedEnvironment& each : sensed_) {
            each.modules.clear();
            each.places.clear();
        }
        organs_.clear();
        Sink sink(*this, word);
        if (const std::optional<Stop> stop = turtle_->walk(word, age, sink)) {
            end.error = turtle_->error();
            end.limit.kind = LimitKind::Memory;
            return stop;
        }
        if (sink.failed) {
            end.error =
                error_at(RuntimeErrorKind::SenseNotFinite, bytecode_, *sink.failed, word, age);
            end.error.value = sink.value;
            return Stop::Diagnosed;
        }
        for (std::size_t i = 0; i < sensed_.size(); ++i) {
            if (const std::optional<Stop> stop = ask(i, word, age, end)) {
                return stop;
            }
        }
        return std::nullopt;
    };
    return catch_out_of_memory(work, [] { return std::optional(Stop::OutOfMemory); });
}

std::optional<Stop>
EnvironmentSense::ask(std::size_t index, Word& word, std::uint32_t age, DerivationEnd& end) {
    SensedEnvironment& sensed = sensed_[index];
    const EnvironmentKind kind = bytecode_.environments[index].kind;
    for (std::size_t i = 0; i < sensed.places.size(); ++i) {
        const SensePlace& place = sensed.places[i];
        if (!is_finite(place.position) || !is_finite(place.heading) || !is_finite(place.up)) {
            EnvironmentFailure failure;
            failure.text = "the position of the turtle is infinite or not a number";
            failure.failed_place = i;
            return end_failed(index, std::move(failure), &word, age, end);
        }
    }
    const std::uint32_t size = answer_size(kind);
    std::vector<float> parameters;
    std::vector<std::uint32_t> first;
    if (kind == EnvironmentKind::Program) { // other kinds do not read parameters
        for (const SenseModule& module : sensed.modules) {
            first.push_back(static_cast<std::uint32_t>(parameters.size()));
            const auto own = word.parameters().subspan(module.first_parameter,
                                                       bytecode_.stored_parameters(module.code));
            parameters.insert(parameters.end(), own.begin(), own.end());
        }
        first.push_back(static_cast<std::uint32_t>(parameters.size()));
    }
    sensed.sizes.clear();
    sensed.answers.assign(size == kUnknownAnswerSize ? 0 : sensed.places.size() * size, 0.0F);
    SensedWord sensed_word{age, sensed.places, organs_, parameters, first};
    std::vector<SensePlace> all_places; // also places of neighbours, whose answers are dropped
    std::vector<SensedOrgan> all_organs;
    if (options_.neighbours != nullptr && kind == EnvironmentKind::Shadow) {
        all_places = sensed.places;
        options_.neighbours->append_places(age, index, all_places);
        sensed.answers.resize(all_places.size() * size);
        sensed_word.places = all_places;
    } else if (options_.neighbours != nullptr && kind == EnvironmentKind::Sky) {
        all_organs = organs_;
        options_.neighbours->append_organs(age, all_organs);
        sensed_word.organs = all_organs;
    }
    if (auto failure = caught([&] {
            return environments_[index]->answer(sensed_word, sensed.answers, sensed.sizes);
        })) {
        return end_failed(index, std::move(*failure), &word, age, end);
    }
    if (!all_places.empty()) {
        sensed.answers.resize(sensed.places.size() * size);
    }
    return write_answers(index, word, age, end);
}

std::optional<Stop> EnvironmentSense::write_answers(std::size_t index,
                                                    Word& word,
                                                    std::uint32_t age,
                                                    DerivationEnd& end) const {
    const SensedEnvironment& sensed = sensed_[index];
    const std::uint32_t fixed = answer_size(bytecode_.environments[index].kind);
    const float* answer = sensed.answers.data();
    for (std::size_t i = 0; i < sensed.modules.size(); ++i) {
        const SenseModule& module = sensed.modules[i];
        const std::uint32_t size = fixed == kUnknownAnswerSize ? sensed.sizes[i] : fixed;
        const std::uint32_t count = std::min(size, bytecode_.stored_parameters(module.code));
        for (std::uint32_t k = 0; k < count; ++k) {
            if (!std::isfinite(answer[k])) {
                end.error =
                    error_at(RuntimeErrorKind::SenseNotFinite, bytecode_, module, word, age);
                end.error.value = answer[k];
                end.error.environment = static_cast<std::uint32_t>(index);
                end.error.site = bytecode_.environments[index].site;
                return Stop::Diagnosed;
            }
        }
        std::copy_n(answer, count, word.parameters().data() + module.first_parameter);
        answer += size;
    }
    return std::nullopt;
}

std::string EnvironmentSense::state() const {
    std::string all;
    bool any = false;
    for (const std::unique_ptr<Environment>& environment : environments_) {
        const std::string own = environment->state();
        any = any || !own.empty();
        append_size(own.size(), all);
        all += own;
    }
    return any ? all : std::string();
}

bool EnvironmentSense::restore(std::string_view state) {
    if (state.empty()) { // the environments keep no data
        return std::all_of(environments_.begin(), environments_.end(),
                           [](const auto& each) { return each->restore({}); });
    }
    for (const std::unique_ptr<Environment>& environment : environments_) {
        const std::optional<std::uint64_t> size = take_size(state);
        if (!size || *size > state.size() || !environment->restore(state.substr(0, *size))) {
            return false;
        }
        state.remove_prefix(*size);
    }
    return state.empty();
}

} // namespace lsys
