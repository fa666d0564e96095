// SPDX-License-Identifier: MIT
#include "viewer/scene/forest_lod.h"

#include "viewer/scene/streamed_trees.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

namespace lsys::view {

namespace {

constexpr double kTreesPerCell = 16.0;

} // namespace

ForestLod::ForestLod(const ForestModel& model) : model_(model), added_(model.terrain->region()) {
    std::uint32_t meshes = 0;
    for (const TreeForm& form : model_.forms) {
        expanders_.emplace_back(*form.cache, model_.forest->key);
        first_mesh_.push_back(meshes);
        meshes += kGroups * static_cast<std::uint32_t>(form.cache->instances.size());
    }
    mesh_counts_.resize(meshes);
    if (model_.streamed != nullptr) {
        cell_size_ = model_.streamed->layout.cell_side();
        return;
    }
    sort_into_cells();
}

Sphere bounding_sphere(const ForestModel& model, const LodTree& tree, float yaw) {
    const TreeForm& form = model.forms[tree.form];
    const glm::vec3& c = form.sphere.centre;
    const glm::vec3 turned(std::cos(yaw) * c.x + std::sin(yaw) * c.z, c.y,
                           std::cos(yaw) * c.z - std::sin(yaw) * c.x);
    return {tree.position + tree.scale * turned, tree.scale * form.sphere.radius};
}

Sphere impostor_sphere(const ForestModel& model, const LodTree& tree) {
    const TreeForm& form = model.forms[tree.form];
    return {tree.position + glm::vec3(0.0F, tree.scale * 0.5F * (form.low + form.high), 0.0F),
            tree.scale * std::hypot(form.radius, 0.5F * form.height())};
}

void describe_cell(const ForestModel& model,
                   std::span<const LodTree> trees,
                   std::span<const Tree> all,
                   ForestCell& cell) {
    Bounds box;
    std::vector<std::uint32_t> of_form(model.forms.size());
    glm::dvec4 total(0.0);
    for (const LodTree& tree : trees) {
        const Sphere reach = bounding_sphere(model, tree, all[tree.tree].yaw);
        const Sphere impostor = impostor_sphere(model, tree);
        for (const Sphere& sphere : {reach, impostor}) {
            box.add(sphere.centre - sphere.radius);
            box.add(sphere.centre + sphere.radius);
        }
        cell.tallest = std::max(cell.tallest, tree.scale * model.forms[tree.form].height());
        ++of_form[tree.form];
        total += glm::dvec4(glm::dvec3(tree.position), static_cast<double>(tree.scale));
    }
    total /= std::max(static_cast<double>(trees.size()), 1.0);
    cell.middle = glm::vec3(total);
    cell.scale = static_cast<float>(total.w);
    cell.low = box.low;
    cell.high = box.high;
    cell.form = static_cast<std::uint16_t>(std::max_element(of_form.begin(), of_form.end()) -
                                           of_form.begin());
}

std::uint64_t ForestLod::cell_of(const glm::vec3& place) const {
    const auto column =
        static_cast<std::uint64_t>(static_cast<double>(place.x - cells_low_.x) / cell_size_);
    const auto row =
        static_cast<std::uint64_t>(static_cast<double>(place.z - cells_low_.y) / cell_size_);
    return std::min(row, rows_ - 1) * columns_ + std::min(column, columns_ - 1);
}

LodTree ForestLod::make_lod_tree(const Tree& tree, std::uint32_t index) {
    LodTree lod_tree;
    lod_tree.position = tree.position;
    lod_tree.scale = tree.scale;
    lod_tree.tree = index;
    lod_tree.form = static_cast<std::uint16_t>(model_.form_of(tree));
    lod_tree.impostor = static_cast<std::uint16_t>(
        model_.forms[lod_tree.form].impostor_of[expanders_[lod_tree.form].root_instance(tree)]);
    return lod_tree;
}

void ForestLod::sort_into_cells() {
    const LargeVector<Tree>& trees = model_.forest->trees;
    alive_count_ = trees.size();
    if (trees.empty()) {
        return;
    }
    glm::vec2 low(trees.front().position.x, trees.front().position.z);
    glm::vec2 high = low;
    for (const Tree& tree : trees) {
        const glm::vec2 at(tree.position.x, tree.position.z);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const double area = std::max(static_cast<double>(high.x - low.x), 1.0) *
                        std::max(static_cast<double>(high.y - low.y), 1.0);
    cell_size_ = std::sqrt(area * kTreesPerCell / static_cast<double>(trees.size()));
    cells_low_ = low;
    columns_ = static_cast<std::uint64_t>(static_cast<double>(high.x - low.x) / cell_size_) + 1;
    rows_ = static_cast<std::uint64_t>(static_cast<double>(high.y - low.y) / cell_size_) + 1;
    cells_.resize(columns_ * rows_);
    for (const Tree& tree : trees) {
        ++cells_[cell_of(tree.position)].count;
    }
    std::uint32_t sum = 0;
    for (ForestCell& cell : cells_) {
        cell.first = sum;
        sum += cell.count;
        cell.count = 0;
    }
    trees_.resize(trees.size());
    for (std::uint32_t i = 0; i < trees.size(); ++i) {
        ForestCell& cell = cells_[cell_of(trees[i].position)];
        trees_[cell.first + cell.count++] = make_lod_tree(trees[i], i);
    }
    for (ForestCell& cell : cells_) {
        describe_cell(model_, {trees_.data() + cell.first, cell.count}, trees, cell);
        if (cell.count != 0) {
            bounds_.add(cell.low);
            bounds_.add(cell.high);
        }
    }
}

void ForestLod::find_within(const Bounds& box, std::vector<std::uint32_t>& trees) const {
    for (const ForestCell& cell : cells_) {
        if (cell.count != 0 && cell.low.x <= box.high.x && cell.high.x >= box.low.x &&
            cell.low.z <= box.high.z && cell.high.z >= box.low.z) {
            for (std::uint32_t i = 0; i < cell.count; ++i) {
                if (!trees_[cell.first + i].is_removed()) {
                    trees.push_back(cell.first + i);
                }
            }
        }
    }
    added_.visit(
        [&](const AddedTrees::Cell& cell) {
            return cell.low.x <= box.high.x && cell.high.x >= box.low.x &&
                   cell.low.z <= box.high.z && cell.high.z >= box.low.z;
        },
        [&](std::uint32_t slot) { trees.push_back(first_added() + slot); });
}

float ForestLod::crown_cover(const glm::vec3& eye) const {
    constexpr float kRange = 15.0F;  // m
    constexpr float kMinTop = 1.0F;  // m above the eye: lower tops of crowns do not count
    constexpr float kFullTop = 5.0F; // m above the eye: higher tops count in full
    Bounds box;
    box.add(eye - kRange);
    box.add(eye + kRange);
    std::vector<std::uint32_t> numbers;
    find_within(box, numbers);
    float covered = 0.0F; // m^2, weighted area of crowns / pi
    for (const std::uint32_t number : numbers) {
        const LodTree& tree = lod_tree(number);
        const TreeForm& form = model_.forms[tree.form];
        const glm::vec2 away(tree.position.x - eye.x, tree.position.z - eye.z);
        const float nearness = std::max(1.0F - glm::dot(away, away) / (kRange * kRange), 0.0F);
        const float top = tree.position.y + tree.scale * form.high - eye.y;
        const float radius = tree.scale * form.radius;
        covered += nearness * std::clamp((top - kMinTop) / (kFullTop - kMinTop), 0.0F, 1.0F) *
                   radius * radius;
    }
    constexpr float kMeanNearness = 0.5F; // mean of `nearness` within the range
    return 1.0F - std::exp(-covered / (kMeanNearness * kRange * kRange));
}

void ForestLod::list_whole_trees(std::span<const std::uint32_t> trees,
                                 std::uint32_t level,
                                 std::vector<PoolBranch>& branches,
                                 DrawLists& lists) {
    branches.clear();
    lists.branches.clear();
    lists.runs.clear();
    for (const std::uint32_t number : trees) {
        const std::uint32_t form = lod_tree(number).form;
        const InstanceCache& cache = *model_.forms[form].cache;
        expanders_[form].expand(tree_of(number), [&](const BranchInstance& branch) {
            branches.push_back(pool_branch(branch, cache.instances[branch.instance], number));
        });
    }
    const auto mesh_of = [&](std::uint32_t slot) {
        const PoolBranch& branch = branches[slot];
        return std::pair(lod_tree(branch.tree).form, branch.mesh);
    };
    std::vector<std::uint32_t> slots(branches.size());
    std::iota(slots.begin(), slots.end(), 0U);
    std::stable_sort(slots.begin(), slots.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return mesh_of(a) < mesh_of(b); });
    for (const std::uint32_t slot : slots) {
        const auto [form, mesh] = mesh_of(slot);
        const auto at = static_cast<std::uint32_t>(lists.branches.size());
        if (lists.runs.empty() || lists.runs.back().form != form ||
            lists.runs.back().instance != mesh) {
            lists.runs.push_back({form, level, mesh, at, 0, false});
        }
        ++lists.runs.back().count;
        lists.branches.emplace_back(slot);
    }
}

/// Replaces yaw and form of a tree of the forest in `cell` after its surroundings have changed.
void ForestLod::replace_yaw_and_form(std::uint32_t number, const Tree& tree, ForestCell& cell) {
    pool_.forget(number);
    turned_[number] = tree;
    const bool is_removed = trees_[number].is_removed();
    LodTree& turned = trees_[number];
    turned = make_lod_tree(tree, turned.tree);
    turned.impostor |= is_removed ? LodTree::kRemoved : 0;
    for (const Sphere& sphere : {bounding_sphere(turned, tree.yaw), impostor_sphere(turned)}) {
        cell.low = glm::min(cell.low, sphere.centre - sphere.radius);
        cell.high = glm::max(cell.high, sphere.centre + sphere.radius);
    }
    cell.tallest = std::max(cell.tallest, tree.scale * model_.forms[turned.form].height());
    bounds_.add(cell.low);
    bounds_.add(cell.high);
}

std::uint32_t ForestLod::change_tree(std::uint32_t index, const Tree& tree, bool alive) {
    if (index >= trees_.size()) {
        const std::uint32_t slot = index - first_added();
        const bool was_alive = added_.is_alive(slot);
        if (alive && added_.differs(slot, tree)) {
            pool_.forget(index);
            const LodTree made = make_lod_tree(tree, index);
            Bounds box;
            for (const Sphere& sphere : {bounding_sphere(made, tree.yaw), impostor_sphere(made)}) {
                box.add(sphere.centre - sphere.radius);
                box.add(sphere.centre + sphere.radius);
            }
            added_.put(slot, tree, made, box);
            bounds_.add(box.low);
            bounds_.add(box.high);
        }
        added_.set_alive(slot, alive);
        alive_count_ += static_cast<std::uint64_t>(alive) - static_cast<std::uint64_t>(was_alive);
        return index;
    }
    ForestCell& cell = cells_[cell_of(tree.position)];
    std::uint32_t number = cell.first;
    while (trees_[number].tree != index) {
        ++number;
    }
    if (alive && std::bit_cast<std::uint32_t>(placed_tree(number).yaw) !=
                     std::bit_cast<std::uint32_t>(tree.yaw)) {
        replace_yaw_and_form(number, tree, cell);
    }
    if (trees_[number].is_removed() == alive) {
        trees_[number].impostor ^= LodTree::kRemoved;
        cell.removed += alive ? ~std::uint32_t{0} : 1U;
        alive_count_ += alive ? 1 : ~std::uint64_t{0};
    }
    return number;
}

std::uint64_t ForestLod::byte_count() const {
    return trees_.size() * sizeof(LodTree) + cells_.size() * sizeof(ForestCell);
}

} // namespace lsys::view
