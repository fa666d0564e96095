// SPDX-License-Identifier: MIT
#include "web/binding/impl/read_options.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

namespace lsys::web {

namespace {

constexpr std::array<std::pair<std::string_view, MeshMethod>, 5> kMethods{
    {{"default", MeshMethod::Default},
     {"tubes", MeshMethod::Tubes},
     {"cylinders", MeshMethod::Cylinders},
     {"boxes", MeshMethod::Boxes},
     {"solid", MeshMethod::Solid}}};

const Json& member(const Json& object, const char* name) {
    static const Json none;
    const auto found = object.find(name);
    return found == object.end() ? none : *found;
}

/// Sets `target` if the object has the member.
template <typename T, typename Target>
void read(const Json& object, const char* name, Target& target) {
    const Json& value = member(object, name);
    if (!value.is_null()) {
        target = value.get<T>();
    }
}

} // namespace

std::string name_of(const Json& request) {
    return request.at("name").get<std::string>();
}

GrammarOptions grammar_options_of(const Json& request) {
    GrammarOptions options;
    read<std::string>(request, "dialect", options.dialect);
    read<std::string>(request, "system", options.system);
    for (const auto& [name, value] : member(request, "definitions").items()) {
        options.definitions.push_back({name, value.get<float>()});
    }
    for (const auto& [key, values] : member(request, "settings").items()) {
        options.settings.push_back({key, values.get<std::string>()});
    }
    return options;
}

PlantOptions plant_options_of(const Json& request) {
    PlantOptions options;
    options.file = name_of(request);
    read<std::uint32_t>(request, "generations", options.generations);
    read<std::uint64_t>(request, "seed", options.seed);
    read<float>(request, "height", options.height);
    return options;
}

MeshOptions mesh_options_of(const Json& request) {
    MeshOptions options;
    options.tangents = false;
    options.colours = false;
    const Json& mesh = member(request, "mesh");
    if (mesh.is_null()) {
        return options;
    }
    std::string method;
    read<std::string>(mesh, "method", method);
    for (const auto& [name, value] : kMethods) {
        if (name == method) {
            options.method = value;
        }
    }
    read<float>(mesh, "deviation", options.deviation);
    read<std::uint32_t>(mesh, "sides", options.sides);
    read<bool>(mesh, "smoothJoints", options.smooth_joints);
    return options;
}

std::vector<NamedOption> named_options_of(const Json& request, const char* name) {
    std::vector<NamedOption> options;
    read<std::vector<NamedOption>>(request, name, options);
    return options;
}

} // namespace lsys::web
