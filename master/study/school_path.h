// SPDX-License-Identifier: Apache-2.0
// Whether a path repeats itself: a school that follows a script comes back after its period.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace aquarama::study {

// The autocorrelation of a path at lags 0 to `mostLag`, in samples: for each coordinate the mean
// product of the differences from its mean at two times, divided by its variance; then the mean of
// the coordinates that vary. At lag 0 it is 1, or 0 for a path that stays. `mostLag` is below the
// number of points. O(points x mostLag).
[[nodiscard]] std::vector<double> autocorrelationOf(std::span<const glm::dvec3> path,
                                                    std::size_t mostLag);

// The highest peak of an autocorrelation and its lag, in samples.
struct PathPeak {
    double height = 0;
    std::size_t lag = 0;
    // Of the first peak at most kAlikePeaks lower. A path that repeats itself has peaks at all
    // multiples of its period; this is the shortest.
    std::size_t firstLag = 0;
};
inline constexpr double kAlikePeaks = 0.1;
// Of peaks beyond the first zero, not at the end, and not within `tolerance` samples of a multiple
// of one of `periods`; all 0 where there is none.
[[nodiscard]] PathPeak highestPeak(std::span<const double> autocorrelation,
                                   std::span<const std::size_t> periods = {},
                                   std::size_t tolerance = 0);

}  // namespace aquarama::study
