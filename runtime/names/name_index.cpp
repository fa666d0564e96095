// SPDX-License-Identifier: MIT
#include "runtime/names/name_index.h"

#include "compiler/bytecode/environment_keys.h"
#include "compiler/resolve/known_words.h"
#include "compiler/resolve/profiles.h"
#include "grammar/ast/include_chain.h"
#include "grammar/base/characters.h"
#include "grammar/base/counted_enum.h"
#include "grammar/lsys/parse.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

constexpr std::size_t kMaxDetail = 100; // bytes of StatementOutline::detail

/// `text` with each run of whitespace as one blank, cut after kMaxDetail bytes.
std::string one_line(std::string_view text) {
    std::string line;
    for (const char c : text) {
        const bool is_blank = kWhitespace.find(c) != std::string_view::npos;
        if (is_blank ? !line.empty() && line.back() != ' ' : true) {
            line += is_blank ? ' ' : c;
        }
        if (line.size() >= kMaxDetail && (static_cast<unsigned char>(c) & 0x80U) == 0) {
            return line + "...";
        }
    }
    return line;
}

class Indexer {
public:
    explicit Indexer(const ParsedGrammar& parsed)
        : parsed_(parsed), ast_(parsed.ast), names_(parsed.names) {
        for (std::uint32_t i = 0; i < parsed.sources.file_count(); ++i) {
            paths_.push_back(normalised_path(parsed.sources.file(static_cast<FileId>(i)).path()));
        }
        find_profile();
        find_known();
    }

    NameIndex run() {
        for (const Statement& statement : ast_.statements) {
            scope_ = place(statement.span);
            locals_.clear();
            outline_ = {};
            outline_.kind = statement.kind;
            outline_.place = scope_;
            outline_.detail = one_line(parsed_.sources.text(statement.span));
            add(statement);
            index_.statements.push_back(std::move(outline_));
        }
        std::sort(index_.uses.begin(), index_.uses.end());
        index_.uses.erase(std::unique(index_.uses.begin(), index_.uses.end()), index_.uses.end());
        return std::move(index_);
    }

private:
    [[nodiscard]] TextPlace place(SourceSpan span) const {
        return span.file == kNoFile
                   ? TextPlace{}
                   : TextPlace{paths_[static_cast<std::size_t>(span.file)], span.begin, span.end};
    }

    void find_profile() {
        for (const Statement& statement : ast_.statements) {
            if (statement.kind != StatementKind::Set) {
                continue;
            }
            const SetNode& set = ast_.sets[statement.index];
            if (names_.text(set.key) != "turtle" || set.values.count != 1 ||
                !ast_.set_values[set.values.first].is_word) {
                continue;
            }
            for (const TurtleProfile profile : enumerators_of<TurtleProfile>()) {
                if (name_of(profile) == names_.text(ast_.set_values[set.values.first].word)) {
                    index_.profile = profile;
                }
            }
        }
    }

    /// Finds the names of constants, and the known names of modules, into which unknown names are
    /// split (docs/language.md section 3.2).
    void find_known() {
        const auto add_all = [&](ModuleList list) {
            for (ModuleCursor cursor(ast_, names_, parsed_.sources, list); !cursor.done();
                 cursor.next()) {
                known_.insert(names_.text(cursor.name()));
            }
        };
        for (const Statement& statement : ast_.statements) {
            if (statement.kind == StatementKind::Production) {
                add_all(ast_.productions[statement.index].predecessor);
            } else if (statement.kind == StatementKind::Module) {
                add_all(ast_.module_declarations[statement.index].modules);
            } else if (statement.kind == StatementKind::Object) {
                add_all(ast_.objects[statement.index].name);
            } else if (statement.kind == StatementKind::Define) {
                constants_.insert(names_.text(ast_.defines[statement.index].name));
            } else if (statement.kind == StatementKind::Param) {
                constants_.insert(names_.text(ast_.params[statement.index].name));
            }
        }
        for (const TurtleCommand& command : turtle_commands(index_.profile)) {
            known_.insert(command.name);
        }
    }

    void put(NameKind kind, std::string_view name, SourceSpan span, bool is_definition) {
        if (span.file == kNoFile || parsed_.sources.text(span) != name) {
            return; // written differently, for example with typographic characters
        }
        NameUse use;
        use.place = place(span);
        use.kind = kind;
        use.name = name;
        use.is_definition = is_definition;
        use.is_part = is_part_;
        if (kind == NameKind::Formal) {
            use.scope = scope_;
        }
        index_.uses.push_back(std::move(use));
    }
    void put_definition(NameKind kind, NameId name, SourceSpan span) {
        put(kind, names_.text(name), span, true);
        const bool is_written =
            span.file != kNoFile && parsed_.sources.text(span) == names_.text(name);
        outline_.name =
            parsed_.is_translated && !is_written ? outline_.detail : std::string(names_.text(name));
        outline_.name_place = place(span);
    }

