// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/split_report.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace lsys {

namespace {

constexpr std::size_t kMaxLabels = 8; // max number of labels of one warning
/// Max number of edits in a fix; files with more are better fixed by `names letters`.
constexpr std::size_t kMaxEdits = 10'000;
constexpr std::size_t kMaxQuotedBytes = 60;

} // namespace

void SplitReport::add(SourceSpan name, SourceSpan module, std::span<const NamePart> parts) {
    if (warning_ && warning_->fixes[0].edits.size() >= kMaxEdits) {
        warning_->fixes[0].machine_applicable = false;
        return;
    }
    const std::string_view written = resolution_.sources.text(module);
    std::string read;
    for (const NamePart& part : parts) {
        read += fmt::format("{}{}", read.empty() ? "" : " ", resolution_.text(part.name));
    }
    read += written.substr(name.end - name.begin);
    if (read.size() > kMaxQuotedBytes) {
        read = read.substr(0, kMaxQuotedBytes) + "...";
    }
    if (!warning_) {
        warning_ = make_diagnostic(
            DiagnosticCode::SplitName, name,
            fmt::format("{} is read as {}", quoted(resolution_.sources.text(name)), quoted(read)));
        warning_->label = "no module has this name, but it is a sequence of known names";
        warning_->help.emplace_back(
            "separate the modules by blanks, or declare the name: `#module NAME;`");
        warning_->fixes.push_back({"insert the blanks", {}, true});
    } else if (warning_->labels.size() < kMaxLabels) {
        warning_->labels.push_back({name, fmt::format("read as {}", quoted(read))});
    }
    for (const NamePart& part : parts.subspan(1)) {
        const std::uint32_t at = name.begin + part.offset;
        warning_->fixes[0].edits.push_back({{name.file, at, at}, " "});
    }
}

void SplitReport::finish() {
    if (warning_) {
        resolution_.diagnostics.add(*std::exchange(warning_, std::nullopt));
    }
}

} // namespace lsys
