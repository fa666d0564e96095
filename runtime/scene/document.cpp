#include "runtime/scene/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

// Header-only, and compiled here alone.
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

namespace lsys {

namespace {

/// Bytes of the character that `text` begins with; `text` is UTF-8 as far as anything was read.
std::uint32_t character_length(std::string_view text) {
    std::uint32_t length = 1;
    while (length < text.size() && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) {
        ++length;
    }
    return length;
}

/// toml++ counts lines and code points from 1.
class Places {
public:
    Places(FileId file, const SourceFile& source) : file_(file), source_(source) {}

    [[nodiscard]] std::uint32_t offset(const toml::source_position& at) {
        if (at.line == 0) {
            return 0;
        }
        if (at.line != line_) {
            read_line(at.line);
        }
        return offsets_[std::min<std::size_t>(at.column - 1, offsets_.size() - 1)];
    }

    [[nodiscard]] SourceSpan span(const toml::source_region& region) {
        const std::uint32_t begin = offset(region.begin);
        return {file_, begin, std::max(begin, offset(region.end))};
    }

private:
    void read_line(std::uint32_t line) {
        line_ = line;
        offsets_.clear();
        const std::uint32_t shown = std::min(line, source_.line_count());
        std::uint32_t at = source_.line_begin(shown);
        const std::uint32_t end = at + static_cast<std::uint32_t>(source_.line_text(shown).size());
        while (at < end) {
            offsets_.push_back(at);
            at += character_length(source_.text().substr(at, end - at));
        }
        offsets_.push_back(end);
    }

    FileId file_;
    const SourceFile& source_;
    std::uint32_t line_ = 0;             // of offsets_
    std::vector<std::uint32_t> offsets_; // of its characters, and of its end
};

SceneValue convert(const toml::node& node, Places& places);

void convert_table(const toml::table& table, Places& places, SceneValue& value) {
    std::vector<std::pair<const toml::key*, const toml::node*>> entries;
    for (auto&& [key, child] : table) {
        entries.emplace_back(&key, &child);
    }
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
        const toml::source_position& first = a.first->source().begin;
        const toml::source_position& second = b.first->source().begin;
        return std::pair(first.line, first.column) < std::pair(second.line, second.column);
    });
    for (const auto& [key, child] : entries) {
        const SourceSpan span = places.span(key->source());
        value.entries.push_back({std::string(key->str()), span, convert(*child, places)});
    }
}

SceneValue convert(const toml::node& node, Places& places) {
    SceneValue value;
    value.span = places.span(node.source());
    switch (node.type()) {
    case toml::node_type::table:
        value.kind = SceneValueKind::Table;
        convert_table(*node.as_table(), places, value);
        break;
    case toml::node_type::array:
        value.kind = SceneValueKind::List;
        for (const toml::node& item : *node.as_array()) {
            value.items.push_back(convert(item, places));
        }
        break;
    case toml::node_type::string:
        value.kind = SceneValueKind::Text;
        value.text = node.as_string()->get();
        break;
    case toml::node_type::integer:
        value.kind = SceneValueKind::Whole;
        value.whole = node.as_integer()->get();
        value.real = static_cast<double>(value.whole);
        break;
    case toml::node_type::floating_point:
        value.kind = SceneValueKind::Real;
        value.real = node.as_floating_point()->get();
        break;
    case toml::node_type::boolean:
        value.kind = SceneValueKind::Truth;
        break;
    default:
        value.kind = SceneValueKind::Date;
        break;
    }
    return value;
}

/// toml++ says "Error while parsing WHAT: REASON", and 'x' where our messages have `x`.
struct Complaint {
    std::string what; // a string, a key-value pair; may be empty
    std::string reason;
};

Complaint complaint_of(std::string_view description) {
    constexpr std::string_view kPrefix = "Error while parsing ";
    Complaint complaint;
    if (description.starts_with(kPrefix)) {
        const std::size_t colon = description.find(": ");
        if (colon != std::string_view::npos) {
            complaint.what = description.substr(kPrefix.size(), colon - kPrefix.size());
            description.remove_prefix(colon + 2);
        }
    }
    complaint.reason = description;
    std::replace(complaint.reason.begin(), complaint.reason.end(), '\'', '`');
    if (!complaint.reason.empty() && complaint.reason[0] == 'E') {
        complaint.reason[0] = 'e';
    }
    return complaint;
}

void report_syntax(const toml::parse_error& error, Places& places, Diagnostics& diagnostics) {
    const Complaint complaint = complaint_of(error.description());
    const bool at_end = complaint.reason == "encountered end-of-file";
    const std::string article =
        complaint.what.find_first_of("aeiou") == 0 ? std::string("an ") : std::string("a ");
    Diagnostic& diagnostic =
        diagnostics.add(DiagnosticCode::SceneSyntax, places.span(error.source()),
                        at_end && !complaint.what.empty()
                            ? fmt::format("the file ends within {}{}", article, complaint.what)
                            : complaint.reason);
    if (!at_end && !complaint.what.empty()) {
        diagnostic.notes.push_back(fmt::format("while reading {}{}", article, complaint.what));
    }
    if (complaint.reason.starts_with("cannot redefine existing table")) {
        diagnostic.help.emplace_back(
            "a table stands once; another species begins with `[[species]]`");
    } else if (complaint.reason.starts_with("cannot redefine")) {
        diagnostic.help.emplace_back("a key stands once in its table");
    } else if (complaint.reason.starts_with("expected `true`") ||
               complaint.reason.starts_with("expected `false`") ||
               complaint.reason.starts_with("could not determine value type")) {
        diagnostic.help.emplace_back("a text stands in quotes: `kind = \"noise\"`");
    }
}

} // namespace

std::string_view kind_text(SceneValueKind kind) {
    switch (kind) {
    case SceneValueKind::Table:
        return "a table";
    case SceneValueKind::List:
        return "a list";
    case SceneValueKind::Text:
        return "a text";
    case SceneValueKind::Whole:
        return "a whole number";
    case SceneValueKind::Real:
        return "a number with a fraction";
    case SceneValueKind::Truth:
        return "a truth value";
    case SceneValueKind::Date:
        return "a date or time";
    }
    return "a value";
}

const SceneEntry* find_entry(const SceneValue& table, std::string_view key) {
    const auto found = std::find_if(table.entries.begin(), table.entries.end(),
                                    [&](const SceneEntry& entry) { return entry.key == key; });
    return found == table.entries.end() ? nullptr : &*found;
}

std::optional<SceneValue>
read_toml(FileId file, const SourceMap& sources, Diagnostics& diagnostics) {
    const SourceFile& source = sources.file(file);
    Places places(file, source);
    const toml::parse_result result = toml::parse(source.text());
    if (!result) {
        report_syntax(result.error(), places, diagnostics);
        return std::nullopt;
    }
    return convert(result.table(), places);
}

} // namespace lsys
