// SPDX-License-Identifier: MIT
// Diagnostics, their fixes and code actions as JSON of LSP.
#include "grammar/ast/include_chain.h"
#include "runtime/languageserver/impl/workspace.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace lsys {

namespace {

/// More diagnostics than an editor can show are not sent.
constexpr std::size_t kMaxDiagnostics = 1000;

int severity_number(Severity severity) {
    return severity == Severity::Error ? 1 : severity == Severity::Warning ? 2 : 3;
}

bool is_unnecessary(DiagnosticCode code) {
    constexpr std::array kCodes{DiagnosticCode::UnusedConstant, DiagnosticCode::UnusedFormal,
                                DiagnosticCode::UnusedLocal, DiagnosticCode::UnusedObject,
                                DiagnosticCode::NeverProduced};
    return std::find(kCodes.begin(), kCodes.end(), code) != kCodes.end();
}

TextPlace place_of(SourceSpan span, const SourceMap& sources) {
    return {normalised_path(sources.file(span.file).path()), span.begin, span.end};
}

class DiagnosticWriter {
public:
    DiagnosticWriter(Workspace& workspace, const Document& document, const CheckedDocument& checked)
        : workspace_(workspace), document_(document), sources_(*checked.compiled.grammar.sources),
          at_(workspace) {}

    Json write(const Diagnostic& diagnostic) {
        Json out{{"severity", severity_number(diagnostic.severity)},
                 {"code", info(diagnostic.code).name},
                 {"source", "lsc"}};
        if (workspace_.host.explanation_uri) {
            if (const std::string uri = workspace_.host.explanation_uri(info(diagnostic.code).name);
                !uri.empty()) {
                out["codeDescription"] = {{"href", uri}};
            }
        }
        std::string message = diagnostic.message;
        Json related = Json::array();
        const auto relate = [&](SourceSpan span, const std::string& text) {
            if (span.file != kNoFile) {
                related.push_back(
                    {{"location", at_.location(place_of(span, sources_))}, {"message", text}});
            }
        };
        TextPlace place{document_.path, 0, 0};
        if (diagnostic.span.file != kNoFile) {
            place = place_of(diagnostic.span, sources_);
        }
        if (place.path != document_.path) {
            relate(diagnostic.span, message);
            message = "in `" + place.path + "`: " + message;
            place = include_of(place.path);
        }
        out["range"] = at_.range(place);
        if (!diagnostic.label.empty()) {
            message += "\n" + diagnostic.label;
        }
        for (const Label& label : diagnostic.labels) {
            relate(label.span, label.text);
        }
        for (const std::string& note : diagnostic.notes) {
            message += "\nnote: " + note;
        }
        for (const std::string& help : diagnostic.help) {
            message += "\nhelp: " + help;
        }
        out["message"] = std::move(message);
        if (!related.empty() && workspace_.editor.related_information) {
            out["relatedInformation"] = std::move(related);
        }
        if (is_unnecessary(diagnostic.code)) {
            out["tags"] = Json::array({1}); // DiagnosticTag.Unnecessary, which editors show faded
        }
        return out;
    }

    Json fix_edits(const Fix& fix) {
        Json changes = Json::object();
        for (const Edit& edit : fix.edits) {
            if (edit.span.file == kNoFile) {
                return {};
            }
            const TextPlace place = place_of(edit.span, sources_);
            changes[workspace_.uri_of(place.path)].push_back(
                {{"range", at_.range(place)}, {"newText", edit.replacement}});
        }
        return changes;
    }

    Places& places() { return at_; }

private:
    /// The place of the `#include` in the document through which it reads `path`.
    TextPlace include_of(const std::string& path) {
        if (!includes_) {
            includes_ = workspace_.names({document_.path});
        }
        TextPlace first{document_.path, 0, 0};
        bool is_first = true;
        for (const StatementOutline& statement : includes_->statements) {
            if (statement.kind != StatementKind::Include ||
                statement.place.path != document_.path) {
                continue;
            }
            const std::string included =
                normalised_path(path_beside(document_.path, statement.name));
            if (included == path) {
                return statement.name_place;
            }
            if (is_first) {
                first = statement.name_place; // included by an included file
                is_first = false;
            }
        }
        return first;
    }

