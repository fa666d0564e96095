// SPDX-License-Identifier: MIT
#include "packaging/pages/manual_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>

namespace lsys::pages {

namespace {

/// Escapes characters that man(7) reads as commands or prints as typographic characters.
std::string escape(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
        case '\\':
            escaped += "\\e";
            break;
        case '-':
            escaped += "\\-";
            break;
        case '`':
            escaped += "\\(ga";
            break;
        case '\'':
            escaped += "\\(aq";
            break;
        case '"':
            escaped += "\\(dq";
            break;
        case '^':
            escaped += "\\(ha";
            break;
        case '~':
            escaped += "\\(ti";
            break;
        default:
            escaped += c;
        }
    }
    return escaped.starts_with('.') ? "\\&" + escaped : escaped;
}

/// Escapes a text of --help; code between backquotes becomes bold.
std::string prose(std::string_view text) {
    std::string escaped;
    while (true) {
        const std::size_t begin = text.find('`');
        const std::size_t end = begin == std::string_view::npos ? begin : text.find('`', begin + 1);
        if (end == std::string_view::npos) {
            return escaped + escape(text);
        }
        const std::string_view before = text.substr(0, begin);
        escaped += before.empty() ? std::string() : escape(before);
        escaped += "\\fB" + escape(text.substr(begin + 1, end - begin - 1)) + "\\fR";
        text.remove_prefix(end + 1);
    }
}

/// prose() wrapped at blanks to lines of at most 80 bytes; longer words are kept whole.
std::string filled(std::string_view text) {
    constexpr std::size_t kLineLength = 80;
    std::istringstream words(prose(text));
    std::string lines;
    std::size_t column = 0;
    for (std::string word; words >> word;) {
        if (column > 0 && column + 1 + word.size() > kLineLength) {
            lines += word.starts_with('.') ? "\n\\&" : "\n";
            column = 0;
        } else if (column > 0) {
            lines += ' ';
            ++column;
        }
        lines += word;
        column += word.size();
    }
    return lines;
}

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

/// The description of a program or command as in the section NAME of man pages: without the final
/// dot, and with a small first letter.
std::string name_line(std::string text) {
    while (!text.empty() && text.back() == '.') {
        text.pop_back();
    }
    if (!text.empty()) {
        text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
    }
    return text;
}

void begin_page(std::string& page,
                const std::string& name,
                const std::string& program,
                const std::string& description,
                const PageInfo& info) {
    page += fmt::format(".TH {} 1 {} \"{} {}\" \"User Commands\"\n", escape(upper(name)), info.date,
                        program, info.version);
    page += fmt::format(".SH NAME\n{} \\- {}\n", escape(name), prose(name_line(description)));
}

/// Values of an option: placeholders are italic, words are bold.
std::string value_text(const OptionText& option) {
    return fmt::format("\\f{}{}\\fR", option.kind == ValueKind::Words ? 'B' : 'I',
                       escape(option.value));
}

void add_option(std::string& page, const OptionText& option) {
    page += ".TP\n";
    if (option.names.empty()) {
        page += value_text(option) + (option.repeatable ? " ..." : "");
    }
    for (std::size_t i = 0; i < option.names.size(); ++i) {
        page += fmt::format("{}\\fB{}\\fR", i == 0 ? "" : ", ", escape(option.names[i]));
    }
    if (option.optional_value) {
        page += "[=";
        for (std::size_t i = 0; i < option.words.size(); ++i) {
            page += fmt::format("{}\\fB{}\\fR", i == 0 ? "" : "|", escape(option.words[i]));
        }
        page += ']';
    } else if (!option.names.empty() && option.kind != ValueKind::None) {
        page += ' ' + value_text(option);
    }
    page += '\n' + filled(option.description) + '\n';
}

void add_options(std::string& page, const CommandText& command) {
    if (!command.positionals.empty()) {
        page += ".SH ARGUMENTS\n";
        for (const OptionText& option : command.positionals) {
            add_option(page, option);
        }
    }
    page += ".SH OPTIONS\n";
    std::vector<std::string> groups;
    for (const OptionText& option : command.options) {
        if (std::find(groups.begin(), groups.end(), option.group) == groups.end()) {
            groups.push_back(option.group);
        }
    }
    for (const std::string& group : groups) {
        if (groups.size() > 1) {
            page += fmt::format(".SS {}\n", escape(group));
        }
        for (const OptionText& option : command.options) {
            if (option.group == group) {
                add_option(page, option);
            }
        }
    }
}

/// The parts of the footer of --help.
struct Footer {
    std::string notes;    // as man(7)
    std::string examples; // as man(7)
};

void add_paragraph(std::string& text, std::string& paragraph) {
    if (!paragraph.empty()) {
        text += (text.empty() ? "" : ".PP\n") + filled(paragraph) + '\n';
        paragraph.clear();
    }
}

