// SPDX-License-Identifier: MIT
// The environments of a derivation and the answers that they write into its words: section 13.3 of
// the language reference.

#pragma once

#include "tests/reference/environments/space.h"
#include "tests/reference/system.h"

namespace lsys::reference {

class Surroundings {
public:
    // Draws the markers. `system` must outlive the surroundings.
    explicit Surroundings(const System& system);

    // Writes the answers of all environments into a word that is complete up to this stage. Throws
    // Stop for a word or an answer that is an error.
    void sense(Word& word, std::uint32_t age, Derivation& derivation);

private:
    Answers answers_of(std::size_t number,
                       std::uint32_t age,
                       const std::vector<Place>& places,
                       const std::vector<Organ>& organs);

    const System& system_;
    std::map<std::size_t, Markers> markers_; // by number of the environment
};

} // namespace lsys::reference
