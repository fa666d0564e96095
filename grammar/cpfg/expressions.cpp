#include "grammar/cpfg/expressions.h"

#include "grammar/session/number.h"
#include "grammar/session/reports.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

/// Longer expressions come of variables that are put into one another again and again.
constexpr std::size_t kLongestTerm = 20'000;

/// Functions of both, with one argument.
struct Function {
    std::string_view name;
    std::string_view lsys;
};
constexpr std::array kFunctions{
    Function{"sin", "sin"},   Function{"cos", "cos"},   Function{"tan", "tan"},
    Function{"asin", "asin"}, Function{"acos", "acos"}, Function{"atan", "atan"},
    Function{"exp", "exp"},   Function{"log", "log"},   Function{"floor", "floor"},
    Function{"ceil", "ceil"}, Function{"sign", "sign"}, Function{"sqrt", "sqrt"},
    Function{"fabs", "abs"},
};

/// Procedures that do nothing to the word.
constexpr std::array<std::string_view, 10> kProcedures{
    "printf", "fprintf", "fopen", "fclose", "fflush", "stop", "play", "Display", "srand", "fputs"};

bool is_number(std::string_view text) {
    return !text.empty() && literal_length(text) == text.size();
}

/// Whether the text is a number that is 0.
bool is_zero(std::string_view text) {
    return text.find_first_of("123456789") == text.npos;
}

std::string in_parentheses(const std::string& text) {
    const bool plain = is_number(text) ||
                       text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                              "0123456789_") == std::string::npos;
    return plain ? text : "(" + text + ")";
}

} // namespace

void CpfgExpressions::leave_out(SourceSpan span,
                                const std::string& what,
                                const std::string& message) {
    if (left_out_.insert(what).second) {
        session_.context.diagnostics.add(DiagnosticCode::ForeignIgnored, span, message);
    }
}

void CpfgExpressions::find_changed(const std::vector<int>& statements) {
    for (const int index : statements) {
        const CpfgStatement& each = statement(index);
        if (each.kind == CpfgStatementKind::Assign) {
            changed_.insert(node(each.target).text);
        }
        find_changed(each.block);
        find_changed(each.otherwise);
    }
}

void CpfgExpressions::read_header() {
    in_header_ = true;
    for (const int index : session_.definitions) {
        define_array(statement(index));
    }
    run(session_.start);
    globals_ = std::exchange(variables_, {});
    for (const std::vector<int>& block : session_.each) {
        find_changed(block);
        for (const int index : block) {
            const CpfgStatement& each = statement(index);
            if (each.kind == CpfgStatementKind::Call) {
                call_statement(each);
            }
        }
    }
    for (const int index : session_.end) {
        leave_out(statement(index).span, "End", "`End:` is left out: it cannot change the word");
    }
    in_header_ = false;
}

void CpfgExpressions::begin(std::set<std::string> formals, Stage stage) {
    formals_ = std::move(formals);
    stage_ = stage;
    variables_.clear();
}

void CpfgExpressions::run(const std::vector<int>& statements) {
    for (const int index : statements) {
        run(statement(index));
    }
}

void CpfgExpressions::run(const CpfgStatement& each) {
    switch (each.kind) {
    case CpfgStatementKind::Assign: {
        const CpfgExpression& target = node(each.target);
        if (target.kind == CpfgKind::Index) {
            session_.unable(each.span, "an element of an array that is changed while the word is "
                                       "derived");
            return;
        }
        const bool global = globals_.count(target.text) != 0 || changed_.count(target.text) != 0;
        if (!in_header_ && global && formals_.count(target.text) == 0) {
            session_.unable(each.span, "`" + shown(target.text) +
                                           "` belongs to the whole system and is changed by a "
                                           "production");
            return;
        }
        CpfgTerm value = term(each.value);
        if (value.text.size() > kLongestTerm) {
            value = unable(each.span, "the value of `" + shown(target.text) +
                                          "` is too long for one expression");
        }
        value.uses = 0;
        variables_[target.text] = std::move(value);
        break;
    }
    case CpfgStatementKind::Call:
        call_statement(each);
        break;
    case CpfgStatementKind::If:
        branch(each);
        break;
    case CpfgStatementKind::Loop:
        session_.unable(each.span, "a loop");
        break;
    case CpfgStatementKind::Array:
        define_array(each);
        break;
    }
}

void CpfgExpressions::call_statement(const CpfgStatement& each) {
    const CpfgExpression& called = node(each.value);
    if (called.kind != CpfgKind::Call) {
        return; // a value that nobody uses
    }
    const bool known =
        std::find(kProcedures.begin(), kProcedures.end(), called.text) != kProcedures.end();
    if (called.text == "srand") {
        leave_out(called.span, "srand",
                  "`srand` is left out: random numbers are those of lsc, by its own seed");
    } else if (known) {
        leave_out(called.span, called.text,
                  "`" + shown(called.text) + "` is left out: it cannot change the word");
    } else {
        static_cast<void>(term(each.value));
    }
}

