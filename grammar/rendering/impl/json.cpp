// SPDX-License-Identifier: MIT
#include "grammar/rendering/impl/json.h"

#include <nlohmann/json.hpp>

#include <utility>
#include <variant>

namespace lsys::rendering {

namespace {

using Json = nlohmann::ordered_json;

void append(const Json& object, std::string& out) {
    out += object.dump(-1, ' ', false, Json::error_handler_t::replace);
    out += '\n';
}

void set_place(SourceSpan span, const SourceMap& sources, Json& object) {
    if (span.file == kNoFile) {
        return;
    }
    const SourceFile& file = sources.file(span.file);
    const LineColumn begin = file.line_column(span.begin);
    const LineColumn end = file.line_column(span.end);
    const std::uint32_t skipped = file.has_byte_order_mark() ? 3 : 0;
    object["file"] = file.path();
    object["line"] = begin.line;
    object["column"] = begin.column;
    object["end_line"] = end.line;
    object["end_column"] = end.column;
    object["utf16_column"] = begin.utf16_column;
    object["end_utf16_column"] = end.utf16_column;
    object["byte"] = span.begin + skipped;
    object["end_byte"] = span.end + skipped;
}

/// Each object is made by Json::object(): if memory runs out while a null value becomes an object,
/// the process crashes (JSON for Modern C++ 3.11).
Json make_labels(const Diagnostic& diagnostic, const SourceMap& sources) {
    Json labels = Json::array();
    for (const Label& label : diagnostic.labels) {
        Json object = Json::object();
        object["text"] = label.text;
        set_place(label.span, sources, object);
        labels.push_back(std::move(object));
    }
    return labels;
}

Json make_fixes(const Diagnostic& diagnostic, const SourceMap& sources) {
    Json fixes = Json::array();
    for (const Fix& fix : diagnostic.fixes) {
        Json edits = Json::array();
        for (const Edit& edit : fix.edits) {
            Json object = Json::object();
            set_place(edit.span, sources, object);
            object["replacement"] = edit.replacement;
            edits.push_back(std::move(object));
        }
        Json object = Json::object();
        object["title"] = fix.title;
        object["machine_applicable"] = fix.machine_applicable;
        object["edits"] = std::move(edits);
        fixes.push_back(std::move(object));
    }
    return fixes;
}

} // namespace

void append_json(const Diagnostic& diagnostic, const SourceMap& sources, std::string& out) {
    Json object = Json::object();
    object["severity"] = severity_name(diagnostic.severity);
    object["code"] = info(diagnostic.code).name;
    object["message"] = diagnostic.message;
    set_place(diagnostic.span, sources, object);
    object["label"] = diagnostic.label;
    object["labels"] = make_labels(diagnostic, sources);
    object["notes"] = diagnostic.notes;
    object["help"] = diagnostic.help;
    object["fixes"] = make_fixes(diagnostic, sources);
    if (!diagnostic.facts.empty()) {
        Json data = Json::object();
        for (const Fact& fact : diagnostic.facts) {
            std::visit([&](const auto& value) { data[fact.name] = value; }, fact.value);
        }
        object["data"] = std::move(data);
    }
    append(object, out);
}

void append_json_omitted(std::uint64_t errors,
                         std::uint64_t warnings,
                         std::uint64_t notes,
                         std::string& out) {
    Json object = Json::object();
    object["more"] = {{"errors", errors}, {"warnings", warnings}, {"notes", notes}};
    append(object, out);
}

} // namespace lsys::rendering
