// SPDX-License-Identifier: MIT
#include "runtime/pipeline/setting_options.h"

#include "compiler/compile.h"
#include "grammar/dialects/dialect.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace lsys {

namespace {

constexpr std::string_view kOption = "--set"; // shown in messages as the path of an option's text
constexpr std::string_view kBlanks = " \t";

constexpr std::array<std::string_view, 6> kCompiledIn{"turtle", "names",   "rewriting",
                                                      "choice", "weights", "random"};

std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

/// Offset of the first character of `values` that would end the statement or the line, or npos.
std::size_t find_end_of_statement(std::string_view values) {
    return std::min({values.find_first_of(";#\n\r"), values.find("//"), values.find("/*")});
}

std::uint32_t length_of(std::string_view text) {
    return static_cast<std::uint32_t>(text.size());
}

} // namespace

Result<SettingText> parse_setting(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) {
        return Error{fmt::format("`{}` is not of the form KEY=VALUE", text)};
    }
    SettingText setting{std::string(trimmed(text.substr(0, equals))),
                        std::string(trimmed(text.substr(equals + 1)))};
    if (!is_identifier(setting.key)) {
        return Error{fmt::format("`{}` is not the name of a setting", setting.key)};
    }
    return setting;
}

std::string_view values_of(std::string_view key, std::span<const SettingText> settings) {
    for (const SettingText& setting : settings) {
        if (setting.key == key) {
            return setting.values;
        }
    }
    return {};
}

bool is_compiled_in(std::string_view key) {
    return std::ranges::find(kCompiledIn, key) != kCompiledIn.end();
}

std::optional<Ast> parse_settings(std::span<const SettingText> settings,
                                  SourceMap& sources,
                                  Names& names,
                                  Diagnostics& diagnostics) {
    if (settings.empty()) {
        return std::nullopt;
    }
    std::optional<Translation> statements;
    for (const SettingText& setting : settings) {
        const FileId file =
            sources.add(std::string(kOption), fmt::format("{}={}", setting.key, setting.values));
        if (!statements) {
            statements.emplace(file);
        }
        const std::uint32_t equals = length_of(setting.key);
        const std::uint32_t begin = equals + 1;
        const std::uint32_t end = begin + length_of(setting.values);
        const std::size_t bad = find_end_of_statement(setting.values);
        if (bad != std::string::npos) {
            const std::uint32_t at = begin + static_cast<std::uint32_t>(bad);
            diagnostics.add(DiagnosticCode::BadSetting, {file, at, at + 1},
                            fmt::format("`{}` takes values alone, on one line", setting.key));
            continue;
        }
        statements->put("#set ", {file, 0, 0});
        statements->copy({file, 0, equals}, sources);
        statements->put(" ", {file, equals, begin});
        statements->copy({file, begin, end}, sources);
        statements->put(";\n", {file, end, end});
    }
    const FileLoader load = [](const std::string& path) -> Result<std::string> {
        return Error{fmt::format("`{}` is not read here", path)};
    };
    return parse_translation(*statements, {sources, names, diagnostics, load});
}

Result<void> change_compiled_settings(const std::string& path,
                                      std::span<const SettingText> settings,
                                      Grammar& grammar,
                                      Diagnostics& diagnostics) {
    for (const SettingText& setting : settings) {
        if (is_compiled_in(setting.key)) {
            return Error{fmt::format("--set cannot change `{}` of `{}`, which is compiled",
                                     setting.key, path)};
        }
    }
    std::optional<Ast> ast = parse_settings(settings, *grammar.sources, grammar.names, diagnostics);
    if (!ast) {
        return {};
    }
    return change_settings(*ast, grammar.names, *grammar.sources, grammar.bytecode, diagnostics);
}

} // namespace lsys
