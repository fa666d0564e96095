// SPDX-License-Identifier: MIT
#include "runtime/program/trace_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <string>
#include <string_view>

namespace lsys {

namespace {

using Json = nlohmann::ordered_json;

/// A JSON number with the shortest digits of a binary32, or a string if it is not finite.
Json number(float value) {
    if (!std::isfinite(value)) {
        return std::isnan(value) ? "nan" : value > 0.0F ? "infinity" : "-infinity";
    }
    return Json::parse(fmt::format("{}", value));
}

Json numbers(const std::vector<float>& values) {
    Json list = Json::array();
    for (const float value : values) {
        list.push_back(number(value));
    }
    return list;
}

constexpr std::array<std::string_view, 7> kKinds{"cut",   "rewrite", "decompose", "interpret",
                                                 "sense", "down",    "up"};
constexpr std::array<std::string_view, kCountOf<Fate>> kFates{"copied",  "rewritten", "cut",
                                                              "used-up", "sensed",    "failed"};
constexpr std::array<std::string_view, kCountOf<Verdict>> kVerdicts{
    "applies",   "other-count", "other-rule", "predecessor", "left-context", "right-context",
    "condition", "fault",       "no-weight",  "not-drawn",   "not-tried"};
constexpr std::array<std::string_view, kCountOf<ContextEnd>> kEnds{
    "fits", "other-module", "end-of-path", "no-branch", "not-searched"};

template <typename Enum, std::size_t kCount>
std::string_view name_of(const std::array<std::string_view, kCount>& names, Enum value) {
    return names[static_cast<std::size_t>(value)];
}

class JsonReport {
public:
    JsonReport(const Trace& trace, const Bytecode& bytecode) : trace_(trace), bytecode_(bytecode) {}

