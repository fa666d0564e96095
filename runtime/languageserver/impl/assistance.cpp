// SPDX-License-Identifier: MIT
// Hover, completion and signatures. The statement at the cursor is usually unfinished and not in
// the syntax tree, so its text determines what completion offers.
#include "compiler/bytecode/environment_keys.h"
#include "compiler/bytecode/turtle_operation.h"
#include "compiler/resolve/profiles.h"
#include "grammar/ast/include_chain.h"
#include "grammar/base/characters.h"
#include "grammar/base/names.h"
#include "grammar/base/paths.h"
#include "runtime/languageserver/impl/predictions.h"
#include "runtime/languageserver/impl/vocabulary.h"
#include "runtime/languageserver/impl/workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace lsys {

namespace {

/// The kind of text that completion offers at the cursor.
enum class Slot {
    Nothing,
    Statement, // `#` and a keyword
    SettingKey,
    SettingValue,
    SenseKind,
    SenseKey,
    Object,
    Modules,
    Expression,
};

struct CursorContext {
    Slot slot = Slot::Nothing;
    std::string key;                  // key of the `#set`, kind of the `#sense`
    std::set<std::string> locals;     // formals and local values of the statement
    std::string prefix;               // the part of a word before the cursor
    std::string callee;               // name before the innermost open `(`
    std::uint32_t argument_index = 0; // commas since this `(`
    bool is_module_call = false;      // the callee is a module, else a function
};

/// The text since the last statement ended, without comments; nullopt within a comment or quotes.
std::optional<std::string> unfinished_statement(std::string_view text) {
    std::string statement;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::string_view rest = text.substr(i);
        const bool is_outside = statement.find('#') == std::string::npos;
        if (rest.starts_with("/*")) {
            const std::size_t end = rest.find("*/", 2);
            if (end == std::string_view::npos) {
                return std::nullopt;
            }
            i += end + 1;
        } else if (rest.starts_with("//") && is_outside) {
            const std::size_t end = rest.find('\n');
            if (end == std::string_view::npos) {
                return std::nullopt;
            }
            i += end;
        } else if (text[i] == '`' || (text[i] == '"' && rest.find('"', 1) < rest.find('\n'))) {
            // A `"` without a second one in its line is a module.
            const std::size_t end = rest.find(text[i], 1);
            if (end == std::string_view::npos) {
                return std::nullopt;
            }
            statement += rest.substr(0, end + 1);
            i += end;
        } else if (text[i] == ';') {
            statement.clear();
        } else {
            statement += text[i];
        }
    }
    statement.erase(0, std::min(statement.find_first_not_of(kWhitespace), statement.size()));
    return statement;
}

std::size_t word_begin(std::string_view text, std::size_t end) {
    while (end > 0 && is_word_character(text[end - 1])) {
        --end;
    }
    return end;
}

/// Adds the names in the parentheses of a predecessor; add_local_values(): those before each `=`.
void add_locals(std::string_view field, std::set<std::string>& locals) {
    int depth = 0;
    for (std::size_t i = 0; i < field.size(); ++i) {
        depth += field[i] == '(' ? 1 : field[i] == ')' ? -1 : 0;
        if (depth > 0 && is_letter(field[i])) {
            const std::size_t begin = i;
            while (i + 1 < field.size() && is_word_character(field[i + 1])) {
                ++i;
            }
            locals.emplace(field.substr(begin, i + 1 - begin));
        }
    }
}
void add_local_values(std::string_view field, std::set<std::string>& locals) {
    for (std::size_t i = field.find('='); i != std::string_view::npos; i = field.find('=', i + 1)) {
        const std::size_t end = field.find_last_not_of(kWhitespace, i - 1) + 1;
        const std::size_t begin = i == 0 ? end : word_begin(field, end);
        if (begin < end) {
            locals.emplace(field.substr(begin, end - begin));
        }
    }
}

