// SPDX-License-Identifier: MIT
#include "runtime/program/impl/trace_printer.h"

namespace lsys {

namespace {

/// Max numbers of items shown, so that the report of a module fits one screen.
constexpr std::size_t kMaxWritten = 60;
constexpr std::size_t kMaxLater = 8; // max modules of later passes

} // namespace

std::string TracePrinter::modules(const std::vector<TracedModule>& list) const {
    if (list.empty()) {
        return "nothing";
    }
    std::string text;
    const std::size_t shown = std::min(list.size(), kMaxWritten);
    std::size_t column = 0;
    for (std::size_t i = 0; i < shown; ++i) {
        const std::string each = module(list[i]);
        if (column != 0 && column + each.size() > 90) {
            text += "\n      ";
            column = 0;
        }
        text += (column == 0 ? "" : " ") + each;
        column += each.size() + 1;
    }
    if (list.size() > shown) {
        text += fmt::format(" ... and {} more", list.size() - shown);
    }
    return text;
}

void TracePrinter::list(const std::string& title, const std::vector<TracedModule>& written) {
    const std::string text = modules(written);
    const bool fits =
        title.size() + 1 + text.size() <= kMaxTraceColumns && text.find('\n') == std::string::npos;
    line("{}{}{}", title, fits ? " " : "\n      ", text);
}

std::string TracePrinter::range_text(std::uint64_t first, std::size_t count) {
    return count == 1 ? fmt::format("position {}", first)
                      : fmt::format("positions {} to {}", first, first + count - 1);
}

std::string TracePrinter::arguments_text(const TracedRange& range) {
    const bool is_range = range.opcode == Opcode::Range;
    std::string text = is_range ? std::string() : std::string(info(range.opcode).mnemonic);
    text += is_range ? '{' : '(';
    for (std::size_t i = 0; i < range.arguments.size(); ++i) {
        text += (i == 0 ? "" : ", ") + value_text(range.arguments[i]);
    }
    return text + (is_range ? '}' : ')');
}

void TracePrinter::values(const ModuleTrace& trace) {
    for (const TracedLocal& local : trace.locals) {
        const std::string number = value_text(local.value);
        line("  let {} = {}{}{}", local.name,
             local.text == number ? number : fmt::format("{} = {}", local.text, number),
             local.choices.empty() ? "" : ", since ", fmt::join(local.choices, ", "));
    }
    for (const TracedRange& range : trace.ranges) {
        const std::string values = arguments_text(range);
        line("  {} = {}{}: {}, u = {}", range.text,
             values == range.text ? std::string() : values + " = ", value_text(range.value),
             draw_text(range.number), value_text(range.unit));
    }
}

std::string TracePrinter::asked_text(const TracedModule& asking) const {
    const Sense sense = bytecode_.symbol(asking.symbol).sense;
    if (!asks_environment(sense)) {
        return "the turtle";
    }
    const BytecodeEnvironment& environment =
        bytecode_.environments[static_cast<std::size_t>(sense)];
    return fmt::format("the environment `{}` ({})", environment.name,
                       lsys::name_of(environment.kind));
}

void TracePrinter::outcome(const ModuleTrace& trace, const std::string& word) {
    switch (trace.fate) {
    case Fate::Cut:
        if (trace.cause == trace.position) {
            line("taken out, with the rest of its branch, before anything is rewritten");
        } else {
            line("taken out before anything is rewritten: the % at position {} cuts it off",
                 trace.cause);
        }
        return;
    case Fate::Consumed:
        line("consumed by the match of {} that begins at position {}", name(trace.production),
             trace.cause);
        return;
    case Fate::Sensed:
        line("{} answers: {}", asked_text(trace.module), modules(trace.written));
        break;
    case Fate::Failed:
        line("{}", trace.fault.empty() ? std::string("the derivation ends here")
                                       : fmt::format("fails: {}", trace.fault));
        return;
    case Fate::Copied:
        if (trace.is_checked) {
            line("copied to position {}{}", trace.first_written, word);
        } else {
            line("copied");
        }
        break;
    case Fate::Rewritten:
        values(trace);
        if (!trace.is_checked) {
            line("would write: {}", modules(trace.written));
        } else if (trace.written.empty()) {
            line("writes nothing: the module is erased");
        } else if (word.empty()) {
            line("writes {}", modules(trace.written));
        } else {
            list(fmt::format("writes {}{}:", range_text(trace.first_written, trace.written.size()),
                             word),
                 trace.written);
        }
        break;
    }
    if (trace.is_checked && !trace.agrees) {
        line("internal error: the engine wrote something else here; please report it");
    }
}

bool TracePrinter::is_only_pass(const std::vector<ModuleTrace>& list,
                                const ModuleTrace& trace) const {
    return std::none_of(list.begin(), list.end(), [&](const ModuleTrace& other) {
        return other.kind != trace.kind || other.pass != trace.pass || other.rule != trace.rule;
    });
}

std::string TracePrinter::pass_head(const ModuleTrace& trace) const {
    const std::string where =
        fmt::format("{} at position {}", module(trace.module), trace.position);
    switch (trace.kind) {
    case DerivationPass::Kind::Cut:
        return {};
    case DerivationPass::Kind::Rewrite:
        return bytecode_.settings.rewriting == RewritingMode::Sequential && trace.was_run
                   ? fmt::format("sequential, pass of rule {}: {}", trace.rule, where)
                   : std::string();
    case DerivationPass::Kind::Decompose:
        return fmt::format("decomposition, pass {}: {}", trace.pass, where);
    case DerivationPass::Kind::Interpret:
        return fmt::format("interpretation, pass {}: {}", trace.pass, where);
    case DerivationPass::Kind::Sense:
        return fmt::format("sensing: {}", where);
    case DerivationPass::Kind::Down:
        return fmt::format("sweep down: {}", where);
    case DerivationPass::Kind::Up:
        return fmt::format("sweep up: {}", where);
    }
    return {};
}

std::string TracePrinter::again_text(const ModuleTrace& trace) const {
    const auto applies =
        std::find_if(trace.attempts.begin(), trace.attempts.end(),
                     [](const Attempt& each) { return each.verdict == Verdict::Applies; });
    if (applies == trace.attempts.end() || !framed_.contains(applies->production)) {
        return {};
    }
    return fmt::format(", {} again{}", name(applies->production),
                       applies->condition ? ": " + condition_text(*applies->condition)
                                          : std::string());
}

void TracePrinter::traces(const std::vector<ModuleTrace>& list,
                          std::uint64_t start,
                          std::uint32_t generation) {
    std::size_t later = 0;
    std::size_t hidden = 0;
    framed_.clear();
    for (std::size_t i = 0; i < list.size(); ++i) {
        const ModuleTrace& trace = list[i];
        const bool is_later =
            trace.parent != kNoTrace && trace.fate != Fate::Consumed && !is_cause(list, trace);
        if (is_later && trace.fate == Fate::Copied) {
            continue;
        }
        if (is_later && ++later > kMaxLater) {
            ++hidden;
            continue;
        }
        const std::string title = pass_head(trace);
        if (!title.empty()) {
            line("{}{}", title, is_later ? again_text(trace) : std::string());
        } else if (is_cause(list, trace)) {
            line("the match begins with {} at position {}", module(trace.module), trace.position);
        }
        if (trace.parent == kNoTrace && trace.position != start && title.empty() &&
            trace.kind == DerivationPass::Kind::Rewrite) {
            line("at position {} after the cuts of `%`", trace.position);
        }
        attempts(trace, is_later, std::nullopt);
        if (trace.choice && is_later) {
            brief_choice(*trace.choice);
        } else if (trace.choice) {
            choice(trace, *trace.choice);
        }
        const bool plain = trace.kind == DerivationPass::Kind::Rewrite && is_only_pass(list, trace);
        outcome(trace, is_later ? std::string()
                       : plain  ? fmt::format(" of generation {}", generation)
                       : trace.kind == DerivationPass::Kind::Interpret
                           ? std::string(" of the drawn word")
                           : std::string(" of the word of this pass"));
    }
    if (hidden != 0) {
        line("and {} in later passes; `--format json` has them all",
             count_text(hidden, "more module", "more modules"));
    }
}

bool TracePrinter::is_cause(const std::vector<ModuleTrace>& list, const ModuleTrace& trace) {
    return trace.parent != kNoTrace && list[trace.parent].fate == Fate::Consumed;
}

} // namespace lsys