    [[nodiscard]] Json run() const {
        Json object = Json::object();
        object["generation"] = trace_.generation;
        object["generations"] = trace_.generations;
        object["seed"] = trace_.seed;
        object["modules"] = trace_.modules;
        object["matches"] = trace_.matches;
        object["agrees"] = trace_.agrees;
        object["complete"] = !trace_.stop;
        if (trace_.axiom) {
            object["axiom_choice"] = axiom(*trace_.axiom);
        }
        object["traces"] = Json::array();
        for (const TracedPlace& place : trace_.places) {
            object["traces"].push_back(traced(place));
        }
        return object;
    }

private:
    [[nodiscard]] Json module(const TracedModule& module) const {
        Json object = Json::object();
        object["text"] = module_text(bytecode_, module);
        object["name"] = bytecode_.symbol(module.symbol).name;
        object["values"] = numbers(module.values);
        return object;
    }
    [[nodiscard]] Json modules(const std::vector<TracedModule>& list) const {
        Json array = Json::array();
        for (const TracedModule& each : list) {
            array.push_back(module(each));
        }
        return array;
    }
    void put_site(Json& object, const Site& site) const {
        object["file"] = bytecode_.files[static_cast<std::size_t>(site.span.file)];
        object["line"] = site.line;
        object["column"] = site.column;
    }
    [[nodiscard]] Json production(ProductionId id) const {
        const BytecodeProduction& found = bytecode_.productions[static_cast<std::size_t>(id)];
        Json object = Json::object();
        object["name"] = found.name;
        object["stage"] = name_of(kStages, found.stage);
        if (found.name_site != kNone) {
            put_site(object, bytecode_.sites[found.name_site]);
        }
        return object;
    }
    [[nodiscard]] Json origin(const TraceOrigin& origin) const {
        Json object = Json::object();
        if (origin.production != kNoProduction) {
            object["production"] = production(origin.production);
        } else {
            object["axiom"] = true;
        }
        if (origin.place) {
            put_site(object, *origin.place);
        }
        object["generation"] = origin.generation;
        return object;
    }
    [[nodiscard]] Json visited_modules(const std::vector<VisitedModule>& list) const {
        Json array = Json::array();
        for (const VisitedModule& each : list) {
            Json object = module(each.module);
            object["position"] = each.position;
            object["item"] = each.item;
            array.push_back(std::move(object));
        }
        return array;
    }
    [[nodiscard]] Json context(const ContextTrace& context) const {
        Json object = Json::object();
        object["result"] = name_of(kEnds, context.end);
        object["met"] = visited_modules(context.visited);
        object["ignored"] = context.ignored;
        object["branches"] = context.branches;
        return object;
    }
    [[nodiscard]] static Json condition(const ExpressionTrace& condition) {
        Json object = Json::object();
        object["text"] = condition.text;
        object["value"] = number(condition.value);
        object["parts"] = Json::array();
        for (const TracedPart& part : condition.parts) {
            object["parts"].push_back(
                {{"text", part.text}, {"values", part.values}, {"value", number(part.value)}});
        }
        return object;
    }
    [[nodiscard]] Json attempt(const Attempt& attempt) const {
        Json object = production(attempt.production);
        object["result"] = name_of(kVerdicts, attempt.verdict);
        if (!attempt.predecessor.empty()) {
            object["predecessor"] = visited_modules(attempt.predecessor);
        }
        if (attempt.left.end != ContextEnd::NotSearched) {
            object["left"] = context(attempt.left);
        }
        if (attempt.right.end != ContextEnd::NotSearched) {
            object["right"] = context(attempt.right);
        }
        if (attempt.condition) {
            object["condition"] = condition(*attempt.condition);
        }
        if (attempt.weight) {
            object["weight"] = condition(*attempt.weight);
        }
        return object;
    }
    [[nodiscard]] Json choice(const ChoiceTrace& choice) const {
        Json object = Json::object();
        object["scope"] = choice.by_generation ? "generation" : "module";
        object["draw"] = choice.number;
        if (!choice.by_glibc) {
            object["position"] = choice.position;
        }
        object["rule"] = choice.rule;
        object["u"] = number(choice.unit);
        object["taken"] = choice.taken;
        object["alternatives"] = Json::array();
        for (const ChoiceTrace::Alternative& each : choice.alternatives) {
            Json alternative = production(each.production);
            alternative["weight"] = number(each.weight);
            alternative["sum"] = number(each.cumulative);
            object["alternatives"].push_back(std::move(alternative));
        }
        return object;
    }
    [[nodiscard]] Json axiom(const AxiomTrace& choice) const {
        Json object = Json::object();
        object["u"] = number(choice.unit);
        object["taken"] = choice.taken;
        object["alternatives"] = Json::array();
        for (const AxiomTrace::Alternative& each : choice.alternatives) {
            Json alternative = Json::object();
            if (each.site != kNone) {
                put_site(alternative, bytecode_.sites[each.site]);
            }
            alternative["weight"] = number(each.weight);
            alternative["sum"] = number(each.cumulative);
            object["alternatives"].push_back(std::move(alternative));
        }
        return object;
    }
    [[nodiscard]] Json step(const ModuleTrace& trace) const {
        Json object = Json::object();
        object["pass"] = name_of(kKinds, trace.kind);
        object["number"] = trace.pass;
        if (trace.rule != kNone) {
            object["rule"] = trace.rule;
        }
        object["generation"] = trace.generation;
        object["parent"] = trace.parent == kNoTrace ? Json() : Json(trace.parent);
        object["offset"] = trace.offset;
        object["position"] = trace.position;
        object["module"] = module(trace.module);
        object["productions"] = Json::array();
        for (const Attempt& each : trace.attempts) {
            object["productions"].push_back(attempt(each));
        }
        object["productions_of_other_names"] = trace.other_names;
        if (trace.choice) {
            object["choice"] = choice(*trace.choice);
        }
        object["result"] = name_of(kFates, trace.fate);
        if (trace.production != kNoProduction) {
            object["production"] = production(trace.production);
        }
        if (trace.fate == Fate::Cut || trace.fate == Fate::Consumed) {
            object["cause"] = trace.cause;
        }
        if (!trace.fault.empty()) {
            object["fault"] = trace.fault;
        }
        object["locals"] = Json::array();
        for (const TracedLocal& local : trace.locals) {
            Json& value = object["locals"].emplace_back(
                Json{{"name", local.name}, {"text", local.text}, {"value", number(local.value)}});
            if (!local.choices.empty()) {
                value["choices"] = local.choices;
            }
        }
        object["ranges"] = Json::array();
        for (const TracedRange& range : trace.ranges) {
            object["ranges"].push_back({{"text", range.text},
                                        {"kind", info(range.opcode).mnemonic},
                                        {"draw", range.number},
                                        {"arguments", numbers(range.arguments)},
                                        {"u", number(range.unit)},
                                        {"value", number(range.value)}});
        }
        object["first_written"] = trace.is_checked ? Json(trace.first_written) : Json();
        object["written"] = modules(trace.written);
        object["agrees"] = trace.is_checked ? Json(trace.agrees) : Json();
        return object;
    }
    [[nodiscard]] Json steps(const std::vector<ModuleTrace>& list) const {
        Json array = Json::array();
        for (const ModuleTrace& each : list) {
            array.push_back(step(each));
        }
        return array;
    }
    [[nodiscard]] Json traced(const TracedPlace& place) const {
        Json object = Json::object();
        object["position"] = place.position;
        object["module"] = module(place.module);
        object["origin"] = origin(place.origin);
        if (trace_.scope != TraceScope::Next) {
            object["back"] = Json::array();
            for (const AncestorStep& each : place.back) {
                Json back;
                back["generation"] = each.generation;
                back["position"] = each.position;
                back["module"] = module(each.module);
                back["next_position"] = each.next_position;
                back["offset"] = each.offset;
                back["steps"] = steps(each.steps);
                object["back"].push_back(std::move(back));
            }
        } else {
            object["steps"] = steps(place.step);
            object["first_next"] = place.next.empty() ? Json() : Json(place.first_next);
            object["next"] = modules(place.next);
        }
        if (!place.drawing.empty()) {
            object["drawing"] = steps(place.drawing);
            object["drawn"] = modules(place.drawn);
        }
        return object;
    }

    static constexpr std::array<std::string_view, kCountOf<Stage>> kStages{
        "rewrite", "decompose", "interpret", "down", "up"};

    const Trace& trace_;
    const Bytecode& bytecode_;
};

} // namespace

std::string trace_json(const Trace& trace, const Grammar& grammar) {
    return JsonReport(trace, grammar.bytecode)
               .run()
               .dump(-1, ' ', false, Json::error_handler_t::replace) +
           '\n';
}

} // namespace lsys
