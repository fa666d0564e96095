// SPDX-License-Identifier: MIT
// InstanceCache: the branches of a few hero plants of an instanced system. Any number of distinct
// plants can be assembled from them (Kenwood, Gain and Marais 2014; docs/language.md section 9). An
// instance is a part of the common skeleton of the heroes with an entry, and exits where other
// instances continue. Instances with the same key can replace each other; a slot lists them.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/base/random.h"
#include "runtime/derive/derive.h"
#include "runtime/forest/tree.h"
#include "runtime/turtle/skeleton.h"
#include "runtime/turtle/turtle.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// Place where another instance continues. Coordinates are relative to the entry of the instance
/// that has the exit.
struct InstanceExit {
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec3 position{};    // m
    std::uint32_t slot = 0;  // index of the slot whose instances can continue here
    std::uint32_t order = 0; // number of brackets between entry and exit
};

/// A range of the heroes' segments, objects and polygons.
struct DrawnRange {
    DrawnCounts begin;
    DrawnCounts end;
};

/// A segment of the heroes at whose tip a branch is not drawn, because a recorded instance replaces
/// the branch.
struct InstanceFork {
    std::uint32_t segment = 0; // index in Skeleton::segments
    std::uint32_t slot = 0;    // index in InstanceCache::slots: the slot of the branch
};

struct Instance {
    std::uint32_t slot = 0;       // index in InstanceCache::slots
    std::uint32_t hero = 0;       // number of the hero that contains the instance
    std::uint32_t first_exit = 0; // index in InstanceCache::exits
    std::uint32_t exit_count = 0;
    std::uint32_t first_range = 0; // index in InstanceCache::ranges
    std::uint32_t range_count = 0;
    DrawnCounts size;                     // counts of the items in its ranges
    glm::dquat frame{1.0, 0.0, 0.0, 0.0}; // frame of the turtle at the entry, in the skeleton
    glm::dvec3 position{};                // m, position of the entry, in the skeleton
    std::uint32_t order = 0;              // brackets around the branch in its hero, with its own
};

/// The instances of one key, with counts of the recording.
struct InstanceSlot {
    std::uint32_t id = 0;            // id of the branch; 0: the axiom, whole plants
    std::uint32_t age = 0;           // age of the branch, in generations
    std::uint32_t first_variant = 0; // index in InstanceCache::variants
    std::uint32_t variant_count = 0;
    // In the instanced system `<` uses a recorded branch, `@` records a branch.
    std::uint64_t hits = 0;     // branches `<` that a recorded instance replaced
    std::uint64_t misses = 0;   // branches `<` that were recorded because the slot was empty
    std::uint64_t recorded = 0; // branches `@`, dropped ones included
    std::uint64_t dropped = 0;  // branches `@` that were not kept because of CacheOptions::cap
};

/// The values of a key besides id and age, as recorded for the first branch with this key.
struct InstanceKey {
    /// Values of the formals that the branch uses, in the order of the predecessor.
    std::vector<float> formals;
    TurtlePlace place;         // position, frame and order are not part of the key
    bool has_vertical = false; // whether elevation and roll are part of the key
    float elevation = 0.0F;    // degrees, elevation of the heading
    float roll = 0.0F;         // degrees, roll about the heading
};

struct InstanceCache {
    Skeleton skeleton; // all heroes, one after the other
    std::vector<Instance> instances;
    std::vector<InstanceSlot> slots;     // slot 0: whole plants
    std::vector<std::uint32_t> variants; // indexes of instances, slot by slot
    std::vector<InstanceExit> exits;
    std::vector<DrawnRange> ranges;
    std::vector<InstanceFork> forks; // segments at whose tip the skeleton lacks a branch
    std::vector<InstanceKey> keys;   // by slot; empty unless CacheOptions::keep_keys
    std::uint32_t heroes = 0;        // number of heroes
    /// Origin of the `[` of each instance, kNone for whole plants; empty unless
    /// CacheOptions::origins.
    std::vector<Origin> origins;

