// SPDX-License-Identifier: MIT
#include "tests/support/builder_text.h"

#include "compiler/bytecode/arithmetic.h"

#include <bit>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace lsys::test {

[[noreturn]] void mistake(std::string_view what, std::string_view text) {
    std::fprintf(stderr, "bytecode_builder: %s: %s\n", std::string(what).c_str(),
                 std::string(text).c_str());
    std::abort();
}

namespace {

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

Opcode function_named(const std::string& name) {
    for (auto opcode = Opcode::Sin; opcode <= Opcode::Mod;
         opcode = static_cast<Opcode>(static_cast<std::uint8_t>(opcode) + 1)) {
        if (info(opcode).mnemonic == name) {
            return opcode;
        }
    }
    mistake("unknown function", name);
}

/// Compiles one expression by precedence climbing and folds constant parts.
class ExpressionCompiler {
public:
    explicit ExpressionCompiler(const ExpressionScope& scope)
        : formals_(scope.formals), globals_(scope.globals), draws_(scope.draws),
          uses_steps_(scope.uses_steps) {}

    /// The instructions of an expression; a constant is a single Literal.
    Instructions run(const std::string& text) {
        Reader reader(text);
        Instructions code = binary(reader, 0);
        if (!reader.done()) {
            mistake("not an expression", text);
        }
        return code;
    }

private:
    static Instructions literal(float value) {
        return {encode(Opcode::Literal, 0), std::bit_cast<std::uint32_t>(value)};
    }
    static Instructions apply(Opcode opcode, Instructions x, const Instructions& y) {
        const std::optional<float> a = constant_of(x);
        const std::optional<float> b = constant_of(y);
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
                const Opcode opcode = function_named(name);
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

    const NameTable& formals_;
    const NameTable& globals_;
    std::uint32_t& draws_;
    bool& uses_steps_;
};

} // namespace

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
        production.weight = std::stof(condition[1]);
    }
    if (condition[0].find_first_not_of(" *") != std::string::npos) {
        production.condition = condition[0];
    }
    production.successor = parts[3];
    return production;
}

std::string formal_name(std::string_view text) {
    return Reader(text).name();
}

std::optional<float> constant_of(const Instructions& code) {
    if (code.size() == 2 && code[0] == encode(Opcode::Literal, 0)) {
        return std::bit_cast<float>(code[1]);
    }
    return std::nullopt;
}

Instructions compile_expression(const std::string& text, const ExpressionScope& scope) {
    return ExpressionCompiler(scope).run(text);
}

} // namespace lsys::test
