// Painter: a forest that is changed by hand: trees are put under a brush or taken away, undone and
// redone. What it costs grows with the trees that change, not with the forest.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/forest/tree.h"
#include "runtime/scene/painting.h"
#include "runtime/terrain/region.h"
#include "runtime/terrain/terrain.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lsys::view {

struct Brush {
    float radius = 5.0F;   // m
    float density = 0.05F; // trees a square metre that it fills up to
    std::uint16_t species = 0;
    float least_scale = 0.8F;
    float greatest_scale = 1.2F;
};

/// A tree that came or went.
struct TreeChange {
    std::uint32_t index = 0; // of Painter::tree()
    bool alive = false;
};

class Painter {
public:
    /// `placed` and `terrain` outlive the painter, or what move_to() was called for, and do not
    /// change. `painting` is what was painted before: those of its erased trees that are in
    /// `placed` are not alive. `key` is the forest's.
    Painter(std::span<const Tree> placed,
            const Painting& painting,
            const Region& region,
            const Terrain& terrain,
            std::uint64_t key);
    /// The same trees on the same ground, which lie elsewhere from now on. False: they are others,
    /// and nothing has happened.
    [[nodiscard]] bool move_to(std::span<const Tree> placed, const Terrain& terrain);

    /// Placed trees first, then all that were ever painted.
    [[nodiscard]] std::uint32_t tree_count() const {
        return static_cast<std::uint32_t>(placed_.size() + painted_.size());
    }
    [[nodiscard]] const Tree& tree(std::uint32_t index) const {
        return index < placed_.size() ? placed_[index] : painted_[index - placed_.size()];
    }
    [[nodiscard]] bool is_alive(std::uint32_t index) const {
        return (index < placed_.size() ? placed_alive_[index]
                                       : painted_alive_[index - placed_.size()]) != 0;
    }
    [[nodiscard]] std::uint64_t alive_count() const { return alive_count_; }

    /// What follows is undone at once, until the next stroke.
    void begin_stroke();
    /// Puts trees under the brush, none nearer to another than its density asks for, none beyond
    /// the region. The changes are good until the next call of the painter.
    std::span<const TreeChange> paint(float x, float z, const Brush& brush);
    /// Puts one tree at a place, of the brush's species and scales, unless one stands there or it
    /// is beyond the region.
    std::span<const TreeChange> plant(float x, float z, const Brush& brush);
    /// Takes all trees under the brush away.
    std::span<const TreeChange> erase(float x, float z, float radius);

    [[nodiscard]] bool can_undo() const { return done_ != 0; }
    [[nodiscard]] bool can_redo() const { return done_ != strokes_.size(); }
    /// Of the last stroke; nothing if there is none.
    std::span<const TreeChange> undo();
    std::span<const TreeChange> redo();

    /// For a scene file.
    [[nodiscard]] Painting painting() const;
    /// Whether it is another one than at the last call of saved(), or at the start.
    [[nodiscard]] bool is_changed() const { return done_ != saved_; }
    void saved() { saved_ = done_; }
    /// What was painted before is in no file.
    void set_unsaved() { saved_ = kNone; }

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    /// Changes from `first` on, up to those of the next stroke.
    struct Stroke {
        std::size_t first = 0;
    };

    [[nodiscard]] std::uint32_t cell_of(float x, float z) const;
    template <typename Visit>
    bool any_near(float x, float z, float radius, const Visit& visit) const;
    void add(const PaintedTree& paint);
    void set_alive(std::uint32_t index, bool alive);
    void record(std::uint32_t index, bool alive);
    void forget_undone();
    [[nodiscard]] std::size_t end_of(std::size_t stroke) const {
        return stroke + 1 < strokes_.size() ? strokes_[stroke + 1].first : log_.size();
    }

    std::span<const Tree> placed_;
    const Region region_;
    const Terrain* terrain_;
    std::uint64_t key_;
    LargeVector<Tree> painted_;
    std::vector<PaintedTree> paints_; // as they were painted, beside painted_
    LargeVector<std::uint8_t> placed_alive_;
    LargeVector<std::uint8_t> painted_alive_;
    std::uint64_t alive_count_ = 0;
    std::vector<std::uint32_t> erased_before_; // numbers that are not in `placed`
    std::uint64_t draws_ = 0;                  // positions of random numbers that were used

    // Trees by squares of the ground: the placed ones in a row, the painted ones linked.
    float cell_ = 1.0F; // m
    std::uint32_t columns_ = 1;
    std::uint32_t rows_ = 1;
    LargeVector<std::uint32_t> first_; // of each square, in items_
    LargeVector<std::uint32_t> items_;
    LargeVector<std::uint32_t> head_; // of each square, in painted_
    LargeVector<std::uint32_t> next_; // of each painted tree

    std::vector<TreeChange> log_;
    std::vector<Stroke> strokes_;
    std::size_t done_ = 0;  // strokes that are in force
    std::size_t saved_ = 0; // of them when it was saved; kNone: nothing here is what was saved
    std::vector<TreeChange> changes_;
};

} // namespace lsys::view
