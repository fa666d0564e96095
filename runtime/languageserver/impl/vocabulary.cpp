// SPDX-License-Identifier: MIT
#include "runtime/languageserver/impl/vocabulary.h"

#include "compiler/bytecode/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace lsys {

namespace {

constexpr auto kStatementHelps = std::to_array<StatementHelp>({
    {"#n", "#n = NUMBER;", "number of generations"},
    {"#w", "#w : modules;",
     "axiom: the modules to begin with; `#w ~ p : modules;` is one of several"},
    {"#define", "#define NAME expr;", "constant"},
    {"#param", "#param NAME expr {min, max};", "constant that users can change within bounds"},
    {"#function", "#function NAME(x, ...) expr;", "function of numbers"},
    {"#curve", "#curve NAME x y, x y, ...;",
     "function of one number, a smooth line through points"},
    {"#contour", "#contour NAME x y, x y, ...;", "cross-section of organs"},
    {"#material", "#material INDEX key value ...;", "appearance of a colour index"},
    {"#sense", "#sense NAME KIND key value ...;", "environment that modules `?NAME` ask"},
    {"#module", "#module NAME(formals);",
     "declares a module, so that it is not reported as unknown"},
    {"#object", "#object NAME OBJECT;", "modules of this name draw an object or a mesh"},
    {"#include", "#include \"file.lsys\";", "the statements of another file, in place"},
    {"#set", "#set KEY value;", "setting"},
    {"#ignore", "#ignore : names;", "modules that contexts skip"},
    {"#consider", "#consider : names;", "the only modules that contexts see"},
    {"#decompose", "#decompose NAME : module : condition : successor;",
     "production that is applied again and again after each generation"},
    {"#interpret", "#interpret NAME : module : condition : successor;",
     "production that is applied only for the drawing"},
    {"#down", "#down NAME : module > right : condition : module;",
     "sweep of parameters through each word, from the tips to the root"},
    {"#up", "#up NAME : left < module : condition : module;",
     "sweep of parameters through each word, from the root to the tips"},
});

constexpr auto kFunctionHelps = std::to_array<FunctionHelp>({
    {"abs", "x", "absolute value"},
    {"acos", "x", "arc cosine, in degrees"},
    {"asin", "x", "arc sine, in degrees"},
    {"atan", "x", "arc tangent, in degrees"},
    {"atan2", "y, x", "angle of the point (x, y), in degrees"},
    {"binomial", "n, p", "random number of successes in n trials of probability p"},
    {"ceil", "x", "smallest whole number from x on"},
    {"clamp", "x, low, high", "x, but at least low and at most high"},
    {"cos", "x", "cosine of x degrees"},
    {"exp", "x", "e to the power of x"},
    {"floor", "x", "largest whole number up to x"},
    {"if", "c, a, b", "a if c is not 0, else b"},
    {"log", "x", "natural logarithm"},
    {"max", "x, y", "the larger number"},
    {"min", "x, y", "the smaller number"},
    {"mix", "a, b, t", "a + (b - a) t"},
    {"mod", "x, y", "remainder of x / y, with the sign of x"},
    {"normal", "mean, deviation", "random number of the normal distribution"},
    {"poisson", "mean", "random whole number of the Poisson distribution"},
    {"pow", "x, y", "x to the power of y"},
    {"round", "x", "nearest whole number, halves away from zero"},
    {"sign", "x", "1 or -1; x if it is 0"},
    {"sin", "x", "sine of x degrees"},
    {"sqrt", "x", "square root"},
    {"step", "", "age of the word that is rewritten, from 0"},
    {"steps", "", "number of generations"},
    {"tan", "x", "tangent of x degrees"},
});

template <typename Enum>
SettingHelp choice(std::string_view name, Enum initial) {
    SettingHelp help;
    help.name = name;
    for (const Enum value : enumerators_of<Enum>()) {
        help.values.emplace_back(name_of(value));
    }
    help.meaning =
        fmt::format("one of `{}`; default `{}`", fmt::join(help.values, "`, `"), name_of(initial));
    return help;
}

template <typename Number>
SettingHelp number(std::string_view name, std::string_view wanted, Number initial) {
    return {std::string(name), fmt::format("{}; default {}", wanted, initial), {}};
}

/// Help for a setting whose value is neither one number nor one word of a fixed list.
SettingHelp special(std::string_view name) {
    if (name == "names") {
        return {"names",
                "how module names end: `words`, or each of the `letters` or `characters` is a "
                "module; default `words`",
                {"words", "letters", "characters"}};
    }
    constexpr auto kMeanings = std::to_array<std::pair<std::string_view, std::string_view>>({
        {"tropism", "x y z e: segments turn towards the direction (x, y, z) by e"},
        {"tropisms",
         "`after`, `before` or `twist` x y z e: tropisms whose strength e commands change"},
        {"seed", "seed of the random numbers, from 0"},
        {"spring", "`auto`, or the spring constant of every joint in N m / rad"},
        {"height", "height of the plant in metres"},
        {"pipe", "e w t: widths from the tips, by exponent, width of a tip and taper"},
        {"flare", "f h n: the stem is f times as thick at the ground, up to the height h, with n "
                  "roots"},
    });
    const auto found = std::find_if(kMeanings.begin(), kMeanings.end(),
                                    [&](const auto& row) { return row.first == name; });
    SettingHelp help{std::string(name), {}, {}};
    if (found != kMeanings.end()) {
        help.meaning = found->second;
    }
    if (name == "spring") {
        help.values = {"auto"};
    }
    return help;
}

template <typename Row, std::size_t size>
const Row* find_row(const std::array<Row, size>& rows, std::string_view name) {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.name == name; });
    return found != rows.end() ? &*found : nullptr;
}

} // namespace

std::span<const StatementHelp> statement_helps() {
    return kStatementHelps;
}

const StatementHelp* find_statement_help(std::string_view name) {
    return find_row(kStatementHelps, name);
}

std::span<const FunctionHelp> function_helps() {
    return kFunctionHelps;
}

const FunctionHelp* find_function_help(std::string_view name) {
    return find_row(kFunctionHelps, name);
}

std::vector<SettingHelp> setting_helps() {
    std::vector<SettingHelp> all;
#define LSYS_CHOICE(type, field, initial, effect, group)                                           \
    all.push_back(choice(#field, type::initial));
#define LSYS_NUMBER(field, initial, effect, group, min, wanted)                                    \
    all.push_back(number(#field, wanted, initial));
#define LSYS_COUNT(field, initial, effect, group, min, max, wanted, misfit)                        \
    all.push_back(number(#field, wanted, initial));
#define LSYS_FIELD(type, field, initial, effect)
#define LSYS_STATEMENT(key) all.push_back(special(#key));
#include "compiler/bytecode/settings.def"
    return all;
}

std::optional<SettingHelp> find_setting_help(std::string_view name) {
    for (SettingHelp& help : setting_helps()) {
        if (help.name == name) {
            return std::move(help);
        }
    }
    return std::nullopt;
}

} // namespace lsys
