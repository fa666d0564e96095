// For programs with sanitizers: no library is unloaded. A driver that is gone when the program ends
// cannot be named in reports, and what its variables point to looks lost.

extern "C" __attribute__((visibility("default"))) int dlclose(void* /*library*/) noexcept {
    return 0;
}
