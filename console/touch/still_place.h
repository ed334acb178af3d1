// SPDX-License-Identifier: Apache-2.0
// Whether one place alone has been seen, still, for long enough to be somebody at a mark.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "common/tuio/hand_set.h"

namespace aquarama::console {

// So long it has to be still, seconds.
inline constexpr double kStillForSeconds = 2;
// As far, in shares, a mark has to be from those before it.
inline constexpr double kApartShares = 0.05;

// A value without clock or socket: times are seconds of any clock that is never set back.
class StillPlace {
  public:
    // `spread`: how far it may move in all, shares of the plane. `before`: places of earlier marks.
    StillPlace(double spread, std::vector<glm::dvec2> before)
        : spread_{spread}, before_{std::move(before)} {}

    // The mean place, once it was still. A tracker may lose a hand and give it another session.
    [[nodiscard]] std::optional<glm::dvec2> see(const std::vector<tuio::Hand>& hands, double now);

    // What is seen, for whoever is at the mark; changes with what there is to do.
    [[nodiscard]] std::string text() const;

  private:
    void add(glm::dvec2 place, double now);
    [[nodiscard]] bool isAtAnEarlierMark(glm::dvec2 place) const;

    double spread_;
    std::vector<glm::dvec2> before_;
    std::deque<std::pair<double, glm::dvec2>> kept_;  // of one that has been still
    std::size_t count_ = 0;
};

}  // namespace aquarama::console
