// Writes the expressions of a Houdini rule text in .lsys.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/dialects/houdini/session.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

/// Place of an expression.
enum class HoudiniPlace : std::uint8_t { Premise, Successor, Condition, Probability };

struct HoudiniScope {
    HoudiniPlace place{};
    const HoudiniRule* rule = nullptr;            // null in the premise
    const std::vector<std::string_view>* zeros{}; // parameters that this variant of the rule lacks
};

class HoudiniExpressions {
public:
    HoudiniExpressions(const HoudiniSession& session, Translation& translation)
        : session_(session), translation_(translation) {}

    /// Sets the value of the variable `a`.
    void set_angle(std::string angle) { angle_ = std::move(angle); }
    void write(int node, const HoudiniScope& scope);
    /// Warns once that `rand` does not depend on its seed.
    void warn_random(SourceSpan place);

private:
    /// A part to be written: a node, or a text with its place.
    struct Item {
        int node = -1;
        std::string_view text;
        SourceSpan span;
    };

    void write_node(const HoudiniNode& node, const HoudiniScope& scope);
    void write_name(const HoudiniNode& node, const HoudiniScope& scope);
    void write_call(const HoudiniNode& node, const HoudiniScope& scope);
    void write_random(const HoudiniNode& node, const HoudiniScope& scope);
    void write_integer(const HoudiniNode& node);
    [[nodiscard]] bool draws(int root, bool& is_positive) const;
    void write_binary(const HoudiniNode& node);
    void report_unsupported(SourceSpan place, const std::string& message) const;

    const HoudiniSession& session_;
    std::string angle_;
    Translation& translation_;
    std::vector<Item> items_; // stack of parts to be written
    bool has_warned_random_ = false;
};

} // namespace lsys
