// SPDX-License-Identifier: MIT
// Controls: turns mouse and keyboard input into changes of a view.
#pragma once

#include "viewer/app/camera_bookmarks.h"
#include "viewer/app/contact_sheet.h"
#include "viewer/app/editor.h"
#include "viewer/app/film_export.h"
#include "viewer/app/panel_focus.h"
#include "viewer/app/source_pane.h"
#include "viewer/app/start_page.h"
#include "viewer/app/view_switcher.h"
#include "viewer/gl/window.h"

#include <array>
#include <optional>
#include <string>

namespace lsys::view {

/// The open dialog, which receives all keys.
enum class OpenDialog : std::uint8_t { None, File, Picture, Export, Sheet, Unsaved };

/// State of overlays and dialogs, and modes of the window.
struct PanelState {
    bool panels = true;         // the panels are shown
    bool statistics = false;    // the statistics are shown
    bool help = false;          // the list of keys is shown
    bool flies = false;         // fly mode: the mouse looks around, WASD move
    bool wants_to_quit = false; // the user has pressed Ctrl+Q
    bool quits = false;         // close the window now: no unsaved changes are left
    FocusMove focus_move = FocusMove::None;
    PanelFocus focus;
    /// Text of View::all_messages() when the user closed them; they stay hidden until it changes.
    std::string closed_messages;
    std::string state_folder; // folder of files kept between runs; empty: none are kept
    OpenDialog dialog = OpenDialog::None;
    FileBrowser browser;
    StartPage start;
    PictureSettings picture;
    FilmExport film;
    CameraBookmarks bookmarks;
    ContactSheet sheet;
    bool has_open_list = false; // a list of a panel or dialog is open
    std::string save_failure;   // why saving failed in the dialog about unsaved changes
    SourcePane source;
    Editors editors;
    WindowLook look;
    std::uint32_t window_width = 0; // pixels
    std::uint32_t window_height = 0;
    std::function<void()> wake; // called on any thread when `film` has an outcome
    AddImage add_image;         // empty: pictures are not shown
};

/// A row of the list of keys that the window shows.
struct KeyHelp {
    const char* keys;
    const char* what;
};
inline constexpr auto kStartKeys = std::to_array<KeyHelp>({
    {"Arrows", "Select a sample or a recent file"},
    {"Letters", "Select a sample by a part of its name"},
    {"Enter", "Open it"},
    {"Ctrl+O", "Open another file"},
    {"F1", "This list"},
    {"Ctrl+Q", "Quit"},
});
inline constexpr auto kPlantKeys = std::to_array<KeyHelp>({
    {"Left drag", "Orbit"},
    {"Click", "Describe the module and the production that wrote it"},
    {"T", "Trace of the module: why written, next step, back to the axiom"},
    {"Right drag", "Pan"},
    {"Wheel", "Zoom; speed while flying"},
    {"F", "Frame all"},
    {"1, 2, 3", "View from the front, the side, the top"},
    {"Tab", "Fly: look with the mouse, move with W A S D Q E, Shift: faster"},
    {"C", "Copy the camera as text"},
    {"Ctrl+1 to 9, Alt+1 to 9", "Keep a camera, go to it"},
    {"W", "Wireframe"},
    {"I", "Surfaces"},
    {"L", "Lines: none, skeleton, turtle path"},
    {"V", "Person of 1.8 m as a scale"},
    {"S", "Shadows"},
    {"G", "Ground"},
    {"O, Y, X, D", "Senses: obstacles, light, markers, directions"},
    {"Shift+drag", "Move an obstacle; the plant grows again"},
    {"B", "Simulate gravity and wind"},
    {"Space", "Play or pause growth"},
    {"PageUp", "Next generation"},
    {"PageDown", "Previous generation"},
    {"N", "Next seed"},
    {"K", "Contact sheet: nine seeds, or values of constants"},
    {"R", "Reload files"},
    {"Ctrl+Z, Ctrl+Y", "Undo, redo a change of settings"},
    {"Ctrl+S", "Write constants, settings and seed to the file"},
    {"P, Shift+P", "Picture or film; at once a PNG in the current folder"},
    {"E", "Export to a file of another program"},
    {"H", "Panels"},
    {"A", "Statistics"},
    {"M", "Close or show the messages"},
    {"U", "Source of the grammar"},
    {"F8, Shift+F8", "Next, previous message in the source"},
    {"Ctrl+Enter", "Apply the fix of the selected line of the source"},
    {"Ctrl+E", "Open the selected line, the clicked part or the message in the editor"},
    {"F1", "Keys"},
    {"F6", "Keyboard to the next panel, then to the picture"},
    {"in a panel", "Arrows: controls, Tab: fields, Enter or Space: use, Esc: picture"},
    {"Esc", "Cancel what is being made; close the keys, stop flying"},
    {"Ctrl+Q", "Quit"},
    {"Ctrl+O", "Open a file"},
    {"Alt+Left, Alt+Right", "Previous, next file of the folder"},
    {"Drop a file", "Open it"},
});

inline constexpr auto kForestKeys = std::to_array<KeyHelp>({
    {"Left drag", "Orbit; with a tool: paint, Shift: erase"},
    {"Click", "Without a tool: describe the branch and its production"},
    {"Right drag", "Pan; with a tool: orbit"},
    {"Middle drag", "Pan"},
    {"Wheel", "Zoom; speed while flying"},
    {"F", "Frame all"},
    {"1, 2, 3", "View from the front, the side, the top"},
    {"Tab", "Fly: look with the mouse, move with W A S D Q E, Shift: faster"},
    {"C", "Copy the camera as text"},
    {"Ctrl+1 to 9, Alt+1 to 9", "Keep a camera, go to it"},
    {"Shift+drag", "Without a tool: move an obstacle; the plants grow again"},
    {"B", "Brush"},
    {"O", "Single tree"},
    {"X", "Eraser"},
    {"PageUp", "Larger brush; without a tool: next year"},
    {"PageDown", "Smaller brush; without a tool: previous year"},
    {"Ctrl+Z", "Undo a stroke or a change of settings"},
    {"Ctrl+Y", "Redo"},
    {"Ctrl+S", "Save painted trees in the scene file"},
    {"Space", "Play or pause the years"},
    {"W", "Wireframe"},
    {"V", "Person of 1.8 m as a scale"},
    {"S", "Shadows"},
    {"L", "Colours of branches: natural, id, age, hero"},
    {"N", "Next key: another forest"},
    {"R", "Reload files"},
    {"P, Shift+P", "Picture or film; at once a PNG in the current folder"},
    {"H, A", "Panels, statistics"},
    {"M", "Close or show the messages"},
    {"U", "Source of the grammars"},
    {"F8, Shift+F8", "Next, previous message in the source"},
    {"Ctrl+E", "Open the selected line, the clicked part or the message in the editor"},
    {"F1", "Keys"},
    {"F6", "Keyboard to the next panel, then to the picture"},
    {"in a panel", "Arrows: controls, Tab: fields, Enter or Space: use, Esc: picture"},
    {"Esc", "Cancel what is being made; put the tool away, close the keys, stop flying"},
    {"Ctrl+Q", "Quit"},
    {"Ctrl+O", "Open a file"},
    {"Alt+Left, Alt+Right", "Previous, next file of the folder"},
    {"Drop a file", "Open it: a scene or a grammar"},
});

class Controls {
public:
    /// Applies input to the view that is shown. `seconds`: time since the last call. `area`: the
    /// part of the window that the picture fills, in pixels from the lower left corner of the
    /// window.
    void apply(const WindowInput& input,
               double seconds,
               const PixelArea& area,
               ViewSwitcher& switcher,
               PanelState& panels);
    /// Applies input to a plant. `height`: height of the picture, pixels.
    void apply(const WindowInput& input,
               double seconds,
               float height,
               PlantView& view,
               PanelState& panels);
    /// Applies input to a forest.
    void apply(const WindowInput& input,
               double seconds,
               const PixelArea& area,
               ForestView& view,
               PanelState& panels);
    /// Moves the obstacle that the user grabs with Shift and the left button. Returns whether an
    /// obstacle was held.
    [[nodiscard]] static bool
    move_obstacle(const WindowInput& input, const PixelArea& area, PlantView& view);
    [[nodiscard]] static bool
    move_obstacle(const WindowInput& input, const PixelArea& area, ForestView& view);
    /// Whether held keys may move the camera.
    [[nodiscard]] bool is_moving() const { return is_moving_; }

private:
    /// Passes input to the open dialog or to the start page. Returns whether one of them is shown.
    [[nodiscard]] static bool
    use_pages(const WindowInput& input, ViewSwitcher& switcher, PanelState& panels);
    /// press_in_page() handles a key in the start page or in a dialog, press_in_browser() in the
    /// dialog that opens a file. If the key chooses a file to open, they set `chosen` to its path.
    static void press_in_page(const KeyPress& press,
                              ViewSwitcher& switcher,
                              PanelState& panels,
                              std::string& chosen);
    static void press_in_browser(const KeyPress& press, PanelState& panels, std::string& chosen);
    /// Camera bookmarks (Alt and a digit), and the next or previous file (Alt and an arrow).
    static void press_with_alt(Key key, ViewSwitcher& switcher, PanelState& panels);
    /// Passes input to the view: keys, tools, picking and motion of the camera.
    void apply_to_view(const WindowInput& input,
                       double seconds,
                       const PixelArea& area,
                       ViewSwitcher& switcher,
                       PanelState& panels);
    void press(const KeyPress& press, PlantView& view, PanelState& panels);
    void press(const KeyPress& press, ForestView& view, PanelState& panels);
    /// Handles a key that has the same meaning in all views; returns whether `press` is such a key.
    [[nodiscard]] static bool press_common(const KeyPress& press, View& view, PanelState& panels);
    /// Picks the part under the mouse if the left button was pressed and released at one place.
    void click(const WindowInput& input, const PixelArea& area, View& view);
    /// Passes presses, moves and releases of the mouse to the paint tool.
    void use_tool(const WindowInput& input, const PixelArea& area, ForestView& view);
    void fly(const WindowInput& input, float seconds, float height, Camera& camera);

