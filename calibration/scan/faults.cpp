// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/faults.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <spdlog/fmt/fmt.h>

#include "calibration/scan/tag.h"
#include "common/wall/scan_pattern.h"
#include "common/wall/wall.h"

namespace aquarama::scan {

namespace {

using config::ScanPattern;
using Kind = ScanPattern::Kind;

bool isCode(Kind kind) {
    return kind != Kind::Level && kind != Kind::Room;
}
bool isLit(const ScanPattern& pattern, std::size_t channel) {
    return ((pattern.lit >> channel) & 1U) != 0;
}
bool isPhase(Kind kind) {
    return kind == Kind::PhaseColumns || kind == Kind::PhaseRows;
}

bool isColour(const ScanPattern& pattern) {
    return pattern.light.r != pattern.light.g || pattern.light.g != pattern.light.b;
}

float luminanceOf(glm::vec3 light) {
    return 0.25F * light.r + 0.5F * light.g + 0.25F * light.b;
}

// The small copies of what was decoded.
struct SmallChannel {
    Plane light;             // white without black
    float most = 0;          // what its bright pixels have
    std::vector<int> cells;  // of the tag: index for each pixel, -1 beside it
    bool hasTag = false;
};

class FaultFinder {
  public:
    explicit FaultFinder(const Evidence& evidence)
        : evidence_{evidence}, black_{evidence.small.of(evidence.firstBlack)} {
        for (std::size_t c = 0; c < evidence.view.channels.size(); ++c)
            channels_.push_back(smallOf(c));
    }

    [[nodiscard]] std::vector<ScanFault> find() {
        findExposure();
        findRepeats();
        findLateChannels();
        findUnseen();
        // What is wrong makes what follows look wrong.
        if (!refused()) findBlackDrift();
        if (!refused()) forSeen([this](std::size_t c) { findMoved(c); });
        if (!refused()) findLightDrift();
        if (!refused()) forSeen([this](std::size_t c) { findNoise(c); });
        if (!refused()) forSeen([this](std::size_t c) { findBlocked(c); });
        return std::move(faults_);
    }

  private:
    static constexpr float kLeastLight = 0.04F;  // linear, of white
    static constexpr float kLeastSeen = 0.05F;   // share of a channel's picture
    static constexpr glm::ivec2 kGrid{24, 15};   // of a channel's picture

    [[nodiscard]] bool isScanned(std::size_t c) const {
        return !evidence_.view.channels[c].place.empty();
    }
    [[nodiscard]] bool isSeen(std::size_t c) const {
        return isScanned(c) && seenShare_.at(c) > kLeastSeen;
    }
    [[nodiscard]] const std::string& nameOf(std::size_t c) const {
        return evidence_.rig.channels[c].name;
    }
    [[nodiscard]] std::string pictureName(std::size_t index) const {
        const std::string& file = evidence_.scan.pictures[index].file;
        return fmt::format("picture {}{}", index + 1, file.empty() ? "" : " (" + file + ")");
    }
    void report(const char* cause, std::string advice, bool refuses = true) {
        const auto same = [&](const ScanFault& fault) { return fault.advice == advice; };
        if (std::ranges::none_of(faults_, same))
            faults_.push_back({cause, std::move(advice), refuses});
    }

    [[nodiscard]] bool refused() const { return std::ranges::any_of(faults_, &ScanFault::refuses); }
    template <class Look>
    void forSeen(const Look& look) {
        for (std::size_t c = 0; c < channels_.size(); ++c)
            if (isSeen(c)) look(c);
    }

    // Channels: what is seen of them.

