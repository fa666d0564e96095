// SPDX-License-Identifier: MIT
// The part of CpfgExpressions for files of numbers beside the L-system, which `Start:` reads with
// `fopen` and `fscanf`: measured lengths and angles of a plant.
#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/number_chars.h"
#include "grammar/base/paths.h"
#include "grammar/dialects/cpfg/expressions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace lsys {

namespace {

std::string_view without_quotes(std::string_view text) {
    return text.size() < 2 ? std::string_view() : text.substr(1, text.size() - 2);
}

/// Count of numbers that a format of `fscanf` reads; nullopt if it reads anything else.
std::optional<std::size_t> numbers_of(std::string_view format) {
    std::size_t count = 0;
    while (!format.empty()) {
        if (format[0] != '%') {
            if (kWhitespace.find(format[0]) == kWhitespace.npos && !format.starts_with("\\n")) {
                return std::nullopt;
            }
            format.remove_prefix(format[0] == '\\' ? 2 : 1);
            continue;
        }
        format.remove_prefix(format.starts_with("%l") ? 2 : 1);
        if (format.empty() || std::string_view("fgd").find(format[0]) == std::string_view::npos) {
            return std::nullopt;
        }
        format.remove_prefix(1);
        ++count;
    }
    return count;
}

/// The next number of a text from `at` on; nullopt if there is none.
std::optional<double> next_number(std::string_view text, std::size_t& at) {
    at = std::min(text.find_first_not_of(kWhitespace, at), text.size());
    const std::size_t begin = at + (text.substr(at).starts_with('+') ? 1 : 0);
    double value = 0.0;
    const auto [end, error] =
        number_from_chars(text.data() + begin, text.data() + text.size(), value);
    if (error != std::errc() || !std::isfinite(value)) {
        return std::nullopt;
    }
    at = static_cast<std::size_t>(end - text.data());
    return value;
}

} // namespace

bool CpfgExpressions::open_file(const CpfgStatement& statement) {
    const ForeignNode call = tree_[statement.value];
    if (call.kind != ForeignKind::Call || call.text != "fopen" || call.parts.size() != 2 ||
        tree_[statement.target].kind != ForeignKind::Name || !in_header_ || in_step_) {
        return false;
    }
    const ForeignNode& mode = tree_[call.parts[1]];
    if (mode.kind != ForeignKind::Text || !without_quotes(mode.text).starts_with('r')) {
        return false;
    }
    const std::string_view name = without_quotes(tree_[call.parts[0]].text);
    const std::string_view path = session_.context.sources.file(session_.text.file()).path();
    Result<std::string> text =
        session_.context.load(std::string(folder_of_path(path)) + std::string(name));
    if (!text) {
        static_cast<void>(
            unsupported(call.span, "a file beside this one, `" + shown(name) + "`, is missing"));
    }
    files_[tree_[statement.target].text] = {text ? std::move(text).value() : std::string(), 0};
    return true;
}

void CpfgExpressions::read_numbers(const ForeignNode& call) {
    const auto file = call.parts.empty() ? files_.end() : files_.find(tree_[call.parts[0]].text);
    const std::size_t wanted = call.parts.size() < 2 ? 0 : call.parts.size() - 2;
    if (file == files_.end() || wanted == 0 || tree_[call.parts[1]].kind != ForeignKind::Text ||
        numbers_of(without_quotes(tree_[call.parts[1]].text)) != wanted || !in_header_ ||
        in_step_) {
        if (file != files_.end() || !session_.context.diagnostics.has_errors()) {
            static_cast<void>(
                unsupported(call.span, "`fscanf` of anything but numbers, in `Start:`"));
        }
        for (std::size_t i = 2; i < call.parts.size(); ++i) {
            const ForeignNode address = tree_[call.parts[i]]; // the variable becomes 0
            if (address.kind == ForeignKind::Address &&
                tree_[address.parts[0]].kind == ForeignKind::Name) {
                assign(tree_[address.parts[0]].text, number_node(0.0, address.span), address.span);
            }
        }
        return;
    }
    for (std::size_t i = 2; i < call.parts.size(); ++i) {
        const ForeignNode address = tree_[call.parts[i]];
        const std::optional<double> value = next_number(file->second.text, file->second.at);
        if (!value || address.kind != ForeignKind::Address) {
            return;
        }
        const ForeignNode target = tree_[address.parts[0]];
        const ForeignId number = number_node(*value, address.span);
        if (target.kind == ForeignKind::Index) {
            set_element(target, number, address.span);
        } else {
            assign(target.text, number, address.span);
        }
    }
}

} // namespace lsys
