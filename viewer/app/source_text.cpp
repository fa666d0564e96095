// SPDX-License-Identifier: MIT
#include "viewer/app/source_text.h"

#include "grammar/base/utf8.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/program/host.h"
#include "runtime/repair/chosen_fixes.h"
#include "runtime/repair/fixes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace lsys::view {

namespace {

constexpr std::string_view kSourceMark = "\xEF\xBB\xBF";

/// Number of columns of the longest line. Tabs count as kPaneTabStop columns, so the result may be
/// a little too large.
std::uint32_t columns_of(const SourceFile& file) {
    std::uint32_t most = 0;
    for (std::uint32_t line = 1; line <= file.line_count(); ++line) {
        const std::string_view text = file.line_text(line);
        const auto tabs = static_cast<std::uint32_t>(std::count(text.begin(), text.end(), '\t'));
        most = std::max(most, static_cast<std::uint32_t>(text.size()) + tabs * (kPaneTabStop - 1));
    }
    return most;
}

/// Appends a remark below a message, such as `note: text`.
void add_remark(const char* kind,
                TextColour colour,
                const std::string& text,
                std::vector<TextLine>& lines) {
    lines.push_back({{colour, std::string(kind) + ": "}, {TextColour::Plain, text}});
}

class Maker {
public:
    Maker(const LoadedSources& loaded, const std::atomic<bool>& cancelled)
        : loaded_(loaded), project_{file_host(cancelled),    loaded.run.limits,
                                    loaded.run.threads,      {},
                                    loaded.run.environments, loaded.run.files},
          made_(std::make_shared<SourceText>()) {}

    std::shared_ptr<const SourceText> run() {
        add_loaded_files();
        add_files_of_disk();
        if (made_->files.empty()) {
            return made_;
        }
        if (loaded_.is_forest) {
            for (std::size_t i = 0; i < made_->files.size(); ++i) {
                if (made_->files[i].path.ends_with(".lsys")) {
                    colour(made_->files[i]);
                }
            }
        } else {
            compile();
        }
        add_messages();
        return made_;
    }

private:
    /// A Host that reads the shown files from memory and other files from disk.
    Host file_host(const std::atomic<bool>& cancelled) {
        Host host = make_file_host(&cancelled, loaded_.run.files);
        const auto shown_first = [this](auto read) {
            return [this, read](const std::string& path, const ReadLimit& limit) {
                const std::optional<std::size_t> shown = made_->find(path);
                return shown ? Result<std::string>(file_bytes(*made_->files[*shown].file))
                             : read(path, limit);
            };
        };
        host.read_file = shown_first(host.read_referenced_file);
        host.read_referenced_file = shown_first(host.read_referenced_file);
        return host;
    }

    void add_file(const std::string& path, std::string bytes) {
        if (path.empty() || path.starts_with("--") || made_->find(path)) {
            return; // the text of an option, or a file that was added already
        }
        const FileId id = made_->sources.add(path, std::move(bytes));
        const SourceFile& file = made_->sources.file(id);
        made_->files.push_back({path, &file, {}, {}, {}, columns_of(file)});
    }

    void add_loaded_files() {
        const auto add = [this](const SourceMap* sources) {
            for (std::uint32_t i = 0; sources != nullptr && i < sources->file_count(); ++i) {
                const SourceFile& file = sources->file(static_cast<FileId>(i));
                if (loaded_.is_forest ? is_grammar_of_scene(file.path())
                                      : !file.path().ends_with(".obj")) {
                    add_file(file.path(), file_bytes(file));
                }
            }
        };
        if (loaded_.is_forest) {
            add_files_of_disk(); // the files in the order of the scene
        }
        add(loaded_.sources.get());
        if (loaded_.messages != nullptr) {
            for (const Message& message : loaded_.messages->all()) {
                add(message.sources.get());
            }
        }
    }

    static bool is_grammar_of_scene(const std::string& path) {
        return has_grammar_extension(path) || path.ends_with(".toml");
    }

    void add_files_of_disk() {
        const auto add = [this](const std::string& path) {
            if (made_->find(path)) {
                return;
            }
            Result<std::string> bytes = project_.host.read_referenced_file(
                path, {kMaxSourceBytes, project_.limits.max_bytes});
            if (!bytes) {
                made_->failure = bytes.error().message;
            } else if (bytes.value().find('\0') != std::string::npos) {
                made_->failure = "is compiled, so it has no source";
            } else {
                add_file(path, std::move(bytes.value()));
            }
        };
        if (made_->files.empty()) {
            add(loaded_.file);
        }
        for (const std::string& path : loaded_.files) {
            if (is_grammar_of_scene(path)) {
                add(path);
            }
        }
        if (!made_->files.empty()) {
            made_->failure.clear();
        } else {
            made_->failure = fmt::format("`{}`: {}", loaded_.file, made_->failure);
        }
    }

