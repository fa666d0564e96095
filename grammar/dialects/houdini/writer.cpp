// SPDX-License-Identifier: MIT
#include "grammar/dialects/houdini/writer.h"

#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/base/utf8.h"
#include "grammar/dialects/impl/letter_modules.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsys {

HoudiniWriter::HoudiniWriter(HoudiniSession& session, Translation& translation)
    : session_(session), tree_(session.nodes), translation_(translation), symbols_(session),
      expressions_(session) {
    read_settings();
    expressions_.set_angle(number("angle", "90"));
    for (const HoudiniRule& rule : session.rules) {
        bool& known = has_probability_[group_of(rule)];
        known = known || rule.probability != kNoForeign;
    }
    find_random_pairs();
}

void HoudiniWriter::report_syntax(SourceSpan place, const std::string& message) const {
    session_.context.diagnostics.add(DiagnosticCode::ForeignSyntax, place, message);
}

void HoudiniWriter::report_unsupported(SourceSpan place, const std::string& message) const {
    session_.context.diagnostics.add(DiagnosticCode::ForeignFeature, place, message);
}

void HoudiniWriter::read_settings() {
    for (const HoudiniSetting& setting : session_.settings) {
        SourceSpan value = setting.value;
        value.end = value.begin + static_cast<std::uint32_t>(trimmed(text(value)).size());
        const HoudiniSettingRow* const row = find_houdini_setting(houdini_key(text(setting.key)));
        if (row == nullptr || row->kind == HoudiniSettingKind::Unused) {
            session_.context.diagnostics.add(
                DiagnosticCode::ForeignIgnored, setting.key,
                "`" + shown(text(setting.key)) +
                    (row == nullptr ? "` is no setting that lsc reads" : "` has no effect here"));
            continue;
        }
        read_setting(*row, setting.key, value);
    }
    read_generations();
}

void HoudiniWriter::read_setting(const HoudiniSettingRow& row, SourceSpan key, SourceSpan value) {
    const std::string word = lowered(text(value));
    const bool is_switch = row.kind == HoudiniSettingKind::Switch;
    if (is_switch && word != "on" && word != "off" && word != "1" && word != "0") {
        report_syntax(value, "`" + shown(text(value)) + "` is not `on` or `off`");
    } else if (!is_switch && row.kind != HoudiniSettingKind::Ignore &&
               !is_number(text(value), "+-")) {
        report_syntax(value, "`" + shown(text(value)) + "` is not a number");
    } else if (!settings_.emplace(row.name, value).second) {
        report_syntax(key, "this setting occurs twice");
    }
}

void HoudiniWriter::read_generations() {
    const auto found = settings_.find("n");
    if (found == settings_.end()) {
        return;
    }
    constexpr float kMax = 1'000'000.0F;
    const float value = read_literal(number("n", "0")).value;
    const float whole = std::floor(value);
    if (!(value > 0.0F && value < kMax) || whole == value) {
        return; // .lsys reports numbers that are too large or negative
    }
    generations_ = static_cast<std::uint32_t>(whole) + 1;
    const std::string digits = number("n", "0"); // as written: 0.3, not 0.3000002
    const std::size_t point = digits.find('.');
    fraction_ = point != digits.npos && digits.find_first_of("eE") == digits.npos
                    ? "0" + digits.substr(point)
                    : text_of(value - whole);
}

bool HoudiniWriter::is_on(std::string_view name) const {
    const auto found = settings_.find(name);
    if (found == settings_.end()) {
        return true;
    }
    const std::string word = lowered(text(found->second));
    return word == "on" || word == "1";
}

std::string HoudiniWriter::number(std::string_view name, const char* fallback) const {
    const auto found = settings_.find(name);
    std::string digits = found != settings_.end() ? std::string(text(found->second)) : fallback;
    return digits.starts_with('+') ? digits.substr(1) : digits;
}

