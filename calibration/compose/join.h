// SPDX-License-Identifier: Apache-2.0
// Joins clips of one film.
#pragma once

#include <string>
#include <vector>

namespace aquarama::compose {

// The clips of a film in order, MP4 files of one encoder and size.
struct JoinedClips {
    std::string out;
    std::vector<std::string> clips;
    int ticksBetween = 1;  // of two pictures
};

// Writes them, one behind the other, as one file, without encoding them again. Throws Error, which
// names the file, where one is not as the first.
void join(const JoinedClips& joining);

}  // namespace aquarama::compose
