// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/tag.h"

#include <algorithm>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "calibration/scan/least_squares.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

namespace {

// Places at most so many cells away from the tag.
std::vector<TagMap::Sample> samplesAround(const ChannelView& view,
                                          glm::ivec2 camera,
                                          glm::ivec2 channel) {
    constexpr double kReach = 4;
    const wall::ScanTagPlace tag = wall::scanTagPlace(channel);
    std::vector<TagMap::Sample> samples;
    for (int y = 0; y < camera.y; ++y)
        for (int x = 0; x < camera.x; ++x) {
            const glm::dvec2 place(view.place[static_cast<std::size_t>(y * camera.x + x)]);
            const glm::dvec2 cell =
                (place - glm::dvec2(tag.corner)) / static_cast<double>(tag.cell);
            if (cell.x > -kReach && cell.y > -kReach && cell.x < wall::kScanTagCells + kReach &&
                cell.y < 1 + kReach)
                samples.push_back({{x, y}, cell});
        }
    return samples;
}

}  // namespace

std::optional<TagMap> TagMap::of(const ChannelView& view,
                                 glm::ivec2 cameraPixels,
                                 glm::ivec2 channelPixels) {
    constexpr std::size_t kLeast = 100;
    constexpr double kLeastShare = 0.7;
    std::vector<Sample> samples = samplesAround(view, cameraPixels, channelPixels);
    const std::size_t all = samples.size();
    if (all < kLeast) return std::nullopt;
    TagMap map;
    map.frame(samples, wall::scanTagPlace(channelPixels).cell, cameraPixels);
    // Cells; an error of phase, as of a picture that came late, is less than the last.
    for (const double allowed : {4.0, 2.0, 1.0, 0.5}) {
        if (!map.fit(samples)) return std::nullopt;
        std::erase_if(samples, [&](const Sample& sample) {
            const glm::dvec2 error = map.cellAt(sample.pixel) - sample.cell;
            return glm::dot(error, error) > allowed * allowed;
        });
        if (static_cast<double>(samples.size()) < kLeastShare * static_cast<double>(all))
            return std::nullopt;
    }
    return map;
}

void TagMap::frame(const std::vector<Sample>& samples, double cellPixels, glm::ivec2 cameraPixels) {
    cell_ = cellPixels;
    for (const Sample& sample : samples) {
        low_ = glm::min(low_, sample.pixel);
        high_ = glm::max(high_, sample.pixel);
    }
    middle_ = 0.5 * glm::dvec2(low_ + high_);
    scale_ = 2 / glm::length(glm::dvec2(high_ - low_));
    // Places may be seen on one side of the tag only.
    const int more = std::max(high_.x - low_.x, high_.y - low_.y) / 4;
    low_ = glm::max(low_ - more, glm::ivec2(0));
    high_ = glm::min(high_ + more, cameraPixels - 1);
}

bool TagMap::fit(const std::vector<Sample>& samples) {
    for (int axis = 0; axis < 2; ++axis) {
        LeastSquares<6> squares;
        for (const Sample& sample : samples) squares.add(termsAt(sample.pixel), sample.cell[axis]);
        const auto found = squares.solve();
        if (!found) return false;
        fit_.at(static_cast<std::size_t>(axis)) = *found;
    }
    return true;
}

glm::dvec2 TagMap::cellAt(glm::dvec2 pixel) const {
    const Terms terms = termsAt(pixel);
    glm::dvec2 cell(0);
    for (std::size_t i = 0; i < terms.size(); ++i)
        cell += terms.at(i) * glm::dvec2(fit_[0].at(i), fit_[1].at(i));
    return cell;
}

TagMap::Terms TagMap::termsAt(glm::dvec2 pixel) const {
    const glm::dvec2 at = scale_ * (pixel - middle_);
    return {1, at.x, at.y, at.x * at.x, at.x * at.y, at.y * at.y};
}

}  // namespace aquarama::scan
