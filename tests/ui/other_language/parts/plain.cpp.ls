#include <iostream>
#include <vector>

int main() {
    std::vector<int> v{1, 2, 3};
    for (int each : v) {
        std::cout << each;
    }
}
