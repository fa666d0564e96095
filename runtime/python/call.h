// SPDX-License-Identifier: MIT
// A call of the library from Python: its options, the interpreter's lock, Ctrl-C, exceptions and
// warnings.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cxxabi.h>
#include <exception>
#include <functional>
#include <lsys/export.h>
#include <lsys/grammar.h>
#include <lsys/outcome.h>
#include <lsys/plant.h>
#include <lsys/project.h>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <string>
#include <thread>
#include <utility>

namespace lsys_python {

namespace py = pybind11;
using namespace pybind11::literals;

/// Options of every call.
struct CallOptions {
    std::uint32_t threads = 0; // 0: as many as the machine has
    std::uint64_t max_modules = lsys::Limits{}.max_modules;
    std::uint64_t max_bytes = 0; // 0: half of the memory of the machine
    lsys::Policy policy;
    py::object progress = py::none();  // callable(generation, generations, modules)
    py::object read_file = py::none(); // callable(path) -> bytes, str or None
    py::dict environment; // name to callable(generation, positions, headings, ups, parameters)
};

/// The options among the keyword arguments. Raises TypeError for other arguments.
[[nodiscard]] CallOptions options_of(const py::kwargs& arguments);
/// The options of the library for the arguments of lsys.compile(), which have the same meaning.
[[nodiscard]] lsys::GrammarOptions grammar_options(const std::map<std::string, float>& defines,
                                                   const py::dict& settings,
                                                   std::optional<std::uint32_t> generations,
                                                   const std::string& dialect,
                                                   const std::string& system,
                                                   bool bug_compatible);
/// The options of the library for the arguments of Plant.mesh(). Raises ValueError for an unknown
/// `method`.
[[nodiscard]] lsys::MeshOptions mesh_options(const std::string& method,
                                             std::uint32_t sides,
                                             float deviation,
                                             bool texture_coordinates,
                                             bool tangents,
                                             bool smooth_joints,
                                             float min_width);

/// Whether this is Python's main thread (`threading.main_thread()`), which handles Ctrl-C.
[[nodiscard]] bool is_main_thread();
/// The argument `environment`: a dictionary from names to callables, or None. Raises TypeError for
/// other values. Returns a copy.
[[nodiscard]] py::dict environments_of(const py::handle& argument);
/// Adds the functions of environments_of() to the host. `functions` outlives the call.
void add_environments(const py::dict& functions, lsys::Host& host);
/// Calls read(path), which returns the contents of the file as bytes or text, or None for a missing
/// file. An OSError becomes the reason of a failure.
[[nodiscard]] lsys::FileContents read_by(const py::function& read, const std::string& path);
/// A receiver of files that calls the Python function receive(name, bytes, is_last), which ends the
/// call by returning False. `receive` must outlive the receiver. The caller of the receiver need
/// not hold the lock.
[[nodiscard]] lsys::FileReceiver receiver_of(const py::function& receive);
/// Raises the exception for a call that has failed.
[[noreturn]] void raise(lsys::Status status, const lsys::Messages& messages);
/// A help text of the library with the names of Python's arguments: `max_bytes=` for
/// `Limits::max_bytes`.
[[nodiscard]] std::string with_argument_names(std::string text);
/// Reports the warnings as warnings of Python.
void warn(const lsys::Messages& messages);

/// Blocks the thread if the interpreter has ended or is ending: no thread gets its lock any more,
/// and the process ends soon.
void wait_for_end_if_ending();
/// Blocks the thread for ever.
[[noreturn]] void wait_for_end();

/// Calls `work` with the interpreter's lock (GIL). If a thread requests the lock while the
/// interpreter ends, CPython unwinds the stack of the thread, which C++ code does not survive;
/// with_lock() blocks the thread instead.
template <typename Work>
auto with_lock(const Work& work) {
    wait_for_end_if_ending();
    try {
        const py::gil_scoped_acquire lock;
        return work();
    } catch (const abi::__forced_unwind&) {
        wait_for_end();
    }
}

/// Gives up the interpreter's lock until the end of the scope.
class Unlocked {
public:
    Unlocked() : state_(PyEval_SaveThread()) {}
    ~Unlocked() {
        wait_for_end_if_ending();
        try {
            PyEval_RestoreThread(state_);
        } catch (const abi::__forced_unwind&) {
            wait_for_end();
        }
    }
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;

private:
    PyThreadState* state_;
};

/// A thread that runs the library calls of Python's main thread, one after the other. The thread is
/// reused, since a new thread first gets its memory from the system, which takes about 0.7 ms per
/// call.
class CallThread {
public:
    CallThread(); // call with the interpreter's lock held
    /// Waits until the current work has ended.
    ~CallThread();
    CallThread(const CallThread&) = delete;
    CallThread& operator=(const CallThread&) = delete;

