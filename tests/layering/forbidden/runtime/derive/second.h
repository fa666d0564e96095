#pragma once

namespace lsys {

struct Twice {
    char b;
};

} // namespace lsys
