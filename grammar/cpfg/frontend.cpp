#include "grammar/cpfg/frontend.h"

#include "cpfg/parser.h"
#include "grammar/cpfg/expressions.h"
#include "grammar/cpfg/preprocessor.h"
#include "grammar/cpfg/session.h"
#include "grammar/session/include_chain.h"
#include "grammar/session/letter_modules.h"
#include "grammar/session/number.h"
#include "grammar/session/reports.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

bool is_letter(const std::string& name) {
    return name.size() == 1 &&
           ((name[0] >= 'a' && name[0] <= 'z') || (name[0] >= 'A' && name[0] <= 'Z'));
}

class CpfgWriter {
public:
    CpfgWriter(CpfgSession& session, Translation& out)
        : session_(session), context_(session.context), out_(out), header_{out.file(), 0, 1},
          expressions_(session) {}

    void run() {
        find_names();
        expressions_.read_header();
        settings();
        expressions_.begin({}, Stage::Rewrite);
        out_.put("\n#w : ", *session_.axiom_span);
        modules(session_.axiom);
        out_.put(";\n\n", header_);
        std::size_t number = 0;
        for (const CpfgProduction& each : session_.productions) {
            production(each, ++number);
        }
    }

private:
    /// Names of all modules, and of those that productions look at.
    void find_names() {
        const auto note = [&](const std::vector<CpfgModule>& list, bool matched) {
            for (const CpfgModule& module : list) {
                used_.insert(module.name);
                if (matched) {
                    matched_.insert(module.name);
                }
                check_module(module);
                if (!matched && &module != &list.front() && (&module - 1)->name == "~") {
                    surface(module);
                }
            }
        };
        note(session_.axiom, false);
        for (CpfgProduction& each : session_.productions) {
            keep_tilde(each);
            note(each.left, true);
            note(each.predecessor, true);
            note(each.right, true);
            note(each.successor, false);
            if (each.stage == Stage::Rewrite && !each.predecessor.empty()) {
                ++alternatives_[key_of(each)];
            }
        }
    }

    /// `~s(x) --> ~s(y)` rewrites the `s` after a `~`, which stays.
    void keep_tilde(CpfgProduction& each) const {
        const auto begins = [](const std::vector<CpfgModule>& list) {
            return list.size() > 1 && list.front().name == "~" && !list.front().has_arguments;
        };
        if (each.predecessor.size() == 2 && begins(each.predecessor) && begins(each.successor)) {
            const auto& named = session_.considers ? session_.considered : session_.ignored;
            const bool is_named = std::any_of(
                named.begin(), named.end(), [](const auto& module) { return module.name == "~"; });
            if (is_named == session_.considers) { // else contexts do not see it
                each.left.push_back(each.predecessor.front());
            }
            each.predecessor.erase(each.predecessor.begin());
            each.successor.erase(each.successor.begin());
        }
    }

    static std::string key_of(const CpfgProduction& each) {
        const CpfgModule& module = each.predecessor.front();
        return module.name + "/" + std::to_string(module.arguments.size());
    }

    void check_module(const CpfgModule& module) {
        const std::string& name = module.name;
        if (name == "?") {
            session_.unable(module.span, "`?` asks an environment process for values");
        } else if (name == "$") {
            session_.unable(module.span, "`$` ends a sub-L-system");
        } else if (name == "%" && module.has_arguments) {
            session_.unable(module.span, "`%` with a parameter keeps what it cuts off for an "
                                         "environment process");
        } else if (name.size() >= 2 && name[0] == '@' && name != "@v") {
            expressions_.leave_out(module.span, name, "`" + shown(name) + "` is not drawn");
        } else if ((name == "{" || name == "}") && module.has_arguments) {
            expressions_.leave_out(module.span, "{(", "parameters of `" + name + "` are left out");
        }
    }

    /// The symbol after a `~`.
    void surface(const CpfgModule& module) {
        surfaces_.insert(module.name);
        expressions_.leave_out(module.span, "surface " + module.name,
                               "the surface `" + shown(module.name) +
                                   "` is drawn as a leaf: its file is not read");
    }

