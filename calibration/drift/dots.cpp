// SPDX-License-Identifier: Apache-2.0
#include "calibration/drift/dots.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "calibration/scan/frames.h"
#include "common/base/log.h"
#include "common/base/statistics.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::drift {

namespace {

using Kind = config::ScanPattern::Kind;

// The luminance of a picture without that of the black wall.
struct DotPicture {
    glm::ivec2 size{};
    scan::Plane light;

    [[nodiscard]] float at(int x, int y) const {
        return light[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                     static_cast<std::size_t>(x)];
    }
};

// The linear light of a picture, by the camera's response. Sets `size` to that of the picture.
scan::Plane luminanceOf(scan::PictureSource& source, std::size_t index, glm::ivec2& size) {
    const config::Scan& scan = source.scan();
    const Picture picture = source.picture(index);
    const auto table =
        scan::lightOfCodes(picture.bits, scan.cameras[scan.pictures[index].camera].response);
    size = picture.sizePixels;
    scan::Plane light(picture.rgb.size() / 3);
    for (std::size_t i = 0; i < light.size(); ++i)
        light[i] = scan::cameraLuminance(table[picture.rgb[3 * i]],
                                         table[picture.rgb[3 * i + 1]],
                                         table[picture.rgb[3 * i + 2]]);
    return light;
}

// The black picture whose exposure is nearest.
std::size_t blackFor(const config::Scan& scan, std::size_t index) {
    std::optional<std::size_t> best;
    const auto apart = [&](std::size_t i) {
        return std::abs(
            std::log(scan.pictures[i].exposureSeconds / scan.pictures[index].exposureSeconds));
    };
    for (std::size_t i = 0; i < scan.pictures.size(); ++i)
        if (isBlack(scan.pictures[i].pattern) && (!best || apart(i) < apart(*best))) best = i;
    if (!best) throw Error("the pictures have none of the black wall; take them by aquarama drift");
    return *best;
}

// Throws Error where there is no black picture or where it has another size.
DotPicture dotPicture(scan::PictureSource& source, std::size_t index) {
    DotPicture picture;
    picture.light = luminanceOf(source, index, picture.size);
    glm::ivec2 size;
    const scan::Plane black = luminanceOf(source, blackFor(source.scan(), index), size);
    if (size != picture.size) throw Error("the pictures have different sizes; take them again");
    for (std::size_t i = 0; i < black.size(); ++i) picture.light[i] -= black[i];
    return picture;
}

// A bright spot in the dark.
struct Spot {
    glm::dvec2 place{};
    double radius = 0;
};

// Sums over the pixels of a spot.
struct SpotSum {
    double light = 0;
    glm::dvec2 moment{0};
    std::size_t pixels = 0;
};

// The connected pixels brighter than `least` around a pixel; they are removed from the picture.
SpotSum takeSpot(DotPicture& picture, glm::ivec2 start, float least) {
    SpotSum sum;
    std::vector<glm::ivec2> open{start};
    while (!open.empty()) {
        const glm::ivec2 at = open.back();
        open.pop_back();
        const bool isInside =
            at.x >= 0 && at.y >= 0 && at.x < picture.size.x && at.y < picture.size.y;
        if (!isInside || picture.at(at.x, at.y) <= least) continue;
        float& light =
            picture
                .light[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(picture.size.x) +
                       static_cast<std::size_t>(at.x)];
        sum.light += double{light};
        sum.moment += double{light} * (glm::dvec2(at) + 0.5);
        ++sum.pixels;
        light = 0;
        for (const glm::ivec2 step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}})
            open.push_back(at + step);
    }
    return sum;
}

// The vector from a place to the centre of the light around it, weighted by a Gaussian at the
// place. The window of a spot stays the same, so that the effect of other light cancels when two
// nights are compared.
glm::dvec2 wayToMiddle(const DotPicture& picture, glm::dvec2 place, double radius) {
    const glm::ivec2 low = glm::max(glm::ivec2(place - 3 * radius), 0);
    const glm::ivec2 high = glm::min(glm::ivec2(place + 3 * radius), picture.size - 1);
    double sum = 0;
    glm::dvec2 moment(0);
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
            const glm::dvec2 off = glm::dvec2(x, y) + 0.5 - place;
            const double weight =
                std::exp(-0.5 * glm::dot(off, off) / (radius * radius)) * double{picture.at(x, y)};
            sum += weight;
            moment += weight * off;
        }
    return sum > 0 ? moment / sum : glm::dvec2(0);
}

// The centre of a spot. The vector is doubled, as a window as wide as the spot shows half of it.
glm::dvec2 centred(const DotPicture& picture, const Spot& spot) {
    constexpr int kSteps = 30;
    glm::dvec2 place = spot.place;
    for (int step = 0; step < kSteps; ++step) {
        const glm::dvec2 move = 2.0 * wayToMiddle(picture, place, spot.radius);
        place += move;
        if (glm::length(move) < 1e-4 || glm::distance(place, spot.place) > 2 * spot.radius) break;
    }
    return place;
}

// Dots are brighter than this.
float leastLight(const DotPicture& picture) {
    constexpr float kLeastShare = 0.12F;   // of the brightest
    constexpr double kBrightest = 0.9997;  // but for this share of the pixels
    return kLeastShare * quantile(picture.light, kBrightest);
}

