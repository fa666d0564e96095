// SPDX-License-Identifier: MIT
#include "runtime/cli/lsc.h"
#include "runtime/program/process.h"

#include <revision.h>

int main(int argc, char** argv) {
    return lsys::run_process(argc, argv, "lsc", LSYS_REVISION, lsys::lsc::run);
}
