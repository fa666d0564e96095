// SPDX-License-Identifier: MIT
// Arrays of the library as arrays of numpy: read-only views that keep their owner alive.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <span>
#include <utility>
#include <vector>

namespace lsys_python {

namespace py = pybind11;

/// A view of the items of type `dtype` from `data` on, in the given `shape`; keeps `owner` alive.
inline py::array view(const py::dtype& dtype,
                      std::vector<py::ssize_t> shape,
                      const void* data,
                      const py::object& owner) {
    py::array array(dtype, std::move(shape), data, owner);
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
}

/// A view of `items` as a matrix of type Scalar, one row per item.
template <typename Scalar, typename Item>
inline py::array rows(std::span<const Item> items, const py::object& owner) {
    constexpr auto kColumns = static_cast<py::ssize_t>(sizeof(Item) / sizeof(Scalar));
    return view(py::dtype::of<Scalar>(), {static_cast<py::ssize_t>(items.size()), kColumns},
                items.data(), owner);
}

/// A field of a structured dtype of numpy.
struct Field {
    const char* name;
    const char* format;
    std::size_t offset;
};
/// A structured dtype of `size` bytes.
inline py::dtype structure(std::initializer_list<Field> fields, std::size_t size) {
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

/// A view of `items` as an array of a structured dtype.
template <typename Item>
inline py::array
records(std::span<const Item> items, const py::dtype& dtype, const py::object& owner) {
    return view(dtype, {static_cast<py::ssize_t>(items.size())}, items.data(), owner);
}

} // namespace lsys_python