/// Lines that begin with two blanks are a table. Lines after `Example:` or `Examples:` are
/// commands. `Exit status: ...` is omitted, because pages have a section about it.
Footer read_footer(const std::string& footer) {
    Footer parts;
    std::istringstream lines(footer);
    std::string paragraph;
    bool in_table = false;
    bool in_examples = false;
    bool in_status = false;
    for (std::string line; std::getline(lines, line);) {
        const bool begins_examples =
            line.starts_with("Example: ") || line.starts_with("Examples: ");
        if (begins_examples) {
            in_examples = true;
            line.erase(0, line.find(": ") + 2);
        }
        in_status =
            !begins_examples && !line.empty() && (in_status || line.starts_with("Exit status: "));
        if (in_examples) {
            const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
            parts.examples += escape(line.substr(begin)) + '\n';
            continue;
        }
        if (in_status) {
            continue;
        }
        const bool is_row = line.starts_with("  ");
        if (is_row != in_table || line.empty()) {
            add_paragraph(parts.notes, paragraph);
        }
        if (is_row != in_table) {
            parts.notes += is_row ? ".PP\n.nf\n" : ".fi\n";
            in_table = is_row;
        }
        if (is_row) {
            parts.notes += escape(line) + '\n';
        } else if (!line.empty()) {
            paragraph += (paragraph.empty() ? "" : " ") + line;
        }
    }
    add_paragraph(parts.notes, paragraph);
    parts.notes += in_table ? ".fi\n" : "";
    return parts;
}

void add_section(std::string& page, const char* name, const std::string& text) {
    if (!text.empty()) {
        page += fmt::format(".SH {}\n{}", name, text);
    }
}

/// Sections after the options.
void end_page(std::string& page,
              const std::string& name,
              const Footer& footer,
              const PageInfo& info) {
    std::string statuses;
    for (const auto& [number, meaning] : info.statuses) {
        statuses += fmt::format(".TP\n\\fB{}\\fR\n{}\n", number, filled(meaning));
    }
    add_section(page, "EXIT STATUS", statuses);
    add_section(page, "EXAMPLES",
                footer.examples.empty() ? std::string() : ".EX\n" + footer.examples + ".EE\n");
    std::string others;
    for (const std::string& other : info.see_also) {
        if (other != name) {
            others += fmt::format("{}.BR {} (1)", others.empty() ? "" : " ,\n", escape(other));
        }
    }
    add_section(page, "SEE ALSO", others.empty() ? others : others + '\n');
}

void add_synopsis(std::string& page, const std::string& words, const CommandText& command) {
    page += fmt::format(".SH SYNOPSIS\n.B {}\n[\\fIOPTION\\fR]...", escape(words));
    for (const OptionText& option : command.positionals) {
        const std::string value = value_text(option);
        page += option.required ? " " + value : " [" + value + "]";
        page += option.repeatable ? "..." : "";
    }
    for (const OptionText& option : command.options) {
        if (option.required) {
            page += fmt::format(" \\fB{}\\fR {}", escape(option.names.front()), value_text(option));
        }
    }
    page += '\n';
}

} // namespace

std::string
command_page(const std::string& program, const CommandText& command, const PageInfo& info) {
    const std::string name = program + "-" + command.name;
    const Footer footer = read_footer(command.footer);
    std::string page;
    begin_page(page, name, program, command.description, info);
    add_synopsis(page, program + " " + command.name, command);
    page += ".SH DESCRIPTION\n" + filled(command.description) + ".\n";
    page += footer.notes.empty() ? "" : ".PP\n" + footer.notes;
    add_options(page, command);
    end_page(page, name, footer, info);
    return page;
}

std::string program_page(const ProgramText& program, const PageInfo& info) {
    const CommandText& self = program.program;
    const Footer footer = read_footer(self.footer);
    std::string page;
    begin_page(page, self.name, self.name, self.description, info);
    add_synopsis(page, self.name, self);
    if (!program.commands.empty()) {
        page += fmt::format(".br\n.B {}\n\\fICOMMAND\\fR [\\fIOPTION\\fR]... \\fIARGUMENT\\fR...\n",
                            self.name);
    }
    page += ".SH DESCRIPTION\n" + filled(self.description) + '\n';
    page += footer.notes.empty() ? "" : ".PP\n" + footer.notes;
    if (!program.commands.empty()) {
        page += ".SH COMMANDS\n";
        for (const CommandText& command : program.commands) {
            page += fmt::format(".TP\n.BR {} (1)\n{}.\n", escape(self.name + "-" + command.name),
                                prose(command.description));
        }
    }
    add_options(page, self);
    end_page(page, self.name, footer, info);
    return page;
}

} // namespace lsys::pages
