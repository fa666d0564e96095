// SPDX-License-Identifier: MIT
#include "compiler/program/program_dump.h"

#include "compiler/bytecode/distributions.h"
#include "compiler/bytecode/environment_keys.h"
#include "grammar/base/contract.h"
#include "grammar/base/counted_text.h"
#include "grammar/base/number_chars.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace lsys {

namespace {

void append_number(std::string& out, float value) {
    char buffer[32];
    const auto end = number_to_chars(buffer, buffer + sizeof buffer, value).ptr;
    out.append(buffer, end);
}

class Dumper {
public:
    Dumper(const Program& program, const Names& names, bool has_labels)
        : program_(program), names_(names), has_labels_(has_labels) {}

    std::string run() {
        settings();
        symbols();
        curves();
        contours();
        materials();
        environments();
        constants();
        for (const Axiom& axiom : program_.axioms) {
            out_ += "axiom";
            if (axiom.has_weight) {
                out_ += " ~ ";
                append_number(out_, axiom.weight);
            }
            out_ += "\n  ";
            word(axiom.word, nullptr);
            out_ += '\n';
        }
        out_ += fmt::format("productions: {}, {}\n", counted(program_.rule_count, "rule"),
                            counted(program_.context_group_count, "group"));
        for (const Production& each : program_.productions) {
            production(each);
        }
        return std::move(out_);
    }

private:
    void settings() {
        const Settings& s = program_.settings;
        const bool has_stages =
            !program_.productions.empty() && program_.productions.back().stage != Stage::Rewrite;
        out_ += "settings\n";
        for (const SettingGroup group : enumerators_of<SettingGroup>()) {
            if (group != SettingGroup::None &&
                (group != SettingGroup::Random || s.random != RandomSource::Philox) &&
                (group != SettingGroup::Stages || has_stages)) {
                setting_line(group);
            }
        }
        if (s.has_tropism) {
            out_ += fmt::format("  tropism {} {} {} {}\n", s.tropism[0], s.tropism[1], s.tropism[2],
                                s.tropism[3]);
        }
        if (has_tropisms(s.tropisms)) {
            out_ += "  tropisms";
            for (const StepTropism& each : s.tropisms) {
                if (each.kind != TropismKind::None) {
                    out_ += fmt::format(" {} {} {} {} {} {} {}", name_of(each.kind),
                                        each.direction[0], each.direction[1], each.direction[2],
                                        each.strength, each.increment, each.angle);
                }
            }
            out_ += '\n';
        }
        if (s.width_unit != WidthUnit::Metres) {
            out_ += fmt::format("  width_unit {}\n", name_of(s.width_unit));
        }
        if (s.colour != 0) {
            out_ += fmt::format("  colour {}\n", s.colour);
        }
        if (s.colour_increment != 1) {
            out_ += fmt::format("  colour_increment {}\n", s.colour_increment);
        }
        if (s.scale != 1.0F) {
            out_ += fmt::format("  scale {}\n", s.scale);
        }
        if (s.word_shape != WordShape::Line) {
            out_ += fmt::format("  word_shape {}\n", name_of(s.word_shape));
        }
        if (s.height != 0.0F) {
            out_ += fmt::format("  height {}\n", s.height);
        }
        if (s.pipe.is_set()) {
            out_ += fmt::format("  pipe {} {}{}\n", s.pipe.exponent, s.pipe.tip_width,
                                s.pipe.taper == 0.0F ? "" : fmt::format(" {}", s.pipe.taper));
        }
        if (s.flare != Flare{}) {
            out_ += fmt::format("  flare {} {}{}\n", s.flare.factor, s.flare.height,
                                s.flare.roots == 0 ? "" : fmt::format(" {}", s.flare.roots));
        }
        if (s.collar != 0.0F) {
            out_ += fmt::format("  collar {}\n", s.collar);
        }
        if (s.tips != TipShape::Flat) {
            out_ += fmt::format("  tips {}\n", name_of(s.tips));
        }
        if (s.has_spring) {
            out_ += fmt::format("  spring {}\n", s.spring);
        }
        if (s.has_seed) {
            out_ += fmt::format("  seed {}\n", s.seed);
        }
        if (program_.generations) {
            out_ += fmt::format("generations {}\n", *program_.generations);
        }
    }

    /// Appends the settings of a group as one line: numbers first, then words.
    void setting_line(SettingGroup group) {
        std::vector<std::string> numbers;
        std::vector<std::string> modes;
        for_each_setting(program_.settings, [&](const SettingRow& row, const auto& value) {
            if constexpr (requires { name_of(value); }) {
                if (row.group == group) {
                    modes.push_back(fmt::format("{} {}", row.name, name_of(value)));
                }
            } else if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>) {
                if (row.group == group) {
                    numbers.push_back(fmt::format("{} {}", row.name, value));
                }
            }
        });
        numbers.insert(numbers.end(), modes.begin(), modes.end());
        out_ += fmt::format("  {}\n", fmt::join(numbers, ", "));
    }

