// The Python module lsys._lsys: bindings of the public library. Arrays are numpy views without copies.
// The package in lsys/ adds functions that are easier to write in Python.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <lsys/export.h>
#include <lsys/grammar.h>
#include <lsys/plant.h>
#include <lsys/word.h>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <span>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

namespace py = pybind11;
using namespace pybind11::literals;

namespace {

/// Options of every call.
struct CallOptions {
    std::uint32_t threads = 0;
    std::uint64_t max_modules = lsys::Limits{}.max_modules;
    std::uint64_t max_bytes = 0;
    py::object progress = py::none();  // callable(generation, generations, modules)
    py::object read_file = py::none(); // callable(path) -> bytes
};

/// Whether this is Python's main thread, which handles Ctrl-C.
bool is_main_thread() {
    const py::object threading = py::module_::import("threading");
    return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

/// Calls a Python function that reads a file. It returns bytes or text, or raises an OSError.
lsys::FileContents read_by(const py::function& read, const std::string& path) {
    const py::gil_scoped_acquire lock;
    try {
        const py::object result = read(path);
        if (result.is_none()) {
            return {false, {}, "no such file or directory"};
        }
        return {true, result.cast<std::string>(), {}};
    } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_OSError)) {
            throw;
        }
        const py::object reason = error.value().attr("strerror");
        return {false, {}, reason.is_none() ? std::string() : reason.cast<std::string>()};
    }
}

/// Runs `work(project)` without the interpreter's lock. If this is Python's main thread, another
/// thread does the work, so that this thread can cancel it on Ctrl-C.
template <typename Work>
auto run(const CallOptions& options, const Work& work) {
    using Result = decltype(work(std::declval<const lsys::Project&>()));
    std::atomic<bool> cancelled{false};
    lsys::Project project;
    project.threads = options.threads;
    project.limits.max_modules = options.max_modules;
    project.limits.max_bytes = options.max_bytes;
    project.host.cancelled = &cancelled;
    if (!options.read_file.is_none()) {
        const auto read = options.read_file.cast<py::function>();
        project.host.read_file = [read = read.ptr()](const std::string& path) {
            return read_by(py::reinterpret_borrow<py::function>(read), path);
        };
    }
    if (!options.progress.is_none()) {
        project.host.progress = [report = options.progress.ptr()](const lsys::Progress& progress) {
            const py::gil_scoped_acquire lock;
            const py::object go_on = py::reinterpret_borrow<py::function>(report)(
                progress.generation, progress.generations, progress.modules);
            return go_on.is_none() || py::bool_(go_on);
        };
    }
    if (!is_main_thread()) {
        const py::gil_scoped_release unlocked;
        return work(project);
    }
    std::optional<Result> result;
    std::exception_ptr thrown;
    std::exception_ptr interrupt; // KeyboardInterrupt
    std::mutex mutex;
    std::condition_variable ended;
    bool is_done = false;
    {
        const py::gil_scoped_release unlocked;
        std::thread worker([&] {
            try {
                result.emplace(work(project));
            } catch (...) {
                thrown = std::current_exception();
            }
            const std::lock_guard<std::mutex> lock(mutex);
            is_done = true;
            ended.notify_one();
        });
        std::unique_lock<std::mutex> lock(mutex);
        while (!ended.wait_for(lock, std::chrono::milliseconds(50), [&] { return is_done; })) {
            lock.unlock();
            const py::gil_scoped_acquire locked;
            if (!interrupt && PyErr_CheckSignals() != 0) {
                cancelled.store(true);
                interrupt = std::make_exception_ptr(py::error_already_set());
            }
            lock.lock();
        }
        lock.unlock();
        worker.join();
    }
    if (interrupt) {
        std::rethrow_exception(interrupt);
    }
    if (thrown) {
        std::rethrow_exception(thrown);
    }
    return std::move(*result);
}

