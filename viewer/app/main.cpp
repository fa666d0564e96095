#include "runtime/cli/process.h"
#include "viewer/app/lsview.h"

int main(int argc, char** argv) {
    return lsys::lsc::run_process(argc, argv, "lsview", lsys::view::run);
}
