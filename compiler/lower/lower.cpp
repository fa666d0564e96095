// SPDX-License-Identifier: MIT
#include "compiler/lower/lower.h"

#include "compiler/bytecode/distributions.h"
#include "compiler/bytecode/instructions.h"
#include "compiler/lower/impl/code_emitter.h"
#include "compiler/lower/impl/module_folder.h"
#include "compiler/lower/impl/place_writer.h"
#include "grammar/base/cancellation.h"
#include "grammar/base/contract.h"

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

class Lowerer {
public:
    Lowerer(const Program& program, const Names& names, const SourceMap& sources)
        : program_(program), names_(names), emitter_(program, sources, bytecode_),
          folder_(program, bytecode_), places_(program, names, sources, bytecode_) {}

    std::optional<Bytecode> run() {
        bytecode_.settings = program_.settings;
        bytecode_.generations = program_.generations;
        bytecode_.files = program_.files;
        bytecode_.rule_count = program_.rule_count;
        bytecode_.context_group_count = program_.context_group_count;
        for (const Curve& curve : program_.curves) {
            bytecode_.curves.push_back({std::string(names_.text(curve.name)), curve.points});
        }
        for (const ProgramContour& contour : program_.contours) {
            bytecode_.contours.push_back({std::string(names_.text(contour.name)), contour.points});
        }
        materials();
        environments();
        symbols();
        globals();
        bytecode_.template_codes.reserve(program_.modules.size());
        for (const Axiom& axiom : program_.axioms) {
            BytecodeAxiom& lowered = bytecode_.axioms.emplace_back();
            lowered.word = word(axiom.word);
            lowered.site = emitter_.add_site(axiom.word.span);
            lowered.draw_position = axiom.draw_position;
            lowered.weight = axiom.weight;
        }
        bytecode_.productions.reserve(program_.productions.size());
        for (const Production& production : program_.productions) {
            bytecode_.productions.push_back(lowered(production));
        }
        const CodeNeeds needs = needs_of(bytecode_.instructions);
        bytecode_.stack_depth = needs.stack_depth;
        bytecode_.local_count = needs.local_count;
        if (emitter_.overflowed()) {
            return std::nullopt;
        }
        return std::move(bytecode_);
    }

private:
    void materials() {
        for (const ProgramMaterial& material : program_.materials) {
            BytecodeMaterial& lowered = bytecode_.materials.emplace_back();
            lowered.index = material.index;
            lowered.has_colour = material.colour.has_value();
            lowered.colour = material.colour.value_or(lowered.colour);
            lowered.picture = picture(material.picture);
            lowered.normal = picture(material.normal);
            lowered.has_roughness = material.roughness.has_value();
            lowered.roughness = material.roughness.value_or(0.0F);
            lowered.has_translucency = material.translucency.has_value();
            lowered.translucency = material.translucency.value_or(0.0F);
            lowered.has_sides = material.two_sided.has_value();
            lowered.two_sided = material.two_sided.value_or(false);
        }
        std::sort(bytecode_.materials.begin(), bytecode_.materials.end(),
                  [](const auto& a, const auto& b) { return a.index < b.index; });
    }

    void environments() {
        for (const ProgramEnvironment& environment : program_.environments) {
            BytecodeEnvironment& lowered = bytecode_.environments.emplace_back(environment.values);
            lowered.name = names_.text(environment.name);
            lowered.site = emitter_.add_site(environment.name_span);
            for (std::size_t i = 0; i < lowered.surfaces.size(); ++i) {
                lowered.surfaces[i].site = emitter_.add_site(environment.surface_spans[i]);
            }
        }
    }

    BytecodePicture picture(const MaterialPictureName& name) {
        return {name.path, name.path.empty() ? kNone : emitter_.add_site(name.span)};
    }

    void symbols() {
        bytecode_.symbols.reserve(program_.symbols.size());
        for (const Symbol& symbol : program_.symbols) {
            BytecodeSymbol& lowered = bytecode_.symbols.emplace_back();
            lowered.name = names_.text(symbol.name);
            lowered.parameter_count = symbol.parameter_count;
            lowered.kind = symbol.kind;
            lowered.ignored = symbol.ignored;
            lowered.turtle = symbol.turtle;
            lowered.mesh_file = symbol.mesh_file;
            lowered.sense = symbol.sense;
        }
    }