    /// The module of .lsys that a symbol is.
    [[nodiscard]] std::string spelled(const std::string& name, bool has_arguments) const {
        if (name == ";" && used_.count("'") == 0) {
            return "'";
        }
        if (name == "@v") {
            return "$";
        }
        if (name == "#" && matched_.count("#") == 0 && matched_.count("!") == 0) {
            return has_arguments ? "!" : "`#`";
        }
        if (name == "," && has_arguments && matched_.count(",") == 0 && matched_.count(";") == 0 &&
            used_.count("'") == 0) {
            return "'";
        }
        return name.size() == 1 ? spelled_letter(static_cast<unsigned char>(name[0]))
                                : "`" + name + "`";
    }

    void setting(const char* begin, int expression, const char* fallback) {
        if (expression < 0) {
            if (fallback != nullptr) {
                out_.put(std::string(begin) + fallback + ";\n", header_);
            }
            return;
        }
        const SourceSpan span = session_.expressions[static_cast<std::size_t>(expression)].span;
        const CpfgTerm value = expressions_.term(expression);
        if (value.drawn) {
            session_.unable(span, "a random number in the header");
        }
        const bool number = literal_length(value.text) == value.text.size();
        out_.put(begin, span);
        out_.put(number ? value.text : "(" + value.text + ")", span);
        out_.put(";\n", span);
    }

    void settings() {
        out_.put("#set turtle abop;\n#set names letters;\n", header_);
        view();
        const bool decomposes = has(Stage::Decompose);
        const bool interprets = has(Stage::Interpret);
        if (decomposes) {
            setting("#set decompose_depth ", session_.decompose_depth, "1");
        }
        if (interprets) {
            setting("#set interpret_depth ", session_.interpret_depth, "1");
        }
        if (decomposes || interprets) {
            out_.put("#set at_depth stop;\n", header_);
        }
        if (session_.seed >= 0) {
            out_.put("#set weights any;\n", header_);
            setting("#set seed ", session_.seed, nullptr);
        }
        setting("#n = ", session_.derivation_length, "0");
        if (used_.count("G") != 0) {
            out_.put("#object G BRANCH;\n", header_);
        }
        for (const std::string& name : surfaces_) {
            if (is_letter(name)) {
                out_.put("#object " + name + " LEAF;\n", header_);
            }
        }
        declare();
        if (session_.considers) {
            names("#consider : ", session_.considered);
        } else if (session_.ignores) {
            names("#ignore : ", session_.ignored);
        }
    }

    /// Symbols that stand for themselves.
    void declare() {
        std::set<std::string> rewritten;
        for (const CpfgProduction& each : session_.productions) {
            for (const CpfgModule& module : each.predecessor) {
                rewritten.insert(module.name);
            }
        }
        std::set<std::pair<std::string, std::size_t>> declared;
        const auto visit = [&](const std::vector<CpfgModule>& list) {
            for (const CpfgModule& module : list) {
                const std::string name = spelled(module.name, module.has_arguments);
                const bool draws =
                    name.size() == 1 && std::string_view("FfG+-&^\\/|$!\"'[]{}.%").find(name[0]) !=
                                            std::string_view::npos;
                if (!draws && rewritten.count(module.name) == 0 &&
                    surfaces_.count(module.name) == 0 &&
                    declared.insert({name, module.arguments.size()}).second) {
                    out_.put("#module " + name, header_);
                    for (std::size_t i = 0; i < module.arguments.size(); ++i) {
                        out_.put((i == 0 ? "(x" : ", x") + std::to_string(i + 1), header_);
                    }
                    out_.put(module.has_arguments ? ");\n" : ";\n", header_);
                }
            }
        };
        visit(session_.axiom);
        for (const CpfgProduction& each : session_.productions) {
            visit(each.successor);
        }
    }

    [[nodiscard]] bool has(Stage stage) const {
        return std::any_of(session_.productions.begin(), session_.productions.end(),
                           [&](const CpfgProduction& each) { return each.stage == stage; });
    }

