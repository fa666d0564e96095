// SPDX-License-Identifier: MIT
// The part of HoudiniWriter for the node's *Random Scale* and for a last generation that is a
// fraction: both scale the lengths, angles and widths of commands.
#include "grammar/ast/number.h"
#include "grammar/dialects/houdini/writer.h"
#include "grammar/dialects/impl/letter_modules.h"

#include <string>
#include <string_view>

namespace lsys {

namespace {

constexpr std::string_view kMoves = "FHGfh"; // parameters: length, and if it draws, width
constexpr std::string_view kDrawing = "FHG";
constexpr std::string_view kTurns = "+-&^/\\"; // parameter: angle

bool is_in(std::string_view set, std::string_view symbol) {
    return symbol.size() == 1 && set.find(symbol) != set.npos;
}

} // namespace

void HoudiniWriter::write_scaled(const Lowered& lowered_module) {
    const HoudiniModule& module = *lowered_module.module;
    const std::string_view symbol = text(module.symbol);
    const bool moves = is_in(kMoves, symbol) && is_on("continuous_length");
    const bool turns = is_in(kTurns, symbol) && is_on("continuous_angles");
    const bool draws = is_in(kDrawing, symbol) && is_on("continuous_width");
    Lowered scaled = lowered_module;
    const auto scale = [&](std::size_t index) {
        const SourceSpan span = module.symbol;
        scaled.arguments[index] =
            tree_.binary("*", scaled.arguments[index], tree_.number(fraction_, span), span);
    };
    std::string before;
    std::string after;
    const auto scale_turtle = [&](char command) {
        before += spelled_letter(static_cast<unsigned char>(command)) + "(" + fraction_ + ")";
        after += spelled_letter(static_cast<unsigned char>(command)) + "(1/" + fraction_ + ")";
    };
    if (moves || turns) {
        if (lowered_module.arguments.empty()) {
            scale_turtle(moves ? '"' : ';');
        } else {
            scale(0);
        }
    }
    if (draws) {
        if (lowered_module.arguments.size() < 2) {
            scale_turtle('!');
        } else {
            scale(1);
        }
    }
    translation_.put(before, module.symbol);
    write_module(scaled);
    translation_.put(after, module.symbol);
}

void HoudiniWriter::write_random_scale() {
    const auto found = settings_.find("random_scale");
    if (found == settings_.end() || read_literal(number("random_scale", "0")).value == 0.0F) {
        return;
    }
    const SourceSpan span = found->second;
    const std::string factor =
        "{1 - " + number("random_scale", "0") + ", 1 + " + number("random_scale", "0") + "}";
    for (const char symbol : std::string(kMoves) + std::string(kTurns)) {
        const std::string name(1, symbol);
        const std::string spelled = spelled_letter(static_cast<unsigned char>(symbol));
        const bool moves = kMoves.find(symbol) != kMoves.npos;
        const bool draws = kDrawing.find(symbol) != kDrawing.npos;
        for (std::uint32_t count = 0; count <= HoudiniSymbols::kMaxParameters; ++count) {
            if (!symbols_.occurs_with(name, count)) {
                continue;
            }
            std::string formals;
            std::string arguments;
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::string formal = "x" + std::to_string(i + 1);
                const bool is_scaled = i == 0 || (i == 1 && draws);
                formals += (i == 0 ? "(" : ", ") + formal;
                arguments += (i == 0 ? "(" : ", ") + formal;
                arguments += is_scaled ? (i == 0 ? "*p" : "*q") : "";
            }
            formals += count != 0 ? ")" : "";
            arguments += count != 0 ? ")" : "";
            const std::string turtle = spelled_letter(moves ? '"' : ';');
            const std::string begin =
                (count == 0 ? turtle + "(p)" : "") + (draws && count < 2 ? "!(q)" : "");
            const std::string end =
                (count == 0 ? turtle + "(1/p)" : "") + (draws && count < 2 ? "!(1/q)" : "");
            translation_.put("#interpret scale" + std::to_string(++fresh_) + " : " + spelled +
                                 formals + " : * : let p = " + factor +
                                 (draws ? ", q = " + factor : std::string()) + " : " + begin +
                                 spelled + arguments + end + ";\n",
                             span);
        }
    }
}

} // namespace lsys
