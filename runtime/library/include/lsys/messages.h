// SPDX-License-Identifier: MIT
// Messages: the diagnostics of a library call, for authors of grammars and for callers, as data and
// as text. Messages are values, and hold the source texts to which they refer.
#pragma once

#include <cstdint>
#include <lsys/api.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::LSYS_INTERFACE {

/// A range of characters of a file. Lines and columns count from 1; a column is a Unicode code
/// point. The end is exclusive.
struct Place {
    std::string file;
    std::uint32_t line = 0;
    std::uint32_t column = 0;
    std::uint32_t end_line = 0;
    std::uint32_t end_column = 0;
    std::uint32_t offset = 0; // bytes from the start of the text, a byte order mark not counted
    std::uint32_t end_offset = 0;
};

enum class Severity : std::uint8_t { Note, Warning, Error };

/// A further place of a diagnostic, with its text.
struct Label {
    Place place;
    std::string text;
};

/// A replacement of the text at `place`.
struct Edit {
    Place place;
    std::string replacement;
};

/// A repair: edits that do not overlap, applied together.
struct Fix {
    std::string title;
    std::vector<Edit> edits;
    /// Whether no other repair is plausible. Uncertain repairs need the consent of the author.
    bool certain = false;
};

/// One message. Messages about files and options have no code and no place.
struct Diagnostic {
    Severity severity = Severity::Error;
    std::string code; // stable name, `unknown-name`; `lsc explain CODE` explains it
    std::string message;
    std::optional<Place> place;
    std::string label; // text at the place; may be empty
    std::vector<Label> labels;
    std::vector<std::string> notes;
    std::vector<std::string> help;
    std::vector<Fix> fixes;
};

enum class MessageStyle : std::uint8_t {
    Frames,       // source lines with carets
    ColourFrames, // Frames with colours, for terminals
    Lines,        // file:line:column: severity: message [code]
    Json,         // one object per line
};

/// The messages of a call, in order.
class LSYS_API Messages {
public:
    Messages();
    Messages(const Messages&);
    Messages(Messages&&) noexcept;
    Messages& operator=(const Messages&);
    Messages& operator=(Messages&&) noexcept;
    ~Messages();

    /// All messages, at most 100,000.
    [[nodiscard]] const std::vector<Diagnostic>& all() const;
    [[nodiscard]] bool empty() const { return all().empty(); }
    [[nodiscard]] bool has_errors() const;
    [[nodiscard]] std::string text(MessageStyle style = MessageStyle::Frames) const;

    struct Data;
    explicit Messages(std::shared_ptr<const Data> data);

private:
    std::shared_ptr<const Data> data_; // never null
};

} // namespace lsys::LSYS_INTERFACE
