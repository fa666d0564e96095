// SPDX-License-Identifier: MIT
#include "runtime/forest/instance_cache.h"

#include "grammar/base/contract.h"
#include "grammar/base/trigonometry.h"
#include "runtime/base/out_of_memory.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <unordered_map>
#include <utility>

namespace lsys {

namespace {

/// Generation number of the draws that choose instances (docs/language.md section 9.6).
constexpr std::uint32_t kExpansionGeneration = 0xFFFFFFFEu;

/// Records instances while the turtle draws the heroes.
class Recorder : public BranchWatcher {
public:
    Recorder(const CacheOptions& options, bool draws_organs, InstanceCache& cache)
        : options_(options), draws_organs_(draws_organs), cache_(cache) {}

    void begin_hero(std::uint32_t hero, const TurtlePlace& place, const DrawnCounts& drawn) {
        hero_ = hero;
        if (cache_.slots.empty()) {
            cache_.slots.emplace_back();
            variants_.emplace_back();
            if (options_.keep_keys) {
                cache_.keys.emplace_back().place = place;
            }
        }
        ++cache_.slots[0].recorded;
        start(0, place, drawn, {});
    }
    void end_hero(const DrawnCounts& drawn) {
        LSYS_CHECK(active_.size() == 1 && suspended_ == 0);
        close(drawn);
    }

    bool begin(const BranchStart& branch) override {
        const std::uint32_t index = slot_of(branch);
        InstanceSlot& slot = cache_.slots[index];
        std::vector<std::uint32_t>& variants = variants_[index];
        if (!branch.has_instance) {
            ++slot.recorded;
            if (options_.cap != 0 && variants.size() >= options_.cap) {
                ++slot.dropped;
                active_.emplace_back(); // a branch that is not recorded
                return true;
            }
            start(index, branch.place, branch.drawn, branch.origin);
            return true;
        }
        mark_exit(index, branch.place);
        if (!variants.empty()) {
            ++slot.hits;
            if (branch.segment != kNoSegment) {
                cache_.forks.push_back({branch.segment, index});
            }
            return false;
        }
        // None of the enclosing instances contains the drawing of this branch.
        ++slot.misses;
        for (std::size_t i = suspended_; i < active_.size(); ++i) {
            end_range(active_[i], branch.drawn);
        }
        const std::size_t base = active_.size();
        start(index, branch.place, branch.drawn, branch.origin);
        active_.back().suspended_below = suspended_;
        active_.back().suspends = true;
        suspended_ = base;
        return true;
    }

    void end(const DrawnCounts& drawn) override { close(drawn); }

    /// Fills the lists of the cache. Called after the last hero.
    void finish() {
        for (std::size_t i = 0; i < cache_.instances.size(); ++i) {
            Instance& instance = cache_.instances[i];
            instance.first_exit = static_cast<std::uint32_t>(cache_.exits.size());
            instance.exit_count = static_cast<std::uint32_t>(exits_[i].size());
            cache_.exits.insert(cache_.exits.end(), exits_[i].begin(), exits_[i].end());
            instance.first_range = static_cast<std::uint32_t>(cache_.ranges.size());
            instance.range_count = static_cast<std::uint32_t>(ranges_[i].size());
            cache_.ranges.insert(cache_.ranges.end(), ranges_[i].begin(), ranges_[i].end());
            for (const DrawnRange& range : ranges_[i]) {
                instance.size.segments += range.end.segments - range.begin.segments;
                instance.size.objects += range.end.objects - range.begin.objects;
                instance.size.polygons += range.end.polygons - range.begin.polygons;
            }
        }
        for (std::size_t i = 0; i < cache_.slots.size(); ++i) {
            InstanceSlot& slot = cache_.slots[i];
            slot.first_variant = static_cast<std::uint32_t>(cache_.variants.size());
            slot.variant_count = static_cast<std::uint32_t>(variants_[i].size());
            cache_.variants.insert(cache_.variants.end(), variants_[i].begin(), variants_[i].end());
        }
    }

private:
    /// An instance that is being recorded.
    struct Active {
        std::uint32_t instance = kNone;
        DrawnCounts range_begin;
        std::size_t suspended_below = 0; // if `suspends`: suspended_ before this instance
        bool suspends = false;           // suspends the enclosing instances while it is recorded
    };

    void start(std::uint32_t slot,
               const TurtlePlace& place,
               const DrawnCounts& drawn,
               const Origin& origin) {
        Active active;
        active.instance = static_cast<std::uint32_t>(cache_.instances.size());
        active.range_begin = drawn;
        Instance& instance = cache_.instances.emplace_back();
        instance.slot = slot;
        instance.hero = hero_;
        instance.frame = place.frame;
        instance.position = place.position;
        instance.order = place.order;
        if (options_.origins) {
            cache_.origins.push_back(origin);
        }
        exits_.emplace_back();
        ranges_.emplace_back();
        variants_[slot].push_back(active.instance);
        active_.push_back(active);
    }