/// Finds the innermost open parenthesis of a field.
void find_call(std::string_view field, bool is_modules, CursorContext& context) {
    std::vector<std::pair<std::size_t, std::uint32_t>> open; // place and commas
    for (std::size_t i = 0; i < field.size(); ++i) {
        if (field[i] == '(' || field[i] == '{') {
            open.emplace_back(i, 0);
        } else if ((field[i] == ')' || field[i] == '}') && !open.empty()) {
            open.pop_back();
        } else if (field[i] == ',' && !open.empty()) {
            ++open.back().second;
        }
    }
    if (open.empty() || field[open.back().first] != '(') {
        return;
    }
    context.argument_index = open.back().second;
    context.is_module_call = is_modules && open.size() == 1;
    std::size_t end = open.back().first;
    end = end == 0 ? 0 : field.find_last_not_of(kWhitespace, end - 1) + 1;
    std::size_t begin = word_begin(field, end);
    begin -=
        begin > 0 && begin < end && field[begin - 1] == '?' ? std::size_t{1} : 0; // a sense module
    context.callee = field.substr(begin, end - begin);
    if (context.callee.empty() && end > 0 && context.is_module_call) {
        context.callee = field[end - 1]; // a turtle command of one character, such as `+`
    }
    if (is_modules) {
        context.slot = Slot::Expression;
    }
}

CursorContext context_at(std::string_view before) {
    CursorContext context;
    const std::optional<std::string> statement = unfinished_statement(before);
    if (!statement || (!statement->empty() && !statement->starts_with('#'))) {
        return context;
    }
    const std::string_view text = *statement;
    const std::size_t last = word_begin(text, text.size());
    context.prefix = text.substr(last);
    std::size_t end = std::min<std::size_t>(1, text.size());
    while (end < text.size() && is_word_character(text[end])) {
        ++end;
    }
    const std::string_view word = text.substr(0, end);
    if (end == text.size()) {
        context.slot = Slot::Statement;
        context.prefix = text;
        return context;
    }
    std::vector<std::string_view> fields; // the parts between `:`
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t colon = std::min(text.find(':', begin), text.size());
        fields.push_back(text.substr(begin, colon - begin));
        begin = colon + 1;
    }
    const std::string_view field = fields.back();
    const auto modules = [&] {
        context.slot = Slot::Modules;
        if (last > 0 && text[last - 1] == '?') { // the name of a sense module
            context.prefix.insert(0, 1, '?');
        }
        find_call(field, true, context);
    };
    const auto expression = [&] {
        context.slot = Slot::Expression;
        find_call(field, false, context);
    };
    if (fields.size() == 1) {
        // The words after the keyword, without the one at the cursor.
        std::vector<std::string_view> words;
        for (std::size_t at = text.find_first_not_of(kWhitespace, end); at < last;) {
            const std::size_t stop = std::min(text.find_first_of(kWhitespace, at), last);
            words.push_back(text.substr(at, stop - at));
            at = std::min(text.find_first_not_of(kWhitespace, stop), text.size());
        }
        if (word == "#set" && words.empty()) {
            context.slot = Slot::SettingKey;
        } else if (word == "#set") {
            context.key = words[0];
            context.slot = Slot::SettingValue;
        } else if (word == "#sense" && !words.empty()) {
            context.slot = words.size() == 1 ? Slot::SenseKind : Slot::SenseKey;
            context.key = words.size() == 1 ? std::string_view() : words[1];
        } else if (word == "#object" && !words.empty()) {
            context.slot = Slot::Object;
        } else if (word == "#function") {
            add_locals(text.substr(0, std::min(text.find(')'), text.size())), context.locals);
            expression();
            if (text.find(')') == std::string_view::npos) {
                context = {};
            }
        } else if (word == "#n" || word == "#w" ||
                   ((word == "#define" || word == "#param") && !words.empty())) {
            expression();
        }
        return context;
    }
    if (word == "#w" || word == "#ignore" || word == "#consider") {
        modules();
        return context;
    }
    add_locals(fields[1], context.locals);
    const bool has_let =
        fields.size() > 3 &&
        fields[3]
            .substr(std::min(fields[3].find_first_not_of(kWhitespace), fields[3].size()))
            .starts_with("let ");
    if (has_let) {
        add_local_values(fields[3], context.locals);
    }
    if (fields.size() == 2) {
        modules();
        if (context.slot == Slot::Expression) {
            context.slot = Slot::Nothing; // the author chooses a name for a new formal
        }
    } else if (fields.size() == 3 || (fields.size() == 4 && has_let)) {
        expression();
    } else {
        modules();
    }
    return context;
}

std::string code(std::string_view text) {
    return "`" + std::string(text) + "`";
}

