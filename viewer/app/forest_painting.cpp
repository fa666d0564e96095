// SPDX-License-Identifier: MIT
#include "viewer/app/forest_painting.h"

#include "runtime/program/files.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lsys::view {

namespace {

constexpr double kPickCell = 1.0;    // m, side of a HeightField cell on grounds of 16 to 1024 m
constexpr double kMaxCells = 1024.0; // along a side of the height field
constexpr float kStep = 0.5F;        // distance between places of a stroke, in radii of the brush
constexpr std::uint32_t kMaxSteps = 256; // max number of places per motion of the pointer

std::vector<std::string> names_of(const Scene& scene) {
    std::vector<std::string> names;
    for (const SceneSpecies& species : scene.species) {
        names.push_back(species.name);
    }
    return names;
}

bool is_same_ground(const SceneTerrain& a, const SceneTerrain& b) {
    // Two height maps never count as equal, because the file of a map may have changed.
    return a.kind == b.kind && a.kind != TerrainKind::HeightMap && a.region == b.region &&
           a.base == b.base && a.noise == b.noise;
}

std::uint32_t cells_along(double size) {
    return static_cast<std::uint32_t>(std::clamp(size / kPickCell, 16.0, kMaxCells));
}

/// Refines `found`, where the ray meets a height field, to the point where it meets the terrain.
glm::dvec3 refined(const Ray& ray, const glm::dvec3& found, double reach, const Terrain& terrain) {
    const double length = glm::length(ray.direction);
    const double middle = glm::dot(found - ray.origin, ray.direction) / (length * length);
    const auto place = [&](double t) { return ray.origin + t * ray.direction; };
    const auto above = [&](double t) {
        const glm::dvec3 at = place(t);
        return at.y - static_cast<double>(
                          terrain.height(static_cast<float>(at.x), static_cast<float>(at.z)));
    };
    double low = std::max(middle - reach / length, 0.0);
    double high = middle + reach / length;
    if (above(low) > 0.0 && above(high) <= 0.0) {
        for (int i = 0; i < 40; ++i) {
            const double between = 0.5 * (low + high);
            (above(between) > 0.0 ? low : high) = between;
        }
        return place(high);
    }
    return found;
}

} // namespace

Painter& ForestPainting::painter() {
    if (!painter_) {
        const Scene& scene = document_->scene;
        names_ = names_of(scene);
        painter_.emplace(document_->grown.forest.trees, in_file_.value_or(Painting{}),
                         scene.placement.region, *document_->grown.terrain,
                         document_->grown.forest.key);
    }
    return *painter_;
}

/// The painting with the species numbers of document_; species are matched by name. Drops trees of
/// species that document_ does not have.
Painting ForestPainting::renamed(const Painting& painting) const {
    const std::vector<std::string> names = names_of(document_->scene);
    Painting result{{}, painting.erased};
    for (PaintedTree tree : painting.trees) {
        const auto at = std::find(names.begin(), names.end(), names_[tree.species]);
        if (at != names.end()) {
            tree.species = static_cast<std::uint16_t>(at - names.begin());
            result.trees.push_back(tree);
        }
    }
    return result;
}

std::string ForestPainting::set_document(std::shared_ptr<const ForestDocument> document) {
    const std::shared_ptr<const ForestDocument> before = std::exchange(document_, document);
    if (!before || !is_same_ground(before->scene.terrain, document->scene.terrain)) {
        ground_.reset();
    }
    last_.reset();
    const Painting& read = document->scene.painting;
    const bool is_other_file = in_file_ && *in_file_ != read;
    in_file_ = read;
    std::string note;
    const GrownForest& grown = document->grown;
    const bool same_names = painter_ && names_ == names_of(document->scene);
    if (painter_ && painter_->is_changed()) {
        if (is_other_file) {
            note = "the painting in the file has changed; your painting stays, and Ctrl+S replaces "
                   "the one in the file";
        }
        if (!same_names || !painter_->move_to(grown.forest.trees, *grown.terrain)) {
            const Painting kept = painter_->painting();
            const Painting wanted = renamed(kept);
            if (wanted.trees.size() != kept.trees.size()) {
                note = "painted trees of species that no longer exist are removed";
            }
            painter_.reset();
            in_file_ = wanted;
            painter().set_unsaved();
            in_file_ = read;
        }
    } else if (is_other_file || !same_names ||
               !painter_->move_to(grown.forest.trees, *grown.terrain)) {
        painter_.reset();
        if (!read.empty()) {
            static_cast<void>(painter());
        }
    }
    show_all();
    return note;
}

void ForestPainting::show_all() {
    painted_ = 0;
    if (!painter_) {
        return;
    }
    const auto placed = static_cast<std::uint32_t>(document_->grown.forest.trees.size());
    std::vector<TreeChange> changes;
    for (std::uint32_t i = 0; i < painter_->tree_count(); ++i) {
        const bool alive = painter_->is_alive(i);
        if (alive != (i < placed)) {
            renderer_->change_tree(i, painter_->tree(i), alive);
            changes.push_back({i, alive});
        }
        painted_ += alive && i >= placed ? 1U : 0U;
    }
    show_surroundings(changes);
}

