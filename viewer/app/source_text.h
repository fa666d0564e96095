// SPDX-License-Identifier: MIT
// SourceText: the files of the shown grammar or scene, with all that the source pane draws: tokens,
// statements, messages and their fixes. Made on another thread after each load.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/names/source_tokens.h"
#include "runtime/pipeline/file_position.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/run_options.h"
#include "viewer/app/latest_request_worker.h"
#include "viewer/app/styled_text.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::view {

inline constexpr std::uint32_t kPaneTabStop = 4; // columns, as in messages on a terminal

/// The colour of the first words of a message.
[[nodiscard]] TextColour severity_colour(Severity severity);

struct SourceFix {
    std::string title;
    bool is_certain = false;                        // `lsc check --fix` applies it
    std::string refusal;                            // why it cannot be applied here; else empty
    std::vector<TextLine> preview;                  // the changed lines after the fix
    std::map<std::string, std::vector<Edit>> edits; // by path, ascending
};

/// A diagnostic in a file. `text` has the rows that `lsc check` prints below the source line.
struct SourceMessage {
    Severity severity = Severity::Error;
    std::uint32_t line = 1;
    std::uint32_t column = 1;
    std::uint32_t begin = 0; // marked bytes of the line; `end` is at most its size
    std::uint32_t end = 0;
    std::string label;          // text beside the marked bytes
    std::vector<TextLine> text; // severity, message and code; places, notes and help
    std::vector<SourceFix> fixes;
};

struct ShownSource {
    std::string path;
    const SourceFile* file = nullptr; // in SourceText::sources; not null
    std::vector<SourceToken> tokens;
    std::vector<SourceSpan> statements;  // ascending
    std::vector<SourceMessage> messages; // sorted by line
    std::uint32_t columns = 0;           // number of columns of the longest line
};

/// A range of lines, counted from 1, with both ends.
struct LineRange {
    std::uint32_t first = 0; // 0: an empty range
    std::uint32_t last = 0;
};

struct SourceText {
    SourceMap sources;
    std::vector<ShownSource> files; // the grammar or scene comes first
    std::string failure;            // reason why there are no files
    /// The bytes that `lsc check --fix` would write, by path. Empty if there is no certain fix.
    std::map<std::string, std::string> fixed;
    std::size_t fix_count = 0; // count of the certain fixes in `fixed`

    /// Index of the file with this path; nullopt if the file is not shown.
    [[nodiscard]] std::optional<std::size_t> find(std::string_view path) const;
};

/// Lines of the statement at a place; the line of the place if there is no statement.
[[nodiscard]] LineRange
statement_at(const ShownSource& source, std::uint32_t line, std::uint32_t column);

/// The bytes of a file.
[[nodiscard]] std::string file_bytes(const SourceFile& file);
/// The bytes of `file` after the edits of a fix.
[[nodiscard]] std::string edited_bytes(const SourceFile& file, const std::vector<Edit>& edits);

/// The sources of a load. Texts that the load has read are used; other files are read from disk.
struct LoadedSources {
    std::string file;                         // grammar or scene
    std::vector<std::string> files;           // further grammars of a scene
    std::shared_ptr<const SourceMap> sources; // of a plant; null if it has errors
    std::shared_ptr<const Messages> messages; // messages of the load
    GrammarOptions options;                   // of a plant
    RunOptions run;
    bool is_forest = false;
};

struct SourceRequest {
    LoadedSources loaded;
    // Fields for LatestRequestWorker.
    SteadyClock::time_point changed_at;
    bool is_repeat = false;
};

[[nodiscard]] std::shared_ptr<const SourceText>
make_source_text(const SourceRequest& request, const std::atomic<bool>& cancelled);

using SourceWorker = LatestRequestWorker<SourceRequest, std::shared_ptr<const SourceText>>;

} // namespace lsys::view