    /// The kept thread of earlier calls. Makes a new thread if none is kept, if another call is in
    /// progress (a signal handler may call), or in a fork, where the kept thread does not exist.
    /// Main thread only.
    static std::unique_ptr<CallThread> take();
    /// Keeps an idle thread for later calls. Main thread only.
    static void give_back(std::unique_ptr<CallThread> thread);

    /// Starts `work`, which throws nothing.
    void start(std::function<void()> work);
    /// Waits for the end of the work, at most for `time`. Returns false if it has not ended.
    bool wait_for(std::chrono::milliseconds time);

private:
    void do_calls(); // the main function of the thread

    std::mutex mutex_;
    std::condition_variable changed_;
    std::function<void()> work_; // empty: none
    bool ends_ = false;          // the thread has to end after the current work
    long process_;               // number of the process that made the thread
    std::thread thread_;
};

/// Runs `work(project)` without the lock of the interpreter. If called on the main thread of
/// Python, another thread does the work, while the main thread handles Ctrl-C.
template <typename Work>
auto run(const CallOptions& options, const Work& work) {
    using Result = decltype(work(std::declval<const lsys::Project&>()));
    std::atomic<bool> cancelled{false};
    lsys::Project project;
    project.threads = options.threads;
    project.limits.max_modules = options.max_modules;
    project.limits.max_bytes = options.max_bytes;
    project.policy = options.policy;
    project.host.cancelled = &cancelled;
    if (!options.read_file.is_none()) {
        const auto read = options.read_file.cast<py::function>();
        project.host.read_file = [read = read.ptr()](const std::string& path) {
            return with_lock(
                [&] { return read_by(py::reinterpret_borrow<py::function>(read), path); });
        };
    }
    add_environments(options.environment, project.host);
    if (!options.progress.is_none()) {
        project.host.progress = [report = options.progress.ptr()](const lsys::Progress& progress) {
            return with_lock([&] {
                const py::object go_on = py::reinterpret_borrow<py::function>(report)(
                    progress.generation, progress.generations, progress.modules);
                return go_on.is_none() || py::bool_(go_on);
            });
        };
    }
    if (!is_main_thread()) {
        const Unlocked unlocked;
        return work(project);
    }
    std::optional<Result> result;
    std::exception_ptr thrown;
    std::exception_ptr interrupt; // KeyboardInterrupt
    std::unique_ptr<CallThread> thread = CallThread::take();
    {
        const py::gil_scoped_release unlocked;
        thread->start([&] {
            try {
                result.emplace(work(project));
            } catch (...) {
                thrown = std::current_exception();
            }
        });
        while (!thread->wait_for(std::chrono::milliseconds(50))) {
            const py::gil_scoped_acquire locked;
            if (!interrupt && PyErr_CheckSignals() != 0) {
                cancelled.store(true);
                interrupt = std::make_exception_ptr(py::error_already_set());
            }
        }
    }
    CallThread::give_back(std::move(thread));
    if (interrupt) {
        std::rethrow_exception(interrupt);
    }
    if (thrown) {
        std::rethrow_exception(thrown);
    }
    return std::move(*result);
}

/// The value of an outcome; without a value raises an exception with the messages. Warnings become
/// warnings of Python.
template <typename T>
T value_of(lsys::Outcome<T> outcome) {
    if (!outcome) {
        raise(outcome.status(), outcome.messages());
    }
    warn(outcome.messages());
    return std::move(*outcome);
}

// Each of these adds classes and functions to the Python module.
void bind_messages(py::module_& module);
void bind_grammar(py::module_& module);
void bind_word(py::module_& module);
void bind_plant(py::module_& module);
void bind_forest(py::module_& module);

} // namespace lsys_python
