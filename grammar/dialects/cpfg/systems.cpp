// SPDX-License-Identifier: MIT
#include "grammar/dialects/cpfg/systems.h"

#include "grammar/base/characters.h"
#include "grammar/dialects/impl/frontends.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <optional>

namespace lsys {

namespace {

/// The text after `Lsystem:`; nullopt if the line does not begin so.
std::optional<std::string_view> label_of(std::string_view line) {
    constexpr std::size_t kLength = std::string_view("Lsystem").size();
    line = trimmed(line, kWhitespace);
    if (!line.starts_with("Lsystem") && !line.starts_with("lsystem")) {
        return std::nullopt;
    }
    line = trimmed(line.substr(kLength), kWhitespace);
    return line.starts_with(':') ? std::optional(trimmed(line.substr(1), kWhitespace))
                                 : std::nullopt;
}

} // namespace

std::vector<CpfgSystem> cpfg_systems(std::string_view text) {
    std::vector<CpfgSystem> systems;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = text.substr(at, end - at);
        const auto label = label_of(line);
        if (label && !line.starts_with('\t')) { // a tab continues the line before
            if (!systems.empty()) {
                systems.back().end = at;
            }
            systems.push_back({std::string(*label), at, text.size()});
        }
        at = end + 1;
    }
    return systems;
}

std::vector<std::string> systems_in_cpfg(std::string_view text) {
    std::vector<std::string> names;
    for (CpfgSystem& system : cpfg_systems(text)) {
        names.push_back(std::move(system.name));
    }
    return names;
}

} // namespace lsys