    void colour(const ShownSource& root) {
        const FileLoader load = make_loader(project_, project_.limits.max_bytes);
        for (ColouredFile& coloured : coloured_files(root.path, file_bytes(*root.file), load)) {
            const std::optional<std::size_t> shown = made_->find(coloured.path);
            if (shown) {
                made_->files[*shown].tokens = std::move(coloured.tokens);
                made_->files[*shown].statements = std::move(coloured.statements);
            }
        }
    }

    /// Finds the tokens of a plant's grammar, and the fixes that are certain.
    void compile() {
        const std::array<std::string, 1> named{loaded_.file};
        scope_.emplace(loaded_.file, named);
        Outcome<GrammarText> text = read_grammar(loaded_.file, loaded_.options.dialect, project_);
        if (!text) {
            return;
        }
        if (text.value().dialect == Dialect::Lsys) {
            colour(made_->files.front());
        }
        if (!has_fixes()) {
            return;
        }
        const FileLoader load = make_loader(project_, project_.limits.max_bytes);
        Result<CompiledText> compiled = compile_text(loaded_.file, text.value(), loaded_.options,
                                                     project_.limits.max_modules, load);
        if (!compiled) {
            return;
        }
        compiled_ = std::move(compiled.value());
        if (!repair::offer_doubtful_fixes(loaded_.file, text.value(), loaded_.options, *scope_,
                                          project_, compiled_)) {
            compiled_.diagnostics.offer_fixes_from(0);
        }
        const std::vector<Diagnostic>& all = compiled_.diagnostics.all();
        made_->fix_count =
            static_cast<std::size_t>(std::count_if(all.begin(), all.end(), has_certain_fix));
        repair::FixedGrammar fixed;
        if (made_->fix_count != 0 &&
            repair::fix_text(loaded_.file, text.value(), loaded_.options, *scope_, project_,
                             repair::FixChoice::Certain, fixed)) {
            made_->fixed = std::move(fixed.changed);
        }
    }

    [[nodiscard]] bool has_fixes() const {
        if (loaded_.messages == nullptr) {
            return false;
        }
        const std::vector<Message>& all = loaded_.messages->all();
        return std::any_of(all.begin(), all.end(), [](const Message& message) {
            const std::vector<Diagnostic>& each = message.diagnostics.all();
            return std::any_of(each.begin(), each.end(), [](const Diagnostic& diagnostic) {
                return !diagnostic.fixes.empty();
            });
        });
    }

    void add_messages() {
        if (loaded_.messages == nullptr) {
            return;
        }
        for (const Message& message : loaded_.messages->all()) {
            for (const Diagnostic& diagnostic : message.diagnostics.all()) {
                if (message.sources != nullptr && diagnostic.span.file != kNoFile) {
                    add_message(diagnostic, *message.sources);
                }
            }
        }
        for (ShownSource& file : made_->files) {
            std::stable_sort(file.messages.begin(), file.messages.end(),
                             [](const SourceMessage& a, const SourceMessage& b) {
                                 return std::tie(a.line, a.begin) < std::tie(b.line, b.begin);
                             });
        }
    }

    void add_message(const Diagnostic& diagnostic, const SourceMap& sources) {
        const SourceFile& file = sources.file(diagnostic.span.file);
        const std::optional<std::size_t> shown = made_->find(file.path());
        if (!shown || made_->files[*shown].file->text() != file.text()) {
            return; // the file has changed since the message
        }
        SourceMessage& message = made_->files[*shown].messages.emplace_back();
        const LineColumn place = file.line_column(diagnostic.span.begin);
        const std::uint32_t begin = file.line_begin(place.line);
        const auto size = static_cast<std::uint32_t>(file.line_text(place.line).size());
        message.severity = diagnostic.severity;
        message.line = place.line;
        message.column = place.column;
        message.begin = std::min(diagnostic.span.begin - begin, size);
        message.end = std::clamp(diagnostic.span.end - begin, message.begin, size);
        message.label = diagnostic.label;
        message.text.push_back(
            {{severity_colour(diagnostic.severity),
              std::string(severity_name(diagnostic.severity)) + ": "},
             {TextColour::Bold, diagnostic.message},
             {TextColour::Plain, fmt::format(" [{}]", info(diagnostic.code).name)}});
        for (const Label& label : diagnostic.labels) {
            std::string text = label.text;
            if (label.span.file != kNoFile) {
                const SourceFile& other = sources.file(label.span.file);
                const LineColumn there = other.line_column(label.span.begin);
                text += fmt::format("{}{}:{}:{}", text.empty() ? "" : ": ", other.path(),
                                    there.line, there.column);
            }
            add_remark("note", TextColour::Cyan, text, message.text);
        }
        for (const std::string& note : diagnostic.notes) {
            add_remark("note", TextColour::Cyan, note, message.text);
        }
        for (const std::string& help : diagnostic.help) {
            add_remark("help", TextColour::Green, help, message.text);
        }
        add_fixes(diagnostic, sources, message);
    }

