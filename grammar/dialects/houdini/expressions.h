// SPDX-License-Identifier: MIT
// Houdini's expressions in .lsys. Equal seeds of `rand` in one rule are one random number.
#pragma once

#include "grammar/dialects/houdini/session.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

/// Place of an expression.
enum class HoudiniPlace : std::uint8_t { Premise, Successor, Condition, Probability };

struct HoudiniScope {
    HoudiniPlace place{};
    const HoudiniRule* rule = nullptr; // null in the premise
    /// Parameters that this variant of the rule lacks; null: it lacks none.
    const std::vector<std::string_view>* omitted_parameters = nullptr;
};

class HoudiniExpressions {
public:
    explicit HoudiniExpressions(HoudiniSession& session)
        : session_(session), tree_(session.nodes) {}

    /// Sets the value of the variable `a`.
    void set_angle(std::string angle) { angle_ = std::move(angle); }
    /// Begins the premise or a variant of a rule, which draws its own random numbers.
    void begin() { seeds_.clear(); }
    /// Returns the equivalent of an expression in .lsys.
    [[nodiscard]] ForeignId term(ForeignId root, const HoudiniScope& scope);
    /// Warns once that `rand` does not depend on its seed.
    void warn_random(SourceSpan place);

private:
    using Terms = std::map<ForeignId, ForeignId>; // by node of the file: its equivalent in .lsys
    /// The equivalent of one node. `terms`: the equivalents of its operands.
    [[nodiscard]] ForeignId lower(ForeignId id, const Terms& terms, const HoudiniScope& scope);
    [[nodiscard]] ForeignId name(const ForeignNode& node, const HoudiniScope& scope);
    [[nodiscard]] ForeignId call(const ForeignNode& node, std::vector<ForeignId> arguments);
    /// A random number from 0 to 1; equal seeds in one rule give one number.
    [[nodiscard]] ForeignId random(const ForeignNode& node, const HoudiniScope& scope);
    /// Reports a feature that .lsys lacks; returns the number 0 in its place.
    ForeignId unsupported(SourceSpan place, const std::string& message);

    HoudiniSession& session_;
    ForeignExpressions& tree_;
    std::string angle_;                      // see set_angle()
    std::map<std::string, ForeignId> seeds_; // random numbers of the rule, by seed as written
    bool has_warned_random_ = false;
};

} // namespace lsys
