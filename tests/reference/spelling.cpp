// SPDX-License-Identifier: MIT
#include "tests/reference/spelling.h"

#include <array>
#include <charconv>
#include <cstdio>

namespace lsys::reference {

namespace {

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

std::string with_format(float value, std::chars_format format) {
    std::array<char, 200> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format);
    return std::string(buffer.data(), end.ptr);
}

std::string shortest(float value) {
    std::array<char, 64> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return std::string(buffer.data(), end.ptr);
}

// The exact decimal digits of the binary value.
std::string exact(float value) {
    std::array<char, 300> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.150f", static_cast<double>(value));
    std::string text = buffer.data();
    while (text.back() == '0') {
        text.pop_back();
    }
    return text; // may end with the point, as `1.`
}

// Precedence levels of section 4; a higher level binds tighter.
constexpr int kUnary = 7;
constexpr int kPower = 8;
constexpr int kPrimary = 9;

int precedence(const Expr& expr) {
    if (expr.kind == ExprKind::Unary) {
        return kUnary;
    }
    if (expr.kind != ExprKind::Binary) {
        return kPrimary;
    }
    static const std::map<std::string, int> kLevels = {
        {"||", 1}, {"&&", 2}, {"==", 3}, {"!=", 3}, {"<", 4}, {"<=", 4},     {">", 4},
        {">=", 4}, {"+", 5},  {"-", 5},  {"*", 6},  {"/", 6}, {"^", kPower},
    };
    return kLevels.at(expr.text);
}

void spell_operand(const Expr& expr,
                   int min_level,
                   Random* random,
                   std::vector<std::string>& tokens) {
    const bool parentheses =
        precedence(expr) < min_level || (random != nullptr && random->percent(6));
    if (parentheses) {
        tokens.emplace_back("(");
    }
    spell_expression(expr, random, tokens);
    if (parentheses) {
        tokens.emplace_back(")");
    }
}

} // namespace

bool is_identifier(const std::string& name) {
    if (name.empty() || !is_letter(name[0])) {
        return false;
    }
    for (const char c : name) {
        if (!is_letter(c) && !is_digit(c)) {
            return false;
        }
    }
    return true;
}

bool is_symbol(const std::string& name) {
    return name.size() == 1 && std::string("+-/\\^&|$!\"'.[]{}%").find(name) != std::string::npos;
}

std::string spell_number(float value, Random* random) {
    const std::string plain = shortest(value);
    if (random == nullptr) {
        return plain;
    }
    switch (random->below(12)) {
    case 0:
        return with_format(value, std::chars_format::scientific);
    case 1:
        return with_format(value, std::chars_format::fixed);
    case 2:
        return value < 1e6F ? exact(value) : plain;
    case 3:
        return plain.find_first_of(".e") == std::string::npos ? plain + "." : plain;
    case 4:
        return plain.find_first_of(".e") == std::string::npos ? plain + ".0e0" : plain;
    case 5:
        return plain.substr(0, 2) == "0." ? plain.substr(1) : plain;
    case 6:
        return plain.find('e') == std::string::npos ? plain + "e+0" : plain;
    default:
        return plain;
    }
}

void spell_expression(const Expr& expr, Random* random, std::vector<std::string>& tokens) {
    switch (expr.kind) {
    case ExprKind::Number:
        tokens.push_back(expr.text.empty() ? spell_number(expr.number, random) : expr.text);
        return;
    case ExprKind::Name:
        tokens.push_back(expr.text);
        return;
    case ExprKind::Unary:
        tokens.push_back(expr.text);
        spell_operand(expr.parts[0], kUnary, random, tokens);
        return;
    case ExprKind::Binary: {
        const int level = precedence(expr);
        const bool comparison = level == 3 || level == 4; // comparisons cannot be chained
        const bool power = level == kPower;
        spell_operand(expr.parts[0], power ? kPrimary : level + (comparison ? 1 : 0), random,
                      tokens);
        tokens.push_back(expr.text);
        spell_operand(expr.parts[1], power ? kUnary : level + 1, random, tokens);
        return;
    }
    case ExprKind::Call:
    case ExprKind::Range: {
        if (expr.kind == ExprKind::Call) {
            tokens.push_back(expr.text);
        }
        tokens.emplace_back(expr.kind == ExprKind::Call ? "(" : "{");
        for (std::size_t i = 0; i < expr.parts.size(); ++i) {
            if (i > 0) {
                tokens.emplace_back(",");
            }
            spell_operand(expr.parts[i], 0, random, tokens);
        }
        tokens.emplace_back(expr.kind == ExprKind::Call ? ")" : "}");
        return;
    }
    }
}

