// SPDX-License-Identifier: MIT
// Reads any bytes as a saved state, then makes a state from the same bytes: a program, an age, any
// codes, parameters and data of environments, with a checksum that fits. A state that is accepted
// is derived for two generations.
#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/state_file.h"
#include "tests/fuzz/compiled.h"
#include "tests/fuzz/input_bytes.h"
#include "tests/fuzz/small_derivation.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

/// States of this age or later are not continued: the numbers of two more generations might exceed
/// 32 bits.
constexpr std::uint32_t kLastAge = 0xFFFFFFF0U;

constexpr std::array kGrammars{
    "#n = 9; #w : A; #p : A : * : F [ + A ] B; #q : B : * : A;",
    "#n = 9; #w : A(1); #p : A(x) : x < 9 : F(x) [ + A(x+1) ] B(x, 2*x); "
    "#q : B(x, y) : x > y : A({0, y});",
    "#n = 9; #set seed 3; #w : A B C; #ignore : + -; #p : A < B > C : * ~ 0.5 : B C; "
    "#q : A < B > C : * ~ 0.5 : A; #r : B > C : * : [ B ] A;",
    "#n = 9; #sense s space shape ball size 1 1 1 count 40 radius 0.4 kill 0.2; "
    "#w : A ?s(0, 0, 0, 0); #p : A > ?s(n, x, y, z) : n > 0 : F(0.1) A; "
    "#q : A : * : F(0.2) [ + A ?s(0, 0, 0, 0) ] A;",
    "#n = 9; #decompose d : D(x) : x > 0 : F D(x-1); #interpret i : L : * : [ F + F ]; "
    "#w : D(4) L; #p : L : * : % L D(2);",
};

std::vector<lsys::Bytecode> make_programs() {
    std::vector<lsys::Bytecode> programs;
    for (const char* grammar : kGrammars) {
        CompiledText compiled = compile_text(grammar, lsys::Dialect::Lsys, "");
        if (!compiled.bytecode) {
            std::abort();
        }
        programs.push_back(std::move(*compiled.bytecode));
    }
    return programs;
}

/// A word of any codes, with as many parameters as they store.
lsys::Word word_of(const lsys::Bytecode& bytecode, InputBytes& input) {
    const std::string_view codes = input.text(input.number<std::uint8_t>());
    std::uint64_t parameters = 0;
    for (const char code : codes) {
        const auto number = static_cast<std::uint8_t>(code) % bytecode.code_count();
        parameters += bytecode.stored_parameters(static_cast<lsys::Code>(number));
    }
    lsys::Word word(lsys::code_width(bytecode.code_count()));
    if (word.code_width() != 1 || !word.resize(codes.size(), parameters)) {
        std::abort();
    }
    for (std::size_t i = 0; i < codes.size(); ++i) {
        // A few codes stay beyond the program's, which must be refused.
        const auto code = static_cast<std::uint8_t>(codes[i]);
        word.codes<std::uint8_t>()[i] =
            code == 0xFF ? code : static_cast<std::uint8_t>(code % bytecode.code_count());
    }
    for (std::uint64_t i = 0; i < parameters; ++i) {
        word.parameters()[i] = input.number<float>();
    }
    return word;
}

void try_state(const std::string& bytes, const lsys::Bytecode& bytecode) {
    lsys::Result<lsys::SavedState> read = lsys::read_state(bytes, bytecode);
    if (read && read.value().header.age < kLastAge) {
        const std::uint32_t age = read.value().header.age;
        SmallDerivation derivation(bytecode);
        static_cast<void>(derivation.resume(std::move(read.value()), age + 2));
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::vector<lsys::Bytecode> programs = make_programs();
    InputBytes input(data, size);
    const lsys::Bytecode& bytecode = programs[input.below(programs.size())];
    try_state(std::string(data, data + size), bytecode);

    lsys::StateHeader header;
    header.program_digest = lsys::digest(bytecode);
    header.seed = input.number<std::uint16_t>();
    header.generations = input.number<std::uint8_t>();
    header.age = input.below(2) == 0 ? input.number<std::uint8_t>() : input.number<std::uint32_t>();
    const lsys::Word word = word_of(bytecode, input);
    std::string bytes;
    static_cast<void>(lsys::write_state(header, word, input.rest(), [&](std::string_view piece) {
        bytes += piece;
        return true;
    }));
    try_state(bytes, bytecode);
    return 0;
}
