#include "compiler/module_file.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/files.h"
#include "runtime/cli/fixes.h"
#include "runtime/cli/grammar_file.h"

#include <fmt/format.h>

#include <utility>

namespace lsys::lsc {

namespace {

Status check_text(const std::string& path,
                  const GrammarText& text,
                  const CheckCommand& command,
                  const Console& console) {
    Grammar grammar;
    Result<Done> compiled =
        compile_text(path, text, command.grammar, make_loader(console), grammar);
    if (compiled && command.messages.format == MessageFormat::Json) {
        // Editors apply what is machine applicable.
        compiled = offer_doubtful_fixes(path, text, command.grammar, console, grammar);
    }
    const Status status = console.show(grammar.diagnostics, grammar.sources);
    if (!compiled) {
        console.error(compiled.error().message);
        return Status::Failure;
    }
    console.detail(fmt::format("`{}`: {} errors, {} warnings", shown_path(path),
                               grammar.diagnostics.count(Severity::Error),
                               grammar.diagnostics.count(Severity::Warning)));
    return status;
}

/// Writes what the fixes changed: files in place, standard input to standard output.
Result<Done> write_fixed(const std::string& path,
                         const std::string& bytes,
                         const FixedGrammar& fixed,
                         const Console& console) {
    const std::string root = shown_path(path);
    if (path == "-") {
        const auto mended = fixed.changed.find(root);
        Result<Done> written =
            write_file("-", mended != fixed.changed.end() ? mended->second : bytes, console);
        if (!written) {
            return written;
        }
    }
    for (const auto& [changed_path, text] : fixed.changed) {
        if (path == "-" && changed_path == root) {
            continue;
        }
        if (Result<Done> written = write_file(changed_path, text, console); !written) {
            return written;
        }
    }
    return Done{};
}

Status fix_file(const std::string& path,
                const GrammarText& text,
                const CheckCommand& command,
                const Console& console) {
    FixedGrammar fixed;
    Result<Done> done = fix_text(path, text, command.grammar, console, fixed);
    if (done && !console.interrupted()) {
        done = write_fixed(path, text.bytes, fixed, console);
    }
    if (!done) {
        console.error(done.error().message);
        return Status::Failure;
    }
    for (const std::string& line : fixed.lines) {
        console.line(line);
    }
    if (fixed.fix_count > fixed.lines.size()) {
        console.info(fmt::format("{} more fixes", fixed.fix_count - fixed.lines.size()));
    }
    return console.show(fixed.grammar.diagnostics, fixed.grammar.sources);
}

} // namespace

Status run_check(const CheckCommand& command, const Console& console) {
    Status status = Status::Fine;
    for (const std::string& path : command.files) {
        Result<GrammarText> text = read_grammar(path, command.grammar.dialect, console);
        if (!text) {
            console.error(text.error().message);
            status = worse(status, Status::Failure);
        } else if (is_module_file(text.value().bytes)) {
            console.error(fmt::format("`{}` is compiled; only grammars can be checked", path));
            status = worse(status, Status::Failure);
        } else if (command.fix) {
            status = worse(status, fix_file(path, text.value(), command, console));
        } else {
            status = worse(status, check_text(path, text.value(), command, console));
        }
    }
    return status;
}

} // namespace lsys::lsc
