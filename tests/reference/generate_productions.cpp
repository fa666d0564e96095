// SPDX-License-Identifier: MIT
#include "tests/reference/generate_productions.h"

#include "tests/reference/generate_senses.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>

namespace lsys::reference {

namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool can_be_rewritten(const std::string& name) {
    return std::string("[]{}").find(name) == std::string::npos;
}

// Index of `length` adjacent modules at a random place in `list`; nullopt if there is no such
// place.
std::optional<std::size_t> place_in(const KindList& list, std::size_t length, Random& random) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i + length <= list.size(); ++i) {
        const auto first = list.begin() + static_cast<std::ptrdiff_t>(i);
        if (std::all_of(first, first + static_cast<std::ptrdiff_t>(length),
                        [](const ModuleKind& one) { return can_be_rewritten(one.name); })) {
            places.push_back(i);
            if (i + length < list.size() && list[i + length].name == "[") {
                // Added three more times, because contexts with branches fit here.
                places.insert(places.end(), 3, i);
            }
        }
    }
    if (places.empty()) {
        return std::nullopt;
    }
    return random.pick(places);
}

ModulePattern pattern_of(const ModuleKind& kind) {
    return {kind.name, std::vector<std::string>(kind.count)};
}

// The last modules on the path that leads to `place`, as a left context.
Pattern cut_left(const KindList& list,
                 std::size_t place,
                 int length,
                 const std::vector<std::string>& ignored) {
    Pattern pattern;
    int finished = 0; // depth within branches that are not on the path
    for (std::size_t i = place; i-- > 0 && static_cast<int>(pattern.size()) < length;) {
        if (list[i].name == "]") {
            ++finished;
        } else if (list[i].name == "[") {
            finished -= finished > 0 ? 1 : 0;
        } else if (finished == 0 && !contains(ignored, list[i].name)) {
            pattern.insert(pattern.begin(), pattern_of(list[i]));
        }
    }
    return pattern;
}

// Some modules of the axis from `place` on, with some of its branches, as a right context.
Pattern cut_right(const KindList& list,
                  std::size_t place,
                  int length,
                  const std::vector<std::string>& ignored,
                  Random& random) {
    Pattern pattern;
    /// Whether a branch was skipped: a pattern with a branch directly after it would not match.
    bool skipped = false;
    std::size_t i = place;
    for (int taken = 0; taken < length && i < list.size() && list[i].name != "]"; ++i) {
        if (list[i].name == "[") {
            if (!skipped && random.percent(70)) {
                const int inner_length = random.between(0, 2);
                pattern.push_back({"[", {}});
                const Pattern inner = cut_right(list, i + 1, inner_length, ignored, random);
                pattern.insert(pattern.end(), inner.begin(), inner.end());
                pattern.push_back({"]", {}});
                ++taken;
            } else {
                skipped = true;
            }
            for (int depth = 0; i < list.size(); ++i) {
                depth += list[i].name == "[" ? 1 : list[i].name == "]" ? -1 : 0;
                if (depth == 0) {
                    break;
                }
            }
        } else if (!contains(ignored, list[i].name)) {
            pattern.push_back(pattern_of(list[i]));
            skipped = false;
            ++taken;
        }
    }
    return pattern;
}

} // namespace

const ModuleKind& ProductionMaker::any_kind(bool letters) {
    while (true) {
        const bool senses = plan_.senses && random_.percent(20);
        const ModuleKind& kind = random_.pick(senses                ? plan_.senses_of
                                              : random_.percent(75) ? plan_.active
                                                                    : plan_.kinds);
        if (fits(kind.name, letters)) {
            return kind;
        }
    }
}

const ModuleKind& ProductionMaker::active_kind(bool letters) {
    while (true) {
        const std::size_t turn = next_active_kind_++ % plan_.active.size();
        const ModuleKind& kind = random_.percent(70)   ? plan_.active[turn]
                                 : random_.percent(75) ? random_.pick(plan_.active)
                                                       : random_.pick(plan_.kinds);
        if (fits(kind.name, letters)) {
            return kind;
        }
    }
}