    [[nodiscard]] SmallChannel smallOf(std::size_t c) {
        SmallChannel small;
        seen_.emplace_back(static_cast<std::size_t>(kGrid.x * kGrid.y));
        seenShare_.push_back(0);
        if (!isScanned(c)) return small;
        markSeen(c);
        small.light =
            evidence_.small.shrunk(evidence_.view.channels[c].light, evidence_.view.sizePixels.x);
        Plane sorted = small.light;
        const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 49 / 50);
        std::nth_element(sorted.begin(), at, sorted.end());
        small.most = *at;
        if (evidence_.channels[c].isTagged) findCells(c, small);
        return small;
    }
    void markSeen(std::size_t c) {
        const glm::vec2 scale = glm::vec2(kGrid) / glm::vec2(evidence_.rig.channels[c].sizePixels);
        for (const glm::vec2 place : evidence_.view.channels[c].place) {
            if (!(place.x == place.x)) continue;
            const glm::ivec2 cell = glm::clamp(glm::ivec2(place * scale), glm::ivec2(0), kGrid - 1);
            seen_[c][static_cast<std::size_t>(cell.y * kGrid.x + cell.x)] = 1;
        }
        const auto seen = std::ranges::count(seen_[c], 1);
        seenShare_[c] = static_cast<float>(seen) / static_cast<float>(kGrid.x * kGrid.y);
    }

    // Where the small copies show the cells of a tag.
    void findCells(std::size_t c, SmallChannel& small) const {
        const auto map = TagMap::of(evidence_.view.channels[c],
                                    evidence_.view.sizePixels,
                                    evidence_.rig.channels[c].sizePixels);
        if (!map) return;
        const int factor = evidence_.small.factor;
        const glm::ivec2 size = evidence_.small.sizePixels;
        small.cells.assign(small.light.size(), kBeside);
        const glm::ivec2 first = map->low() / factor,
                         last = glm::min(map->high() / factor, size - 1);
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const glm::dvec2 middle = glm::dvec2(x, y) * double(factor) + 0.5 * (factor - 1);
                small.cells[static_cast<std::size_t>(y * size.x + x)] =
                    cellIndex(map->cellAt(middle));
            }
        small.hasTag = true;
        for (int cell = 0; cell < wall::kScanTagCells; ++cell)
            small.hasTag &= std::ranges::count(small.cells, cell) > 0;
    }
    static constexpr int kBeside = -1, kEdge = -2;
    // The inner part of a cell; its edge is mixed with others'.
    [[nodiscard]] static int cellIndex(glm::dvec2 cell) {
        constexpr double kInner = 0.3, kMargin = 1;
        const glm::dvec2 cells(wall::kScanTagCells, 1);
        if (glm::any(glm::greaterThan(glm::abs(cell - 0.5 * cells), 0.5 * cells + kMargin)))
            return kBeside;
        const glm::dvec2 within = glm::floor(cell);
        const bool isInner =
            glm::all(glm::lessThan(glm::abs(cell - within - 0.5), glm::dvec2(kInner)));
        const bool isCell = within.y == 0 && within.x >= 0 && within.x < cells.x;
        return isInner && isCell ? static_cast<int>(within.x) : kEdge;
    }

    // Faults of the exposure and of single channels.

    void findExposure() {
        float most = 0;
        for (const SmallChannel& small : channels_) most = std::max(most, small.most);
        if (most < kLeastLight)
            return report(
                "under_exposed",
                fmt::format("white is only {:.1f} % of the camera's range: open the aperture, "
                            "or choose a longer exposure where the camera has its own, and scan "
                            "again",
                            100 * static_cast<double>(most)));
        for (std::size_t c = 0; c < channels_.size(); ++c)
            if (isScanned(c)) findClipped(c);
    }

    void findClipped(std::size_t c) {
        constexpr double kMostClipped = 0.01;
        const ChannelNotes& notes = evidence_.channels[c];
        if (notes.clipped > kMostClipped)
            report("over_exposed",
                   fmt::format(
                       "white of channel \"{}\" is too bright in {:.0f} % of its pixels: close "
                       "the aperture, or choose a shorter exposure where the camera has its own, "
                       "and scan again",
                       nameOf(c),
                       100 * notes.clipped),
                   notes.hasPhase);
    }

