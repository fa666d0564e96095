// SPDX-License-Identifier: MIT
// Forests and their instances for Python.
#include "runtime/python/arrays.h"
#include "runtime/python/call.h"

#include <lsys/forest.h>

namespace lsys_python {

namespace {

// The numpy types of the library's structs, with the same layout.
py::dtype tree_type() {
    using lsys::Tree;
    return structure({{"position", "(3,)f4", offsetof(Tree, position)},
                      {"yaw", "f4", offsetof(Tree, yaw)},
                      {"scale", "f4", offsetof(Tree, scale)},
                      {"number", "u4", offsetof(Tree, number)},
                      {"species", "u2", offsetof(Tree, species)},
                      {"age", "u2", offsetof(Tree, age)}},
                     sizeof(Tree));
}

py::dtype instance_type() {
    using lsys::Instance;
    return structure({{"position", "(3,)f4", offsetof(Instance, position)},
                      {"scale", "f4", offsetof(Instance, scale)},
                      {"rotation", "(4,)f4", offsetof(Instance, rotation)},
                      {"tree", "u4", offsetof(Instance, tree)},
                      {"group", "u4", offsetof(Instance, group)}},
                     sizeof(Instance));
}

py::dtype group_type() {
    using lsys::InstanceGroup;
    return structure({{"mesh", "u4", offsetof(InstanceGroup, mesh)},
                      {"first_part", "u4", offsetof(InstanceGroup, first_part)},
                      {"part_count", "u4", offsetof(InstanceGroup, part_count)},
                      {"first_instance", "u8", offsetof(InstanceGroup, first_instance)},
                      {"instance_count", "u8", offsetof(InstanceGroup, instance_count)}},
                     sizeof(InstanceGroup));
}

/// The trees of an array of tree_type().
std::span<const lsys::Tree> trees_of(const py::array& places) {
    const bool has_type = py::bool_(places.dtype().attr("__eq__")(tree_type()));
    if (places.ndim() != 1 || !has_type) {
        throw py::type_error("places is a one-dimensional array of the type lsys.TREE");
    }
    if ((places.flags() & py::array::c_style) == 0) {
        throw py::type_error("places is not contiguous");
    }
    return {static_cast<const lsys::Tree*>(places.data()), static_cast<std::size_t>(places.size())};
}

} // namespace

void bind_forest(py::module_& module) {
    module.attr("TREE") = tree_type();
    module.attr("INSTANCE") = instance_type();
    module.attr("INSTANCE_GROUP") = group_type();
    py::class_<lsys::Species>(module, "Species", "A species of a forest.")
        .def_readonly("name", &lsys::Species::name)
        .def_readonly("generations", &lsys::Species::generations)
        .def_readonly("heroes", &lsys::Species::heroes)
        .def_readonly("height", &lsys::Species::height);
    py::class_<lsys::ForestCounts>(module, "ForestCounts", "Sums over all trees of a forest.")
        .def_readonly("trees", &lsys::ForestCounts::trees)
        .def_readonly("branches", &lsys::ForestCounts::branches)
        .def_readonly("segments", &lsys::ForestCounts::segments)
        .def_readonly("objects", &lsys::ForestCounts::objects)
        .def_readonly("polygons", &lsys::ForestCounts::polygons)
        .def_readonly("max_branches", &lsys::ForestCounts::max_branches);
    py::class_<lsys::Instances>(module, "Instances", "The branches of all trees, grouped by mesh.")
        .def("__len__", [](const lsys::Instances& self) { return self.all().size(); })
        .def_property_readonly("meshes", &lsys::Instances::meshes)
        .def_property_readonly("array",
                               [](const py::object& self) {
                                   return records(self.cast<const lsys::Instances&>().all(),
                                                  instance_type(), self);
                               })
        .def_property_readonly(
            "groups",
            [](const py::object& self) {
                const auto& groups = self.cast<const lsys::Instances&>().groups();
                return records(std::span<const lsys::InstanceGroup>(groups), group_type(), self);
            })
        .def(
            "read_matrices",
            [](const lsys::Instances& self, py::array_t<float, py::array::c_style>& to,
               std::uint64_t first) {
                if (to.ndim() < 1 || to.size() % 16 != 0 || first > self.all().size() ||
                    static_cast<std::uint64_t>(to.size()) / 16 > self.all().size() - first) {
                    throw py::value_error("`to` has 16 floats for each instance from `first` on");
                }
                float* const data = to.mutable_data();
                const auto count = static_cast<std::uint64_t>(to.size()) / 16;
                const py::gil_scoped_release unlocked;
                self.read_matrices(first, count, data);
            },
            py::arg("to").noconvert(), "first"_a = 0);
    py::class_<lsys::Forest>(module, "Forest", "Trees of some species on a ground.",
                             py::dynamic_attr())
        .def_property_readonly("key", &lsys::Forest::key)
        .def_property_readonly("species", &lsys::Forest::species)
        .def_property_readonly("trees",
                               [](const py::object& self) {
                                   return records(self.cast<const lsys::Forest&>().trees(),
                                                  tree_type(), self);
                               })
        .def("count", &lsys::Forest::count, py::call_guard<py::gil_scoped_release>())
        .def(
            "make_instances",
            [](const lsys::Forest& self, const std::string& method, std::uint32_t sides,
               float deviation, bool texture_coordinates, bool tangents, bool smooth_joints,
               float min_width, const py::kwargs& rest) {
                const lsys::MeshOptions options =
                    mesh_options(method, sides, deviation, texture_coordinates, tangents,
                                 smooth_joints, min_width);
                return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                    return lsys::make_instances(self, options, project);
                }));
            },
            "method"_a = "default", "sides"_a = 0, "deviation"_a = 0.0F,
            "texture_coordinates"_a = true, "tangents"_a = true, "smooth_joints"_a = false,
            "min_width"_a = 0.0F)
        .def("ground",
             [](const lsys::Forest& self, const py::kwargs& rest) {
                 return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                     return lsys::make_ground(self, project);
                 }));
             })
        .def(
            "_save",
            [](const lsys::Forest& self, const std::string& path, const lsys::Options& options,
               const py::kwargs& rest) {
                return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                    return lsys::save_forest(self, path, options, project);
                }));
            },
            "path"_a, "options"_a)
        .def(
            "_write",
            [](const lsys::Forest& self, const std::string& name, const py::function& receive,
               const lsys::Options& options, const py::kwargs& rest) {
                return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                    return lsys::write_forest(self, name, receiver_of(receive), options, project);
                }));
            },
            "name"_a, "receive"_a, "options"_a);
    // No py::init(): pybind11 2.10 registers an object of a constructor where no exception may
    // leave, so that a lack of memory would end the process.
    module.def(
        "_grow_forest",
        [](const std::vector<std::string>& files, const py::object& places,
           const lsys::Options& scene, const std::map<std::string, float>& defines,
           const py::dict& settings, std::optional<std::uint32_t> generations,
           const py::kwargs& rest) {
            const lsys::ForestOptions options{
                grammar_options(defines, settings, generations, "", "", false), scene};
            const std::optional<py::array> array =
                places.is_none() ? std::nullopt : std::optional(places.cast<py::array>());
            const std::span<const lsys::Tree> trees =
                array ? trees_of(*array) : std::span<const lsys::Tree>();
            return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                return array ? lsys::forest_of_places(files, trees, options, project)
                             : lsys::grow_forest(files, options, project);
            }));
        },
        "files"_a, "places"_a, "scene"_a, "defines"_a, "settings"_a, "generations"_a);
}

} // namespace lsys_python
