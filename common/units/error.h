// SPDX-License-Identifier: Apache-2.0
// The one exception of the project: thrown while something starts, caught once in each main().
#pragma once

#include <stdexcept>
#include <string>

namespace aquarama {

// Says what is wrong, where, and what to do, in one line: "config/desk.txtpb:12:3: projector "left"
// ...; move it". Nothing throws inside the frame loop; there a bad packet is an empty optional, and
// is counted.
class Error : public std::runtime_error {
  public:
    explicit Error(const std::string& whatWhereAndWhatToDo)
        : std::runtime_error(whatWhereAndWhatToDo) {}
};

}  // namespace aquarama