    /// Memory in bytes, without skeleton, keys and origins.
    [[nodiscard]] std::uint64_t byte_count() const {
        return instances.size() * sizeof(Instance) + slots.size() * sizeof(InstanceSlot) +
               variants.size() * sizeof(std::uint32_t) + exits.size() * sizeof(InstanceExit) +
               ranges.size() * sizeof(DrawnRange) + forks.size() * sizeof(InstanceFork);
    }
};

struct CacheOptions {
    std::uint32_t heroes = 10; // number of heroes, at least 1
    std::uint32_t generations = 0;
    std::uint64_t seed = 0; // hero k is derived with the seed `seed` + k
    std::uint32_t cap = 0;  // max instances per key; 0: any number
    /// Rounding step of each value in a key, as a fraction of the first value recorded for the same
    /// branch id at the same position in the key; 0: exact values.
    float tolerance = 0.0F;
    /// By branch id: whether the drawing of the branch depends on the up direction. If so, the key
    /// contains elevation and roll of the heading.
    std::vector<bool> depends_on_vertical;
    bool keep_keys = false;                      // fills InstanceCache::keys
    std::uint32_t threads = 0;                   // 0: as many as the machine has
    Limits limits;                               // limits of each word
    std::uint64_t max_bytes = ~std::uint64_t{0}; // limit of the bytes of the skeleton
    std::vector<float> mesh_lengths;             // as in TurtleOptions
    WordSense* senses = nullptr;                 // as in DeriveOptions
    std::shared_ptr<const Looks> looks;          // as in TurtleOptions
    bool origins = false;                        // record the origins of instances and drawn items
    /// A flag that another thread sets to true to stop; may be null.
    const std::atomic<bool>* cancelled = nullptr;
};

struct CacheOutcome {
    InstanceCache cache; // empty unless ok()
    DerivationEnd derivation_end;
    DrawingEnd drawing_end; // end of the drawing, with the faults of all heroes
    std::uint32_t hero = 0; // number of the last hero that was begun

    [[nodiscard]] bool ok() const { return !derivation_end.stop && !drawing_end.stop; }
};

/// Derives and draws the heroes. `bytecode` is an instanced system
/// (compiler/instancing/impl/instancing_pass.h); with another system the cache has whole plants
/// only.
[[nodiscard]] CacheOutcome make_instance_cache(const Bytecode& bytecode,
                                               const CacheOptions& options);

/// An instance placed in a tree. Rotation, position and scale are those of its entry in the world.
struct BranchInstance {
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    glm::vec3 position{}; // m
    float scale = 1.0F;
    std::uint32_t instance = 0; // index in InstanceCache::instances
    std::uint32_t order = 0;    // number of brackets around the branch, its own included
};

/// Expands trees into instances. Use one for each thread.
class TreeExpander {
public:
    /// `key`: the forest's key. `cache` must outlive the expander.
    TreeExpander(const InstanceCache& cache, std::uint64_t key) : cache_(cache), key_(key) {}

    /// Calls visit(BranchInstance) for each instance of the tree, depth first, exits in order.
    /// Depends only on cache, key and tree. Returns the number of instances.
    template <typename Visit>
    std::uint32_t expand(const Tree& tree, Visit&& visit);
    /// Like expand(), but visit() returns whether to visit the instances at the exits. It chooses
    /// the same instances as expand().
    template <typename Visit>
    void expand_until(const Tree& tree, Visit&& visit);
    /// Calls visit(instance) for the instances of expand(). Computes no transforms, so it takes only
    /// a third of the time of expand().
    template <typename Visit>
    std::uint32_t expand_instances(const Tree& tree, Visit&& visit);
    /// The first instance of expand(): a whole plant.
    [[nodiscard]] std::uint32_t root_instance(const Tree& tree) {
        return choose(cache_.slots[0], tree.number, 0);
    }

private:
    static constexpr std::uint32_t kHidden = ~std::uint32_t{0}; // order of unvisited instances

