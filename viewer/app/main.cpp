#include "runtime/program/process.h"
#include "viewer/app/lsview.h"

int main(int argc, char** argv) {
    return lsys::run_process(argc, argv, "lsview", lsys::view::run);
}