void CpfgExpressions::branch(const CpfgStatement& each) {
    const CpfgTerm test = term(each.value);
    if (is_number(test.text)) {
        run(is_zero(test.text) ? each.otherwise : each.block);
        return;
    }
    if (test.drawn) {
        session_.unable(node(each.value).span, "a random number in an `if`");
        return;
    }
    const Variables before = variables_;
    run(each.block);
    Variables yes = std::exchange(variables_, before);
    run(each.otherwise);
    Variables no = std::exchange(variables_, before);
    const auto value_in = [&](const Variables& values, const std::string& name) {
        const auto found = values.find(name);
        if (found != values.end()) {
            return found->second;
        }
        return CpfgTerm{formals_.count(name) != 0 ? name : "0", false, 0};
    };
    std::set<std::string> names;
    for (const Variables* values : {&yes, &no}) {
        for (const auto& [name, value] : *values) {
            names.insert(name);
        }
    }
    for (const std::string& name : names) {
        const CpfgTerm a = value_in(yes, name);
        const CpfgTerm b = value_in(no, name);
        variables_[name] = a.text == b.text ? a : choose(test, a, b, each.span);
    }
}

CpfgTerm CpfgExpressions::choose(const CpfgTerm& test,
                                 const CpfgTerm& yes,
                                 const CpfgTerm& no,
                                 SourceSpan span) {
    if (test.drawn) {
        return unable(span, "a choice by a random number");
    }
    const std::string condition = in_parentheses(test.text);
    CpfgTerm made{"(" + condition + " != 0) * " + in_parentheses(yes.text) + " + (" + condition +
                      " == 0) * " + in_parentheses(no.text),
                  yes.drawn || no.drawn, 0};
    return made.text.size() > kLongestTerm ? unable(span, "a choice that is too long") : made;
}

void CpfgExpressions::define_array(const CpfgStatement& each) {
    constexpr int kMostElements = 256;
    const CpfgExpression& target = node(each.target);
    Array array;
    int count = 1;
    for (const int part : target.parts) {
        const CpfgTerm size = term(part);
        int value = 0;
        std::from_chars(size.text.data(), size.text.data() + size.text.size(), value);
        if (!is_number(size.text) || value <= 0 || value > kMostElements / count) {
            session_.unable(target.span, "an array whose size is no number from 1 to 256");
            return;
        }
        array.sizes.push_back(value);
        count *= value;
    }
    for (const int value : each.block) {
        const CpfgTerm made = term(value);
        if (made.drawn) {
            session_.unable(each.span, "random numbers in an array");
            return;
        }
        array.values.push_back(made.text);
    }
    array.values.resize(static_cast<std::size_t>(count), "0");
    arrays_[target.text] = std::move(array);
}

CpfgTerm CpfgExpressions::element(const CpfgExpression& each) {
    const auto found = arrays_.find(each.text);
    if (found == arrays_.end()) {
        return unable(each.span, "`" + shown(each.text) + "` is no array");
    }
    const Array& array = found->second;
    if (array.sizes.size() != each.parts.size()) {
        return unable(each.span, "`" + shown(each.text) + "` has " +
                                     std::to_string(array.sizes.size()) + " dimensions");
    }
    std::string index = "0";
    bool drawn = false;
    for (std::size_t i = 0; i < each.parts.size(); ++i) {
        const CpfgTerm part = term(each.parts[i]);
        drawn = drawn || part.drawn;
        const std::string floor = is_number(part.text)
                                      ? part.text
                                      : "min(max(floor(" + part.text + "), 0), " +
                                            std::to_string(array.sizes[i] - 1) + ")";
        index =
            i == 0 ? floor
                   : in_parentheses(index) + " * " + std::to_string(array.sizes[i]) + " + " + floor;
    }
    if (drawn) {
        return unable(each.span, "a random number as the index of an array");
    }
    if (is_number(index)) {
        std::size_t at = 0;
        std::from_chars(index.data(), index.data() + index.size(), at);
        return {array.values[std::min(at, array.values.size() - 1)], false, 0};
    }
    std::string text;
    for (std::size_t i = 0; i < array.values.size(); ++i) {
        if (!is_number(array.values[i]) || !is_zero(array.values[i])) {
            text += (text.empty() ? "((" : " + ((") + index + ") == " + std::to_string(i) + ") * " +
                    in_parentheses(array.values[i]);
        }
    }
    return {text.empty() ? "0" : text, false, 0};
}

