// SPDX-License-Identifier: MIT
// FileBrowser: the state of the dialog that opens a file: a folder, its entries, a typed text,
// which filters the entries or is a path, and a selected entry.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys::view {

struct FolderEntry {
    std::string name;
    bool is_folder = false;

    friend bool operator==(const FolderEntry&, const FolderEntry&) = default;
};

/// Whether lsview shows files with the extension of `path`: grammars of all dialects, compiled
/// grammars, scenes.
[[nodiscard]] bool can_open(std::string_view path);

/// Folders, then files that lsview can open, each in alphabetical order; without hidden files.
/// Empty if the folder cannot be read.
[[nodiscard]] std::vector<FolderEntry> list_folder(const std::string& folder);

/// The file that lies `step` places after `file` among the files of its folder that lsview can
/// open, in alphabetical order; the first file follows the last. Empty if the folder has no other
/// file.
[[nodiscard]] std::string neighbour_file(const std::string& file, int step);

class FileBrowser {
public:
    /// Shows a folder, which becomes absolute; empty: the current folder.
    void show(const std::string& folder);
    /// Shows the home folder of the user; the root folder if there is none.
    void go_home() { show(home_folder()); }
    /// Shows the parent folder and selects the folder that was shown.
    void go_up();

    [[nodiscard]] const std::string& folder() const { return folder_; }
    /// Entries that match the text. A text without `/` matches names that contain it; the case of
    /// ASCII letters does not matter. A text with `/` is a path from the shown folder, from `/` or
    /// from `~`: it matches names in the folder before its last `/` that begin with the text after
    /// this `/`.
    [[nodiscard]] const std::vector<FolderEntry>& entries() const { return entries_; }
    [[nodiscard]] std::size_t selected() const { return selected_; }
    [[nodiscard]] const std::string& text() const { return text_; }
    /// Why accept() opened nothing; empty after a change.
    [[nodiscard]] const std::string& mistake() const { return mistake_; }

    void set_text(const std::string& text);
    /// Removes the last character of the text, in UTF-8; if the text is empty, goes to the parent
    /// folder.
    void erase_character();
    /// Completes the name after the last `/` of the text: appends the characters that all entries
    /// beginning with this name have in common; a single entry is completed to its whole name.
    void complete();
    /// Moves the selection; stops at both ends.
    void move(int steps);
    void select(std::size_t entry) { selected_ = entry; }
    /// Whether the list must be scrolled to the selection: true once after each change by keys.
    [[nodiscard]] bool take_scroll_request() { return std::exchange(wants_scroll_, false); }
    /// If a folder is selected, enters it and returns an empty path. Else returns the path of the
    /// selected file, or of the file that the text names. If there is neither, sets mistake().
    [[nodiscard]] std::string accept();

private:
    [[nodiscard]] static std::string home_folder();
    /// The folder that the text names.
    [[nodiscard]] std::string listed_folder() const;
    void filter(); // sets entries_; reads another folder if the text names one

    std::string folder_;
    std::string text_;
    std::string mistake_;
    std::string read_folder_;          // the folder of all_
    std::vector<FolderEntry> all_;     // all entries of read_folder_
    std::vector<FolderEntry> entries_; // the entries of all_ that match text_
    std::size_t selected_ = 0;         // index in entries_
    bool wants_scroll_ = false;
};

} // namespace lsys::view
