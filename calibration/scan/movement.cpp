// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/movement.h"

#include <bit>
#include <cmath>
#include <optional>

#include "calibration/scan/least_squares.h"

namespace aquarama::scan {

namespace {

// Whether no other channel lights a pixel of the small copies, and no tag lies there.
bool isOnlyOf(const SmallChannels& channels, std::size_t c, std::uint64_t others, std::size_t p) {
    constexpr float kShare = 0.05F;
    const SmallChannel& channel = channels[c];
    if (!channel.cells.empty() && channel.cells[p] != SmallChannel::kBeside) return false;
    for (std::uint64_t left = others; left != 0; left &= left - 1) {
        const SmallChannel& other = channels[static_cast<std::size_t>(std::countr_zero(left))];
        if (!other.light.empty() && other.light[p] > kShare * other.most) return false;
    }
    return true;
}

// Fits a picture by the light of the channel's white, its gradient across and down, and the white
// of the other channels, which reaches this one by way of the screen. A movement changes the light
// by the gradient times the movement.
LeastSquares<4> differenceFrom(const Evidence& evidence,
                               const SmallChannels& channels,
                               std::size_t c,
                               const SmallPicture& picture) {
    LeastSquares<4> fit;
    fit.add({0, 0, 0, 1e-3}, 0);  // solvable where no other is lit
    const Plane& white = channels[c].light;
    const std::uint64_t others =
        evidence.scan.pictures[picture.index].pattern.lit & ~config::bitOf(c);
    const auto row = static_cast<std::size_t>(evidence.small.sizePixels.x);
    for (std::size_t p = row; p + row < white.size(); ++p) {
        if (!isOnlyOf(channels, c, others, p)) continue;
        const double across = 0.5 * double{white[p + 1] - white[p - 1]};
        const double down = 0.5 * double{white[p + row] - white[p - row]};
        fit.add({double{white[p]}, across, down, double{channels.lightAt(p, others)}},
                double{picture.light[p] - channels.black()[p]});
    }
    return fit;
}

// How far the channel has moved from its white to a picture of an even level, in its pixels;
// nothing for other pictures.
std::optional<double> movedSinceWhite(const Evidence& evidence,
                                      const SmallChannels& channels,
                                      std::size_t c,
                                      const SmallPicture& picture) {
    constexpr float kLeastLevel = 0.3F;
    const config::ScanPattern& pattern = evidence.scan.pictures[picture.index].pattern;
    // Shorter exposures are left out: there the camera's response, where it is not linear, looks
    // like a movement.
    const bool isLevel = pattern.kind == config::ScanPattern::Kind::Level && pattern.step == 0 &&
                         weightOf(pattern, c) > kLeastLevel;
    if (!isLevel || (channels[c].cells.empty() && evidence.channels[c].isTagged))
        return std::nullopt;
    const auto found = differenceFrom(evidence, channels, c, picture).solve();
    if (!found || (*found)[0] <= 0) return std::nullopt;
    const double moved = std::hypot((*found)[1], (*found)[2]) / (*found)[0];
    return moved * evidence.small.factor * double{evidence.channels[c].step};
}

void report(
    FaultList& faults, std::size_t c, double pixels, const char* when, std::size_t picture) {
    faults.add(
        "moved",
        fmt::format("channel \"{}\" or the camera has moved by {:.1f} px {} {}: fasten both and "
                    "scan again",
                    faults.channelName(c),
                    std::abs(pixels),
                    when,
                    faults.pictureName(picture)));
}

}  // namespace

void findMovement(const Evidence& evidence,
                  const SmallChannels& channels,
                  std::size_t channel,
                  FaultList& faults) {
    constexpr double kMostShift = 0.7;
    const ChannelNotes& notes = evidence.channels[channel];
    if (std::abs(notes.shift) > kMostShift)
        return report(faults, channel, notes.shift, "about", notes.shiftedPicture);
    double most = 0;
    std::size_t where = 0;
    for (const SmallPicture& small : evidence.small.pictures)
        if (const auto moved = movedSinceWhite(evidence, channels, channel, small);
            moved && *moved > most) {
            most = *moved;
            where = small.index;
        }
    if (most > kMostShift) report(faults, channel, most, "between its white and", where);
}

}  // namespace aquarama::scan
