// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/faults.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "calibration/scan/dropped_frames.h"
#include "calibration/scan/fault_list.h"
#include "calibration/scan/movement.h"
#include "calibration/scan/room_light.h"
#include "calibration/scan/small_channels.h"
#include "common/base/statistics.h"
#include "common/wall/wall.h"

namespace aquarama::scan {

namespace {

constexpr float kLeastChannelLight = SmallChannels::kLeastLight;

bool isScanned(const Evidence& evidence, std::size_t channel) {
    return !evidence.view.channels[channel].place.empty();
}

void findClipped(const Evidence& evidence, std::size_t channel, FaultList& faults) {
    constexpr double kMostClipped = 0.01;
    const ChannelNotes& notes = evidence.channels[channel];
    if (notes.clipped > kMostClipped)
        faults.add(
            "over_exposed",
            fmt::format("white of channel \"{}\" is too bright in {:.0f} % of its pixels: close "
                        "the aperture, or choose a shorter exposure where the camera has its own, "
                        "and scan again",
                        faults.channelName(channel),
                        100 * notes.clipped),
            notes.hasPhase);
}

void findExposure(const Evidence& evidence, const SmallChannels& channels, FaultList& faults) {
    if (channels.mostLight() < kLeastChannelLight)
        return faults.add(
            "under_exposed",
            fmt::format("white is only {:.1f} % of the camera's range: open the aperture, "
                        "or choose a longer exposure where the camera has its own, and scan "
                        "again",
                        100 * double{channels.mostLight()}));
    for (std::size_t c = 0; c < channels.size(); ++c)
        if (isScanned(evidence, c)) findClipped(evidence, c, faults);
}

void reportFaint(std::size_t channel, FaultList& faults) {
    faults.add("under_exposed",
               fmt::format("patterns of channel \"{}\" are faint in the camera's noise: darken the "
                           "room, focus the camera, open its aperture, and scan again",
                           faults.channelName(channel)));
}

// A channel without places is too dark for the camera's noise, or is not there.
void findUnseen(const Evidence& evidence, const SmallChannels& channels, FaultList& faults) {
    constexpr double kLeastSignal = 12;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        if (!isScanned(evidence, c) || channels[c].isSeen()) continue;
        const double most = double{channels[c].most};
        if (most > double{kLeastChannelLight} && most < kLeastSignal * evidence.view.noise)
            reportFaint(c, faults);
        else
            faults.add(
                "channel_not_seen",
                fmt::format(
                    "the camera does not see channel \"{}\": switch its projector on, check its "
                    "cable, clear the camera's view, and scan again",
                    faults.channelName(c)));
    }
}

void findNoise(const Evidence& evidence, std::size_t channel, FaultList& faults) {
    constexpr float kMostSigma = 1.5F;
    Plane sigmas;
    for (const glm::vec2 sigma : evidence.view.channels[channel].sigma)
        if (sigma.x == sigma.x) sigmas.push_back(std::max(sigma.x, sigma.y));
    if (!sigmas.empty() && median(sigmas) > kMostSigma) reportFaint(channel, faults);
}

// Counts the cells of a channel's picture that fall on the screen, by the rig, and are not seen.
void findBlocked(const Evidence& evidence,
                 const SmallChannels& channels,
                 const wall::Wall& wall,
                 std::size_t channel,
                 FaultList& faults) {
    constexpr double kRefused = 0.25, kWarned = 0.1;
    constexpr glm::ivec2 kGrid = SmallChannel::kGrid;
    const glm::dvec2 cell =
        glm::dvec2(evidence.rig.channels[channel].sizePixels) / glm::dvec2(kGrid);
    int expected = 0, unseen = 0;
    for (int y = 0; y < kGrid.y; ++y)
        for (int x = 0; x < kGrid.x; ++x) {
            if (!wall.channel(channel).pointOf((glm::dvec2(x, y) + 0.5) * cell, 0)) continue;
            ++expected;
            const auto at = static_cast<std::size_t>(y * kGrid.x + x);
            unseen += channels[channel].seen[at] == 0 ? 1 : 0;
        }
    const double share = static_cast<double>(unseen) / std::max(1, expected);
    if (share < kWarned) return;
    // A warning where another camera may see the rest.
    faults.add(
        "blocked",
        fmt::format("{:.0f} % of channel \"{}\" is not seen: clear the view of the camera and of "
                    "the projector, or move the camera back, and scan again",
                    100 * share,
                    faults.channelName(channel)),
        share > kRefused && evidence.scan.cameras.size() == 1);
}

}  // namespace

std::vector<ScanFault> faultsOf(const Evidence& evidence) {
    const SmallChannels channels(evidence);
    FaultList faults(evidence);
    const auto forSeen = [&](const auto& look) {
        for (std::size_t c = 0; c < channels.size(); ++c)
            if (channels[c].isSeen()) look(c);
    };
    findExposure(evidence, channels, faults);
    findRepeats(evidence, channels, faults);
    findLateChannels(evidence, channels, faults);
    // A fault makes later checks fail too, so they are left out.
    if (!faults.refuses()) findUnseen(evidence, channels, faults);
    if (!faults.refuses()) findBlackDrift(evidence, channels, faults);
    if (!faults.refuses())
        forSeen([&](std::size_t c) { findMovement(evidence, channels, c, faults); });
    if (!faults.refuses()) findLightDrift(evidence, channels, faults);
    if (!faults.refuses()) forSeen([&](std::size_t c) { findNoise(evidence, c, faults); });
    if (faults.refuses()) return faults.all();
    const wall::Wall wall(evidence.rig);
    forSeen([&](std::size_t c) { findBlocked(evidence, channels, wall, c, faults); });
    return faults.all();
}

}  // namespace aquarama::scan
