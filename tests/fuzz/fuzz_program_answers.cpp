// SPDX-License-Identifier: MIT
// Takes the lines of the input as the answers of the program of an environment, and derives a plant
// that asks it. If answers are accepted, their stated sizes add up to the count of numbers.
#include "runtime/environment/program.h"
#include "tests/fuzz/compiled.h"
#include "tests/fuzz/input_bytes.h"
#include "tests/fuzz/small_derivation.h"

#include <cmath>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr const char* kGrammar =
    "#n = 3; #sense host program; #w : A ?host(0, 1, 2); #p : A > ?host(a, b, c) : a > b : F(c) [ "
    "+(30) A ?host(b, a, 0) ] A ?host; #q : ?host(a, b, c) : a < 0 : ?host(a, b);";

/// A program whose answers are the lines of the input.
class WrittenProgram final : public lsys::LineProgram {
public:
    explicit WrittenProgram(InputBytes& input) : input_(input) {}

    std::optional<lsys::ProgramFailure>
    ask(const std::string& /*line*/, std::uint64_t max_bytes, std::string& answer) override {
        if (input_.empty()) {
            return lsys::ProgramFailure{lsys::Stop::Diagnosed, "it has ended", ""};
        }
        answer = input_.line().substr(0, max_bytes);
        return std::nullopt;
    }
    std::string finish() override { return "end"; }

private:
    InputBytes& input_;
};

void check_answers(std::string_view line, std::size_t count) {
    std::vector<float> answers;
    std::vector<std::uint32_t> sizes;
    if (!lsys::read_answers(line, count, answers, sizes) &&
        (sizes.size() != count ||
         std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}) != answers.size())) {
        std::abort();
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const CompiledText compiled = compile_text(kGrammar, lsys::Dialect::Lsys, "");
    InputBytes lines(data, size);
    for (std::size_t count = 1; count <= 4; ++count) {
        check_answers(lines.line(), count);
    }
    InputBytes input(data, size);
    Division division;
    division.program.command = "written";
    division.program.start = [&](const std::string&, double, const std::atomic<bool>*) {
        return lsys::Result<std::unique_ptr<lsys::LineProgram>>(
            std::make_unique<WrittenProgram>(input));
    };
    SmallDerivation derivation(*compiled.bytecode, division);
    if (!derivation.run()) {
        for (const float value : derivation.word().parameters()) {
            if (!std::isfinite(value)) {
                std::abort();
            }
        }
    }
    return 0;
}