/// The exception class for a status, from lsys/errors.py.
py::object error_class(lsys::Status status) {
    const py::module_ errors = py::module_::import("lsys.errors");
    switch (status) {
    case lsys::Status::Diagnosed:
        return errors.attr("GrammarError");
    case lsys::Status::Limit:
        return errors.attr("LimitError");
    case lsys::Status::OutOfMemory:
        return errors.attr("LimitError");
    case lsys::Status::Cancelled:
        return errors.attr("Cancelled");
    case lsys::Status::Ok:
    case lsys::Status::Failed:
        break;
    }
    return errors.attr("LsysError");
}

/// The text of an exception: messages with the lines of the source, or only the messages if they
/// refer to no source.
std::string text_of(const lsys::Messages& messages) {
    std::string text;
    for (const lsys::Diagnostic& diagnostic : messages.all()) {
        if (diagnostic.place) {
            text = messages.text();
            break;
        }
        text += diagnostic.message + '\n';
        for (const std::string& help : diagnostic.help) {
            text += "help: " + help + '\n';
        }
    }
    text.resize(text.find_last_not_of('\n') + 1);
    return text;
}

/// The value of an outcome; without a value raises an exception with the messages. Warnings become
/// Python warnings.
template <typename T>
T value_of(lsys::Outcome<T> outcome) {
    const lsys::Messages& messages = outcome.messages();
    if (!outcome) {
        const py::object type = error_class(outcome.status());
        std::string text = text_of(messages);
        if (text.empty()) {
            text = lsys::text_of(outcome.status());
        }
        const py::object error = type(text, py::cast(messages.all()));
        PyErr_SetObject(type.ptr(), error.ptr());
        throw py::error_already_set();
    }
    for (const lsys::Diagnostic& diagnostic : messages.all()) {
        if (diagnostic.severity == lsys::Severity::Warning) {
            const py::object type = py::module_::import("lsys.errors").attr("GrammarWarning");
            std::string text = diagnostic.message;
            if (diagnostic.place) {
                text = diagnostic.place->file + ":" + std::to_string(diagnostic.place->line) + ":" +
                       std::to_string(diagnostic.place->column) + ": " + text;
            }
            if (PyErr_WarnEx(type.ptr(), text.c_str(), 2) != 0) {
                throw py::error_already_set();
            }
        }
    }
    return std::move(*outcome);
}

/// A view of the items of type `dtype` at `data`, which keeps `owner` alive.
py::array view(const py::dtype& dtype,
               std::vector<py::ssize_t> shape,
               const void* data,
               const py::object& owner) {
    py::array array(dtype, std::move(shape), data, owner);
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
}

template <typename Scalar, typename Item>
py::array rows(std::span<const Item> items, const py::object& owner) {
    constexpr auto kColumns = static_cast<py::ssize_t>(sizeof(Item) / sizeof(Scalar));
    return view(py::dtype::of<Scalar>(), {static_cast<py::ssize_t>(items.size()), kColumns},
                items.data(), owner);
}

/// A field of a structured numpy type.
struct Field {
    const char* name;
    const char* format;
    std::size_t offset;
};
py::dtype structure(std::initializer_list<Field> fields, std::size_t size) {
    py::list names;
    py::list formats;
    py::list offsets;
    for (const Field& field : fields) {
        names.append(field.name);
        formats.append(py::str(field.format));
        offsets.append(field.offset);
    }
    return {std::move(names), std::move(formats), std::move(offsets),
            static_cast<py::ssize_t>(size)};
}

template <typename Item>
py::array records(std::span<const Item> items, const py::dtype& dtype, const py::object& owner) {
    return view(dtype, {static_cast<py::ssize_t>(items.size())}, items.data(), owner);
}

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

py::dtype code_type(std::uint32_t bytes) {
    return bytes == 1   ? py::dtype::of<std::uint8_t>()
           : bytes == 2 ? py::dtype::of<std::uint16_t>()
                        : py::dtype::of<std::uint32_t>();
}

/// The modules of a word, one after the other.
class WordIterator {
public:
    explicit WordIterator(lsys::Word word) : word_(std::move(word)) {}