Pattern ProductionMaker::context(int length, bool brackets, int depth, bool letters) {
    Pattern pattern;
    for (int i = 0; i < length; ++i) {
        if (brackets && random_.percent(35)) {
            pattern.push_back({"[", {}});
            if (depth < 2 && random_.percent(80)) {
                for (ModulePattern& inner :
                     context(random_.between(1, 2), true, depth + 1, letters)) {
                    pattern.push_back(inner);
                }
            }
            pattern.push_back({"]", {}});
        } else if (brackets && plan_.polygons && random_.percent(5)) {
            pattern.push_back({random_.percent(50) ? "{" : "}", {}});
        } else {
            const ModuleKind& kind = any_kind(letters);
            pattern.push_back({kind.name, std::vector<std::string>(kind.count)});
        }
    }
    return pattern;
}

void ProductionMaker::name_formals(Pattern& pattern, std::vector<std::string>& used) {
    // Formals may have the names of functions, settings and keywords.
    static const std::vector<std::string> kUsual = {"x", "y", "z", "a", "b", "s", "t",
                                                    "u", "v", "x", "y", "z", "l", "r"};
    static const std::vector<std::string> kOdd = {
        "w",  "n",     "sin",    "step", "min", "A",    "_",         "x1",   "e",
        "e1", "angle", "define", "F",    "inf", "max_", "long_name", "steps"};
    for (ModulePattern& module : pattern) {
        for (std::string& formal : module.formals) {
            do {
                if (!constants_.values.empty() && random_.percent(8)) {
                    const std::size_t k = random_.below(constants_.values.size());
                    auto constant = constants_.values.begin();
                    std::advance(constant, static_cast<std::ptrdiff_t>(k));
                    formal = constant->first;
                } else {
                    formal = random_.pick(random_.percent(80) ? kUsual : kOdd);
                    formal += random_.percent(10) ? std::to_string(random_.between(1, 9)) : "";
                }
            } while (std::find(used.begin(), used.end(), formal) != used.end());
            used.push_back(formal);
        }
    }
}

// Local values may have the names of keywords, functions and constants.
std::string ProductionMaker::name_local(const std::vector<std::string>& used) {
    static const std::vector<std::string> kNames = {"d", "len", "q", "let", "if", "mix", "p", "k"};
    std::string text;
    do {
        const bool hides = !constants_.values.empty() && random_.percent(10);
        text = hides ? constants_.values.begin()->first : random_.pick(kNames);
        text += !hides && random_.percent(30) ? std::to_string(random_.between(1, 9)) : "";
    } while (std::find(used.begin(), used.end(), text) != used.end());
    return text;
}

KindList ProductionMaker::random_list(int length, bool letters, bool polygon) {
    KindList list;
    const auto nest = [&](const char* open, const char* close, bool in_polygon) {
        list.push_back({open, 0});
        const KindList inner = random_list(random_.between(0, 3), letters, in_polygon);
        list.insert(list.end(), inner.begin(), inner.end());
        list.push_back({close, 0});
    };
    for (int i = 0; i < length; ++i) {
        if (plan_.brackets && random_.percent(22)) {
            nest("[", "]", polygon);
        } else if (plan_.polygons && !polygon && random_.percent(12)) {
            nest("{", "}", true);
        } else {
            list.push_back(any_kind(letters));
        }
    }
    return list;
}

const KindList& ProductionMaker::common_list(bool letters) {
    std::vector<KindList>& all = letters ? lists_of_letters_ : lists_;
    while (all.size() < 3) {
        all.push_back(random_list(random_.between(3, 7), letters, false));
    }
    return random_.pick(all);
}

Expr ProductionMaker::argument(const ModuleKind& kind, const Scope& scope) {
    if (!plan_.senses) {
        return expressions_.argument(scope);
    }
    if (std::string("+-&^/\\").find(kind.name) != std::string::npos) {
        return turn_argument(scope.formals, random_);
    }
    const bool is_answer = is_sense_name(kind.name);
    const bool is_any = random_.percent(kind.name == "F" || kind.name == "f" ? 3 : 30);
    return is_any                             ? expressions_.argument(scope)
           : is_answer && random_.percent(60) ? number(0)
                                              : length_argument(scope.formals, random_);
}