void HoudiniWriter::write_settings(std::string_view turtle) {
    translation_.put("#set turtle " + std::string(turtle) + ";\n#set names letters;\n");
    for (const std::string_view key : {"angle", "angle_scale", "step", "step_scale", "width",
                                       "width_scale", "sides", "seed", "n"}) {
        const auto found = settings_.find(key);
        if (found == settings_.end()) {
            continue;
        }
        translation_.put(key == "n" ? "#n = " : "#set " + std::string(key) + " ", found->second);
        const bool is_fraction = key == "n" && !fraction_.empty();
        translation_.put(is_fraction ? std::to_string(generations_) : number(key, ""),
                         found->second);
        translation_.put(";\n");
    }
    if (settings_.count("random_scale") != 0) {
        translation_.put("#set interpret_depth 1;\n#set at_depth stop;\n");
    }
    if (std::any_of(session_.rules.begin(), session_.rules.end(),
                    [](const HoudiniRule& rule) { return rule.probability != kNoForeign; })) {
        translation_.put("#set weights any;\n");
    }
    const auto ignored = settings_.find("ignore");
    if (ignored != settings_.end()) {
        translation_.put("#ignore :", ignored->second);
        read_letter_modules(ignored->second, session_.context, [&](const LetterModule& symbol) {
            translation_.put(" " + spelled_letter(symbol.character), symbol.span);
        });
        translation_.put(";\n");
    }
}

bool HoudiniWriter::reads_variable(std::string_view value) const {
    std::size_t rule = 0;
    for (std::uint32_t i = 0; i < session_.nodes.size(); ++i) {
        while (rule < session_.rules.size() && session_.rules[rule].end_node <= i) {
            ++rule;
        }
        const ForeignNode& node = session_.node(static_cast<ForeignId>(i));
        if (node.kind == ForeignKind::Name && node.text == value &&
            (rule == session_.rules.size() || session_.rules[rule].first_node > i ||
             !names_parameter(session_.rules[rule], value))) {
            return true;
        }
    }
    return false;
}

bool HoudiniWriter::calls(std::string_view function) const {
    for (std::uint32_t i = 0; i < session_.nodes.size(); ++i) {
        const ForeignNode& node = session_.node(static_cast<ForeignId>(i));
        if (node.kind == ForeignKind::Call && node.text == function) {
            return true;
        }
    }
    return false;
}

void HoudiniWriter::write_values() {
    for (const std::string_view value : {"b", "c", "d"}) {
        if (!reads_variable(value)) {
            continue;
        }
        const auto found = settings_.find(value);
        if (found == settings_.end()) {
            session_.context.diagnostics.add(
                DiagnosticCode::ForeignLoss, session_.premise_span,
                "the value of `" + std::string(value) +
                    "` is missing in this file and taken as 0; set it with -D value_" +
                    std::string(value) + "=NUMBER");
        }
        translation_.put("#define value_" + std::string(value) + " " + number(value, "0") + ";\n",
                         found != settings_.end() ? found->second : session_.premise_span);
    }
}

void HoudiniWriter::write(std::string_view turtle) {
    if (session_.premise.empty()) {
        report_syntax({translation_.file(), 0, 0},
                      "the premise is missing: a line of symbols before the rules");
        return;
    }
    write_settings(turtle);
    write_values();
    if (calls("int")) {
        translation_.put(kIntegerPart, session_.premise_span);
    }
    const Word premise = lower_word(session_.premise, {HoudiniPlace::Premise, nullptr, nullptr});
    std::set<std::string> taken{"value_b", "value_c", "value_d"};
    for (const HoudiniRule& rule : session_.rules) {
        taken.insert(rule.formals.begin(), rule.formals.end());
    }
    name_locals(premise, 0, std::move(taken));
    premise_local_count_ = tree_.locals().size();
    tree_.write_constants(0, premise_local_count_, translation_);
    translation_.put("\n#w : ", session_.premise_span);
    write_word(premise);
    translation_.put(";\n\n");
    for (std::size_t i = 0; i < session_.rules.size(); ++i) {
        if (check_head(session_.rules[i])) {
            write_rule(session_.rules[i], i + 1);
        }
    }
    for (std::size_t i = 0; i < session_.rules.size(); ++i) {
        write_ageing(session_.rules[i], i + 1);
    }
    write_random_scale();
}

