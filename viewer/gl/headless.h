// Headless: an OpenGL 4.5 core context without a window, on machines with or without a display.
// Tried in turn: EGL without a surface, EGL on a device, a hidden window.
#pragma once

#include "grammar/base/result.h"

#include <memory>
#include <string>

namespace lsys::view {

class Headless {
public:
    /// Makes it current on this thread. Error: why each way failed.
    [[nodiscard]] static Result<std::unique_ptr<Headless>> make();
    Headless(const Headless&) = delete;
    Headless& operator=(const Headless&) = delete;
    ~Headless();

    /// "EGL without a surface".
    [[nodiscard]] const std::string& way() const { return way_; }

private:
    struct State;
    Headless();
    std::unique_ptr<State> state_;
    std::string way_;
};

} // namespace lsys::view
