// SPDX-License-Identifier: MIT
// Plants and meshes for Python.
#include "runtime/python/arrays.h"
#include "runtime/python/call.h"

#include <lsys/export.h>
#include <lsys/plant.h>

namespace lsys_python {

namespace {

// The numpy types of the library's structs, with the same layout.
py::dtype segment_type() {
    using lsys::Segment;
    return structure({{"base", "(3,)f4", offsetof(Segment, base)},
                      {"length", "f4", offsetof(Segment, length)},
                      {"frame", "(4,)f4", offsetof(Segment, frame)},
                      {"base_radius", "f4", offsetof(Segment, base_radius)},
                      {"tip_radius", "f4", offsetof(Segment, tip_radius)},
                      {"spring", "f4", offsetof(Segment, spring)},
                      {"mass", "f4", offsetof(Segment, mass)},
                      {"parent", "u4", offsetof(Segment, parent)},
                      {"colour", "u4", offsetof(Segment, colour)},
                      {"order", "u2", offsetof(Segment, order)},
                      {"sides", "u1", offsetof(Segment, sides)},
                      {"flags", "u1", offsetof(Segment, flags)}},
                     sizeof(Segment));
}

py::dtype object_type() {
    using lsys::Object;
    return structure({{"kind", "u1", offsetof(Object, kind)},
                      {"file", "u4", offsetof(Object, file)},
                      {"position", "(3,)f4", offsetof(Object, position)},
                      {"size", "f4", offsetof(Object, size)},
                      {"frame", "(4,)f4", offsetof(Object, frame)},
                      {"parent", "u4", offsetof(Object, parent)},
                      {"colour", "u4", offsetof(Object, colour)},
                      {"order", "u2", offsetof(Object, order)}},
                     sizeof(Object));
}

py::dtype polygon_type() {
    using lsys::Polygon;
    return structure({{"first_corner", "u4", offsetof(Polygon, first_corner)},
                      {"corner_count", "u4", offsetof(Polygon, corner_count)},
                      {"frame", "(4,)f4", offsetof(Polygon, frame)},
                      {"parent", "u4", offsetof(Polygon, parent)},
                      {"colour", "u4", offsetof(Polygon, colour)},
                      {"picture", "u4", offsetof(Polygon, picture)},
                      {"order", "u2", offsetof(Polygon, order)}},
                     sizeof(Polygon));
}

py::dict material_of(const lsys::Material& material) {
    return py::dict("name"_a = material.name,
                    "colour"_a = py::make_tuple(material.colour.x, material.colour.y,
                                                material.colour.z, material.colour.w),
                    "roughness"_a = material.roughness, "two_sided"_a = material.two_sided,
                    "cut_out"_a = material.cut_out);
}

lsys::ExportOptions
export_options(const std::string& name, const std::string& compress, const std::string& up) {
    lsys::ExportOptions options;
    options.name = name;
    if (compress != "none" && compress != "quantize" && compress != "meshopt") {
        throw py::value_error("compress is one of none, quantize, meshopt");
    }
    options.compression = compress == "none"       ? lsys::Compression::None
                          : compress == "quantize" ? lsys::Compression::Quantize
                                                   : lsys::Compression::Meshopt;
    if (up != "y" && up != "z") {
        throw py::value_error("up is y or z");
    }
    options.up = up == "z" ? lsys::UpAxis::Z : lsys::UpAxis::Y;
    return options;
}

} // namespace

void bind_plant(py::module_& module) {
    module.attr("SEGMENT") = segment_type();
    module.attr("OBJECT") = object_type();
    module.attr("POLYGON") = polygon_type();
    module.attr("OBJECT_KINDS") = py::cast(lsys::object_kinds());
    module.attr("PRESETS") = py::cast(lsys::preset_names());
    module.attr("FORMATS") = py::cast(lsys::export_formats());
    module.def("options", [](const std::string& set) {
        const std::map<std::string, lsys::OptionSet> sets{{"plant", lsys::OptionSet::Plant},
                                                          {"forest", lsys::OptionSet::Forest},
                                                          {"scene", lsys::OptionSet::Scene}};
        const auto found = sets.find(set);
        if (found == sets.end()) {
            throw py::value_error("the sets of options are plant, forest, scene");
        }
        py::dict options;
        for (const lsys::OptionHelp& help : lsys::describe_options(found->second)) {
            options[py::str(help.name)] = py::make_tuple(help.value_name, help.text);
        }
        return options;
    });
    module.def("format_of_path",
               [](const std::string& path) { return lsys::format_of_path(path); });
    py::class_<lsys::PlantSize>(module, "PlantSize",
                                "Measures of a plant, in metres and kilograms.")
        .def_property_readonly("low",
                               [](const lsys::PlantSize& size) {
                                   return py::make_tuple(size.low.x, size.low.y, size.low.z);
                               })
        .def_property_readonly("high",
                               [](const lsys::PlantSize& size) {
                                   return py::make_tuple(size.high.x, size.high.y, size.high.z);
                               })
        .def_readonly("height", &lsys::PlantSize::height)
        .def_readonly("crown_width", &lsys::PlantSize::crown_width)
        .def_readonly("length", &lsys::PlantSize::length)
        .def_readonly("volume", &lsys::PlantSize::volume)
        .def_readonly("mass", &lsys::PlantSize::mass)
        .def_readonly("segments_by_order", &lsys::PlantSize::segments_by_order);
    py::class_<lsys::Plant> plant(module, "Plant",
                                  "A drawn plant: segments, objects and polygons.");
    plant.def_property_readonly("modules", &lsys::Plant::modules)
        .def_property_readonly("generations", &lsys::Plant::generations)
        .def_property_readonly("seed", &lsys::Plant::seed)
        .def_property_readonly("files", &lsys::Plant::files)
        .def("measure", &lsys::Plant::measure, py::call_guard<py::gil_scoped_release>())
        .def_property_readonly("segments",
                               [](const py::object& self) {
                                   return records(self.cast<const lsys::Plant&>().segments(),
                                                  segment_type(), self);
                               })
        .def_property_readonly("objects",
                               [](const py::object& self) {
                                   return records(self.cast<const lsys::Plant&>().objects(),
                                                  object_type(), self);
                               })
        .def_property_readonly("polygons",
                               [](const py::object& self) {
                                   return records(self.cast<const lsys::Plant&>().polygons(),
                                                  polygon_type(), self);
                               })
        .def_property_readonly("corners",
                               [](const py::object& self) {
                                   return rows<float>(self.cast<const lsys::Plant&>().corners(),
                                                      self);
                               })
        .def(
            "mesh",
            [](const lsys::Plant& plant, const std::string& method, std::uint32_t sides,
               float deviation, bool texture_coordinates, bool tangents, bool smooth_joints,
               float min_width, const py::kwargs& rest) {
                const lsys::MeshOptions options =
                    mesh_options(method, sides, deviation, texture_coordinates, tangents,
                                 smooth_joints, min_width);
                return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                    return lsys::make_mesh(plant, options, project);
                }));
            },
            "method"_a = "default", "sides"_a = 0, "deviation"_a = 0.0F,
            "texture_coordinates"_a = true, "tangents"_a = true, "smooth_joints"_a = false,
            "min_width"_a = 0.0F)
        .def(
            "export",
            [](const lsys::Plant& plant, const lsys::Mesh& mesh, const std::string& format,
               const std::string& name, const std::string& compress, const std::string& up,
               const py::kwargs& rest) {
                const lsys::ExportOptions options = export_options(name, compress, up);
                std::string bytes;
                value_of(run(options_of(rest), [&](const lsys::Project& project) {
                    return lsys::export_plant(
                        plant, mesh, format,
                        [&](std::string_view piece) {
                            bytes += piece;
                            return true;
                        },
                        options, project);
                }));
                return py::bytes(bytes);
            },
            "mesh"_a, "format"_a, "name"_a = "plant", "compress"_a = "none", "up"_a = "y");
    plant
        .def(
            "_save_mesh",
            [](const lsys::Plant& self, const lsys::Mesh& mesh, const std::string& path,
               const std::string& format, const std::string& name, const std::string& compress,
               const std::string& up, const py::kwargs& rest) {
                const lsys::ExportOptions options = export_options(name, compress, up);
                return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                    return lsys::save_mesh(self, mesh, path, format, options, project);
                }));
            },
            "mesh"_a, "path"_a, "format"_a, "name"_a = "plant", "compress"_a = "none", "up"_a = "y")
        .def(
            "_save",
            [](const lsys::Plant& self, const std::string& path, const lsys::Options& options,
               const py::kwargs& rest) {
                return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                    return lsys::save_plant(self, path, options, project);
                }));
            },
            "path"_a, "options"_a)
        .def(
            "_write",
            [](const lsys::Plant& self, const std::string& name, const py::function& receive,
               const lsys::Options& options, const py::kwargs& rest) {
                return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                    return lsys::write_plant(self, name, receiver_of(receive), options, project);
                }));
            },
            "name"_a, "receive"_a, "options"_a);
    py::class_<lsys::Mesh>(module, "Mesh", "Triangles of a plant.")
        .def_property_readonly("positions",
                               [](const py::object& self) {
                                   return rows<float>(self.cast<const lsys::Mesh&>().positions(),
                                                      self);
                               })
        .def_property_readonly("normals",
                               [](const py::object& self) {
                                   return rows<float>(self.cast<const lsys::Mesh&>().normals(),
                                                      self);
                               })
        .def_property_readonly("texture_coordinates",
                               [](const py::object& self) {
                                   return rows<float>(
                                       self.cast<const lsys::Mesh&>().texture_coordinates(), self);
                               })
        .def_property_readonly("tangents",
                               [](const py::object& self) {
                                   return rows<float>(self.cast<const lsys::Mesh&>().tangents(),
                                                      self);
                               })
        .def_property_readonly("colours",
                               [](const py::object& self) {
                                   const auto colours = self.cast<const lsys::Mesh&>().colours();
                                   return view(py::dtype::of<std::uint32_t>(),
                                               {static_cast<py::ssize_t>(colours.size())},
                                               colours.data(), self);
                               })
        .def_property_readonly(
            "indices",
            [](const lsys::Mesh& mesh) {
                py::array_t<std::uint32_t> indices(
                    {static_cast<py::ssize_t>(mesh.index_count() / 3), py::ssize_t{3}});
                std::uint32_t* const to = indices.mutable_data();
                const py::gil_scoped_release unlocked;
                mesh.read_indices(0, mesh.index_count(), to);
                return indices;
            })
        .def_property_readonly(
            "parts",
            [](const lsys::Mesh& mesh) {
                py::list parts;
                for (const lsys::MeshPart& part : mesh.parts()) {
                    parts.append(py::make_tuple(part.material, part.first_index, part.index_count));
                }
                return parts;
            })
        .def_property_readonly("materials", [](const lsys::Mesh& mesh) {
            py::list materials;
            for (const lsys::Material& material : mesh.materials()) {
                materials.append(material_of(material));
            }
            return materials;
        });
}

} // namespace lsys_python
