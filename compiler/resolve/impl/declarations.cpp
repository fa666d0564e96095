// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/declarations.h"

#include "compiler/resolve/impl/definitions.h"
#include "compiler/resolve/profiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

/// Whether the file name ends in `.png`. `#object {` takes a picture, which is drawn on polygons.
bool is_picture(std::string_view file) {
    constexpr std::string_view kExtension = ".png";
    return file.size() > kExtension.size() &&
           std::equal(kExtension.begin(), kExtension.end(), file.end() - kExtension.size(),
                      [](char wanted, char c) {
                          return wanted == (c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
                      });
}

} // namespace

void DeclarationResolver::report_bad_declaration(SourceSpan span, std::string message) {
    resolution_.diagnostics.add(DiagnosticCode::BadDeclaration, span, std::move(message));
}

bool DeclarationResolver::check_one_name(ModuleList list,
                                         SourceSpan statement,
                                         const char* keyword) {
    if (list.count == 0) {
        report_bad_declaration(statement, fmt::format("`{}` names no module", keyword));
        return false;
    }
    const auto& letters = resolution_.letter_files;
    const bool is_letters =
        std::find(letters.begin(), letters.end(), list.span.file) != letters.end();
    if (list.count > 1 && !is_letters) {
        report_bad_declaration(list.span,
                               fmt::format("`{}` takes one module, not {}", keyword, list.count));
        return false;
    }
    return true;
}

bool DeclarationResolver::check_no_parentheses(const ModuleView& module, const char* statement) {
    if (!module.has_parentheses) {
        return true;
    }
    const SourceSpan parentheses{module.span.file, module.name_span.end, module.span.end};
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::BadDeclaration, parentheses,
        fmt::format("`{}` is about modules with any number of parameters", statement));
    // Formals can be removed without changing the meaning; numbers may be meant as arguments.
    const bool has_only_formals =
        resolution_.sources.text(parentheses).find_first_of("0123456789") == std::string_view::npos;
    error.fixes.push_back({"leave the parentheses out", {{parentheses, ""}}, has_only_formals});
    return false;
}

/// Reports a sense module in `statement`, since sense modules draw nothing and only `#sense`
/// declares them. Returns false after a report.
bool DeclarationResolver::check_not_sense(const ModuleView& module, const char* statement) {
    const std::string_view name = resolution_.text(module.name);
    if (!is_sense_name(name)) {
        return true;
    }
    const bool is_object = std::string_view(statement) == "#object";
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::BadDeclaration, module.name_span,
        is_object ? fmt::format("`{}` senses, and draws no object", name)
                  : fmt::format("`{}` needs no `#module`", name));
    error.help.emplace_back(
        is_object ? fmt::format("to draw something in its place, write `#interpret p : {} : * : L;`"
                                " with `#object L ...;`",
                                name)
        : is_turtle_sense(name) ? "`?P ?H ?U ?R ?L` are built in"
                                : "`#sense` declares it");
    return false;
}

void DeclarationResolver::object(const ObjectNode& node) {
    std::optional<ObjectBinding> binding = object_of(node);
    if (!check_one_name(node.name, node.object_span, "#object")) {
        return;
    }
    ModuleCursor cursor(resolution_.ast, resolution_.names, resolution_.sources, node.name);
    for (; !cursor.done(); cursor.next()) {
        const ModuleView module = cursor.view();
        const std::string_view name = resolution_.text(module.name);
        if (!check_not_sense(module, "#object") || !check_no_parentheses(module, "#object")) {
            continue;
        }
        if (is_structural(resolution_.program.settings.turtle, name)) {
            if (name == "{" && binding && is_picture(binding->mesh_file)) {
                ObjectBinding picture = *binding;
                picture.object = TurtleOperation::PolygonBegin;
                bind(module, std::move(picture));
                continue;
            }
            report_bad_declaration(module.name_span,
                                   fmt::format("`{}` cannot draw an object", name));
        } else if (binding) {
            bind(module, *binding);
        }
    }
}

