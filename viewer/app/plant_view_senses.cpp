// SPDX-License-Identifier: MIT
// PlantView: the drawing of what its plant senses, and the obstacles that the mouse moves.
#include "viewer/app/plant_view.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace lsys::view {

const SensedPlant* PlantView::sensed() const {
    return shows_growth_          ? grown_.sensed.get()
           : document_ == nullptr ? nullptr
                                  : document_->plant.sensed.get();
}

/// Displacements of environments that the user has made since the shown plant grew.
std::vector<EnvironmentMove> PlantView::new_moves() const {
    std::vector<EnvironmentMove> moves = settings.moves;
    const std::vector<EnvironmentMove>& grown_with =
        shows_growth_ ? grown_.moves : shown_outcome_.options.grammar.moves;
    for (const EnvironmentMove& old : grown_with) {
        std::array<float, 3> by = move_of(moves, old.name);
        for (std::size_t axis = 0; axis < by.size(); ++axis) {
            by[axis] -= old.by[axis];
        }
        set_move(old.name, by, moves);
    }
    return moves;
}

void PlantView::show_senses() {
    shown_senses_ = settings.senses;
    shown_moves_ = settings.moves;
    const SensedPlant* const plant = sensed();
    renderer_->show_senses(plant == nullptr ? SenseDrawing{}
                                            : make_sense_drawing(*plant, settings.senses,
                                                                 new_moves(), renderer_->bounds()));
    changed_ = true;
}

bool PlantView::grab_obstacle(const glm::vec2& place) {
    grabbed_.reset();
    const SensedPlant* const plant = sensed();
    if (plant == nullptr || !settings.senses.obstacles) {
        return false;
    }
    const glm::dvec3 direction(direction_at(settings.camera, place.x, place.y));
    std::optional<ObstacleHit> hit = first_obstacle(*plant, new_moves(), renderer_->bounds(),
                                                    {eye_of(settings.camera), direction});
    if (!hit) {
        return false;
    }
    GrabbedObstacle grabbed;
    grabbed.move = move_of(settings.moves, hit->name);
    grabbed.depth = hit->distance;
    grabbed.place = hit->distance * direction;
    grabbed.name = std::move(hit->name);
    grabbed_ = std::move(grabbed);
    return true;
}

void PlantView::drag_obstacle(const glm::vec2& place) {
    const SensedPlant* const plant = sensed();
    if (!grabbed_ || plant == nullptr) {
        return;
    }
    const glm::dvec3 now =
        grabbed_->depth * glm::dvec3(direction_at(settings.camera, place.x, place.y));
    std::array<float, 3> move = grabbed_->move;
    for (std::size_t axis = 0; axis < move.size(); ++axis) {
        const auto at = static_cast<int>(axis);
        move[axis] += static_cast<float>((now[at] - grabbed_->place[at]) / plant->scale);
        if (!std::isfinite(move[axis])) {
            return;
        }
    }
    set_move(grabbed_->name, move, settings.moves);
}

} // namespace lsys::view
