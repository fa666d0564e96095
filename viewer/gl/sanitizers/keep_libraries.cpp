// Keeps libraries loaded in programs with sanitizers. Reports cannot name functions of an unloaded
// driver, and memory that its variables point to would count as leaked.

extern "C" __attribute__((visibility("default"))) int dlclose(void* /*library*/) noexcept {
    return 0;
}