bool DeclarationResolver::check_file_name(const ObjectNode& node) {
    const std::string_view name = node.object;
    const bool has_variable = name.starts_with('$') || name.find("/$") != std::string_view::npos;
    const bool is_foreign = name.find(".bgeo") != std::string_view::npos ||
                            name.ends_with(".geo") || name.ends_with(".fbx") ||
                            name.ends_with(".abc") || name.ends_with(".blend");
    if (!has_variable && !is_foreign) {
        return true;
    }
    const std::size_t slash =
        has_variable ? name.find('/', name.find('$')) : std::string_view::npos;
    std::string plain(slash == std::string_view::npos ? name : name.substr(slash + 1));
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::UnknownObject, node.object_span,
        has_variable ? fmt::format("`{}` is not expanded in the name of a file",
                                   name.substr(name.find('$'), slash - name.find('$')))
                     : fmt::format("lsc does not read `{}`", name));
    if (is_foreign) {
        const std::size_t base = plain.rfind('/') == std::string::npos ? 0 : plain.rfind('/');
        plain = plain.substr(0, plain.find('.', base)) + ".obj";
        error.help.emplace_back("export the object as OBJ");
    }
    error.help.emplace_back("names of files are relative to the folder of this file");
    add_fix(error, fmt::format("write `\"{}\"`", plain), node.object_span,
            fmt::format("\"{}\"", plain), false);
    return false;
}

bool DeclarationResolver::set_contour(const ObjectNode& node, ObjectBinding& binding) {
    if (node.contour.empty()) {
        return true; // CONTOUR alone sets the circle
    }
    if (binding.object != TurtleOperation::SetContour) {
        resolution_.diagnostics
            .add(DiagnosticCode::BadDeclaration, node.contour_span,
                 fmt::format("`{}` takes no name", node.object))
            .help.emplace_back("`CONTOUR` takes the name of a `#contour`");
        return false;
    }
    std::vector<std::string_view> names;
    for (const CurveNode& contour : resolution_.ast.contours) {
        names.push_back(resolution_.text(contour.name));
    }
    if (std::find(names.begin(), names.end(), node.contour) == names.end()) {
        Diagnostic& error =
            resolution_.diagnostics.add(DiagnosticCode::UnknownObject, node.contour_span,
                                        fmt::format("there is no contour `{}`", node.contour));
        const std::string nearest = suggestions_.nearest(node.contour, names);
        if (!nearest.empty()) {
            suggest(error, node.contour_span, nearest);
        } else {
            error.help.push_back(fmt::format(
                "declare it: `#contour {} 0.5 0, 0 0.5, -0.5 0, 0 -0.5, 0.5 0;`", node.contour));
        }
        return false;
    }
    binding.mesh_file = node.contour;
    return true;
}

std::optional<ObjectBinding> DeclarationResolver::object_of(const ObjectNode& node) {
    ObjectBinding binding;
    binding.object_span = node.object_span;
    if (node.is_file) {
        if (node.object.empty()) {
            resolution_.diagnostics.add(DiagnosticCode::UnknownObject, node.object_span,
                                        "a file without a name");
            return std::nullopt;
        }
        if (!check_file_name(node)) {
            return std::nullopt;
        }
        binding.object = TurtleOperation::MeshFile;
        binding.mesh_file = node.object;
        return binding;
    }
    if (const auto object = find_turtle_object(node.object)) {
        binding.object = *object;
        return set_contour(node, binding) ? std::optional(binding) : std::nullopt;
    }
    std::vector<std::string_view> objects;
    for (const TurtleObject& object : turtle_objects()) {
        objects.push_back(object.name);
    }
    Diagnostic& error =
        resolution_.diagnostics.add(DiagnosticCode::UnknownObject, node.object_span,
                                    fmt::format("there is no object {}", quoted(node.object)));
    const std::string nearest = suggestions_.nearest(node.object, objects);
    if (!nearest.empty()) {
        suggest(error, node.object_span, nearest);
    }
    error.notes.push_back(fmt::format("the objects are `{}` and names of files in quotes",
                                      fmt::join(objects, "`, `")));
    return std::nullopt;
}

void DeclarationResolver::bind(const ModuleView& module, ObjectBinding binding) {
    std::vector<ObjectBinding>& objects = resolution_.program.objects;
    const auto [at, is_new] = bindings_.try_emplace(module.name, objects.size());
    if (!is_new) {
        const ObjectBinding& first = objects[at->second];
        if (first.object != binding.object || first.mesh_file != binding.mesh_file) {
            report_duplicate(resolution_, module.name_span, first.name_span,
                             fmt::format("object for {}", quoted(resolution_.text(module.name))));
        }
        return;
    }
    binding.name = module.name;
    binding.name_span = module.name_span;
    symbols_.bind(binding.name, binding.object, binding.mesh_file);
    objects.push_back(std::move(binding));
}