    /// The only way to split a name into known names; empty if there is none or several.
    [[nodiscard]] std::vector<std::size_t> split(std::string_view name) const {
        std::vector<int> ways(name.size() + 1);
        std::vector<std::size_t> from(name.size() + 1);
        ways[0] = 1;
        for (std::size_t begin = 0; begin < name.size(); ++begin) {
            for (std::size_t end = begin + 1; ways[begin] != 0 && end <= name.size(); ++end) {
                if (known_.contains(name.substr(begin, end - begin))) {
                    ways[end] = std::min(2, ways[end] + ways[begin]);
                    from[end] = begin;
                }
            }
        }
        std::vector<std::size_t> ends;
        if (ways[name.size()] == 1) {
            for (std::size_t end = name.size(); end > 0; end = from[end]) {
                ends.push_back(end);
            }
            std::reverse(ends.begin(), ends.end());
        }
        return ends;
    }

    /// Adds a use of `?P`, `?H`, `?U`, `?R` or `?L` as the name of a module, and a use of another
    /// `?NAME` as the name of an environment.
    void add_sense(std::string_view name, SourceSpan span) {
        if (is_turtle_sense(name)) {
            put(NameKind::Module, name, span, false);
        } else if (parsed_.sources.text(span) == name) {
            ++span.begin;
            put(NameKind::Environment, name.substr(1), span, false);
        }
    }

    void add_module(const ModuleView& module, bool is_definition) {
        constexpr std::size_t kMaxSplit = 256; // longer names are not split here
        const std::string_view name = names_.text(module.name);
        SourceSpan span = module.name_span;
        const std::string_view written = parsed_.sources.text(span);
        if (written.size() == name.size() + 2 && written.starts_with('`')) {
            ++span.begin;
            --span.end;
        }
        if (is_sense_name(name)) {
            add_sense(name, span);
            return;
        }
        if (!is_definition && !module.is_indivisible && is_identifier(name) &&
            name.size() <= kMaxSplit && !known_.contains(name) && written == name) {
            const std::vector<std::size_t> ends = split(name);
            is_part_ = ends.size() > 1;
            std::size_t begin = 0;
            for (const std::size_t end : ends) {
                put(NameKind::Module, name.substr(begin, end - begin),
                    {span.file, span.begin + static_cast<std::uint32_t>(begin),
                     span.begin + static_cast<std::uint32_t>(end)},
                    false);
                begin = end;
            }
            is_part_ = false;
            if (!ends.empty()) {
                return;
            }
        }
        put(NameKind::Module, name, span, is_definition);
    }

    enum class Arguments { Formals, Values };
    void add_modules(ModuleList list, bool is_definition, Arguments arguments) {
        for (ModuleCursor cursor(ast_, names_, parsed_.sources, list); !cursor.done();
             cursor.next()) {
            const ModuleView module = cursor.view();
            add_module(module, is_definition);
            for (std::uint32_t i = 0; i < module.arguments.count; ++i) {
                const ExpressionId id = ast_.expression_lists[module.arguments.first + i];
                if (arguments == Arguments::Formals) {
                    add_formal(id);
                } else {
                    add_expression(id);
                }
            }
        }
    }

    void add_formal(ExpressionId id) {
        const Expression& formal = ast_.expression(id);
        if (formal.kind == ExpressionKind::Name) {
            add_local(formal.name, formal.span());
        }
    }
    void add_local(NameId name, SourceSpan span) {
        put(NameKind::Formal, names_.text(name), span, true);
        locals_.insert(name);
        outline_.formals.emplace_back(names_.text(name));
    }

