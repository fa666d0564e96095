// SPDX-License-Identifier: MIT
#include "compiler/bytecode/impl/bytecode_contents.h"
#include "compiler/bytecode/impl/verify_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace lsys {

namespace {

/// A stream for describe_settings() that finds invalid enumerators and numbers that are not finite.
struct RangeCheck : IgnoringStream {
    bool all_enumerators = true;
    bool all_finite = true;

    RangeCheck& outside_digest() { return *this; }
    template <typename Enum>
    void tag(const Enum& value) {
        all_enumerators = all_enumerators && is_enumerator(value);
    }
    void real(const float& value) { all_finite = all_finite && std::isfinite(value); }
};

} // namespace

std::optional<std::string> settings_problem(const Bytecode& bytecode) {
    const Settings& s = bytecode.settings;
    RangeCheck ranges;
    describe_settings(ranges, s);
    if (!ranges.all_enumerators) {
        return fmt::format("a setting has a value that does not exist");
    }
    if (!ranges.all_finite) {
        return fmt::format("a setting is not finite");
    }
#define LSYS_COUNT(field, initial, effect, group, min, max, wanted, misfit)                        \
    if (static_cast<std::int64_t>(s.field) < (min) || s.field > (max)) {                           \
        return fmt::format(misfit, s.field);                                                       \
    }
#include "compiler/bytecode/settings.def"
    if (s.height != 0.0F && !(s.height >= kMinHeight && s.height <= kMaxHeight)) {
        return fmt::format("a plant {} m high", s.height);
    }
    const bool is_exponent =
        s.pipe.exponent >= kMinPipeExponent && s.pipe.exponent <= kMaxPipeExponent;
    if (s.pipe != Pipe{} && !(is_exponent && s.pipe.tip_width >= 0.0F)) {
        return fmt::format("a pipe model of exponent {} and width {}", s.pipe.exponent,
                           s.pipe.tip_width);
    }
    if (!(s.pipe.taper >= 0.0F && s.pipe.taper <= 1.0F)) {
        return fmt::format("a pipe model of taper {}", s.pipe.taper);
    }
    const auto& [factor, height, roots] = s.flare;
    if (s.flare != Flare{} && !(factor >= 1.0F && factor <= kMaxFlare && height > 0.0F &&
                                (roots == 0 || (roots >= kMinRoots && roots <= kMaxRoots)))) {
        return fmt::format("a flare of factor {}, height {} and {} roots", factor, height, roots);
    }
    bool ended = false;
    for (const StepTropism& tropism : s.tropisms) {
        const bool is_used = tropism.kind != TropismKind::None;
        if (is_used ? ended : tropism != StepTropism{}) {
            return fmt::format("a tropism behind the last one");
        }
        ended = !is_used;
    }
    if (!(s.collar >= 0.0F)) {
        return fmt::format("a collar of factor {}", s.collar);
    }
    if (bytecode.generations && *bytecode.generations == kNone) {
        return fmt::format("more generations than there can be");
    }
    return std::nullopt;
}

} // namespace lsys