void DeclarationResolver::ignore(const IgnoreNode& node, NameSplitter& splitter) {
    SplitReport splits(resolution_);
    ModuleCursor cursor(resolution_.ast, resolution_.names, resolution_.sources, node.modules);
    for (; !cursor.done(); cursor.next()) {
        ignore_module(cursor.view(), node.considers, splitter, splits);
    }
    splits.finish();
    SourceSpan& first = node.considers ? first_consider_ : first_ignore_;
    first = first.file == kNoFile ? node.keyword_span : first;
    if (first_ignore_.file != kNoFile && first_consider_.file != kNoFile) {
        Diagnostic& error =
            resolution_.diagnostics.add(DiagnosticCode::BadDeclaration, node.keyword_span,
                                        "a grammar cannot have both `#ignore` and `#consider`");
        error.labels.push_back(
            {node.considers ? first_ignore_ : first_consider_,
             node.considers ? "modules are ignored here" : "all but these are ignored already"});
    }
}

void DeclarationResolver::finish_ignores() {
    if (first_consider_.file != kNoFile) {
        symbols_.ignore_all_but_considered();
    }
}

void DeclarationResolver::ignore_module(const ModuleView& module,
                                        bool considers,
                                        NameSplitter& splitter,
                                        SplitReport& splits) {
    if (!environments_.check_name(module.name, module.name_span) ||
        !check_no_parentheses(module, considers ? "#consider" : "#ignore")) {
        return;
    }
    const SymbolKind kind =
        kind_of(resolution_.program.settings.turtle, resolution_.text(module.name));
    if (kind == SymbolKind::BranchOpen || kind == SymbolKind::BranchClose) {
        report_bad_declaration(module.name_span,
                               considers
                                   ? "brackets count in any case: contexts follow the branches"
                                   : "brackets cannot be ignored: contexts follow the branches");
        return;
    }
    const auto add = [&](NameId name, SourceSpan span) {
        if (considers) {
            symbols_.consider(name);
            resolution_.program.considered.push_back({name, span});
        } else {
            symbols_.ignore(name);
            resolution_.program.ignored.push_back({name, span});
        }
    };
    const std::span<const NamePart> parts = module.is_indivisible
                                                ? std::span<const NamePart>{}
                                                : splitter.parts(module.name, 0, module.span.file);
    if (parts.empty()) {
        add(module.name, module.name_span);
        return;
    }
    splits.add(module.name_span, module.name_span, parts);
    for (const NamePart& part : parts) {
        const std::uint32_t begin = module.name_span.begin + part.offset;
        const auto size = static_cast<std::uint32_t>(resolution_.text(part.name).size());
        add(part.name, {module.span.file, begin, begin + size});
    }
}

void DeclarationResolver::module(const ModuleDeclarationNode& node,
                                 SourceSpan statement,
                                 ModuleReading& reading) {
    if (!check_one_name(node.modules, statement, "#module")) {
        return;
    }
    reading.expressions.begin_statement();
    ModuleCursor cursor(resolution_.ast, resolution_.names, resolution_.sources, node.modules);
    for (; !cursor.done(); cursor.next()) {
        const ModuleView module = cursor.view();
        if (!check_not_sense(module, "#module") || !check_module(reading, module)) {
            continue;
        }
        for (std::uint32_t i = 0; i < module.arguments.count; ++i) {
            const Expression& formal = resolution_.ast.expression(
                resolution_.ast.expression_lists[module.arguments.first + i]);
            if (formal.kind == ExpressionKind::Name) {
                if (!reading.expressions.add_formal(formal.name, formal.span())) {
                    Diagnostic& error = resolution_.diagnostics.add(
                        DiagnosticCode::DuplicateFormal, formal.span(),
                        fmt::format("a second parameter `{}`", resolution_.text(formal.name)));
                    error.labels.push_back(
                        {reading.expressions.formal_span(formal.name), "the first is here"});
                }
            } else if (formal.kind != ExpressionKind::Error) {
                resolution_.diagnostics.add(DiagnosticCode::ExpressionInHead, formal.span(),
                                            "a parameter is a name here, not a value");
            }
        }
        resolution_.program.declarations.push_back(
            {symbols_.get(module.name, module.arguments.count), module.span});
    }
}

} // namespace lsys
