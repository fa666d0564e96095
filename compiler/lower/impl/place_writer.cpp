// SPDX-License-Identifier: MIT
#include "compiler/lower/impl/place_writer.h"

#include "compiler/program/module_text.h"
#include "grammar/base/cancellation.h"

#include <span>

namespace lsys {

PlaceWriter::PlaceWriter(const Program& program,
                         const Names& names,
                         const SourceMap& sources,
                         Bytecode& bytecode)
    : program_(program), names_(names), sources_(sources), runs_(bytecode.template_places) {
    spellings_.reserve(program.symbols.size());
    for (const Symbol& symbol : program.symbols) {
        const std::string_view name = names.text(symbol.name);
        spellings_.push_back(
            {static_cast<std::uint32_t>(name.size()),
             symbol.parameter_count != 0 && symbol.turtle != TurtleOperation::SaveBranch,
             name != "`"});
    }
}

void PlaceWriter::set_position(const SourceFile& file, std::uint32_t offset) {
    file_ = &file;
    text_ = file.text();
    offset_ = offset;
    place_ = file.line_column(offset);
}

bool PlaceWriter::move_to(std::uint32_t offset) {
    bool is_one_line = true;
    bool is_ascii = true;
    for (; offset_ < offset; ++offset_) {
        const auto c = static_cast<unsigned char>(text_[offset_]);
        is_ascii = is_ascii && c < 0x80;
        ++place_.column;
        if (c == '\n') {
            ++place_.line;
            place_.column = 1;
            is_one_line = false;
        }
    }
    if (!is_ascii) {
        place_ = file_->line_column(offset);
    }
    return is_one_line && is_ascii;
}

/// Length of a module with its arguments, in bytes. Inline because it runs for every module.
inline std::uint32_t PlaceWriter::length_of(const ProgramWord& word,
                                            const ProgramModule& module) const {
    constexpr std::uint32_t kQuotes = 2;
    const Spelling& spelling = spellings_[static_cast<std::size_t>(module.symbol)];
    std::uint32_t name = spelling.length;
    if (!program_.written_names.empty()) {
        name = name_length_in_source(word, module);
    } else if (spelling.may_be_quoted && text_[module.begin] == '`') {
        name += kQuotes;
    }
    if (!spelling.has_arguments) {
        return name;
    }
    return static_cast<std::uint32_t>(end_of_arguments(text_, module.begin + name)) - module.begin;
}

/// Length of the name as its file spells it, in bytes.
std::uint32_t PlaceWriter::name_length_in_source(const ProgramWord& word,
                                                 const ProgramModule& module) const {
    const SourceSpan span =
        module_name_span(sources_, word.file, module.begin,
                         names_.text(program_.symbol(module.symbol).name), program_.written_names);
    return span.end - span.begin;
}

void PlaceWriter::word(const ProgramWord& word, std::uint32_t first) {
    std::uint32_t code = first;
    PlaceRun run; // the current run, not yet in runs_
    std::size_t index = word.first_module;
    for (const std::size_t end = index + word.module_count; index < end;) {
        stop_if_cancelled();
        const std::span<const ProgramModule> row = program_.modules.row(index, end - index);
        index += row.size();
        for (const ProgramModule module : row) {
            if (code == first) {
                set_position(sources_.file(word.file), module.begin);
            }
            // Modules of a translated grammar may share a place, and need not be in the order
            // of the text.
            const bool ascends = module.begin >= offset_;
            if (!ascends) {
                set_position(sources_.file(word.file), module.begin);
            }
            const std::uint32_t stride = module.begin - offset_;
            const bool is_plain = move_to(module.begin);
            const std::uint32_t length = length_of(word, module);
            if (is_plain && ascends && length == run.length && stride >= length &&
                (run.stride == stride || run.first + 1 == code)) {
                run.stride = stride;
            } else {
                if (code != first) {
                    runs_.push_back(run);
                }
                run = {code, module.begin, length, 0, place_.line, place_.column};
            }
            ++code;
        }
    }
    if (code != first) {
        runs_.push_back(run);
    }
}

} // namespace lsys
