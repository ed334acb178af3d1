// SPDX-License-Identifier: Apache-2.0
// A line of comma separated values.
#pragma once

#include <ostream>
#include <utility>

namespace aquarama::report {

// None of the values may have a comma in it.
template <class... Values>
void addRow(std::ostream& csv, const Values&... values) {
    const char* comma = "";
    ((csv << std::exchange(comma, ",") << values), ...);
    csv << '\n';
}

}  // namespace aquarama::report
