// SPDX-License-Identifier: MIT
#include "tests/reference/sensing.h"

#include "tests/reference/environments/crowd.h"
#include "tests/reference/environments/program.h"
#include "tests/reference/environments/shadow.h"
#include "tests/reference/environments/sky.h"
#include "tests/reference/environments/solid.h"
#include "tests/reference/mesh_file.h"
#include "tests/reference/pass.h"
#include "tests/reference/walk.h"

#include <algorithm>
#include <cmath>

namespace lsys::reference {

namespace {

// The values of the keys of a statement.
class Keys {
public:
    explicit Keys(const DeclaredSense& declared)
        : statement_(*declared.statement), values_(declared.values) {}

    // Number `index` of the value of a key, or the usual value.
    [[nodiscard]] double number(const std::string& key, double usual, std::size_t index = 0) const {
        for (std::size_t i = 0; i < values_.size(); ++i) {
            if (statement_.sense.keys[i].key == key && index < values_[i].size()) {
                return static_cast<double>(values_[i][index]);
            }
        }
        return usual;
    }
    [[nodiscard]] Vector vector(const std::string& key) const {
        return {number(key, 0), number(key, 0, 1), number(key, 0, 2)};
    }
    [[nodiscard]] const SenseKey& with_name(const std::string& key) const {
        const std::vector<SenseKey>& keys = statement_.sense.keys;
        return *std::find_if(keys.begin(), keys.end(),
                             [&](const SenseKey& one) { return one.key == key; });
    }

private:
    const Statement& statement_;
    const std::vector<std::vector<float>>& values_;
};

Space space_of(const Grammar& grammar, const Keys& keys) {
    static const std::map<std::string, Shape> kShapes = {{"box", Shape::Box},
                                                         {"ball", Shape::Ball},
                                                         {"dome", Shape::Dome},
                                                         {"cone", Shape::Cone},
                                                         {"", Shape::Mesh}};
    Space space;
    const SenseKey& shape = keys.with_name("shape");
    space.shape = kShapes.at(shape.word);
    if (space.shape == Shape::Mesh) {
        space.mesh = surface_of(mesh_of(grammar, shape.file));
    }
    space.size = keys.vector("size");
    space.at = keys.vector("at");
    space.count = static_cast<std::uint32_t>(keys.number("count", 0));
    space.radius = keys.number("radius", 0);
    space.angle = keys.number("angle", 90);
    space.kill = keys.number("kill", 0);
    return space;
}

Solid solid_of(const Grammar& grammar, const DeclaredSense& declared) {
    Solid solid;
    for (std::size_t i = 0; i < declared.values.size(); ++i) {
        const SenseKey& key = declared.statement->sense.keys[i];
        if (key.key == "mesh") {
            solid.meshes.push_back(surface_of(mesh_of(grammar, key.file)));
        } else {
            Plane& plane = solid.planes.emplace_back();
            std::copy(declared.values[i].begin(), declared.values[i].end(), plane.begin());
        }
    }
    return solid;
}

GreyMap map_of(const Grammar& grammar, const Keys& keys) {
    GreyMap map;
    map.picture = grey_of(picture_of(grammar, keys.with_name("file").file));
    map.size = {keys.number("size", 0), keys.number("size", 0, 1)};
    map.at = {keys.number("at", 0), keys.number("at", 0, 1)};
    map.low = keys.number("low", 0);
    map.high = keys.number("high", 1);
    return map;
}

bool is_finite(const Vector& vector) {
    return std::all_of(vector.begin(), vector.end(), [](double x) { return std::isfinite(x); });
}

// Overwrites the first parameters. Returns false if one of them is not finite.
bool write_answer(Module& module, const std::vector<double>& answer, Answered& answered) {
    std::vector<float> numbers;
    for (std::size_t i = 0; i < std::min(answer.size(), module.values.size()); ++i) {
        numbers.push_back(rounded_answer(answer[i]));
    }
    std::copy(numbers.begin(), numbers.end(), module.values.begin());
    if (!numbers.empty()) {
        ++answered.modules;
        const bool is_other =
            std::any_of(numbers.begin(), numbers.end(), [](float number) { return number != 0; });
        answered.other_than_zero += is_other ? 1U : 0U;
        answered.different.insert(numbers);
    }
    return std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); });
}