    /// An exit to expand.
    struct Pending {
        glm::quat rotation;
        glm::vec3 position;
        std::uint32_t slot;
        std::uint32_t order;
    };
    /// Items still to visit; the last added is visited first. The capacity doubles when the stack is
    /// full, since most instances add only one or two items.
    template <typename T>
    class VisitStack {
    public:
        [[nodiscard]] bool empty() const { return count_ == 0; }
        T pop() { return items_[--count_]; }
        /// Makes room for `count` items on the stack, which the caller writes; returns the first of
        /// them.
        T* add(std::size_t count) {
            if (count > items_.size() - count_) {
                items_.resize(2 * (count_ + count));
            }
            count_ += count;
            return items_.data() + count_ - count;
        }
        void clear() { count_ = 0; }

    private:
        std::vector<T> items_;
        std::size_t count_ = 0;
    };

    /// The instance of `slot` that node number `node` of a tree takes.
    [[nodiscard]] std::uint32_t
    choose(const InstanceSlot& slot, std::uint32_t tree, std::uint32_t node);
    /// Adds the exits of an instance, placed at `at`, to pending_.
    void add_exits(const Instance& instance, const BranchInstance& at);

    const InstanceCache& cache_;
    std::uint64_t key_; // the forest's key
    VisitStack<Pending> pending_;
    VisitStack<std::uint32_t> pending_slots_;      // used by expand_instances()
    std::array<std::uint32_t, kBlockRun> draws_{}; // random words of the current run of nodes
};

/// The transform of a tree into the world.
[[nodiscard]] BranchInstance root_of(const Tree& tree);

template <typename Visit>
std::uint32_t TreeExpander::expand(const Tree& tree, Visit&& visit) {
    BranchInstance at = root_of(tree);
    pending_.clear();
    *pending_.add(1) = {at.rotation, at.position, 0, 0};
    std::uint32_t node = 0;
    while (!pending_.empty()) {
        const Pending next = pending_.pop();
        const InstanceSlot& slot = cache_.slots[next.slot];
        at.rotation = next.rotation;
        at.position = next.position;
        at.order = next.order;
        at.instance = choose(slot, tree.number, node++);
        add_exits(cache_.instances[at.instance], at);
        visit(at);
    }
    return node;
}

template <typename Visit>
void TreeExpander::expand_until(const Tree& tree, Visit&& visit) {
    BranchInstance at = root_of(tree);
    pending_.clear();
    *pending_.add(1) = {at.rotation, at.position, 0, 0};
    std::uint32_t node = 0;
    while (!pending_.empty()) {
        const Pending next = pending_.pop();
        at.rotation = next.rotation;
        at.position = next.position;
        at.order = next.order;
        // Instances that are not visited use up draws too, because the draws of a tree are numbered
        // in sequence.
        at.instance = choose(cache_.slots[next.slot], tree.number, node++);
        const Instance& instance = cache_.instances[at.instance];
        if (next.order != kHidden && visit(at)) {
            add_exits(instance, at);
        } else {
            Pending* const hidden = pending_.add(instance.exit_count);
            for (std::uint32_t i = 0; i < instance.exit_count; ++i) {
                const std::uint32_t exit = instance.first_exit + instance.exit_count - 1 - i;
                hidden[i].slot = cache_.exits[exit].slot;
                hidden[i].order = kHidden;
            }
        }
    }
}

template <typename Visit>
std::uint32_t TreeExpander::expand_instances(const Tree& tree, Visit&& visit) {
    pending_slots_.clear();
    *pending_slots_.add(1) = 0;
    std::uint32_t node = 0;
    while (!pending_slots_.empty()) {
        const std::uint32_t index = choose(cache_.slots[pending_slots_.pop()], tree.number, node++);
        const Instance& instance = cache_.instances[index];
        const InstanceExit* const exits = cache_.exits.data() + instance.first_exit;
        std::uint32_t* const slots = pending_slots_.add(instance.exit_count);
        for (std::uint32_t i = 0; i < instance.exit_count; ++i) {
            slots[i] = exits[instance.exit_count - 1 - i].slot;
        }
        visit(index);
    }
    return node;
}

} // namespace lsys
