// SPDX-License-Identifier: MIT
#include "grammar/ast/include_chain.h"

#include "grammar/base/contract.h"
#include "grammar/base/paths.h"

#include <algorithm>
#include <utility>

namespace lsys {

std::string normalised_path(std::string_view path) {
    std::vector<std::string_view> parts;
    const bool absolute = path.starts_with('/');
    while (!path.empty()) {
        const std::string_view part = path.substr(0, path.find('/'));
        path.remove_prefix(std::min(path.size(), part.size() + 1));
        if (part.empty() || part == ".") {
            continue;
        }
        if (part != ".." || (parts.empty() && !absolute) ||
            (!parts.empty() && parts.back() == "..")) {
            parts.push_back(part);
        } else if (!parts.empty()) {
            parts.pop_back();
        }
    }
    std::string joined;
    for (const std::string_view part : parts) {
        if (absolute || !joined.empty()) {
            joined += '/';
        }
        joined += part;
    }
    return joined;
}

std::string path_beside(std::string_view including, std::string_view path) {
    return is_absolute_path(path) ? std::string(path)
                                  : std::string(folder_of_path(including)) + std::string(path);
}

IncludeChain::IncludeChain(const ParseContext& context, FileId root) : context_(context) {
    std::string path = normalised_path(context.sources.file(root).path());
    read_.emplace(path, root);
    chain_.push_back({std::move(path), {}});
}

FileId IncludeChain::enter(std::string_view path, SourceSpan path_span) {
    Diagnostics& diagnostics = context_.diagnostics;
    const std::string beside = path_beside(context_.sources.file(path_span.file).path(), path);
    std::string normalised = normalised_path(beside);
    if (path.empty()) {
        diagnostics.add(DiagnosticCode::IncludeNotFound, path_span,
                        "the name of the file is empty");
        return kNoFile;
    }
    const auto same = [&](const Link& link) { return link.path == normalised; };
    if (const auto found = std::find_if(chain_.begin(), chain_.end(), same);
        found != chain_.end()) {
        if (!diagnostics.admits(DiagnosticCode::IncludeCycle)) {
            return kNoFile;
        }
        Diagnostic& diagnostic = diagnostics.add(
            DiagnosticCode::IncludeCycle, path_span,
            found + 1 == chain_.end() ? "`" + beside + "` includes itself"
                                      : "`" + beside + "` is being included already");
        for (auto link = found + 1; link != chain_.end(); ++link) {
            diagnostic.labels.push_back({link->included_at, "which includes this file"});
        }
        diagnostic.help.emplace_back(
            "an #include stands for the statements of the file; a file that "
            "includes itself would never end");
        return kNoFile;
    }
    if (chain_.size() > kMaxIncludeDepth || inclusions_ >= kMaxInclusions) {
        if (diagnostics.admits(DiagnosticCode::IncludeTooDeep)) {
            diagnostics.add(DiagnosticCode::IncludeTooDeep, path_span,
                            inclusions_ >= kMaxInclusions ? "more than 65,536 files are included"
                                                          : "files are included more than 32 deep");
        }
        return kNoFile;
    }
    FileId file = kNoFile;
    if (const auto found = read_.find(normalised); found != read_.end()) {
        file = found->second;
    } else {
        Result<std::string> bytes = context_.load(beside);
        const bool too_large = bytes.ok() && bytes.value().size() > kMaxSourceBytes;
        if (!bytes.ok() || too_large) {
            const bool is_limit = !bytes.ok() && bytes.error().kind == ErrorKind::Limit;
            const DiagnosticCode code =
                is_limit ? DiagnosticCode::LimitReached : DiagnosticCode::IncludeNotFound;
            if (diagnostics.admits(code)) {
                Diagnostic& diagnostic = diagnostics.add(
                    code, path_span,
                    "cannot read `" + beside +
                        "`: " + (too_large ? "it is larger than 2 GiB" : bytes.error().message));
                if (!is_limit) {
                    diagnostic.help.emplace_back(
                        "the path is relative to the file that holds the #include");
                }
            }
            return kNoFile;
        }
        file = context_.sources.add(beside, std::move(bytes.value()));
        read_.emplace(normalised, file);
    }
    ++inclusions_;
    chain_.push_back({std::move(normalised), path_span});
    return file;
}

void IncludeChain::leave() {
    LSYS_CHECK(chain_.size() > 1);
    chain_.pop_back();
}

} // namespace lsys