    void close(const DrawnCounts& drawn) {
        const Active closed = active_.back();
        end_range(closed, drawn);
        active_.pop_back();
        if (closed.suspends) {
            suspended_ = closed.suspended_below;
            for (std::size_t i = suspended_; i < active_.size(); ++i) {
                active_[i].range_begin = drawn;
            }
        }
    }

    void end_range(const Active& active, const DrawnCounts& drawn) {
        if (active.instance != kNone && !(active.range_begin == drawn)) {
            ranges_[active.instance].push_back({active.range_begin, drawn});
        }
    }

    void mark_exit(std::uint32_t slot, const TurtlePlace& place) {
        for (std::size_t i = suspended_; i < active_.size(); ++i) {
            if (active_[i].instance == kNone) {
                continue;
            }
            const Instance& instance = cache_.instances[active_[i].instance];
            const glm::dquat back = glm::conjugate(instance.frame);
            InstanceExit exit;
            exit.rotation = glm::quat(glm::normalize(back * place.frame));
            exit.position = glm::vec3(back * (place.position - instance.position));
            exit.slot = slot;
            exit.order = place.order - instance.order;
            exits_[active_[i].instance].push_back(exit);
        }
    }

    std::uint32_t slot_of(const BranchStart& branch) {
        key_.clear();
        part_ = 0;
        add(branch.id);
        add(branch.age);
        for (const float formal : branch.formals) {
            add_real(branch.id, formal);
        }
        const TurtlePlace& place = branch.place;
        for (const float value :
             {place.width, place.taper, place.step, place.angle, place.second_heading}) {
            add_real(branch.id, value);
        }
        if (draws_organs_) {
            add(place.contour);
            add_real(branch.id, place.tangent_before);
            add_real(branch.id, place.tangent_after);
            const RadiusTangents& radii = place.radii;
            for (const float value : {radii.part_before, radii.radius_before, radii.part_after,
                                      radii.radius_after, radii.per_chord ? 1.0F : 0.0F}) {
                add_real(branch.id, value);
            }
        }
        add(place.sides);
        add(place.colour);
        if (is_own(place.colour) || place.texture != 0) {
            add(place.colour_index);
            add(place.texture);
        }
        InstanceKey values;
        values.has_vertical = branch.id < options_.depends_on_vertical.size() &&
                              options_.depends_on_vertical[branch.id];
        if (values.has_vertical) {
            // Elevation of the heading, and roll about the heading from the heights (y) of the
            // right and up axes.
            const glm::dvec3 heading = place.frame * glm::dvec3(0.0, 1.0, 0.0);
            const glm::dvec3 right = place.frame * glm::dvec3(1.0, 0.0, 0.0);
            const glm::dvec3 up = place.frame * glm::dvec3(0.0, 0.0, 1.0);
            constexpr double kDegrees = 180.0 / std::numbers::pi;
            values.elevation =
                static_cast<float>(arc_sine(std::clamp(heading.y, -1.0, 1.0)) * kDegrees);
            values.roll = static_cast<float>(polar_angle(right.y, up.y) * kDegrees);
            add_real(branch.id, values.elevation);
            add_real(branch.id, values.roll);
        }
        const auto [known, is_new] =
            slot_of_key_.emplace(key_, static_cast<std::uint32_t>(cache_.slots.size()));
        if (is_new) {
            InstanceSlot& slot = cache_.slots.emplace_back();
            slot.id = branch.id;
            slot.age = branch.age;
            variants_.emplace_back();
            if (options_.keep_keys) {
                values.formals.assign(branch.formals.begin(), branch.formals.end());
                values.place = place;
                cache_.keys.push_back(std::move(values));
            }
        }
        return known->second;
    }

    void add(std::uint32_t word) { key_.append(reinterpret_cast<const char*>(&word), sizeof word); }

    /// Adds to the key the bits of a value or, with a tolerance, its number of rounding steps.
    void add_real(std::uint32_t id, float value) {
        const std::uint32_t part = part_++;
        if (options_.tolerance == 0.0F) {
            add(std::bit_cast<std::uint32_t>(value));
            return;
        }
        const auto [scale, is_first] =
            scales_.emplace(std::pair(id, part), static_cast<double>(std::abs(value)));
        if (scale->second == 0.0) {
            scale->second = 1.0;
        }
        const double steps = std::round(static_cast<double>(value) /
                                        (static_cast<double>(options_.tolerance) * scale->second));
        const auto bits = std::bit_cast<std::uint64_t>(steps + 0.0); // -0 becomes 0
        add(static_cast<std::uint32_t>(bits));
        add(static_cast<std::uint32_t>(bits >> 32));
    }