std::vector<ModuleUse> ProductionMaker::modules(int length, const Scope& scope, bool letters) {
    const bool common = length > 2 && random_.percent(60);
    const KindList names = common ? common_list(letters) : random_list(length, letters, false);
    std::vector<ModuleUse> list;
    for (const ModuleKind& kind : names) {
        ModuleUse use{kind.name, {}};
        for (std::size_t k = 0; k < kind.count; ++k) {
            use.arguments.push_back(argument(kind, scope));
        }
        list.push_back(use);
    }
    if (plan_.unbalanced && random_.percent(30)) {
        const auto at = static_cast<std::ptrdiff_t>(random_.below(list.size() + 1));
        list.insert(list.begin() + at, {random_.percent(60) ? "[" : "]", {}});
    }
    if (plan_.open_polygons && random_.percent(30)) {
        // Inserts modules that begin a polygon, end one, or end one and begin another.
        const auto at = static_cast<std::ptrdiff_t>(random_.below(list.size() + 1));
        const std::size_t way = random_.below(4);
        if (way != 1) {
            list.insert(list.begin() + at, {"{", {}});
        }
        if (way == 1 || way == 2) {
            list.insert(list.begin() + at, {"}", {}});
        }
    }
    return list;
}

// An expression with the value `value`, up to rounding: a number, an operation, or a constant with
// this value.
Expr ProductionMaker::probability(float value, const std::vector<std::string>& formals) {
    for (const auto& [constant, known] : constants_.values) {
        if (known == value && !contains(formals, constant) &&
            constants_.drawn.count(constant) == 0 && random_.percent(50)) {
            return name(constant);
        }
    }
    switch (random_.below(8)) {
    case 0:
        return binary("-", number(1), number(1 - value));
    case 1:
        return binary("/", number(value), number(1));
    case 2:
        return binary("*", number(2), number(value / 2));
    default:
        return number(value);
    }
}

// A weight that depends on the module: 0 for some modules, and negative for few.
Expr ProductionMaker::weight(const Scope& scope) {
    // An expression that the compiler does not recognise as the constant 0, which would be an
    // error.
    Expr any = scope.formals.empty() || random_.percent(20) ? call("step", {})
                                                            : name(random_.pick(scope.formals));
    if (random_.percent(60)) {
        static const std::vector<std::string> kOperators = {"+", "-", "*"};
        any = binary(random_.pick(kOperators), any, expressions_.literal());
    }
    switch (random_.below(6)) {
    case 0:
        return any;
    case 1:
        return unary("-", any);
    case 2:
        return call("max", {number(0), binary("-", any, number(2))});
    case 3:
        return call("if", {binary(">", any, number(1)), number(3), number(0)});
    default:
        return call("min", {call("abs", {any}), number(1000)});
    }
}

// Probabilities whose sum is nearly 1.
std::vector<float> ProductionMaker::shares(int count) {
    static const std::vector<std::vector<std::vector<float>>> kShares = {
        {{1}, {0.995F}},
        {{0.5F, 0.5F},
         {0.25F, 0.75F},
         {0.1F, 0.9F},
         {0.999F, 0.001F},
         {0.34F, 0.66F},
         {0.3F, 0.7F}},
        {{0.33F, 0.33F, 0.34F}, {0.33F, 0.33F, 0.33F}, {0.2F, 0.3F, 0.5F}, {0.1F, 0.1F, 0.8F}},
        {{0.25F, 0.25F, 0.25F, 0.25F}, {0.1F, 0.2F, 0.3F, 0.4F}, {0.7F, 0.1F, 0.15F, 0.06F}},
    };
    std::vector<float> values = random_.pick(kShares[static_cast<std::size_t>(count - 1)]);
    random_.shuffle(values);
    if (plan_.weights_any) {
        static const std::vector<float> kWeights = {1, 2, 3, 0.5F, 10, 0.01F, 7.25F, 100};
        for (float& value : values) {
            value = random_.percent(60) ? random_.pick(kWeights) : value;
        }
    }
    return values;
}

// Makes predecessor and contexts: cuts them from a stored list, or makes them of modules of random
// kinds.
Production ProductionMaker::shape(bool letters) {
    Production shape;
    const bool allows_several_modules = plan_.rewriting != "parallel";
    const std::size_t length =
        allows_several_modules && random_.percent(35) ? 2 + random_.below(2) : 1;
    const bool in_context = random_.percent(plan_.context_percent);
    const std::size_t sides = random_.below(10);
    const int size = random_.percent(60) ? 1 : random_.between(2, 3);
    const KindList& list = common_list(letters);
    const std::optional<std::size_t> place = place_in(list, length, random_);
    const bool from_list = place && random_.percent(in_context || length > 1 ? 85 : 25);
    for (std::size_t i = 0; i < length; ++i) {
        const ModuleKind& kind = from_list ? list[*place + i] : active_kind(letters);
        shape.predecessor.push_back({kind.name, std::vector<std::string>(kind.count)});
    }
    if (in_context && sides < 6) {
        shape.left = from_list ? cut_left(list, *place, size, plan_.ignored) : Pattern{};
        if (shape.left->empty()) {
            shape.left = context(size, false, 0, letters);
        }
    }
    if (in_context && sides > 3) {
        const std::size_t end = from_list ? *place + length : 0;
        shape.right = from_list ? cut_right(list, end, size, plan_.ignored, random_) : Pattern{};
        if (shape.right->empty()) {
            shape.right = context(size, plan_.brackets, 0, letters);
        }
    }
    return shape;
}