std::string call_text(std::string_view name, std::string_view parameters) {
    return parameters.empty() ? std::string(name) : fmt::format("{}({})", name, parameters);
}

std::string turtle_text(const TurtleCommand& command, TurtleProfile profile) {
    return fmt::format("`{}`: turtle command {} of the profile `{}`",
                       call_text(command.name, command.parameters), info(command.operation).name,
                       name_of(profile));
}

std::string file_note(const StatementOutline& statement, const std::string& path) {
    return statement.place.path == path
               ? std::string()
               : fmt::format("\n\nin `{}`", name_of_path(statement.place.path));
}

/// "`?light(q, x, y, z)`: ..." for the environment of a #sense.
std::string sense_text(std::string_view name, std::string_view kind_word) {
    const auto kind = find_environment_kind(kind_word);
    return kind ? fmt::format("`?{}{}`: {} (`{}`)", name, answer_text(*kind), meaning_of(*kind),
                              kind_word)
                : std::string();
}

/// sense_text() for `?P`, `?H`, `?U`, `?R` and `?L`; empty for other names.
std::string turtle_sense_text(std::string_view name) {
    constexpr std::array<std::string_view, kTurtleSenses.size()> kMeanings{
        "place of the turtle, in metres", "heading of the turtle", "up of the turtle",
        "right of the turtle", "left of the turtle"};
    return is_turtle_sense(name)
               ? fmt::format("`{}(x, y, z)`: {}", name, kMeanings[kTurtleSenses.find(name[1])])
               : std::string();
}

/// The meaning of a name as Markdown.
std::string name_text(const NameUse& use, const NameIndex& index, const std::string& path) {
    std::string text;
    if (use.kind == NameKind::Formal) {
        text = fmt::format("{}: parameter or local value of this statement", code(use.name));
    }
    if (use.kind == NameKind::Function) {
        if (const FunctionHelp* const row = find_function_help(use.name)) {
            text = fmt::format("`{}({})`: {}", row->name, row->parameters, row->meaning);
        }
    }
    if (use.kind == NameKind::Environment) {
        for (const StatementOutline& statement : index.statements) {
            if (statement.kind == StatementKind::Sense && statement.name == use.name) {
                text = sense_text(use.name, statement.environment_kind);
            }
        }
    }
    if (use.kind == NameKind::Module) {
        if (const std::string sense = turtle_sense_text(use.name); !sense.empty()) {
            return sense;
        }
    }
    std::set<TextPlace> defining;
    for (const NameUse& each : index.uses) {
        if (each.is_definition && NameIndex::are_same(each, use)) {
            defining.insert(each.place);
        }
    }
    std::size_t shown = 0;
    constexpr std::size_t kMaxShown = 8;
    std::string notes;
    for (const StatementOutline& statement : index.statements) {
        const bool defines =
            use.kind != NameKind::Formal &&
            std::any_of(defining.begin(), defining.end(), [&](const TextPlace& place) {
                return place.path == statement.place.path && statement.place.begin <= place.begin &&
                       place.end <= statement.place.end;
            });
        if (defines && shown < kMaxShown) {
            ++shown;
            text += fmt::format("{}```lsys\n{}\n```{}", text.empty() ? "" : "\n\n",
                                statement.detail, file_note(statement, path));
        }
    }
    const bool is_bound = std::any_of(
        index.statements.begin(), index.statements.end(), [&](const StatementOutline& statement) {
            return statement.kind == StatementKind::Object && statement.name == use.name;
        });
    if (use.kind == NameKind::Module && !is_bound) {
        if (const TurtleCommand* const command = find_turtle_command(index.profile, use.name)) {
            text = turtle_text(*command, index.profile) + (text.empty() ? "" : "\n\n") + text;
        } else if (text.empty()) {
            text = code(use.name) + ": module that nothing rewrites and the turtle does not draw";
        }
    }
    return text;
}

/// The value of a constant: a number, or the range from which it is drawn.
std::string constant_value(const CheckedDocument& checked, std::string_view name) {
    const Grammar& grammar = checked.compiled.grammar;
    if (!grammar.program) {
        return {};
    }
    for (const Constant& constant : grammar.program->constants) {
        if (grammar.names.text(constant.name) == name) {
            return constant.is_random ? "drawn once, when the derivation starts"
                                      : fmt::format("value: {}", constant.value);
        }
    }
    return {};
}

