// SPDX-License-Identifier: Apache-2.0
// The clock that counts from the start of this machine on, also while it sleeps: alike for all its
// processes, and nobody sets it.
#pragma once

#include <cstdint>
#include <ctime>

namespace aquarama {

// CLOCK_BOOTTIME, nanoseconds.
[[nodiscard]] inline std::int64_t bootNanoseconds() {
    timespec now{};
    clock_gettime(CLOCK_BOOTTIME, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

}  // namespace aquarama
