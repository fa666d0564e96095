// SPDX-License-Identifier: MIT
#include "tests/reference/generate_grammar.h"

#include "tests/reference/generate_expression.h"
#include "tests/reference/generate_productions.h"
#include "tests/reference/generate_senses.h"
#include "tests/reference/random.h"
#include "tests/reference/spelling.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace lsys::reference {

namespace {

std::string to_text(std::uint64_t value) {
    return std::to_string(value);
}

// Makes a grammar from a seed and an attempt. The same seed and attempt give the same grammar.
class Maker {
public:
    Maker(std::uint64_t seed, std::uint32_t attempt, bool senses)
        : random_(seed, 0x100 + attempt), senses_(senses),
          productions_(random_, plan_, constants_) {}

    Case make() {
        make_files();
        plan_ = make_plan(some_file(true), some_file(false), random_);
        if (senses_) {
            add_senses(plan_, some_file(true), random_);
        }
        place(choose_kinds());
        fill_file(0);
        finish();
        return case_;
    }

private:
    // Makes one file, or several files that include each other as a tree.
    void make_files() {
        const int count = random_.percent(60) ? 1 : random_.between(2, 4);
        static const std::vector<std::string> kFolders = {"", "", "parts/", "parts/deep/", "more/"};
        const bool letters = random_.percent(35);
        for (int i = 0; i < count; ++i) {
            File file;
            file.path = i == 0 ? (random_.percent(85) ? "main.lsys" : "plants/main.lsys")
                               : random_.pick(kFolders) + "part" + std::to_string(i) + ".lsys";
            file.letters = letters && random_.percent(count == 1 ? 100 : 60);
            case_.grammar.files.push_back(file);
            parent_.push_back(i == 0 ? 0 : random_.below(static_cast<std::size_t>(i)));
        }
    }

    bool some_file(bool letters) {
        return std::any_of(case_.grammar.files.begin(), case_.grammar.files.end(),
                           [&](const File& file) { return file.letters == letters; });
    }