/// The colour of the `#material` at `place` in CSS notation.
std::string material_text(const CheckedDocument& checked, const TextPlace& place) {
    const Grammar& grammar = checked.compiled.grammar;
    if (!grammar.program) {
        return {};
    }
    for (const ProgramMaterial& material : grammar.program->materials) {
        const SourceSpan span = material.span;
        if (!material.colour || span.file == kNoFile || span.begin < place.begin ||
            span.end > place.end ||
            normalised_path(grammar.sources->file(span.file).path()) != place.path) {
            continue;
        }
        const auto byte = [&](std::size_t part) {
            return static_cast<int>(std::lround((*material.colour)[part] * 255.0F));
        };
        return fmt::format("colour {}: `#{:02x}{:02x}{:02x}`", material.index, byte(0), byte(1),
                           byte(2));
    }
    return {};
}

/// Kinds of completion items of LSP.
enum class ItemKind : int {
    Function = 3,
    Variable = 6,
    Class = 7,
    Property = 10,
    Value = 12,
    Keyword = 14,
    Constant = 21,
    Operator = 24,
};

class Completion {
public:
    Completion(Json range, bool takes_snippets)
        : range_(std::move(range)), takes_snippets_(takes_snippets) {}

    /// Adds an item unless there is one with this label. Returns whether it was added.
    bool add(std::string_view label, ItemKind kind, std::string_view detail) {
        if (!added_.emplace(label).second) {
            return false;
        }
        items_.push_back({{"label", label},
                          {"kind", static_cast<int>(kind)},
                          {"detail", detail},
                          {"textEdit", {{"range", range_}, {"newText", label}}}});
        return true;
    }
    void add_documented(std::string_view label,
                        ItemKind kind,
                        std::string_view detail,
                        std::string_view text) {
        if (add(label, kind, detail)) {
            items_.back()["documentation"] = {{"kind", "markdown"}, {"value", text}};
        }
    }
    /// Adds a name that is called, with placeholders for its parameters.
    void add_call(std::string_view name,
                  ItemKind kind,
                  const std::vector<std::string>& formals,
                  std::string_view text) {
        const std::string call = formals.empty()
                                     ? std::string(name)
                                     : fmt::format("{}({})", name, fmt::join(formals, ", "));
        if (!add(name, kind, call)) {
            return;
        }
        Json& item = items_.back();
        item["documentation"] = {{"kind", "markdown"}, {"value", text}};
        const bool are_names = std::all_of(formals.begin(), formals.end(),
                                           [](const auto& each) { return is_identifier(each); });
        if (takes_snippets_ && !formals.empty() && are_names) {
            std::vector<std::string> holes;
            for (std::size_t i = 0; i < formals.size(); ++i) {
                holes.push_back(fmt::format("${{{}:{}}}", i + 1, formals[i]));
            }
            item["textEdit"]["newText"] = fmt::format("{}({})", name, fmt::join(holes, ", "));
            item["insertTextFormat"] = 2; // a snippet
        }
    }
    [[nodiscard]] Json take() { return std::move(items_); }

private:
    Json range_;
    bool takes_snippets_;
    Json items_ = Json::array();
    std::set<std::string> added_;
};

std::string code_block(std::string_view text) {
    return fmt::format("```lsys\n{}\n```", text);
}

void add_modules(const NameIndex& index, Completion& items) {
    for (const StatementOutline& statement : index.statements) {
        if (statement.kind == StatementKind::Object || statement.kind == StatementKind::Module) {
            items.add_call(statement.name, ItemKind::Class, statement.formals,
                           code_block(statement.detail));
        } else if (statement.kind == StatementKind::Production) {
            for (const ModuleHead& head : statement.heads) {
                items.add_call(head.name, ItemKind::Class, head.formals,
                               code_block(statement.detail));
            }
        }
    }
    for (const StatementOutline& statement : index.statements) {
        if (statement.kind == StatementKind::Sense) {
            items.add_documented('?' + statement.name, ItemKind::Class, statement.detail,
                                 sense_text(statement.name, statement.environment_kind));
        }
    }
    for (std::size_t i = 0; i < kTurtleSenses.size(); ++i) {
        const std::string name{'?', kTurtleSenses[i]};
        items.add_documented(name, ItemKind::Class, name + "(x, y, z)", turtle_sense_text(name));
    }
    // With `#set names letters` one `#module` may declare several modules; its outline, added
    // above, has only the first name.
    for (const NameUse& use : index.uses) {
        if (use.kind == NameKind::Module && use.is_definition) {
            items.add(use.name, ItemKind::Class, "");
        }
    }
    for (const TurtleCommand& command : turtle_commands(index.profile)) {
        items.add_documented(command.name, ItemKind::Operator,
                             call_text(command.name, command.parameters),
                             turtle_text(command, index.profile));
    }
}

