// SPDX-License-Identifier: MIT
// What the trees of a ForestView sense: their drawing, and obstacles that the mouse moves.
#include "viewer/app/forest_view.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsys::view {

/// Displacements of environments since the forest shown has grown.
SpeciesMoves ForestView::new_moves() const {
    SpeciesMoves moves;
    for (const SceneSpecies& species : document_->scene.species) {
        const auto moves_in = [&](const SceneOverrides& edits) {
            const auto found = edits.species.find(species.name);
            return found == edits.species.end() ? std::vector<EnvironmentMove>{}
                                                : found->second.moves;
        };
        std::vector<EnvironmentMove>& species_moves = moves.emplace_back(moves_in(settings.edits));
        for (const EnvironmentMove& old : moves_in(shown_edits_)) {
            std::array<float, 3> by = move_of(species_moves, old.name);
            for (std::size_t axis = 0; axis < by.size(); ++axis) {
                by[axis] -= old.by[axis];
            }
            set_move(old.name, by, species_moves);
        }
    }
    return moves;
}

void ForestView::show_senses() {
    if (document_ == nullptr || !has_senses(*document_)) {
        if (shown_senses_) {
            shown_senses_.reset();
            renderer_->show_senses({});
            changed_ = true;
        }
        return;
    }
    ShownSenses now;
    now.look = settings.senses;
    now.moves = new_moves();
    now.content = {stats_.swaps, stats_.moments, painting_.tree_count(), steps_.size()};
    now.place = settings.camera.origin + glm::dvec3(settings.camera.target);
    if (shown_senses_ == now || (grabbed_ && shown_senses_ && shown_senses_->moves == now.moves)) {
        return;
    }
    const bool is_near =
        shown_senses_ && shown_senses_->content == now.content && shown_senses_->place == now.place;
    std::vector<Tree> trees = sensing_trees_;
    if (!is_near && !grabbed_) {
        NearestSensing nearest(*document_, now.place);
        painting_.for_each_tree([&nearest](const Tree& tree) { nearest.add(tree); });
        trees = nearest.take();
    }
    const auto is_same = [](const Tree& a, const Tree& b) {
        return a.number == b.number && a.position == b.position;
    };
    const bool is_same_drawing = shown_senses_ && shown_senses_->content == now.content &&
                                 shown_senses_->look == now.look &&
                                 shown_senses_->moves == now.moves &&
                                 std::equal(trees.begin(), trees.end(), sensing_trees_.begin(),
                                            sensing_trees_.end(), is_same);
    sensing_trees_ = std::move(trees);
    shown_senses_ = std::move(now);
    if (!is_same_drawing) {
        renderer_->show_senses(make_forest_sense_drawing(
            *document_, sensing_trees_, shown_senses_->look, shown_senses_->moves));
        changed_ = true;
    }
}

bool ForestView::grab_obstacle(const glm::vec2& place) {
    grabbed_.reset();
    if (document_ == nullptr || !has_senses(*document_) || !settings.senses.obstacles ||
        settings.tool != PaintTool::None) {
        return false;
    }
    const glm::dvec3 direction(direction_at(settings.camera, place.x, place.y));
    std::optional<ForestObstacleHit> hit = first_forest_obstacle(
        *document_, sensing_trees_, new_moves(), {eye_of(settings.camera), direction});
    if (!hit) {
        return false;
    }
    GrabbedObstacle grabbed;
    grabbed.species = document_->scene.species[hit->tree.species].name;
    grabbed.move = move_of(settings.edits.species[grabbed.species].moves, hit->obstacle.name);
    grabbed.depth = hit->obstacle.distance;
    grabbed.place = hit->obstacle.distance * direction;
    grabbed.name = std::move(hit->obstacle.name);
    grabbed.tree = hit->tree;
    grabbed_ = std::move(grabbed);
    return true;
}

void ForestView::drag_obstacle(const glm::vec2& place) {
    if (!grabbed_ || document_ == nullptr) {
        return;
    }
    const glm::dvec3 now =
        grabbed_->depth * glm::dvec3(direction_at(settings.camera, place.x, place.y));
    const glm::dvec3 by = in_sensing_metres(*document_, grabbed_->tree, now - grabbed_->place);
    std::array<float, 3> move = grabbed_->move;
    for (std::size_t axis = 0; axis < move.size(); ++axis) {
        move[axis] += static_cast<float>(by[static_cast<int>(axis)]);
        if (!std::isfinite(move[axis])) {
            return;
        }
    }
    set_move(grabbed_->name, move, settings.edits.species[grabbed_->species].moves);
}

} // namespace lsys::view
