// SPDX-License-Identifier: MIT
// Python functions that give the answers of environments.
#include "runtime/python/arrays.h"
#include "runtime/python/call.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace lsys_python {

namespace {

/// Positions, headings and ups as three arrays of (modules, 3). They are views of one copy of the
/// places, so that a function may keep them beyond its call.
std::array<py::array, 3> vectors_of(std::span<const lsys::SensePlace> places) {
    constexpr auto kStride = static_cast<py::ssize_t>(sizeof(lsys::SensePlace));
    const auto count = static_cast<py::ssize_t>(places.size());
    py::array_t<double> all({count, py::ssize_t{9}});
    static_assert(sizeof(lsys::SensePlace) == 9 * sizeof(double));
    std::memcpy(all.mutable_data(), places.data(), places.size_bytes());
    const auto part = [&](py::ssize_t first) {
        return py::array_t<double>({count, py::ssize_t{3}}, {kStride, py::ssize_t{sizeof(double)}},
                                   all.data() + first, all);
    };
    return {part(0), part(3), part(6)};
}

/// The parameters as an array of (modules, largest count); NaN where a module has fewer.
py::array_t<float> parameters_of(const lsys::EnvironmentQuery& query) {
    const std::span<const std::uint32_t> offsets = query.offsets;
    std::size_t columns = 0;
    for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
        columns = std::max<std::size_t>(columns, offsets[i + 1] - offsets[i]);
    }
    py::array_t<float> parameters(
        {static_cast<py::ssize_t>(query.places.size()), static_cast<py::ssize_t>(columns)});
    float* to = parameters.mutable_data();
    for (std::size_t i = 0; i + 1 < offsets.size(); ++i, to += columns) {
        const std::span<const float> own =
            query.parameters.subspan(offsets[i], offsets[i + 1] - offsets[i]);
        std::fill(std::copy(own.begin(), own.end(), to), to + columns,
                  std::numeric_limits<float>::quiet_NaN());
    }
    return parameters;
}

/// Calls answer(generation, positions, headings, ups, parameters), which returns an array of
/// (modules, numbers). Raises TypeError or ValueError, with the name of the environment, for other
/// results.
lsys::EnvironmentAnswers answers_by(const py::function& answer,
                                    const std::string& name,
                                    const lsys::EnvironmentQuery& query) {
    const std::string subject = "environment \"" + name + "\": the answer ";
    const auto [positions, headings, ups] = vectors_of(query.places);
    const py::object result =
        answer(query.generation, positions, headings, ups, parameters_of(query));
    using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
    const auto numbers = result.is_none() ? Numbers() : Numbers::ensure(result);
    if (result.is_none() || !numbers) {
        throw py::type_error(subject + "is " + py::repr(py::type::of(result)).cast<std::string>() +
                             ", not an array of numbers");
    }
    const auto count = static_cast<py::ssize_t>(query.places.size());
    if (numbers.ndim() != 2 || numbers.shape(0) != count) {
        throw py::value_error(subject + "has the shape " +
                              py::repr(numbers.attr("shape")).cast<std::string>() + ", not (" +
                              std::to_string(count) + ", numbers)");
    }
    return {static_cast<std::size_t>(numbers.shape(1)),
            {numbers.data(), numbers.data() + numbers.size()},
            {}};
}

} // namespace

py::dict environments_of(const py::handle& argument) {
    if (argument.is_none()) {
        return {};
    }
    if (!py::isinstance<py::dict>(argument)) {
        throw py::type_error("environment is a dictionary from names to functions");
    }
    // A copy, whose functions live until the end of the call.
    auto copy = py::reinterpret_steal<py::dict>(PyDict_Copy(argument.ptr()));
    for (const auto& [key, function] : copy) {
        if (!py::isinstance<py::str>(key) || PyCallable_Check(function.ptr()) == 0) {
            throw py::type_error("environment is a dictionary from names to functions");
        }
    }
    return copy;
}

void add_environments(const py::dict& functions, lsys::Host& host) {
    for (const auto& [key, function] : functions) {
        const auto name = key.cast<std::string>();
        host.environments[name] = [name,
                                   answer = function.ptr()](const lsys::EnvironmentQuery& query) {
            return with_lock([&] {
                return answers_by(py::reinterpret_borrow<py::function>(answer), name, query);
            });
        };
    }
}

} // namespace lsys_python
