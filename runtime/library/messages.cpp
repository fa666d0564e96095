// SPDX-License-Identifier: MIT
#include "grammar/base/source.h"
#include "runtime/library/impl/message_data.h"
#include "runtime/program/console.h"

#include <algorithm>
#include <lsys/messages.h>
#include <lsys/outcome.h>
#include <optional>
#include <string_view>
#include <utility>

namespace lsys::v0 {

namespace {

Place place_of(SourceSpan span, const SourceMap& sources) {
    const SourceFile& file = sources.file(span.file);
    const LineColumn begin = file.line_column(span.begin);
    const LineColumn end = file.line_column(span.end);
    return {file.path(), begin.line, begin.column, end.line, end.column, span.begin, span.end};
}

std::optional<Place> maybe_place_of(SourceSpan span, const SourceMap* sources) {
    if (sources == nullptr || span.file == kNoFile) {
        return std::nullopt;
    }
    return place_of(span, *sources);
}

Severity public_severity(::lsys::Severity severity) {
    switch (severity) {
    case ::lsys::Severity::Note:
        return Severity::Note;
    case ::lsys::Severity::Warning:
        return Severity::Warning;
    case ::lsys::Severity::Error:
        break;
    }
    return Severity::Error;
}

Fix public_fix(const ::lsys::Fix& fix, const SourceMap* sources) {
    Fix out{fix.title, {}, fix.machine_applicable};
    for (const ::lsys::Edit& edit : fix.edits) {
        if (std::optional<Place> place = maybe_place_of(edit.span, sources)) {
            out.edits.push_back({std::move(*place), edit.replacement});
        }
    }
    return out;
}

/// Options of lsc in messages, and what they are in this interface.
struct OptionName {
    std::string_view option;
    std::string_view member;
};
constexpr OptionName kOptionNames[] = {
    {"`--max-modules`", "`Limits::max_modules`"}, {"`--max-memory`", "`Limits::max_bytes`"},
    {"`--max-output`", "`Policy::max_output`"},   {"`--max-time`", "`Policy::max_seconds`"},
    {"`--sides`", "`MeshOptions::sides`"},        {"`-n ", "`GrammarOptions::generations = "},
    {"`-n`", "`GrammarOptions::generations`"},
};

std::string with_member_names(std::string text) {
    for (const OptionName& name : kOptionNames) {
        for (std::size_t at = text.find(name.option); at != std::string::npos;
             at = text.find(name.option, at + name.member.size())) {
            text.replace(at, name.option.size(), name.member);
        }
    }
    return text;
}

Diagnostic public_diagnostic(const ::lsys::Diagnostic& diagnostic, const SourceMap* sources) {
    Diagnostic out;
    out.severity = public_severity(diagnostic.severity);
    out.code = std::string(info(diagnostic.code).name);
    out.message = diagnostic.message;
    out.place = maybe_place_of(diagnostic.span, sources);
    out.label = diagnostic.label;
    for (const ::lsys::Label& label : diagnostic.labels) {
        if (std::optional<Place> place = maybe_place_of(label.span, sources)) {
            out.labels.push_back({std::move(*place), label.text});
        }
    }
    out.notes = diagnostic.notes;
    for (const std::string& help : diagnostic.help) {
        out.help.push_back(with_member_names(help));
    }
    for (const ::lsys::Fix& fix : diagnostic.fixes) {
        out.fixes.push_back(public_fix(fix, sources));
    }
    return out;
}

/// Adds the diagnostics of a message. The help of an error becomes part of the error.
void add_message(const Message& message, std::vector<Diagnostic>& all) {
    Diagnostic text;
    text.message = message.text;
    switch (message.kind) {
    case Message::Kind::Diagnostics:
        for (const ::lsys::Diagnostic& diagnostic : message.diagnostics.all()) {
            all.push_back(public_diagnostic(diagnostic, message.sources.get()));
        }
        return;
    case Message::Kind::Help:
        if (!all.empty()) {
            all.back().help.push_back(with_member_names(message.text));
        }
        return;
    case Message::Kind::Error:
        text.severity = Severity::Error;
        break;
    case Message::Kind::Info:
        text.severity = Severity::Note;
        break;
    case Message::Kind::Detail:
        return;
    }
    all.push_back(std::move(text));
}

} // namespace

std::shared_ptr<const Messages::Data> make_message_data(::lsys::Messages messages) {
    auto data = std::make_shared<Messages::Data>();
    data->messages = std::move(messages);
    for (const Message& message : data->messages.all()) {
        add_message(message, data->diagnostics);
    }
    return data;
}

Messages::Messages() : Messages(std::make_shared<const Data>()) {}
Messages::Messages(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
Messages::Messages(const Messages&) = default;
// A moved-from object keeps its messages, so that data_ is never null.
// NOLINTNEXTLINE(performance-move-constructor-init)
Messages::Messages(Messages&& other) noexcept : data_(other.data_) {}
Messages& Messages::operator=(const Messages&) = default;
Messages& Messages::operator=(Messages&& other) noexcept {
    data_ = other.data_;
    return *this;
}
Messages::~Messages() = default;

const std::vector<Diagnostic>& Messages::all() const {
    return data_->diagnostics;
}

bool Messages::has_errors() const {
    return data_->messages.has_errors();
}

std::string Messages::text(MessageStyle style) const {
    MessageOptions options;
    options.format = style == MessageStyle::Lines  ? MessageFormat::Short
                     : style == MessageStyle::Json ? MessageFormat::Json
                                                   : MessageFormat::Human;
    options.colour = style == MessageStyle::ColourFrames ? ColourMode::Always : ColourMode::Never;
    const std::string text = messages_text(data_->messages, options, "lsys");
    if (style == MessageStyle::Json) {
        return with_member_names(text);
    }
    // Lines of the grammar stay as they are.
    constexpr std::string_view kHelp = "help: ";
    std::string out;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
        const std::string line = text.substr(begin, end - begin);
        out += line.find(kHelp) == std::string::npos ? line : with_member_names(line);
        begin = end;
    }
    return out;
}

const char* text_of(Status status) noexcept {
    switch (status) {
    case Status::Ok:
        return "ok";
    case Status::Diagnosed:
        return "mistakes in the grammar or scene";
    case Status::Failed:
        return "failed";
    case Status::Limit:
        return "a limit was reached";
    case Status::OutOfMemory:
        return "out of memory";
    case Status::Cancelled:
        break;
    }
    return "cancelled";
}

} // namespace lsys::v0