    void symbols() {
        out_ += "symbols\n";
        for (std::size_t i = 0; i < program_.symbols.size(); ++i) {
            const Symbol& symbol = program_.symbols[i];
            out_ += fmt::format("  {} ", i);
            name(symbol.name);
            if (symbol.parameter_count != 0) {
                out_ += fmt::format("/{}", symbol.parameter_count);
            }
            if (symbol.turtle != TurtleOperation::Nothing) {
                out_ += fmt::format(" {}", name_of(symbol.turtle));
            }
            if (!symbol.mesh_file.empty()) {
                out_ += fmt::format(" \"{}\"", symbol.mesh_file);
            }
            out_ += symbol.ignored ? " ignored\n" : "\n";
        }
    }

    template <typename Points>
    void points(const Points& list) {
        for (std::size_t i = 0; i < list.size(); ++i) {
            out_ += i == 0 ? " " : ", ";
            append_number(out_, list[i].x);
            out_ += ' ';
            append_number(out_, list[i].y);
        }
        out_ += '\n';
    }

    void curves() {
        for (const Curve& curve : program_.curves) {
            out_ += "curve ";
            name(curve.name);
            points(curve.points);
        }
    }

    void contours() {
        for (const ProgramContour& contour : program_.contours) {
            out_ += "contour ";
            name(contour.name);
            points(contour.points);
        }
    }

    void materials() {
        for (const ProgramMaterial& material : program_.materials) {
            out_ += fmt::format("material {}", material.index);
            const auto number = [&](const char* key, float value) {
                out_ += key;
                append_number(out_, value);
            };
            if (material.colour) {
                out_ += " colour";
                for (const float part : *material.colour) {
                    number(" ", part);
                }
            }
            if (!material.picture.path.empty()) {
                out_ += fmt::format(" picture \"{}\"", material.picture.path);
            }
            if (!material.normal.path.empty()) {
                out_ += fmt::format(" normal \"{}\"", material.normal.path);
            }
            if (material.roughness) {
                number(" roughness ", *material.roughness);
            }
            if (material.translucency) {
                number(" translucency ", *material.translucency);
            }
            if (material.two_sided) {
                out_ += *material.two_sided ? " two_sided 1" : " two_sided 0";
            }
            out_ += '\n';
        }
    }

    void environments() {
        for (const ProgramEnvironment& environment : program_.environments) {
            out_ += "sense ";
            name(environment.name);
            out_ += ' ' + environment_text(environment.values) + '\n';
        }
    }

    void constants() {
        if (program_.constants.empty()) {
            return;
        }
        out_ += "constants\n";
        for (const Constant& constant : program_.constants) {
            out_ += constant.is_param ? "  param " : "  define ";
            out_ += names_.text(constant.name);
            out_ += " = ";
            if (constant.is_random) {
                const Global& global = program_.globals[constant.global];
                value(global.value, nullptr);
                out_ += fmt::format(", drawn at {}", global.draw_position);
            } else {
                append_number(out_, constant.value);
            }
            if (constant.is_param) {
                out_ += " in [";
                append_number(out_, constant.minimum);
                out_ += ", ";
                append_number(out_, constant.maximum);
                out_ += "]";
            }
            out_ += '\n';
        }
    }

    /// A name as a grammar writes it: identifiers and one-character symbols bare, others in back
    /// quotes.
    void name(NameId id) {
        const std::string_view text = names_.text(id);
        const bool plain =
            is_identifier(text) || is_sense_name(text) ||
            (text.size() == 1 && std::string_view("+-/\\^&|$!\"'.[]{}%").find(text) != text.npos);
        out_ += plain ? std::string(text) : fmt::format("`{}`", text);
    }

    void production(const Production& production) {
        out_ += "  ";
        if (production.stage != Stage::Rewrite) {
            out_ += keyword_of(production.stage);
            out_ += ' ';
        }
        out_ += has_labels_ ? names_.text(production.name) : std::string_view();
        out_ += fmt::format(" (rule {}, group {})\n    ", production.rule, production.group);
        if (production.has_left) {
            pattern(production.left, production);
            out_ += " < ";
        }
        pattern(production.predecessor, production);
        if (production.has_right) {
            out_ += " > ";
            pattern(production.right, production);
        }
        out_ += " : ";
        if (production.condition == kNoValue) {
            out_ += '*';
        } else {
            value(production.condition, &production);
        }
        if (production.stochastic) {
            out_ += " ~ ";
            if (production.weight_value == kNoValue) {
                append_number(out_, production.weight);
            } else {
                value(production.weight_value, &production);
            }
        }
        for (std::size_t i = 0; i < production.locals.size(); ++i) {
            out_ += i == 0 ? " : let " : ", ";
            out_ += names_.text(production.locals[i].name);
            out_ += " = ";
            value(production.locals[i].value, &production);
        }
        out_ += " : ";
        word(production.successor, &production);
        if (production.successor.draw_count != 0) {
            out_ += fmt::format("  ({} draws)", production.successor.draw_count);
        }
        out_ += '\n';
    }

