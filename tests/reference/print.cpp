// SPDX-License-Identifier: MIT
#include "tests/reference/print.h"

#include "tests/reference/random.h"
#include "tests/reference/spelling.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace lsys::reference {

namespace {

struct Token {
    std::string text;
    bool touches = false; // a letter in a file with `names letters`: needs no blank before it
    std::vector<std::pair<const ModuleUse*, std::size_t>> modules =
        {}; // modules that begin in the token, with offset
};

bool is_wordy(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.';
}

// Turns statements into tokens, and tokens into text, for one file.
class FilePrinter {
public:
    FilePrinter(const Grammar& grammar, const File& file, const JoinedNames* joined, Random* random)
        : grammar_(grammar), file_(file), joined_(joined), random_(random) {
        density_ = random_ == nullptr ? 0 : random_->pick(std::vector<std::size_t>{0, 3, 12, 40});
        line_end_ = chance(20) ? "\r\n" : "\n";
    }

    std::string print() {
        if (chance(6)) {
            out_ += "\xEF\xBB\xBF";
        }
        for (const Statement& statement : file_.statements) {
            tokens_.clear();
            spell(statement);
            tokens_.push_back({";", false});
            lay_out();
            between_statements();
        }
        if (chance(15)) { // no line end after the last line
            while (!out_.empty() && (out_.back() == '\n' || out_.back() == '\r')) {
                out_.pop_back();
            }
            if (chance(30)) {
                out_ += line_end_ + "// the end";
            }
        }
        return out_;
    }

    // The modules of the text that print() has made.
    [[nodiscard]] const std::vector<WrittenModule>& modules() const { return modules_; }
    // The paths of the included files, by index.
    [[nodiscard]] const std::map<std::size_t, std::string>& included() const { return included_; }

private:
    bool chance(std::size_t percent) { return random_ != nullptr && random_->percent(percent); }

    void add(const std::string& text) { tokens_.push_back({text, false}); }

    void add_expression(const Expr& expr) {
        std::vector<std::string> tokens;
        spell_expression(expr, random_, tokens);
        for (const std::string& token : tokens) {
            add(token);
        }
    }

    // Writes a number without parentheses, also a negative one, and any other expression in
    // parentheses.
    void add_coordinate(const Expr& expr) {
        const bool negative = expr.kind == ExprKind::Unary && expr.text == "-" &&
                              expr.parts[0].kind == ExprKind::Number;
        if (negative || expr.kind == ExprKind::Number) {
            const Expr& number = negative ? expr.parts[0] : expr;
            if (negative) {
                add("-");
            }
            add(number.text.empty() ? spell_number(number.number, random_) : number.text);
            return;
        }
        add("(");
        add_expression(expr);
        add(")");
    }

    // Appends a name; returns its offset in the last token.
    std::size_t add_name(const std::string& name, bool joins_previous) {
        const bool senses = is_sense_name(name) && is_identifier(name.substr(1));
        const bool word = is_identifier(name) || senses;
        const std::size_t length = senses ? name.size() - 1 : name.size();
        const bool plain = (word && (!file_.letters || length == 1)) || is_symbol(name);
        const bool quotable = std::string("[]{}").find(name) == std::string::npos;
        if (!plain || (!joins_previous && !next_joins_ && quotable && chance(4))) {
            add("`" + name + "`");
        } else if (joins_previous) {
            tokens_.back().text += name;
            return tokens_.back().text.size() - name.size();
        } else {
            tokens_.push_back({name, file_.letters});
        }
        return 0;
    }

    void add_modules(const std::vector<ModuleUse>& modules) {
        for (std::size_t i = 0; i < modules.size(); ++i) {
            const std::size_t begin = start_module(&modules, modules[i].name, i);
            tokens_.back().modules.emplace_back(&modules[i], begin);
            const std::vector<Expr>& arguments = modules[i].arguments;
            for (std::size_t k = 0; k < arguments.size(); ++k) {
                add(k == 0 ? "(" : ",");
                add_expression(arguments[k]);
            }
            end_module(modules[i].name, arguments.empty());
        }
    }

