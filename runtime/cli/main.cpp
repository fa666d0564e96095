#include "runtime/cli/process.h"

int main(int argc, char** argv) {
    return lsys::lsc::run_process(argc, argv, "lsc", lsys::lsc::run);
}