    void add_expression(ExpressionId root) {
        std::vector<ExpressionId> left{root};
        while (!left.empty()) {
            const ExpressionId id = left.back();
            left.pop_back();
            if (id == kNoExpression) {
                continue;
            }
            const Expression& expression = ast_.expression(id);
            switch (expression.kind) {
            case ExpressionKind::Name:
                put(locals_.contains(expression.name) ? NameKind::Formal : NameKind::Constant,
                    names_.text(expression.name), expression.span(), false);
                break;
            case ExpressionKind::Binary:
            case ExpressionKind::Range:
                left.push_back(expression.right);
                left.push_back(expression.left);
                break;
            case ExpressionKind::Unary:
            case ExpressionKind::Grouping:
                left.push_back(expression.left);
                break;
            case ExpressionKind::Call: {
                const std::string_view name = names_.text(expression.name);
                put(NameKind::Function, name,
                    {expression.file, expression.begin,
                     expression.begin + static_cast<std::uint32_t>(name.size())},
                    false);
                const ListRange arguments = ast_.argument_lists[expression.arguments];
                for (std::uint32_t i = 0; i < arguments.count; ++i) {
                    left.push_back(ast_.expression_lists[arguments.first + i]);
                }
                break;
            }
            case ExpressionKind::Number:
            case ExpressionKind::Error:
                break;
            }
        }
    }

    /// Values of `#set`, `#material` or `#sense`; `keys` are words that are no constants there.
    void add_values(ListRange values, const std::vector<std::string_view>& keys) {
        for (std::uint32_t i = 0; i < values.count; ++i) {
            const SetValue& value = ast_.set_values[values.first + i];
            if (!value.is_word) {
                add_expression(value.value);
                continue;
            }
            const std::string_view word = names_.text(value.word);
            const bool is_key = std::find(keys.begin(), keys.end(), word) != keys.end();
            if (!value.is_file && !is_key && constants_.contains(word)) {
                put(NameKind::Constant, word, value.span, false);
            }
        }
    }

    void add_sense_values(ListRange values) {
        if (values.count == 0) {
            return;
        }
        if (const SetValue& kind = ast_.set_values[values.first]; kind.is_word && !kind.is_file) {
            outline_.environment_kind = names_.text(kind.word);
        }
        std::vector<std::string_view> keys = sense_keys();
        const std::vector<std::string_view> shapes = space_shape_names();
        keys.insert(keys.end(), shapes.begin(), shapes.end());
        add_values({values.first + 1, values.count - 1}, keys);
    }

    void add_heads(ModuleList list) {
        for (ModuleCursor cursor(ast_, names_, parsed_.sources, list); !cursor.done();
             cursor.next()) {
            const ModuleView module = cursor.view();
            ModuleHead head{std::string(names_.text(module.name)), {}};
            for (std::uint32_t i = 0; i < module.arguments.count; ++i) {
                const ExpressionId id = ast_.expression_lists[module.arguments.first + i];
                const SourceSpan span = ast_.expression(id).span();
                head.formals.emplace_back(span.file == kNoFile ? std::string_view()
                                                               : parsed_.sources.text(span));
            }
            outline_.heads.push_back(std::move(head));
        }
    }

    void add_production(const ProductionNode& node) {
        outline_.stage = node.stage;
        put_definition(NameKind::Production, node.name, node.name_span);
        add_modules(node.left, false, Arguments::Formals);
        add_modules(node.predecessor, true, Arguments::Formals);
        add_heads(node.predecessor);
        add_modules(node.right, false, Arguments::Formals);
        add_expression(node.condition.condition);
        add_expression(node.condition.probability);
        for (std::uint32_t i = 0; i < node.locals.count; ++i) {
            const LocalNode& local = ast_.locals[node.locals.first + i];
            add_expression(local.value);
            add_local(local.name, local.name_span);
        }
        add_modules(node.successor, false, Arguments::Values);
    }

