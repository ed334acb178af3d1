// SPDX-License-Identifier: Apache-2.0
#include "console/touch/still_place.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace aquarama::console {

std::optional<glm::dvec2> StillPlace::see(const std::vector<tuio::Hand>& hands, double now) {
    count_ = hands.size();
    if (hands.size() != 1) {
        kept_.clear();
        return std::nullopt;
    }
    add(hands.front().place, now);
    if (now - kept_.front().first < kStillForSeconds) return std::nullopt;
    glm::dvec2 sum(0);
    for (const auto& [when, where] : kept_) sum += where;
    const glm::dvec2 mean = sum / static_cast<double>(kept_.size());
    return isAtAnEarlierMark(mean) ? std::nullopt : std::optional(mean);
}

// Forgets what is older than it needs to be, and all before a move.
void StillPlace::add(glm::dvec2 place, double now) {
    const auto isFar = [&](const auto& one) {
        return glm::any(glm::greaterThan(glm::abs(one.second - place), glm::dvec2(spread_)));
    };
    kept_.emplace_back(now, place);
    const auto lastFar = std::find_if(kept_.rbegin(), kept_.rend(), isFar);
    kept_.erase(kept_.begin(), lastFar.base());
    while (kept_.size() > 1 && now - kept_[1].first >= kStillForSeconds) kept_.pop_front();
}

bool StillPlace::isAtAnEarlierMark(glm::dvec2 place) const {
    return std::ranges::any_of(
        before_, [&](glm::dvec2 one) { return glm::length(place - one) < kApartShares; });
}

std::string StillPlace::text() const {
    if (count_ == 0) return "nobody is seen";
    if (count_ > 1) return fmt::format("{} are seen: one alone, please", count_);
    const glm::dvec2 place = kept_.back().second;
    if (isAtAnEarlierMark(place)) return "seen where the mark before was: go on to this one";
    return "seen: hold still";
}

}  // namespace aquarama::console
