// SPDX-License-Identifier: MIT
#include "runtime/turtle/impl/correspondence.h"

#include "grammar/base/contract.h"
#include "runtime/turtle/organs.h"

#include <algorithm>
#include <cstddef>

namespace lsys {

namespace {

/// Lists of items, one per module of the earlier word, in the order of drawing.
class ItemsByModule {
public:
    /// module_of(i): the module of item i, at most `modules` - 1.
    template <typename ModuleOf>
    ItemsByModule(std::size_t items, std::size_t modules, const ModuleOf& module_of)
        : first_(modules + 1, 0), items_(items) {
        for (std::size_t i = 0; i < items; ++i) {
            ++first_[module_of(i) + 1];
        }
        for (std::size_t i = 1; i < first_.size(); ++i) {
            first_[i] += first_[i - 1];
        }
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t i = 0; i < items; ++i) {
            items_[next[module_of(i)]++] = static_cast<std::uint32_t>(i);
        }
    }

    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t module) const {
        return std::span(items_).subspan(first_[module], first_[module + 1] - first_[module]);
    }

private:
    std::vector<std::uint32_t> first_; // by module: index in items_; last: its size
    std::vector<std::uint32_t> items_; // module by module
};

/// Both drawings, and for each module of the later word its ancestor in the earlier word.
struct FollowedDrawings {
    const Skeleton& before;
    const Skeleton& after;
    std::uint32_t generation;
    std::span<const Origin> ancestors;
    std::size_t modules; // modules of the earlier word, up to the last with an item or descendant

    /// Items of the earlier drawing, by the module that drew them. `origins`: of these items.
    [[nodiscard]] ItemsByModule old_items(const LargeVector<Origin>& origins) const {
        return {origins.size(), modules, [&](std::size_t i) { return origins[i].place; }};
    }
    /// Items of the later drawing, by the ancestor of the module that drew them.
    [[nodiscard]] ItemsByModule new_items(const LargeVector<Origin>& origins) const {
        return {origins.size(), modules,
                [&](std::size_t i) { return ancestors[origins[i].place].place; }};
    }
    /// Whether the module that drew segment `segment` of `after` was copied, not rewritten.
    [[nodiscard]] bool is_copy(std::uint32_t segment) const {
        return (ancestors[after.segment_origins[segment].place].generation & ~kFollowed) !=
               generation;
    }
};

/// The segments among `items` with the fewest brackets around them, up to the first segment that
/// does not continue the segment before it.
std::vector<std::uint32_t> axis_of(std::span<const std::uint32_t> items, const Skeleton& skeleton) {
    std::vector<std::uint32_t> axis;
    if (items.empty()) {
        return axis;
    }
    std::uint16_t order = skeleton.segments[items.front()].order;
    for (const std::uint32_t item : items) {
        order = std::min(order, skeleton.segments[item].order);
    }
    for (const std::uint32_t item : items) {
        const Segment& segment = skeleton.segments[item];
        if (segment.order != order) {
            continue;
        }
        if (!axis.empty() && segment.parent != axis.back()) {
            break;
        }
        axis.push_back(item);
    }
    return axis;
}

/// Whether both lists have equally many segments, with equal orders relative to the first segment.
bool are_alike(std::span<const std::uint32_t> old_items,
               std::span<const std::uint32_t> new_items,
               const Skeleton& before,
               const Skeleton& after) {
    return old_items.size() == new_items.size() &&
           std::equal(
               old_items.begin(), old_items.end(), new_items.begin(),
               [&](std::uint32_t old_item, std::uint32_t new_item) {
                   return before.segments[old_item].order - before.segments[old_items[0]].order ==
                          after.segments[new_item].order - after.segments[new_items[0]].order;
               });
}

/// Divides an old segment into pieces for the segments of an axis, in proportion to their lengths.
void divide(std::uint32_t old_item,
            std::span<const std::uint32_t> axis,
            const Skeleton& after,
            std::vector<SegmentPiece>& pieces) {
    double total = 0.0;
    for (const std::uint32_t item : axis) {
        total += static_cast<double>(after.segments[item].length);
    }
    double sum = 0.0;
    float low = 0.0F;
    for (std::size_t i = 0; i < axis.size(); ++i) {
        sum += static_cast<double>(after.segments[axis[i]].length);
        const double part = total > 0.0
                                ? sum / total
                                : static_cast<double>(i + 1) / static_cast<double>(axis.size());
        const float high = i + 1 == axis.size() ? 1.0F : static_cast<float>(part);
        pieces[axis[i]] = {old_item, low, high};
        low = high;
    }
}

