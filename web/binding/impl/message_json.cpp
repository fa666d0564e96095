// SPDX-License-Identifier: MIT
#include "web/binding/impl/message_json.h"

#include "grammar/base/source.h"
#include "grammar/rendering/render_diagnostic.h"

#include <string>
#include <utility>

namespace lsys::web {

namespace {

Json place_of(SourceSpan span, const SourceMap* sources) {
    if (sources == nullptr || span.file == kNoFile) {
        return nullptr;
    }
    const SourceFile& file = sources->file(span.file);
    const LineColumn begin = file.line_column(span.begin);
    const LineColumn end = file.line_column(span.end);
    return {{"file", file.path()},
            {"line", begin.line},
            {"column", begin.utf16_column},
            {"endLine", end.line},
            {"endColumn", end.utf16_column}};
}

Json fix_of(const Fix& fix, const SourceMap* sources) {
    Json edits = Json::array();
    for (const Edit& edit : fix.edits) {
        edits.push_back(
            {{"place", place_of(edit.span, sources)}, {"replacement", edit.replacement}});
    }
    return {{"title", fix.title}, {"certain", fix.machine_applicable}, {"edits", std::move(edits)}};
}

Json diagnostic_of(const Diagnostic& diagnostic, const SourceMap* sources) {
    Json labels = Json::array();
    for (const Label& label : diagnostic.labels) {
        labels.push_back({{"place", place_of(label.span, sources)}, {"text", label.text}});
    }
    Json fixes = Json::array();
    for (const Fix& fix : diagnostic.fixes) {
        fixes.push_back(fix_of(fix, sources));
    }
    Json json{{"severity", severity_name(diagnostic.severity)},
              {"code", info(diagnostic.code).name},
              {"message", diagnostic.message},
              {"place", place_of(diagnostic.span, sources)},
              {"label", diagnostic.label},
              {"labels", std::move(labels)},
              {"notes", diagnostic.notes},
              {"help", diagnostic.help},
              {"fixes", std::move(fixes)}};
    if (sources != nullptr) {
        std::string text;
        render(diagnostic, *sources, {}, text);
        json["text"] = std::move(text);
    }
    return json;
}

Json error_of(const std::string& text) {
    return {{"severity", "error"},
            {"code", ""},
            {"message", text},
            {"place", nullptr},
            {"label", ""},
            {"labels", Json::array()},
            {"notes", Json::array()},
            {"help", Json::array()},
            {"fixes", Json::array()}};
}

} // namespace

Json json_of(const Messages& messages) {
    Json all = Json::array();
    for (const Message& message : messages.all()) {
        switch (message.kind) {
        case Message::Kind::Diagnostics:
            for (const Diagnostic& diagnostic : message.diagnostics.all()) {
                all.push_back(diagnostic_of(diagnostic, message.sources.get()));
            }
            break;
        case Message::Kind::Error:
            all.push_back(error_of(message.text));
            break;
        case Message::Kind::Help:
            if (!all.empty()) {
                all.back()["help"].push_back(message.text);
            }
            break;
        case Message::Kind::Info:
        case Message::Kind::Detail:
            break;
        }
    }
    return all;
}

std::string_view status_name(Stop stop) {
    switch (stop) {
    case Stop::Diagnosed:
        return "diagnosed";
    case Stop::Failed:
        break;
    case Stop::Limit:
        return "limit";
    case Stop::OutOfMemory:
        return "out-of-memory";
    case Stop::Cancelled:
        return "cancelled";
    }
    return "failed";
}

} // namespace lsys::web
