// SPDX-License-Identifier: MIT
#include "web/binding/impl/operations.h"

#include "compiler/bytecode/module_file.h"
#include "grammar/ast/parse_context.h"
#include "grammar/format/format.h"
#include "grammar/lsys/parse.h"
#include "runtime/derive/word_text.h"
#include "runtime/pipeline/constant_text.h"
#include "runtime/pipeline/plant.h"
#include "runtime/pipeline/setting_controls.h"
#include "runtime/pipeline/step.h"
#include "runtime/pipeline/value_edits.h"
#include "runtime/turtle/skeleton.h"
#include "web/binding/impl/files.h"
#include "web/binding/impl/mesh_answer.h"
#include "web/binding/impl/read_options.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace lsys::web {

namespace {

Json numbers_json(const SettingControl& control) {
    const std::size_t count = control.kind == SettingKind::Vector ? 4 : 1;
    Json numbers = Json::array();
    for (std::size_t i = 0; i < count; ++i) {
        numbers.push_back(control.numbers[i]);
    }
    return numbers;
}

Json settings_json(const Grammar& grammar) {
    static constexpr std::array kKinds{"number", "count", "vector", "word"};
    Json settings = Json::array();
    for (const SettingControl& control : setting_controls(grammar)) {
        settings.push_back({{"key", control.key},
                            {"kind", kKinds[static_cast<std::size_t>(control.kind)]},
                            {"numbers", numbers_json(control)},
                            {"accepts", control.accepts},
                            {"word", control.word},
                            {"words", control.words},
                            {"min", control.min},
                            {"max", control.max}});
    }
    return settings;
}

Json constants_json(const Grammar& grammar) {
    Json constants = Json::array();
    if (!grammar.program) {
        return constants;
    }
    for (const Constant& constant : grammar.program->constants) {
        constants.push_back({{"name", grammar.names.text(constant.name)},
                             {"isParameter", constant.is_param},
                             {"isRandom", constant.is_random},
                             {"value", constant.value},
                             {"min", constant.minimum},
                             {"max", constant.maximum},
                             {"text", describe_constant(constant, grammar)}});
    }
    return constants;
}

Outcome<void> compile(Session& session, const Json& request, Answer& answer) {
    Step step(session.project());
    Grammar grammar;
    if (!step.take(load_grammar(name_of(request), grammar_options_of(request), session.project()),
                   grammar)) {
        return step.end();
    }
    const Bytecode& bytecode = grammar.bytecode;
    answer.head["generations"] = bytecode.generations ? Json(*bytecode.generations) : Json();
    answer.head["seed"] = bytecode.settings.seed;
    answer.head["constants"] = constants_json(grammar);
    answer.head["settings"] = settings_json(grammar);
    answer.head["translation"] = grammar.translation;
    return step.done();
}

Outcome<void> derive(Session& session, const Json& request, Answer& answer) {
    Step step(session.project());
    Grammar grammar;
    DerivedWord derived;
    if (!step.take(load_grammar(name_of(request), grammar_options_of(request), session.project()),
                   grammar) ||
        !step.take(derive_word(plant_options_of(request), grammar, session.project()), derived)) {
        return step.end();
    }
    const std::size_t max_bytes = request.value("maxBytes", ~std::size_t{0});
    WordPrinter printer(derived.folded ? *derived.folded : grammar.bytecode);
    std::string text;
    const bool is_whole = printer.print(derived.word, [&](std::string_view piece) {
        text.append(piece.substr(0, max_bytes - text.size()));
        return text.size() < max_bytes;
    });
    answer.head["modules"] = derived.word.module_count();
    answer.head["generations"] = derived.generations;
    answer.head["seed"] = derived.seed;
    answer.head["isWhole"] = is_whole;
    answer.head["text"] = answer.add(std::move(text));
    return step.done();
}

/// Compiles and derives the grammar of the request, and draws its word.
bool grow(Step& step, const Session& session, const Json& request, Plant& plant) {
    Grammar grammar;
    return step.take(load_grammar(name_of(request), grammar_options_of(request), session.project()),
                     grammar) &&
           step.take(grow_plant(plant_options_of(request), grammar, session.project()), plant);
}

Json facts_of(const Plant& plant, const Skeleton& skeleton) {
    const SkeletonStats stats = measure(skeleton);
    return {{"modules", plant.modules},
            {"generations", plant.generations},
            {"seed", plant.seed},
            {"segments", skeleton.segments.size()},
            {"objects", skeleton.objects.size()},
            {"polygons", skeleton.polygons.size()},
            {"height", stats.height},
            {"low", {stats.bounds.low.x, stats.bounds.low.y, stats.bounds.low.z}},
            {"high", {stats.bounds.high.x, stats.bounds.high.y, stats.bounds.high.z}}};
}

Outcome<void> skeleton(Session& session, const Json& request, Answer& answer) {
    Step step(session.project());
    Plant plant;
    if (!grow(step, session, request, plant)) {
        return step.end();
    }
    answer.head["plant"] = facts_of(plant, plant.skeleton);
    answer.head["skeleton"] = add_skeleton(plant.skeleton, answer);
    return step.done();
}

Outcome<void> mesh(Session& session, const Json& request, Answer& answer) {
    Step step(session.project());
    Plant plant;
    Mesh made;
    if (!grow(step, session, request, plant)) {
        return step.end();
    }
    answer.head["plant"] = facts_of(plant, plant.skeleton);
    if (!step.take(mesh_plant(plant, plant.skeleton, mesh_options_of(request), session.project()),
                   made)) {
        return step.end();
    }
    plant = {}; // frees memory for the blocks
    answer.head["mesh"] = add_mesh(std::move(made), answer);
    return step.done();
}

Outcome<void> begin_growth(Session& session, const Json& request, Answer& answer) {
    Step step(session.project());
    session.growing = std::make_unique<Growing>();
    Growing& growing = *session.growing;
    if (!step.take(load_grammar(name_of(request), grammar_options_of(request), session.project()),
                   growing.grammar)) {
        return step.end();
    }
    Outcome<PlantGrowth> growth =
        PlantGrowth::begin(plant_options_of(request), growing.grammar, session.project());
    step.messages.append(std::move(growth.messages()));
    if (!growth) {
        return step.end(growth.stop());
    }
    growing.growth.emplace(std::move(growth.value()));
    answer.head["generations"] = growing.growth->last_generation();
    return step.done();
}

Outcome<void> pose_growth(Session& session, const Json& request, Answer& answer) {
    Step step(session.project());
    if (!session.growing || !session.growing->growth) {
        return step.fail("no growth has begun");
    }
    PlantGrowth& growth = *session.growing->growth;
    const double time = request.at("time").get<double>();
    if (!(time >= 0.0) || time > growth.last_generation()) {
        return step.fail("the time is not between 0 and the last generation");
    }
    const double whole = std::floor(time);
    const GrowthMoment moment{static_cast<std::uint32_t>(whole), time - whole};
    Skeleton skeleton;
    Mesh made;
    if (!step.take(growth.pose(moment, session.project(), skeleton)) ||
        !step.take(
            mesh_plant(growth.plant(), skeleton, mesh_options_of(request), session.project()),
            made)) {
        return step.end();
    }
    answer.head["plant"] = facts_of(growth.plant(), skeleton);
    answer.head["mesh"] = add_mesh(std::move(made), answer);
    return step.done();
}

Outcome<void> bytecode(Session& session, const Json& request, Answer& answer) {
    Step step(session.project());
    Grammar grammar;
    if (!step.take(load_grammar(name_of(request), grammar_options_of(request), session.project()),
                   grammar)) {
        return step.end();
    }
    answer.head["bytes"] = answer.add(write_module_file(grammar.bytecode));
    return step.done();
}

/// Writes values into the text of a grammar.
Outcome<void> edit(Session& session, const Json& request, Answer& answer) {
    Step step(session.project());
    const std::string name = name_of(request);
    const GrammarOptions options = grammar_options_of(request);
    StatementValues values;
    values.generations = plant_options_of(request).generations;
    values.definitions = options.definitions;
    values.settings = options.settings;
    const Result<std::string> text = step.read(name, {kMaxSourceBytes});
    if (!text) {
        return step.fail(text.error());
    }
    Result<std::string> edited =
        with_values(name, text.value(), values, make_loader(session.project(), kMaxSourceBytes));
    if (!edited) {
        return step.fail(edited.error());
    }
    answer.head["text"] = answer.add(std::move(edited.value()));
    return step.done();
}

/// Lays out the text of a grammar as `lsc fmt` does.
Outcome<void> format(Session& session, const Json& request, Answer& answer) {
    Step step(session.project());
    const std::string name = name_of(request);
    Result<std::string> text = step.read(name, {kMaxSourceBytes});
    if (!text) {
        return step.fail(text.error());
    }
    const auto sources = std::make_shared<SourceMap>();
    Names names;
    Diagnostics diagnostics;
    const FileId file = sources->add(name, std::move(text.value()));
    const FileLoader load = make_loader(session.project(), kMaxSourceBytes);
    std::optional<std::string> formatted = format_lsys(file, {*sources, names, diagnostics, load});
    if (!step.diagnose(std::move(diagnostics), sources) || !formatted) {
        return step.end(Stop::Diagnosed);
    }
    answer.head["text"] = answer.add(std::move(*formatted));
    return step.done();
}

constexpr std::array<std::pair<std::string_view, Operation>, 11> kOperations{
    {{"compile", compile},
     {"derive", derive},
     {"skeleton", skeleton},
     {"mesh", mesh},
     {"begin-growth", begin_growth},
     {"pose-growth", pose_growth},
     {"bytecode", bytecode},
     {"edit", edit},
     {"format", format},
     {"write-plant", write_plant},
     {"write-forest", write_forest}}};

} // namespace

Operation find_operation(std::string_view name) {
    for (const auto& [key, operation] : kOperations) {
        if (key == name) {
            return operation;
        }
    }
    return nullptr;
}

} // namespace lsys::web
