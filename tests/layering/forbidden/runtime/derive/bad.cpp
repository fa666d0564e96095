// Includes that check_includes.cmake must report; the test checks that it does.
#include "compiler/bytecode/bytecode.h"
#include "compiler/compile.h"
#include "runtime/turtle/turtle.h"
#include "compiler/growth/impl/known_values.h"
#include <unistd.h>
