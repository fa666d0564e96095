// SPDX-License-Identifier: MIT
// Painter: adds and removes trees by hand, with undo and redo. Time depends on the number of
// changed trees, not on the size of the forest.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/forest/forest.h"
#include "runtime/forest/tree.h"
#include "runtime/scene/painting.h"
#include "runtime/terrain/region.h"
#include "runtime/terrain/terrain.h"

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace lsys::view {

struct Brush {
    float radius = 5.0F;   // m
    float density = 0.05F; // max trees per square metre
    std::uint16_t species = 0;
    float min_scale = 0.8F;
    float max_scale = 1.2F;
};

/// A tree that was added or removed.
struct TreeChange {
    std::uint32_t index = 0; // index for Painter::tree()
    bool alive = false;      // whether the tree exists after the change
};

class Painter {
public:
    /// `placed` and `terrain` must stay valid and unchanged until the next move_to(), or as long as
    /// the painter. `painting`: earlier changes; the trees that it erases are removed at the start.
    /// `key`: key of the forest.
    Painter(std::span<const Tree> placed,
            const Painting& painting,
            const Region& region,
            const Terrain& terrain,
            std::uint64_t key);
    /// Continues with trees and ground that are equal, but stored elsewhere. Returns false, without
    /// any effect, if they are not equal.
    [[nodiscard]] bool move_to(std::span<const Tree> placed, const Terrain& terrain);

    /// Number of placed trees, which have the first indices, plus the number of all trees ever
    /// painted.
    [[nodiscard]] std::uint32_t tree_count() const {
        return static_cast<std::uint32_t>(placed_.size() + painted_.size());
    }
    [[nodiscard]] const Tree& tree(std::uint32_t index) const {
        if (index >= placed_.size()) {
            return painted_[index - placed_.size()];
        }
        const auto turned = turned_.empty() ? turned_.end() : turned_.find(index);
        return turned == turned_.end() ? placed_[index] : turned->second;
    }
    [[nodiscard]] bool is_alive(std::uint32_t index) const {
        return (index < placed_.size() ? placed_alive_[index]
                                       : painted_alive_[index - placed_.size()]) != 0;
    }
    [[nodiscard]] std::uint64_t alive_count() const { return alive_count_; }

    /// Begins a stroke; undo() takes back whole strokes.
    void begin_stroke();
    /// Adds trees within the brush and the region until the density of the brush is reached. Trees
    /// keep the min distance that the density implies. The result is valid until the next call.
    std::span<const TreeChange> paint(float x, float z, const Brush& brush);
    /// Adds one tree with the species and scales of the brush, unless there is a tree at the place,
    /// or the place is outside of the region.
    std::span<const TreeChange> plant(float x, float z, const Brush& brush);
    /// Removes all trees under the brush.
    std::span<const TreeChange> erase(float x, float z, float radius);

    [[nodiscard]] bool can_undo() const { return done_ != 0; }
    [[nodiscard]] bool can_redo() const { return done_ != strokes_.size(); }
    /// Undoes the last stroke; does nothing if there is none.
    std::span<const TreeChange> undo();
    std::span<const TreeChange> redo();

    /// Senses the surroundings of the living trees around the changed trees again. Returns the
    /// indices of the trees that have got new surroundings or another yaw. `kinds`: forest with the
    /// species of the trees. The result is valid until the next call.
    std::span<const std::uint32_t> sense_around(std::span<const TreeChange> changes,
                                                const Forest& kinds);

    /// All changes, in the form that a scene file stores.
    [[nodiscard]] Painting painting() const;
    /// Whether painting() differs from its value at the last mark_saved() or, without one, at the
    /// start.
    [[nodiscard]] bool is_changed() const { return done_ != saved_; }
    /// Marks painting() as saved.
    void mark_saved() { saved_ = done_; }
    /// Marks the painting with which the painter was made as not saved.
    void set_unsaved() { saved_ = kNone; }

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    /// Entries of a stroke: from index `first` up to the first entry of the next stroke.
    struct Stroke {
        std::size_t first = 0;
    };

    [[nodiscard]] std::uint32_t cell_of(float x, float z) const;
    void turn(std::uint32_t index, const Tree& tree); // replaces a tree by one with another yaw
    /// Calls visit(index) for living trees near a place until it returns true; returns whether it
    /// did.
    template <typename Visit>
    bool any_near(float x, float z, float radius, const Visit& visit) const;
    void add(const PaintedTree& paint);              // a painted tree, which does not live yet
    void set_alive(std::uint32_t index, bool alive); // without a record in the stroke
    void record(std::uint32_t index, bool alive);    // set_alive() as a part of the stroke
    void forget_undone();                            // undone strokes can no longer be redone
    [[nodiscard]] std::size_t end_of(std::size_t stroke) const {
        return stroke + 1 < strokes_.size() ? strokes_[stroke + 1].first : log_.size();
    }

    std::span<const Tree> placed_;
    const Region region_;
    const Terrain* terrain_;
    std::uint64_t key_;                    // of the forest
    std::map<std::uint32_t, Tree> turned_; // placed trees whose surroundings have changed
    LargeVector<Tree> painted_;
    std::vector<PaintedTree> paints_;         // parallel to painted_
    LargeVector<std::uint8_t> placed_alive_;  // by placed tree
    LargeVector<std::uint8_t> painted_alive_; // by painted tree
    std::uint64_t alive_count_ = 0;
    float max_scale_ = 0.0F; // of all trees, including removed ones
    // Numbers in `erased` of the painting that no placed tree has; kept, to be saved again.
    std::vector<std::uint32_t> erased_before_;
    std::uint64_t draws_ = 0; // count of random numbers used

    // Trees by square of the ground: placed trees in ranges, painted trees in linked lists.
    float cell_ = 1.0F; // m, side of a square
    std::uint32_t columns_ = 1;
    std::uint32_t rows_ = 1;
    LargeVector<std::uint32_t> first_; // by square: index in items_
    LargeVector<std::uint32_t> items_; // indices of placed trees, by square
    LargeVector<std::uint32_t> head_;  // by square: first painted tree, index in painted_
    LargeVector<std::uint32_t> next_;  // by painted tree: the next painted tree of its square

    std::vector<TreeChange> log_; // changes of all strokes, undone ones included
    std::vector<Stroke> strokes_;
    std::size_t done_ = 0;                 // number of strokes that are not undone
    std::size_t saved_ = 0;                // done_ when last saved; kNone: that state cannot return
    std::vector<TreeChange> last_changes_; // result of the last change
    std::vector<std::uint32_t> sensed_;    // result of sense_around()
};

} // namespace lsys::view