void add_values(const NameIndex& index, const CursorContext& context, Completion& items) {
    for (const std::string& local : context.locals) {
        items.add(local, ItemKind::Variable, "parameter or local value");
    }
    for (const StatementOutline& statement : index.statements) {
        if (statement.kind == StatementKind::Define || statement.kind == StatementKind::Param) {
            items.add_documented(statement.name, ItemKind::Constant, statement.detail,
                                 code_block(statement.detail));
        } else if (statement.kind == StatementKind::Function) {
            items.add_call(statement.name, ItemKind::Function, statement.formals,
                           code_block(statement.detail));
        } else if (statement.kind == StatementKind::Curve) {
            items.add_call(statement.name, ItemKind::Function, {"x"}, code_block(statement.detail));
        }
    }
    for (const FunctionHelp& row : function_helps()) {
        items.add_documented(row.name, ItemKind::Function,
                             fmt::format("{}({})", row.name, row.parameters), row.meaning);
    }
}

/// The keys of a kind of environment, and the shapes if it has one.
void add_sense_keys(std::string_view kind_word, Completion& items) {
    const auto kind = find_environment_kind(kind_word);
    for (const EnvironmentKey& key : environment_keys()) {
        if (!kind || !key.belongs_to(*kind)) {
            continue;
        }
        const std::string initial = default_text(key);
        items.add_documented(
            key.word, ItemKind::Property, wanted_text(key, *kind),
            fmt::format("{}{}{}", key.meaning, initial.empty() ? "" : "; default ", initial));
        if (key.form == EnvironmentKeyForm::Shape) {
            for (const std::string_view shape : space_shape_names()) {
                items.add(shape, ItemKind::Value, "shape");
            }
        }
    }
}

/// The modules and constants of a grammar of another program.
Json complete_foreign(Workspace& workspace,
                      const Document& document,
                      Places& at,
                      std::uint32_t offset) {
    const std::size_t begin = word_begin(at.text(document.path), offset);
    Completion items(at.range({document.path, static_cast<std::uint32_t>(begin), offset}), false);
    const std::shared_ptr<const NameIndex> names = workspace.names({document.path});
    for (const NameUse& use : names->uses) {
        if (use.kind == NameKind::Module || use.kind == NameKind::Constant) {
            items.add(use.name, use.kind == NameKind::Module ? ItemKind::Class : ItemKind::Constant,
                      "");
        }
    }
    for (const TurtleCommand& command : turtle_commands(names->profile)) {
        items.add_documented(command.name, ItemKind::Operator,
                             call_text(command.name, command.parameters),
                             turtle_text(command, names->profile));
    }
    return items.take();
}

/// Whether a range of LSP contains a position.
bool contains(const Json& range, const Json& position) {
    const auto key = [](const Json& place) {
        return std::pair(place.at("line").get<std::uint32_t>(),
                         place.at("character").get<std::uint32_t>());
    };
    return key(range.at("start")) <= key(position) && key(position) <= key(range.at("end"));
}

Json signature(const std::string& label, std::string_view parameters, std::uint32_t active) {
    Json list = Json::array();
    while (!parameters.empty()) {
        const std::size_t comma = std::min(parameters.find(','), parameters.size());
        std::string_view parameter = parameters.substr(0, comma);
        parameter.remove_prefix(
            std::min(parameter.find_first_not_of(kWhitespace), parameter.size()));
        list.push_back({{"label", parameter}});
        parameters.remove_prefix(std::min(comma + 1, parameters.size()));
    }
    return {{"signatures", Json::array({Json{{"label", label}, {"parameters", list}}})},
            {"activeSignature", 0},
            {"activeParameter", active}};
}

