// SPDX-License-Identifier: Apache-2.0
#include "calibration/result/maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <thread>
#include <utility>

#include <ceres/rotation.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "calibration/hall/thrown_light.h"
#include "calibration/hall/true_lens.h"
#include "common/base/worker_pool.h"

namespace aquarama::result {

namespace {

// The hall as the solve has it: fitted lenses, poses and screen. It knows no brightness, so light()
// returns what was sent.
class SolvedFall final : public Fall {
  public:
    explicit SolvedFall(const geometry::SolvedHall& hall) : hall_{hall} {}

    [[nodiscard]] std::optional<glm::dvec3> seenAt(glm::dvec2 place) const override {
        const auto nominal = hall_.nominal.screen().at(place);
        if (!nominal) return std::nullopt;
        const glm::dvec3 eye = hall_.rig.sweetSpotMetres;
        const auto seen = hall_.screen.hit({eye, *nominal - eye});
        return seen ? std::optional(seen->point) : std::nullopt;
    }
    [[nodiscard]] std::optional<glm::dvec2> pixelOf(std::size_t channel,
                                                    glm::dvec3 point) const override {
        const geometry::Device& projector = hall_.projectors[channel];
        const geometry::Three<double> at{point.x, point.y, point.z};
        const geometry::Three<double> seen = geometry::inFrame(projector.pose.data(), at);
        if (seen[2] <= 0) return std::nullopt;
        const glm::dvec2 tangent(seen[0] / seen[2], seen[1] / seen[2]);
        const geometry::Two<double> model =
            geometry::imaged(projector.lens.data(), geometry::Two<double>{tangent.x, tangent.y});
        const glm::dvec2 size(hall_.rig.channels[channel].sizePixels);
        const glm::dvec2 modelled(model[0], model[1]);
        // Far outside its picture a lens may fold: points there are not in the picture.
        constexpr double kSame = 1e-6;
        if (glm::distance(geometry::tangentOf(projector.lens, modelled).tangent, tangent) > kSame)
            return std::nullopt;
        glm::dvec2 pixel = modelled;  // the correction is that of the pixel itself
        for (int i = 0; i < 3; ++i) pixel = modelled + hall_.corrections[channel].at(pixel / size);
        const bool inside = glm::clamp(pixel, glm::dvec2(0), size) == pixel;
        return inside ? std::optional(pixel) : std::nullopt;
    }
    [[nodiscard]] glm::vec3 light(std::size_t /*channel*/,
                                  glm::dvec3 /*point*/,
                                  glm::vec3 sent) const override {
        return sent;
    }

  private:
    const geometry::SolvedHall& hall_;
};

// The hall as the simulation has it. Places of the panorama are those of the rig's own screen,
// without its displacement.
class TrueFall final : public Fall {
  public:
    explicit TrueFall(const hall::TrueHall& hall)
        : hall_{hall}, nominal_{wall::makeSurface(hall.rig())} {}

    [[nodiscard]] std::optional<glm::dvec3> seenAt(glm::dvec2 place) const override {
        const auto nominal = nominal_->at(place);
        if (!nominal) return std::nullopt;
        const glm::dvec3 eye = hall_.rig().sweetSpotMetres;
        return hall_.screen().hit({eye, *nominal - eye});
    }
    [[nodiscard]] std::optional<glm::dvec2> pixelOf(std::size_t channel,
                                                    glm::dvec3 point) const override {
        return hall_.pixelOf(channel, point);
    }
    [[nodiscard]] glm::vec3 light(std::size_t channel,
                                  glm::dvec3 point,
                                  glm::vec3 sent) const override {
        glm::vec3 code(0);
        for (int c = 0; c < 3; ++c)
            code[c] = static_cast<float>(srgbFromLinear(std::clamp(double(sent[c]), 0.0, 1.0)));
        const auto& projector = hall_.hall().projectors[hall_.projectorOf(channel)];
        return static_cast<float>(hall_.whiteAt(channel, point)) *
               hall::lightOfCode(projector, code);
    }