    void pattern(const ProgramPattern& pattern, const Production& production) {
        const char* separator = "";
        for (const ProgramPatternItem& item : pattern.items) {
            out_ += separator;
            separator = " ";
            if (item.kind != PatternKind::Module) {
                out_ += item.kind == PatternKind::Open ? '[' : ']';
                continue;
            }
            const Symbol& symbol = program_.symbol(item.symbol);
            name(symbol.name);
            for (std::uint32_t i = 0; i < symbol.parameter_count; ++i) {
                out_ += i == 0 ? "(" : ", ";
                out_ += names_.text(production.formals[item.first_formal + i]);
            }
            out_ += symbol.parameter_count != 0 ? ")" : "";
        }
    }

    /// `production`: the production of the word; the arguments name its formals. Null for an axiom.
    void word(const ProgramWord& word, const Production* production) {
        std::size_t argument = word.first_argument;
        for (std::uint32_t i = 0; i < word.module_count; ++i) {
            const Symbol& symbol = program_.symbol(program_.modules[word.first_module + i].symbol);
            out_ += i == 0 ? "" : " ";
            name(symbol.name);
            for (std::uint32_t k = 0; k < symbol.parameter_count; ++k, ++argument) {
                out_ += k == 0 ? "(" : ", ";
                value(program_.arguments[argument], production);
            }
            out_ += symbol.parameter_count != 0 ? ")" : "";
        }
    }

    /// Writes operations as functions of their operands, so that readers need no precedence.
    /// Iterative, since an expression may be nested as deep as its file is long. `production`: null
    /// outside of productions.
    void value(ValueId root, const Production* production) {
        struct Step {
            ValueId value;
            const char* text; // if not null, written in place of `value`
        };
        std::vector<Step> steps{{root, nullptr}};
        while (!steps.empty()) {
            const Step step = steps.back();
            steps.pop_back();
            if (step.text != nullptr) {
                out_ += step.text;
                continue;
            }
            const Value& value = program_.value(step.value);
            if (value.left == kNoValue) {
                leaf(value, production);
                continue;
            }
            out_ += info(value.opcode).mnemonic;
            if (value.opcode == Opcode::Curve) {
                out_ += fmt::format("#{}", names_.text(program_.curves[value.index].name));
            }
            if (is_draw(value.opcode) || value.opcode == Opcode::SetLocal) {
                out_ += fmt::format("#{}", value.index);
            }
            out_ += '(';
            steps.push_back({kNoValue, ")"});
            std::array<ValueId, 3> operands = value.operands(); // in the order of a call
            if (value.opcode == Opcode::Mix) {
                operands = {value.left, value.right, value.third};
            }
            for (std::size_t i = operands.size(); i-- > 0;) {
                if (operands[i] != kNoValue) {
                    steps.push_back({operands[i], nullptr});
                    if (i > 0 && operands[i - 1] != kNoValue) {
                        steps.push_back({kNoValue, ", "});
                    }
                }
            }
        }
    }

    void leaf(const Value& value, const Production* production) {
        switch (value.opcode) {
        case Opcode::Literal:
            append_number(out_, value.literal);
            return;
        case Opcode::Formal:
            LSYS_CHECK(production != nullptr);
            out_ += names_.text(production->formals[value.index]);
            return;
        case Opcode::Local:
            if (production != nullptr && value.index < production->locals.size()) {
                out_ += names_.text(production->locals[value.index].name);
            } else {
                out_ += fmt::format("slot#{}", value.index);
            }
            return;
        case Opcode::Global:
            out_ += names_.text(program_.globals[value.index].name);
            return;
        default:
            out_ += info(value.opcode).mnemonic;
            out_ += "()";
            return;
        }
    }

    const Program& program_;
    const Names& names_;
    bool has_labels_; // write the names of productions
    std::string out_;
};

} // namespace

std::string dump_program(const Program& program, const Names& names) {
    return Dumper(program, names, true).run();
}

std::string dump_without_labels(const Program& program, const Names& names) {
    return Dumper(program, names, false).run();
}

} // namespace lsys
