#include "grammar/dialects/dialect.h"

#include "grammar/base/contract.h"
#include "grammar/dialects/carey/frontend.h"
#include "grammar/dialects/cpfg/frontend.h"
#include "grammar/dialects/fractint/frontend.h"
#include "grammar/dialects/houdini/frontend.h"
#include "grammar/dialects/l3d/frontend.h"
#include "grammar/dialects/sys/frontend.h"

#include <algorithm>
#include <array>

namespace lsys {

namespace {

using Translate = Translation (*)(FileId root, const ParseContext& context);
/// What in a text tells the dialect; empty: nothing does.
using Recognise = std::string_view (*)(std::string_view text);
using SystemsIn = std::vector<std::string> (*)(std::string_view text);

/// Everything that is known of a dialect.
struct Entry {
    DialectRow row;
    Recognise recognise = nullptr;
    Translate translate = nullptr;
    SystemsIn systems = nullptr; // where a file may hold several
};

/// In order of Dialect. Content is asked in this order too.
constexpr std::array<Entry, 8> kEntries{{
    {{Dialect::Lsys, "lsys", "lsys", ".lsys"}, nullptr, nullptr},
    {{Dialect::Sys, "sys", "the .sys forest", ".sys"}, recognise_sys, translate_sys},
    {{Dialect::Houdini, "houdini", "Houdini's rules", ".hlsys"},
     recognise_houdini,
     translate_houdini},
    {{Dialect::Carey, "carey", "Carey's rule list", ".rules"}, recognise_carey, translate_carey},
    {{Dialect::Cpfg, "cpfg", "a cpfg L-system", ""}, recognise_cpfg, translate_cpfg},
    {{Dialect::Fractint, "fractint", "a Fractint collection", ""},
     recognise_fractint,
     translate_fractint,
     systems_in_fractint},
    {{Dialect::L3d, "l3d", "L3D", ".l3d .l"}, recognise_l3d, translate_l3d},
    {{Dialect::Lplus, "lplus", "L+System", ".l++"}, recognise_l3d, translate_lplus},
}};

constexpr auto kRows = [] {
    std::array<DialectRow, kEntries.size()> rows{};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i] = kEntries[i].row;
    }
    return rows;
}();

bool has_extension(std::string_view path, std::string_view extensions) {
    while (!extensions.empty()) {
        const std::size_t end = std::min(extensions.find(' '), extensions.size());
        if (path.ends_with(extensions.substr(0, end))) {
            return true;
        }
        extensions.remove_prefix(std::min(end + 1, extensions.size()));
    }
    return false;
}

} // namespace

std::span<const DialectRow> dialects() {
    return kRows;
}

const DialectRow& row_of(Dialect dialect) {
    return kRows[static_cast<std::size_t>(dialect)];
}

std::optional<Dialect> find_dialect(std::string_view name) {
    for (const DialectRow& row : kRows) {
        if (row.name == name) {
            return row.dialect;
        }
    }
    return std::nullopt;
}

DetectedDialect detect_dialect(std::string_view path, std::string_view text) {
    // Nothing but .lsys has this name, and a file of it may hold anything in a comment.
    if (has_extension(path, row_of(Dialect::Lsys).extensions)) {
        return {Dialect::Lsys, "its name"};
    }
    // Of dialects that are the same by content, the extension tells.
    DetectedDialect found;
    for (const Entry& entry : kEntries) {
        if (entry.recognise == nullptr ||
            (found.dialect && !has_extension(path, entry.row.extensions))) {
            continue;
        }
        if (const std::string_view by = entry.recognise(text); !by.empty()) {
            found = {entry.row.dialect, by};
        }
    }
    if (found.dialect) {
        return found;
    }
    for (const DialectRow& row : kRows) {
        if (has_extension(path, row.extensions)) {
            return {row.dialect, "its name"};
        }
    }
    return {};
}

bool has_systems(Dialect dialect) {
    return kEntries[static_cast<std::size_t>(dialect)].systems != nullptr;
}

std::vector<std::string> systems_in(Dialect dialect, std::string_view text) {
    const Entry& entry = kEntries[static_cast<std::size_t>(dialect)];
    return entry.systems != nullptr ? entry.systems(text) : std::vector<std::string>();
}

Translation translate(FileId root, Dialect dialect, const ParseContext& context) {
    const Entry& entry = kEntries[static_cast<std::size_t>(dialect)];
    LSYS_CHECK(entry.translate != nullptr);
    Translation translation = entry.translate(root, context);
    static_cast<void>(translation.report_overflow(context.diagnostics));
    return translation;
}

Ast parse_dialect(FileId root, Dialect dialect, const ParseContext& context, std::string* text) {
    if (dialect == Dialect::Lsys) {
        return parse_lsys(root, context);
    }
    const Translation translation = translate(root, dialect, context);
    if (context.diagnostics.has_errors()) {
        Ast ast;
        ast.files.push_back({root, {}});
        ast.incomplete = true;
        return ast;
    }
    if (text != nullptr) {
        *text = translation.text();
    }
    return parse_translation(translation, context);
}

} // namespace lsys
