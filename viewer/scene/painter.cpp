// SPDX-License-Identifier: MIT
#include "viewer/scene/painter.h"

#include "runtime/base/random.h"
#include "runtime/forest/surroundings.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace lsys::view {

namespace {

constexpr std::uint32_t kMaxCells = std::uint32_t{1} << 22; // max number of squares
// Generation in the counter of Philox for painted trees; no placement draws with this number.
constexpr std::uint32_t kPaintGeneration = 0x5041494EU;
// Number of random places that are tried per tree that still fits into the brush.
constexpr double kTries = 4.0;
// Max number of random places that are tried per call.
constexpr double kMaxTries = 20'000.0;
// Max density * d^2 of trees that are placed at random, at least d apart. The jamming limit of
// discs is 0.547 of the area (Feder 1980), and 0.547 * 4 / pi = 0.696.
constexpr float kJammed = 0.696F;

} // namespace

Painter::Painter(std::span<const Tree> placed,
                 const Painting& painting,
                 const Region& region,
                 const Terrain& terrain,
                 std::uint64_t key)
    : placed_(placed), region_(region), terrain_(&terrain), key_(key) {
    // Makes about one square per two trees.
    const double wanted = std::clamp(static_cast<double>(placed.size()) / 2.0, 1024.0,
                                     static_cast<double>(kMaxCells) / 2.0);
    cell_ = static_cast<float>(std::sqrt(region.area() / wanted));
    columns_ = static_cast<std::uint32_t>(region.width / static_cast<double>(cell_)) + 1;
    rows_ = static_cast<std::uint32_t>(region.depth / static_cast<double>(cell_)) + 1;
    const std::size_t cells = std::size_t{columns_} * rows_;
    first_.assign(cells + 1, 0);
    for (const Tree& tree : placed) {
        ++first_[cell_of(tree.position.x, tree.position.z) + 1];
        max_scale_ = std::max(max_scale_, tree.scale);
    }
    for (std::size_t i = 0; i < cells; ++i) {
        first_[i + 1] += first_[i];
    }
    items_.resize(placed.size());
    LargeVector<std::uint32_t> ends(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < placed.size(); ++i) {
        items_[ends[cell_of(placed[i].position.x, placed[i].position.z)]++] = i;
    }
    head_.assign(cells, kNone);
    placed_alive_.assign(placed.size(), 1);
    alive_count_ = placed.size();
    if (!painting.erased.empty()) {
        std::vector<std::uint8_t> found(painting.erased.size());
        for (std::uint32_t i = 0; i < placed.size(); ++i) {
            const auto at =
                std::lower_bound(painting.erased.begin(), painting.erased.end(), placed[i].number);
            if (at != painting.erased.end() && *at == placed[i].number) {
                set_alive(i, false);
                found[static_cast<std::size_t>(at - painting.erased.begin())] = 1;
            }
        }
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (found[i] == 0) {
                erased_before_.push_back(painting.erased[i]);
            }
        }
    }
    for (const PaintedTree& tree : painting.trees) {
        add(tree);
        set_alive(tree_count() - 1, true);
    }
}

bool Painter::move_to(std::span<const Tree> placed, const Terrain& terrain) {
    const bool is_unchanged =
        std::equal(placed.begin(), placed.end(), placed_.begin(), placed_.end(),
                   [](const Tree& a, const Tree& b) {
                       return a.position == b.position && a.yaw == b.yaw && a.scale == b.scale &&
                              a.number == b.number && a.species == b.species && a.age == b.age;
                   }) &&
        std::all_of(painted_.begin(), painted_.end(), [&](const Tree& tree) {
            return terrain.height(tree.position.x, tree.position.z) == tree.position.y;
        });
    if (is_unchanged) {
        placed_ = placed;
        terrain_ = &terrain;
        turned_.clear();
    }
    return is_unchanged;
}

std::uint32_t Painter::cell_of(float x, float z) const {
    const auto index = [&](double at, std::uint32_t count) {
        return static_cast<std::uint32_t>(
            std::clamp(at / static_cast<double>(cell_), 0.0, static_cast<double>(count - 1)));
    };
    return index(static_cast<double>(z) - region_.z, rows_) * columns_ +
           index(static_cast<double>(x) - region_.x, columns_);
}