// Spots of a picture, none of them smaller than a few pixels.
std::vector<Spot> spotsIn(const DotPicture& picture) {
    constexpr std::size_t kLeastPixels = 8;
    const float least = leastLight(picture);
    std::vector<Spot> spots;
    if (least <= 0) return spots;
    DotPicture rest = picture;
    for (int y = 0; y < rest.size.y; ++y)
        for (int x = 0; x < rest.size.x; ++x) {
            if (rest.at(x, y) <= least) continue;
            const SpotSum sum = takeSpot(rest, {x, y}, least);
            if (sum.pixels < kLeastPixels) continue;
            spots.push_back({sum.moment / sum.light,
                             std::sqrt(static_cast<double>(sum.pixels) / std::numbers::pi) / 2});
        }
    for (Spot& spot : spots) spot.place = centred(picture, spot);
    return spots;
}

// The mean over a spot's middle.
double lightAt(const DotPicture& picture, const Spot& spot) {
    const int reach = std::max(1, static_cast<int>(spot.radius / 2));
    const glm::ivec2 middle(spot.place);
    double sum = 0;
    for (int y = middle.y - reach; y <= middle.y + reach; ++y)
        for (int x = middle.x - reach; x <= middle.x + reach; ++x)
            sum += double{picture.at(std::clamp(x, 0, picture.size.x - 1),
                                     std::clamp(y, 0, picture.size.y - 1))};
    return sum;
}

// Indices of the pictures of dots that these channels show together, by their step.
std::map<int, std::size_t> stepsOf(const config::Scan& scan, std::uint64_t lit) {
    std::map<int, std::size_t> steps;
    for (std::size_t i = 0; i < scan.pictures.size(); ++i) {
        const config::ScanPattern& pattern = scan.pictures[i].pattern;
        if (pattern.kind == Kind::Dots && pattern.lit == lit) steps.emplace(pattern.step, i);
    }
    return steps;
}

// The sets of channels that show dots together.
std::vector<std::uint64_t> roundsIn(const config::Scan& scan) {
    std::vector<std::uint64_t> rounds;
    for (const config::ScanPicture& picture : scan.pictures)
        if (picture.pattern.kind == Kind::Dots &&
            std::ranges::find(rounds, picture.pattern.lit) == rounds.end())
            rounds.push_back(picture.pattern.lit);
    return rounds;
}

// Step 0 shows all dots; step k shows those whose number has bit k - 1. A spot counts as lit above
// half of its light in step 0.
void readNumbers(scan::PictureSource& source,
                 std::uint64_t round,
                 std::size_t channels,
                 std::map<unsigned, std::vector<SeenDot>>& byNumber) {
    const std::map<int, std::size_t> steps = stepsOf(source.scan(), round);
    if (!steps.contains(0)) return;
    const DotPicture all = dotPicture(source, steps.at(0));
    const std::vector<Spot> spots = spotsIn(all);
    std::vector<unsigned> numbers(spots.size());
    for (const auto& [step, index] : steps) {
        if (step == 0) continue;
        const DotPicture some = dotPicture(source, index);
        for (std::size_t i = 0; i < spots.size(); ++i)
            if (lightAt(some, spots[i]) > 0.5 * lightAt(all, spots[i]))
                numbers[i] |= 1U << static_cast<unsigned>(step - 1);
    }
    for (std::size_t i = 0; i < spots.size(); ++i) {
        const unsigned index = numbers[i] - 1;  // of no dot where the number is 0
        const std::size_t channel = index / wall::kScanDotCount;
        if (numbers[i] == 0 || channel >= channels || ((round >> channel) & 1U) == 0) continue;
        byNumber[numbers[i]].push_back({channel,
                                        static_cast<int>(index % wall::kScanDotCount),
                                        spots[i].place,
                                        spots[i].radius});
    }
}

// The distance to the nearest other dot of the same channel.
double spacingOf(const SeenDot& dot, const std::vector<SeenDot>& dots) {
    double least = std::numeric_limits<double>::infinity();
    for (const SeenDot& other : dots)
        if (other.channel == dot.channel && other.dot != dot.dot)
            least = std::min(least, glm::distance(other.place, dot.place));
    return least;
}

}  // namespace

std::vector<SeenDot> numberedDots(scan::PictureSource& source, const config::Rig& rig) {
    std::map<unsigned, std::vector<SeenDot>> byNumber;
    for (const std::uint64_t round : roundsIn(source.scan()))
        readNumbers(source, round, rig.channels.size(), byNumber);
    std::vector<SeenDot> dots;
    for (const auto& [number, seen] : byNumber)
        if (seen.size() == 1) dots.push_back(seen.front());  // else something reflects
    return dots;
}

std::vector<SeenDot> foundAgain(scan::PictureSource& source, const std::vector<SeenDot>& before) {
    constexpr double kFarthest = 1.0 / 3;  // of the way to the next dot
    std::vector<SeenDot> found;
    for (const std::uint64_t round : roundsIn(source.scan())) {
        const DotPicture picture = dotPicture(source, stepsOf(source.scan(), round).at(0));
        const std::vector<Spot> spots = spotsIn(picture);
        for (const SeenDot& dot : before) {
            if (((round >> dot.channel) & 1U) == 0 || spots.empty()) continue;
            const Spot& nearest = *std::ranges::min_element(
                spots, {}, [&](const Spot& spot) { return glm::distance(spot.place, dot.place); });
            if (glm::distance(nearest.place, dot.place) > kFarthest * spacingOf(dot, before))
                continue;
            SeenDot now = dot;
            now.place = centred(picture, {nearest.place, dot.radius});
            found.push_back(now);
        }
    }
    return found;
}

}  // namespace aquarama::drift
