// SPDX-License-Identifier: MIT
// A minimal C++ program that prints one line; start_bench compares the start of lsc with it.
#include <iostream>

int main() {
    std::cout << "one line\n";
    return 0;
}