    py::tuple next() {
        if (position_ == word_.size()) {
            throw py::stop_iteration();
        }
        const lsys::ModuleKind& kind = word_.kinds()[code()];
        const std::span<const float> values =
            kind.stored_parameters != 0
                ? word_.parameters().subspan(parameter_, kind.stored_parameters)
                : std::span<const float>(kind.constants);
        ++position_;
        parameter_ += kind.stored_parameters;
        py::tuple parameters(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            parameters[i] = values[i];
        }
        return py::make_tuple(kind.name, std::move(parameters));
    }

private:
    [[nodiscard]] std::uint32_t code() const {
        switch (word_.code_bytes()) {
        case 1:
            return static_cast<const std::uint8_t*>(word_.codes())[position_];
        case 2:
            return static_cast<const std::uint16_t*>(word_.codes())[position_];
        default:
            return static_cast<const std::uint32_t*>(word_.codes())[position_];
        }
    }

    lsys::Word word_;
    std::uint64_t position_ = 0;
    std::uint64_t parameter_ = 0;
};

CallOptions options_of(const py::kwargs& arguments) {
    CallOptions options;
    for (const auto& [key, value] : arguments) {
        const auto name = key.cast<std::string>();
        if (name == "threads") {
            options.threads = value.cast<std::uint32_t>();
        } else if (name == "max_modules") {
            options.max_modules = value.cast<std::uint64_t>();
        } else if (name == "max_bytes") {
            options.max_bytes = value.cast<std::uint64_t>();
        } else if (name == "progress") {
            options.progress = py::reinterpret_borrow<py::object>(value);
        } else if (name == "read_file") {
            options.read_file = py::reinterpret_borrow<py::object>(value);
        } else {
            throw py::type_error("unexpected keyword argument '" + name + "'");
        }
    }
    return options;
}

lsys::GrammarOptions grammar_options(const std::map<std::string, float>& defines,
                                     const py::dict& settings,
                                     std::optional<std::uint32_t> generations,
                                     const std::string& dialect,
                                     const std::string& system,
                                     bool bug_compatible) {
    lsys::GrammarOptions options;
    options.dialect = dialect;
    options.system = system;
    options.bug_compatible = bug_compatible;
    options.generations = generations;
    options.definitions.assign(defines.begin(), defines.end());
    for (const auto& [key, value] : settings) {
        std::string text;
        if (py::isinstance<py::sequence>(value) && !py::isinstance<py::str>(value)) {
            for (const py::handle part : py::reinterpret_borrow<py::sequence>(value)) {
                text += (text.empty() ? "" : " ") + std::string(py::str(part));
            }
        } else {
            text = py::str(value);
        }
        options.settings.emplace_back(py::str(key), text);
    }
    return options;
}

py::dict material_of(const lsys::Material& material) {
    return py::dict("name"_a = material.name,
                    "colour"_a = py::make_tuple(material.colour.x, material.colour.y,
                                                material.colour.z, material.colour.w),
                    "roughness"_a = material.roughness, "two_sided"_a = material.two_sided,
                    "cut_out"_a = material.cut_out);
}

lsys::MeshMethod method_of(const std::string& name) {
    const std::map<std::string, lsys::MeshMethod> methods{
        {"default", lsys::MeshMethod::Default},
        {"tubes", lsys::MeshMethod::Tubes},
        {"cylinders", lsys::MeshMethod::Cylinders},
        {"boxes", lsys::MeshMethod::Boxes},
        {"solid", lsys::MeshMethod::Solid}};
    const auto found = methods.find(name);
    if (found == methods.end()) {
        throw py::value_error("method is one of default, tubes, cylinders, boxes, solid");
    }
    return found->second;
}

