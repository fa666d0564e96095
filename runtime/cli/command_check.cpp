// SPDX-License-Identifier: MIT
#include "compiler/bytecode/module_file.h"
#include "grammar/base/counted_text.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/including_grammar.h"
#include "runtime/cli/unified_diff.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/senses.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"
#include "runtime/repair/fixes.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace lsys::lsc {

namespace {

/// The options of the command for a file. Sets GrammarOptions::part if the file has no axiom and
/// another grammar includes it.
GrammarOptions options_of(const std::string& path,
                          const GrammarText& text,
                          const CheckCommand& command,
                          const Console& console) {
    GrammarOptions options = command.grammar;
    options.part = command.part;
    if (command.part || command.run.files.is_untrusted || text.dialect != Dialect::Lsys ||
        shown_path(path).ends_with("<stdin>") || text.bytes.find("#w") != std::string::npos) {
        return options;
    }
    if (const auto grammar = find_including_grammar(shown_path(path))) {
        console.detail(
            fmt::format("`{}` is checked as a part of `{}`", shown_path(path), *grammar));
        options.part = true;
    }
    return options;
}

/// Adds the errors of files that `#sense` statements name, unless the grammar has errors already.
void check_files(const std::string& path, const Project& project, CompiledText& compiled) {
    if (compiled.has_bytecode) {
        check_environment_files(path, compiled.grammar, project, compiled.diagnostics);
    }
}

ExitStatus check_text(const std::string& path,
                      const GrammarText& text,
                      const CheckCommand& command,
                      const GrammarOptions& options,
                      const Console& console) {
    const Project project = make_project(console, command.run);
    Result<CompiledText> compiled =
        compile_text(path, text, options, project.limits.max_modules, make_include_loader(project));
    if (!compiled) {
        return report_error(compiled.error(), console);
    }
    if (!compiled.value().definition_error && command.messages.format == MessageFormat::Json) {
        // Readers of JSON apply machine-applicable fixes without asking, so doubtful fixes must not
        // be marked machine-applicable.
        const Result<void> offered = repair::offer_doubtful_fixes(
            path, text, options, repair::FixScope(path, command.files), project, compiled.value());
        if (!offered) {
            return report_error(offered.error(), console);
        }
    }
    check_files(path, project, compiled.value());
    Diagnostics& diagnostics = compiled.value().diagnostics;
    const ExitStatus status = console.show(diagnostics, *compiled.value().grammar.sources);
    if (compiled.value().definition_error) {
        return report_error(*compiled.value().definition_error, console);
    }
    console.detail(fmt::format("`{}`: {}, {}", shown_path(path),
                               counted(diagnostics.count(Severity::Error), "error"),
                               counted(diagnostics.count(Severity::Warning), "warning")));
    return status;
}

/// Writes all changed files in place, or none. The repaired text of standard input goes to standard
/// output.
Result<void> write_fixed(const std::string& path,
                         const std::string& bytes,
                         const repair::FixedGrammar& fixed,
                         const Console& console) {
    const std::string root = shown_path(path);
    std::vector<Output> outputs;
    const auto put = [&](const std::string& to, const std::string& text) {
        Result<Output> output = Output::reopen(to, console);
        if (!output) {
            return Result<void>(output.error());
        }
        Result<void> written = output.value().write(text);
        if (written) {
            written = output.value().finish();
        }
        outputs.push_back(std::move(output.value()));
        return written;
    };
    for (const auto& [changed_path, text] : fixed.changed) {
        if (is_standard_input(path) && changed_path == root) {
            continue;
        }
        if (Result<void> written = put(changed_path, text); !written) {
            return written;
        }
    }
    if (is_standard_input(path)) { // standard output comes last: it cannot be undone
        const auto found = fixed.changed.find(root);
        if (Result<void> written = put("-", found != fixed.changed.end() ? found->second : bytes);
            !written) {
            return written;
        }
    }
    return commit_all(outputs);
}

std::size_t count_fixes(const Diagnostics& diagnostics) {
    std::size_t count = 0;
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        count += diagnostic.fixes.size();
    }
    return count;
}

/// The bytes of the file `changed_path` before the repair.
Result<std::string> original_text(const std::string& changed_path,
                                  const std::string& path,
                                  const GrammarText& text,
                                  const Project& project) {
    return changed_path == shown_path(path) ? Result<std::string>(text.bytes)
                                            : make_include_loader(project)(changed_path);
}

ExitStatus fix_file(const std::string& path,
                    const GrammarText& text,
                    const CheckCommand& command,
                    const GrammarOptions& options,
                    const Console& console) {
    repair::FixedGrammar fixed;
    const Project project = make_project(console, command.run);
    const Result<void> done = repair::fix_text(
        path, text, options, repair::FixScope(path, command.files), project,
        command.fix == "offered" ? repair::FixChoice::Offered : repair::FixChoice::Certain, fixed);
    if (!done) {
        return report_error(done.error(), console);
    }
    if (command.diff) {
        for (const auto& [changed_path, fixed_text] : fixed.changed) {
            const Result<std::string> before = original_text(changed_path, path, text, project);
            if (!before) {
                return report_error(before.error(), console);
            }
            const Result<void> shown =
                console.write(unified_diff(changed_path, before.value(), fixed_text));
            if (!shown) {
                return report_error(shown.error(), console);
            }
        }
    } else if (!console.interrupted()) {
        if (const Result<void> written = write_fixed(path, text.bytes, fixed, console); !written) {
            const ExitStatus status = report_error(written.error(), console);
            if (fixed.changed.size() > 1) {
                console.help(fmt::format("`{}` and the files that it includes are as they were: "
                                         "either all of them are written or none",
                                         shown_path(path)));
            }
            return status;
        }
    }
    if (command.diff) {
        // The printed difference shows the fixes.
    } else if (command.messages.format == MessageFormat::Json) {
        console.records(fixed.records);
    } else {
        for (const std::string& line : fixed.lines) {
            console.line(line);
        }
        if (fixed.fix_count > fixed.lines.size()) {
            console.info(fmt::format("{} more fixes", fixed.fix_count - fixed.lines.size()));
        }
    }
    check_files(path, project, fixed.compiled);
    const ExitStatus status =
        console.show(fixed.compiled.diagnostics, *fixed.compiled.grammar.sources);
    if (const std::size_t offers = count_fixes(fixed.compiled.diagnostics); offers != 0) {
        console.info(offers == 1 ? "1 repair is offered, but not applied"
                                 : fmt::format("{} repairs are offered, but not applied", offers));
    }
    for (const std::string& outside : fixed.out_of_scope) {
        console.info(fmt::format("`{}` is left as it is: it lies outside the folder of `{}`",
                                 outside, shown_path(path)));
    }
    return status;
}

} // namespace

ExitStatus run_command(const CheckCommand& command, const Console& console) {
    ExitStatus status = ExitStatus::Ok;
    for (const std::string& path : command.files) {
        GrammarText text;
        const ExitStatus read = console.take(
            read_grammar(path, command.grammar.dialect, make_project(console, command.run)), text);
        if (read != ExitStatus::Ok) {
            status = more_severe(status, read);
        } else if (is_module_file(text.bytes)) {
            console.error(fmt::format("`{}` is compiled; only grammars can be checked", path));
            status = more_severe(status, ExitStatus::Failure);
        } else {
            const GrammarOptions options = options_of(path, text, command, console);
            status = more_severe(status, command.fix.empty()
                                             ? check_text(path, text, command, options, console)
                                             : fix_file(path, text, command, options, console));
        }
    }
    return status;
}

} // namespace lsys::lsc
