// SPDX-License-Identifier: MIT
#include "tests/reference/environments/program.h"

namespace lsys::reference {

Answers program_answers(std::uint32_t generation, const std::vector<Place>& places) {
    Answers answers;
    for (const Place& place : places) {
        double sum = 0;
        for (const float parameter : place.parameters) {
            sum += static_cast<double>(parameter);
        }
        std::vector<double> answer = {
            place.position[0] + 2 * place.position[1] - place.position[2],
            place.heading[0] + place.heading[1] / 2 + place.up[2],
            static_cast<double>(generation) + static_cast<double>(answers.size()) / 2,
            sum / 8,
        };
        answer.resize(4 - answers.size() % 4); // modules may have more parameters, or fewer
        answers.push_back(answer);
    }
    return answers;
}

} // namespace lsys::reference
