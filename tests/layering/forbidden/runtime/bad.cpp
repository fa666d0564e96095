// A case for the test of the rule: this include must be found.
#include "compiler/compile.h"
