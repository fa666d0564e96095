// SPDX-License-Identifier: MIT
#include "runtime/program/process.h"
#include "viewer/app/lsview.h"

#include <revision.h>

int main(int argc, char** argv) {
    return lsys::run_process(argc, argv, "lsview", LSYS_REVISION, lsys::view::run);
}