/// Calls `visit(index)` for living trees nearer than `radius` to (x, z), until `visit` returns
/// true. Returns whether it returned true.
template <typename Visit>
bool Painter::any_near(float x, float z, float radius, const Visit& visit) const {
    const std::uint32_t low = cell_of(x - radius, z - radius);
    const std::uint32_t high = cell_of(x + radius, z + radius);
    const float square = radius * radius;
    const auto ask = [&](std::uint32_t index) {
        const glm::vec3& at = tree(index).position;
        const float dx = at.x - x;
        const float dz = at.z - z;
        return is_alive(index) && dx * dx + dz * dz < square && visit(index);
    };
    for (std::uint32_t row = low / columns_; row <= high / columns_; ++row) {
        for (std::uint32_t column = low % columns_; column <= high % columns_; ++column) {
            const std::size_t cell = std::size_t{row} * columns_ + column;
            for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
                if (ask(items_[i])) {
                    return true;
                }
            }
            for (std::uint32_t i = head_[cell]; i != kNone; i = next_[i]) {
                if (ask(static_cast<std::uint32_t>(placed_.size()) + i)) {
                    return true;
                }
            }
        }
    }
    return false;
}

void Painter::turn(std::uint32_t index, const Tree& tree) {
    if (index < placed_.size()) {
        turned_[index] = tree;
    } else {
        painted_[index - placed_.size()] = tree;
    }
}

std::span<const std::uint32_t> Painter::sense_around(std::span<const TreeChange> changes,
                                                     const Forest& kinds) {
    sensed_.clear();
    if (changes.empty() || !has_sensed_surroundings(kinds)) {
        return sensed_;
    }
    const std::vector<double> scales(kinds.species.size(), static_cast<double>(max_scale_));
    // One centimetre is added, because any_near() excludes trees at the distance `radius`.
    const auto reach = static_cast<float>(reach_of_surroundings(kinds, scales)) + 0.01F;
    std::vector<std::uint32_t> affected;
    std::vector<std::uint32_t> around; // affected trees and their neighbours
    const auto collect_near = [&](std::uint32_t index, std::vector<std::uint32_t>& found) {
        const glm::vec3& at = tree(index).position;
        any_near(at.x, at.z, reach, [&](std::uint32_t near) {
            found.push_back(near);
            return false;
        });
    };
    const auto make_unique = [](std::vector<std::uint32_t>& indices) {
        std::sort(indices.begin(), indices.end());
        indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    };
    for (const TreeChange& change : changes) {
        collect_near(change.index, affected);
    }
    make_unique(affected);
    for (const std::uint32_t index : affected) {
        collect_near(index, around);
    }
    make_unique(around);
    std::vector<Tree> neighbours;
    for (const std::uint32_t index : around) {
        neighbours.push_back(tree(index));
    }
    std::vector<Tree> trees;
    for (const std::uint32_t index : affected) {
        trees.push_back(tree(index));
    }
    sense_surroundings(kinds, neighbours, trees, 1);
    for (std::size_t i = 0; i < trees.size(); ++i) {
        if (std::bit_cast<std::uint32_t>(trees[i].yaw) !=
            std::bit_cast<std::uint32_t>(tree(affected[i]).yaw)) {
            turn(affected[i], trees[i]);
            sensed_.push_back(affected[i]);
        }
    }
    return sensed_;
}

void Painter::set_alive(std::uint32_t index, bool alive) {
    (index < placed_.size() ? placed_alive_[index] : painted_alive_[index - placed_.size()]) =
        alive ? 1 : 0;
    alive_count_ += alive ? 1U : ~std::uint64_t{0};
}

void Painter::record(std::uint32_t index, bool alive) {
    set_alive(index, alive);
    log_.push_back({index, alive});
    last_changes_.push_back(log_.back());
}

/// Adds a painted tree that no stroke has added yet.
void Painter::add(const PaintedTree& paint) {
    const std::uint32_t cell = cell_of(paint.x, paint.z);
    paints_.push_back(paint);
    max_scale_ = std::max(max_scale_, paint.scale);
    painted_.push_back(painted_tree(paint, *terrain_));
    next_.push_back(head_[cell]);
    head_[cell] = static_cast<std::uint32_t>(painted_.size() - 1);
    painted_alive_.push_back(0);
}

/// Drops undone strokes, which redo() can then no longer repeat, and the trees that only these
/// strokes have added.
void Painter::forget_undone() {
    if (done_ == strokes_.size()) {
        return;
    }
    if (saved_ > done_) {
        saved_ = kNone;
    }
    const std::size_t first = strokes_[done_].first;
    std::size_t kept_count = painted_.size();
    for (std::size_t i = first; i < log_.size(); ++i) {
        if (log_[i].alive) { // the first entry of a painted tree adds it
            kept_count = std::min<std::size_t>(kept_count, log_[i].index - placed_.size());
        }
    }
    while (painted_.size() > kept_count) {
        const PaintedTree& last = paints_.back();
        head_[cell_of(last.x, last.z)] = next_.back();
        painted_.pop_back();
        paints_.pop_back();
        next_.pop_back();
        painted_alive_.pop_back();
    }
    log_.resize(first);
    strokes_.resize(done_);
}

