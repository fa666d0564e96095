// SPDX-License-Identifier: MIT
#include "viewer/app/forest_senses.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace lsys::view {

namespace {

/// The stage of a tree; null: its species senses nothing.
const SensedStage* stage_of(const ForestDocument& document, const Tree& tree) {
    const GrownForest& grown = document.grown;
    if (tree.species >= grown.sensed.size() || grown.sensed[tree.species] == nullptr) {
        return nullptr;
    }
    const SensedStage& stage = grown.sensed[tree.species]->stages[grown.forest.stage_of(tree)];
    return stage.heroes.empty() ? nullptr : &stage;
}

/// What the hero of a tree sensed; null: it is not kept.
const SensedPlant* plant_of(const ForestDocument& document, const Tree& tree) {
    const SensedStage* const stage = stage_of(document, tree);
    const Forest& forest = document.grown.forest;
    const InstanceCache& cache = forest.cache_of(tree);
    const std::uint32_t hero =
        cache.instances[TreeExpander(cache, forest.key).root_instance(tree)].hero;
    return stage != nullptr && hero < stage->heroes.size() ? &stage->heroes[hero] : nullptr;
}

/// Turns, scales and moves a drawing of a hero to a tree, and appends it.
void append(SenseDrawing part, const Tree& tree, SenseDrawing& drawing) {
    const BranchInstance pose = root_of(tree);
    for (SenseGroup& group : part.groups) {
        group.first += drawing.vertices.size();
        group.diameter *= pose.scale;
        drawing.groups.push_back(group);
    }
    for (LineVertex& vertex : part.vertices) {
        vertex.position = pose.position + pose.rotation * (pose.scale * vertex.position);
        drawing.vertices.push_back(vertex);
    }
}

const std::vector<EnvironmentMove>& moves_of(const SpeciesMoves& moves, const Tree& tree) {
    static const std::vector<EnvironmentMove> kNone;
    return tree.species < moves.size() ? moves[tree.species] : kNone;
}

} // namespace

bool has_senses(const ForestDocument& document) {
    return document.squares == nullptr &&
           std::any_of(document.grown.sensed.begin(), document.grown.sensed.end(),
                       [](const auto& heroes) { return heroes != nullptr; });
}

bool NearestSensing::is_nearer(const Found& a, const Found& b) {
    return std::tie(a.square, a.tree.number) < std::tie(b.square, b.tree.number);
}

void NearestSensing::add(const Tree& tree) {
    if (stage_of(document_, tree) == nullptr) {
        return;
    }
    const double x = static_cast<double>(tree.position.x) - place_.x;
    const double z = static_cast<double>(tree.position.z) - place_.z;
    const Found found{x * x + z * z, tree};
    if (found_.size() == kMaxObstacleTrees) {
        if (!is_nearer(found, found_.front())) {
            return;
        }
        std::pop_heap(found_.begin(), found_.end(), is_nearer);
        found_.pop_back();
    }
    found_.push_back(found);
    std::push_heap(found_.begin(), found_.end(), is_nearer);
}

std::vector<Tree> NearestSensing::take() {
    std::sort_heap(found_.begin(), found_.end(), is_nearer);
    std::vector<Tree> trees;
    for (const Found& found : std::exchange(found_, {})) {
        trees.push_back(found.tree);
    }
    return trees;
}

SenseDrawing make_forest_sense_drawing(const ForestDocument& document,
                                       const std::vector<Tree>& trees,
                                       const SenseLook& look,
                                       const SpeciesMoves& moves) {
    SenseDrawing drawing;
    SenseLook nearest_look = look;
    nearest_look.obstacles = false;
    if (!trees.empty() && nearest_look != SenseLook{false, false, false, false}) {
        const Tree& tree = trees.front();
        if (const SensedPlant* const plant = plant_of(document, tree)) {
            append(make_sense_drawing(*plant, nearest_look, {}, stage_of(document, tree)->bounds),
                   tree, drawing);
        }
    }
    const SenseLook obstacles{look.obstacles, false, false, false};
    for (const Tree& tree : trees) {
        const SensedStage& stage = *stage_of(document, tree);
        append(make_sense_drawing(stage.heroes.front(), obstacles, moves_of(moves, tree),
                                  stage.bounds),
               tree, drawing);
    }
    return drawing;
}

SenseDrawing
forest_sense_drawing(const ForestDocument& document, const SenseLook& look, const Camera& camera) {
    if (!has_senses(document)) {
        return {};
    }
    NearestSensing nearest(document, camera.origin + glm::dvec3(camera.target));
    for (const Tree& tree : document.grown.forest.trees) {
        nearest.add(tree);
    }
    return make_forest_sense_drawing(document, nearest.take(), look, {});
}

std::optional<ForestObstacleHit> first_forest_obstacle(const ForestDocument& document,
                                                       const std::vector<Tree>& trees,
                                                       const SpeciesMoves& moves,
                                                       const Ray& ray) {
    std::optional<ForestObstacleHit> first;
    for (const Tree& tree : trees) {
        const SensedStage& stage = *stage_of(document, tree);
        const BranchInstance pose = root_of(tree);
        const glm::dquat back = glm::conjugate(glm::dquat(pose.rotation));
        const double scale = static_cast<double>(pose.scale);
        const Ray hero_ray{back * (ray.origin - glm::dvec3(pose.position)) / scale,
                           back * ray.direction / scale};
        std::optional<ObstacleHit> hit =
            first_obstacle(stage.heroes.front(), moves_of(moves, tree), stage.bounds, hero_ray);
        if (hit && (!first || hit->distance < first->obstacle.distance)) {
            first = ForestObstacleHit{std::move(*hit), tree};
        }
    }
    return first;
}

glm::dvec3
in_sensing_metres(const ForestDocument& document, const Tree& tree, const glm::dvec3& vector) {
    const BranchInstance pose = root_of(tree);
    const SensedStage* const stage = stage_of(document, tree);
    const double scale =
        static_cast<double>(pose.scale) * (stage == nullptr ? 1.0 : stage->heroes.front().scale);
    return glm::conjugate(glm::dquat(pose.rotation)) * vector / scale;
}

} // namespace lsys::view
