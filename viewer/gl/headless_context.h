// SPDX-License-Identifier: MIT
// HeadlessContext: an OpenGL 4.5 core context without a window, on machines with or without a
// display. Tries in turn: EGL without a surface, EGL on a device, a hidden window.
#pragma once

#include "grammar/base/result.h"

#include <memory>
#include <string>

namespace lsys::view {

class HeadlessContext {
public:
    /// Makes a context that is current on this thread. The error lists the reasons for which each
    /// way failed.
    [[nodiscard]] static Result<std::unique_ptr<HeadlessContext>> make();
    /// Like make(), but never makes a hidden window, which only the main thread may make, and only
    /// while no Window exists.
    [[nodiscard]] static Result<std::unique_ptr<HeadlessContext>> make_without_window();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;
    ~HeadlessContext();

    /// Description of the context, for example "EGL without a surface".
    [[nodiscard]] const std::string& description() const { return description_; }

private:
    struct State;
    [[nodiscard]] static Result<std::unique_ptr<HeadlessContext>> make(bool may_use_window);
    HeadlessContext();
    std::unique_ptr<State> state_;
    std::string description_;
};

} // namespace lsys::view
