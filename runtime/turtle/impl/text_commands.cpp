// SPDX-License-Identifier: MIT
#include "runtime/turtle/impl/text_commands.h"

#include "grammar/base/number_chars.h"
#include "runtime/turtle/impl/state.h"

#include <string_view>

namespace lsys {

namespace {

/// The number at the start of `text`, after blanks and a sign; 0 if there is none.
float leading_number(std::string_view text) {
    while (!text.empty() && (text[0] == ' ' || text[0] == '\t')) {
        text.remove_prefix(1);
    }
    const bool plus = !text.empty() && text[0] == '+';
    text.remove_prefix(plus ? 1 : 0);
    float value = 0.0F;
    const std::size_t digit = text.starts_with('-') && !plus ? 1 : 0;
    if (text.size() > digit && (text[digit] == '.' || (text[digit] >= '0' && text[digit] <= '9'))) {
        number_from_chars(text.data(), text.data() + text.size(), value); // 0 if there is no number
    }
    return value;
}

} // namespace

TextStep TextCommand::take(const Action& action) {
    if (in_parameter && action.operation == TurtleOperation::ParameterEnd) {
        in_parameter = false;
        return TextStep::Parameter;
    }
    if (in_parameter) {
        if (text.size() < kMaxLength) {
            text += action.character == '\0' ? '?' : action.character;
        }
        return TextStep::Text;
    }
    if (is_set && action.operation == TurtleOperation::ParameterBegin) {
        in_parameter = true;
        text.clear();
        return TextStep::Text;
    }
    return TextStep::Command;
}

std::optional<float> TextCommand::parameter(TurtleOperation command, bool is_compatible) const {
    const float value = leading_number(text);
    const bool one_is_default = is_compatible && info(command).has(TurtleInfo::OneIsDefault);
    return one_is_default && value == 1.0F ? std::nullopt : std::optional(value);
}

bool Turtle::State::execute_pending() {
    pending.is_set = false;
    position = pending.position;
    code = pending.code;
    origin = pending.origin;
    const Action& action = pending.action;
    return cut != 0 ? skip(action) : execute(action, action.arguments.data());
}

/// Reads the next module of the word. Returns false once the drawing has ended.
bool Turtle::State::take_character(const Action& action, Code character, const float* arguments) {
    switch (pending.take(action)) {
    case TextStep::Text:
        return true;
    case TextStep::Parameter:
        if (const auto value =
                pending.parameter(pending.action.operation, traits.l3d_compatible_surface)) {
            pending.action.argument_count = 1;
            pending.action.arguments[0] = *value;
        }
        return execute_pending();
    case TextStep::Command:
        break;
    }
    if (pending.is_set && !execute_pending()) {
        return false;
    }
    pending.is_set = true;
    // A branch is executed at once: it may have more arguments than an Action.
    if (action.operation == TurtleOperation::SaveBranch) {
        pending.action = {};
        code = character;
        return cut != 0 ? skip(action) : execute(action, arguments);
    }
    pending.action = action;
    for (std::uint32_t i = 0; i < action.argument_count; ++i) {
        pending.action.arguments[i] = arguments[i];
    }
    pending.position = position;
    pending.code = character;
    pending.origin = origin;
    return true;
}

} // namespace lsys
