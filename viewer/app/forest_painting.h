// ForestPainting: a forest that is painted while it is shown. Finds the ground under the mouse,
// keeps what was painted through reloads, and writes it into the scene file.
#pragma once

#include "runtime/program/console.h"
#include "viewer/app/forest_document.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/height_field.h"
#include "viewer/scene/painter.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

enum class PaintTool : std::uint8_t { None, Brush, OneTree, Eraser };

/// What a stroke, or undoing one, has done.
struct PaintCount {
    std::uint64_t came = 0;
    std::uint64_t went = 0;
};

class ForestPainting {
public:
    explicit ForestPainting(Renderer& renderer) : renderer_(&renderer) {}

    /// The forest that the renderer shows from now on; its trees that were painted or erased come
    /// and go there. What was painted and not saved stays. Returns what there is to say of that.
    [[nodiscard]] std::string follow(std::shared_ptr<const ForestDocument> document);

    /// Where a ray first meets the ground of the forest.
    [[nodiscard]] std::optional<glm::dvec3> pick(const Ray& ray);
    /// A place that the tool goes over; `begins` a stroke there. Between places of a stroke it goes
    /// over those that lie between.
    void go_over(const glm::dvec3& place, bool begins, PaintTool tool, const Brush& brush);
    /// Nothing since the last stroke was begun, or undone, or redone: what it has done so far.
    [[nodiscard]] const PaintCount& count() const { return count_; }

    [[nodiscard]] bool can_undo() const { return painter_ && painter_->can_undo(); }
    [[nodiscard]] bool can_redo() const { return painter_ && painter_->can_redo(); }
    void undo();
    void redo();
    [[nodiscard]] bool is_unsaved() const { return painter_ && painter_->is_changed(); }
    /// Into the scene file, all or nothing.
    [[nodiscard]] Result<void> save(const std::string& file, const Console& console);
    /// What was saved last takes placed trees away.
    [[nodiscard]] bool has_erased() const { return in_file_ && !in_file_->erased.empty(); }
    /// The text that was saved last.
    [[nodiscard]] const std::string& saved_text() const { return saved_text_; }
    /// Trees that are there, painted ones too.
    [[nodiscard]] std::uint64_t tree_count() const;
    [[nodiscard]] std::uint64_t painted_count() const { return painted_; }

    /// The outline of a brush on the ground.
    [[nodiscard]] std::vector<LineVertex>
    outline(const glm::dvec3& place, float radius, bool erases) const;

private:
    [[nodiscard]] Painter& painter();
    [[nodiscard]] Painting renamed(const Painting& painting) const;
    void dab(float x, float z, PaintTool tool, const Brush& brush);
    void show(std::span<const TreeChange> changes);
    void show_all();

    Renderer* renderer_;
    std::shared_ptr<const ForestDocument> document_;
    std::optional<Painter> painter_;
    std::vector<std::string> names_;    // of the species that painter_ knows
    std::optional<Painting> in_file_;   // as it was read or saved last
    std::optional<HeightField> ground_; // made when it is asked for
    std::optional<glm::dvec3> last_;    // of the stroke
    PaintCount count_;
    std::uint64_t painted_ = 0;
    std::string saved_text_;
};

} // namespace lsys::view
