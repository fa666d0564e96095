// SPDX-License-Identifier: MIT
#include "runtime/environment/program.h"

#include "grammar/base/counted_text.h"
#include "grammar/base/number_chars.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

namespace lsys {

namespace {

template <typename Number>
void append_number(Number number, std::string& text) {
    std::array<char, 32> characters{};
    const auto end =
        number_to_chars(characters.data(), characters.data() + characters.size(), number).ptr;
    text.append(characters.data(), end);
}

template <typename Numbers>
void append_array(const char* name, const Numbers& numbers, std::string& text) {
    text += '"';
    text += name;
    text += "\": [";
    bool is_first = true;
    for (const auto number : numbers) {
        text += is_first ? "" : ", ";
        is_first = false;
        append_number(number, text);
    }
    text += ']';
}

/// Parses the line with the answers of a program.
class AnswerReader {
public:
    explicit AnswerReader(std::string_view text) : text_(text) {}

    /// Skips blanks and then `character`. Returns false if another character stands there.
    [[nodiscard]] bool take(char character) {
        skip_blanks();
        if (at_ == text_.size() || text_[at_] != character) {
            return false;
        }
        ++at_;
        return true;
    }
    [[nodiscard]] bool take(std::string_view word) {
        skip_blanks();
        if (!text_.substr(at_).starts_with(word)) {
            return false;
        }
        at_ += word.size();
        return true;
    }
    [[nodiscard]] bool take(float& number) {
        skip_blanks();
        const char* const first = text_.data() + at_;
        const char* const last = text_.data() + text_.size();
        // JSON has no infinity and no NaN, which from_chars would read.
        const char* const digit = first != last && *first == '-' ? first + 1 : first;
        if (digit == last || *digit < '0' || *digit > '9') {
            return false;
        }
        double value = 0.0;
        const auto [end, error] = number_from_chars(first, last, value);
        if (error == std::errc::result_out_of_range) {
            value = is_below_one(first, end) ? 0.0 : std::numeric_limits<double>::infinity();
        } else if (error != std::errc()) {
            return false;
        }
        number = static_cast<float>(value) + 0.0F; // -0 becomes 0
        at_ = static_cast<std::size_t>(end - text_.data());
        return true;
    }
    [[nodiscard]] bool is_at_end() {
        skip_blanks();
        return at_ == text_.size();
    }

private:
    /// Whether a number that is out of range is too small, not too large.
    static bool is_below_one(const char* first, const char* last) {
        const std::string_view number(first, static_cast<std::size_t>(last - first));
        const std::size_t exponent = number.find_first_of("eE");
        return exponent == std::string_view::npos ? number.find('.') <= 2
                                                  : number.substr(exponent + 1).starts_with('-');
    }
    void skip_blanks() {
        while (at_ < text_.size() &&
               (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r')) {
            ++at_;
        }
    }

    std::string_view text_;
    std::size_t at_ = 0; // index of the next character to read
};

/// An environment whose answers come from a function of the host.
class FunctionEnvironment final : public Environment {
public:
    explicit FunctionEnvironment(AnswerPlaces answer) : answer_(std::move(answer)) {}

    std::optional<EnvironmentFailure> answer(const SensedWord& word,
                                             std::vector<float>& answers,
                                             std::vector<std::uint32_t>& sizes) override {
        return word.places.empty() ? std::nullopt : answer_(word, answers, sizes);
    }

private:
    AnswerPlaces answer_;
};

class ProgramEnvironment : public Environment {
public:
    ProgramEnvironment(const BytecodeEnvironment& declared,
                       ProgramCommand command,
                       const EnvironmentContext& context)
        : declared_(declared), command_(std::move(command)), context_(context) {}

    std::optional<EnvironmentFailure> begin(std::uint64_t /*seed*/) override {
        program_.reset();
        EnvironmentFailure failure;
        if (command_.command.empty()) {
            failure.text = "no program is given that answers it";
            failure.help = program_help(declared_.name);
            return failure;
        }
        if (!command_.start) {
            failure.text = "programs cannot be started here";
            return failure;
        }
        Result<std::unique_ptr<LineProgram>> started =
            command_.start(command_.command, command_.seconds, context_.cancelled);
        if (!started) {
            failure.text =
                fmt::format("its program cannot be started: {}", started.error().message);
            return failure;
        }
        program_ = std::move(started.value());
        return std::nullopt;
    }

