// SPDX-License-Identifier: MIT
#include "compiler/bytecode/disassemble.h"

#include "compiler/bytecode/environment_keys.h"
#include "compiler/bytecode/instructions.h"
#include "grammar/base/counted_text.h"
#include "grammar/base/number_chars.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace lsys {

namespace {

class Listing {
public:
    explicit Listing(const Bytecode& bytecode) : bytecode_(bytecode) {}

    std::string run() {
        header();
        symbols();
        contours();
        materials();
        environments();
        for (std::size_t i = 0; i < bytecode_.globals.size(); ++i) {
            global(i);
        }
        for (const BytecodeAxiom& axiom : bytecode_.axioms) {
            line("\naxiom{}{}",
                 bytecode_.axioms.size() > 1 ? ", probability " + real(axiom.weight) : "",
                 at_site(axiom.site));
            word(axiom.word);
        }
        for (std::size_t i = 0; i < bytecode_.productions.size(); ++i) {
            production(i);
        }
        return std::move(out_);
    }

private:
    template <typename... Values>
    void line(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Values>(values)...);
        out_ += '\n';
    }

    static std::string real(float value) {
        char buffer[32];
        const auto end = number_to_chars(std::begin(buffer), std::end(buffer), value).ptr;
        return {buffer, end};
    }

    std::string at_site(std::uint32_t index) const {
        if (index == kNone) {
            return {};
        }
        const Site& site = bytecode_.sites[index];
        return fmt::format("  ; {}:{}:{}",
                           bytecode_.files[static_cast<std::size_t>(site.span.file)], site.line,
                           site.column);
    }

    void header() {
        const Settings& s = bytecode_.settings;
        line("rewriting {}, choice {}, weights {}, turtle {}", name_of(s.rewriting),
             name_of(s.choice), name_of(s.weights), name_of(s.turtle));
        if (bytecode_.generations) {
            line("generations {}", *bytecode_.generations);
        }
        line("{}, {}, {} of {}", counted(bytecode_.rule_count, "rule"),
             counted(bytecode_.context_group_count, "group"),
             counted(bytecode_.code_count(), "code"),
             counted(code_width(bytecode_.code_count()), "byte"));
    }

    void symbols() {
        line("\nsymbols");
        for (std::size_t i = 0; i < bytecode_.symbols.size(); ++i) {
            const BytecodeSymbol& symbol = bytecode_.symbols[i];
            line("{:5} {}/{}{} {}{}{}", i, symbol.name, symbol.parameter_count,
                 symbol.ignored ? " ignored" : "", name_of(symbol.turtle),
                 symbol.mesh_file.empty() ? "" : " \"" + symbol.mesh_file + '"',
                 sense_text(symbol.sense));
        }
        for (std::size_t i = 0; i < bytecode_.folded.size(); ++i) {
            line("{:5} {}", bytecode_.symbols.size() + i,
                 code_text(static_cast<Code>(bytecode_.symbols.size() + i)));
        }
    }

    /// " asks N" with the index N of an environment, or " asks the turtle".
    static std::string sense_text(Sense sense) {
        return asks_environment(sense) ? fmt::format(" asks {}", static_cast<std::uint32_t>(sense))
               : sense == Sense::Nothing ? ""
                                         : " asks the turtle";
    }

    void contours() {
        if (!bytecode_.contours.empty()) {
            line("\ncontours");
        }
        for (const BytecodeContour& contour : bytecode_.contours) {
            std::string text;
            for (const ContourPoint& point : contour.points) {
                text +=
                    fmt::format("{} {} {}", text.empty() ? "" : ",", real(point.x), real(point.y));
            }
            line("      {}{}", contour.name, text);
        }
    }

    void materials() {
        if (!bytecode_.materials.empty()) {
            line("\nmaterials");
        }
        for (const BytecodeMaterial& m : bytecode_.materials) {
            std::string text;
            if (m.has_colour) {
                text += fmt::format(" colour {} {} {}", real(m.colour[0]), real(m.colour[1]),
                                    real(m.colour[2]));
            }
            text += m.picture.path.empty() ? "" : fmt::format(" picture \"{}\"", m.picture.path);
            text += m.normal.path.empty() ? "" : fmt::format(" normal \"{}\"", m.normal.path);
            text += m.has_roughness ? " roughness " + real(m.roughness) : "";
            text += m.has_translucency ? " translucency " + real(m.translucency) : "";
            text += !m.has_sides ? "" : m.two_sided ? " two_sided 1" : " two_sided 0";
            line("{:5}{}", m.index, text);
        }
    }

    void environments() {
        if (!bytecode_.environments.empty()) {
            line("\nenvironments");
        }
        for (std::size_t i = 0; i < bytecode_.environments.size(); ++i) {
            const BytecodeEnvironment& each = bytecode_.environments[i];
            line("{:5} {} {}", i, each.name, environment_text(each));
        }
    }

