// The least that a C++ program does to print one line: what start_bench compares the start of lsc
// with.
#include <iostream>

int main() {
    std::cout << "one line\n";
    return 0;
}