    void findUnseen() {
        if (refused()) return;
        for (std::size_t c = 0; c < channels_.size(); ++c)
            if (isScanned(c) && !isSeen(c)) reportUnseen(c);
    }
    // No places: too dark for its noise, or not there.
    void reportUnseen(std::size_t c) {
        constexpr double kLeastSignal = 12;
        const double most = double{channels_[c].most};
        if (most > double{kLeastLight} && most < kLeastSignal * evidence_.view.noise)
            return reportFaint(c);
        report("channel_not_seen",
               fmt::format(
                   "the camera does not see channel \"{}\": switch its projector on, check its "
                   "cable, clear the camera's view, and scan again",
                   nameOf(c)));
    }
    void reportFaint(std::size_t c) {
        report("under_exposed",
               fmt::format("patterns of channel \"{}\" are faint in the camera's noise: darken the "
                           "room, focus the camera, open its aperture, and scan again",
                           nameOf(c)));
    }

    void findNoise(std::size_t c) {
        constexpr float kMostSigma = 1.5F;
        Plane sigmas;
        for (const glm::vec2 sigma : evidence_.view.channels[c].sigma)
            if (sigma.x == sigma.x) sigmas.push_back(std::max(sigma.x, sigma.y));
        if (sigmas.empty()) return;
        const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
        std::nth_element(sigmas.begin(), middle, sigmas.end());
        if (*middle > kMostSigma) reportFaint(c);
    }

    // Cells of its picture that fall on the screen, by the rig, and are not seen.
    void findBlocked(std::size_t c) {
        constexpr double kRefused = 0.25, kWarned = 0.1;
        const wall::Wall wall(evidence_.rig);
        const glm::dvec2 cell =
            glm::dvec2(evidence_.rig.channels[c].sizePixels) / glm::dvec2(kGrid);
        int expected = 0, unseen = 0;
        for (int y = 0; y < kGrid.y; ++y)
            for (int x = 0; x < kGrid.x; ++x) {
                if (!wall.channel(c).pointOf((glm::dvec2(x, y) + 0.5) * cell, 0)) continue;
                ++expected;
                unseen += seen_[c][static_cast<std::size_t>(y * kGrid.x + x)] == 0 ? 1 : 0;
            }
        const double share = static_cast<double>(unseen) / std::max(1, expected);
        if (share < kWarned) return;
        // Another camera may see the rest.
        report("blocked",
               fmt::format(
                   "{:.0f} % of channel \"{}\" is not seen: clear the view of the camera and of "
                   "the projector, or move the camera back, and scan again",
                   100 * share,
                   nameOf(c)),
               share > kRefused && evidence_.scan.cameras.size() == 1);
    }

