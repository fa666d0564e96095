// SPDX-License-Identifier: MIT
#include "tests/manual/markdown.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <sstream>

namespace lsys::tests {

namespace {

constexpr std::string_view kFence = "```";

std::vector<std::string> lines_of(std::string_view document) {
    std::vector<std::string> lines;
    std::istringstream in{std::string(document)};
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    return lines;
}

/// For each line, whether it belongs to a fence; the lines with ``` do.
std::vector<bool> fenced(const std::vector<std::string>& lines) {
    std::vector<bool> is_code(lines.size());
    bool open = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const bool is_fence = lines[i].starts_with(kFence);
        is_code[i] = open || is_fence;
        open = open != is_fence;
    }
    return is_code;
}

/// The line, with code (`...`) replaced by blanks.
std::string without_code(std::string_view line) {
    std::string text(line);
    for (std::size_t at = text.find('`'); at != std::string::npos; at = text.find('`', at)) {
        const std::size_t end = std::min(text.find_first_not_of('`', at), text.size());
        const std::string ticks = text.substr(at, end - at);
        std::size_t close = text.find(ticks, end);
        // A longer sequence of back quotes does not close the code.
        while (close != std::string::npos && close + ticks.size() < text.size() &&
               text[close + ticks.size()] == '`') {
            close = text.find(ticks, text.find_first_not_of('`', close));
        }
        if (close == std::string::npos) {
            at = end;
            continue;
        }
        std::fill(text.begin() + static_cast<std::ptrdiff_t>(at),
                  text.begin() + static_cast<std::ptrdiff_t>(close + ticks.size()), ' ');
    }
    return text;
}

std::string anchor_of(std::string_view heading) {
    std::string anchor;
    bool in_target = false; // in the target of a link; targets are not part of the anchor
    for (std::size_t i = 0; i < heading.size(); ++i) {
        const char c = heading[i];
        if (c == ']' && i + 1 < heading.size() && heading[i + 1] == '(') {
            in_target = true;
        }
        const auto byte = static_cast<unsigned char>(c);
        if (in_target) {
            in_target = c != ')';
        } else if (c == ' ') {
            anchor += '-';
        } else if (byte >= 0x80 || std::isalnum(byte) != 0 || c == '-' || c == '_') {
            anchor += static_cast<char>(std::tolower(byte));
        }
    }
    return anchor;
}

void find_targets(std::string_view text,
                  std::string_view before,
                  char after,
                  std::size_t line,
                  std::vector<Link>& links) {
    for (std::size_t at = text.find(before); at != std::string_view::npos;
         at = text.find(before, at)) {
        at += before.size();
        std::string target(text.substr(at, text.find(after, at) - at));
        target = target.substr(0, target.find(' ')); // a title may follow
        links.push_back({line, target});
    }
}

} // namespace

std::filesystem::path source_root() {
    return LSYS_SOURCE_DIR;
}

std::vector<std::filesystem::path> all_documents() {
    std::vector<std::filesystem::path> documents;
    const std::filesystem::path root = source_root();
    auto walk = std::filesystem::recursive_directory_iterator(root);
    for (auto entry = begin(walk); entry != end(walk); ++entry) {
        const std::string name = entry->path().filename().string();
        if (entry->is_directory() &&
            (name == "build" || name == "node_modules" || name == ".git")) {
            entry.disable_recursion_pending();
        } else if (entry->path().extension() == ".md") {
            documents.push_back(entry->path().lexically_relative(root));
        }
    }
    std::sort(documents.begin(), documents.end());
    return documents;
}

std::string Fence::text() const {
    std::string text;
    for (const std::string& each : lines) {
        text += each + '\n';
    }
    return text;
}

std::vector<Fence> fences_of(std::string_view document) {
    std::vector<Fence> fences;
    bool open = false;
    std::size_t number = 0;
    for (const std::string& line : lines_of(document)) {
        ++number;
        if (line.starts_with(kFence)) {
            open = !open;
            if (open) {
                fences.push_back({number, line.substr(kFence.size()), {}});
            }
        } else if (open) {
            fences.back().lines.push_back(line);
        }
    }
    return fences;
}

std::vector<Heading> headings_of(std::string_view document) {
    const std::vector<std::string> lines = lines_of(document);
    const std::vector<bool> is_code = fenced(lines);
    std::vector<Heading> headings;
    std::map<std::string, std::size_t> seen;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::size_t level = std::min(lines[i].find_first_not_of('#'), lines[i].size());
        if (is_code[i] || level == 0 || level > 6 || lines[i].substr(level, 1) != " ") {
            continue;
        }
        const std::string text = lines[i].substr(level + 1);
        std::string anchor = anchor_of(text);
        const std::size_t before = seen[anchor]++;
        anchor += before == 0 ? "" : "-" + std::to_string(before);
        headings.push_back({i + 1, text, anchor});
    }
    return headings;
}

std::vector<Link> links_of(std::string_view document) {
    const std::vector<std::string> lines = lines_of(document);
    const std::vector<bool> is_code = fenced(lines);
    std::vector<Link> links;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (is_code[i]) {
            continue;
        }
        const std::string text = without_code(lines[i]);
        find_targets(text, "](", ')', i + 1, links);
        find_targets(text, "src=\"", '"', i + 1, links);
        find_targets(text, "href=\"", '"', i + 1, links);
        if (const std::size_t colon = text.find("]: "); text.starts_with('[')) {
            if (colon != std::string::npos) {
                links.push_back({i + 1, text.substr(colon + 3)});
            }
        }
    }
    return links;
}

std::vector<ProseLine> prose_of(std::string_view document) {
    const std::vector<std::string> lines = lines_of(document);
    const std::vector<bool> is_code = fenced(lines);
    std::vector<ProseLine> prose;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string& line = lines[i];
        if (!is_code[i] && !line.starts_with('|') && !line.starts_with("    ") &&
            !line.starts_with('#') && !line.starts_with("[![") && !line.starts_with("![")) {
            prose.push_back({i + 1, line});
        }
    }
    return prose;
}

} // namespace lsys::tests
