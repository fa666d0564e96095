// SPDX-License-Identifier: MIT
// Options shared by several commands, and the parsers of their values.
#pragma once

#include "grammar/base/result.h"
#include "runtime/meshing/mesh.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/scene_overrides.h"
#include "runtime/program/arguments.h"
#include "runtime/program/message_options.h"
#include "runtime/program/run_options.h"
#include "runtime/program/usage.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

/// Adds an option whose value `parse` reads into `target`.
template <typename Target, typename Parse>
CLI::Option*
add_parsed(CLI::App& app, const std::string& name, Target& target, Parse parse, const char* text) {
    return app.add_option_function<std::string>(
        name,
        [&target, parse, name](const std::string& value) {
            auto parsed = parse(value);
            if (!parsed) {
                throw CLI::ValidationError(name.substr(name.rfind(',') + 1),
                                           parsed.error().message);
            }
            target = static_cast<Target>(std::move(parsed.value()));
        },
        text);
}

/// Adds an option with one of several words as its value.
template <typename Target>
CLI::Option* add_choice(CLI::App& app,
                        const std::string& name,
                        Target& target,
                        std::vector<std::pair<std::string, Target>> choices,
                        const char* text) {
    std::string words;
    for (const auto& choice : choices) {
        words += (words.empty() ? "" : "|") + choice.first;
    }
    const auto parse = [choices = std::move(choices),
                        words](const std::string& value) -> Result<Target> {
        for (const auto& [word, meaning] : choices) {
            if (word == value) {
                return meaning;
            }
        }
        return Error{choices.size() == 1 ? fmt::format("`{}` is not `{}`", value, words)
                                         : fmt::format("`{}` is none of {}", value, words)};
    };
    return add_parsed(app, name, target, parse, text)->type_name(words);
}

inline auto integer(std::uint64_t low, std::uint64_t high) {
    return [low, high](const std::string& text) { return parse_integer(text, low, high); };
}

/// Parses a number from 0 to 1.
inline Result<float> fraction(const std::string& text) {
    return parse_number(text, 0.0F, 1.0F);
}

/// Rewords a mistake found by CLI11 in the style of other messages, and suggests the nearest option
/// name. `command`: the words before the options of `app`, such as `lsc dump`.
[[nodiscard]] UsageError
to_usage_error(const CLI::ParseError& error, const CLI::App& app, const std::string& command);

/// The text of `--help`, with one blank line between its parts. `program`: printed before the name
/// of a command; empty if `app` is the program itself.
[[nodiscard]] std::string help_text(const CLI::App& app, const std::string& program);

void add_messages(CLI::App& app, MessageOptions& options);
/// The options --allow, --warn and --deny.
void add_levels(CLI::App& app, MessageOptions& options);
void add_dialect(CLI::App& app, std::string& dialect);
void add_grammar(CLI::App& app, GrammarOptions& options, RunOptions& run);
/// The options --base and --stdin-name: folder or path of a grammar from standard input.
void add_base_option(CLI::App& app, RunOptions& run);
/// Applies --base or --stdin-name: replaces each `-` in `files` by the path of standard_input_in()
/// or standard_input_as(). Returns a mistake if one of these options is given without a `-`, or if
/// both are given.
[[nodiscard]] std::optional<UsageError> apply_base(const RunOptions& run,
                                                   std::span<std::string> files);
/// The option --environment of commands that derive.
void add_environments(CLI::App& app, RunOptions& run);
void add_seed(CLI::App& app, std::optional<std::uint64_t>& seed);
/// The option for the height of the plant, in m.
void add_height(CLI::App& app, std::optional<float>& height);
/// The option for heights of the trees of a forest: METRES, or MIN,MAX.
void add_tree_height(CLI::App& app, std::optional<HeightRange>& height);
/// The options of make_mesh().
void add_mesh(CLI::App& app, MeshOptions& mesh);
/// Changes the help of `--level`, an option of add_mesh(), to describe a level of DetailLevels.
void describe_detail_levels(CLI::App& app);
void add_run_limits(CLI::App& app, RunOptions& run);

/// The options that replace values of a scene: key, placement, instances. `size`: the name of the
/// option for the side of the ground.
void add_scene_overrides(CLI::App& app, SceneOverrides& overrides, const char* size);

} // namespace lsys
