// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/dropped_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

namespace {

using config::ScanPattern;
using Kind = ScanPattern::Kind;

bool isCode(Kind kind) {
    return kind != Kind::Level && kind != Kind::Room;
}

bool isColour(const ScanPattern& pattern) {
    return pattern.light.r != pattern.light.g || pattern.light.g != pattern.light.b;
}

// Whether two patterns must look different where the camera sees this channel.
bool mustDiffer(const ScanPattern& a, const ScanPattern& b, std::size_t channel) {
    const bool isLit = config::contains(a.lit | b.lit, channel);
    if (a.kind == Kind::Room || b.kind == Kind::Room || !isLit) return false;
    if (isCode(a.kind) || isCode(b.kind)) return true;
    if (isColour(a) || isColour(b)) return false;  // the camera may mix colours into one grey
    return std::abs(weightOf(a, channel) - weightOf(b, channel)) > 0.2F;
}

// The light of a channel's white in its brighter places, and the difference of two pictures there.
std::pair<double, double> differenceOf(const SmallChannel& channel,
                                       const Plane& before,
                                       const Plane& now) {
    constexpr float kBright = 0.3F;
    double light = 0, apart = 0;
    for (std::size_t p = 0; p < before.size(); ++p) {
        if (channel.light[p] < kBright * channel.most) continue;
        apart += double{std::abs(now[p] - before[p])};
        light += double{channel.light[p]};
    }
    return {light, apart};
}

// Whether a picture shows what another one shows, though their patterns differ.
bool isRepeated(const Evidence& evidence,
                const SmallChannels& channels,
                std::size_t before,
                std::size_t now) {
    constexpr double kSame = 0.06;
    const ScanPattern& a = evidence.scan.pictures[before].pattern;
    const ScanPattern& b = evidence.scan.pictures[now].pattern;
    double changed = 0, light = 0;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        if (channels[c].most < SmallChannels::kLeastLight || !mustDiffer(a, b, c)) continue;
        const auto [lit, apart] =
            differenceOf(channels[c], *evidence.small.of(before), *evidence.small.of(now));
        changed += apart;
        light += lit * double{std::max(weightOf(a, c), weightOf(b, c))};
    }
    return light > 0 && changed < kSame * light;
}

// Whether a pattern with this number is shown shortly before or after a picture. A number that is
// not was misread.
bool isNear(const config::Scan& scan, unsigned number, std::size_t index) {
    constexpr std::size_t kReach = 6;
    const std::size_t last = std::min(scan.pictures.size(), index + kReach + 1);
    for (std::size_t i = index - std::min(index, kReach); i < last; ++i)
        if (scan.pictures[i].pattern.number == number) return true;
    return false;
}

using TagLight = std::array<double, wall::kScanTagCells>;

// The mean light of each cell of a tag.
TagLight lightOfCells(const SmallChannel& small, const Plane& light) {
    TagLight sums{}, counts{};
    for (std::size_t p = 0; p < small.cells.size(); ++p) {
        if (small.cells[p] < 0) continue;
        const auto cell = static_cast<std::size_t>(small.cells[p]);
        sums.at(cell) += double{light[p]};
        ++counts.at(cell);
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums.at(i) /= counts.at(i);
    return sums;
}

// The number that a tag shows; nothing where a cell is unclear.
std::optional<unsigned> tagOf(const SmallChannel& small, const Plane& light, double noise) {
    constexpr double kLeastContrast = 0.03, kLeastNoises = 5, kDoubt = 0.15;
    const TagLight cells = lightOfCells(small, light);
    const double contrast = cells[0] - cells[1], middle = 0.5 * (cells[0] + cells[1]);
    if (contrast < std::max(kLeastContrast * double{small.most}, kLeastNoises * noise))
        return std::nullopt;
    if (std::ranges::any_of(
            cells, [&](double cell) { return std::abs(cell - middle) < kDoubt * contrast; }))
        return std::nullopt;
    unsigned number = 0;
    for (std::size_t i = 2; i < cells.size() - 1; ++i)
        number = 2 * number + (cells.at(i) > middle ? 1U : 0U);
    const bool isOdd = wall::scanTagIsLit(wall::kScanTagCells - 1, number);
    return isOdd == (cells.back() > middle) ? std::optional(number) : std::nullopt;
}

}  // namespace

void findRepeats(const Evidence& evidence, const SmallChannels& channels, FaultList& faults) {
    std::optional<std::size_t> before;  // of this camera
    for (std::size_t i = 0; i < evidence.scan.pictures.size(); ++i) {
        if (evidence.scan.pictures[i].camera != evidence.camera) continue;
        if (before && isRepeated(evidence, channels, *before, i))
            faults.add(
                "dropped_frame",
                fmt::format("{} shows what the picture before it shows: end other programs on "
                            "the nodes and here, and scan again; a program of your own must "
                            "wait longer after each pattern",
                            faults.pictureName(i)));
        before = i;
    }
}

void findLateChannels(const Evidence& evidence, const SmallChannels& channels, FaultList& faults) {
    for (const SmallPicture& picture : evidence.small.pictures) {
        const ScanPattern& pattern = evidence.scan.pictures[picture.index].pattern;
        if (!pattern.tagged || pattern.number == 0) continue;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            if (!config::contains(pattern.lit, c) || !channels[c].hasTag) continue;
            const auto number = tagOf(channels[c], picture.light, evidence.view.noise);
            if (!number || *number == pattern.number ||
                !isNear(evidence.scan, *number, picture.index))
                continue;
            faults.add("dropped_frame",
                       fmt::format("channel \"{}\" shows pattern {} instead of {} in {}: end other "
                                   "programs on its node and here, and scan again; a program of "
                                   "your own must wait longer after each pattern",
                                   faults.channelName(c),
                                   *number,
                                   pattern.number,
                                   faults.pictureName(picture.index)));
        }
    }
}

}  // namespace aquarama::scan
