// SPDX-License-Identifier: MIT
// ContactSheet: nine pictures of a plant with other seeds, or with other values of one or two
// `#param`, from which the user chooses. Plants are derived, meshed and drawn one after the other
// on another thread, so only one of them is in memory at a time.
#pragma once

#include "runtime/meshing/texture.h"
#include "viewer/app/latest_request_worker.h"
#include "viewer/app/plant_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys::view {

inline constexpr std::size_t kSheetSide = 3;
inline constexpr std::size_t kSheetCells = kSheetSide * kSheetSide;

/// A plant of the sheet: the values by which it differs from the plant of the view.
struct SheetCell {
    std::optional<std::uint64_t> seed;
    std::vector<Definition> definitions; // they replace definitions of the same names
    std::string label;                   // "seed 4", "angle 30, width 0.2"
};

/// The cells of a sheet. Without `params`: nine consecutive seeds, beginning with `seed`. One
/// parameter: nine values in equal steps from its minimum to its maximum. Two parameters: three
/// values of each; the first changes from left to right, the second from top to bottom.
[[nodiscard]] std::array<SheetCell, kSheetCells>
sheet_cells(std::uint64_t seed, const std::vector<Constant>& params, const Names& names);

/// Sets the values of a cell in the settings of a plant, `edits`.
void take_cell(const SheetCell& cell, PlantEdits& edits);

/// Pictures that the other thread has drawn and take() has not returned yet.
struct SheetPictures {
    std::mutex mutex;
    std::vector<std::pair<std::size_t, Texture>> drawn; // cell, picture; no texels: failed
};

/// The input of the thread that draws the pictures.
struct SheetRequest {
    ViewOptions options;                       // options of all plants; `edits` are applied to them
    std::array<PlantEdits, kSheetCells> edits; // constants and seeds of the plants
    std::uint32_t width = 0;                   // size of a picture, pixels
    std::uint32_t height = 0;
    std::shared_ptr<SheetPictures> pictures;
    std::function<void()> wake; // called after each picture
    // Fields for LatestRequestWorker.
    SteadyClock::time_point changed_at;
    bool is_repeat = false;
};

/// Size of a picture, pixels.
struct SheetSize {
    std::uint32_t width = 1;
    std::uint32_t height = 1;
};
/// Size of the picture of a cell, in a window of the given size in pixels: a third of the window,
/// minus borders.
[[nodiscard]] SheetSize sheet_cell_size(std::uint32_t window_width, std::uint32_t window_height);

class ContactSheet {
public:
    /// Begins to draw the pictures for the plant of `view`, and drops earlier pictures. `width`,
    /// `height`: size of a picture in pixels. `wake`: called on any thread when take() has
    /// pictures. Does nothing if `view` has no plant.
    void show(const PlantView& view,
              std::uint32_t width,
              std::uint32_t height,
              const std::function<void()>& wake);
    /// Stops drawing.
    void close();
    [[nodiscard]] bool is_busy() const { return worker_ != nullptr && worker_->is_busy(); }
    /// Whether take() has pictures.
    [[nodiscard]] bool has_pictures() const;
    /// Takes new pictures, with the numbers of their cells.
    [[nodiscard]] std::vector<std::pair<std::size_t, Texture>> take();

    /// Names of the at most two `#param` that are varied; empty: seeds are varied. A change takes
    /// effect at the next show().
    std::vector<std::string> varied;
    std::array<SheetCell, kSheetCells> cells;         // cells of the last show()
    std::array<std::uintptr_t, kSheetCells> images{}; // for ImGui::Image(); 0: none yet
    /// Whether the picture of a cell was taken; true without an image: its plant could not be made.
    std::array<bool, kSheetCells> done{};
    /// Whether all pictures taken so far are equal.
    [[nodiscard]] bool are_alike() const { return are_alike_; }

private:
    std::shared_ptr<SheetPictures> pictures_;
    std::vector<std::uint8_t> first_texels_; // of the first picture taken, for are_alike()
    bool are_alike_ = true;
    std::unique_ptr<LatestRequestWorker<SheetRequest, bool>> worker_;
};

/// The action of the user in a frame of draw_contact_sheet().
struct SheetAction {
    std::optional<std::size_t> chosen_cell; // cell whose plant the user takes
    bool closes = false;                    // the user closes the sheet
    bool varies = false;                    // ContactSheet::varied has changed
};
/// Draws the sheet over the whole window. Returns the action of the user.
[[nodiscard]] SheetAction draw_contact_sheet(ContactSheet& sheet, const PlantView& view);

} // namespace lsys::view