void bind_messages(py::module_& module) {
    py::class_<lsys::Place>(module, "Place",
                            "A range of characters of a file; the end is exclusive.")
        .def_readonly("file", &lsys::Place::file)
        .def_readonly("line", &lsys::Place::line)
        .def_readonly("column", &lsys::Place::column)
        .def_readonly("end_line", &lsys::Place::end_line)
        .def_readonly("end_column", &lsys::Place::end_column)
        .def_readonly("offset", &lsys::Place::offset)
        .def_readonly("end_offset", &lsys::Place::end_offset)
        .def("__repr__", [](const lsys::Place& place) {
            return "Place(" + place.file + ":" + std::to_string(place.line) + ":" +
                   std::to_string(place.column) + ")";
        });
    py::class_<lsys::Edit>(module, "Edit", "Replaces the text of a place.")
        .def_readonly("place", &lsys::Edit::place)
        .def_readonly("replacement", &lsys::Edit::replacement);
    py::class_<lsys::Fix>(module, "Fix", "A repair: edits that are applied together.")
        .def_readonly("title", &lsys::Fix::title)
        .def_readonly("edits", &lsys::Fix::edits)
        .def_readonly("certain", &lsys::Fix::certain);
    py::class_<lsys::Label>(module, "Label", "A further place of a diagnostic.")
        .def_readonly("place", &lsys::Label::place)
        .def_readonly("text", &lsys::Label::text);
    py::class_<lsys::Diagnostic>(module, "Diagnostic", "A message with its place and repairs.")
        .def_property_readonly("severity",
                               [](const lsys::Diagnostic& diagnostic) {
                                   return diagnostic.severity == lsys::Severity::Error ? "error"
                                          : diagnostic.severity == lsys::Severity::Warning
                                              ? "warning"
                                              : "note";
                               })
        .def_readonly("code", &lsys::Diagnostic::code)
        .def_readonly("message", &lsys::Diagnostic::message)
        .def_readonly("place", &lsys::Diagnostic::place)
        .def_readonly("label", &lsys::Diagnostic::label)
        .def_readonly("labels", &lsys::Diagnostic::labels)
        .def_readonly("notes", &lsys::Diagnostic::notes)
        .def_readonly("help", &lsys::Diagnostic::help)
        .def_readonly("fixes", &lsys::Diagnostic::fixes)
        .def("__repr__", [](const lsys::Diagnostic& diagnostic) {
            return "<Diagnostic " + diagnostic.code + ": " + diagnostic.message + ">";
        });
}

void bind_grammar(py::module_& module) {
    py::class_<lsys::Constant>(module, "Constant", "A `#define` or `#param` of a grammar.")
        .def_readonly("name", &lsys::Constant::name)
        .def_readonly("is_parameter", &lsys::Constant::is_parameter)
        .def_property_readonly("value",
                               [](const lsys::Constant& constant) -> py::object {
                                   return constant.is_random ? py::object(py::none())
                                                             : py::float_(constant.value);
                               })
        .def_property_readonly("bounds", [](const lsys::Constant& constant) -> py::object {
            return constant.is_parameter ? py::object(py::make_tuple(constant.min, constant.max))
                                         : py::object(py::none());
        });
    py::class_<lsys::PredictedSize>(module, "PredictedSize",
                                    "Bounds of the number of modules of one generation.")
        .def_readonly("low", &lsys::PredictedSize::low)
        .def_readonly("high", &lsys::PredictedSize::high)
        .def_readonly("low_segments", &lsys::PredictedSize::low_segments)
        .def_readonly("high_segments", &lsys::PredictedSize::high_segments)
        .def_readonly("max_bytes", &lsys::PredictedSize::max_bytes);
    py::class_<lsys::Grammar>(module, "Grammar", "A compiled L-system.")
        .def_property_readonly("name", &lsys::Grammar::name)
        .def_property_readonly("generations", &lsys::Grammar::generations)
        .def_property_readonly("seed", &lsys::Grammar::seed)
        .def_property_readonly("constants", &lsys::Grammar::constants)
        .def_property_readonly("translation", &lsys::Grammar::translation)
        .def_property_readonly(
            "bytecode", [](const lsys::Grammar& grammar) { return py::bytes(grammar.bytecode()); })
        .def("predict", &lsys::Grammar::predict, "generations"_a,
             py::call_guard<py::gil_scoped_release>())
        .def(
            "derive",
            [](const lsys::Grammar& grammar, std::optional<std::uint32_t> generations,
               std::optional<std::uint64_t> seed, const py::kwargs& rest) {
                return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                    return lsys::derive(grammar, {generations, seed}, project);
                }));
            },
            "generations"_a = py::none(), "seed"_a = py::none())
        .def(
            "grow",
            [](const lsys::Grammar& grammar, std::optional<std::uint32_t> generations,
               std::optional<std::uint64_t> seed, std::optional<float> height, bool stream,
               const py::kwargs& rest) {
                return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                    return lsys::grow(grammar, {generations, seed, height, stream}, project);
                }));
            },
            "generations"_a = py::none(), "seed"_a = py::none(), "height"_a = py::none(),
            "stream"_a = false);
    module.def(
        "compile_file",
        [](const std::string& path, const std::map<std::string, float>& defines,
           const py::dict& settings, std::optional<std::uint32_t> generations,
           const std::string& dialect, const std::string& system, bool bug_compatible,
           const py::kwargs& rest) {
            const lsys::GrammarOptions options =
                grammar_options(defines, settings, generations, dialect, system, bug_compatible);
            return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                return lsys::compile_file(path, options, project);
            }));
        },
        "path"_a, "defines"_a, "settings"_a, "generations"_a, "dialect"_a, "system"_a,
        "bug_compatible"_a);
    module.def(
        "compile_text",
        [](const std::string& text, const std::string& name,
           const std::map<std::string, float>& defines, const py::dict& settings,
           std::optional<std::uint32_t> generations, const std::string& dialect,
           const std::string& system, bool bug_compatible, const py::kwargs& rest) {
            const lsys::GrammarOptions options =
                grammar_options(defines, settings, generations, dialect, system, bug_compatible);
            return value_of(run(options_of(rest), [&](const lsys::Project& project) {
                return lsys::compile_text(text, name, options, project);
            }));
        },
        "text"_a, "name"_a, "defines"_a, "settings"_a, "generations"_a, "dialect"_a, "system"_a,
        "bug_compatible"_a);
}

