// SPDX-License-Identifier: MIT
#include "packaging/pages/command_text.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>

namespace lsys::pages {

namespace {

/// The alternatives of `human|short|json` or `N|all` that are words; placeholders have capitals.
std::vector<std::string> words_of(const std::string& value) {
    std::vector<std::string> words;
    for (std::size_t at = 0; at <= value.size();) {
        const std::size_t end = std::min(value.find('|', at), value.size());
        const std::string word = value.substr(at, end - at);
        const auto is_upper = [](unsigned char c) { return std::isupper(c) != 0; };
        if (!word.empty() && std::none_of(word.begin(), word.end(), is_upper)) {
            words.push_back(word);
        }
        at = end + 1;
    }
    return words;
}

ValueKind kind_of(const OptionText& option) {
    if (option.value.empty()) {
        return ValueKind::None;
    }
    if (option.value == "FILE") {
        return ValueKind::File;
    }
    if (option.value == "FOLDER") {
        return ValueKind::Folder;
    }
    return option.words.empty() ? ValueKind::Text : ValueKind::Words;
}

OptionText describe_option(const CLI::Option& option) {
    OptionText text;
    text.description = option.get_description();
    text.group = option.get_group();
    text.required = option.get_required();
    if (option.get_positional()) {
        text.value = option.get_name(true);
        text.repeatable = option.get_expected_max() > 1;
    } else {
        for (const std::string& name : option.get_snames()) {
            text.names.push_back("-" + name);
        }
        for (const std::string& name : option.get_lnames()) {
            text.names.push_back("--" + name);
        }
        const bool is_flag = option.get_items_expected_max() == 0;
        if (!is_flag) {
            text.value = option.get_type_name();
            text.repeatable = option.get_expected_max() > 1;
        } else if (!option.get_fnames().empty()) {
            text.optional_value = true;
        }
    }
    text.words = words_of(text.value);
    text.kind = kind_of(text);
    return text;
}

} // namespace

CommandText describe(const CLI::App& app, const AddValues& add_values) {
    CommandText text;
    text.name = app.get_name();
    text.description = app.get_description();
    text.footer = app.get_footer();
    for (const CLI::Option* option : app.get_options()) {
        OptionText described = describe_option(*option);
        add_values(text.name, described);
        (option->get_positional() ? text.positionals : text.options)
            .push_back(std::move(described));
    }
    return text;
}

const std::string& main_name(const OptionText& option) {
    return option.names.empty() ? option.value : option.names.back();
}

} // namespace lsys::pages
