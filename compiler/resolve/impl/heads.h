// SPDX-License-Identifier: MIT
// Resolves heads of productions, `left < predecessor > right`, to patterns and formals.
#pragma once

#include "compiler/resolve/impl/constants.h"
#include "compiler/resolve/impl/words.h"

namespace lsys {

class HeadResolver {
public:
    HeadResolver(ModuleReading& reading, ConstantTable& constants)
        : reading_(reading), resolution_(reading.resolution), constants_(constants) {}

    /// Sets contexts, predecessor and formals of `production`, and adds the formals to the
    /// ExpressionResolver. Returns false after reporting an error of the head.
    [[nodiscard]] bool resolve(const ProductionNode& node, Production& production);

private:
    enum class Part : std::uint8_t { Left, Predecessor, Right };

    [[nodiscard]] bool read_pattern(ModuleList list, Part part, ProgramPattern& out);
    [[nodiscard]] bool read_bracket(const ModuleView& module, Part part, ProgramPattern& out);
    [[nodiscard]] bool read_formals(const ModuleView& module);
    [[nodiscard]] bool read_formal(const Expression& argument);
    /// Appends a module, or the parts of a name that is split, to a pattern.
    void append(const ModuleView& module, std::uint32_t first_formal, ProgramPattern& out);
    /// Reports a number or expression in place of a formal: `A(2)` for `A(x) : x == 2`.
    void report_argument(const Expression& argument);
    /// The edit that adds the condition `test` to a production without one.
    [[nodiscard]] std::optional<Edit> condition_edit(const std::string& test) const;
    /// Checks that there is at least one predecessor module and no empty context.
    [[nodiscard]] bool check_shape(const ProductionNode& node);
    /// Checks the number of modules and the contexts of a head of a later stage.
    [[nodiscard]] bool check_stage(const ProductionNode& node);
    /// Checks that a production of #down has no left context and one of #up no right context, and
    /// that the predecessor is one module.
    [[nodiscard]] bool check_sweep(const ProductionNode& node);

    ModuleReading& reading_;
    Resolution& resolution_;
    ConstantTable& constants_;
    const ProductionNode* node_ = nullptr; // arguments of resolve(); null before the first call
    Production* production_ = nullptr;
    std::vector<SourceSpan> open_;  // open brackets of the right context
    bool bracket_reported_ = false; // a bracket of the current pattern has been reported
};

} // namespace lsys