  private:
    const hall::TrueHall& hall_;
    std::unique_ptr<const wall::ScreenSurface> nominal_;
};

// Calls `work` with column, row and place (0 to 1) of each pixel; rows on all processors.
template <class Work>
void overPixels(glm::ivec2 sizePixels, const Work& work) {
    WorkerPool pool(std::thread::hardware_concurrency());
    pool.run(static_cast<std::size_t>(sizePixels.y), [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < sizePixels.x; ++x)
            work(x, y, (glm::dvec2(x, y) + 0.5) / glm::dvec2(sizePixels));
    });
}

}  // namespace

// The hall must outlive what is returned.
std::unique_ptr<Fall> fallOf(const geometry::SolvedHall& hall) {
    return std::make_unique<SolvedFall>(hall);
}
// The hall must outlive what is returned.
std::unique_ptr<Fall> fallOf(const hall::TrueHall& hall) {
    return std::make_unique<TrueFall>(hall);
}

// The light of all channels adds up. Each pixel is sampled once, at its centre.
Light seenPanorama(const Fall& fall,
                   const hall::DrawnWall& wall,
                   const hall::Content& content,
                   glm::ivec2 sizePixels) {
    Light seen = darkness(sizePixels);
    overPixels(sizePixels, [&](int x, int y, glm::dvec2 place) {
        const auto point = fall.seenAt(place);
        for (std::size_t i = 0; point && i < wall.wall().channels(); ++i)
            if (const auto pixel = fall.pixelOf(i, *point))
                seen.at(x, y) += fall.light(i, *point, wall.sent(i, *pixel, content));
    });
    return seen;
}

namespace {

// Where in the panorama, in its pixels, each channel shows what belongs to a point.
std::vector<glm::dvec2> shownPlaces(const Fall& fall,
                                    const hall::DrawnWall& wall,
                                    glm::dvec3 point,
                                    glm::ivec2 panoramaPixels) {
    std::vector<glm::dvec2> shown;
    for (std::size_t i = 0; i < wall.wall().channels(); ++i) {
        const auto pixel = fall.pixelOf(i, point);
        if (!pixel) continue;
        if (const auto lit = wall.wall().channel(i).pointOf(*pixel, wall::kSpillMetres))
            shown.push_back(wall.wall().screen().unrolled(*lit) * glm::dvec2(panoramaPixels));
    }
    return shown;
}

// Keeps the larger; the first replaces what is not a number.
void raise(double& value, double other) {
    if (std::isnan(value) || other > value) value = other;
}

}  // namespace

// Each row is one task and writes only its own pixels, so no lock is needed.
ErrorMaps errorMaps(const Fall& fall,
                    const hall::DrawnWall& wall,
                    glm::ivec2 panoramaPixels,
                    glm::ivec2 sizePixels) {
    ErrorMaps maps{emptyField(sizePixels), emptyField(sizePixels)};
    overPixels(sizePixels, [&](int x, int y, glm::dvec2 place) {
        const auto point = fall.seenAt(place);
        if (!point) return;
        const auto shown = shownPlaces(fall, wall, *point, panoramaPixels);
        for (std::size_t i = 0; i < shown.size(); ++i) {
            raise(maps.absolute.at(x, y),
                  glm::distance(shown[i], place * glm::dvec2(panoramaPixels)));
            for (std::size_t j = i + 1; j < shown.size(); ++j)
                raise(maps.neighbours.at(x, y), glm::distance(shown[i], shown[j]));
        }
    });
    return maps;
}

// The solve holds metres, the map millimetres.
Field displacementMap(const geometry::SolvedHall& hall, glm::ivec2 sizePixels) {
    constexpr double kMillimetres = 1000;
    Field field = emptyField(sizePixels);
    overPixels(sizePixels, [&](int x, int y, glm::dvec2 place) {
        if (hall.nominal.screen().at(place))
            field.at(x, y) = kMillimetres * hall.screen.displacement().at(place);
    });
    return field;
}

// Six colours: the seventh channel has the first one again.
glm::vec3 channelColour(std::size_t channel) {
    constexpr std::array<glm::vec3, 6> kColours{{{0.95F, 0.25F, 0.1F},
                                                 {0.05F, 0.45F, 0.95F},
                                                 {0.2F, 0.75F, 0.12F},
                                                 {0.85F, 0.6F, 0.03F},
                                                 {0.6F, 0.15F, 0.85F},
                                                 {0.05F, 0.7F, 0.65F}}};
    return kColours[channel % kColours.size()];
}

