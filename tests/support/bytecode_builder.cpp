// SPDX-License-Identifier: MIT
#include "tests/support/bytecode_builder.h"

#include "compiler/bytecode/instructions.h"
#include "compiler/bytecode/verify.h"
#include "tests/support/builder_text.h"

#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace lsys::test {

namespace {

/// Fills the tables of a Bytecode in the order that bytecode.h requires.
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

    /// Symbols have the lowest codes, so all symbols are declared before the first word is read.
    void declare_symbols(const std::string& modules) {
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

    /// Appends the instructions of one value, and the instruction that takes this value.
    void emit(const Instructions& code, Opcode taker) {
        bytecode_.site_ranges.push_back({next(), site()});
        bytecode_.instructions.insert(bytecode_.instructions.end(), code.begin(), code.end());
        bytecode_.instructions.push_back(encode(taker, 0));
    }
    void end() { bytecode_.instructions.push_back(encode(Opcode::End, 0)); }
    [[nodiscard]] std::uint32_t next() const {
        return static_cast<std::uint32_t>(bytecode_.instructions.size());
    }

    WordTemplate word(const std::string& text, const NameTable& formals) {
        WordTemplate result;
        result.codes.first = static_cast<std::uint32_t>(bytecode_.template_codes.size());
        std::vector<Instructions> stored;
        const ExpressionScope scope{formals, globals, result.draw_count, bytecode_.uses_steps};
        for (const ModuleText& module : read_modules(text)) {
            std::vector<Instructions> arguments;
            for (const std::string& argument : module.arguments) {
                arguments.push_back(compile_expression(argument, scope));
            }
            const SymbolId id = symbol(module.name, module.arguments.size());
            if (const std::optional<Code> folded = fold(id, arguments)) {
                bytecode_.template_codes.push_back(*folded);
                continue;
            }
            bytecode_.template_codes.push_back(static_cast<Code>(id));
            for (Instructions& argument : arguments) {
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
        for (const Instructions& argument : stored) {
            emit(argument, Opcode::Emit);
        }
        end();
        return result;
    }

    TableRange pattern(const std::string& text, bool brackets, NameTable& formals) {
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
                    formals.emplace(formal_name(formal),
                                    static_cast<std::uint32_t>(formals.size()));
                }
            }
            bytecode_.patterns.push_back(item);
            ++range.count;
        }
        return range;
    }

