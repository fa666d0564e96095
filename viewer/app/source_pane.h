// SPDX-License-Identifier: MIT
// SourcePane: the text of the grammar beside the plant, with its messages and fixes.
#pragma once

#include "runtime/pipeline/file_position.h"
#include "viewer/app/plant_view.h"
#include "viewer/app/source_text.h"
#include "viewer/app/view.h"
#include "viewer/gl/window.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

/// The settings of the pane that are stored for the next run.
struct SourcePaneLook {
    bool is_shown = false;
    float width = 440.0F; // pixels at text scale 1

    friend bool operator==(const SourcePaneLook&, const SourcePaneLook&) = default;
};
inline constexpr float kMinSourceWidth = 200.0F; // of `width`
inline constexpr float kMaxSourceWidth = 4000.0F;
/// The settings that write_source_look() wrote into the state folder (recent_files.h).
[[nodiscard]] SourcePaneLook read_source_look(const std::string& folder);
void write_source_look(const std::string& folder,
                       const SourcePaneLook& look,
                       const Console& console);

/// A row of the pane. All rows have the same height.
struct SourceRow {
    enum class Kind : std::uint8_t {
        Line,    // a line of the file
        Marks,   // `^^^` below the marked bytes of `message`; with its label if `index` is 1
        Text,    // row `index` of SourcePane::texts()
        Fix,     // fix `index` of `message`, with its button
        Preview, // row `index` of SourcePane::texts(), not wrapped
    };
    Kind kind = Kind::Line;
    std::uint32_t line = 1;
    std::uint32_t message = 0; // index in ShownSource::messages
    std::uint32_t index = 0;   // see Kind
};

class SourcePane {
public:
    SourcePaneLook look;
    bool has_focus = false; // keys scroll the pane

    /// Takes newly loaded texts and the newly picked part from a view. `wake` is called on any
    /// thread when update() has work. Returns whether the pane shows something new.
    bool update(View& view, const std::function<void()>& wake);
    /// Shows and selects the statement at a place. Does nothing if its file is not shown.
    void show(const FilePosition& place);
    /// Selects the next message (`step` 1) or the previous message (-1) among the messages of all
    /// files.
    void go_to_message(int step, View& view);
    /// Handles a key while has_focus; returns whether the key has a meaning.
    bool press(const KeyPress& press);
    /// The place that *Open in editor* opens: the selected line; without a selection, the picked
    /// part; else the first message; else the file.
    [[nodiscard]] FilePosition place_to_open(const View& view) const;
    /// The text of the selected lines; empty if none is selected.
    [[nodiscard]] std::string selected_text() const;

    /// Shows another file, without a selection.
    void select_file(std::size_t file);
    /// Selects a line; with `extends`, the other end of the selection stays.
    void select_line(std::uint32_t line, bool extends);
    /// Makes the rows for a width of `columns`.
    void lay_out(std::uint32_t columns);
    /// Writes a file with a fix applied: a fix of a message in the file shown, or all certain
    /// fixes.
    void apply(const SourceFix& fix, PlantView& view) const;
    void apply_all(PlantView& view) const;
    /// The fix that apply_here() applies: of the messages of the selected line, the first certain
    /// fix, else the first other fix; null if there is none.
    [[nodiscard]] const SourceFix* fix_here() const;
    /// Applies fix_here(), or says in a note of `view` why there is nothing to apply. `plant`: the
    /// view, if it shows a plant, else null.
    void apply_here(View& view, PlantView* plant) const;

    [[nodiscard]] const SourceText* text() const { return text_.get(); }
    /// The file that is shown; null: none.
    [[nodiscard]] const ShownSource* source() const;
    [[nodiscard]] std::size_t file_index() const { return file_index_; }
    [[nodiscard]] const std::vector<SourceRow>& rows() const { return rows_; }
    [[nodiscard]] const std::vector<TextLine>& texts() const { return texts_; }
    [[nodiscard]] LineRange selected() const;
    /// The lines of the statement that drew the picked part.
    [[nodiscard]] LineRange highlighted() const { return highlighted_; }
    /// The line to which the pane must scroll; returned once.
    [[nodiscard]] std::optional<std::uint32_t> take_target();

private:
    /// Shows a new text; keeps file, selection and scrolling if it is the text of the same file.
    void take(std::shared_ptr<const SourceText> text, View& view);

    std::unique_ptr<SourceWorker> worker_;
    std::string requested_file_;       // file of the last request
    std::uint64_t requested_load_ = 0; // View::taken_request_count() at the last request
    std::uint64_t followed_pick_ = 0;  // View::pick_count() when the pane last showed a pick
    std::string shown_file_;           // file of the view to which text_ belongs
    std::shared_ptr<const SourceText> text_;
    std::size_t file_index_ = 0;
    std::string first_error_;             // first error of text_, with its place
    std::uint32_t anchor_ = 0;            // number of the line where the selection began; 0: none
    std::uint32_t selected_ = 0;          // number of the selected line; 0: none
    LineRange highlighted_;               // highlighted()
    std::optional<std::uint32_t> target_; // line to which the pane must scroll
    std::uint32_t columns_ = 0;           // columns for which rows_ were made; 0: they must be made
    std::vector<SourceRow> rows_;
    std::vector<TextLine> texts_;
};

/// Parts of `line`, each at most `columns` wide; `line` is broken at blanks where possible.
[[nodiscard]] std::vector<TextLine> wrapped(const TextLine& line, std::uint32_t columns);
/// `text` with each tab replaced by blanks. `column`: the column in which `text` begins.
[[nodiscard]] std::string expanded(std::string_view text, std::uint32_t column);

/// What the user requests in the drawn pane.
struct SourceActions {
    std::optional<FilePosition> opens; // place to open in the editor
    bool closes = false;
};
/// Draws the pane at the right edge of the window. `plant` may be null; then no fix can be applied.
/// `width`: in pixels. `scale`: scale of text.
[[nodiscard]] SourceActions
draw_source_pane(SourcePane& pane, View& view, PlantView* plant, float width, float scale);

} // namespace lsys::view
