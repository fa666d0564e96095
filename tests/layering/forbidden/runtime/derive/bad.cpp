// A case for the test of the rules: these includes must be found.
#include "compiler/bytecode/bytecode.h"
#include "compiler/compile.h"
#include "runtime/turtle/turtle.h"
#include "compiler/growth/impl/known_values.h"
