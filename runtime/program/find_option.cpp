// SPDX-License-Identifier: MIT
#include "runtime/program/find_option.h"

#include <CLI/CLI.hpp>

namespace lsys {

namespace {

template <typename Options>
auto find_in(const Options& options, const std::string& name) -> typename Options::value_type {
    for (const auto option : options) {
        if (option->check_name(name)) {
            return option;
        }
    }
    return nullptr;
}

} // namespace

CLI::Option* find_option(CLI::App& app, const std::string& name) {
    return find_in(app.get_options(), name);
}

const CLI::Option* find_option(const CLI::App& app, const std::string& name) {
    return find_in(app.get_options(), name);
}

bool is_given(const CLI::App& app, const std::string& name) {
    const CLI::Option* const option = find_option(app, name);
    return option != nullptr && option->count() > 0;
}

} // namespace lsys
