// Small Bytecode by hand for the tests of the growth analysis: modules by name, expressions as
// lists of instructions. What finish() returns is verified.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/bytecode/verify.h"

#include <catch2/catch.hpp>

#include <bit>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace lsys::test {

using Code32 = std::vector<std::uint32_t>;

inline Code32 number(float value) {
    return {encode(Opcode::Literal, 0), std::bit_cast<std::uint32_t>(value)};
}
inline Code32 formal(std::uint32_t index) {
    return {encode(Opcode::Formal, index)};
}
inline Code32 leaf(Opcode opcode, std::uint32_t operand = 0) {
    return {encode(opcode, operand)};
}
inline Code32 apply(Opcode opcode, Code32 x, const Code32& y = {}) {
    x.insert(x.end(), y.begin(), y.end());
    x.push_back(encode(opcode, 0));
    return x;
}
/// {min, max}, the first draw of its word.
inline Code32 range(float min, float max) {
    Code32 code = number(min);
    const Code32 high = number(max);
    code.insert(code.end(), high.begin(), high.end());
    code.push_back(encode(Opcode::Range, 0));
    return code;
}

struct TestModule {
    std::string name;
    std::vector<Code32> arguments;
};
using TestWord = std::vector<TestModule>;

/// Modules without parameters, separated by blanks.
inline TestWord word(const std::string& text) {
    TestWord result;
    std::istringstream in(text);
    for (std::string name; in >> name;) {
        result.push_back({name, {}});
    }
    return result;
}
inline TestWord operator+(TestWord a, const TestWord& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

struct TestProduction {
    std::string predecessor;           // names, separated by blanks
    std::uint32_t parameters = 0;      // of the first of them
    std::optional<Code32> condition{}; // none: `*`
    float weight = 0.0F;               // 0: not stochastic
    TestWord successor;
    std::string left{}; // context: names without parameters
    std::string right{};
};

class BytecodeBuilder {
public:
    BytecodeBuilder() { code_.files = {"test.lsys"}; }

    void axiom(const TestWord& modules) { axiom_ = modules; }
    void production(TestProduction p) { productions_.push_back(std::move(p)); }
    void rule(const std::string& predecessor, const TestWord& successor) {
        productions_.push_back({.predecessor = predecessor, .successor = successor});
    }
    Settings& settings() { return code_.settings; }
    void use_steps() { code_.uses_steps = true; }

    Bytecode finish() {
        // Codes, patterns and instructions lie in the order in which the verifier walks.
        code_.axiom = make_word(axiom_);
        for (const TestProduction& p : productions_) {
            add(p);
        }
        const std::optional<std::string> problem = verify(code_);
        INFO(problem.value_or(""));
        REQUIRE(!problem);
        return code_;
    }

private:
    std::uint32_t symbol(const std::string& name, std::size_t parameters) {
        for (std::uint32_t i = 0; i < code_.symbols.size(); ++i) {
            if (code_.symbols[i].name == name && code_.symbols[i].parameter_count == parameters) {
                return i;
            }
        }
        BytecodeSymbol row;
        row.name = name;
        row.parameter_count = static_cast<std::uint32_t>(parameters);
        row.kind = name == "["   ? SymbolKind::BranchOpen
                   : name == "]" ? SymbolKind::BranchClose
                                 : SymbolKind::Plain;
        row.turtle = name == "F" ? TurtleOperation::Forward : TurtleOperation::Nothing;
        code_.symbols.push_back(row);
        return static_cast<std::uint32_t>(code_.symbols.size() - 1);
    }

    WordTemplate make_word(const TestWord& modules) {
        WordTemplate made;
        made.codes.first = static_cast<std::uint32_t>(code_.template_codes.size());
        made.codes.count = static_cast<std::uint32_t>(modules.size());
        Code32 arguments;
        for (const TestModule& module : modules) {
            code_.template_codes.push_back(symbol(module.name, module.arguments.size()));
            for (const Code32& argument : module.arguments) {
                arguments.insert(arguments.end(), argument.begin(), argument.end());
                // An expression here is a range as a whole or has none.
                made.draw_count += argument.back() == encode(Opcode::Range, 0) ? 1U : 0U;
                arguments.push_back(encode(Opcode::Emit, 0));
                ++made.parameter_count;
            }
        }
        if (made.parameter_count != 0) {
            made.arguments = static_cast<std::uint32_t>(code_.instructions.size());
            arguments.push_back(encode(Opcode::End, 0));
            code_.instructions.insert(code_.instructions.end(), arguments.begin(), arguments.end());
        }
        return made;
    }

    TableRange pattern(const std::string& names, std::uint32_t parameters, std::uint32_t& formals) {
        TableRange range{static_cast<std::uint32_t>(code_.patterns.size()), 0};
        for (const TestModule& module : word(names)) {
            const std::uint32_t count = range.count == 0 ? parameters : 0;
            const std::uint32_t id = symbol(module.name, count);
            code_.patterns.push_back({PatternKind::Module, static_cast<SymbolId>(id), formals});
            formals += count;
            ++range.count;
        }
        return range;
    }

    std::uint32_t number_of(std::vector<std::string>& keys, const std::string& key) {
        for (std::uint32_t i = 0; i < keys.size(); ++i) {
            if (keys[i] == key) {
                return i;
            }
        }
        keys.push_back(key);
        return static_cast<std::uint32_t>(keys.size() - 1);
    }

    void add(const TestProduction& p) {
        BytecodeProduction made;
        made.name = "p";
        made.has_left = !p.left.empty();
        made.has_right = !p.right.empty();
        made.left = pattern(p.left, 0, made.formal_count);
        made.predecessor = pattern(p.predecessor, p.parameters, made.formal_count);
        made.right = pattern(p.right, 0, made.formal_count);
        const std::string key = p.predecessor + "/" + std::to_string(p.parameters);
        made.rule = number_of(rules_, key);
        made.group = number_of(groups_, p.left + "<" + key + ">" + p.right);
        code_.rule_count = static_cast<std::uint32_t>(rules_.size());
        code_.group_count = static_cast<std::uint32_t>(groups_.size());
        made.stochastic = p.weight > 0.0F;
        made.weight = p.weight;
        if (p.condition) {
            made.condition = static_cast<std::uint32_t>(code_.instructions.size());
            code_.instructions.insert(code_.instructions.end(), p.condition->begin(),
                                      p.condition->end());
            code_.instructions.push_back(encode(Opcode::Test, 0));
            code_.instructions.push_back(encode(Opcode::End, 0));
        }
        made.successor = make_word(p.successor);
        code_.productions.push_back(made);
    }

    Bytecode code_;
    TestWord axiom_;
    std::vector<TestProduction> productions_;
    std::vector<std::string> rules_;
    std::vector<std::string> groups_;
};

} // namespace lsys::test
