// SPDX-License-Identifier: MIT
#include "runtime/pipeline/step.h"

#include "runtime/pipeline/grammar.h"
#include "runtime/turtle/turtle_diagnostic.h"

#include <fmt/format.h>

#include <algorithm>

namespace lsys {

namespace {

/// Adds the name of the file to the Error of `bytes`, if it is an error.
Result<std::string> with_file_name(Result<std::string> bytes, const std::string& path) {
    if (bytes) {
        return bytes;
    }
    return Error{fmt::format("cannot read `{}`: {}", shown_path(path), bytes.error().message),
                 bytes.error().kind};
}

} // namespace

Result<std::string> Step::read(const std::string& path, const ReadLimit& limit) const {
    return with_file_name(project_.host.read_file(path, limit), path);
}

Result<std::string> Step::read_referenced(const std::string& path, const ReadLimit& limit) const {
    return with_file_name(project_.host.read_referenced_file(path, limit), path);
}

bool Step::diagnose(Diagnostics diagnostics, std::shared_ptr<const SourceMap> sources) {
    apply_levels(project_.levels, sources != nullptr ? *sources : SourceMap(), diagnostics);
    const bool ok = !diagnostics.has_errors();
    messages.add(std::move(diagnostics), std::move(sources));
    return ok;
}

bool Step::diagnose(Diagnostic diagnostic, std::shared_ptr<const SourceMap> sources) {
    Diagnostics diagnostics;
    diagnostics.add(std::move(diagnostic));
    return diagnose(std::move(diagnostics), std::move(sources));
}

Step::Ended Step::end_diagnosed() {
    const auto is_limit = [](const Diagnostic& diagnostic) {
        return diagnostic.code == DiagnosticCode::LimitReached;
    };
    const bool reached_limit =
        std::any_of(messages.all().begin(), messages.all().end(), [&](const Message& message) {
            const std::vector<Diagnostic>& all = message.diagnostics.all();
            return std::any_of(all.begin(), all.end(), is_limit);
        });
    return end(reached_limit ? Stop::Limit : Stop::Diagnosed);
}

Step::Ended Step::end_too_large(Stop stop, std::string_view what) {
    diagnose(stop == Stop::Limit ? plant_limit_diagnostic(what, project_.limits.max_bytes)
                                 : no_memory_diagnostic(what),
             nullptr);
    return end(stop);
}

Step::Ended Step::fail(Error error) {
    if (project_.is_cancelled()) {
        return end(Stop::Cancelled);
    }
    const bool is_limit = error.kind == ErrorKind::Limit;
    messages.add_error(std::move(error.message));
    if (is_limit) {
        messages.add_help("raise the limit with `--max-memory`");
    }
    return end(is_limit ? Stop::Limit : Stop::Failed);
}

} // namespace lsys
