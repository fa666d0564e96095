// SPDX-License-Identifier: MIT
#include "tests/reference/generate_senses.h"

#include "tests/reference/generate_meshes.h"

#include <algorithm>

namespace lsys::reference {

namespace {

// Makes the keys of a `#sense` statement, in any order.
class KeyMaker {
public:
    KeyMaker(Grammar& grammar, const Constants& constants, Random& random)
        : grammar_(grammar), constants_(constants), random_(random) {}

    std::vector<SenseKey> keys_of(const std::string& kind) {
        if (kind == "shadow") {
            add_some("cell", {0.5F, 0.25F, 1, 0.3F, 0.07F});
            add("levels", {random_.percent(90) ? pick({0, 1, 2, 3, 4}) : 9});
            add_some("strength", {0.2F, 0.1F, 0.07F, 1, 0});
            add_some("ratio", {2, 1.5F, 3, 0.5F, 1});
        } else if (kind == "sky") {
            add_some("cell", {0.5F, 0.25F, 1, 0.3F});
            add_some("extinction", {0.5F, 2, 0.125F, 0.01F});
            add("directions", {pick({1, 2, 7, 20, 46})});
        } else if (kind == "space") {
            add_space();
        } else if (kind == "crowd") {
            add("radius", {pick({0.3F, 1, 2.5F, 1.2F, 40})});
        } else if (kind == "solid") {
            for (int count = random_.between(1, 3); count > 0; --count) {
                add_surface();
            }
        } else if (kind == "map") {
            add("size", {pick({1, 4, 2.7F}), pick({1, 5, 3.3F})});
            add_some_lists("at", {{0, 0}, {0.5F, -0.25F}, {-1.3F, 2}});
            add_some("low", {0, -1, 2.5F});
            add_some("high", {1, 3, -0.7F});
            keys_.push_back({"file", {}, "", add_picture(grammar_, random_)});
        }
        random_.shuffle(keys_);
        return keys_;
    }

private:
    float pick(const std::vector<float>& values) { return random_.pick(values); }

    void add(const std::string& key, const std::vector<float>& values) {
        SenseKey one{key, {}, "", ""};
        for (const float value : values) {
            one.numbers.push_back(spelled(value));
        }
        keys_.push_back(one);
    }

    // Leaves the key out sometimes, for its usual value.
    void add_some(const std::string& key, const std::vector<float>& values) {
        if (random_.percent(70)) {
            add(key, {pick(values)});
        }
    }

    void add_some_lists(const std::string& key, const std::vector<std::vector<float>>& values) {
        if (random_.percent(70)) {
            add(key, random_.pick(values));
        }
    }

    // A literal, a negative literal, or an expression of earlier constants.
    Expr spelled(float value) {
        const Expr literal = value < 0 ? unary("-", number(-value)) : number(value);
        if (!random_.percent(20)) {
            return literal;
        }
        for (const auto& [constant, known] : constants_.values) {
            if (constants_.drawn.count(constant) == 0 && random_.percent(50)) {
                return binary("+", binary("*", name(constant), number(0)), literal);
            }
        }
        return binary("*", literal, number(1));
    }

    void add_space() {
        static const std::vector<std::string> kShapes = {"box", "ball", "dome", "cone"};
        if (random_.percent(25)) {
            keys_.push_back({"shape", {}, "", add_mesh(grammar_, random_, MeshUse::Crown)});
        } else {
            keys_.push_back({"shape", {}, random_.pick(kShapes), ""});
            add("size", {pick({2, 3, 4.3F}), pick({1, 3, 2.6F}), pick({2, 4, 3.1F})});
        }
        add_some_lists("at", {{0, 0, 0}, {0.5F, 1, -0.25F}, {0.1F, -0.7F, 0.2F}});
        add("count", {pick({1, 60, 120, 240})});
        add("radius", {pick({0.7F, 1.5F, 3, 40})});
        add("kill", {pick({0, 0.1F, 0.2F, 0.4F})});
        add_some("angle", {360, 180, 120, 90, 60, 41.5F, 271});
    }

    void add_surface() {
        if (random_.percent(55)) {
            keys_.push_back({"mesh", {}, "", add_mesh(grammar_, random_, MeshUse::Obstacle)});
        } else {
            static const std::vector<std::vector<float>> kPlanes = {
                {0, 1, 0, 0},  {0, 1, 0, -1.5F},          {1, 0, 0, 0.75F},
                {0, 0, -2, 1}, {0.3F, -0.2F, 0.7F, 0.1F}, {1, 1, 0, -1}};
            add("plane", random_.pick(kPlanes));
        }
    }

