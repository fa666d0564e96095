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

    /// Call for all objects before the NameSplitter and any symbol are made.
    void object(const ObjectNode& node);
    /// Call after object() and before any symbol is made.
    void ignore(const IgnoreNode& node, NameSplitter& splitter);
    /// Call after all statements.
    void finish_ignores();
    void module(const ModuleDeclarationNode& node, SourceSpan statement, ModuleReading& reading);

private:
    [[nodiscard]] bool check_file_name(const ObjectNode& node);
    [[nodiscard]] std::optional<ObjectBinding> object_of(const ObjectNode& node);
    [[nodiscard]] bool set_contour(const ObjectNode& node, ObjectBinding& binding);
    void bind(const ModuleView& module, ObjectBinding binding);
    void ignore_module(const ModuleView& module,
                       bool considers,
                       NameSplitter& splitter,
                       SplitReport& splits);
    [[nodiscard]] bool check_not_sense(const ModuleView& module, const char* statement);
    [[nodiscard]] bool check_bare(const ModuleView& module, const char* statement);
    void report_bad_declaration(SourceSpan span, std::string message);
    [[nodiscard]] bool check_one_name(ModuleList list, SourceSpan statement, const char* keyword);

    Resolution& resolution_;
    SymbolTable& symbols_;
    EnvironmentResolver& environments_;
    Suggestions suggestions_;
    SourceSpan first_ignore_; // kNoFile if there is none
    SourceSpan first_consider_;
    std::unordered_map<NameId, std::size_t> bindings_; // index in Program::objects
};

} // namespace lsys