void Painter::begin_stroke() {
    forget_undone();
    if (strokes_.empty() || strokes_.back().first != log_.size()) {
        strokes_.push_back({log_.size()});
    }
    done_ = strokes_.size();
}

std::span<const TreeChange> Painter::paint(float x, float z, const Brush& brush) {
    last_changes_.clear();
    if (done_ == 0 || done_ != strokes_.size()) {
        begin_stroke();
    }
    if (!(brush.radius > 0.0F && brush.density > 0.0F)) {
        return last_changes_;
    }
    const float spacing = std::sqrt(kJammed / brush.density);
    const double room = std::numbers::pi * static_cast<double>(brush.radius) *
                        static_cast<double>(brush.radius) * static_cast<double>(brush.density);
    const auto tries = static_cast<std::uint32_t>(std::clamp(kTries * room, 1.0, kMaxTries));
    for (std::uint32_t i = 0; i < tries; ++i) {
        const PhiloxBlock words = draw_block(key_, kPaintGeneration, draws_++, 0);
        const float angle = 2.0F * std::numbers::pi_v<float> * unit_interval(words[0]);
        const float away = brush.radius * std::sqrt(unit_interval(words[1]));
        PaintedTree paint;
        paint.species = brush.species;
        paint.x = x + away * std::cos(angle);
        paint.z = z + away * std::sin(angle);
        paint.yaw = 2.0F * std::numbers::pi_v<float> * unit_interval(words[2]);
        paint.scale =
            brush.min_scale + (brush.max_scale - brush.min_scale) * unit_interval(words[3]);
        if (!region_.contains(paint.x, paint.z) || painted_.size() == kMaxPainted ||
            any_near(paint.x, paint.z, spacing, [](std::uint32_t) { return true; })) {
            continue;
        }
        add(paint);
        record(tree_count() - 1, true);
    }
    return last_changes_;
}

std::span<const TreeChange> Painter::plant(float x, float z, const Brush& brush) {
    last_changes_.clear();
    if (done_ == 0 || done_ != strokes_.size()) {
        begin_stroke();
    }
    constexpr float kSamePlace = 0.05F; // m
    if (!region_.contains(x, z) || painted_.size() == kMaxPainted ||
        any_near(x, z, kSamePlace, [](std::uint32_t) { return true; })) {
        return last_changes_;
    }
    const PhiloxBlock words = draw_block(key_, kPaintGeneration, draws_++, 0);
    PaintedTree paint;
    paint.species = brush.species;
    paint.x = x;
    paint.z = z;
    paint.yaw = 2.0F * std::numbers::pi_v<float> * unit_interval(words[2]);
    paint.scale = brush.min_scale + (brush.max_scale - brush.min_scale) * unit_interval(words[3]);
    add(paint);
    record(tree_count() - 1, true);
    return last_changes_;
}

std::span<const TreeChange> Painter::erase(float x, float z, float radius) {
    last_changes_.clear();
    if (done_ == 0 || done_ != strokes_.size()) {
        begin_stroke();
    }
    std::vector<std::uint32_t> gone;
    any_near(x, z, radius, [&gone](std::uint32_t index) {
        gone.push_back(index);
        return false;
    });
    for (const std::uint32_t index : gone) {
        record(index, false);
    }
    return last_changes_;
}

std::span<const TreeChange> Painter::undo() {
    last_changes_.clear();
    if (can_undo()) {
        --done_;
        for (std::size_t i = end_of(done_); i-- > strokes_[done_].first;) {
            set_alive(log_[i].index, !log_[i].alive);
            last_changes_.push_back({log_[i].index, !log_[i].alive});
        }
    }
    return last_changes_;
}

std::span<const TreeChange> Painter::redo() {
    last_changes_.clear();
    if (can_redo()) {
        for (std::size_t i = strokes_[done_].first; i < end_of(done_); ++i) {
            set_alive(log_[i].index, log_[i].alive);
            last_changes_.push_back(log_[i]);
        }
        ++done_;
    }
    return last_changes_;
}

Painting Painter::painting() const {
    Painting result;
    result.erased = erased_before_;
    for (std::size_t i = 0; i < placed_.size(); ++i) {
        if (placed_alive_[i] == 0) {
            result.erased.push_back(placed_[i].number);
        }
    }
    std::sort(result.erased.begin(), result.erased.end());
    for (std::size_t i = 0; i < paints_.size(); ++i) {
        if (painted_alive_[i] != 0) {
            result.trees.push_back(paints_[i]);
        }
    }
    return result;
}

} // namespace lsys::view
