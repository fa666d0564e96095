// SPDX-License-Identifier: MIT
// The program of environments of kind `program` in random grammars: answers each line of queries on
// its standard input with a line on its standard output (docs/language.md section 13.4).

#include "tests/reference/environments/program.h"

#include <nlohmann/json.hpp>

#include <iostream>
#include <string>

int main() {
    using lsys::reference::Place;
    for (std::string line; std::getline(std::cin, line);) {
        const nlohmann::json question = nlohmann::json::parse(line);
        std::vector<Place> places;
        for (const nlohmann::json& query : question.at("queries")) {
            places.push_back({query.at("position"), query.at("heading"), query.at("up"),
                              query.at("parameters").get<std::vector<float>>()});
        }
        const nlohmann::json answers =
            lsys::reference::program_answers(question.at("generation"), places);
        std::cout << nlohmann::json{{"answers", answers}}.dump() << std::endl;
    }
}