    void add_fixes(const Diagnostic& diagnostic, const SourceMap& sources, SourceMessage& message) {
        const std::string& path = sources.file(diagnostic.span.file).path();
        const Diagnostic* const judged = find_judged(diagnostic, path);
        for (std::size_t i = 0; i < diagnostic.fixes.size(); ++i) {
            const Fix& fix = diagnostic.fixes[i];
            SourceFix& made = message.fixes.emplace_back();
            made.title = fix.title;
            made.is_certain = judged != nullptr && judged->fixes[i].machine_applicable;
            for (const Edit& edit : fix.edits) {
                const std::string& to = sources.file(edit.span.file).path();
                made.edits[to].push_back(edit);
                if (loaded_.is_forest) {
                    made.refusal = "open the grammar alone to apply it";
                } else if (!scope_ || !scope_->contains(to)) {
                    made.refusal = fmt::format("`{}` lies outside the folder of the grammar", to);
                }
            }
            for (auto& [to, edits] : made.edits) {
                std::sort(edits.begin(), edits.end(),
                          [](const Edit& a, const Edit& b) { return a.span.begin < b.span.begin; });
            }
            made.preview = preview_of(diagnostic, fix, sources);
        }
    }

    /// The diagnostic of compiled_ that equals `diagnostic` in the file `path`; null if there is
    /// none.
    [[nodiscard]] const Diagnostic* find_judged(const Diagnostic& diagnostic,
                                                const std::string& path) const {
        for (const Diagnostic& each : compiled_.diagnostics.all()) {
            if (each.code == diagnostic.code && each.span.begin == diagnostic.span.begin &&
                each.span.end == diagnostic.span.end && each.message == diagnostic.message &&
                each.fixes.size() == diagnostic.fixes.size() && each.span.file != kNoFile &&
                compiled_.grammar.sources->file(each.span.file).path() == path) {
                return &each;
            }
        }
        return nullptr;
    }

    /// The lines that a fix changes, as messages show them.
    static std::vector<TextLine>
    preview_of(const Diagnostic& diagnostic, const Fix& fix, const SourceMap& sources) {
        Diagnostic alone = make_diagnostic(diagnostic.code, {}, {});
        alone.fixes = {fix};
        std::string text;
        render(alone, sources, {MessageFormat::Human, true}, text);
        std::vector<TextLine> lines = styled_lines(text);
        constexpr std::ptrdiff_t kHead = 2; // lines: head of the message, title of the fix
        lines.erase(lines.begin(),
                    lines.begin() + std::min(kHead, static_cast<std::ptrdiff_t>(lines.size())));
        return lines;
    }

    const LoadedSources& loaded_;
    Project project_;
    std::shared_ptr<SourceText> made_;      // the result
    CompiledText compiled_;                 // the file, with its diagnostics and fixes
    std::optional<repair::FixScope> scope_; // files that fixes may change
};

} // namespace

TextColour severity_colour(Severity severity) {
    switch (severity) {
    case Severity::Error:
        return TextColour::Red;
    case Severity::Warning:
        return TextColour::Yellow;
    case Severity::Note:
        break;
    }
    return TextColour::Cyan;
}

std::optional<std::size_t> SourceText::find(std::string_view path) const {
    const auto found = std::find_if(files.begin(), files.end(),
                                    [path](const ShownSource& each) { return each.path == path; });
    return found == files.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - files.begin()));
}

LineRange statement_at(const ShownSource& source, std::uint32_t line, std::uint32_t column) {
    const SourceFile& file = *source.file;
    line = std::clamp(line, 1U, file.line_count());
    std::string_view text = file.line_text(line);
    std::uint32_t offset = file.line_begin(line);
    for (std::uint32_t i = 1; i < column && !text.empty(); ++i) {
        const std::uint32_t length = decode_utf8(text).length;
        offset += length;
        text.remove_prefix(length);
    }
    const auto after = std::upper_bound(
        source.statements.begin(), source.statements.end(), offset,
        [](std::uint32_t at, const SourceSpan& statement) { return at < statement.begin; });
    if (after == source.statements.begin() || offset >= std::prev(after)->end) {
        return {line, line};
    }
    const SourceSpan& statement = *std::prev(after);
    return {file.line_column(statement.begin).line,
            file.line_column(std::max(statement.end, statement.begin + 1) - 1).line};
}

std::string file_bytes(const SourceFile& file) {
    std::string bytes(file.has_byte_order_mark() ? kSourceMark : "");
    bytes += file.text();
    return bytes;
}

std::string edited_bytes(const SourceFile& file, const std::vector<Edit>& edits) {
    std::vector<const Edit*> pointers;
    for (const Edit& edit : edits) {
        pointers.push_back(&edit);
    }
    std::string bytes(file.has_byte_order_mark() ? kSourceMark : "");
    bytes += repair::apply_edits(file.text(), pointers);
    return bytes;
}

std::shared_ptr<const SourceText> make_source_text(const SourceRequest& request,
                                                   const std::atomic<bool>& cancelled) {
    return catch_out_of_memory([&] { return Maker(request.loaded, cancelled).run(); },
                               [] {
                                   const auto failed = std::make_shared<SourceText>();
                                   failed->failure = "out of memory";
                                   return std::shared_ptr<const SourceText>(failed);
                               });
}

} // namespace lsys::view
