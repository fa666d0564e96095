// SPDX-License-Identifier: MIT
// The part of CpfgWriter for names of modules and for the statements before the axiom.
#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/dialects/cpfg/writer.h"
#include "grammar/dialects/impl/letter_modules.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

bool is_letter(const std::string& name) {
    return name.size() == 1 &&
           ((name[0] >= 'a' && name[0] <= 'z') || (name[0] >= 'A' && name[0] <= 'Z'));
}

/// Commands of generalised cylinders.
bool is_organ_command(std::string_view name) {
    return name == "@Gs" || name == "@Gc" || name == "@Ge" || name == "@Gt" || name == "@Gr" ||
           name == "@#";
}

/// Whether the turtle profile `cpfg` has the command, which begins with `@`.
bool is_drawn(std::string_view name) {
    return name == "@v" || name == "@O" || name == "@o" || name == "@c" || is_organ_command(name) ||
           (name.size() == 3 && name.starts_with("@T"));
}

/// Whether the module asks for the turtle's state or, `?E`, an environment process.
bool is_query(std::string_view name) {
    return name.size() == 2 && name[0] == '?';
}

/// The end of the message about a command that is not drawn: what happens to the command.
std::string why_left_out(std::string_view name) {
    if (name.starts_with("@D")) {
        return "is left out: it scales all that follows";
    }
    if (name == "@!") {
        return "is left out: `contour sides:` of the view file sets the sides of all cylinders";
    }
    if (name == "@;" || name == "@,") {
        return "is left out: both sides of a surface have one colour";
    }
    if (name == "@R" || name == "@M") {
        return "is left out: it places the turtle";
    }
    return "is not drawn";
}

} // namespace

void CpfgWriter::collect_names() {
    const auto note = [&](std::vector<CpfgModule>& list, bool matched) {
        for (CpfgModule& module : list) {
            used_.insert(module.name);
            if (matched) {
                matched_.insert(module.name);
            }
            check_module(module);
            forms_.emplace(module.name, module.has_arguments);
            if (module.name == "?E" && !environment_) {
                environment_ = module.span;
            }
            if (!matched && &module != &list.front() && (&module - 1)->name == "~") {
                add_surface(module);
            }
        }
    };
    note(session_.axiom, false);
    for (CpfgProduction& production : session_.productions) {
        keep_tilde(production);
        note(production.left, true);
        note(production.predecessor, true);
        note(production.right, true);
        note(production.successor, false);
        if (production.stage == Stage::Rewrite && !production.predecessor.empty()) {
            ++alternatives_[key_of(production)];
        }
    }
}

void CpfgWriter::keep_tilde(CpfgProduction& production) const {
    const auto begins_with_tilde = [](const std::vector<CpfgModule>& list) {
        return list.size() > 1 && list.front().name == "~" && !list.front().has_arguments;
    };
    if (production.predecessor.size() == 2 && begins_with_tilde(production.predecessor) &&
        begins_with_tilde(production.successor)) {
        const auto& named = session_.considers ? session_.considered : session_.ignored;
        const bool is_named = std::any_of(named.begin(), named.end(),
                                          [](const auto& module) { return module.name == "~"; });
        if (is_named == session_.considers) { // otherwise contexts skip the `~`
            production.left.push_back(production.predecessor.front());
        }
        production.predecessor.erase(production.predecessor.begin());
        production.successor.erase(production.successor.begin());
    }
}

std::string CpfgWriter::key_of(const CpfgProduction& production) {
    std::string key;
    for (const CpfgModule& module : production.predecessor) {
        key += module.name + "/" + std::to_string(module.arguments.size()) + " ";
    }
    return key;
}

void CpfgWriter::check_module(CpfgModule& module) {
    const std::string& name = module.name;
    if (name.find('`') != std::string::npos) { // .lsys writes other names between back quotes
        session_.report_unsupported(module.span, "a back quote in the name of a module");
    } else if (name == "$") {
        session_.report_unsupported(module.span, "`$` ends a sub-L-system");
    } else if (name == "?") {
        session_.report_unsupported(module.span,
                                    module.has_arguments
                                        ? "`?(id, scale)` begins a sub-L-system, which is not read"
                                        : "a `?` before other characters than P H U L R E");
    } else if (name == "%" && module.has_arguments) {
        session_.report_unsupported(module.span,
                                    "`%` with a parameter keeps what it cuts off for an "
                                    "environment process");
    } else if (name.size() >= 2 && name[0] == '@' && !is_drawn(name)) {
        expressions_.warn_left_out(module.span, name,
                                   "`" + shown(name) + "` " + why_left_out(name));
    } else if ((name == "{" || name == "}") && module.has_arguments) {
        expressions_.warn_left_out(module.span, "{(", "parameters of `" + name + "` are left out");
    }
    // Drop strings, the texts of labels.
    std::erase_if(module.arguments, [&](ForeignId argument) {
        return name.starts_with("@") && expression(argument).kind == ForeignKind::Text;
    });
    module.has_arguments = !module.arguments.empty();
}

