#include "compiler/module_file.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/files.h"
#include "runtime/cli/fixes.h"
#include "runtime/cli/grammar_file.h"
#include "runtime/cli/tell.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace lsys::lsc {

namespace {

Status check_text(const std::string& path,
                  GrammarText text,
                  const CheckCommand& command,
                  const Console& console) {
    Grammar grammar;
    const Result<Done> compiled =
        compile_text(path, std::move(text), command.grammar,
                     make_loader(command.grammar.max_bytes, console), grammar);
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

/// Writes what the fixes changed, all files or none: files in place, standard input to standard
/// output.
Result<Done> write_fixed(const std::string& path,
                         const std::string& bytes,
                         const FixedGrammar& fixed,
                         const Console& console) {
    const std::string root = shown_path(path);
    std::vector<Output> outputs;
    const auto put = [&](const std::string& to, const std::string& text) {
        Result<Output> output = Output::open(to, console);
        if (!output) {
            return Result<Done>(output.error());
        }
        Result<Done> written = output.value().write(text);
        if (written) {
            written = output.value().finish();
        }
        outputs.push_back(std::move(output.value()));
        return written;
    };
    for (const auto& [changed_path, text] : fixed.changed) {
        if (path == "-" && changed_path == root) {
            continue;
        }
        if (Result<Done> written = put(changed_path, text); !written) {
            return written;
        }
    }
    if (path == "-") { // last: it cannot be taken back
        const auto mended = fixed.changed.find(root);
        if (Result<Done> written = put("-", mended != fixed.changed.end() ? mended->second : bytes);
            !written) {
            return written;
        }
    }
    return commit_all(outputs);
}

Status fix_file(const std::string& path,
                const GrammarText& text,
                const CheckCommand& command,
                const Console& console) {
    FixedGrammar fixed;
    const Result<Done> done =
        fix_text(path, text, command.grammar, FixScope(path, command.files), console, fixed);
    if (!done) {
        return fail(done.error(), console);
    }
    if (!console.interrupted()) {
        if (const Result<Done> written = write_fixed(path, text.bytes, fixed, console); !written) {
            const Status status = fail(written.error(), console);
            if (fixed.changed.size() > 1) {
                console.help(fmt::format("`{}` and the files that it includes are as they were: "
                                         "either all of them are written or none",
                                         shown_path(path)));
            }
            return status;
        }
    }
    for (const std::string& line : fixed.lines) {
        console.line(line);
    }
    if (fixed.fix_count > fixed.lines.size()) {
        console.info(fmt::format("{} more fixes", fixed.fix_count - fixed.lines.size()));
    }
    const Status status = console.show(fixed.grammar.diagnostics, fixed.grammar.sources);
    for (const std::string& left : fixed.left) {
        console.info(fmt::format("`{}` is left as it is: it lies outside the folder of `{}`", left,
                                 shown_path(path)));
    }
    return status;
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
            status = worse(status, check_text(path, std::move(text.value()), command, console));
        }
    }
    return status;
}

} // namespace lsys::lsc
