// SPDX-License-Identifier: MIT
#include "runtime/scene/impl/table_reader.h"
#include "runtime/scene/impl/tables.h"

#include <array>
#include <string_view>

namespace lsys {

void read_light_table(const SceneValue* table, Scene& scene, Diagnostics& diagnostics) {
    TableReader reader(table, "[light]", diagnostics);
    SceneLight& light = scene.light;
    constexpr std::array<std::string_view, 3> kTimeKeys{"day", "hour", "latitude"};
    if (const auto sun = reader.pair("sun", {-360.0, 360.0, false, "degrees"}, false)) {
        if ((*sun)[1] < -90.0 || (*sun)[1] > 90.0) {
            reader.report_bad_value(reader.span_of("sun"),
                                    "the elevation of the sun must be from -90 to 90 degrees");
        } else {
            light.sun = SunPlace{(*sun)[0], (*sun)[1]};
        }
    }
    const auto day = reader.number("day", {1.0, 366.0, false, {}});
    const auto hour = reader.number("hour", {0.0, 24.0, false, {}});
    const auto latitude = reader.number("latitude", {-90.0, 90.0, false, "degrees"});
    for (const std::string_view key : kTimeKeys) {
        if (reader.has("sun")) {
            reader.report_conflicting_key(key, "`sun` gives the place of the sun",
                                          reader.span_of("sun"));
        } else if (!reader.has(key) &&
                   (reader.has("day") || reader.has("hour") || reader.has("latitude"))) {
            reader.report_missing(key, "the time of the light");
        }
    }
    if (day && hour && latitude && !reader.has("sun")) {
        light.sun = sun_at(*day, *hour, *latitude);
    }
    light.turbidity = reader.number(
        "turbidity", {SceneLight::kMinTurbidity, SceneLight::kMaxTurbidity, false, {}});
    reader.finish();
}

} // namespace lsys
