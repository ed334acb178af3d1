// SPDX-License-Identifier: Apache-2.0
#include "calibration/light/foresight.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "calibration/light/level_samples.h"
#include "calibration/light/seams.h"

namespace aquarama::light {

namespace {

// The result of the finished masks for even light, where the camera saw each channel's white.
class Foresight {
  public:
    Foresight(const LevelSamples& levels,
              const std::vector<ChannelLight>& lights,
              const formats::WallFile& file)
        : levels_{levels}, lights_{lights}, file_{file} {
        for (std::size_t c = 0; c < lights.size(); ++c) {
            medians_.push_back(lights[c].white.at({0.5, 0.5}));
            blends_.emplace_back(*file.channels[c].blend);
            blacks_.emplace_back(*file.channels[c].black);
        }
    }
    [[nodiscard]] double worst(double grey) const {
        const glm::ivec2 size = levels_.black().sizePixels;
        double worst = 0;
        for (const int axis : {0, 1})
            for (const double band : kBands)
                worst =
                    std::max(worst, seamOf(profile(axis, firstOfBand(band, size[1 - axis]), grey)));
        return worst;
    }

  private:
    // The luminance that will be seen, the one that the masks intend, and the number of channels.
    struct Seen {
        double seen = 0, meant = 0;
        int channels = 0;
    };
    // Nothing beside the screen, and where the place in a picture is not known.
    [[nodiscard]] std::optional<Seen> at(std::size_t index, double grey) const {
        // Shares of a channel's white: outside its picture, and past the screen's edge.
        constexpr double kUnlit = 0.2, kScreen = 0.7;
        Seen seen;
        for (std::size_t c = 0; c < lights_.size(); ++c) {
            const double white = luminance(levels_.white(c, index));
            const glm::dvec2 place = levels_.place(c, index);
            const bool isHere = !std::isnan(place.x + place.y);
            if (std::isnan(white) || (!isHere && white > kUnlit * medians_[c])) return std::nullopt;
            if (!isHere) continue;
            const double meant =
                lights_[c].white.at(place / glm::dvec2(file_.channels[c].sizePixels));
            if (white < kScreen * meant) return std::nullopt;
            const double share = shareOf(c, place, grey);
            seen.seen += white * share;
            seen.meant += meant * share;
            ++seen.channels;
        }
        return seen.channels > 0 ? std::optional(seen) : std::nullopt;
    }
    // Of a channel's white.
    [[nodiscard]] double shareOf(std::size_t c, glm::dvec2 place, double grey) const {
        const formats::FileChannel& channel = file_.channels[c];
        const glm::dvec2 at = place / glm::dvec2(channel.sizePixels);
        const double lift = double(blacks_[c].at(at).x);
        const double light = grey * double(blends_[c].at(at).x) * (1 - lift) + lift;
        const glm::dvec3 own = glm::dmat3(channel.colour->mix) * glm::dvec3(light);
        return luminance(lights_[c].primaries * own) + lights_[c].black;
    }
    [[nodiscard]] std::vector<ProfilePoint> profile(int axis, int first, double grey) const {
        const glm::ivec2 size = levels_.black().sizePixels;
        std::vector<ProfilePoint> points;
        for (int i = 0; i < size[axis]; ++i) {
            ProfilePoint point;
            int count = 0;
            for (int j = 0; j < kBandWidth; ++j) {
                glm::ivec2 sample(i);
                sample[1 - axis] = first + j;
                const auto seen = at(static_cast<std::size_t>(sample.y * size.x + sample.x), grey);
                if (!seen) continue;
                point.luminance += seen->seen / seen->meant;
                point.isShared |= seen->channels > 1;
                ++count;
            }
            if (count < kBandWidth) continue;
            point.luminance /= count;
            points.push_back(point);
        }
        // Leaves out the edges of the screen, where samples are only partly on it.
        const auto edge = static_cast<std::ptrdiff_t>(points.size() / 30 + 2);
        if (points.size() < 20) return {};
        return {points.begin() + edge, points.end() - edge};
    }

    const LevelSamples& levels_;
    const std::vector<ChannelLight>& lights_;
    const formats::WallFile& file_;
    std::vector<double> medians_;
    std::vector<formats::MaskLight> blends_, blacks_;
};

}  // namespace

ForeseenSeams foreseenSeams(const std::vector<ChannelLight>& lights,
                            const formats::WallFile& file,
                            scan::CameraView seen) {
    const scan::CameraView view = linearised(std::move(seen));
    const LevelSamples levels(view);
    const Foresight foresight(levels, lights, file);
    return {foresight.worst(0.02), foresight.worst(0.18), foresight.worst(1)};
}

}  // namespace aquarama::light