    Workspace& workspace_;
    const Document& document_;
    const SourceMap& sources_;
    Places at_;
    std::shared_ptr<const NameIndex> includes_;
};

bool is_before(const Json& a, const Json& b) {
    return std::pair(a.at("line").get<std::int64_t>(), a.at("character").get<std::int64_t>()) <
           std::pair(b.at("line").get<std::int64_t>(), b.at("character").get<std::int64_t>());
}

bool ranges_touch(const Json& a, const Json& b) {
    return !is_before(a.at("end"), b.at("start")) && !is_before(b.at("end"), a.at("start"));
}

/// Whether the editor asks for actions of `kind`.
bool is_wanted(const Json& context, std::string_view kind) {
    if (!context.contains("only")) {
        return true;
    }
    for (const Json& each : context.at("only")) {
        const auto only = each.get<std::string>();
        if (only.empty() || kind == only || kind.starts_with(only + ".")) {
            return true;
        }
    }
    return false;
}

} // namespace

Json document_diagnostics(Workspace& workspace, Document& document) {
    if (!document.is_dirty) {
        return document.diagnostics;
    }
    document.is_dirty = false;
    Json all = Json::array();
    const CheckedDocument& checked = workspace.check(document);
    if (!checked.failure.empty()) {
        Places at(workspace);
        all.push_back({{"range", at.range({document.path, 0, 0})},
                       {"severity", 1},
                       {"source", "lsc"},
                       {"message", checked.failure}});
    } else {
        DiagnosticWriter writer(workspace, document, checked);
        for (const Diagnostic& diagnostic : checked.compiled.diagnostics.all()) {
            if (all.size() == kMaxDiagnostics) {
                break;
            }
            all.push_back(writer.write(diagnostic));
        }
    }
    document.diagnostics = all;
    return all;
}

Json code_actions(Workspace& workspace, const Json& params) {
    Document& document = workspace.document(params.at("textDocument").at("uri"));
    const Json& context = params.at("context");
    const Json& range = params.at("range");
    static_cast<void>(position_of(range.at("start")));
    static_cast<void>(position_of(range.at("end")));
    Json actions = Json::array();
    bool has_certain = context.contains("only");
    if (is_wanted(context, "quickfix")) {
        const CheckedDocument checked = workspace.check_with_offers(document);
        if (!checked.failure.empty()) {
            return actions;
        }
        DiagnosticWriter writer(workspace, document, checked);
        for (const Diagnostic& diagnostic : checked.compiled.diagnostics.all()) {
            if (diagnostic.fixes.empty()) {
                continue;
            }
            has_certain = has_certain || has_certain_fix(diagnostic);
            const Json written = writer.write(diagnostic);
            if (!ranges_touch(written.at("range"), range)) {
                continue;
            }
            for (const Fix& fix : diagnostic.fixes) {
                Json changes = writer.fix_edits(fix);
                if (changes.empty()) {
                    continue;
                }
                Json action{{"title", fix.title},
                            {"kind", "quickfix"},
                            {"diagnostics", Json::array({written})},
                            {"edit", {{"changes", std::move(changes)}}}};
                if (fix.machine_applicable) {
                    action["isPreferred"] = true;
                }
                actions.push_back(std::move(action));
            }
        }
    }
    if (has_certain && is_wanted(context, "source.fixAll")) {
        Places at(workspace);
        Json changes = Json::object();
        for (const auto& [path, bytes] : workspace.fixed(document)) {
            const std::string key = normalised_path(path);
            std::string_view after = bytes;
            if (after.starts_with("\xEF\xBB\xBF")) {
                after.remove_prefix(3);
            }
            changes[workspace.uri_of(key)].push_back(changing_edit(key, at.text(key), after, at));
        }
        if (!changes.empty()) {
            actions.push_back({{"title", "apply all certain repairs"},
                               {"kind", "source.fixAll"},
                               {"edit", {{"changes", std::move(changes)}}}});
        }
    }
    return actions;
}

} // namespace lsys