    const CacheOptions& options_;
    bool draws_organs_; // keys then have the contour and the tangents
    InstanceCache& cache_;
    std::vector<std::vector<InstanceExit>> exits_;     // by instance
    std::vector<std::vector<DrawnRange>> ranges_;      // by instance
    std::vector<std::vector<std::uint32_t>> variants_; // by slot
    std::vector<Active> active_;
    std::size_t suspended_ = 0; // number of suspended instances, the first ones in active_
    std::unordered_map<std::string, std::uint32_t> slot_of_key_;
    // By branch id and index of a value in the key: absolute value in the first recorded branch;
    // this value times CacheOptions::tolerance is the rounding step.
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> scales_;
    std::string key_;        // bytes of the key that slot_of() is making
    std::uint32_t part_ = 0; // index of the next real value in this key
    std::uint32_t hero_ = 0; // number of the hero that is being drawn
};

CacheOutcome record_heroes(const Bytecode& bytecode, const CacheOptions& options) {
    CacheOutcome outcome;
    InstanceCache cache;
    const bool draws_organs =
        std::ranges::any_of(bytecode.symbols, [](const BytecodeSymbol& symbol) {
            return symbol.turtle == TurtleOperation::SurfaceBegin;
        });
    Recorder recorder(options, draws_organs, cache);
    TurtleOptions turtle_options;
    turtle_options.mesh_lengths = options.mesh_lengths;
    turtle_options.looks = options.looks;
    turtle_options.max_bytes = options.max_bytes;
    turtle_options.cancelled = options.cancelled;
    turtle_options.branches = &recorder;
    turtle_options.seed = options.seed;
    turtle_options.generations = options.generations;
    Turtle turtle(bytecode, turtle_options);
    for (std::uint32_t k = 0; k < options.heroes && outcome.ok(); ++k) {
        outcome.hero = k;
        DeriveOptions derive;
        derive.generations = options.generations;
        derive.seed = options.seed + k;
        derive.threads = options.threads;
        derive.origins = options.origins;
        derive.limits = options.limits;
        derive.cancelled = options.cancelled;
        derive.senses = options.senses;
        Derivation derivation(bytecode, derive);
        if (derivation.derive()) {
            outcome.derivation_end = derivation.end();
            break;
        }
        if (k > 0) {
            turtle.begin_word(derive.seed);
        }
        recorder.begin_hero(k, turtle.place(), turtle.drawn());
        if (!turtle.feed(derivation.word()) && !turtle.finish()) {
            recorder.end_hero(turtle.drawn());
        }
        outcome.drawing_end = turtle.end();
    }
    if (outcome.ok()) {
        recorder.finish();
        cache.heroes = options.heroes;
        cache.skeleton = turtle.take_skeleton();
        outcome.cache = std::move(cache);
    }
    return outcome;
}

} // namespace

CacheOutcome make_instance_cache(const Bytecode& bytecode, const CacheOptions& options) {
    LSYS_CHECK(options.heroes > 0);
    LSYS_CHECK(options.tolerance >= 0.0F);
    return catch_out_of_memory([&] { return record_heroes(bytecode, options); },
                               [] {
                                   CacheOutcome outcome;
                                   outcome.drawing_end.stop = Stop::OutOfMemory;
                                   return outcome;
                               });
}

BranchInstance root_of(const Tree& tree) {
    BranchInstance root;
    const SineCosine half = sine_cosine(0.5 * static_cast<double>(tree.yaw));
    root.rotation =
        glm::quat(static_cast<float>(half.cosine), 0.0F, static_cast<float>(half.sine), 0.0F);
    root.position = tree.position;
    root.scale = tree.scale;
    return root;
}

/// Chooses a variant of `slot` by a draw u from 0 to below 1: the variant number floor(u *
/// variant_count), computed in integers. u is draw 0 of block `node`.
std::uint32_t
TreeExpander::choose(const InstanceSlot& slot, std::uint32_t tree, std::uint32_t node) {
    if (node % kBlockRun == 0) {
        draws_ = draw_block_run(key_, kExpansionGeneration, tree, node);
    }
    const std::uint32_t* const variants = cache_.variants.data() + slot.first_variant;
    if (slot.variant_count == 1) {
        return variants[0];
    }
    const std::uint64_t u = draws_[node % kBlockRun] >> 8;
    return variants[u * slot.variant_count >> 24];
}

void TreeExpander::add_exits(const Instance& instance, const BranchInstance& at) {
    const InstanceExit* const exits = cache_.exits.data() + instance.first_exit;
    Pending* const pending = pending_.add(instance.exit_count);
    for (std::uint32_t i = 0; i < instance.exit_count; ++i) {
        const InstanceExit& exit = exits[instance.exit_count - 1 - i];
        pending[i] = {at.rotation * exit.rotation,
                      at.position + at.scale * (at.rotation * exit.position), exit.slot,
                      at.order + exit.order};
    }
}

} // namespace lsys
