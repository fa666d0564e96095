// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/gpu_timer.h"

namespace lsys::view {

GpuTimer::GpuTimer(Device& device) {
    for (Span& span : spans_) {
        for (Object<QueryKind>* query : {&span.begin, &span.end}) {
            GLuint name = 0;
            glCreateQueries(GL_TIMESTAMP, 1, &name);
            *query = Object<QueryKind>(device, name);
        }
    }
}

void GpuTimer::begin() {
    current_ = (current_ + 1) % kSpans;
    spans_[current_].is_pending = false;
    glQueryCounter(spans_[current_].begin.name(), GL_TIMESTAMP);
}

void GpuTimer::end() {
    glQueryCounter(spans_[current_].end.name(), GL_TIMESTAMP);
    spans_[current_].is_pending = true;
}

double GpuTimer::milliseconds() {
    for (std::size_t i = 1; i <= kSpans; ++i) { // oldest first
        Span& span = spans_[(current_ + i) % kSpans];
        if (!span.is_pending) {
            continue;
        }
        GLuint available = GL_FALSE;
        glGetQueryObjectuiv(span.end.name(), GL_QUERY_RESULT_AVAILABLE, &available);
        if (available == GL_FALSE) {
            break;
        }
        GLuint64 first = 0;
        GLuint64 last = 0;
        glGetQueryObjectui64v(span.begin.name(), GL_QUERY_RESULT, &first);
        glGetQueryObjectui64v(span.end.name(), GL_QUERY_RESULT, &last);
        span.is_pending = false;
        milliseconds_ = last > first ? 1e-6 * static_cast<double>(last - first) : 0.0;
    }
    return milliseconds_;
}

} // namespace lsys::view
