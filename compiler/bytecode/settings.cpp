// SPDX-License-Identifier: MIT
#include "compiler/bytecode/settings.h"

#include "grammar/base/contract.h"

namespace lsys {

namespace {

/// The names of the enumerators, in their order.
template <typename Enum>
using EnumNames = std::array<std::string_view, kCountOf<Enum>>;

template <typename Enum>
std::string_view name_in(const EnumNames<Enum>& names, Enum value) {
    const auto index = static_cast<std::size_t>(value);
    LSYS_CHECK(index < names.size(), index);
    return names[index];
}

constexpr EnumNames<RewritingMode> kRewritingModes{"parallel", "sequential", "cyclic", "leftmost"};
constexpr EnumNames<ChoiceScope> kChoiceScopes{"module", "generation"};
constexpr EnumNames<WeightRule> kWeightRules{"one", "any"};
constexpr EnumNames<AtDepth> kAtDepths{"error", "stop"};
constexpr EnumNames<LoadRule> kLoadRules{"carried", "own"};
constexpr EnumNames<TipShape> kTipShapes{"flat", "round", "broken"};
constexpr EnumNames<WidthUnit> kWidthUnits{"metres", "pixels"};
constexpr EnumNames<WordShape> kWordShapes{"line", "ring"};
constexpr EnumNames<TropismKind> kTropismKinds{"", "after", "before", "twist"};
constexpr EnumNames<RandomSource> kRandomSources{"philox", "glibc"};
constexpr EnumNames<TurtleProfile> kTurtleProfiles{
#define LSYS_TURTLE_PROFILE(identifier, name, ...) name,
#include "compiler/bytecode/turtle_profiles.def"
};
constexpr std::array<TurtleTraits, kCountOf<TurtleProfile>> kTurtleTraits{{
#define LSYS_TURTLE_PROFILE(identifier, name, ...) TurtleTraits{__VA_ARGS__},
#include "compiler/bytecode/turtle_profiles.def"
}};
// An array with too few names ends with an empty entry.
static_assert(!kRewritingModes.back().empty() && !kChoiceScopes.back().empty() &&
                  !kWeightRules.back().empty() && !kAtDepths.back().empty() &&
                  !kRandomSources.back().empty() && !kLoadRules.back().empty() &&
                  !kTipShapes.back().empty() && !kWidthUnits.back().empty() &&
                  !kTropismKinds.back().empty() && !kWordShapes.back().empty(),
              "an enumerator has no name");

} // namespace

std::string_view name_of(RewritingMode mode) {
    return name_in(kRewritingModes, mode);
}
std::string_view name_of(ChoiceScope scope) {
    return name_in(kChoiceScopes, scope);
}
std::string_view name_of(RandomSource source) {
    return name_in(kRandomSources, source);
}
std::string_view name_of(WeightRule rule) {
    return name_in(kWeightRules, rule);
}
std::string_view name_of(AtDepth at) {
    return name_in(kAtDepths, at);
}
std::string_view name_of(LoadRule load) {
    return name_in(kLoadRules, load);
}
std::string_view name_of(TipShape tips) {
    return name_in(kTipShapes, tips);
}
std::string_view name_of(WidthUnit unit) {
    return name_in(kWidthUnits, unit);
}
std::string_view name_of(WordShape shape) {
    return name_in(kWordShapes, shape);
}
std::string_view name_of(TropismKind kind) {
    return name_in(kTropismKinds, kind);
}
std::string_view name_of(TurtleProfile profile) {
    return name_in(kTurtleProfiles, profile);
}

const TurtleTraits& traits_of(TurtleProfile profile) {
    const auto index = static_cast<std::size_t>(profile);
    LSYS_CHECK(index < kTurtleTraits.size(), index);
    return kTurtleTraits[index];
}

} // namespace lsys