    std::optional<EnvironmentFailure> answer(const SensedWord& word,
                                             std::vector<float>& answers,
                                             std::vector<std::uint32_t>& sizes) override {
        // Max bytes of a line of answers: kMaxLineBytes, and kMaxBytesPerQuery more per query.
        constexpr std::uint64_t kMaxLineBytes = std::uint64_t{1} << 20;
        constexpr std::uint64_t kMaxBytesPerQuery = 4096;
        if (word.places.empty()) {
            return std::nullopt;
        }
        std::string line;
        std::optional<ProgramFailure> failed = program_->ask(
            query_line(word), kMaxLineBytes + kMaxBytesPerQuery * word.places.size(), line);
        if (!failed) {
            if (std::optional<std::string> reason =
                    read_answers(line, word.places.size(), answers, sizes)) {
                failed = ProgramFailure{Stop::Diagnosed, std::move(*reason), program_->finish()};
            }
        }
        if (!failed) {
            return std::nullopt;
        }
        EnvironmentFailure failure;
        failure.stop = failed->stop;
        failure.text = std::move(failed->text);
        if (!failed->messages.empty()) {
            failure.help = "the program wrote: " + failed->messages;
        }
        program_.reset();
        return failure;
    }

private:
    const BytecodeEnvironment& declared_;
    ProgramCommand command_;
    EnvironmentContext context_;
    std::unique_ptr<LineProgram> program_;
};

} // namespace

std::string query_line(const SensedWord& word) {
    std::string line = fmt::format("{{\"generation\": {}, \"queries\": [", word.generation);
    for (std::size_t i = 0; i < word.places.size(); ++i) {
        const SensePlace& place = word.places[i];
        line += i == 0 ? "{" : ", {";
        append_array("position", place.position, line);
        line += ", ";
        append_array("heading", place.heading, line);
        line += ", ";
        append_array("up", place.up, line);
        line += ", ";
        append_array("parameters",
                     word.parameters.subspan(word.first[i], word.first[i + 1] - word.first[i]),
                     line);
        line += '}';
    }
    line += "]}";
    return line;
}

std::optional<std::string> read_answers(std::string_view line,
                                        std::size_t count,
                                        std::vector<float>& answers,
                                        std::vector<std::uint32_t>& sizes) {
    AnswerReader reader(line);
    const auto malformed = [&] {
        constexpr std::size_t kShown = 60; // max characters of the line in the message
        return fmt::format("its program answered `{}{}`, not {{\"answers\": [[numbers], ...]}}",
                           line.substr(0, kShown), line.size() > kShown ? "..." : "");
    };
    answers.clear();
    sizes.clear();
    if (!reader.take('{') || !reader.take("\"answers\"") || !reader.take(':') ||
        !reader.take('[')) {
        return malformed();
    }
    for (bool goes_on = !reader.take(']'); goes_on; goes_on = reader.take(',')) {
        const std::size_t before = answers.size();
        if (!reader.take('[')) {
            return malformed();
        }
        for (bool has_number = !reader.take(']'); has_number; has_number = reader.take(',')) {
            if (!reader.take(answers.emplace_back())) {
                return malformed();
            }
        }
        if (answers.size() > before && !reader.take(']')) {
            return malformed();
        }
        sizes.push_back(static_cast<std::uint32_t>(answers.size() - before));
    }
    if ((!sizes.empty() && !reader.take(']')) || !reader.take('}') || !reader.is_at_end()) {
        return malformed();
    }
    if (sizes.size() != count) {
        return fmt::format("its program sent {} to {}", counted(sizes.size(), "answer"),
                           counted(count, "question"));
    }
    return std::nullopt;
}

std::string program_help(std::string_view name) {
    return fmt::format("name the program with `--environment {}=COMMAND`", name);
}

std::unique_ptr<Environment> make_program(const BytecodeEnvironment& declared,
                                          ProgramCommand command,
                                          const EnvironmentContext& context) {
    if (command.answer) {
        return std::make_unique<FunctionEnvironment>(std::move(command.answer));
    }
    return std::make_unique<ProgramEnvironment>(declared, std::move(command), context);
}

} // namespace lsys
