// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/room_light.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace aquarama::scan {

namespace {

// The mean light of each tile of a small copy; tiles are larger than the periods of the patterns.
constexpr glm::ivec2 kTiles{12, 8};
using Tiles = std::vector<double>;
Tiles tilesOf(const Plane& small, glm::ivec2 size) {
    Tiles sums(static_cast<std::size_t>(kTiles.x * kTiles.y)), counts(sums.size());
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const auto tile =
                static_cast<std::size_t>(y * kTiles.y / size.y * kTiles.x + x * kTiles.x / size.x);
            sums[tile] += double{small[static_cast<std::size_t>(y * size.x + x)]};
            ++counts[tile];
        }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= std::max(1.0, counts[i]);
    return sums;
}

// Above 0, so that one can divide by it.
double mostLight(const SmallChannels& channels) {
    return double{std::max(channels.mostLight(), 1e-6F)};
}

void reportLamp(FaultList& faults, std::size_t picture, double share) {
    faults.add(
        "ambient_light",
        fmt::format("light of the room has changed by {:.0f} % of white until {}: switch lamps "
                    "off, close doors and curtains, and scan again",
                    100 * share,
                    faults.pictureName(picture)));
}

// The light of a picture as a multiple of the expected light, and the light where no channel is lit
// as a share of the light expected of lit places.
struct Drift {
    double gain = 1, lamp = 0;
};

// A picture of phase, from afar, looks like half of the white of its channels.
Drift driftOf(const SmallChannels& channels, const SmallPicture& picture, std::uint64_t lit) {
    const float unlit = 0.1F * static_cast<float>(mostLight(channels));
    double seen = 0, expected = 0, count = 0, beside = 0, besideCount = 0;
    for (std::size_t p = 0; p < picture.light.size(); ++p) {
        const float half = 0.5F * channels.lightAt(p, lit);
        const double more = double{picture.light[p] - channels.black()[p]};
        if (half < unlit) {
            beside += more - double{half};
            ++besideCount;
            continue;
        }
        seen += more;
        expected += double{half};
        ++count;
    }
    if (count == 0) return {};
    const double mean = expected / count;
    return {seen / expected, besideCount > 0 ? beside / besideCount / mean : 0};
}

}  // namespace

void findBlackDrift(const Evidence& evidence, const SmallChannels& channels, FaultList& faults) {
    constexpr double kMostChange = 0.02;
    const double white = mostLight(channels);
    const Tiles first = tilesOf(channels.black(), evidence.small.sizePixels);
    for (const SmallPicture& picture : evidence.small.pictures) {
        if (!isBlack(evidence.scan.pictures[picture.index].pattern)) continue;
        const Tiles now = tilesOf(picture.light, evidence.small.sizePixels);
        double most = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
            most = std::max(most, std::abs(now[i] - first[i]));
        if (most > kMostChange * white) reportLamp(faults, picture.index, most / white);
    }
}

void findLightDrift(const Evidence& evidence, const SmallChannels& channels, FaultList& faults) {
    constexpr double kMostChange = 0.05, kMostOfWhite = 0.2;
    std::map<std::uint64_t, double> first;  // by the channels that are lit
    for (const SmallPicture& picture : evidence.small.pictures) {
        const config::ScanPattern& pattern = evidence.scan.pictures[picture.index].pattern;
        if (!isPhase(pattern.kind)) continue;
        const Drift drift = driftOf(channels, picture, pattern.lit);
        const double before = first.emplace(pattern.lit, drift.gain).first->second;
        if (std::abs(drift.gain - 1) < kMostOfWhite &&
            std::abs(drift.gain / before - 1) < kMostChange)
            continue;
        if (drift.lamp > 0.5 * std::abs(drift.gain - 1))
            return reportLamp(faults, picture.index, drift.lamp);
        return faults.add(
            "auto_exposure",
            fmt::format("{} is exposed {:.2f} times as much as white and black: fix the "
                        "camera's exposure, gain and white balance, and scan again",
                        faults.pictureName(picture.index),
                        drift.gain));
    }
}

}  // namespace aquarama::scan