JoinedNames::JoinedNames(const Grammar& grammar, Random& random) {
    known_ = {"F", "f"}; // commands of the turtle profiles that the generator uses
    for (const Statement* statement : statements_in_order(grammar)) {
        if (statement->kind == StatementKind::Object) {
            known_.insert(statement->name);
        }
        for (const ModulePattern& pattern : statement->patterns) {
            known_.insert(pattern.name);
        }
        for (const ModulePattern& pattern : statement->production.predecessor) {
            known_.insert(pattern.name);
        }
    }
    names_ = known_;
    for (const File& file : grammar.files) {
        for (const List& list : lists_of(file)) {
            for (const Word& word : list.words) {
                names_.insert(word.name);
            }
        }
    }
    for (const File& file : grammar.files) {
        if (file.letters) {
            continue;
        }
        std::set<std::string> used; // names that stand alone in this file, with parameter count
        std::vector<List> lists = lists_of(file);
        const bool late = random.percent(50);
        for (std::size_t i = 0; i < lists.size(); ++i) {
            join(lists[late ? lists.size() - 1 - i : i], used, late, random);
        }
    }
}

bool JoinedNames::joined(const void* list, std::size_t index) const {
    const auto found = joined_.find(list);
    return found != joined_.end() && found->second.count(index) != 0;
}

std::set<std::string> JoinedNames::ambiguous_names() const {
    std::set<std::string> ambiguous;
    for (const std::string& name : names_) {
        if (is_identifier(name) && known_.count(name) == 0 && ways(name) > 0) {
            ambiguous.insert(name);
        }
    }
    return ambiguous;
}

std::vector<JoinedNames::List> JoinedNames::lists_of(const File& file) {
    std::vector<List> lists;
    const auto add_pattern = [&lists](const Pattern& pattern) {
        List list{&pattern, {}, false};
        for (const ModulePattern& module : pattern) {
            list.words.push_back({module.name, module.formals.size(), !module.formals.empty()});
        }
        lists.push_back(list);
    };
    const auto add_modules = [&lists](const std::vector<ModuleUse>& modules) {
        List list{&modules, {}, false};
        for (const ModuleUse& module : modules) {
            list.words.push_back({module.name, module.arguments.size(), !module.arguments.empty()});
        }
        lists.push_back(list);
    };
    for (const Statement& statement : file.statements) {
        if (statement.kind == StatementKind::Ignore || statement.kind == StatementKind::Consider) {
            List list{&statement.names, {}, true};
            for (const std::string& name : statement.names) {
                list.words.push_back({name, 0, false});
            }
            lists.push_back(list);
        } else if (statement.kind == StatementKind::Axiom) {
            add_modules(statement.modules);
        } else if (statement.kind == StatementKind::Production) {
            if (statement.production.left) {
                add_pattern(*statement.production.left);
            }
            if (statement.production.right) {
                add_pattern(*statement.production.right);
            }
            add_modules(statement.production.successor);
        }
    }
    return lists;
}

// The number of ways to split `text` into two or more names that occur in the grammar; joined names
// count as occurring.
std::size_t JoinedNames::ways(const std::string& text) const {
    // count[i]: ways to split the first i characters.
    std::vector<std::size_t> count(text.size() + 1, 0);
    count[0] = 1;
    for (std::size_t end = 1; end <= text.size(); ++end) {
        for (std::size_t begin = 0; begin < end; ++begin) {
            const std::string part = text.substr(begin, end - begin);
            const bool whole = part.size() == text.size();
            if (!whole && (names_.count(part) != 0 || texts_.count(part) != 0)) {
                count[end] += count[begin];
            }
        }
    }
    return count[text.size()];
}

// Whether `text` may become a joined name: with it, all joined names so far can be read in one way
// only.
bool JoinedNames::is_safe(const std::string& text) {
    if (names_.count(text) != 0) {
        return false;
    }
    const bool is_new = texts_.insert(text).second;
    bool safe = ambiguous_names().empty();
    for (const std::string& other : texts_) {
        safe = safe && ways(other) == 1;
    }
    if (!safe && is_new) {
        texts_.erase(text);
    }
    return safe;
}

void JoinedNames::join(const List& list, std::set<std::string>& used, bool late, Random& random) {
    const std::size_t size = list.words.size();
    std::set<std::size_t> taken;
    for (std::size_t n = 0; n < size; ++n) {
        const std::size_t first = late ? size - 1 - n : n;
        const std::size_t last = first + (random.percent(20) ? 2 : 1);
        bool free = last < size && random.percent(40);
        for (std::size_t i = first; free && i <= last; ++i) {
            free = taken.count(i) == 0;
        }
        if (free && join_at(list, first, last, used)) {
            for (std::size_t i = first; i <= last; ++i) {
                taken.insert(i);
            }
        } else if (taken.count(first) == 0 && !list.names_only) {
            used.insert(list.words[first].name + "/" + std::to_string(list.words[first].count));
            taken.insert(first);
        }
    }
}

bool JoinedNames::join_at(const List& list,
                          std::size_t first,
                          std::size_t last,
                          std::set<std::string>& used) {
    std::string text;
    for (std::size_t i = first; i <= last; ++i) {
        const Word& word = list.words[i];
        if (!is_identifier(word.name) || (i < last && word.has_parameters)) {
            return false;
        }
        const bool alone = i == last && !list.names_only &&
                           used.count(word.name + "/" + std::to_string(word.count)) != 0;
        if (known_.count(word.name) == 0 && !alone) {
            return false;
        }
        text += word.name;
    }
    if (!is_safe(text)) {
        return false;
    }
    for (std::size_t i = first; i < last; ++i) {
        joined_[list.address].insert(i);
    }
    return true;
}

} // namespace lsys::reference