    /// What the view file of the object says of angles; it lies beside the L-system.
    void view() {
        const std::string_view path = context_.sources.file(out_.file()).path();
        const std::size_t dot = path.rfind('.');
        if (dot == path.npos || path.find('/', dot) != path.npos) {
            return;
        }
        const Result<std::string> text = context_.load(std::string(path.substr(0, dot)) + ".v");
        if (!text) {
            return;
        }
        const std::string_view view = text.value();
        for (std::size_t at = 0; at < view.size();) {
            const std::size_t end = std::min(view.find('\n', at), view.size());
            const std::string_view line = view.substr(at, end - at);
            at = end + 1;
            for (const auto& [key, divides] :
                 {std::pair{std::string_view("angle factor:"), true},
                  std::pair{std::string_view("angle increment:"), false}}) {
                if (!line.starts_with(key)) {
                    continue;
                }
                std::string_view value = line.substr(key.size());
                value.remove_prefix(std::min(value.find_first_not_of(" \t"), value.size()));
                value = value.substr(0, literal_length(value));
                if (!value.empty()) {
                    out_.put(divides ? "#set angle (360 / " + std::string(value) + ");\n"
                                     : "#set angle " + std::string(value) + ";\n",
                             header_);
                    return;
                }
            }
        }
    }

    void names(const char* begin, const std::vector<CpfgModule>& list) {
        std::set<std::string> wanted;
        for (const CpfgModule& module : list) {
            for (const char c : module.name) {
                wanted.insert(std::string(1, c));
            }
        }
        std::set<std::string> spelled_names;
        for (const std::string& name : used_) {
            if (wanted.count(name.substr(0, 1)) != 0 && name != "[" && name != "]") {
                spelled_names.insert(spelled(name, true));
            }
        }
        if (spelled_names.empty() && !session_.considers) {
            return;
        }
        out_.put(begin, header_);
        for (const std::string& name : spelled_names) {
            out_.put(name, header_);
        }
        if (spelled_names.empty()) {
            out_.put("`none`", header_); // nothing of the word counts
        }
        out_.put(";\n", header_);
    }

    void modules(const std::vector<CpfgModule>& list) {
        for (const CpfgModule& module : list) {
            const bool polygon = module.name == "{" || module.name == "}";
            out_.put(spelled(module.name, module.has_arguments), module.span);
            if (!module.has_arguments || polygon) {
                continue;
            }
            for (std::size_t i = 0; i < module.arguments.size(); ++i) {
                const SourceSpan span =
                    session_.expressions[static_cast<std::size_t>(module.arguments[i])].span;
                out_.put(i == 0 ? "(" : ", ", span);
                out_.put(expressions_.term(module.arguments[i]).text, span);
            }
            out_.put(")", module.span);
        }
    }

    /// Predecessor or context: its parameters are names.
    void pattern(const std::vector<CpfgModule>& list) {
        for (const CpfgModule& module : list) {
            out_.put(spelled(module.name, module.has_arguments), module.span);
            for (std::size_t i = 0; i < module.arguments.size(); ++i) {
                const CpfgExpression& formal =
                    session_.expressions[static_cast<std::size_t>(module.arguments[i])];
                if (formal.kind != CpfgKind::Name) {
                    context_.diagnostics.add(DiagnosticCode::ForeignSyntax, formal.span,
                                             "a parameter is a name here");
                }
                out_.put(i == 0 ? "(" : ", ", formal.span);
                out_.put(formal.text, formal.span);
            }
            if (module.has_arguments) {
                out_.put(")", module.span);
            }
        }
    }

    std::set<std::string> formals_of(const CpfgProduction& each) {
        std::set<std::string> formals;
        for (const auto* list : {&each.left, &each.predecessor, &each.right}) {
            for (const CpfgModule& module : *list) {
                for (const int argument : module.arguments) {
                    formals.insert(session_.expressions[static_cast<std::size_t>(argument)].text);
                }
            }
        }
        return formals;
    }

    /// Whether the production can be written at all.
    bool check(const CpfgProduction& each) {
        if (each.predecessor.size() != 1) {
            session_.unable(each.span, each.predecessor.empty()
                                           ? "a production without a module"
                                           : "a production that rewrites several modules as one");
            return false;
        }
        const bool contexts = !each.left.empty() || !each.right.empty();
        if (contexts && each.stage == Stage::Decompose) {
            session_.unable(each.span, "contexts in a decomposition");
            return false;
        }
        if (contexts && each.stage == Stage::Interpret) {
            expressions_.leave_out(each.span, "context",
                                   "contexts in a homomorphism are left out, as cpfg does");
        }
        return true;
    }