void CpfgWriter::add_surface(const CpfgModule& module) {
    surfaces_.emplace(module.name, module.span);
}

/// Binds the letters behind `~` to the surfaces of the view file, and writes its contours.
void CpfgWriter::write_organs() {
    for (const auto& [name, span] : surfaces_) {
        const auto found = organs_.surfaces.find(name);
        const bool is_listed = found != organs_.surfaces.end();
        const bool is_read = is_listed && !found->second.failure;
        if (!is_read) {
            expressions_.warn_left_out(is_listed ? found->second.span : span, "surface " + name,
                                       "the surface `" + shown(name) + "` is drawn as a leaf: " +
                                           (is_listed
                                                ? "cannot read `" + shown(found->second.file) +
                                                      "`: " + *found->second.failure
                                                : "no view file lists its file"));
        }
        if (is_letter(name)) {
            out_.put("#object " + name + " " + (is_read ? object_text(found->second) : "LEAF") +
                         ";\n",
                     header_);
        }
    }
    if (!std::ranges::any_of(used_, is_organ_command)) {
        return;
    }
    if (organs_.sides != 0) {
        out_.put("#set sides " + std::to_string(organs_.sides) + ";\n", header_);
    }
    for (const auto& [number, contour] : organs_.contours) {
        if (!contour.points.empty()) {
            out_.put(contour_statement(number, contour.points), header_);
            continue;
        }
        const std::string digits = std::to_string(number);
        expressions_.warn_left_out(contour.span, "contour " + digits,
                                   "contour " + digits + " is a circle: cannot read `" +
                                       shown(contour.file) + "`: " + contour.failure);
    }
}

std::string CpfgWriter::spelled(const std::string& name, bool has_arguments) const {
    if (name == ";" && used_.count("'") == 0) {
        return "'";
    }
    if (name == "@v") {
        return "$";
    }
    if (name == "#" && matched_.count("#") == 0 && matched_.count("!") == 0) {
        return has_arguments ? "!" : "`#`";
    }
    if (name == "," && has_arguments && matched_.count(",") == 0 && matched_.count(";") == 0 &&
        used_.count("'") == 0) {
        return "'";
    }
    if (is_query(name)) {
        return name;
    }
    return name.size() == 1 ? spelled_letter(static_cast<unsigned char>(name[0]))
                            : "`" + name + "`";
}

void CpfgWriter::write_setting(const char* begin, ForeignId expression, const char* fallback) {
    if (expression == kNoForeign) {
        if (fallback != nullptr) {
            out_.put(std::string(begin) + fallback + ";\n", header_);
        }
        return;
    }
    const SourceSpan span = this->expression(expression).span;
    const bool number = this->expression(expression).kind == ForeignKind::Number;
    out_.put(begin, span);
    out_.put(number ? "" : "(", span);
    tree_.write(expression, {}, out_);
    out_.put(number ? ";\n" : ");\n", span);
}

void CpfgWriter::write_depth(const char* begin, ForeignId expression, Stage stage) {
    const bool has_own_groups = bound_.count(stage) != 0;
    const bool has_rewrite_groups = stage == Stage::Decompose && bound_.count(Stage::Rewrite) != 0;
    if (!has_own_groups && !has_rewrite_groups) {
        write_setting(begin, expression, "1");
        return;
    }
    if (!has(stage)) {
        out_.put(std::string(begin) + "1;\n", header_);
        return;
    }
    ForeignId depth = expression == kNoForeign ? tree_.number("1", header_) : expression;
    depth = has_own_groups ? tree_.binary("*", depth, tree_.number("2", header_), header_) : depth;
    depth =
        has_rewrite_groups ? tree_.binary("+", depth, tree_.number("1", header_), header_) : depth;
    write_setting(begin, depth, nullptr);
}