void HoudiniWriter::write_symbol(const HoudiniModule& module) {
    const std::string_view symbol = text(module.symbol);
    if (symbol[0] == '`') {
        report_unsupported(module.symbol,
                           "text in back quotes is an expression of Houdini, which lsc does "
                           "not have");
        return;
    }
    const CodePoint point = decode_utf8(symbol);
    const std::string spelled = spelled_letter(point.value);
    if (!point.valid || point.value < 0x20 || point.value == 0x7F) {
        report_syntax(module.symbol, "this is not a character of a module");
    } else if (spelled == symbol) {
        translation_.copy(module.symbol, session_.context.sources);
    } else {
        translation_.put(spelled, module.symbol);
    }
}

HoudiniWriter::Word HoudiniWriter::lower_word(const std::vector<HoudiniModule>& word,
                                              const HoudiniScope& scope) {
    expressions_.begin();
    Word lowered_word;
    for (const HoudiniModule& module : word) {
        lowered_word.push_back(lower_module(module, scope));
    }
    return lowered_word;
}

void HoudiniWriter::name_locals(const Word& word, std::size_t first, std::set<std::string> taken) {
    std::vector<ForeignId> roots;
    for (const Lowered& module : word) {
        roots.insert(roots.end(), module.arguments.begin(), module.arguments.end());
    }
    tree_.count_reads(roots, {}, first);
    tree_.name_locals(first, tree_.locals().size(), taken);
}

void HoudiniWriter::write_word(const Word& word) {
    for (const Lowered& lowered_module : word) {
        if (is_last_) {
            write_scaled(lowered_module);
        } else {
            write_module(lowered_module);
        }
    }
}

void HoudiniWriter::write_module(const Lowered& lowered_module) {
    const HoudiniModule& module = *lowered_module.module;
    const SourceSpan place = symbols_.count(module) != 0 ? module.parentheses : module.symbol;
    if (lowered_module.name.empty()) {
        write_symbol(module);
    } else {
        translation_.put(lowered_module.name, module.symbol);
    }
    for (std::size_t i = 0; i < lowered_module.arguments.size(); ++i) {
        translation_.put(i == 0 ? "(" : ", ", place);
        tree_.write(lowered_module.arguments[i], {}, translation_);
    }
    translation_.put(lowered_module.arguments.empty() ? "" : ")", place);
}

void HoudiniWriter::warn_ignored_effect(char symbol, SourceSpan place) {
    if (warned_.find(symbol) != std::string::npos) {
        return;
    }
    warned_ += symbol;
    const std::string what = symbol == 'g'   ? "groups of primitives"
                             : symbol == 'a' ? "attributes of points"
                             : symbol == 'J' ? "values that are stamped on a leaf"
                                             : "coordinates of a colour map";
    session_.context.diagnostics.add(DiagnosticCode::ForeignLoss, place,
                                     "lsc ignores " + what + "; the module stays in the word");
}

HoudiniWriter::Lowered HoudiniWriter::lower_module(const HoudiniModule& module,
                                                   const HoudiniScope& scope) {
    const HoudiniSymbol& known = symbols_.symbol(module);
    Lowered lowered_module{.module = &module, .name = {}, .arguments = {}};
    if (!known.is_command || known.is_rewritten ||
        !lower_special(lowered_module, text(module.symbol)[0], scope)) {
        lowered_module.arguments = arguments(module, 0, scope);
    }
    return lowered_module;
}

std::vector<ForeignId> HoudiniWriter::random_turns(const HoudiniModule& module,
                                                   const HoudiniScope& scope) {
    const SourceSpan span = module.symbol;
    ForeignId limit = symbols_.count(module) == 0
                          ? tree_.number("180", span)
                          : expressions_.term(module.arguments.front(), scope);
    if (tree_[limit].kind != ForeignKind::Number) {
        const ForeignId size = tree_.call("abs", {limit}, span);
        limit = tree_.local({.name = "turn", .value = size, .span = span});
    }
    std::vector<ForeignId> turns;
    for (int turn = 0; turn < 3; ++turn) {
        turns.push_back(tree_.range(tree_.unary("-", limit, span), limit, span));
    }
    return turns;
}

