// SPDX-License-Identifier: MIT
#include "grammar/dialects/impl/known_formats.h"

#include "grammar/base/characters.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace lsys {

namespace {

enum class Where : std::uint8_t { Nowhere, First, Begins, Ends, Holds };

/// A text that lines of a format begin with, end with or hold; First: the first line begins with
/// it.
struct Evidence {
    Where where = Where::Nowhere;
    std::string_view text;
};

struct Format {
    std::string_view name;
    std::size_t min_count = 1; // lines with evidence that are needed
    std::array<Evidence, 9> evidence{};
};

// In the order in which a text is tested: languages whose lines others may hold come last.
constexpr auto kFormats = std::to_array<Format>({
    {"SVG", 1, {{{Where::Begins, "<svg"}}}},
    {"HTML", 1, {{{Where::Begins, "<!DOCTYPE html"}, {Where::Begins, "<html"}}}},
    {"XML", 1, {{{Where::First, "<?xml"}, {Where::First, "<!DOCTYPE"}}}},
    {"a Python program",
     1,
     {{{Where::First, "#!/usr/bin/env python"}, {Where::First, "#!/usr/bin/python"}}}},
    {"a shell script",
     1,
     {{{Where::First, "#!/bin/sh"},
       {Where::First, "#!/bin/bash"},
       {Where::First, "#!/usr/bin/env bash"},
       {Where::First, "#!/usr/bin/env sh"}}}},
    {"a shell script",
     2,
     {{{Where::Begins, "echo "},
       {Where::Ends, "; then"},
       {Where::Ends, "; do"},
       {Where::Begins, "set -e"},
       {Where::Begins, "export "},
       {Where::Begins, "esac"}}}},
    {"a Rust program",
     2,
     {{{Where::Begins, "fn main()"},
       {Where::Begins, "use std::"},
       {Where::Begins, "let mut "},
       {Where::Begins, "pub fn "},
       {Where::Begins, "impl "},
       {Where::Holds, "println!("},
       {Where::Begins, "fn "},
       {Where::Begins, "#[derive("},
       {Where::Begins, "pub struct "}}}},
    {"a C++ program",
     2,
     {{{Where::Begins, "#include <iostream>"},
       {Where::Begins, "#include <vector>"},
       {Where::Begins, "#include <string>"},
       {Where::Holds, "std::"},
       {Where::Begins, "using namespace"},
       {Where::Begins, "template <"},
       {Where::Begins, "namespace "},
       {Where::Begins, "class "}}}},
    {"a JavaScript program",
     2,
     {{{Where::Begins, "const "},
       {Where::Begins, "let "},
       {Where::Begins, "var "},
       {Where::Holds, "=> {"},
       {Where::Holds, "console.log("},
       {Where::Holds, "require('"},
       {Where::Begins, "export "},
       {Where::Begins, "function "},
       {Where::Holds, " from '"}}}},
    {"a Lua program",
     2,
     {{{Where::Begins, "local "},
       {Where::Begins, "function "},
       {Where::Begins, "end"},
       {Where::Ends, " then"},
       {Where::Begins, "-- "},
       {Where::Holds, "require("}}}},
});

bool shows(const Evidence& evidence, std::string_view line, bool is_first) {
    switch (evidence.where) {
    case Where::Nowhere:
        return false;
    case Where::First:
        return is_first && line.starts_with(evidence.text);
    case Where::Begins:
        return line.starts_with(evidence.text);
    case Where::Ends:
        return line.ends_with(evidence.text);
    case Where::Holds:
        return line.find(evidence.text) != std::string_view::npos;
    }
    return false;
}

/// The first line with evidence of the format; nullopt if there are fewer than `min_count`.
std::optional<std::size_t> first_evidence(const Format& format,
                                          std::span<const std::string_view> lines) {
    std::size_t count = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const bool is_shown = std::ranges::any_of(
            format.evidence, [&](const Evidence& each) { return shows(each, lines[i], i == 0); });
        first = is_shown && count == 0 ? i : first;
        count += is_shown ? 1U : 0U;
    }
    return count >= format.min_count ? std::optional(first) : std::nullopt;
}

bool is_key(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) {
        return is_word_character(c) || c == '-' || c == '.';
    });
}

/// TOML: a heading `[name]` and values `key = value`. YAML: a first line `---`, or keys without
/// value and items `- item`.
std::optional<KnownFormat> find_configuration(std::span<const std::string_view> lines) {
    std::optional<std::size_t> heading;
    std::optional<std::size_t> open_key;
    std::size_t values = 0;
    std::size_t items = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string_view line = lines[i];
        const bool is_heading =
            line.starts_with('[') && line.ends_with(']') && is_key(line.substr(1, line.size() - 2));
        heading = is_heading && !heading ? i : heading;
        values += is_key(line.substr(0, line.find(" ="))) && line.find(" =") != line.npos ? 1U : 0U;
        const bool opens = line.ends_with(':') && is_key(line.substr(0, line.size() - 1));
        open_key = opens && !open_key ? i : open_key;
        items += line.starts_with("- ") ? 1U : 0U;
    }
    if (heading && values >= 2) {
        return KnownFormat{"TOML", *heading};
    }
    if (lines.front() == "---" || lines.front().starts_with("%YAML")) {
        return KnownFormat{"YAML", 0};
    }
    return open_key && items >= 2 ? std::optional(KnownFormat{"YAML", *open_key}) : std::nullopt;
}

} // namespace

std::optional<KnownFormat> find_known_format(std::span<const std::string_view> lines) {
    for (const Format& format : kFormats) {
        if (const std::optional<std::size_t> line = first_evidence(format, lines)) {
            return KnownFormat{format.name, *line};
        }
    }
    return find_configuration(lines);
}

std::optional<KnownFormat> find_plain_text(std::span<const std::string_view> lines) {
    constexpr std::size_t kMinRows = 3;
    constexpr std::ptrdiff_t kMinCommas = 2; // min number of commas of a row
    const auto commas = [](std::string_view line) {
        return std::count(line.begin(), line.end(), ',');
    };
    const std::ptrdiff_t width = commas(lines.front());
    const bool is_table =
        lines.size() >= kMinRows && width >= kMinCommas &&
        std::ranges::all_of(lines, [&](std::string_view line) {
            return commas(line) == width && line.find_first_of("(){}=>") == std::string_view::npos;
        });
    if (is_table) {
        return KnownFormat{"a table of comma-separated values", 0};
    }
    constexpr std::size_t kMinWords = 12;
    std::size_t words = 0;
    std::size_t others = 0;
    bool has_sentence = false;
    for (const std::string_view line : lines) {
        has_sentence = has_sentence || line.ends_with('.') || line.find(". ") != line.npos;
        for (std::size_t at = 0; at < line.size();) {
            const std::size_t end = std::min(line.find(' ', at), line.size());
            const std::string_view word = line.substr(at, end - at);
            const bool is_word = std::ranges::all_of(word, [](char c) {
                return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == ',' || c == '.' ||
                       c == '\'' || c == '-' || c == ';' || c == '?' || c == '!';
            });
            ++(is_word && word.size() > 1 ? words : others);
            at = end + 1;
        }
    }
    constexpr std::size_t kWordsPerOther = 6; // min words for each number, name or single letter
    return has_sentence && words >= kMinWords && words >= kWordsPerOther * others
               ? std::optional(KnownFormat{"plain prose", 0})
               : std::nullopt;
}

} // namespace lsys
