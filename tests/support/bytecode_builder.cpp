#include "tests/support/bytecode_builder.h"

#include "compiler/arithmetic.h"
#include "compiler/verify.h"

#include <bit>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>

namespace lsys::test {

namespace {

[[noreturn]] void mistake(std::string_view what, std::string_view text) {
    std::fprintf(stderr, "bytecode_builder: %s: %s\n", std::string(what).c_str(),
                 std::string(text).c_str());
    std::abort();
}

bool starts_name(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool in_name(char c) {
    return starts_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
}

class Reader {
public:
    explicit Reader(std::string_view text) : text_(text) {}

    [[nodiscard]] bool done() {
        skip_blanks();
        return at_ == text_.size();
    }
    [[nodiscard]] char peek() { return done() ? '\0' : text_[at_]; }
    [[nodiscard]] bool take(std::string_view token) {
        skip_blanks();
        if (text_.substr(at_, token.size()) != token) {
            return false;
        }
        at_ += token.size();
        return true;
    }
    [[nodiscard]] std::string name() {
        skip_blanks();
        const std::size_t begin = at_;
        while (at_ < text_.size() && in_name(text_[at_])) {
            ++at_;
        }
        return std::string(text_.substr(begin, at_ - begin));
    }
    [[nodiscard]] char symbol() { return text_[at_++]; }
    [[nodiscard]] float number() {
        const std::string rest(text_.substr(at_));
        char* end = nullptr;
        const float value = std::strtof(rest.c_str(), &end);
        at_ += static_cast<std::size_t>(end - rest.c_str());
        return value;
    }
    [[nodiscard]] std::string_view text() const { return text_; }

private:
    void skip_blanks() {
        while (at_ < text_.size() && text_[at_] == ' ') {
            ++at_;
        }
    }
    std::string_view text_;
    std::size_t at_ = 0;
};

struct ModuleText {
    std::string name;
    std::vector<std::string> arguments;
};

std::vector<ModuleText> read_modules(std::string_view text) {
    std::vector<ModuleText> modules;
    Reader reader(text);
    while (!reader.done()) {
        ModuleText module;
        module.name = starts_name(reader.peek()) ? reader.name() : std::string(1, reader.symbol());
        if (reader.take("(")) {
            std::string argument;
            for (int depth = 0;;) {
                const char c = reader.peek();
                if (c == '\0') {
                    mistake("no end of arguments", text);
                }
                static_cast<void>(reader.symbol());
                if (depth == 0 && (c == ',' || c == ')')) {
                    module.arguments.push_back(std::exchange(argument, {}));
                    if (c == ')') {
                        break;
                    }
                    continue;
                }
                depth += c == '(' || c == '{' ? 1 : c == ')' || c == '}' ? -1 : 0;
                argument += c;
            }
        }
        modules.push_back(std::move(module));
    }
    return modules;
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts{""};
    for (const char c : text) {
        if (c == separator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

const std::map<std::string, Opcode>& functions() {
    static const std::map<std::string, Opcode> table = [] {
        std::map<std::string, Opcode> all;
        for (std::uint32_t i = 0; i < kOpcodeCount; ++i) {
            const auto opcode = static_cast<Opcode>(i);
            if (opcode >= Opcode::Sin && opcode <= Opcode::Mod) {
                all.emplace(std::string(info(opcode).mnemonic), opcode);
            }
        }
        return all;
    }();
    return table;
}

/// Compiles one expression by precedence climbing; all-constant parts are computed at once.
class ExpressionCompiler {
public:
    ExpressionCompiler(const std::map<std::string, std::uint32_t>& formals,
                       const std::map<std::string, std::uint32_t>& globals,
                       std::uint32_t& draws,
                       bool& uses_steps)
        : formals_(formals), globals_(globals), draws_(draws), uses_steps_(uses_steps) {}

    /// Its instructions; a constant one is a single Literal.
    std::vector<std::uint32_t> run(const std::string& text) {
        Reader reader(text);
        std::vector<std::uint32_t> code = binary(reader, 0);
        if (!reader.done()) {
            mistake("not an expression", text);
        }
        return code;
    }

    static std::optional<float> constant(const std::vector<std::uint32_t>& code) {
        if (code.size() == 2 && code[0] == encode(Opcode::Literal, 0)) {
            return std::bit_cast<float>(code[1]);
        }
        return std::nullopt;
    }

private:
    using Instructions = std::vector<std::uint32_t>;

    static Instructions literal(float value) {
        return {encode(Opcode::Literal, 0), std::bit_cast<std::uint32_t>(value)};
    }
    static Instructions apply(Opcode opcode, Instructions x, const Instructions& y) {
        const std::optional<float> a = constant(x);
        const std::optional<float> b = constant(y);
        if (a && (b || y.empty())) {
            return literal(arithmetic::apply(opcode, *a, b.value_or(0.0F)));
        }
        x.insert(x.end(), y.begin(), y.end());
        x.push_back(encode(opcode, 0));
        return x;
    }

    Instructions binary(Reader& reader, std::size_t level) {
        static const std::vector<std::vector<std::pair<std::string, Opcode>>> kLevels{
            {{"||", Opcode::Or}},
            {{"&&", Opcode::And}},
            {{"==", Opcode::Equal}, {"!=", Opcode::NotEqual}},
            {{"<=", Opcode::LessEqual},
             {">=", Opcode::GreaterEqual},
             {"<", Opcode::Less},
             {">", Opcode::Greater}},
            {{"+", Opcode::Add}, {"-", Opcode::Subtract}},
            {{"*", Opcode::Multiply}, {"/", Opcode::Divide}}};
        if (level == kLevels.size()) {
            return unary(reader);
        }
        Instructions left = binary(reader, level + 1);
        for (bool more = true; more;) {
            more = false;
            for (const auto& [token, opcode] : kLevels[level]) {
                if (reader.take(token)) {
                    left = apply(opcode, std::move(left), binary(reader, level + 1));
                    more = true;
                    break;
                }
            }
        }
        return left;
    }

    Instructions unary(Reader& reader) {
        if (reader.take("-")) {
            return apply(Opcode::Negate, unary(reader), {});
        }
        if (reader.take("!")) {
            return apply(Opcode::Not, unary(reader), {});
        }
        Instructions base = primary(reader);
        if (reader.take("^")) {
            return apply(Opcode::Power, std::move(base), unary(reader));
        }
        return base;
    }

    Instructions primary(Reader& reader) {
        if (reader.take("(")) {
            Instructions inner = binary(reader, 0);
            if (!reader.take(")")) {
                mistake("missing )", reader.text());
            }
            return inner;
        }
        if (reader.take("{")) {
            Instructions code = binary(reader, 0);
            if (!reader.take(",")) {
                mistake("missing ,", reader.text());
            }
            const Instructions maximum = binary(reader, 0);
            code.insert(code.end(), maximum.begin(), maximum.end());
            if (!reader.take("}")) {
                mistake("missing }", reader.text());
            }
            code.push_back(encode(Opcode::Range, draws_++));
            return code;
        }
        if (!starts_name(reader.peek())) {
            return literal(reader.number());
        }
        const std::string name = reader.name();
        if (reader.take("(")) {
            Instructions code;
            if (name == "step" || name == "steps") {
                uses_steps_ = uses_steps_ || name == "steps";
                code = {encode(name == "step" ? Opcode::Step : Opcode::Steps, 0)};
            } else {
                const Opcode opcode = functions().at(name);
                code = binary(reader, 0);
                code = reader.take(",") ? apply(opcode, std::move(code), binary(reader, 0))
                                        : apply(opcode, std::move(code), {});
            }
            if (!reader.take(")")) {
                mistake("missing )", reader.text());
            }
            return code;
        }
        if (const auto formal = formals_.find(name); formal != formals_.end()) {
            return {encode(Opcode::Formal, formal->second)};
        }
        if (const auto global = globals_.find(name); global != globals_.end()) {
            return {encode(Opcode::Global, global->second)};
        }
        mistake("unknown name", name);
    }

    const std::map<std::string, std::uint32_t>& formals_;
    const std::map<std::string, std::uint32_t>& globals_;
    std::uint32_t& draws_;
    bool& uses_steps_;
};

struct ProductionText {
    std::string name;
    std::optional<std::string> left;
    std::string predecessor;
    std::optional<std::string> right;
    std::string condition;
    std::optional<std::string> weight;
    std::string successor;
};

ProductionText read_production(const std::string& text) {
    const std::vector<std::string> parts = split(text, ':');
    if (parts.size() != 4) {
        mistake("a production has four parts", text);
    }
    ProductionText production;
    production.name = Reader(parts[0]).name();
    std::string head = parts[1];
    if (const std::size_t at = head.find('<'); at != std::string::npos) {
        production.left = head.substr(0, at);
        head = head.substr(at + 1);
    }
    if (const std::size_t at = head.find('>'); at != std::string::npos) {
        production.right = head.substr(at + 1);
        head = head.substr(0, at);
    }
    production.predecessor = head;
    const std::vector<std::string> condition = split(parts[2], '~');
    if (condition.size() == 2) {
        production.weight = condition[1];
    }
    for (const char c : condition[0]) {
        production.condition += c;
    }
    if (Reader(production.condition).done() || production.condition == " * " ||
        production.condition == "*") {
        production.condition.clear();
    }
    production.successor = parts[3];
    return production;
}

/// Fills the tables in the order that bytecode.h promises.
class Assembler {
public:
    Assembler(bool fold, std::uint32_t unused) : fold_(fold) {
        for (std::uint32_t i = 0; i < unused; ++i) {
            symbol("unused" + std::to_string(i), 0);
        }
        bytecode_.files.emplace_back("test.lsys");
    }

    Bytecode& bytecode() { return bytecode_; }

    SymbolId symbol(const std::string& name, std::size_t count) {
        const auto [at, added] = symbols_.emplace(std::pair(name, count), bytecode_.symbols.size());
        if (added) {
            BytecodeSymbol symbol;
            symbol.name = name;
            symbol.parameter_count = static_cast<std::uint32_t>(count);
            symbol.kind = name == "["   ? SymbolKind::BranchOpen
                          : name == "]" ? SymbolKind::BranchClose
                          : name == "{" ? SymbolKind::PolygonOpen
                          : name == "}" ? SymbolKind::PolygonClose
                                        : SymbolKind::Plain;
            bytecode_.symbols.push_back(std::move(symbol));
        }
        return static_cast<SymbolId>(at->second);
    }

    /// Symbols get the low codes, so all must be known before any word is.
    void see_symbols(const std::string& modules) {
        for (const ModuleText& module : read_modules(modules)) {
            symbol(module.name, module.arguments.size());
        }
    }

    std::uint32_t site() {
        Site at;
        at.span = {FileId{0}, static_cast<std::uint32_t>(bytecode_.sites.size()),
                   static_cast<std::uint32_t>(bytecode_.sites.size() + 1)};
        at.line = static_cast<std::uint32_t>(bytecode_.sites.size() + 1);
        at.column = 1;
        bytecode_.sites.push_back(at);
        return static_cast<std::uint32_t>(bytecode_.sites.size() - 1);
    }

    /// Appends the instructions of one value and what takes it.
    void emit(const std::vector<std::uint32_t>& code, Opcode taker) {
        bytecode_.site_marks.push_back({next(), site()});
        bytecode_.instructions.insert(bytecode_.instructions.end(), code.begin(), code.end());
        bytecode_.instructions.push_back(encode(taker, 0));
    }
    void end() { bytecode_.instructions.push_back(encode(Opcode::End, 0)); }
    [[nodiscard]] std::uint32_t next() const {
        return static_cast<std::uint32_t>(bytecode_.instructions.size());
    }

    WordTemplate word(const std::string& text,
                      const std::map<std::string, std::uint32_t>& formals) {
        WordTemplate result;
        result.codes.first = static_cast<std::uint32_t>(bytecode_.template_codes.size());
        std::vector<std::vector<std::uint32_t>> stored;
        ExpressionCompiler compiler(formals, globals, result.draw_count, bytecode_.uses_steps);
        for (const ModuleText& module : read_modules(text)) {
            std::vector<std::vector<std::uint32_t>> arguments;
            for (const std::string& argument : module.arguments) {
                arguments.push_back(compiler.run(argument));
            }
            const SymbolId id = symbol(module.name, module.arguments.size());
            if (const std::optional<Code> folded = fold(id, arguments)) {
                bytecode_.template_codes.push_back(*folded);
                continue;
            }
            bytecode_.template_codes.push_back(static_cast<Code>(id));
            for (std::vector<std::uint32_t>& argument : arguments) {
                stored.push_back(std::move(argument));
            }
        }
        result.codes.count =
            static_cast<std::uint32_t>(bytecode_.template_codes.size()) - result.codes.first;
        result.parameter_count = static_cast<std::uint32_t>(stored.size());
        if (stored.empty()) {
            return result;
        }
        result.arguments = next();
        for (const std::vector<std::uint32_t>& argument : stored) {
            emit(argument, Opcode::Emit);
        }
        end();
        return result;
    }

    TableRange
    pattern(const std::string& text, bool brackets, std::map<std::string, std::uint32_t>& formals) {
        TableRange range{static_cast<std::uint32_t>(bytecode_.patterns.size()), 0};
        for (const ModuleText& module : read_modules(text)) {
            PatternItem item;
            item.first_formal = 0;
            if (brackets && (module.name == "[" || module.name == "]")) {
                item.kind = module.name == "[" ? PatternKind::Open : PatternKind::Close;
            } else {
                item.symbol = symbol(module.name, module.arguments.size());
                item.first_formal = static_cast<std::uint32_t>(formals.size());
                for (const std::string& formal : module.arguments) {
                    formals.emplace(Reader(formal).name(),
                                    static_cast<std::uint32_t>(formals.size()));
                }
            }
            bytecode_.patterns.push_back(item);
            ++range.count;
        }
        return range;
    }

    std::map<std::string, std::uint32_t> globals;

private:
    std::optional<Code> fold(SymbolId id,
                             const std::vector<std::vector<std::uint32_t>>& arguments) {
        if (!fold_ || arguments.empty()) {
            return std::nullopt;
        }
        std::vector<float> values;
        for (const std::vector<std::uint32_t>& argument : arguments) {
            const std::optional<float> value = ExpressionCompiler::constant(argument);
            if (!value || !std::isfinite(*value)) {
                return std::nullopt;
            }
            values.push_back(*value);
        }
        std::vector<std::uint32_t> key{static_cast<std::uint32_t>(id)};
        for (const float value : values) {
            key.push_back(std::bit_cast<std::uint32_t>(value));
        }
        const auto known = folded_.find(key);
        if (known != folded_.end()) {
            return known->second;
        }
        const Code code = bytecode_.code_count();
        if (code_width(std::uint64_t{code} + 1) != code_width(code)) {
            return std::nullopt;
        }
        bytecode_.folded.push_back({id, static_cast<std::uint32_t>(bytecode_.constants.size())});
        bytecode_.constants.insert(bytecode_.constants.end(), values.begin(), values.end());
        folded_.emplace(std::move(key), code);
        return code;
    }

    Bytecode bytecode_;
    bool fold_;
    std::map<std::pair<std::string, std::size_t>, std::size_t> symbols_;
    std::map<std::vector<std::uint32_t>, Code> folded_;
};

/// The names and counts of a pattern: what rules and groups compare.
std::string shape_of(const std::optional<std::string>& text) {
    std::string shape = text ? "present " : "absent ";
    for (const ModuleText& module : read_modules(text.value_or(""))) {
        shape += module.name + "/" + std::to_string(module.arguments.size()) + " ";
    }
    return shape;
}

std::uint32_t number_of(std::map<std::string, std::uint32_t>& numbers, const std::string& key) {
    return numbers.emplace(key, static_cast<std::uint32_t>(numbers.size())).first->second;
}

} // namespace

BytecodeBuilder& BytecodeBuilder::axiom(std::string text) {
    axiom_ = std::move(text);
    return *this;
}
BytecodeBuilder& BytecodeBuilder::production(std::string text) {
    productions_.push_back(std::move(text));
    return *this;
}
BytecodeBuilder& BytecodeBuilder::ignore(std::string names) {
    for (const ModuleText& module : read_modules(names)) {
        ignored_.push_back(module.name);
    }
    return *this;
}
BytecodeBuilder& BytecodeBuilder::global(std::string name, std::string value) {
    globals_.push_back({std::move(name), std::move(value), false, 0.0F, 0.0F});
    return *this;
}
BytecodeBuilder&
BytecodeBuilder::parameter(std::string name, std::string value, float minimum, float maximum) {
    globals_.push_back({std::move(name), std::move(value), true, minimum, maximum});
    return *this;
}
BytecodeBuilder& BytecodeBuilder::unused_symbols(std::uint32_t count) {
    unused_ = count;
    return *this;
}

Bytecode BytecodeBuilder::build() const {
    Assembler assembler(fold, unused_);
    Bytecode& bytecode = assembler.bytecode();
    bytecode.settings = settings;
    assembler.see_symbols(axiom_);
    std::vector<ProductionText> texts;
    for (const std::string& text : productions_) {
        texts.push_back(read_production(text));
        const ProductionText& production = texts.back();
        assembler.see_symbols(production.left.value_or(""));
        assembler.see_symbols(production.predecessor);
        assembler.see_symbols(production.right.value_or(""));
        assembler.see_symbols(production.successor);
    }
    for (BytecodeSymbol& symbol : bytecode.symbols) {
        for (const std::string& name : ignored_) {
            symbol.ignored = symbol.ignored || symbol.name == name;
        }
    }

    const std::map<std::string, std::uint32_t> no_formals;
    std::uint32_t draw_position = 0;
    for (const GlobalText& text : globals_) {
        BytecodeGlobal global;
        global.name = text.name;
        global.has_bounds = text.has_bounds;
        global.minimum = text.minimum;
        global.maximum = text.maximum;
        global.site = assembler.site();
        global.draw_position = draw_position;
        ExpressionCompiler compiler(no_formals, assembler.globals, global.draw_count,
                                    bytecode.uses_steps);
        const std::vector<std::uint32_t> code = compiler.run(text.value);
        global.instruction = assembler.next();
        assembler.emit(code, Opcode::Emit);
        assembler.end();
        draw_position += global.draw_count;
        assembler.globals.emplace(text.name, static_cast<std::uint32_t>(assembler.globals.size()));
        bytecode.globals.push_back(std::move(global));
    }
    bytecode.axiom_site = assembler.site();
    bytecode.axiom_draw_position = draw_position;
    bytecode.axiom = assembler.word(axiom_, no_formals);

    std::map<std::string, std::uint32_t> rules;
    std::map<std::string, std::uint32_t> groups;
    for (const ProductionText& text : texts) {
        BytecodeProduction production;
        std::map<std::string, std::uint32_t> formals;
        production.name = text.name;
        production.name_site = assembler.site();
        production.rule = number_of(rules, shape_of(text.predecessor));
        production.group =
            number_of(groups, shape_of(text.left) + "<" + shape_of(text.predecessor) + ">" +
                                  shape_of(text.right));
        production.has_left = text.left.has_value();
        production.has_right = text.right.has_value();
        production.left = assembler.pattern(text.left.value_or(""), false, formals);
        production.predecessor = assembler.pattern(text.predecessor, false, formals);
        production.right = assembler.pattern(text.right.value_or(""), true, formals);
        production.formal_count = static_cast<std::uint32_t>(formals.size());
        std::uint32_t no_draws = 0;
        if (!text.condition.empty()) {
            ExpressionCompiler compiler(formals, assembler.globals, no_draws, bytecode.uses_steps);
            const std::vector<std::uint32_t> code = compiler.run(text.condition);
            production.condition = assembler.next();
            assembler.emit(code, Opcode::Test);
            assembler.end();
        }
        if (text.weight) {
            production.stochastic = true;
            production.weight = Reader(*text.weight).done() ? 0.0F : std::stof(*text.weight);
        }
        production.successor = assembler.word(text.successor, formals);
        bytecode.productions.push_back(std::move(production));
    }
    bytecode.rule_count = static_cast<std::uint32_t>(rules.size());
    bytecode.group_count = static_cast<std::uint32_t>(groups.size());
    if (const std::optional<std::string> problem = verify(bytecode)) {
        mistake("does not verify", *problem);
    }
    return std::move(bytecode);
}

} // namespace lsys::test
