// SPDX-License-Identifier: MIT
// GpuTimer: time that the device takes for a span of commands, by timer queries. Results arrive
// some pictures later, unless the device has finished.
#pragma once

#include "viewer/gl/impl/objects.h"

#include <array>
#include <cstddef>

namespace lsys::view {

struct QueryKind {
    static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};

class GpuTimer {
public:
    explicit GpuTimer(Device& device);

    void begin();
    void end();
    /// Milliseconds of the last span with a result; does not wait. 0: none.
    [[nodiscard]] double milliseconds();

private:
    static constexpr std::size_t kSpans = 4;
    struct Span {
        Object<QueryKind> begin;
        Object<QueryKind> end;
        bool is_pending = false;
    };
    std::array<Span, kSpans> spans_;
    std::size_t current_ = 0;
    double milliseconds_ = 0.0;
};

} // namespace lsys::view
