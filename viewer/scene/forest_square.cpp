// SPDX-License-Identifier: MIT
#include "viewer/scene/forest_square.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsys::view {

std::uint64_t ForestSquare::byte_count() const {
    return trees.capacity() * sizeof(Tree) + lod_trees.capacity() * sizeof(LodTree) +
           cells.capacity() * sizeof(ForestCell);
}

SquareMaker::SquareMaker(const ForestModel& model) : model_(model) {
    for (const TreeForm& form : model.forms) {
        expanders_.emplace_back(*form.cache, model.forest->key);
    }
}

ForestSquare SquareMaker::make(const SquareId& id, std::vector<Tree> trees) {
    const SquareLayout& layout = model_.streamed->layout;
    ForestSquare square;
    square.id = id;
    square.corner = layout.corner_of(id);
    const auto place_in = [&](const Tree& tree) {
        return glm::dvec2(static_cast<double>(tree.position.x) - square.corner.x,
                          static_cast<double>(tree.position.z) - square.corner.y);
    };
    const auto cell_of = [&](const Tree& tree) {
        const glm::dvec2 at = place_in(tree) / layout.cell_side();
        const auto along = [&](double where) {
            return static_cast<std::uint32_t>(
                std::clamp(where, 0.0, static_cast<double>(layout.cells_across) - 1.0));
        };
        return along(at.y) * layout.cells_across + along(at.x);
    };
    square.cells.resize(layout.cell_count());
    for (const Tree& tree : trees) {
        ++square.cells[cell_of(tree)].count;
    }
    std::uint32_t sum = 0;
    for (ForestCell& cell : square.cells) {
        cell.first = sum;
        sum += std::exchange(cell.count, 0);
    }
    square.trees.resize(trees.size());
    square.lod_trees.resize(trees.size());
    for (const Tree& tree : trees) {
        ForestCell& cell = square.cells[cell_of(tree)];
        const std::uint32_t index = cell.first + cell.count++;
        square.trees[index] = tree;
        LodTree& made = square.lod_trees[index];
        const glm::dvec2 at = place_in(tree);
        made.position =
            glm::vec3(static_cast<float>(at.x), tree.position.y, static_cast<float>(at.y));
        made.scale = tree.scale;
        made.tree = index;
        made.form = static_cast<std::uint16_t>(model_.form_of(tree));
        made.impostor = static_cast<std::uint16_t>(
            model_.forms[made.form].impostor_of[expanders_[made.form].root_instance(tree)]);
    }
    for (ForestCell& cell : square.cells) {
        cell.seed = cell.count == 0 ? 0 : square.trees[cell.first].number;
        describe_cell(model_, {square.lod_trees.data() + cell.first, cell.count}, square.trees,
                      cell);
    }
    return square;
}

} // namespace lsys::view