CpfgTerm CpfgExpressions::name(const CpfgExpression& each) {
    if (const auto found = variables_.find(each.text); found != variables_.end()) {
        CpfgTerm& value = found->second;
        if (value.drawn && ++value.uses > 1) {
            return unable(each.span, "`" + shown(each.text) +
                                         "` is a random number that is used more than once");
        }
        return {in_parentheses(value.text), value.drawn, 0};
    }
    if (formals_.count(each.text) != 0) {
        return {each.text, false, 0};
    }
    if (each.text == "Q") { // the step, from 1
        return {stage_ == Stage::Rewrite ? "(step() + 1)" : "step()", false, 0};
    }
    if (each.text == "Z") {
        return {"steps()", false, 0};
    }
    if (changed_.count(each.text) != 0) {
        return unable(each.span, "`" + shown(each.text) + "` is changed in every step");
    }
    if (const auto found = globals_.find(each.text); found != globals_.end()) {
        return {in_parentheses(found->second.text), false, 0};
    }
    leave_out(each.span, "name " + each.text,
              "`" + shown(each.text) + "` has no value before this; it is 0");
    return {"0", false, 0};
}

CpfgTerm CpfgExpressions::call(const CpfgExpression& each) {
    std::vector<CpfgTerm> arguments;
    bool drawn = false;
    for (const int part : each.parts) {
        if (node(part).kind == CpfgKind::String) {
            return unable(each.span, "`" + shown(each.text) + "`");
        }
        arguments.push_back(term(part));
        drawn = drawn || arguments.back().drawn;
    }
    const auto wants = [&](std::size_t count) { return arguments.size() == count; };
    for (const Function& function : kFunctions) {
        if (function.name == each.text && wants(1)) {
            return {std::string(function.lsys) + "(" + arguments[0].text + ")", drawn, 0};
        }
    }
    if (each.text == "atan2" && wants(2)) { // x first
        return {"atan2(" + arguments[1].text + ", " + arguments[0].text + ")", drawn, 0};
    }
    if (each.text == "trunc" && wants(1)) {
        return {"floor(" + in_parentheses(arguments[0].text) + " + 0.5)", drawn, 0};
    }
    if (each.text == "ran" && wants(1)) {
        return {"{0, 1} * " + in_parentheses(arguments[0].text), true, 0};
    }
    if (each.text == "nran" && wants(2)) {
        return {in_parentheses(arguments[0].text) + " + " + in_parentheses(arguments[1].text) +
                    " * sqrt(-2 * log(1 - {0, 1})) * cos(360 * {0, 1})",
                true, 0};
    }
    if (each.text == "GetDerivationLength") {
        return {"steps()", false, 0};
    }
    if (each.text == "func" || each.text.starts_with("curve")) {
        return unable(each.span, "`" + shown(each.text) +
                                     "`, a function that is drawn as a curve in a file of its own");
    }
    return unable(each.span, "the function `" + shown(each.text) + "`");
}

CpfgTerm CpfgExpressions::binary(const CpfgExpression& each) {
    const CpfgTerm a = term(each.parts[0]);
    const CpfgTerm b = term(each.parts[1]);
    const bool drawn = a.drawn || b.drawn;
    if (each.text == "%") { // of whole numbers
        if (drawn) {
            return unable(each.span, "the remainder of a random number");
        }
        const auto whole = [](const std::string& text) {
            return "sign(" + text + ") * floor(abs(" + text + "))";
        };
        return {"mod(" + whole(a.text) + ", " + whole(b.text) + ")", false, 0};
    }
    const std::string operation = each.text == "<>" ? "!=" : each.text;
    return {in_parentheses(a.text) + " " + operation + " " + in_parentheses(b.text), drawn, 0};
}

CpfgTerm CpfgExpressions::term(int index) {
    const CpfgExpression each = node(index); // the vector may not grow, but terms are long
    CpfgTerm made;
    switch (each.kind) {
    case CpfgKind::Number:
        made.text = each.text;
        break;
    case CpfgKind::Name:
        made = name(each);
        break;
    case CpfgKind::String:
    case CpfgKind::Address:
        made = unable(each.span, "a value that is no number");
        break;
    case CpfgKind::Unary: {
        const CpfgTerm inner = term(each.parts[0]);
        made = {each.text + in_parentheses(inner.text), inner.drawn, 0};
        break;
    }
    case CpfgKind::Binary:
        made = binary(each);
        break;
    case CpfgKind::Choose: {
        const CpfgTerm test = term(each.parts[0]);
        const CpfgTerm yes = term(each.parts[1]);
        const CpfgTerm no = term(each.parts[2]);
        made = choose(test, yes, no, each.span);
        break;
    }
    case CpfgKind::Call:
        made = call(each);
        break;
    case CpfgKind::Index:
        made = element(each);
        break;
    }
    if (made.text.size() > kLongestTerm) {
        return unable(each.span, "an expression that is too long once its variables are replaced");
    }
    return made;
}

} // namespace lsys
