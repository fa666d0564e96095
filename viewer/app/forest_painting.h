// SPDX-License-Identifier: MIT
// ForestPainting: painting of the forest in the window. Finds the ground under the mouse, keeps
// unsaved changes when the scene is reloaded, and writes them to the scene file.
#pragma once

#include "runtime/program/console.h"
#include "viewer/app/forest_document.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/height_field.h"
#include "viewer/scene/painter.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

enum class PaintTool : std::uint8_t { None, Brush, OneTree, Eraser };

/// Number of trees that a stroke, undo or redo has changed.
struct PaintCount {
    std::uint64_t added = 0;
    std::uint64_t removed = 0;
};

class ForestPainting {
public:
    explicit ForestPainting(Renderer& renderer) : renderer_(&renderer) {}

    /// Switches to a new forest, which the renderer already shows. Applies painted and erased trees
    /// to it, and keeps unsaved changes. Returns a note for the user, which may be empty.
    [[nodiscard]] std::string set_document(std::shared_ptr<const ForestDocument> document);

    /// Forgets which trees were painted and erased, saved or not.
    void clear() {
        painter_.reset();
        in_file_.reset();
    }

    /// First intersection of a ray with the ground.
    [[nodiscard]] std::optional<glm::dvec3> pick(const Ray& ray);
    /// Moves the tool to `place` and applies it between the last place and this one. `begins`: a
    /// stroke begins at `place`.
    void move_tool(const glm::dvec3& place, bool begins, PaintTool tool, const Brush& brush);
    /// Trees changed by the last stroke, undo or redo.
    [[nodiscard]] const PaintCount& count() const { return count_; }

    [[nodiscard]] bool can_undo() const { return painter_ && painter_->can_undo(); }
    [[nodiscard]] bool can_redo() const { return painter_ && painter_->can_redo(); }
    void undo();
    void redo();
    [[nodiscard]] bool is_unsaved() const { return painter_ && painter_->is_changed(); }
    /// Writes the scene file, all or nothing.
    [[nodiscard]] Result<void> save(const std::string& file, const Console& console);
    /// Whether the painting that was saved last erases placed trees.
    [[nodiscard]] bool has_erased() const { return in_file_ && !in_file_->erased.empty(); }
    /// Text of the scene file as saved last.
    [[nodiscard]] const std::string& saved_text() const { return saved_text_; }
    /// Whether anything is painted or erased, in the file or since it was read.
    [[nodiscard]] bool is_painted() const { return painter_.has_value(); }
    /// Count of trees, painted ones included.
    [[nodiscard]] std::uint64_t tree_count() const;
    [[nodiscard]] std::uint64_t painted_count() const { return painted_; }
    /// Calls visit(tree) for all trees, painted ones included. Precondition: set_document().
    template <typename Visit>
    void for_each_tree(const Visit& visit) const {
        if (!painter_) {
            std::for_each(document_->grown.forest.trees.begin(),
                          document_->grown.forest.trees.end(), visit);
            return;
        }
        for (std::uint32_t i = 0; i < painter_->tree_count(); ++i) {
            if (painter_->is_alive(i)) {
                visit(painter_->tree(i));
            }
        }
    }

    /// Circle that shows the brush on the ground.
    [[nodiscard]] std::vector<LineVertex>
    outline(const glm::dvec3& place, float radius, bool erases) const;

private:
    [[nodiscard]] Painter& painter(); // made on first use
    /// The painting with the species numbers of document_; trees of other species are dropped.
    [[nodiscard]] Painting renamed(const Painting& painting) const;
    void apply_at(float x, float z, PaintTool tool, const Brush& brush);
    /// Sends changed trees to the renderer and counts them.
    void show(std::span<const TreeChange> changes);
    /// Sends the trees that sense the changed trees in their surroundings to the renderer.
    void show_surroundings(std::span<const TreeChange> changes);
    /// Sends all painted and erased trees to the renderer.
    void show_all();

    Renderer* renderer_;
    std::shared_ptr<const ForestDocument> document_;
    std::optional<Painter> painter_;
    std::vector<std::string> names_;    // species names by the indices in painter_
    std::optional<Painting> in_file_;   // the painting in the scene file as last read or saved
    std::optional<HeightField> ground_; // made on first use
    std::optional<glm::dvec3> last_;    // last place to which the stroke moved
    PaintCount count_;
    std::uint64_t painted_ = 0; // number of painted trees that are not erased or undone
    std::string saved_text_;
};

} // namespace lsys::view
