// SPDX-License-Identifier: MIT
#include "runtime/mpi/lsc_mpi.h"
#include "runtime/program/process.h"

#include <revision.h>

int main(int argc, char** argv) {
    return lsys::run_process(argc, argv, "lsc-mpi", LSYS_REVISION, lsys::mpi::run);
}