void bind_word(py::module_& module) {
    py::class_<lsys::ModuleKind>(module, "ModuleKind", "What a code of a word stands for.")
        .def_readonly("name", &lsys::ModuleKind::name)
        .def_readonly("stored_parameters", &lsys::ModuleKind::stored_parameters)
        .def_readonly("constants", &lsys::ModuleKind::constants);
    py::class_<WordIterator>(module, "WordIterator")
        .def("__iter__", [](py::object self) { return self; })
        .def("__next__", &WordIterator::next);
    py::class_<lsys::Word>(module, "Word", "A derived string of modules.")
        .def("__len__", &lsys::Word::size)
        .def("__iter__", [](const lsys::Word& word) { return WordIterator(word); })
        .def("__str__",
             [](const lsys::Word& word) {
                 std::string text;
                 {
                     const py::gil_scoped_release unlocked;
                     text = word.text();
                 }
                 return text;
             })
        .def_property_readonly("generation", &lsys::Word::generation)
        .def_property_readonly("seed", &lsys::Word::seed)
        .def_property_readonly("kinds", &lsys::Word::kinds)
        .def_property_readonly("codes",
                               [](const py::object& self) {
                                   const auto& word = self.cast<const lsys::Word&>();
                                   return view(code_type(word.code_bytes()),
                                               {static_cast<py::ssize_t>(word.size())},
                                               word.codes(), self);
                               })
        .def_property_readonly("parameters", [](const py::object& self) {
            const auto& word = self.cast<const lsys::Word&>();
            return view(py::dtype::of<float>(),
                        {static_cast<py::ssize_t>(word.parameters().size())},
                        word.parameters().data(), self);
        });
}

void bind_plant(py::module_& module) {
    module.attr("SEGMENT") = segment_type();
    module.attr("OBJECT") = object_type();
    module.attr("POLYGON") = polygon_type();
    module.attr("OBJECT_KINDS") = py::cast(lsys::object_kinds());
    module.attr("FORMATS") = py::cast(lsys::export_formats());
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
    py::class_<lsys::Plant>(module, "Plant", "What the turtle draws.")
        .def_property_readonly("modules", &lsys::Plant::modules)
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
                lsys::MeshOptions options{
                    method_of(method), sides,         deviation, texture_coordinates,
                    tangents,          smooth_joints, min_width};
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

} // namespace

PYBIND11_MODULE(_lsys, module) {
    module.doc() = "L-systems: compile grammars, derive words, draw and mesh plants.";
    module.attr("__version__") = lsys::version();
    bind_messages(module);
    bind_grammar(module);
    bind_word(module);
    bind_plant(module);
}
