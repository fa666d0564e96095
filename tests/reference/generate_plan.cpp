// SPDX-License-Identifier: MIT
#include "tests/reference/generate_plan.h"

#include "tests/reference/spelling.h"

#include <algorithm>

namespace lsys::reference {

namespace {

void add_species(Plan& plan, const std::string& name, std::size_t max_parameters, Random& random) {
    const auto count =
        static_cast<std::size_t>(random.between(0, static_cast<int>(max_parameters)));
    plan.kinds.push_back({name, random.percent(60) ? count : std::min(count, max_parameters / 2)});
    if (max_parameters > 0 && random.percent(25)) { // the same name, another number of parameters
        plan.kinds.push_back({name, (count + 1) % (max_parameters + 1)});
    }
}

} // namespace

bool fits(const std::string& name, bool letters) {
    if (!letters) {
        return true;
    }
    const std::string bare = is_sense_name(name) ? name.substr(1) : name;
    return !is_identifier(bare) || (bare.size() == 1 && bare != "_");
}

Plan make_plan(bool letters_files, bool words_files, Random& random) {
    Plan plan;
    plan.rewriting =
        random.percent(50)
            ? "parallel"
            : random.pick(std::vector<std::string>{"sequential", "cyclic", "leftmost"});
    plan.choice_generation = random.percent(25);
    plan.weights_any = random.percent(25);
    plan.brackets = random.percent(60);
    plan.unbalanced = plan.brackets && random.percent(7);
    plan.polygons = random.percent(15);
    plan.open_polygons = plan.polygons && random.percent(40);
    plan.context_percent = random.pick(std::vector<std::size_t>{0, 40, 80});
    plan.condition_percent = random.pick(std::vector<std::size_t>{0, 40, 70});
    plan.stochastic_percent = random.pick(std::vector<std::size_t>{0, 30, 70});
    plan.range_percent = random.pick(std::vector<std::size_t>{0, 8, 15, 60});
    plan.local_percent = random.pick(std::vector<std::size_t>{0, 0, 30, 70});

    std::vector<std::string> letters = {"A", "B", "C", "S", "X", "Y", "F", "f", "a", "b", "e"};
    std::vector<std::string> words = {
        "al", "br", "Stem", "Ab_1",   "_",     "sin", "step", "w",  "n",  "define", "min",   "AS",
        "AB", "F2", "leaf", "ignore", "names", "e5",  "inf",  "Ff", "x1", "BA",     "steps", "set"};
    std::vector<std::string> symbols = {"+", "-", "/", "\\", "^", "&",
                                        "|", "$", "!", "\"", "'", "."};
    std::vector<std::string> quoted = {
        "@",  ";",  ":",  "~",        "<", ">",   "*", ",", "(",       ")", "#w",
        "//", "->", "/*", "\xC3\xA9", "1", "a-b", "=", "?", "3D_tree", "#", "sixteen-letters!"};
    for (auto* names : {&letters, &words, &symbols, &quoted}) {
        random.shuffle(*names);
    }
    const std::size_t max_parameters =
        random.pick(std::vector<std::size_t>{0, 1, 1, 1, 2, 2, 3, 6});
    const int letter_count = random.between(2, 5);
    for (int i = 0; i < letter_count; ++i) {
        add_species(plan, letters[static_cast<std::size_t>(i)], max_parameters, random);
    }
    if (words_files && random.percent(50)) {
        const int word_count = random.between(1, 3);
        for (int i = 0; i < word_count; ++i) {
            add_species(plan, words[static_cast<std::size_t>(i)], max_parameters, random);
        }
    }
    random.shuffle(plan.kinds);
    const std::size_t active = 1 + random.below(std::min<std::size_t>(plan.kinds.size(), 4));
    plan.active.assign(plan.kinds.begin(),
                       plan.kinds.begin() + static_cast<std::ptrdiff_t>(active));
    const int symbol_count = random.between(0, 3);
    for (int i = 0; i < symbol_count; ++i) {
        const std::string& symbol = symbols[static_cast<std::size_t>(i)];
        const bool bare = symbol == "|" || symbol == "$" || symbol == ".";
        add_species(plan, symbol, bare ? 0 : max_parameters, random);
    }
    if (random.percent(8)) {
        plan.kinds.push_back({"'", 3}); // a colour
    }
    if (random.percent(25)) {
        add_species(plan, quoted[0], max_parameters, random);
        add_species(plan, quoted[1], max_parameters, random);
    }
    if (random.percent(25)) { // symbols may be rewritten too
        plan.active.push_back(plan.kinds.back());
    }
    if (plan.context_percent > 0 && random.percent(50)) {
        for (int count = random.between(1, 2); count > 0; --count) {
            const std::size_t back = random.below(std::min<std::size_t>(4, plan.kinds.size()));
            plan.ignored.push_back(plan.kinds[plan.kinds.size() - 1 - back].name);
        }
    }
    while (letters_files &&
           std::none_of(plan.active.begin(), plan.active.end(),
                        [](const ModuleKind& kind) { return fits(kind.name, true); })) {
        plan.active.push_back({random.pick(letters), random.percent(50) ? max_parameters : 0});
        plan.kinds.push_back(plan.active.back());
    }
    return plan;
}

} // namespace lsys::reference
