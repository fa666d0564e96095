#include "compiler/bytecode/settings.h"

#include "grammar/base/contract.h"

namespace lsys {

namespace {

template <typename Enum, std::size_t size>
std::string_view name_in(const std::array<std::string_view, size>& names, Enum value) {
    const auto index = static_cast<std::size_t>(value);
    LSYS_CHECK(index < size, index);
    return names[index];
}

constexpr std::array<std::string_view, 4> kRewritingModes{"parallel", "sequential", "cyclic",
                                                          "leftmost"};
constexpr std::array<std::string_view, 2> kChoiceScopes{"module", "generation"};
constexpr std::array<std::string_view, 2> kWeightRules{"one", "any"};
constexpr std::array<std::string_view, 2> kAtDepths{"error", "stop"};
constexpr std::array<std::string_view, 2> kRandomSources{"philox", "glibc"};
constexpr std::array<std::string_view, 12> kTurtleProfiles{
    "lsys", "thesis", "abop",        "houdini",       "l3d",      "lplus",
    "sys",  "carey",  "l3d_program", "lplus_program", "fractint", "sidefx"};

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
std::string_view name_of(TurtleProfile profile) {
    return name_in(kTurtleProfiles, profile);
}

} // namespace lsys