    void production(const CpfgProduction& each, std::size_t number) {
        if (!check(each)) {
            return;
        }
        const bool rewrites = each.stage == Stage::Rewrite;
        const std::string label = rewrites                         ? "#p"
                                  : each.stage == Stage::Decompose ? "#decompose d"
                                                                   : "#interpret i";
        out_.put(label + std::to_string(number) + " : ", each.span);
        if (!each.left.empty() && rewrites) {
            pattern(each.left);
            out_.put(" < ", each.span);
        }
        pattern(each.predecessor);
        if (!each.right.empty() && rewrites) {
            out_.put(" > ", each.span);
            pattern(each.right);
        }
        out_.put(" : ", each.span);
        expressions_.begin(formals_of(each), each.stage);
        expressions_.run(each.before);
        condition(each);
        weight(each);
        expressions_.run(each.after);
        out_.put(" : ", each.arrow);
        modules(each.successor);
        out_.put(";\n", each.arrow);
    }

    void condition(const CpfgProduction& each) {
        if (each.condition < 0) {
            out_.put("*", each.span);
            return;
        }
        const SourceSpan span = session_.expressions[static_cast<std::size_t>(each.condition)].span;
        const CpfgTerm test = expressions_.term(each.condition);
        if (test.drawn) {
            session_.unable(span, "a random number in a condition");
        }
        const bool number = literal_length(test.text) == test.text.size();
        const bool always = number && test.text.find_first_of("123456789") != std::string::npos;
        out_.put(always ? "*" : test.text, span);
    }

    void weight(const CpfgProduction& each) {
        const bool chosen =
            session_.seed >= 0 && each.stage == Stage::Rewrite && alternatives_[key_of(each)] > 1;
        if (each.weight >= 0 && !chosen && session_.seed < 0) {
            expressions_.leave_out(
                session_.expressions[static_cast<std::size_t>(each.weight)].span, "weight",
                "without `seed:` the first production that matches is taken: this is left out");
        }
        if (!chosen) {
            return;
        }
        if (!each.left.empty() || !each.right.empty()) {
            expressions_.leave_out(each.span, "choice " + key_of(each),
                                   "the choice is among productions with the same contexts; cpfg "
                                   "chooses among all that match");
        }
        if (each.weight < 0) {
            out_.put(" ~ 1", each.span);
            return;
        }
        const SourceSpan span = session_.expressions[static_cast<std::size_t>(each.weight)].span;
        out_.put(" ~ ", span);
        out_.put("(" + expressions_.term(each.weight).text + ")", span);
    }

    CpfgSession& session_;
    const ParseContext& context_;
    Translation& out_;
    SourceSpan header_; // what no place of its own says
    CpfgExpressions expressions_;
    std::set<std::string> used_;
    std::set<std::string> matched_;
    std::set<std::string> surfaces_;
    std::map<std::string, int> alternatives_;
};

} // namespace

void CpfgSession::production(CpfgProduction made) {
    made.stage = stage;
    productions.push_back(std::move(made));
}

void CpfgSession::begin_system(SourceSpan label_span) {
    ++systems;
    if (systems == 2) {
        unable(label_span, "a second L-system of the file, which the first would call");
    }
    stage = Stage::Rewrite;
}

std::string_view recognise_cpfg(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view line = text.substr(at, end - at);
        at = end + 1;
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (!line.starts_with("Lsystem") && !line.starts_with("lsystem")) {
            continue;
        }
        line.remove_prefix(7);
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (line.starts_with(":")) {
            return "a line `Lsystem:`";
        }
    }
    return {};
}

Translation translate_cpfg(FileId root, const ParseContext& context) {
    const Translation text = preprocess_cpfg(root, context);
    CpfgSession session(text, context);
    Translation translation(root);
    if (!context.diagnostics.has_errors()) {
        const CpfgScanning scanning(session, text.text());
        cpfg_grammar::Parser parser(session, scanning.scanner());
        static_cast<void>(parser.parse()); // what is wrong has been reported
    }
    if (context.diagnostics.has_errors()) {
        return translation;
    }
    const auto size = static_cast<std::uint32_t>(context.sources.file(root).text().size());
    if (session.systems == 0 || !session.axiom_span) {
        context.diagnostics.add(DiagnosticCode::ForeignSyntax, {root, size, size},
                                session.systems == 0 ? "the file has no line `Lsystem: 1`"
                                                     : "the file has no line `Axiom: ...`");
        return translation;
    }
    CpfgWriter(session, translation).run();
    return translation;
}

} // namespace lsys