    void add_pattern(const Pattern& pattern) {
        for (std::size_t i = 0; i < pattern.size(); ++i) {
            start_module(&pattern, pattern[i].name, i);
            const std::vector<std::string>& formals = pattern[i].formals;
            for (std::size_t k = 0; k < formals.size(); ++k) {
                add(k == 0 ? "(" : ",");
                add(formals[k]);
            }
            end_module(pattern[i].name, formals.empty());
        }
    }

    std::size_t start_module(const void* list, const std::string& name, std::size_t i) {
        const bool joins_previous = next_joins_;
        next_joins_ = joined_ != nullptr && joined_->joined(list, i);
        return add_name(name, joins_previous);
    }

    void end_module(const std::string& name, bool is_bare) {
        if (!is_bare) {
            add(")");
        } else if (!next_joins_ && std::string("[]{}.|$").find(name) == std::string::npos &&
                   chance(3)) {
            add("(");
            add(")");
        }
    }

    void spell(const Statement& statement) {
        switch (statement.kind) {
        case StatementKind::Generations:
            add("#n");
            add("=");
            add_expression(statement.expr);
            return;
        case StatementKind::Define:
            add("#define");
            add(statement.name);
            add_expression(statement.expr);
            return;
        case StatementKind::Param:
            add("#param");
            add(statement.name);
            add_expression(statement.expr);
            add("{");
            add_expression(statement.low);
            add(",");
            add_expression(statement.high);
            add("}");
            return;
        case StatementKind::Function:
            add("#function");
            add(statement.name);
            for (std::size_t i = 0; i < statement.names.size(); ++i) {
                add(i == 0 ? "(" : ",");
                add(statement.names[i]);
            }
            add(")");
            add_expression(statement.expr);
            return;
        case StatementKind::Curve:
            add("#curve");
            add(statement.name);
            for (std::size_t i = 0; i < statement.points.size(); ++i) {
                if (i > 0) {
                    add(",");
                }
                add_coordinate(statement.points[i].first);
                add_coordinate(statement.points[i].second);
            }
            return;
        case StatementKind::Module:
            add("#module");
            add_pattern(statement.patterns);
            return;
        case StatementKind::Object:
            add(chance(30) ? "#include" : "#object");
            add_name(statement.name, false);
            add(statement.mesh.empty() ? statement.text
                                       : "\"" + path_from_root(statement.mesh) + "\"");
            return;
        case StatementKind::IncludeFile:
            add("#include");
            included_[statement.file] = relative_path(grammar_.files[statement.file].path);
            add("\"" + included_[statement.file] + "\"");
            return;
        case StatementKind::Sense:
            add("#sense");
            add(statement.name);
            add(statement.sense.kind);
            for (const SenseKey& key : statement.sense.keys) {
                spell(key);
            }
            return;
        case StatementKind::Set:
            add("#set");
            add(statement.name);
            add(statement.text);
            return;
        case StatementKind::Material:
            add("#material");
            add(statement.text);
            return;
        case StatementKind::Ignore:
        case StatementKind::Consider:
            add(statement.kind == StatementKind::Ignore ? "#ignore" : "#consider");
            add(":");
            for (std::size_t i = 0; i < statement.names.size(); ++i) {
                start_module(&statement.names, statement.names[i], i);
            }
            return;
        case StatementKind::Axiom:
            add("#w");
            if (statement.has_probability) {
                add("~");
                add_expression(statement.expr);
            }
            add(":");
            add_modules(statement.modules);
            return;
        case StatementKind::Production:
            spell(statement.production);
            return;
        }
    }

