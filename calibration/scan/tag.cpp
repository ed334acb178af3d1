// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/tag.h"

#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

namespace {

struct Sample {
    glm::ivec2 pixel{};
    glm::dvec2 cell{};
};

// Places at most so many cells away from the tag.
std::vector<Sample> samplesAround(const ChannelView& view, glm::ivec2 camera, glm::ivec2 channel) {
    constexpr double kReach = 4;
    const wall::ScanTagPlace tag = wall::scanTagPlace(channel);
    std::vector<Sample> samples;
    for (int y = 0; y < camera.y; ++y)
        for (int x = 0; x < camera.x; ++x) {
            const glm::dvec2 place(view.place[static_cast<std::size_t>(y * camera.x + x)]);
            const glm::dvec2 cell = (place - glm::dvec2(tag.corner)) / static_cast<double>(tag.cell);
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
    constexpr double kMostError = 0.15;  // cells, RMS
    const std::vector<Sample> samples = samplesAround(view, cameraPixels, channelPixels);
    if (samples.size() < kLeast) return std::nullopt;
    TagMap map;
    map.cell_ = wall::scanTagPlace(channelPixels).cell;
    for (const Sample& sample : samples) {
        map.low_ = glm::min(map.low_, sample.pixel);
        map.high_ = glm::max(map.high_, sample.pixel);
    }
    map.middle_ = 0.5 * glm::dvec2(map.low_ + map.high_);
    map.scale_ = 2 / glm::length(glm::dvec2(map.high_ - map.low_));
    for (int axis = 0; axis < 2; ++axis) {
        LeastSquares<6> fit;
        for (const Sample& sample : samples) fit.add(map.termsAt(sample.pixel), sample.cell[axis]);
        const auto found = fit.solve();
        if (!found) return std::nullopt;
        map.fit_.at(static_cast<std::size_t>(axis)) = *found;
    }
    double square = 0;
    for (const Sample& sample : samples) {
        const glm::dvec2 error = map.cellAt(sample.pixel) - sample.cell;
        square += glm::dot(error, error) / static_cast<double>(samples.size());
    }
    return square < kMostError * kMostError ? std::optional(map) : std::nullopt;
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