    Grammar& grammar_;
    const Constants& constants_;
    Random& random_;
    std::vector<SenseKey> keys_;
};

void add_turns(Plan& plan, Random& random) {
    std::vector<std::string> turns = {"+", "-", "&", "^", "/", "\\"};
    random.shuffle(turns);
    for (int count = random.between(2, 4); count > 0; --count) {
        plan.kinds.push_back({turns.back(), random.percent(80) ? 1U : 0U});
        turns.pop_back();
    }
    for (const char* other : {"|", "$", "\""}) {
        if (random.percent(15)) {
            plan.kinds.push_back({other, 0});
        }
    }
}

} // namespace

void add_senses(Plan& plan, bool letters_files, Random& random) {
    plan.senses = true;
    plan.brackets = random.percent(85);
    plan.unbalanced = plan.brackets && random.percent(2);
    plan.polygons = random.percent(40);
    plan.open_polygons = plan.polygons && random.percent(10);
    add_turns(plan, random);
    const std::vector<ModuleKind> moves = {{"F", random.percent(75) ? 1U : 0U},
                                           {"f", random.percent(50) ? 1U : 0U}};
    plan.kinds.insert(plan.kinds.end(), moves.begin(), moves.end());
    plan.active.insert(plan.active.end(), moves.begin(), moves.end());

    std::vector<std::string> names = {"A", "B", "c", "d", "E", "G", "i", "Q", "x", "Z"};
    if (!letters_files) {
        names.insert(names.end(), {"light", "sky", "near_1", "_", "step", "w", "Soil", "PH"});
    }
    random.shuffle(names);
    for (int count = random.between(1, 3); count > 0; --count) {
        plan.environments.push_back(names.back());
        const std::string module = "?" + names.back();
        names.pop_back();
        // Most modules have room for the whole answer, some for less or more.
        const auto size = static_cast<std::size_t>(random.percent(65) ? 4 : random.between(0, 5));
        plan.senses_of.push_back({module, size});
        if (random.percent(30)) {
            plan.senses_of.push_back({module, size == 1 ? 0U : 1U});
        }
    }
    for (const char* turtle : {"?P", "?H", "?U", "?R", "?L"}) {
        if (random.percent(30)) {
            plan.senses_of.push_back(
                {turtle, static_cast<std::size_t>(random.percent(70) ? 3 : random.between(0, 4))});
        }
    }
    plan.kinds.insert(plan.kinds.end(), plan.senses_of.begin(), plan.senses_of.end());
    if (random.percent(70)) { // answers change the plant
        plan.active.push_back(random.pick(plan.senses_of));
    }
}

Statement sense_statement(const std::string& name,
                          Grammar& grammar,
                          const Constants& constants,
                          Random& random) {
    static const std::vector<std::string> kKinds = {"shadow", "sky", "space",  "crowd",
                                                    "solid",  "map", "program"};
    Statement statement;
    statement.kind = StatementKind::Sense;
    statement.name = name;
    statement.sense.kind = random.pick(kKinds);
    statement.sense.keys = KeyMaker(grammar, constants, random).keys_of(statement.sense.kind);
    return statement;
}

Expr length_argument(const std::vector<std::string>& formals, Random& random) {
    static const std::vector<float> kLengths = {0.5F, 1, 0.25F, 0.75F, 1.2F, 0.1F, 0.3F};
    switch (random.below(8)) {
    case 0:
        return range(number(0.2F), number(1));
    case 1:
        return unary("-", number(random.pick(kLengths)));
    case 2:
    case 3:
        if (!formals.empty()) {
            return call("clamp", {name(random.pick(formals)), number(0.1F), number(1.5F)});
        }
        [[fallthrough]];
    default:
        return number(random.pick(kLengths));
    }
}

Expr turn_argument(const std::vector<std::string>& formals, Random& random) {
    static const std::vector<float> kAngles = {30, 45, 90, 22.5F, 60, 137.5F, 25.7F, 180, 1000};
    switch (random.below(8)) {
    case 0:
        return range(number(10), number(80));
    case 1:
        return unary("-", number(random.pick(kAngles)));
    case 2:
    case 3:
        if (!formals.empty()) {
            return binary("*", number(random.pick(kAngles)), name(random.pick(formals)));
        }
        [[fallthrough]];
    default:
        return number(random.pick(kAngles));
    }
}

std::vector<std::pair<std::string, std::string>> plant_settings(Random& random) {
    static const std::vector<std::pair<std::string, std::vector<std::string>>> kSettings = {
        {"angle", {"22.5", "60", "25.7"}},
        {"step", {"0.5", "0.3"}},
        {"step_scale", {"0.7", "1.1"}},
        {"turtle", {"lsys", "thesis", "abop"}},
        {"tropism", {"0 -1 0 0.2", "0.3 1 -0.2 0.31", "1 0 0 -0.5"}},
        {"height", {"3"}}, // no effect on places: the plant is scaled later
        {"pipe", {"2 0.05"}}};
    std::vector<std::pair<std::string, std::string>> settings;
    for (const auto& [key, values] : kSettings) {
        if (random.percent(key == "height" || key == "pipe" ? 5 : 25)) {
            settings.emplace_back(key, random.pick(values));
        }
    }
    return settings;
}

std::string add_object_mesh(Grammar& grammar, Random& random) {
    return add_mesh(grammar, random, MeshUse::Organ);
}

} // namespace lsys::reference