    void spell(const Production& production) {
        static const std::map<Stage, std::string> kKeywords = {{Stage::Decompose, "#decompose"},
                                                               {Stage::Interpret, "#interpret"},
                                                               {Stage::Down, "#down"},
                                                               {Stage::Up, "#up"}};
        if (production.stage == Stage::Rewrite) {
            add("#" + production.label);
        } else {
            add(kKeywords.at(production.stage));
            add(production.label);
        }
        add(":");
        if (production.left) {
            add_pattern(*production.left);
            add("<");
        }
        add_pattern(production.predecessor);
        if (production.right) {
            add(">");
            add_pattern(*production.right);
        }
        add(":");
        if (production.condition) {
            add_expression(*production.condition);
        } else if (!production.probability || chance(30)) {
            add("*");
        }
        if (production.probability) {
            add("~");
            add_expression(*production.probability);
        }
        for (std::size_t i = 0; i < production.locals.size(); ++i) {
            if (i == 0) {
                add(":");
                add("let");
            } else {
                add(",");
            }
            add(production.locals[i].first);
            add("=");
            add_expression(production.locals[i].second);
        }
        add(":");
        add_modules(production.successor);
    }

    void spell(const SenseKey& key) {
        add(key.key);
        for (const Expr& expr : key.numbers) {
            add_coordinate(expr);
        }
        if (!key.word.empty()) {
            add(key.word);
        }
        if (!key.file.empty()) {
            add(in_quotes(key.file));
        }
    }

    // The name of a file beside the grammar, in quotes.
    [[nodiscard]] std::string in_quotes(const std::string& path) const {
        return "\"" + relative_path(path) + "\"";
    }

    // `path` relative to the folder of this file.
    [[nodiscard]] std::string relative_path(std::string path) const {
        return relative_path(std::move(path), file_.path);
    }

    // The path of a mesh of an object is relative to the first file, also in an included one.
    [[nodiscard]] std::string path_from_root(std::string path) const {
        return relative_path(std::move(path), grammar_.files[0].path);
    }

    static std::string relative_path(std::string path, const std::string& file) {
        std::string folder = file.substr(0, file.rfind('/') + 1);
        std::string up;
        while (path.compare(0, folder.size(), folder) != 0) {
            folder = folder.substr(0, folder.rfind('/', folder.size() - 2) + 1);
            up += "../";
        }
        return up + path.substr(folder.size());
    }

    std::string comment() {
        static const std::vector<std::string> kComments = {
            "/**/",
            "/***/",
            "/* note */",
            "/* #w : X; */",
            "/* A -> B; \xE2\x80\x9Cquoted\xE2\x80\x9D \xE2\x88\xBC \xE2\x88\x92 */",
            "/* /* */",
            "/* // */",
            "/* ` \" { ( [ */",
        };
        std::string text = random_->pick(kComments);
        if (chance(20)) {
            text.insert(2, line_end_);
        }
        return text;
    }

    std::string blank() {
        switch (random_->below(10)) {
        case 0:
            return line_end_ + "    ";
        case 1:
            return "\t";
        case 2:
            return "  ";
        case 3:
            return " " + comment() + " ";
        case 4:
            return comment();
        default:
            return " ";
        }
    }

    // Whether the scanner would read both tokens as one if no blank were between them.
    [[nodiscard]] bool merge(const Token& previous, const Token& token) const {
        // A single `.` is always the module, never part of a number, so it never merges with
        // another token.
        if (previous.text == "." || token.text == ".") {
            return false;
        }
        if (token.touches && previous.text.front() != '#') {
            return false;
        }
        return is_wordy(previous.text.back()) && is_wordy(token.text.front());
    }

    void lay_out() {
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            const bool must = i > 0 && merge(tokens_[i - 1], tokens_[i]);
            if (must || (i > 0 && chance(density_))) {
                out_ += out_.back() == '/' ? " " : ""; // else the `/` would begin a comment
                out_ += random_ == nullptr ? " " : blank();
            }
            for (const auto& [module, begin] : tokens_[i].modules) {
                add_place(module, out_ + tokens_[i].text.substr(0, begin));
            }
            out_ += tokens_[i].text;
        }
    }

