// SPDX-License-Identifier: MIT
// #module, #object, #ignore and #consider: properties of modules by name.
#pragma once

#include "compiler/resolve/impl/words.h"

#include <unordered_map>

namespace lsys {

class DeclarationResolver {
public:
    DeclarationResolver(Resolution& resolution,
                        SymbolTable& symbols,
                        EnvironmentResolver& environments)
        : resolution_(resolution), symbols_(symbols), environments_(environments) {}

    /// Binds the module of an #object statement to its object, or reports mistakes. Call for all
    /// objects before the NameSplitter and any symbol are made.
    void object(const ObjectNode& node);
    /// Reads an #ignore or #consider statement. Call after object() and before any symbol is made.
    void ignore(const IgnoreNode& node, NameSplitter& splitter);
    /// Applies #consider: all other modules are ignored. Call after all statements.
    void finish_ignores();
    /// Adds the symbol of a #module statement, or reports its mistakes.
    void module(const ModuleDeclarationNode& node, SourceSpan statement, ModuleReading& reading);

private:
    /// Reports file names with variables or formats of other programs.
    [[nodiscard]] bool check_file_name(const ObjectNode& node);
    /// The object that the statement binds; nothing after a report.
    [[nodiscard]] std::optional<ObjectBinding> object_of(const ObjectNode& node);
    /// Reads the name of a contour after the object; returns false after reporting a mistake.
    [[nodiscard]] bool set_contour(const ObjectNode& node, ObjectBinding& binding);
    /// Makes modules of this name draw the object; reports a second object for the name.
    void bind(const ModuleView& module, ObjectBinding binding);
    /// Reads one module of a statement: of #consider if `considers`, else of #ignore.
    void ignore_module(const ModuleView& module,
                       bool considers,
                       NameSplitter& splitter,
                       SplitReport& splits);
    [[nodiscard]] bool check_not_sense(const ModuleView& module, const char* statement);
    /// Returns false after reporting that the module has parentheses.
    [[nodiscard]] bool check_no_parentheses(const ModuleView& module, const char* statement);
    void report_bad_declaration(SourceSpan span, std::string message);
    /// Checks that a statement names one module; with `names letters` it may name several.
    [[nodiscard]] bool check_one_name(ModuleList list, SourceSpan statement, const char* keyword);

    Resolution& resolution_;
    SymbolTable& symbols_;
    EnvironmentResolver& environments_;
    Suggestions suggestions_;
    SourceSpan first_ignore_;                          // first #ignore; kNoFile if there is none
    SourceSpan first_consider_;                        // first #consider; kNoFile if there is none
    std::unordered_map<NameId, std::size_t> bindings_; // index in Program::objects
};

} // namespace lsys