    void findMoved(std::size_t c) {
        constexpr double kMostShift = 0.7;
        const ChannelNotes& notes = evidence_.channels[c];
        if (std::abs(notes.shift) > kMostShift)
            return reportMoved(c, notes.shift, "about", notes.shiftedPicture);
        double most = 0;
        std::size_t where = 0;
        for (const SmallPicture& small : evidence_.small.pictures)
            if (const auto moved = movedSinceWhite(c, small); moved && *moved > most) {
                most = *moved;
                where = small.index;
            }
        if (most > kMostShift) reportMoved(c, most, "between its white and", where);
    }
    void reportMoved(std::size_t c, double pixels, const char* when, std::size_t picture) {
        report("moved",
               fmt::format(
                   "channel \"{}\" or the camera has moved by {:.1f} px {} {}: fasten both and "
                   "scan again",
                   nameOf(c),
                   std::abs(pixels),
                   when,
                   pictureName(picture)));
    }
    // How far an even level of light lies from the channel's white, in its pixels.
    [[nodiscard]] std::optional<double> movedSinceWhite(std::size_t c,
                                                        const SmallPicture& picture) const {
        constexpr float kLeastLevel = 0.3F;
        const ScanPattern& pattern = evidence_.scan.pictures[picture.index].pattern;
        // Not of shorter exposures: a bent response of the camera looks like a movement in them.
        const bool isLevel =
            pattern.kind == Kind::Level && pattern.step == 0 && weightOf(pattern, c) > kLeastLevel;
        if (!isLevel || (channels_[c].cells.empty() && evidence_.channels[c].isTagged))
            return std::nullopt;
        const auto found = differenceFrom(c, picture, pattern.lit).solve();
        if (!found || (*found)[0] <= 0) return std::nullopt;
        const double moved = std::hypot((*found)[1], (*found)[2]) / (*found)[0];
        return moved * evidence_.small.factor * double{evidence_.channels[c].step};
    }
    // By the white's light and its gradient: what differs is the gradient times the movement, and
    // what other channels throw here by way of the screen.
    [[nodiscard]] LeastSquares<4> differenceFrom(std::size_t c,
                                                 const SmallPicture& picture,
                                                 std::uint64_t lit) const {
        LeastSquares<4> fit;
        fit.add({0, 0, 0, 1e-3}, 0);  // where no other is lit
        const Plane& white = channels_[c].light;
        const std::uint64_t others = lit & ~(std::uint64_t{1} << c);
        const auto row = static_cast<std::size_t>(evidence_.small.sizePixels.x);
        for (std::size_t p = row; p + row < white.size(); ++p) {
            if (!isOnlyOf(c, lit, p)) continue;
            const double across = 0.5 * double{white[p + 1] - white[p - 1]};
            const double down = 0.5 * double{white[p + row] - white[p - row]};
            fit.add({double{white[p]}, across, down, double{lightAt(p, others)}},
                    double{picture.light[p] - (*black_)[p]});
        }
        return fit;
    }
    // About a pixel of small copies that no other channel lights, tag aside.
    [[nodiscard]] bool isOnlyOf(std::size_t c, std::uint64_t lit, std::size_t p) const {
        constexpr float kShare = 0.05F;
        const SmallChannel& channel = channels_[c];
        if (!channel.cells.empty() && channel.cells[p] != kBeside) return false;
        for (std::uint64_t left = lit & ~(std::uint64_t{1} << c); left != 0; left &= left - 1) {
            const SmallChannel& other = channels_[static_cast<std::size_t>(std::countr_zero(left))];
            if (!other.light.empty() && other.light[p] > kShare * other.most) return false;
        }
        return true;
    }

