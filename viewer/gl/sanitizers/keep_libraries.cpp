// SPDX-License-Identifier: MIT
// Replaces dlclose() in programs with sanitizers, so that all libraries stay loaded. Sanitizers
// cannot name functions of a driver that was unloaded, and report memory as leaked to which only
// variables of that driver point.

extern "C" __attribute__((visibility("default"))) int dlclose(void* /*library*/) noexcept {
    return 0;
}