std::vector<Production> ProductionMaker::bundle(bool letters) {
    return bundle_of(shape(letters), letters);
}

// A bundle of `#down` has no left contexts and one of `#up` no right contexts. Most modules in it
// have parameters to change.
std::vector<Production> ProductionMaker::sweep_bundle(Stage stage, bool letters) {
    Production shape;
    for (int tries = 0; tries < 20; ++tries) {
        shape = this->shape(letters);
        (stage == Stage::Down ? shape.left : shape.right).reset();
        const bool has_context = shape.left || shape.right;
        if (shape.predecessor.size() == 1 && !shape.predecessor[0].formals.empty() &&
            (has_context || random_.percent(20))) {
            break;
        }
    }
    shape.predecessor.resize(1);
    shape.stage = stage;
    return bundle_of(shape, letters);
}

// Makes the modules that replace the predecessor; in a sweep, the same module with other
// parameters.
std::vector<ModuleUse>
ProductionMaker::successor(const Production& production, const Scope& scope, bool letters) {
    static const std::vector<int> kLengths = {0, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 5, 8};
    if (production.stage == Stage::Rewrite) {
        return modules(random_.pick(kLengths), scope, letters);
    }
    const ModulePattern& swept = production.predecessor[0];
    ModuleUse use{swept.name, {}};
    for (const std::string& formal : swept.formals) {
        // Most values depend on a neighbour, in a way that seldom makes them grow without bound.
        const std::string& other = random_.pick(scope.formals);
        const Expr sum = random_.percent(50) ? binary("+", name(formal), name(other))
                                             : call("max", {name(formal), name(other)});
        use.arguments.push_back(random_.percent(50) ? sum : expressions_.argument(scope));
    }
    return {use};
}

std::vector<Production> ProductionMaker::bundle_of(const Production& shape, bool letters) {
    const int count = random_.percent(45) ? 1 : random_.between(2, 4);
    const bool stochastic = random_.percent(plan_.stochastic_percent);
    const bool conditional = random_.percent(plan_.condition_percent);
    const std::vector<float> parts = shares(count);
    std::vector<Production> bundle;
    bool has_condition = false;
    for (int i = 0; i < count; ++i) {
        Production production = shape;
        std::vector<std::string> formals;
        for (Pattern* pattern :
             {&production.predecessor, production.left ? &*production.left : nullptr,
              production.right ? &*production.right : nullptr}) {
            if (pattern != nullptr) {
                name_formals(*pattern, formals);
            }
        }
        Scope scope{formals, true, 0, true};
        // Without probabilities, only the last production may lack a condition.
        const bool is_last = i + 1 == count;
        if ((conditional && random_.percent(75)) || (!stochastic && !is_last)) {
            production.condition = expressions_.condition(scope);
            has_condition = true;
        }
        if (stochastic) {
            production.probability = plan_.weights_any && random_.percent(50)
                                         ? weight(scope)
                                         : probability(parts[static_cast<std::size_t>(i)], formals);
        }
        scope.range_percent = plan_.range_percent;
        if (random_.percent(plan_.local_percent)) {
            const int locals = random_.between(1, 3);
            for (int k = 0; k < locals; ++k) {
                const std::string text = name_local(scope.formals);
                production.locals.emplace_back(text, expressions_.local(scope));
                scope.formals.push_back(text);
            }
        }
        production.successor = successor(production, scope, letters);
        bundle.push_back(production);
    }
    if (has_condition && stochastic && random_.percent(25)) {
        // Other probabilities are legal here, and one production may have none.
        for (Production& production : bundle) {
            production.probability = number(random_.percent(50) ? 0.5F : 0.125F);
        }
        if (random_.percent(50)) {
            bundle[random_.below(bundle.size())].probability.reset();
        }
    }
    return bundle;
}

} // namespace lsys::reference
