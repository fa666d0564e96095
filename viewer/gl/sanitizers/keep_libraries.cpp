// SPDX-License-Identifier: MIT
// Replaces dlclose(), so that programs with sanitizers keep all libraries loaded. Sanitizers cannot
// name functions of an unloaded driver, and count memory that its variables point to as leaked.

extern "C" __attribute__((visibility("default"))) int dlclose(void* /*library*/) noexcept {
    return 0;
}
