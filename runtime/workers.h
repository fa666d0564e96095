// Workers: a team of threads for pieces of work, for folders that stand on the runtime.
#pragma once

#include "runtime/derive/workers.h" // IWYU pragma: export