    float speed_ = 1.0F; // factor of the speed of flying
    bool is_moving_ = false;
    // Window pixel where the left button was pressed; empty once the mouse has moved from there.
    std::optional<glm::vec2> pressed_;
};

/// Opens a place in the editor and reports this in a note.
void open_in_editor(const FilePosition& place, View& view, PanelState& panels);
/// Opens the dialog that opens a file, in the folder of the file shown.
void show_open_dialog(const View& view, PanelState& panels);
/// Opens the dialog for a picture, with a file name that is not in use.
void show_picture_dialog(const View& view, PanelState& panels);
/// Writes the picture, or begins to write the film, that panels.picture describes; reports errors
/// in a note.
void take_picture(View& view, PanelState& panels);
/// Opens the dialog for the export of a plant.
void show_export_dialog(PanelState& panels);
/// Begins to write the file that the export dialog describes; reports the result in a note.
void export_shown(PlantView& view, PanelState& panels);

/// An answer to the question about unsaved changes.
enum class UnsavedAnswer : std::uint8_t { Save, Discard, Cancel };
/// Carries out the answer. If saving fails, the dialog stays open and shows the reason.
void answer_unsaved(UnsavedAnswer answer, ViewSwitcher& switcher, PanelState& panels);
/// Opens the dialog about unsaved changes if a request of ViewSwitcher::leaving() waits for an
/// answer.
void ask_about_unsaved(const ViewSwitcher& switcher, PanelState& panels);
/// Shows the contact sheet of the plant; if there is no plant, reports this in a note.
void show_sheet(PlantView& view, PanelState& panels);
void close_sheet(PanelState& panels);
/// Sets the values of a cell of the sheet in the view, and closes the sheet; undo() restores the
/// old values.
void take_from_sheet(std::size_t cell, PlantView& view, PanelState& panels);
/// Increments the plant's seed.
void next_seed(PlantView& view);
/// Shows the next generation if `step` is above 0, else the previous generation, and pauses growth.
void step_generations(PlantView& view, int step);
/// Increments the forest's key.
void next_forest_key(ForestView& view);

} // namespace lsys::view