    std::string code_text(Code code) const {
        const BytecodeSymbol& symbol = bytecode_.symbol(bytecode_.symbol_of(code));
        std::string text = symbol.name;
        if (code < bytecode_.symbols.size()) {
            if (symbol.parameter_count != 0) {
                text += fmt::format("/{}", symbol.parameter_count);
            }
            return text;
        }
        const FoldedModule& module = bytecode_.folded[code - bytecode_.symbols.size()];
        for (std::uint32_t i = 0; i < symbol.parameter_count; ++i) {
            text += i == 0 ? '(' : ',';
            text += real(bytecode_.constants[module.first_constant + i]);
        }
        return text + ')';
    }

    void global(std::size_t index) {
        const BytecodeGlobal& global = bytecode_.globals[index];
        line("\nglobal {} {}{}{}", index, global.name,
             global.has_bounds
                 ? fmt::format(" {{{}, {}}}", real(global.minimum), real(global.maximum))
                 : "",
             at_site(global.site));
        code(global.instruction);
    }

    void production(std::size_t index) {
        const BytecodeProduction& p = bytecode_.productions[index];
        std::string head;
        if (p.has_left) {
            head += pattern(p.left) + " < ";
        }
        head += pattern(p.predecessor);
        if (p.has_right) {
            head += " > " + pattern(p.right);
        }
        line("\nproduction {} {}: {}{}", index, p.name, head, at_site(p.name_site));
        line("  {}rule {}, group {}{}",
             p.stage == Stage::Rewrite ? "" : std::string(keyword_of(p.stage)) + ", ", p.rule,
             p.group,
             !p.stochastic            ? ""
             : p.weight_code != kNone ? ", computed weight"
                                      : ", probability " + real(p.weight));
        if (p.condition != kNone) {
            line("  condition");
            code(p.condition);
        }
        if (p.weight_code != kNone) {
            line("  weight");
            code(p.weight_code);
        }
        line("  successor");
        word(p.successor);
    }

    std::string pattern(TableRange range) const {
        std::string text;
        for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
            const PatternItem& item = bytecode_.patterns[i];
            if (!text.empty()) {
                text += ' ';
            }
            if (item.kind != PatternKind::Module) {
                text += item.kind == PatternKind::Open ? '[' : ']';
                continue;
            }
            const BytecodeSymbol& symbol = bytecode_.symbol(item.symbol);
            text += symbol.name;
            for (std::uint32_t k = 0; k < symbol.parameter_count; ++k) {
                text += fmt::format("{}${}", k == 0 ? "(" : ",", item.first_formal + k);
            }
            text += symbol.parameter_count != 0 ? ")" : "";
        }
        return text;
    }

    void word(const WordTemplate& word) {
        std::string text = "    codes";
        for (std::uint32_t i = word.codes.first; i < word.codes.first + word.codes.count; ++i) {
            text += ' ';
            text += code_text(bytecode_.template_codes[i]);
        }
        line("{}", text);
        if (word.locals != kNone) {
            line("    local values");
            code(word.locals);
        }
        if (word.arguments != kNone) {
            line("    {} parameters, {} draws", word.parameter_count, word.draw_count);
            code(word.arguments);
        }
    }

    void code(std::uint32_t first) {
        std::uint32_t site = kNone;
        for (const Instruction each : InstructionRange(bytecode_.instructions, first)) {
            const OpcodeInfo& row = info(each.opcode);
            std::string text = fmt::format("{:8} {}", each.at, row.mnemonic);
            switch (row.operand) {
            case OperandKind::None:
                break;
            case OperandKind::Literal:
                text += ' ' + real(each.literal);
                break;
            case OperandKind::Formal:
                text += fmt::format(" ${}", each.operand);
                break;
            case OperandKind::Global:
                text += ' ' + bytecode_.globals[each.operand].name;
                break;
            case OperandKind::Curve:
                text += ' ' + bytecode_.curves[each.operand].name;
                break;
            case OperandKind::Skip:
                text += fmt::format(" to {}", each.at + each.operand + 1);
                break;
            case OperandKind::Local:
            case OperandKind::Draw:
            case OperandKind::Branch:
                text += fmt::format(" {}", each.operand);
                break;
            }
            const std::uint32_t here = site_of(bytecode_, each.at);
            if (here != site) {
                text = fmt::format("{:<30}{}", text, at_site(here));
                site = here;
            }
            line("{}", text);
        }
    }

    const Bytecode& bytecode_;
    std::string out_;
};

} // namespace

std::string disassemble(const Bytecode& bytecode) {
    return Listing(bytecode).run();
}

} // namespace lsys