std::vector<SegmentPiece> find_pieces(const FollowedDrawings& followed) {
    const Skeleton& before = followed.before;
    const Skeleton& after = followed.after;
    std::vector<SegmentPiece> pieces(after.segments.size());
    const ItemsByModule old_items = followed.old_items(before.segment_origins);
    const ItemsByModule new_items = followed.new_items(after.segment_origins);
    for (std::size_t module = 0; module < followed.modules; ++module) {
        const std::span<const std::uint32_t> old_segments = old_items.of(module);
        const std::span<const std::uint32_t> new_segments = new_items.of(module);
        if (old_segments.empty() || new_segments.empty()) {
            continue;
        }
        if (followed.is_copy(new_segments.front()) ||
            are_alike(old_segments, new_segments, before, after)) {
            for (std::size_t i = 0; i < std::min(old_segments.size(), new_segments.size()); ++i) {
                pieces[new_segments[i]].segment = old_segments[i];
            }
            continue;
        }
        const std::vector<std::uint32_t> old_axis = axis_of(old_segments, before);
        const std::vector<std::uint32_t> new_axis = axis_of(new_segments, after);
        if (old_axis.size() == 1) {
            divide(old_axis.front(), new_axis, after, pieces);
            continue;
        }
        for (std::size_t i = 0; i < std::min(old_axis.size(), new_axis.size()); ++i) {
            pieces[new_axis[i]].segment = old_axis[i];
        }
    }
    return pieces;
}

/// Pairs the items of each module in order; returns the old item of each new one, or kNone.
/// fits(old, new): whether the old item can become the new one.
template <typename Fits>
std::vector<std::uint32_t> find_pairs(const FollowedDrawings& followed,
                                      const LargeVector<Origin>& old_origins,
                                      const LargeVector<Origin>& new_origins,
                                      const Fits& fits) {
    std::vector<std::uint32_t> pairs(new_origins.size(), kNone);
    const ItemsByModule old_items = followed.old_items(old_origins);
    const ItemsByModule new_items = followed.new_items(new_origins);
    for (std::size_t module = 0; module < followed.modules; ++module) {
        const std::span<const std::uint32_t> old_items_of_module = old_items.of(module);
        std::size_t next = 0;
        for (const std::uint32_t item : new_items.of(module)) {
            std::size_t found = next;
            while (found < old_items_of_module.size() && !fits(old_items_of_module[found], item)) {
                ++found;
            }
            if (found < old_items_of_module.size()) {
                pairs[item] = old_items_of_module[found];
                next = found + 1;
            }
        }
    }
    return pairs;
}

} // namespace

Correspondence find_correspondence(const Skeleton& before,
                                   const Skeleton& after,
                                   std::uint32_t generation,
                                   std::span<const Origin> ancestors) {
    LSYS_CHECK(before.segment_origins.size() == before.segments.size());
    LSYS_CHECK(after.segment_origins.size() == after.segments.size());
    std::size_t modules = 0;
    for (const Origin& ancestor : ancestors) {
        modules = std::max<std::size_t>(modules, std::size_t{ancestor.place} + 1);
    }
    for (const auto* origins :
         {&before.segment_origins, &before.object_origins, &before.polygon_origins}) {
        for (const Origin& origin : *origins) {
            modules = std::max<std::size_t>(modules, std::size_t{origin.place} + 1);
        }
    }
    const FollowedDrawings followed{before, after, generation, ancestors, modules};
    Correspondence found;
    found.pieces = find_pieces(followed);
    found.objects = find_pairs(followed, before.object_origins, after.object_origins,
                               [&](std::uint32_t old_item, std::uint32_t new_item) {
                                   const PlacedObject& from = before.objects[old_item];
                                   const PlacedObject& to = after.objects[new_item];
                                   return from.kind == to.kind &&
                                          (is_organ(to) || from.mesh_file == to.mesh_file);
                               });
    found.polygons = find_pairs(followed, before.polygon_origins, after.polygon_origins,
                                [](std::uint32_t, std::uint32_t) { return true; });
    return found;
}

} // namespace lsys
