// SPDX-License-Identifier: MIT
// Finds options by name, in place of CLI::App::get_option() and get_option_no_throw(). These end
// the process when memory runs out, because they allocate in a function that is noexcept.
#pragma once

#include <string>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace lsys {

/// The option of `app` with this name, for example `--level`; null if there is none.
[[nodiscard]] CLI::Option* find_option(CLI::App& app, const std::string& name);
[[nodiscard]] const CLI::Option* find_option(const CLI::App& app, const std::string& name);
/// Whether the command line has the option.
[[nodiscard]] bool is_given(const CLI::App& app, const std::string& name);

} // namespace lsys
