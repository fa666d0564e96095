// SPDX-License-Identifier: MIT
// Bytecode from short texts for unit tests, without the front end and the compiler. Modules,
// expressions and productions look as in the language; names are identifiers or single characters,
// and blanks separate them.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::test {

class BytecodeBuilder {
public:
    Settings settings;
    bool fold = true; // fold constant arguments into codes of their own

    /// Adds an axiom: "F(1)[+(30)A]".
    BytecodeBuilder& axiom(std::string text);
    /// Adds a production: "p : A(x) < B > C [ D ] : x > 0 ~ 0.5 : F(x, {1, 2}) B".
    BytecodeBuilder& production(std::string text);
    /// A production of a later stage. Stages must be given in their order.
    BytecodeBuilder& production(Stage stage, std::string text);
    /// "P H": modules of these names, of any count, are sense modules that ask for the position.
    BytecodeBuilder& sense(std::string names);
    /// Makes contexts skip modules of these names, "+ -", with any number of parameters.
    BytecodeBuilder& ignore(std::string names);
    /// A random constant, drawn at the start.
    BytecodeBuilder& global(std::string name, std::string value);
    BytecodeBuilder& parameter(std::string name, std::string value, float minimum, float maximum);
    /// Declares symbols, "A(x) B", before those of the texts, so that a test knows their numbers.
    BytecodeBuilder& declare(std::string modules);
    /// Declares unused symbols, so that codes need two or four bytes.
    BytecodeBuilder& unused_symbols(std::uint32_t count);

    /// The verified bytecode; a mistake in a text ends the test program.
    [[nodiscard]] Bytecode build() const;

private:
    struct GlobalText {
        std::string name;
        std::string value;
        bool has_bounds = false;
        float minimum = 0.0F;
        float maximum = 0.0F;
    };
    std::string declared_;
    std::string axiom_;
    std::vector<std::string> productions_;
    std::vector<Stage> stages_; // of productions_
    std::vector<std::string> ignored_;
    std::vector<std::string> sensing_;
    std::vector<GlobalText> globals_;
    std::uint32_t unused_ = 0;
};

} // namespace lsys::test