Json named_signature(const std::string& name,
                     const std::vector<std::string>& formals,
                     std::uint32_t active) {
    const std::string list = fmt::format("{}", fmt::join(formals, ", "));
    return signature(fmt::format("{}({})", name, list), list, active);
}

/// The signature of a sense module: its parameters are the numbers of the answer.
Json sense_signature(const NameIndex& index, const CursorContext& context) {
    if (is_turtle_sense(context.callee)) {
        return signature(context.callee + "(x, y, z)", "x, y, z", context.argument_index);
    }
    for (const StatementOutline& statement : index.statements) {
        const auto kind = find_environment_kind(statement.environment_kind);
        if (statement.kind == StatementKind::Sense && kind &&
            sense_name(statement.name) == context.callee) {
            std::string_view answer = answer_text(*kind);
            answer = answer.substr(1, answer.size() - 2); // without parentheses
            return signature(context.callee + std::string(answer_text(*kind)), answer,
                             context.argument_index);
        }
    }
    return nullptr;
}

} // namespace

Json hover(Workspace& workspace, const Json& params) {
    Document& document = workspace.document(params.at("textDocument").at("uri"));
    const Json& position = params.at("position");
    Places at(workspace);
    const std::uint32_t offset = at.offset(document.path, position);
    std::vector<std::string> parts;
    Json range;
    {
        const std::shared_ptr<const NameIndex> names =
            workspace.names(workspace.roots_of(document.path));
        const NameIndex& index = *names;
        if (const NameUse* const use = index.at(document.path, offset)) {
            range = at.range(use->place);
            if (std::string text = name_text(*use, index, document.path); !text.empty()) {
                parts.push_back(std::move(text));
            }
            if (use->kind == NameKind::Constant) {
                if (std::string text = constant_value(workspace.check(document), use->name);
                    !text.empty()) {
                    parts.push_back(std::move(text));
                }
            }
        }
        const std::string& text = at.text(document.path);
        std::size_t begin = word_begin(text, offset);
        std::size_t end = offset;
        while (end < text.size() && is_word_character(text[end])) {
            ++end;
        }
        if (begin > 0 && text[begin - 1] == '#') {
            const StatementHelp* const row =
                find_statement_help(std::string_view(text).substr(begin - 1, end - begin + 1));
            if (row != nullptr && parts.empty()) {
                parts.push_back(fmt::format("`{}`: {}", row->form, row->meaning));
            }
        }
        for (const StatementOutline& statement : index.statements) {
            const bool is_here = statement.place.path == document.path &&
                                 statement.place.begin <= offset && offset <= statement.place.end;
            if (is_here && (statement.kind == StatementKind::Generations ||
                            statement.kind == StatementKind::Axiom)) {
                if (std::string length = predicted_length(workspace.check(document).compiled);
                    !length.empty()) {
                    parts.push_back(std::move(length));
                }
            }
            if (is_here && statement.kind == StatementKind::Material) {
                if (std::string colour = material_text(workspace.check(document), statement.place);
                    !colour.empty()) {
                    parts.push_back(std::move(colour));
                }
            }
            if (statement.kind == StatementKind::Set &&
                statement.name_place.path == document.path &&
                statement.name_place.begin <= offset && offset <= statement.name_place.end) {
                if (const auto setting = find_setting_help(statement.name)) {
                    parts.push_back(fmt::format("`#set {}`: {}", setting->name, setting->meaning));
                }
            }
        }
    }
    std::set<std::string> explained;
    for (const Json& diagnostic : document_diagnostics(workspace, document)) {
        if (!diagnostic.contains("code") || !contains(diagnostic.at("range"), position)) {
            continue;
        }
        const auto name = diagnostic.at("code").get<std::string>();
        const std::string text = workspace.host.explain ? workspace.host.explain(name) : "";
        if (!text.empty() && explained.insert(name).second) {
            parts.push_back(fmt::format("**{}**: {}", name, text));
        }
    }
    if (parts.empty()) {
        return nullptr;
    }
    Json result{
        {"contents",
         {{"kind", "markdown"}, {"value", fmt::format("{}", fmt::join(parts, "\n\n---\n\n"))}}}};
    if (!range.is_null()) {
        result["range"] = range;
    }
    return result;
}

