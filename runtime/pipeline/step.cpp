#include "runtime/pipeline/step.h"

#include "runtime/pipeline/grammar.h"

#include <fmt/format.h>

namespace lsys {

Result<std::string> Step::read(const std::string& path, std::uint64_t max_bytes) const {
    Result<std::string> bytes = project_.host.read_file(path, max_bytes);
    return bytes ? std::move(bytes)
                 : Error{fmt::format("cannot read `{}`: {}", shown_path(path),
                                     bytes.error().message)};
}

bool Step::diagnose(Diagnostics diagnostics, std::shared_ptr<const SourceMap> sources) {
    if (project_.deny_warnings) {
        diagnostics.promote_warnings();
    }
    const bool fine = !diagnostics.has_errors();
    messages.add(std::move(diagnostics), std::move(sources));
    return fine;
}

bool Step::diagnose(Diagnostic diagnostic, std::shared_ptr<const SourceMap> sources) {
    Diagnostics diagnostics;
    diagnostics.add(std::move(diagnostic));
    return diagnose(std::move(diagnostics), std::move(sources));
}

Step::Ended Step::fail(Error error) {
    if (project_.is_cancelled()) {
        return end(Stop::Cancelled);
    }
    messages.add_error(std::move(error.message));
    return end(Stop::Failed);
}

} // namespace lsys