/// Shows the trees around changed ones with their new surroundings.
void ForestPainting::show_surroundings(std::span<const TreeChange> changes) {
    for (const std::uint32_t index : painter_->sense_around(changes, document_->grown.forest)) {
        renderer_->change_tree(index, painter_->tree(index), true);
    }
}

std::optional<glm::dvec3> ForestPainting::pick(const Ray& ray) {
    if (!document_) {
        return std::nullopt;
    }
    const Terrain& terrain = *document_->grown.terrain;
    const Region& region = terrain.region();
    if (!ground_) {
        ground_.emplace(terrain, cells_along(region.width), cells_along(region.depth));
    }
    const std::optional<glm::dvec3> found = ground_->pick(ray);
    if (!found) {
        return std::nullopt;
    }
    const double cell = std::max(region.width / ground_->columns(), region.depth / ground_->rows());
    return refined(ray, *found, 4.0 * cell, terrain);
}

void ForestPainting::move_tool(const glm::dvec3& place,
                               bool begins,
                               PaintTool tool,
                               const Brush& brush) {
    if (!document_ || tool == PaintTool::None) {
        return;
    }
    if (begins) {
        painter().begin_stroke();
        count_ = {};
        last_.reset();
    }
    const auto x = static_cast<float>(place.x);
    const auto z = static_cast<float>(place.z);
    if (!last_) {
        last_ = place;
        apply_at(x, z, tool, brush);
        return;
    }
    const glm::vec2 from(static_cast<float>(last_->x), static_cast<float>(last_->z));
    const float way = glm::distance(from, glm::vec2(x, z));
    const float step = std::max(kStep * brush.radius, 0.1F);
    if (tool == PaintTool::OneTree || way < step) {
        // PaintTool::OneTree plants only when the button is pressed; a brush has already covered
        // this place.
        return;
    }
    const std::uint32_t steps =
        std::min(static_cast<std::uint32_t>(std::min(way / step, 1e6F)), kMaxSteps);
    for (std::uint32_t i = 1; i <= steps; ++i) {
        const float part = static_cast<float>(i) / static_cast<float>(steps);
        apply_at(from.x + part * (x - from.x), from.y + part * (z - from.y), tool, brush);
    }
    last_ = place;
}

void ForestPainting::apply_at(float x, float z, PaintTool tool, const Brush& brush) {
    switch (tool) {
    case PaintTool::None:
        return;
    case PaintTool::Brush:
        show(painter().paint(x, z, brush));
        return;
    case PaintTool::OneTree:
        show(painter().plant(x, z, brush));
        return;
    case PaintTool::Eraser:
        show(painter().erase(x, z, brush.radius));
        return;
    }
}

void ForestPainting::show(std::span<const TreeChange> changes) {
    const auto placed = static_cast<std::uint32_t>(document_->grown.forest.trees.size());
    for (const TreeChange& change : changes) {
        renderer_->change_tree(change.index, painter_->tree(change.index), change.alive);
        ++(change.alive ? count_.added : count_.removed);
        if (change.index >= placed) {
            painted_ += change.alive ? 1 : ~std::uint64_t{0};
        }
    }
    show_surroundings(changes);
}

void ForestPainting::undo() {
    count_ = {};
    if (painter_) {
        show(painter_->undo());
    }
}

void ForestPainting::redo() {
    count_ = {};
    if (painter_) {
        show(painter_->redo());
    }
}

std::uint64_t ForestPainting::tree_count() const {
    if (painter_) {
        return painter_->alive_count();
    }
    return document_ ? document_->grown.forest.trees.size() : 0;
}

Result<void> ForestPainting::save(const std::string& file, const Console& console) {
    if (!painter_) {
        return {}; // nothing changed
    }
    Result<std::string> before = read_file(file, {kMaxSourceBytes}, console);
    if (!before) {
        return before.error();
    }
    Painting painting = painter_->painting();
    Result<std::string> text = with_painting(before.value(), painting, names_);
    if (!text) {
        return text.error();
    }
    if (Result<void> written = write_file(file, text.value(), console); !written) {
        return written;
    }
    saved_text_ = std::move(text.value());
    in_file_ = std::move(painting);
    painter_->mark_saved();
    return {};
}

std::vector<LineVertex>
ForestPainting::outline(const glm::dvec3& place, float radius, bool erases) const {
    constexpr std::uint32_t kCorners = 64;
    constexpr std::array<std::uint8_t, 4> kPaintColour = {255, 240, 120, 255};
    constexpr std::array<std::uint8_t, 4> kEraseColour = {255, 110, 90, 255};
    std::vector<LineVertex> lines;
    const Terrain& terrain = *document_->grown.terrain;
    const float shown_radius = std::max(radius, 0.25F);
    const auto corner = [&](std::uint32_t i) {
        const float angle =
            2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(kCorners);
        const float x = static_cast<float>(place.x) + shown_radius * std::cos(angle);
        const float z = static_cast<float>(place.z) + shown_radius * std::sin(angle);
        return glm::vec3(x, terrain.height(x, z) + 0.02F * shown_radius, z);
    };
    for (std::uint32_t i = 0; i < kCorners; ++i) {
        lines.push_back({corner(i), erases ? kEraseColour : kPaintColour});
        lines.push_back({corner(i + 1), erases ? kEraseColour : kPaintColour});
    }
    return lines;
}

} // namespace lsys::view
