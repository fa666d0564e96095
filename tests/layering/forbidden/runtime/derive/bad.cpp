// check_includes.cmake must report these includes, except the first; a test checks that.
#include "compiler/bytecode/bytecode.h"
#include "compiler/compile.h"
#include "runtime/turtle/turtle.h"
#include "compiler/growth/impl/known_values.h"
#include <unistd.h>