    // Pictures that show what the one before showed.
    void findRepeats() {
        std::vector<std::size_t> own;
        for (std::size_t i = 0; i < evidence_.scan.pictures.size(); ++i)
            if (evidence_.scan.pictures[i].camera == evidence_.camera) own.push_back(i);
        for (std::size_t i = 1; i < own.size(); ++i)
            if (isRepeated(own[i - 1], own[i]))
                report(
                    "dropped_frame",
                    fmt::format("{} shows what the picture before it shows: end other programs on "
                                "the nodes and here, and scan again; a program of your own must "
                                "wait longer after each pattern",
                                pictureName(own[i])));
    }
    [[nodiscard]] bool isRepeated(std::size_t before, std::size_t now) const {
        constexpr double kSame = 0.06;
        const ScanPattern& a = evidence_.scan.pictures[before].pattern;
        const ScanPattern& b = evidence_.scan.pictures[now].pattern;
        double changed = 0, light = 0;
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            if (channels_[c].most < kLeastLight || !mustDiffer(a, b, c)) continue;
            const auto [lit, apart] = differenceOf(c, before, now);
            changed += apart;
            light += lit * double{std::max(weightOf(a, c), weightOf(b, c))};
        }
        return light > 0 && changed < kSame * light;
    }
    // A channel's white in its brighter places, and what differs there between two pictures.
    [[nodiscard]] std::pair<double, double> differenceOf(std::size_t c,
                                                         std::size_t before,
                                                         std::size_t now) const {
        constexpr float kBright = 0.3F;
        const Plane& first = *evidence_.small.of(before);
        const Plane& second = *evidence_.small.of(now);
        double light = 0, apart = 0;
        for (std::size_t p = 0; p < first.size(); ++p) {
            if (channels_[c].light[p] < kBright * channels_[c].most) continue;
            apart += double{std::abs(second[p] - first[p])};
            light += double{channels_[c].light[p]};
        }
        return {light, apart};
    }
    [[nodiscard]] static float weightOf(const ScanPattern& pattern, std::size_t c) {
        return isLit(pattern, c) ? luminanceOf(pattern.light) : 0.0F;
    }
    [[nodiscard]] static bool mustDiffer(const ScanPattern& a,
                                         const ScanPattern& b,
                                         std::size_t c) {
        if (a.kind == Kind::Room || b.kind == Kind::Room || !(isLit(a, c) || isLit(b, c)))
            return false;
        if (isCode(a.kind) || isCode(b.kind)) return true;
        if (isColour(a) || isColour(b)) return false;  // a camera's own mix may make them alike
        return std::abs(weightOf(a, c) - weightOf(b, c)) > 0.2F;
    }

    // Tags that say another number than the picture's.
    void findLateChannels() {
        for (const SmallPicture& picture : evidence_.small.pictures) {
            const ScanPattern& pattern = evidence_.scan.pictures[picture.index].pattern;
            if (!pattern.tagged || pattern.number == 0) continue;
            for (std::size_t c = 0; c < channels_.size(); ++c)
                if (isLit(pattern, c) && channels_[c].hasTag) checkTag(c, picture, pattern.number);
        }
    }
    void checkTag(std::size_t c, const SmallPicture& picture, unsigned expected) {
        const auto number = tagOf(channels_[c], picture.light);
        if (!number || *number == expected || !isNear(*number, picture.index)) return;
        report("dropped_frame",
               fmt::format(
                   "channel \"{}\" shows pattern {} instead of {} in {}: end other programs "
                   "on its node and here, and scan again; a program of your own must wait longer "
                   "after each pattern",
                   nameOf(c),
                   *number,
                   expected,
                   pictureName(picture.index)));
    }
    // Whether a pattern with this number is shown about then: others are misread.
    [[nodiscard]] bool isNear(unsigned number, std::size_t index) const {
        constexpr std::size_t kReach = 6;
        const std::vector<config::ScanPicture>& pictures = evidence_.scan.pictures;
        const std::size_t last = std::min(pictures.size(), index + kReach + 1);
        for (std::size_t i = index - std::min(index, kReach); i < last; ++i)
            if (pictures[i].pattern.number == number) return true;
        return false;
    }
    using TagLight = std::array<double, wall::kScanTagCells>;
    [[nodiscard]] static TagLight lightOfCells(const SmallChannel& small, const Plane& light) {
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
    // Nothing where a cell is in doubt.
    [[nodiscard]] std::optional<unsigned> tagOf(const SmallChannel& small,
                                                const Plane& light) const {
        constexpr double kLeastContrast = 0.03, kLeastNoises = 5, kDoubt = 0.15;
        const TagLight cells = lightOfCells(small, light);
        const double contrast = cells[0] - cells[1], middle = 0.5 * (cells[0] + cells[1]);
        if (contrast <
            std::max(kLeastContrast * double{small.most}, kLeastNoises * evidence_.view.noise))
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

    // Light of the room: black again, and patterns that give half of the light on the whole.

    // Means of small copies over tiles, which are larger than the patterns' periods.
    static constexpr glm::ivec2 kTiles{12, 8};
    using Tiles = std::vector<double>;
    [[nodiscard]] Tiles tilesOf(const Plane& small) const {
        Tiles sums(static_cast<std::size_t>(kTiles.x * kTiles.y)), counts(sums.size());
        const glm::ivec2 size = evidence_.small.sizePixels;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const auto tile = static_cast<std::size_t>(y * kTiles.y / size.y * kTiles.x +
                                                           x * kTiles.x / size.x);
                sums[tile] += double{small[static_cast<std::size_t>(y * size.x + x)]};
                ++counts[tile];
            }
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= std::max(1.0, counts[i]);
        return sums;
    }
    [[nodiscard]] double mostLight() const {
        float most = 0;
        for (const SmallChannel& small : channels_) most = std::max(most, small.most);
        return double{std::max(most, 1e-6F)};
    }

    void findBlackDrift() {
        constexpr double kMostChange = 0.02;
        const Tiles first = tilesOf(*black_);
        for (const SmallPicture& picture : evidence_.small.pictures) {
            const ScanPattern& pattern = evidence_.scan.pictures[picture.index].pattern;
            if (pattern.kind != Kind::Level || pattern.lit != 0) continue;
            const Tiles now = tilesOf(picture.light);
            double most = 0;
            for (std::size_t i = 0; i < now.size(); ++i)
                most = std::max(most, std::abs(now[i] - first[i]));
            if (most > kMostChange * mostLight())
                reportLamp(pictureName(picture.index), most / mostLight());
        }
    }
    void reportLamp(const std::string& where, double share) {
        report(
            "ambient_light",
            fmt::format("light of the room has changed by {:.0f} % of white until {}: switch lamps "
                        "off, close doors and curtains, and scan again",
                        100 * share,
                        where));
    }

    // From afar a picture of phase looks like half of its channels' white, by the response about:
    // and all of them alike.
    void findLightDrift() {
        constexpr double kMostChange = 0.05, kMostOfWhite = 0.2;
        std::map<std::uint64_t, double> first;  // by the channels that are lit
        for (const SmallPicture& picture : evidence_.small.pictures) {
            const ScanPattern& pattern = evidence_.scan.pictures[picture.index].pattern;
            if (!isPhase(pattern.kind)) continue;
            const Drift drift = driftOf(picture, pattern.lit);
            const double before = first.emplace(pattern.lit, drift.gain).first->second;
            if (std::abs(drift.gain - 1) < kMostOfWhite &&
                std::abs(drift.gain / before - 1) < kMostChange)
                continue;
            if (drift.lamp > 0.5 * std::abs(drift.gain - 1))
                return reportLamp(pictureName(picture.index), drift.lamp);
            return report(
                "auto_exposure",
                fmt::format("{} is exposed {:.2f} times as much as white and black: fix the "
                            "camera's exposure, gain and white balance, and scan again",
                            pictureName(picture.index),
                            drift.gain));
        }
    }
    // How much more light there is than expected: in all, and where no channel gives any, both as a
    // share of what is expected of lit places.
    struct Drift {
        double gain = 1, lamp = 0;
    };
    [[nodiscard]] Drift driftOf(const SmallPicture& picture, std::uint64_t lit) const {
        constexpr float kUnlit = 0.1F;
        double seen = 0, expected = 0, count = 0, beside = 0, besideCount = 0;
        for (std::size_t p = 0; p < picture.light.size(); ++p) {
            const float half = 0.5F * lightAt(p, lit);
            const double more = double{picture.light[p] - (*black_)[p]};
            if (half < kUnlit * static_cast<float>(mostLight())) {
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
    // White of all of these channels.
    [[nodiscard]] float lightAt(std::size_t p, std::uint64_t lit) const {
        float light = 0;
        for (std::size_t c = 0; c < channels_.size(); ++c)
            if (((lit >> c) & 1U) != 0 && !channels_[c].light.empty())
                light += channels_[c].light[p];
        return light;
    }

    const Evidence& evidence_;
    const Plane* black_;
    std::vector<std::vector<std::uint8_t>> seen_;  // of each channel's cells
    Plane seenShare_;
    std::vector<SmallChannel> channels_;
    std::vector<ScanFault> faults_;
};

}  // namespace

std::vector<ScanFault> faultsOf(const Evidence& evidence) {
    return FaultFinder(evidence).find();
}

}  // namespace aquarama::scan