bool HoudiniWriter::lower_special(Lowered& lowered_module, char symbol, const HoudiniScope& scope) {
    const HoudiniModule& module = *lowered_module.module;
    const std::uint32_t count = symbols_.count(module);
    switch (symbol) {
    case '~':
        lowered_module.name = "`~`";
        lowered_module.arguments = random_turns(module, scope);
        return true;
    case 'T':
        if (count != 0) {
            return false;
        }
        lowered_module.arguments = {tree_.number(number("gravity", "0"), module.symbol)};
        return true;
    case '$':
        if (count == 0) {
            return false;
        }
        if (count != 3) {
            report_syntax(module.parentheses, "`$` takes a point: three numbers");
        }
        lowered_module.name = "`aim`";
        translation_.replace_name("aim", "$");
        lowered_module.arguments = arguments(module, 0, scope);
        return true;
    case 'a': {
        if (count == 0) {
            return false;
        }
        warn_ignored_effect('a', module.symbol);
        const bool named = session_.node(module.arguments.front()).kind == ForeignKind::Text;
        lowered_module.arguments = arguments(module, named ? 1 : 0, scope);
        return true;
    }
    case 'g':
        if (count != 0) {
            warn_ignored_effect('g', module.symbol);
        }
        return false;
    case '\'':
    case '#':
        warn_ignored_effect('\'', module.symbol);
        return false;
    case 'J':
    case 'K':
    case 'M':
        if (count > 2) {
            warn_ignored_effect('J', module.symbol);
        }
        return false;
    default:
        return false;
    }
}

ForeignId HoudiniWriter::omitted_argument(const HoudiniModule& module,
                                          std::uint32_t index,
                                          SourceSpan place) {
    const char symbol = text(module.symbol)[0];
    std::string value = "0";
    if (!symbols_.symbol(module).is_command) {
        value = "0";
    } else if (symbol == 'J' || symbol == 'K' || symbol == 'M') {
        value = index == 0 ? number("step_scale", "0.9") : "0";
    } else if (std::string_view("FHGfh").find(symbol) == std::string_view::npos) {
        report_syntax(place, "a parameter is missing");
    } else if (index == 0 && (symbols_.occurs("\"") || symbols_.occurs("_"))) {
        report_unsupported(place,
                           "the current length of the turtle cannot be written as a parameter");
    } else if (index == 1 && (symbols_.occurs("!") || symbols_.occurs("?"))) {
        report_unsupported(place,
                           "the current width of the turtle cannot be written as a parameter");
    } else if (index < 2) {
        value = index == 0 ? number("step", "1") : number("width", "0.1");
    } else {
        value = index == 2 ? std::string("1") : number("sides", "8");
    }
    return tree_.number(value, place);
}

std::vector<ForeignId> HoudiniWriter::arguments(const HoudiniModule& module,
                                                std::uint32_t skip,
                                                const HoudiniScope& scope) {
    const HoudiniSymbol& known = symbols_.symbol(module);
    const std::uint32_t written_count = symbols_.count(module);
    const std::uint32_t count = known.is_command ? written_count : known.max_count;
    std::vector<ForeignId> terms;
    if (count > HoudiniSymbols::kMaxParameters) {
        report_syntax(module.parentheses, "a module with so many parameters is not read");
        return terms;
    }
    const SourceSpan place = written_count != 0 ? module.parentheses : module.symbol;
    for (std::uint32_t i = skip; i < count; ++i) {
        const bool is_given =
            i < written_count && session_.node(module.arguments[i]).kind != ForeignKind::Missing;
        terms.push_back(is_given ? expressions_.term(module.arguments[i], scope)
                                 : omitted_argument(module, i, place));
    }
    if (known.has_age) {
        terms.push_back(tree_.number("0", place));
    }
    return terms;
}

} // namespace lsys