    // Adds the place of a module. `before`: the text before the module. A byte order mark does not
    // count as part of the first line.
    void add_place(const ModuleUse* module, const std::string& before) {
        const std::size_t line_end = before.rfind('\n');
        const std::size_t first = line_end == std::string::npos ? 0 : line_end + 1;
        const bool marked = first == 0 && before.compare(0, 3, "\xEF\xBB\xBF") == 0;
        WrittenModule written{module, 1, marked ? 0U : 1U};
        for (const char c : before) {
            written.line += c == '\n' ? 1 : 0;
        }
        for (std::size_t i = first; i < before.size(); ++i) {
            const bool continues = (static_cast<unsigned char>(before[i]) & 0xC0) == 0x80;
            written.column += continues ? 0 : 1;
        }
        modules_.push_back(written);
    }

    void between_statements() {
        if (random_ == nullptr) {
            out_ += "\n";
            return;
        }
        switch (random_->below(12)) {
        case 0:
            return;
        case 1:
            out_ += " ";
            return;
        case 2:
            out_ += " // a remark; #x : A : * : B;" + line_end_;
            return;
        case 3:
            out_ += "//* \xE2\x80\x94 not /* a block" + line_end_;
            return;
        case 4:
            out_ += comment() + line_end_;
            return;
        case 5:
            out_ += line_end_ + line_end_;
            return;
        default:
            out_ += line_end_;
            return;
        }
    }

    const Grammar& grammar_;
    const File& file_;
    const JoinedNames* joined_;
    Random* random_;
    std::size_t density_ = 0; // percentage of gaps between tokens that get blanks or comments
    std::string line_end_;
    bool next_joins_ = false; // the next name is written without a blank before it
    std::vector<Token> tokens_;
    std::string out_;
    std::vector<WrittenModule> modules_;
    std::map<std::size_t, std::string> included_;
};

} // namespace

std::vector<TextFile> print_grammar(const Grammar& grammar, std::uint64_t layout_seed) {
    std::vector<TextFile> files;
    Random random(layout_seed, 2);
    const JoinedNames joined(grammar, random);
    for (const File& file : grammar.files) {
        files.push_back({file.path, file.path, "", {}});
    }
    // A file comes before the files that it includes.
    for (std::size_t i = 0; i < files.size(); ++i) {
        const bool plain = layout_seed == 0;
        FilePrinter printer(grammar, grammar.files[i], plain ? nullptr : &joined,
                            plain ? nullptr : &random);
        files[i].text = printer.print();
        files[i].modules = printer.modules();
        const std::string folder = files[i].shown.substr(0, files[i].shown.rfind('/') + 1);
        for (const auto& [index, way] : printer.included()) {
            files[index].shown = folder + way;
        }
    }
    return files;
}

std::string print_word(const Word& word, bool letters) {
    std::string text;
    bool after_bare_identifier = false;
    for (const Module& module : word) {
        const std::string bare = is_sense_name(module.name) ? module.name.substr(1) : module.name;
        const bool letter = bare.size() == 1 && bare != "_";
        const bool identifier = is_identifier(bare) && (!letters || letter);
        if (identifier && after_bare_identifier && !letters) {
            text += " ";
        }
        const bool plain = identifier || is_symbol(module.name);
        text += plain ? module.name : "`" + module.name + "`";
        for (std::size_t i = 0; i < module.values.size(); ++i) {
            const bool negative = std::signbit(module.values[i]);
            text += i == 0 ? "(" : ",";
            text += negative ? "-" : "";
            text += spell_number(negative ? -module.values[i] : module.values[i], nullptr);
        }
        text += module.values.empty() ? "" : ")";
        after_bare_identifier = identifier && module.values.empty();
    }
    return text;
}

} // namespace lsys::reference