void CpfgWriter::write_settings(std::string_view turtle) {
    out_.put("#set turtle " + std::string(turtle) + ";\n#set names letters;\n", header_);
    const auto several = [](const CpfgProduction& production) {
        return production.stage == Stage::Rewrite && production.predecessor.size() > 1;
    };
    if (std::any_of(session_.productions.begin(), session_.productions.end(), several)) {
        out_.put("#set rewriting leftmost;\n", header_);
    }
    const auto has_contexts = [](const CpfgProduction& production) {
        return production.stage == Stage::Rewrite &&
               !(production.left.empty() && production.right.empty());
    };
    if (session_.ring && std::ranges::any_of(session_.productions, has_contexts)) {
        out_.put("#set word_shape ring;\n", *session_.ring);
    }
    write_constants();
    if (!view_.angle.empty()) {
        out_.put("#set angle " + view_.angle + ";\n", header_);
    }
    for (const CpfgLooks::Text& statement : looks_.statements) {
        out_.put(statement.text, statement.span.file == kNoFile ? header_ : statement.span);
    }
    out_.put(materials_, header_);
    const bool decomposes = has(Stage::Decompose) || bound_.count(Stage::Rewrite) != 0;
    if (decomposes) {
        write_depth("#set decompose_depth ", decompose_depth_, Stage::Decompose);
    }
    if (has(Stage::Interpret)) {
        write_depth("#set interpret_depth ", interpret_depth_, Stage::Interpret);
    }
    if (decomposes || has(Stage::Interpret)) {
        out_.put("#set at_depth stop;\n", header_);
    }
    if (seed_ != kNoForeign) {
        out_.put("#set weights any;\n", header_);
        write_setting("#set seed ", seed_, nullptr);
    }
    write_setting("#n = ", length_, "0");
    write_organs();
    write_declarations();
    if (environment_) {
        out_.put("#sense E program;\n", *environment_);
    }
    if (session_.considers) {
        write_names("#consider : ", session_.considered);
    } else if (session_.ignores) {
        write_names("#ignore : ", session_.ignored);
    }
}

void CpfgWriter::write_constants() {
    expressions_.write_functions(out_, header_);
    tree_.write_constants(0, expressions_.end_of_constants(), out_);
}

void CpfgWriter::write_declarations() {
    std::set<std::string> rewritten;
    for (const CpfgProduction& production : session_.productions) {
        for (const CpfgModule& module : production.predecessor) {
            rewritten.insert(module.name);
        }
    }
    std::set<std::pair<std::string, std::size_t>> declared;
    const auto visit = [&](const std::vector<CpfgModule>& list) {
        for (const CpfgModule& module : list) {
            const std::string name = spelled(module.name, module.has_arguments);
            const bool draws =
                is_drawn(module.name) || is_query(module.name) ||
                (module.name.size() == 1 &&
                 std::string_view("#,_").find(module.name[0]) != std::string_view::npos) ||
                (name.size() == 1 && std::string_view("FfGg+-&^\\/|$!\"'[]{}.%").find(name[0]) !=
                                         std::string_view::npos);
            if (!draws && rewritten.count(module.name) == 0 && surfaces_.count(module.name) == 0 &&
                declared.insert({name, module.arguments.size()}).second) {
                out_.put("#module " + name, header_);
                for (std::size_t i = 0; i < module.arguments.size(); ++i) {
                    out_.put((i == 0 ? "(x" : ", x") + std::to_string(i + 1), header_);
                }
                out_.put(module.has_arguments ? ");\n" : ";\n", header_);
            }
        }
    };
    visit(session_.axiom);
    for (const CpfgProduction& production : session_.productions) {
        visit(production.successor);
    }
}

bool CpfgWriter::has(Stage stage) const {
    return std::any_of(session_.productions.begin(), session_.productions.end(),
                       [&](const CpfgProduction& production) { return production.stage == stage; });
}

void CpfgWriter::write_names(const char* begin, const std::vector<CpfgModule>& list) {
    std::set<std::string> wanted;
    for (const CpfgModule& module : list) {
        if (is_query(module.name)) {
            wanted.insert(module.name);
            continue;
        }
        for (const char c : module.name) {
            wanted.insert(std::string(1, c));
        }
    }
    // A command of several letters is skipped if all of them are.
    const auto is_wanted = [&](const std::string& name) {
        if (is_query(name)) {
            return wanted.count(name) != 0;
        }
        const auto has = [&](char c) { return wanted.count(std::string(1, c)) != 0; };
        return session_.considers ? std::any_of(name.begin(), name.end(), has)
                                  : std::all_of(name.begin(), name.end(), has);
    };
    for (const CpfgModule& module : list) {
        if (!session_.considers && (module.name == "[" || module.name == "]")) {
            expressions_.warn_left_out(
                module.span, "ignored bracket",
                "brackets always count in contexts; `ignore` has no effect on them");
        }
    }
    std::set<std::string> spelled_names;
    for (const auto& [name, has_arguments] : forms_) {
        if (name != "[" && name != "]" && is_wanted(name)) {
            spelled_names.insert(spelled(name, has_arguments));
        }
    }
    if (spelled_names.empty() && !session_.considers) {
        return;
    }
    out_.put(begin, header_);
    for (const std::string& name : spelled_names) {
        out_.put(name, header_);
    }
    if (spelled_names.empty()) {
        out_.put("`none`", header_); // `#consider` needs a name; no module is named `none`
    }
    out_.put(";\n", header_);
}

} // namespace lsys