    // Chooses the kinds of the statements, in the order of the text with all includes.
    std::vector<StatementKind> choose_kinds() {
        std::vector<std::pair<int, StatementKind>> keys;
        const auto add = [&](StatementKind kind, int from, int to, int low, int high) {
            for (int count = random_.between(from, to); count > 0; --count) {
                keys.emplace_back(random_.between(low, high), kind);
            }
        };
        add(StatementKind::Define, 0, 3, 0, 70);
        add(StatementKind::Param, 0, 1, 0, 70);
        if (random_.percent(40)) {
            add(StatementKind::Function, 0, 3, 0, 70);
            add(StatementKind::Curve, 0, 1, 0, 70);
        }
        add(StatementKind::Module, 0, 2, 0, 100);
        add(StatementKind::Object, 0, plan_.senses ? 3 : 1, 0, 100);
        if (plan_.senses) {
            const auto environments = static_cast<int>(plan_.environments.size());
            add(StatementKind::Sense, environments, environments, 0, 100);
        }
        axiom_shares_ =
            random_.percent(15) ? productions_.shares(random_.between(1, 3)) : std::vector<float>{};
        const int axioms = std::max(1, static_cast<int>(axiom_shares_.size()));
        add(StatementKind::Axiom, axioms, axioms, 0, 100);
        add(StatementKind::Generations, random_.percent(65) ? 1 : 0, 1, 0, 100);
        add(StatementKind::Production, random_.percent(98) ? 2 : 0, 6, 40, 100);
        std::stable_sort(keys.begin(), keys.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<StatementKind> kinds;
        bool generations = false;
        for (const auto& [key, kind] : keys) {
            if (kind != StatementKind::Generations || !generations) {
                kinds.push_back(kind);
            }
            generations = generations || kind == StatementKind::Generations;
        }
        has_generations_ = generations;
        return kinds;
    }

    // Distributes the statements, in order, over the files, and puts #include statements between
    // them.
    void place(const std::vector<StatementKind>& kinds) {
        std::vector<File>& files = case_.grammar.files;
        // Files in the order in which reading visits them: a file is visited when it is entered,
        // and again after each #include in it.
        std::vector<std::size_t> order;
        walk(0, order);
        std::vector<std::size_t> cuts; // count of statements before each visit but the first
        for (std::size_t visit = 1; visit < order.size(); ++visit) {
            cuts.push_back(random_.below(kinds.size() + 1));
        }
        std::sort(cuts.begin(), cuts.end());
        cuts.push_back(kinds.size());
        std::size_t next = 0;
        for (std::size_t visit = 0; visit < order.size(); ++visit) {
            File& file = files[order[visit]];
            for (; next < cuts[visit]; ++next) {
                Statement statement;
                statement.kind = kinds[next];
                file.statements.push_back(statement);
            }
            // At the first visit of the next file, include it here.
            if (visit + 1 < order.size() && order[visit + 1] > order[visit]) {
                Statement include;
                include.kind = StatementKind::IncludeFile;
                include.file = order[visit + 1];
                file.statements.push_back(include);
            }
        }
    }

    void walk(std::size_t file, std::vector<std::size_t>& order) {
        order.push_back(file);
        for (std::size_t child = 1; child < parent_.size(); ++child) {
            if (parent_[child] == file) {
                walk(child, order);
                order.push_back(file);
            }
        }
    }

    // Fills statements in the order in which they take effect, so that a constant precedes its use.
    void fill_file(std::size_t index) {
        for (Statement& statement : case_.grammar.files[index].statements) {
            if (statement.kind == StatementKind::IncludeFile) {
                fill_file(statement.file);
            } else {
                fill(statement, case_.grammar.files[index].letters);
            }
        }
    }

    std::string new_constant() {
        static const std::vector<std::string> kNames = {
            "K", "L", "RATE", "x", "y", "sin", "step", "A", "e", "w", "d0", "min", "angle", "_k"};
        std::string name;
        do {
            name = random_.pick(kNames);
            name += random_.percent(15) ? to_text(random_.below(20)) : "";
        } while (constants_.values.count(name) != 0);
        return name;
    }

    std::string new_label() {
        static const std::vector<std::string> kNames = {
            "p",   "rule",  "grow",   "A", "x",      "define",  "n",
            "set", "param", "module", "K", "object", "include", "_"};
        std::string label;
        do {
            label = random_.pick(kNames);
            label += random_.percent(60) ? to_text(random_.below(40)) : "";
        } while (!labels_.insert(label).second);
        return label;
    }

    void fill(Statement& statement, bool letters) {
        ExpressionMaker expressions(random_, constants_);
        const Scope constant_scope{{}, false, random_.percent(30) ? 15U : 0U, true};
        switch (statement.kind) {
        case StatementKind::Define:
            statement.name = new_constant();
            statement.expr =
                random_.percent(50) ? expressions.literal() : expressions.any(constant_scope, 3);
            if (random_.percent(15)) {
                const Expr unit = range(number(0), number(1));
                statement.expr = binary("+", statement.expr, unit);
            }
            define(statement);
            return;
        case StatementKind::Param:
            fill_param(statement, expressions);
            return;
        case StatementKind::Function:
            fill_function(statement, expressions);
            return;
        case StatementKind::Curve:
            fill_curve(statement);
            return;
        case StatementKind::Sense:
            statement = sense_statement(plan_.environments[sense_count_++], case_.grammar,
                                        constants_, random_);
            return;
        case StatementKind::Module: {
            const ModuleKind& module = declarable(letters);
            statement.patterns = {{module.name, {}}};
            for (std::size_t i = 0; i < module.count; ++i) {
                statement.patterns[0].formals.push_back("p" + to_text(i));
            }
            return;
        }
        case StatementKind::Object:
            fill_object(statement, letters);
            return;
        case StatementKind::Axiom: {
            do {
                statement.modules =
                    productions_.modules(random_.between(1, 7), constant_scope, letters);
            } while (statement.modules.empty());
            if (random_.percent(3)) {
                add_many_constants(statement.modules, letters);
            }
            if (!axiom_shares_.empty()) {
                statement.has_probability = true;
                statement.expr = productions_.probability(axiom_shares_.back(), {});
                axiom_shares_.pop_back();
            }
            return;
        }
        case StatementKind::Production:
            bundles_[&statement] = productions_.bundle(letters);
            return;
        default:
            return;
        }
    }

    void fill_object(Statement& statement, bool letters) {
        static const std::vector<std::string> kObjects = {
            "BRANCH", "SPHERE", "HETEROCYST", "LEAF", "FLOWER", "CYLINDER", "CONE", "CUBE", "DISK"};
        do {
            statement.name = declarable(letters).name;
        } while (statement.name == "\"" || statement.name == "." || is_bound(statement.name));
        statement.text = random_.pick(kObjects);
        if (!plan_.senses) {
            return;
        }
        if (random_.percent(30)) {
            statement.mesh = add_object_mesh(case_.grammar, random_);
            statement.text.clear();
        } else if (statement.text == "LEAF" || statement.text == "FLOWER") {
            statement.text = "SPHERE"; // the oracle does not know the area of a leaf
        }
        bound_.insert(statement.name);
    }

    [[nodiscard]] bool is_bound(const std::string& name) const { return bound_.count(name) != 0; }

    std::string new_function() {
        static const std::vector<std::string> kNames = {"f", "taper", "g", "let", "A", "x", "K"};
        std::string name;
        do {
            name = random_.pick(kNames);
            name += random_.percent(40) ? to_text(random_.below(20)) : "";
        } while (constants_.functions.count(name) != 0);
        return name;
    }

    static bool divides(const Expr& expr) {
        return expr.text == "/" || expr.text == "mod" ||
               std::any_of(expr.parts.begin(), expr.parts.end(), divides);
    }

    // A body has no divisions, because a call could make the divisor 0, which is an error of the
    // grammar.
    void fill_function(Statement& statement, ExpressionMaker& expressions) {
        static const std::vector<std::vector<std::string>> kFormals = {
            {"x"}, {"a"}, {"x", "y"}, {"s", "t", "K"}, {"if", "let"}};
        statement.name = new_function();
        statement.names = random_.pick(kFormals);
        const Scope scope{statement.names, false, 0, false};
        do {
            statement.expr = expressions.any(scope, random_.between(1, 4));
        } while (divides(statement.expr));
        constants_.functions[statement.name] = {statement.names, statement.expr, {}};
    }

    void fill_curve(Statement& statement) {
        statement.name = new_function();
        UserFunction curve;
        float x = static_cast<float>(random_.between(-4, 2));
        for (int count = random_.between(2, 6); count > 0; --count) {
            const float y = 0.25F * static_cast<float>(random_.between(-20, 20));
            curve.points.emplace_back(x, y);
            const Expr sum = binary("+", number(x), number(0));
            statement.points.emplace_back(random_.percent(70) ? number(x) : sum, number(y));
            x += 0.5F * static_cast<float>(random_.between(1, 6));
        }
        constants_.functions[statement.name] = curve;
    }

    // Adds more modules with constant arguments than there are codes of one byte.
    void add_many_constants(std::vector<ModuleUse>& modules, bool letters) {
        for (int i = 0; i < 300; ++i) {
            const ModuleKind& module = fitting(letters);
            ModuleUse use{module.name, {}};
            for (std::size_t k = 0; k < module.count; ++k) {
                use.arguments.push_back(number(static_cast<float>(i)));
            }
            modules.push_back(use);
        }
    }

    const ModuleKind& fitting(bool letters) {
        while (true) {
            const ModuleKind& module = random_.pick(plan_.kinds);
            if (fits(module.name, letters)) {
                return module;
            }
        }
    }

    // A module that may have a declaration.
    const ModuleKind& declarable(bool letters) {
        while (true) {
            const ModuleKind& module = fitting(letters);
            if (!is_sense_name(module.name)) {
                return module;
            }
        }
    }

    // Decides whether -D replaces the value of a constant, and by which value. Done when the
    // constant is defined, because later statements use the value.
    void define(const Statement& statement) {
        ExpressionMaker expressions(random_, constants_);
        const Scope scope;
        if (random_.percent(15)) {
            float value = expressions.literal().number;
            if (statement.kind == StatementKind::Param) {
                value = expressions.constant_value(random_.percent(50) ? statement.low
                                                                       : statement.high);
            } else if (random_.percent(30)) {
                value = -value;
            }
            case_.request.definitions.emplace_back(statement.name, value);
            constants_.values[statement.name] = value;
        } else if (expressions.is_constant(statement.expr, scope)) {
            constants_.values[statement.name] = expressions.constant_value(statement.expr);
        } else {
            constants_.values[statement.name] = 0;
            constants_.drawn.insert(statement.name);
        }
    }

    void fill_param(Statement& statement, ExpressionMaker& expressions) {
        statement.name = new_constant();
        Scope scope;
        scope.drawn_constants = false;
        if (random_.percent(40)) { // a random value with bounds that enclose it
            const float low = static_cast<float>(random_.between(-4, 4));
            const float high = low + static_cast<float>(random_.between(0, 6)) / 2;
            statement.expr = range(number(low), number(high));
            statement.low = number(random_.percent(50) ? low : low - 1.5F);
            statement.high = number(random_.percent(50) ? high : high + 1);
        } else {
            statement.expr =
                random_.percent(50) ? expressions.literal() : expressions.any(scope, 2);
            const float value = expressions.constant_value(statement.expr);
            const bool small = std::fabs(value) < 1e6F;
            statement.low = number(random_.percent(50) || !small ? value : value - 1);
            statement.high = number(random_.percent(50) || !small ? value : value + 2);
            if (random_.percent(20) && small) {
                statement.high = binary("+", statement.high, number(2));
            }
        }
        define(statement);
    }

    void add_statement(Statement statement, std::size_t file) {
        std::vector<Statement>& statements = case_.grammar.files[file].statements;
        const auto at = static_cast<std::ptrdiff_t>(random_.below(statements.size() + 1));
        statements.insert(statements.begin() + at, std::move(statement));
    }

    void add_setting(const std::string& key, const std::string& value, std::size_t file) {
        Statement statement;
        statement.kind = StatementKind::Set;
        statement.name = key;
        statement.text = value;
        add_statement(statement, file);
    }

    // Replaces the placeholders of bundles by productions, repairs their probabilities, and adds
    // settings and the declarations that prevent names from being split.
    void finish() {
        expand_bundles();
        add_sweeps();
        repair_probabilities();
        decompose_some();
        interpret_some();
        insert_cuts();
        add_materials();
        add_ignored();
        add_settings();
        declare_ambiguous_names();
    }

    // Adds productions of sweeps at the end of the first file, where all constants are known.
    void add_sweeps() {
        if (plan_.rewriting != "parallel" || !random_.percent(35)) {
            return;
        }
        File& file = case_.grammar.files[0];
        const int ways = random_.between(1, 3); // down, up or both
        for (const Stage stage : {Stage::Down, Stage::Up}) {
            const bool is_wanted = (stage == Stage::Down ? ways & 1 : ways & 2) != 0;
            for (int bundles = is_wanted ? random_.between(1, 3) : 0; bundles > 0; --bundles) {
                for (const Production& production :
                     productions_.sweep_bundle(stage, file.letters)) {
                    Statement& statement = file.statements.emplace_back();
                    statement.kind = StatementKind::Production;
                    statement.production = production;
                    statement.production.label = new_label();
                }
            }
        }
    }

    // Moves some groups to `#decompose`, if this is legal.
    void decompose_some() {
        std::set<std::string> chosen;
        for (File& file : case_.grammar.files) {
            for (Statement& statement : file.statements) {
                Production& production = statement.production;
                if (statement.kind != StatementKind::Production || production.left ||
                    production.right || production.predecessor.size() != 1 ||
                    production.stage != Stage::Rewrite) {
                    continue;
                }
                const std::string group = group_of(production);
                if (chosen.count(group) != 0 ||
                    (decided_.insert(group).second && random_.percent(12))) {
                    chosen.insert(group);
                    production.stage = Stage::Decompose;
                }
            }
        }
        if (!chosen.empty()) {
            add_setting("decompose_depth", to_text(random_.below(3) + 1), any_file());
            add_setting("at_depth", "stop", any_file());
        }
    }

    // Moves a group to `#interpret`: its productions then change the drawing, not the word.
    void interpret_some() {
        if (!random_.percent(plan_.senses ? 35 : 10)) {
            return;
        }
        std::string chosen;
        for (File& file : case_.grammar.files) {
            for (Statement& statement : file.statements) {
                Production& production = statement.production;
                if (statement.kind != StatementKind::Production || production.left ||
                    production.right || production.predecessor.size() != 1 ||
                    production.stage != Stage::Rewrite) {
                    continue;
                }
                chosen = chosen.empty() ? group_of(production) : chosen;
                if (chosen == group_of(production)) {
                    production.stage = Stage::Interpret;
                }
            }
        }
        if (plan_.senses && !chosen.empty()) { // words are drawn while they are derived
            add_setting("interpret_depth", to_text(random_.below(3) + 1), any_file());
            if (!setting(case_.grammar, "at_depth")) {
                add_setting("at_depth", "stop", any_file());
            }
        }
    }

    // Adds some `#material` statements with different indices.
    void add_materials() {
        static const std::vector<std::string> kValues = {
            "0 colour 0.4 0.3 0.2", "(2-1) color 1 0 .5 roughness 0.9",
            "65535 translucency (1/2) two_sided 1", "7 roughness 0", "40 colour 0 0 1"};
        for (const std::string& values : kValues) {
            if (random_.percent(6)) {
                Statement statement;
                statement.kind = StatementKind::Material;
                statement.text = values;
                add_statement(statement, any_file());
            }
        }
    }

    // Inserts a `%` into some axioms and successors.
    void insert_cuts() {
        if (!random_.percent(22)) {
            return;
        }
        for (File& file : case_.grammar.files) {
            for (Statement& statement : file.statements) {
                if (statement.production.stage == Stage::Down ||
                    statement.production.stage == Stage::Up) {
                    continue;
                }
                std::vector<ModuleUse>& modules = statement.kind == StatementKind::Axiom
                                                      ? statement.modules
                                                      : statement.production.successor;
                if (random_.percent(40) && !modules.empty()) {
                    const std::size_t at = random_.below(modules.size() + 1);
                    modules.insert(modules.begin() + static_cast<std::ptrdiff_t>(at), {"%", {}});
                }
            }
        }
    }

    // Replaces `#ignore` by a `#consider` of all other names; returns false if this is not
    // possible.
    bool add_considered() {
        std::set<std::string> names;
        for (const ModuleKind& module : plan_.kinds) {
            names.insert(module.name);
        }
        for (const std::string& name : plan_.ignored) {
            names.erase(name);
        }
        Statement statement;
        statement.kind = StatementKind::Consider;
        for (const std::string& name : names) {
            if (name == "[" || name == "]") {
                continue;
            }
            statement.names = {name};
            add_statement(statement, file_for(statement.names));
        }
        return !statement.names.empty();
    }

    void add_ignored() {
        if (random_.percent(20) && add_considered()) {
            return;
        }
        Statement statement;
        statement.kind = StatementKind::Ignore;
        for (const std::string& name : plan_.ignored) {
            statement.names.push_back(name);
            if (random_.percent(50)) {
                add_statement(statement, file_for(statement.names));
                statement.names.clear();
            }
        }
        if (!statement.names.empty()) {
            add_statement(statement, file_for(statement.names));
        }
    }

    // A random file in which all of these names can be written.
    std::size_t file_for(const std::vector<std::string>& names) {
        while (true) {
            const std::size_t file = any_file();
            const bool letters = case_.grammar.files[file].letters;
            if (std::all_of(names.begin(), names.end(),
                            [&](const std::string& name) { return fits(name, letters); })) {
                return file;
            }
        }
    }

    void expand_bundles() {
        for (File& file : case_.grammar.files) {
            std::vector<Statement> statements;
            for (Statement& statement : file.statements) {
                if (statement.kind != StatementKind::Production) {
                    statements.push_back(statement);
                    continue;
                }
                for (const Production& production : bundles_[&statement]) {
                    Statement one;
                    one.kind = StatementKind::Production;
                    one.production = production;
                    one.production.label = new_label();
                    statements.push_back(one);
                }
            }
            file.statements = statements;
            put_contexts_first(file);
            mix_bundles(file);
        }
    }

    // Moves productions with contexts to the front, because productions without contexts before
    // them would often match first.
    void put_contexts_first(File& file) {
        if (random_.percent(25)) {
            return;
        }
        const auto is_production = [](const Statement& statement) {
            return statement.kind == StatementKind::Production;
        };
        auto begin = file.statements.begin();
        // Moves productions only within runs of productions, so that no constant is used before it
        // is defined.
        while (begin != file.statements.end()) {
            begin = std::find_if(begin, file.statements.end(), is_production);
            const auto end = std::find_if_not(begin, file.statements.end(), is_production);
            std::stable_partition(begin, end, [](const Statement& statement) {
                return statement.production.left || statement.production.right;
            });
            begin = end;
        }
    }

    // Exchanges some neighbouring productions, so that productions of different groups and rules
    // alternate.
    void mix_bundles(File& file) {
        if (!random_.percent(40)) {
            return;
        }
        for (std::size_t i = 1; i < file.statements.size(); ++i) {
            Statement& first = file.statements[i - 1];
            Statement& second = file.statements[i];
            if (first.kind == StatementKind::Production &&
                second.kind == StatementKind::Production && random_.percent(40)) {
                std::swap(first, second);
            }
        }
    }

    // "If no production of such a group has a condition, its p must sum to 1 within 0.011".
    void repair_probabilities() {
        if (plan_.weights_any) {
            return;
        }
        std::map<std::string, std::vector<Production*>> groups;
        for (File& file : case_.grammar.files) {
            for (Statement& statement : file.statements) {
                if (statement.production.probability) {
                    groups[group_of(statement.production)].push_back(&statement.production);
                }
            }
        }
        Environment environment;
        environment.constants = &constants_.values;
        for (auto& [group, productions] : groups) {
            float sum = 0;
            bool condition = false;
            for (const Production* production : productions) {
                sum += evaluate(*production->probability, environment);
                condition = condition || production->condition.has_value();
            }
            if (!condition && std::fabs(sum - 1) > 0.0105F) {
                productions[random_.below(productions.size())]->condition =
                    binary(random_.percent(70) ? ">=" : "<", call("step", {}), number(1));
            }
        }
    }

    std::size_t any_file() { return random_.below(case_.grammar.files.size()); }

    void add_settings() {
        if (plan_.rewriting != "parallel" || random_.percent(10)) {
            add_setting("rewriting", plan_.rewriting, any_file());
        }
        if (plan_.choice_generation || random_.percent(10)) {
            add_setting("choice", plan_.choice_generation ? "generation" : "module", any_file());
        }
        if (plan_.weights_any || random_.percent(10)) {
            add_setting("weights", plan_.weights_any ? "any" : "one", any_file());
        }
        for (std::size_t i = 0; i < case_.grammar.files.size(); ++i) {
            if (case_.grammar.files[i].letters || random_.percent(5)) {
                add_setting("names", case_.grammar.files[i].letters ? "letters" : "words", i);
            }
        }
        std::uint64_t seed = random_.below(1000);
        if (random_.percent(40)) {
            seed = (seed << 54U) + (std::uint64_t{random_.word()} << 16U);
            seed += random_.word();
        }
        if (random_.percent(40)) {
            add_setting("seed", to_text(seed), any_file());
        }
        if (random_.percent(70)) {
            case_.request.seed = random_.percent(90) ? seed + 1 : ~std::uint64_t{0};
        }
        if (plan_.senses) {
            add_plant_settings();
        } else if (random_.percent(15)) {
            static const std::vector<std::vector<std::string>> kOthers = {
                {"angle", "22.5"},      {"step", "2"},      {"width", "0.05"},
                {"turtle", "thesis"},   {"turtle", "lsys"}, {"tropism", "0 -1 0 .2"},
                {"width_scale", "0.8"}, {"sides", "6"},     {"spring", "1e3"},
            };
            const std::vector<std::string>& other = random_.pick(kOthers);
            add_setting(other[0], other[1], any_file());
        }
        // A case without #n needs -n. The 0 is replaced by generate().
        if (!has_generations_ || random_.percent(20)) {
            case_.request.generations = 0;
        }
    }

    // Settings that change places, and the programs of environments.
    void add_plant_settings() {
        for (const auto& [key, value] : plant_settings(random_)) {
            add_setting(key, value, any_file());
        }
        for (const Statement* statement : statements_in_order(case_.grammar)) {
            if (statement->kind == StatementKind::Sense && statement->sense.kind == "program") {
                case_.request.programs.push_back(statement->name);
            }
        }
    }

    void declare_ambiguous_names() {
        while (true) {
            Random random(0, 0);
            const std::set<std::string> names =
                JoinedNames(case_.grammar, random).ambiguous_names();
            if (names.empty()) {
                return;
            }
            Statement statement;
            statement.kind = StatementKind::Module;
            statement.patterns = {{*names.begin(), {}}};
            add_statement(statement, file_for({*names.begin()}));
        }
    }

    Random random_;
    bool senses_ = false;
    Case case_;
    Plan plan_;
    Constants constants_;
    ProductionMaker productions_;
    std::vector<std::size_t> parent_;
    std::set<std::string> labels_;
    std::set<std::string> bound_; // modules with an #object
    std::size_t sense_count_ = 0; // #sense statements so far
    std::map<const Statement*, std::vector<Production>> bundles_;
    std::set<std::string> decided_; // groups for which #decompose was chosen or rejected
    bool has_generations_ = false;
    std::vector<float> axiom_shares_; // probabilities of the next axioms if there are several
};

} // namespace

Case make_case(std::uint64_t seed, std::uint32_t attempt, bool senses) {
    return Maker(seed, attempt, senses).make();
}

} // namespace lsys::reference
