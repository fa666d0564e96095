// SPDX-License-Identifier: MIT
#include "grammar/dialects/cpfg/view_files.h"

#include "grammar/ast/folder_list.h"
#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/paths.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace lsys {

namespace {

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    while (true) {
        line = trimmed(line, kWhitespace);
        if (line.empty()) {
            return words;
        }
        words.push_back(line.substr(0, line.find_first_of(kWhitespace)));
        line.remove_prefix(words.back().size());
    }
}

/// Whether the name is that of a file of materials or of a colour map.
bool holds_colours(std::string_view name) {
    return name.ends_with(".mat") || name.ends_with(".map");
}

/// The names of files in the command line of `specifications` that draws the model.
struct Named {
    std::string view;
    std::string colours;
};
Named read_specifications(std::string_view text, std::string_view model) {
    Named named;
    while (!text.empty()) {
        const std::vector<std::string_view> words = words_of(take_line(text));
        const bool draws =
            std::any_of(words.begin(), words.end(),
                        [](std::string_view word) { return word.ends_with("cpfg"); }) &&
            std::find(words.begin(), words.end(), model) != words.end();
        if (!draws) {
            continue;
        }
        for (const std::string_view word : words) {
            named.view = word.ends_with(".v") ? word : std::string_view(named.view);
            named.colours = holds_colours(word) ? word : std::string_view(named.colours);
        }
        return named;
    }
    return named;
}

/// The only file of the folder for which `fits` is true; else empty.
template <typename Fits>
std::string only_file(std::string_view names, const Fits& fits) {
    std::string found;
    while (!names.empty()) {
        const std::string_view name = take_line(names);
        if (!fits(name)) {
            continue;
        }
        if (!found.empty()) {
            return {};
        }
        found = name;
    }
    return found;
}

} // namespace

CpfgFiles find_cpfg_files(std::string_view path, const ParseContext& context) {
    CpfgFiles files;
    const auto load_view = [&](const std::string& view) {
        Result<std::string> text = context.load(view);
        if (text) {
            files.has_view = true;
            files.view_path = view;
            files.view = std::move(text).value();
        }
        return files.has_view;
    };
    const std::string folder(folder_of_path(path));
    const std::string_view name = name_of_path(path);
    const auto specifications = context.load(folder + "specifications");
    const Named named =
        specifications ? read_specifications(specifications.value(), name) : Named{};
    const auto listed = context.load(list_of(folder));
    const std::string_view names = listed ? std::string_view(listed.value()) : "";
    const std::string_view stem = name.substr(0, std::min(name.rfind('.'), name.size()));
    if (!context.view.empty()) {
        if (!load_view(std::string(context.view))) {
            context.diagnostics.add(DiagnosticCode::ForeignValue, {},
                                    "the view file `" + shown(context.view) + "` cannot be read");
        }
    } else if ((named.view.empty() || !load_view(folder + named.view)) &&
               !load_view(folder + std::string(stem) + ".v") && !load_view(folder + "view.v")) {
        const std::string only =
            only_file(names, [](std::string_view each) { return each.ends_with(".v"); });
        static_cast<void>(!only.empty() && load_view(folder + only));
    }
    std::string colours = named.colours.empty() ? only_file(names, holds_colours) : named.colours;
    if (!colours.empty()) {
        Result<std::string> bytes = context.load(folder + colours);
        files.colours_path = std::move(colours);
        files.colours = bytes ? std::move(bytes).value() : "";
    }
    return files;
}

} // namespace lsys