// The answer of the turtle; empty for other sense modules.
std::vector<double> answer_of_turtle(const std::string& name, const Pose& pose) {
    const Vector left{-pose.right[0], -pose.right[1], -pose.right[2]};
    const Vector& answer = name == "?P"   ? pose.position
                           : name == "?H" ? pose.heading
                           : name == "?U" ? pose.up
                           : name == "?R" ? pose.right
                                          : left;
    const bool is_turtle =
        name.size() == 2 && std::string("PHURL").find(name[1]) != std::string::npos;
    return is_turtle ? std::vector<double>(answer.begin(), answer.end()) : std::vector<double>{};
}

// The modules that ask an environment.
struct Asking {
    std::vector<std::size_t> indexes; // in the word
    std::vector<Place> places;
};

Asking asking(const std::string& name, const Word& word, const Walk& walked, std::uint32_t age) {
    Asking result;
    for (const auto& [index, pose] : walked.poses) {
        if (word[index].name != name) {
            continue;
        }
        if (!is_finite(pose.position)) {
            throw Stop{RunError{Failure::NoAnswer, "", index, age, word[index]}};
        }
        result.indexes.push_back(index);
        result.places.push_back({pose.position, pose.heading, pose.up, word[index].values});
    }
    return result;
}

} // namespace

Surroundings::Surroundings(const System& system) : system_(system) {
    for (std::size_t i = 0; i < system.senses.size(); ++i) {
        if (system.senses[i].statement->sense.kind == "space") {
            const Space space = space_of(*system.grammar, Keys(system.senses[i]));
            markers_.emplace(i, Markers(space, system.seed, static_cast<std::uint32_t>(i)));
        }
    }
}

Answers Surroundings::answers_of(std::size_t number,
                                 std::uint32_t age,
                                 const std::vector<Place>& places,
                                 const std::vector<Organ>& organs) {
    const DeclaredSense& declared = system_.senses[number];
    const Keys keys(declared);
    const std::string& kind = declared.statement->sense.kind;
    if (kind == "shadow") {
        const Shadow usual;
        return shadow_answers(
            {keys.number("cell", usual.cell), static_cast<int>(keys.number("levels", usual.levels)),
             keys.number("strength", usual.strength), keys.number("ratio", usual.ratio)},
            places);
    }
    if (kind == "sky") {
        const Sky usual;
        return sky_answers({keys.number("cell", usual.cell),
                            keys.number("extinction", usual.extinction),
                            static_cast<int>(keys.number("directions", usual.directions))},
                           organs, places);
    }
    if (kind == "space") {
        return markers_.at(number).answers(places);
    }
    if (kind == "crowd") {
        return crowd_answers(keys.number("radius", 0), places);
    }
    if (kind == "solid") {
        return solid_answers(solid_of(*system_.grammar, declared), places);
    }
    if (kind == "map") {
        return map_answers(map_of(*system_.grammar, keys), places);
    }
    return program_answers(age, places);
}

void Surroundings::sense(Word& word, std::uint32_t age, Derivation& derivation) {
    if (std::none_of(word.begin(), word.end(),
                     [](const Module& module) { return is_sense_name(module.name); })) {
        return;
    }
    const Walk walked = walk(system_, word, interpreted(system_, word, age, derivation), age);
    const Word read = word;
    std::map<std::size_t, std::vector<double>> answers; // by index in the word
    std::map<std::size_t, std::string> kinds;
    for (const auto& [index, pose] : walked.poses) {
        answers[index] = answer_of_turtle(word[index].name, pose);
        kinds[index] = "turtle";
    }
    for (std::size_t number = 0; number < system_.senses.size(); ++number) {
        const Statement& statement = *system_.senses[number].statement;
        const Asking asked = asking("?" + statement.name, read, walked, age);
        if (asked.places.empty()) {
            continue; // "A word without `?NAME` removes no markers."
        }
        try {
            const Answers all = answers_of(number, age, asked.places, walked.organs);
            for (std::size_t i = 0; i < all.size(); ++i) {
                answers[asked.indexes[i]] = all[i];
                kinds[asked.indexes[i]] = statement.sense.kind;
            }
        } catch (const NoAnswer& none) {
            const std::size_t index = asked.indexes[none.place];
            throw Stop{RunError{Failure::NoAnswer, "", index, age, read[index]}};
        }
    }
    for (const auto& [index, answer] : answers) {
        if (!write_answer(word[index], answer, derivation.answered[kinds[index]])) {
            throw Stop{RunError{Failure::NoAnswer, "", index, age, read[index]}};
        }
    }
}

} // namespace lsys::reference