// Each channel's colour is weighted by its share of the light at the point.
Light sharesOfLight(const hall::DrawnWall& wall, glm::ivec2 sizePixels) {
    Light light = darkness(sizePixels);
    overPixels(sizePixels, [&](int x, int y, glm::dvec2 place) {
        const auto point = wall.wall().screen().at(place);
        for (std::size_t i = 0; point && i < wall.wall().channels(); ++i)
            light.at(x, y) += static_cast<float>(wall.wall().weight(i, *point)) * channelColour(i);
    });
    return light;
}

// The samples lie at the centres of equal steps; a step without screen counts as 0.
std::vector<std::vector<double>> shareProfile(const hall::DrawnWall& wall, int steps) {
    std::vector<std::vector<double>> profile(wall.wall().channels());
    for (int x = 0; x < steps; ++x) {
        const auto point = wall.wall().screen().at({(x + 0.5) / steps, 0.5});
        for (std::size_t i = 0; i < profile.size(); ++i)
            profile[i].push_back(point ? wall.wall().weight(i, *point) : 0);
    }
    return profile;
}

// Walks clockwise from the top left, through the centres of the outermost pixels. Pieces of a
// single point are dropped.
std::vector<std::vector<glm::dvec2>> footprint(const wall::Wall& wall,
                                               std::size_t channel,
                                               glm::ivec2 channelPixels) {
    constexpr int kSteps = 100;  // along each side
    constexpr std::array<glm::dvec2, 5> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};
    std::vector<std::vector<glm::dvec2>> pieces(1);
    for (int i = 0; i <= 4 * kSteps; ++i) {
        const auto side = static_cast<std::size_t>(std::min(i / kSteps, 3));
        const double along = static_cast<double>(i) / kSteps - static_cast<double>(side);
        const glm::dvec2 corner = glm::mix(kCorners[side], kCorners[side + 1], along);
        const glm::dvec2 pixel = 0.5 + corner * glm::dvec2(channelPixels - 1);
        const auto point = wall.channel(channel).pointOf(pixel, wall::kSpillMetres);
        if (point)
            pieces.back().push_back(wall.screen().unrolled(*point));
        else if (!pieces.back().empty())
            pieces.emplace_back();
    }
    std::erase_if(pieces, [](const auto& piece) { return piece.size() < 2; });
    return pieces;
}

namespace {

// Yaw, pitch and roll, radians. A pose's own frame has z ahead and y down; the flip of both gives
// the frame of the rig's angles.
glm::dvec3 anglesOf(const geometry::PoseParameters& pose) {
    glm::dmat3 ownFromWall;
    ceres::AngleAxisToRotationMatrix(pose.data(), &ownFromWall[0][0]);
    const glm::dmat3 flip(1, 0, 0, 0, -1, 0, 0, 0, -1);
    return hall::anglesOf(glm::transpose(flip * ownFromWall));
}

}  // namespace

// Differences of angles are brought into the range from -pi to pi.
Hang hangOf(const geometry::SolvedHall& hall, std::size_t channel) {
    namespace lens = geometry::lens;
    const config::Projector& rig = hall.rig.channels[channel].projector;
    const geometry::Device& found = hall.projectors[channel];
    Hang hang;
    hang.movedMetres = geometry::positionOf(found.pose) - rig.positionMetres;
    hang.turnedRadians = anglesOf(found.pose) - rig.yawPitchRollRadians;
    for (int i = 0; i < 3; ++i)
        hang.turnedRadians[i] = std::remainder(hang.turnedRadians[i], 2 * std::numbers::pi);
    hang.focalShare = found.lens[lens::Focal] / rig.focalPixels.x - 1;
    hang.shiftPixels =
        glm::dvec2(found.lens[lens::CentreX], found.lens[lens::CentreY]) - rig.principalPixels;
    hang.k1 = found.lens[lens::K1];
    return hang;
}

}  // namespace aquarama::result
