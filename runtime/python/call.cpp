// SPDX-License-Identifier: MIT
#include "runtime/python/call.h"

#include <limits>
#include <string_view>
#include <utility>

namespace lsys_python {

namespace {

/// The thread kept by CallThread::give_back(). Never destroyed: the process may end in any state.
std::unique_ptr<CallThread>& kept_thread() {
    static auto* const kept = new std::unique_ptr<CallThread>;
    return *kept;
}

/// The number of this process, which differs in a fork.
long process_number() {
    return py::module_::import("os").attr("getpid")().cast<long>();
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

} // namespace

std::string with_argument_names(std::string text) {
    constexpr std::pair<std::string_view, std::string_view> kNames[] = {
        {"`Limits::max_modules`", "`max_modules=`"},
        {"`Limits::max_bytes`", "`max_bytes=`"},
        {"`Policy::max_output`", "`max_output=`"},
        {"`Policy::max_seconds`", "`max_seconds=`"},
        {"`MeshOptions::sides`", "`sides=`"},
        {"`GrammarOptions::generations = ", "`generations="},
        {"`GrammarOptions::generations`", "`generations=`"},
    };
    for (const auto& [member, argument] : kNames) {
        for (std::size_t at = text.find(member); at != std::string::npos;
             at = text.find(member, at + argument.size())) {
            text.replace(at, member.size(), argument);
        }
    }
    return text;
}

namespace {

/// The text of an exception: with source lines if a message has a place, else only the messages,
/// their notes and help.
std::string text_of(const lsys::Messages& messages) {
    std::string text;
    for (const lsys::Diagnostic& diagnostic : messages.all()) {
        if (diagnostic.place) {
            text = messages.text();
            break;
        }
        text += diagnostic.message + '\n';
        for (const std::string& note : diagnostic.notes) {
            text += "note: " + note + '\n';
        }
        for (const std::string& help : diagnostic.help) {
            text += "help: " + help + '\n';
        }
    }
    text.resize(text.find_last_not_of('\n') + 1);
    return with_argument_names(std::move(text));
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

} // namespace

bool is_main_thread() {
    const py::object threading = py::module_::import("threading");
    return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

void wait_for_end() {
    for (;;) {
        std::this_thread::sleep_for(std::chrono::hours(1));
    }
}

void wait_for_end_if_ending() {
#if PY_VERSION_HEX >= 0x030D0000
    const bool is_ending = Py_IsFinalizing() != 0;
#else
    const bool is_ending = _Py_IsFinalizing() != 0;
#endif
    if (is_ending || Py_IsInitialized() == 0) {
        wait_for_end();
    }
}

CallThread::CallThread() : process_(process_number()), thread_([this] { do_calls(); }) {}

CallThread::~CallThread() {
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

std::unique_ptr<CallThread> CallThread::take() {
    std::unique_ptr<CallThread> thread = std::move(kept_thread());
    if (thread != nullptr && thread->process_ != process_number()) {
        static_cast<void>(thread.release()); // a fork cannot join a thread of its parent
    }
    return thread != nullptr ? std::move(thread) : std::make_unique<CallThread>();
}

void CallThread::give_back(std::unique_ptr<CallThread> thread) {
    kept_thread() = std::move(thread);
}

void CallThread::start(std::function<void()> work) {
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        work_ = std::move(work);
    }
    changed_.notify_all();
}

bool CallThread::wait_for(std::chrono::milliseconds time) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, time, [this] { return !work_; });
}

void CallThread::do_calls() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return ends_ || work_; });
        if (!work_) {
            return;
        }
        lock.unlock();
        work_();
        lock.lock();
        work_ = nullptr;
        changed_.notify_all();
    }
}

lsys::FileContents read_by(const py::function& read, const std::string& path) {
    try {
        const py::object result = read(path);
        if (result.is_none()) {
            return {false, {}, "no such file or directory"};
        }
        if (!py::isinstance<py::bytes>(result) && !py::isinstance<py::str>(result)) {
            throw py::type_error("read_file returns bytes, text or None");
        }
        try {
            return {true, result.cast<std::string>(), {}};
        } catch (const py::cast_error&) { // a lone surrogate
            throw py::value_error("read_file returns text that cannot be encoded in UTF-8");
        }
    } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_OSError)) {
            throw;
        }
        const py::object reason = error.value().attr("strerror");
        return {false, {}, reason.is_none() ? std::string() : reason.cast<std::string>()};
    }
}

namespace {

/// A whole number that fits into T. Raises TypeError or ValueError, naming the argument.
template <typename T>
T whole_number(const std::string& name, const py::handle& value) {
    try {
        return value.cast<T>();
    } catch (const py::cast_error&) {
        const std::string text =
            name + " is a whole number from 0 to " + std::to_string(std::numeric_limits<T>::max());
        if (py::isinstance<py::int_>(value)) {
            throw py::value_error(text);
        }
        throw py::type_error(text);
    }
}

/// A value of type T. Raises TypeError, naming the argument, for values of other types.
template <typename T>
T typed(const std::string& name, const py::handle& value, const char* kind) {
    try {
        return value.cast<T>();
    } catch (const py::cast_error&) {
        throw py::type_error(name + " is " + kind);
    }
}

} // namespace

CallOptions options_of(const py::kwargs& arguments) {
    CallOptions options;
    for (const auto& [key, value] : arguments) {
        const auto name = key.cast<std::string>();
        if (name == "threads") {
            options.threads = whole_number<std::uint32_t>(name, value);
        } else if (name == "max_modules") {
            options.max_modules = whole_number<std::uint64_t>(name, value);
        } else if (name == "max_bytes") {
            options.max_bytes = whole_number<std::uint64_t>(name, value);
        } else if (name == "untrusted") {
            options.policy.untrusted = typed<bool>(name, value, "True or False");
        } else if (name == "root") {
            options.policy.root = py::str(py::module_::import("os").attr("fspath")(value));
        } else if (name == "max_seconds") {
            options.policy.max_seconds = typed<double>(name, value, "a number of seconds");
        } else if (name == "max_output") {
            options.policy.max_output = whole_number<std::uint64_t>(name, value);
        } else if (name == "progress") {
            options.progress = py::reinterpret_borrow<py::object>(value);
        } else if (name == "read_file") {
            options.read_file = py::reinterpret_borrow<py::object>(value);
        } else if (name == "environment") {
            options.environment = environments_of(value);
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

lsys::MeshOptions mesh_options(const std::string& method,
                               std::uint32_t sides,
                               float deviation,
                               bool texture_coordinates,
                               bool tangents,
                               bool smooth_joints,
                               float min_width) {
    return {method_of(method), sides,         deviation, texture_coordinates,
            tangents,          smooth_joints, min_width};
}

lsys::FileReceiver receiver_of(const py::function& receive) {
    return [function = receive.ptr()](const lsys::FilePiece& piece) {
        return with_lock([&] {
            const py::object go_on = py::reinterpret_borrow<py::function>(function)(
                py::str(piece.name.data(), piece.name.size()),
                py::bytes(piece.bytes.data(), piece.bytes.size()), piece.is_last);
            return go_on.is_none() || py::bool_(go_on);
        });
    };
}

void raise(lsys::Status status, const lsys::Messages& messages) {
    const py::object type = error_class(status);
    std::string text = text_of(messages);
    if (text.empty()) {
        text = lsys::text_of(status);
    }
    const py::object error = type(text, py::cast(messages.all()));
    PyErr_SetObject(type.ptr(), error.ptr());
    throw py::error_already_set();
}

void warn(const lsys::Messages& messages) {
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
}

} // namespace lsys_python
