#include "runtime/cli/lsc.h"
#include "runtime/program/process.h"

int main(int argc, char** argv) {
    return lsys::run_process(argc, argv, "lsc", lsys::lsc::run);
}
