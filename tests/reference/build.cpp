// SPDX-License-Identifier: MIT
#include "tests/reference/build.h"

#include "tests/reference/print.h"

#include <utility>

namespace lsys::reference {

namespace {

void add(Grammar& grammar, Statement statement) {
    if (grammar.files.empty()) {
        grammar.files.push_back({"main.lsys", true, {}});
    }
    grammar.files[0].statements.push_back(std::move(statement));
}

Statement of_kind(StatementKind kind) {
    Statement statement;
    statement.kind = kind;
    return statement;
}

} // namespace

std::vector<ModuleUse> letters(const std::string& text) {
    std::vector<ModuleUse> modules;
    for (const char c : text) {
        if (c != ' ') {
            modules.push_back({std::string(1, c), {}});
        }
    }
    return modules;
}

Pattern letter_pattern(const std::string& text) {
    Pattern pattern;
    for (const ModuleUse& module : letters(text)) {
        pattern.push_back({module.name, {}});
    }
    return pattern;
}

Grammar letter_system(const std::string& axiom, const std::vector<std::string>& productions) {
    Grammar grammar;
    add_axiom(grammar, letters(axiom));
    for (const std::string& text : productions) {
        Production production;
        production.label = "p" + std::to_string(grammar.files[0].statements.size());
        const std::size_t equals = text.find('=');
        std::string head = text.substr(0, equals);
        if (const std::size_t left = head.find('<'); left != std::string::npos) {
            production.left = letter_pattern(head.substr(0, left));
            head = head.substr(left + 1);
        }
        if (const std::size_t right = head.find('>'); right != std::string::npos) {
            production.right = letter_pattern(head.substr(right + 1));
            head.resize(right);
        }
        production.predecessor = letter_pattern(head);
        production.successor = letters(text.substr(equals + 1));
        add_production(grammar, production);
    }
    return grammar;
}

void add_axiom(Grammar& grammar, const std::vector<ModuleUse>& modules) {
    Statement statement = of_kind(StatementKind::Axiom);
    statement.modules = modules;
    add(grammar, statement);
}

void add_setting(Grammar& grammar, const std::string& key, const std::string& value) {
    Statement statement = of_kind(StatementKind::Set);
    statement.name = key;
    statement.text = value;
    add(grammar, statement);
}

void add_ignored(Grammar& grammar, const std::vector<std::string>& names) {
    Statement statement = of_kind(StatementKind::Ignore);
    statement.names = names;
    add(grammar, statement);
}

void add_production(Grammar& grammar, Production production) {
    Statement statement = of_kind(StatementKind::Production);
    statement.production = std::move(production);
    add(grammar, statement);
}

std::string text_after(const Grammar& grammar, std::uint32_t generations) {
    Request request;
    request.generations = generations;
    return print_word(derive(grammar, request).words.back(), true);
}

std::vector<std::size_t> counts(const Grammar& grammar, std::uint32_t generations) {
    Request request;
    request.generations = generations;
    std::vector<std::size_t> counts;
    for (const Word& word : derive(grammar, request).words) {
        counts.push_back(word.size());
    }
    return counts;
}

} // namespace lsys::reference
