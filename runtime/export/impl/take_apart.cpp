// SPDX-License-Identifier: MIT
#include "runtime/export/take_apart.h"

#include <nlohmann/json.hpp>

namespace lsys {

using Json = nlohmann::ordered_json;

void take_apart(Json& value) noexcept {
    if (auto* const items = value.get_ptr<Json::array_t*>()) {
        for (Json& item : *items) {
            take_apart(item);
        }
        items->clear();
    } else if (auto* const members = value.get_ptr<Json::object_t*>()) {
        for (auto& [name, member] : *members) {
            take_apart(member);
        }
        members->clear();
    }
}

} // namespace lsys
