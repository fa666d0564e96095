#pragma once

namespace lsys {

struct Twice {
    int a;
};

} // namespace lsys
