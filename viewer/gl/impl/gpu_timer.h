// SPDX-License-Identifier: MIT
// GpuTimer: measures by timer queries how long the device takes for a span of commands. Results
// arrive some pictures later, unless the device has finished already.
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
    /// Milliseconds of the last span whose result has arrived; 0: none has. Does not wait.
    [[nodiscard]] double milliseconds();

private:
    static constexpr std::size_t kSpans = 4;
    struct Span {
        Object<QueryKind> begin;
        Object<QueryKind> end;
        bool is_pending = false;
    };
    std::array<Span, kSpans> spans_;
    std::size_t current_ = 0;   // index in spans_ of the last span that began
    double milliseconds_ = 0.0; // duration of the last span whose result has arrived
};

} // namespace lsys::view