    NameTable globals;
    std::set<SymbolId> unfolded; // symbols whose parameters change in place

private:
    std::optional<Code> fold(SymbolId id, const std::vector<Instructions>& arguments) {
        if (!fold_ || arguments.empty() || unfolded.count(id) != 0) {
            return std::nullopt;
        }
        std::vector<float> values;
        for (const Instructions& argument : arguments) {
            const std::optional<float> value = constant_of(argument);
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
    bool fold_; // codes include constant arguments
    std::map<std::pair<std::string, std::size_t>, std::size_t> symbols_;
    std::map<std::vector<std::uint32_t>, Code> folded_;
};

/// The names and parameter counts in a pattern. Productions for whose patterns the result is equal
/// belong to the same rule or group.
std::string shape_of(const std::optional<std::string>& text) {
    std::string shape = text ? "present " : "absent ";
    for (const ModuleText& module : read_modules(text.value_or(""))) {
        shape += module.name + "/" + std::to_string(module.arguments.size()) + " ";
    }
    return shape;
}

std::uint32_t number_of(NameTable& numbers, const std::string& key) {
    return numbers.emplace(key, static_cast<std::uint32_t>(numbers.size())).first->second;
}

} // namespace

BytecodeBuilder& BytecodeBuilder::axiom(std::string text) {
    axiom_ = std::move(text);
    return *this;
}
BytecodeBuilder& BytecodeBuilder::production(std::string text) {
    return production(Stage::Rewrite, std::move(text));
}
BytecodeBuilder& BytecodeBuilder::production(Stage stage, std::string text) {
    productions_.push_back(std::move(text));
    stages_.push_back(stage);
    return *this;
}
BytecodeBuilder& BytecodeBuilder::sense(std::string names) {
    for (const ModuleText& module : read_modules(names)) {
        sensing_.push_back(module.name);
    }
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
BytecodeBuilder& BytecodeBuilder::declare(std::string modules) {
    declared_ = std::move(modules);
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
    assembler.declare_symbols(declared_);
    assembler.declare_symbols(axiom_);
    std::vector<ProductionText> texts;
    for (const std::string& text : productions_) {
        texts.push_back(read_production(text));
        const ProductionText& production = texts.back();
        assembler.declare_symbols(production.left.value_or(""));
        assembler.declare_symbols(production.predecessor);
        assembler.declare_symbols(production.right.value_or(""));
        assembler.declare_symbols(production.successor);
    }
    for (BytecodeSymbol& symbol : bytecode.symbols) {
        for (const std::string& name : ignored_) {
            symbol.ignored = symbol.ignored || symbol.name == name;
        }
        for (const std::string& name : sensing_) {
            symbol.sense = symbol.name == name ? Sense::Position : symbol.sense;
        }
    }
    for (std::size_t i = 0; i < bytecode.symbols.size(); ++i) {
        if (bytecode.symbols[i].senses()) {
            assembler.unfolded.insert(static_cast<SymbolId>(i));
        }
    }
    for (std::size_t i = 0; i < texts.size(); ++i) {
        if (stages_[i] == Stage::Down || stages_[i] == Stage::Up) {
            const ModuleText swept = read_modules(texts[i].predecessor).front();
            assembler.unfolded.insert(assembler.symbol(swept.name, swept.arguments.size()));
        }
    }

    const NameTable no_formals;
    std::uint32_t draw_position = 0;
    for (const GlobalText& text : globals_) {
        BytecodeGlobal global;
        global.name = text.name;
        global.has_bounds = text.has_bounds;
        global.minimum = text.minimum;
        global.maximum = text.maximum;
        global.site = assembler.site();
        global.draw_position = draw_position;
        const Instructions code = compile_expression(
            text.value, {no_formals, assembler.globals, global.draw_count, bytecode.uses_steps});
        global.instruction = assembler.next();
        assembler.emit(code, Opcode::Emit);
        assembler.end();
        draw_position += global.draw_count;
        assembler.globals.emplace(text.name, static_cast<std::uint32_t>(assembler.globals.size()));
        bytecode.globals.push_back(std::move(global));
    }
    BytecodeAxiom axiom;
    axiom.site = assembler.site();
    axiom.draw_position = draw_position;
    axiom.word = assembler.word(axiom_, no_formals);
    bytecode.axioms.push_back(axiom);

    NameTable rules;
    NameTable groups;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const ProductionText& text = texts[i];
        const std::string stage = std::to_string(static_cast<int>(stages_[i])) + " ";
        BytecodeProduction production;
        NameTable formals;
        production.name = text.name;
        production.stage = stages_[i];
        production.name_site = assembler.site();
        production.rule = number_of(rules, stage + shape_of(text.predecessor));
        production.group =
            number_of(groups, stage + shape_of(text.left) + "<" + shape_of(text.predecessor) + ">" +
                                  shape_of(text.right));
        production.has_left = text.left.has_value();
        production.has_right = text.right.has_value();
        production.left = assembler.pattern(text.left.value_or(""), false, formals);
        production.predecessor = assembler.pattern(text.predecessor, false, formals);
        production.right = assembler.pattern(text.right.value_or(""), true, formals);
        production.formal_count = static_cast<std::uint32_t>(formals.size());
        std::uint32_t no_draws = 0;
        if (!text.condition.empty()) {
            const Instructions code = compile_expression(
                text.condition, {formals, assembler.globals, no_draws, bytecode.uses_steps});
            production.condition = assembler.next();
            assembler.emit(code, Opcode::Test);
            assembler.end();
        }
        if (text.weight) {
            production.stochastic = true;
            production.weight = *text.weight;
        }
        production.successor = assembler.word(text.successor, formals);
        bytecode.productions.push_back(std::move(production));
    }
    bytecode.rule_count = static_cast<std::uint32_t>(rules.size());
    bytecode.context_group_count = static_cast<std::uint32_t>(groups.size());
    const CodeNeeds needs = needs_of(bytecode.instructions);
    bytecode.stack_depth = needs.stack_depth;
    bytecode.local_count = needs.local_count;
    if (const std::optional<std::string> problem = verify(bytecode)) {
        mistake("does not verify", *problem);
    }
    return std::move(bytecode);
}

} // namespace lsys::test