Json complete(Workspace& workspace, const Json& params) {
    const Document& document = workspace.document(params.at("textDocument").at("uri"));
    Places at(workspace);
    const std::uint32_t offset = at.offset(document.path, params.at("position"));
    if (!document.has_lsys_text()) {
        return complete_foreign(workspace, document, at, offset);
    }
    const CursorContext context =
        context_at(std::string_view(at.text(document.path)).substr(0, offset));
    Completion items(at.range({document.path,
                               offset - static_cast<std::uint32_t>(context.prefix.size()), offset}),
                     workspace.editor.snippets);
    if (context.slot == Slot::Modules || context.slot == Slot::Expression ||
        context.slot == Slot::SettingValue) {
        const std::shared_ptr<const NameIndex> names =
            workspace.names(workspace.roots_of(document.path));
        const NameIndex& index = *names;
        if (context.slot == Slot::Modules) {
            add_modules(index, items);
        } else if (const auto setting = find_setting_help(context.key);
                   setting && !setting->values.empty()) {
            for (const std::string& value : setting->values) {
                items.add_documented(value, ItemKind::Value, setting->name, setting->meaning);
            }
        } else {
            add_values(index, context, items);
        }
    } else if (context.slot == Slot::Statement) {
        for (const StatementHelp& row : statement_helps()) {
            items.add_documented(row.name, ItemKind::Keyword, row.form, row.meaning);
        }
    } else if (context.slot == Slot::SettingKey) {
        for (const SettingHelp& setting : setting_helps()) {
            items.add_documented(setting.name, ItemKind::Property, setting.meaning,
                                 setting.meaning);
        }
    } else if (context.slot == Slot::SenseKind) {
        for (const std::string_view word : environment_kind_names()) {
            const EnvironmentKind kind = *find_environment_kind(word);
            items.add_documented(word, ItemKind::Value, answer_text(kind), meaning_of(kind));
        }
    } else if (context.slot == Slot::SenseKey) {
        add_sense_keys(context.key, items);
    } else if (context.slot == Slot::Object) {
        for (const TurtleObject& object : turtle_objects()) {
            items.add_documented(object.name, ItemKind::Value, "object",
                                 info(object.operation).name);
        }
    }
    return items.take();
}

Json signature_help(Workspace& workspace, const Json& params) {
    const Document& document = workspace.document(params.at("textDocument").at("uri"));
    Places at(workspace);
    const std::uint32_t offset = at.offset(document.path, params.at("position"));
    const CursorContext context =
        context_at(std::string_view(at.text(document.path)).substr(0, offset));
    if (context.callee.empty() || !document.has_lsys_text()) {
        return nullptr;
    }
    const std::shared_ptr<const NameIndex> names =
        workspace.names(workspace.roots_of(document.path));
    const NameIndex& index = *names;
    for (const StatementOutline& statement : index.statements) {
        const bool is_callee = context.is_module_call ? statement.kind == StatementKind::Module
                                                      : statement.kind == StatementKind::Function;
        if (is_callee && statement.name == context.callee) {
            return named_signature(statement.name, statement.formals, context.argument_index);
        }
        for (const ModuleHead& head : statement.heads) {
            if (context.is_module_call && head.name == context.callee && !head.formals.empty()) {
                return named_signature(head.name, head.formals, context.argument_index);
            }
        }
        if (!context.is_module_call && statement.kind == StatementKind::Curve &&
            statement.name == context.callee) {
            return signature(statement.name + "(x)", "x", context.argument_index);
        }
    }
    if (context.is_module_call && context.callee.starts_with('?')) {
        return sense_signature(index, context);
    }
    if (context.is_module_call) {
        const TurtleCommand* const command = find_turtle_command(index.profile, context.callee);
        if (command != nullptr && !command->parameters.empty()) {
            return signature(call_text(command->name, command->parameters), command->parameters,
                             context.argument_index);
        }
        return nullptr;
    }
    if (const FunctionHelp* const row = find_function_help(context.callee)) {
        Json help = signature(fmt::format("{}({})", row->name, row->parameters), row->parameters,
                              context.argument_index);
        help["signatures"][0]["documentation"] = row->meaning;
        return help;
    }
    return nullptr;
}

} // namespace lsys