    void add(const Statement& statement) {
        const std::uint32_t i = statement.index;
        switch (statement.kind) {
        case StatementKind::Generations:
            add_expression(ast_.generations[i].value);
            break;
        case StatementKind::Define:
            put_definition(NameKind::Constant, ast_.defines[i].name, ast_.defines[i].name_span);
            add_expression(ast_.defines[i].value);
            break;
        case StatementKind::Param:
            put_definition(NameKind::Constant, ast_.params[i].name, ast_.params[i].name_span);
            add_expression(ast_.params[i].value);
            add_expression(ast_.params[i].minimum);
            add_expression(ast_.params[i].maximum);
            break;
        case StatementKind::Function: {
            const FunctionNode& node = ast_.functions[i];
            put_definition(NameKind::Function, node.name, node.name_span);
            for (std::uint32_t k = 0; k < node.formals.count; ++k) {
                add_formal(ast_.expression_lists[node.formals.first + k]);
            }
            add_expression(node.body);
            break;
        }
        case StatementKind::Curve:
            put_definition(NameKind::Function, ast_.curves[i].name, ast_.curves[i].name_span);
            for (std::uint32_t k = 0; k < ast_.curves[i].coordinates.count; ++k) {
                add_expression(ast_.expression_lists[ast_.curves[i].coordinates.first + k]);
            }
            break;
        case StatementKind::Contour:
            outline_.name = names_.text(ast_.contours[i].name);
            outline_.name_place = place(ast_.contours[i].name_span);
            for (std::uint32_t k = 0; k < ast_.contours[i].coordinates.count; ++k) {
                add_expression(ast_.expression_lists[ast_.contours[i].coordinates.first + k]);
            }
            break;
        case StatementKind::Material:
            add_values(ast_.materials[i].values, material_keys());
            break;
        case StatementKind::Sense:
            put_definition(NameKind::Environment, ast_.senses[i].name, ast_.senses[i].name_span);
            add_sense_values(ast_.senses[i].values);
            break;
        case StatementKind::Module:
            name_outline(ast_.module_declarations[i].modules);
            add_modules(ast_.module_declarations[i].modules, true, Arguments::Formals);
            break;
        case StatementKind::Object:
            name_outline(ast_.objects[i].name);
            add_modules(ast_.objects[i].name, true, Arguments::Values);
            break;
        case StatementKind::Include:
            outline_.name = ast_.includes[i].path;
            outline_.name_place = place(ast_.includes[i].path_span);
            break;
        case StatementKind::Set:
            outline_.name = names_.text(ast_.sets[i].key);
            outline_.name_place = place(ast_.sets[i].key_span);
            add_values(ast_.sets[i].values, {});
            break;
        case StatementKind::Ignore:
            add_modules(ast_.ignores[i].modules, false, Arguments::Values);
            break;
        case StatementKind::Axiom:
            outline_.name = "w";
            outline_.name_place = outline_.place;
            if (!parsed_.is_translated) {
                outline_.name_place.begin = outline_.place.begin + 1;
                outline_.name_place.end = outline_.place.begin + 2;
            }
            add_expression(ast_.axioms[i].probability);
            add_modules(ast_.axioms[i].modules, false, Arguments::Values);
            break;
        case StatementKind::Production:
            add_production(ast_.productions[i]);
            break;
        }
    }

    void name_outline(ModuleList list) {
        const ModuleCursor cursor(ast_, names_, parsed_.sources, list);
        if (!cursor.done()) {
            outline_.name = names_.text(cursor.name());
            outline_.name_place = place(cursor.view().name_span);
        }
    }

    const ParsedGrammar& parsed_;
    const Ast& ast_;
    const Names& names_;
    std::vector<std::string> paths_;       // by FileId
    std::set<std::string_view> known_;     // names of modules, see find_known()
    std::set<std::string_view> constants_; // names of constants
    std::set<NameId> locals_;              // formals and local values of the current statement
    TextPlace scope_;                      // place of the current statement
    StatementOutline outline_;
    bool is_part_ = false; // NameUse::is_part of the names that are added
    NameIndex index_;
};

} // namespace

void parse_grammar(const std::string& path,
                   std::string text,
                   Dialect dialect,
                   const FileLoader& load,
                   ParsedGrammar& parsed) {
    const FileId root = parsed.sources.add(path, std::move(text));
    const ParseContext context{parsed.sources, parsed.names, parsed.diagnostics, load,
                               false,          {},           &parsed.statements};
    parsed.is_translated = dialect != Dialect::Lsys;
    parsed.ast = dialect == Dialect::Lsys ? parse_lsys(root, context)
                                          : parse_dialect(root, dialect, context);
}

NameIndex index_names(const ParsedGrammar& parsed) {
    return Indexer(parsed).run();
}

void NameIndex::merge(const NameIndex& other) {
    uses.insert(uses.end(), other.uses.begin(), other.uses.end());
    std::sort(uses.begin(), uses.end());
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    std::set<TextPlace> places;
    for (const StatementOutline& statement : statements) {
        places.insert(statement.place);
    }
    for (const StatementOutline& statement : other.statements) {
        if (places.insert(statement.place).second) {
            statements.push_back(statement);
        }
    }
}

const NameUse* NameIndex::at(const std::string& path, std::size_t offset) const {
    const NameUse* found = nullptr;
    for (const NameUse& use : uses) {
        if (use.place.path == path && use.place.begin <= offset && offset <= use.place.end) {
            found = &use; // the later of two adjacent names
        }
    }
    return found;
}

bool NameIndex::are_same(const NameUse& a, const NameUse& b) {
    return a.kind == b.kind && a.name == b.name && a.scope == b.scope;
}

} // namespace lsys