    void globals() {
        for (const Global& global : program_.globals) {
            BytecodeGlobal& lowered = bytecode_.globals.emplace_back();
            lowered.name = names_.text(global.name);
            lowered.instruction = emitter_.arguments({&global.value, 1});
            lowered.draw_position = global.draw_position;
            lowered.draw_count = global.draw_count;
            lowered.has_bounds = global.has_bounds;
            lowered.minimum = global.minimum;
            lowered.maximum = global.maximum;
            lowered.site = emitter_.add_site(global.span);
        }
    }

    /// Whether the local values need code: one of them is used and is not a leaf, or draws a random
    /// number, which may be a run-time error.
    bool needs_code(std::span<const LocalValue> locals) {
        return std::any_of(locals.begin(), locals.end(), [&](const LocalValue& local) {
            bool draws = false;
            for_each_value(program_, {local.value}, [&](ValueId, const Value& value) {
                draws = draws || is_draw(value.opcode);
            });
            const bool is_leaf = program_.value(local.value).left == kNoValue;
            return !is_leaf && (local.is_used || draws);
        });
    }

    WordTemplate word(const ProgramWord& word, std::span<const LocalValue> locals = {}) {
        WordTemplate word_template;
        word_template.codes.first = static_cast<std::uint32_t>(bytecode_.template_codes.size());
        word_template.codes.count = word.module_count;
        word_template.draw_count = word.draw_count;
        stored_arguments_.clear();
        std::size_t argument = word.first_argument;
        bytecode_.template_codes.resize(std::size_t{word_template.codes.first} + word.module_count);
        Code* next = bytecode_.template_codes.data() + word_template.codes.first;
        for_each_symbol(program_, word, [&](std::size_t, SymbolId symbol) {
            const std::uint32_t count = bytecode_.symbol(symbol).parameter_count;
            auto code = static_cast<Code>(symbol);
            if (count != 0) {
                code = folder_.code(symbol, argument);
                if (code == static_cast<Code>(symbol)) {
                    for (std::uint32_t k = 0; k < count; ++k) {
                        stored_arguments_.push_back(program_.arguments[argument + k]);
                    }
                }
                argument += count;
            }
            *next++ = code;
        });
        places_.word(word, word_template.codes.first);
        word_template.parameter_count = static_cast<std::uint32_t>(stored_arguments_.size());
        if (needs_code(locals)) {
            word_template.locals = emitter_.locals(locals);
        }
        if (!stored_arguments_.empty()) {
            word_template.arguments = emitter_.arguments(stored_arguments_);
        }
        if (word_template.locals == kNone && word_template.arguments == kNone) {
            word_template.draw_count = 0; // its draws are in operands that `if()` never chooses
        }
        return word_template;
    }

    TableRange pattern(const ProgramPattern& pattern) {
        TableRange range;
        range.first = static_cast<std::uint32_t>(bytecode_.patterns.size());
        range.count = static_cast<std::uint32_t>(pattern.items.size());
        for (const ProgramPatternItem& item : pattern.items) {
            bytecode_.patterns.push_back({item.kind, item.symbol, item.first_formal});
        }
        return range;
    }

    BytecodeProduction lowered(const Production& production) {
        stop_if_cancelled();
        BytecodeProduction lowered;
        lowered.name = names_.text(production.name);
        lowered.name_site = emitter_.add_site(production.name_span);
        lowered.rule = production.rule;
        lowered.group = production.group;
        lowered.stage = production.stage;
        lowered.has_left = production.has_left;
        lowered.has_right = production.has_right;
        lowered.left = pattern(production.left);
        lowered.predecessor = pattern(production.predecessor);
        lowered.right = pattern(production.right);
        lowered.formal_count = static_cast<std::uint32_t>(production.formals.size());
        if (production.condition != kNoValue) {
            lowered.condition = emitter_.condition(production.condition, production.condition_span);
        }
        lowered.stochastic = production.stochastic;
        if (production.weight_value != kNoValue) {
            lowered.weight_code =
                emitter_.condition(production.weight_value, production.weight_span);
        } else if (production.stochastic) {
            lowered.weight = production.weight;
        }
        lowered.successor = word(production.successor, production.locals);
        return lowered;
    }

    const Program& program_;
    const Names& names_;
    Bytecode bytecode_;
    CodeEmitter emitter_;
    ModuleFolder folder_;
    PlaceWriter places_;
    std::vector<ValueId> stored_arguments_; // arguments of the current word
};

} // namespace

std::optional<Bytecode>
lower(const Program& program, const Names& names, const SourceMap& sources) {
    LSYS_CHECK(program.is_valid);
    return Lowerer(program, names, sources).run();
}

} // namespace lsys
