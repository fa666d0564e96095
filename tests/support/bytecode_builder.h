// SPDX-License-Identifier: MIT
// Makes bytecode from short texts for unit tests, without the front end and the compiler. Modules,
// expressions and productions are written as in the language. Names are identifiers or single
// characters, separated by blanks.
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

    /// Adds an axiom, such as "F(1)[+(30)A]".
    BytecodeBuilder& axiom(std::string text);
    /// Adds a production, such as "p : A(x) < B > C [ D ] : x > 0 ~ 0.5 : F(x, {1, 2}) B".
    BytecodeBuilder& production(std::string text);
    /// Adds a production of a later stage. Stages must be added in their order.
    BytecodeBuilder& production(Stage stage, std::string text);
    /// Makes modules with these names ("P H"), with any number of parameters, sense modules that
    /// ask for the position.
    BytecodeBuilder& sense(std::string names);
    /// Makes contexts skip modules with these names ("+ -"), with any number of parameters.
    BytecodeBuilder& ignore(std::string names);
    /// Adds a constant whose random value is drawn at the start.
    BytecodeBuilder& global(std::string name, std::string value);
    BytecodeBuilder& parameter(std::string name, std::string value, float minimum, float maximum);
    /// Declares symbols ("A(x) B") before the symbols of the other texts, so that a test knows
    /// their numbers.
    BytecodeBuilder& declare(std::string modules);
    /// Declares symbols that are not used, so that codes take two or four bytes.
    BytecodeBuilder& unused_symbols(std::uint32_t count);

    /// Builds the bytecode and verifies it. A mistake in a text ends the test program.
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
    std::vector<Stage> stages_; // stage of each of productions_
    std::vector<std::string> ignored_;
    std::vector<std::string> sensing_;
    std::vector<GlobalText> globals_;
    std::uint32_t unused_ = 0; // of unused_symbols()
};

} // namespace lsys::test
