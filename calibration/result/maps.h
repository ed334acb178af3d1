// SPDX-License-Identifier: Apache-2.0
// What a calibration does to a wall, over the unrolled screen as the sweet spot sees it: pictures
// and errors, in the solved hall or in the true one of a simulation.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "calibration/geometry/solved_hall.h"
#include "calibration/hall/drawn_wall.h"
#include "calibration/hall/true_hall.h"
#include "calibration/result/drawing.h"
#include "common/base/picture.h"

namespace aquarama::result {

// The places where the light of the channels falls. Wall frame; channels are indices in the rig.
// Immutable; for any thread.
class Fall {
  public:
    virtual ~Fall() = default;
    // The point of the screen that the sweet spot sees at a place of the panorama (0 to 1).
    [[nodiscard]] virtual std::optional<glm::dvec3> seenAt(glm::dvec2 place) const = 0;
    // The pixel of a channel that lights a point; nothing where it does not light the point.
    [[nodiscard]] virtual std::optional<glm::dvec2> pixelOf(std::size_t channel,
                                                            glm::dvec3 point) const = 0;
    // The light that the screen reflects there while this light is sent to the projector.
    [[nodiscard]] virtual glm::vec3 light(std::size_t channel,
                                          glm::dvec3 point,
                                          glm::vec3 sent) const = 0;
};
// By the solved hall; all projectors have one brightness. Keeps a reference.
[[nodiscard]] std::unique_ptr<Fall> fallOf(const geometry::SolvedHall& hall);
// By the truth, without the light that the screen reflects on itself. Keeps a reference.
[[nodiscard]] std::unique_ptr<Fall> fallOf(const hall::TrueHall& hall);

// The panorama that a viewer at the sweet spot sees. Uses all processors.
[[nodiscard]] Light seenPanorama(const Fall& fall,
                                 const hall::DrawnWall& wall,
                                 const hall::Content& content,
                                 glm::ivec2 sizePixels);

// Errors in panorama pixels: between channels that show one point, and of the worst channel from
// the right place.
struct ErrorMaps {
    Field neighbours, absolute;
};
// A pixel that no channel lights has no value; one that a single channel lights has none in
// `neighbours`.
[[nodiscard]] ErrorMaps errorMaps(const Fall& fall,
                                  const hall::DrawnWall& wall,
                                  glm::ivec2 panoramaPixels,
                                  glm::ivec2 sizePixels);

// The displacement of the screen towards the audience, in millimetres; no value without screen.
[[nodiscard]] Field displacementMap(const geometry::SolvedHall& hall, glm::ivec2 sizePixels);

// The shares of light of the channels, each in its channelColour().
[[nodiscard]] Light sharesOfLight(const hall::DrawnWall& wall, glm::ivec2 sizePixels);
// The shares of light along the middle row of the panorama: a curve for each channel.
[[nodiscard]] std::vector<std::vector<double>> shareProfile(const hall::DrawnWall& wall, int steps);
// The colour of a channel on the page: linear light; neighbours have very different hues.
[[nodiscard]] glm::vec3 channelColour(std::size_t channel);
// The border of a channel's picture on the unrolled screen (0 to 1), in pieces where its light
// misses the screen.
[[nodiscard]] std::vector<std::vector<glm::dvec2>> footprint(const wall::Wall& wall,
                                                             std::size_t channel,
                                                             glm::ivec2 channelPixels);

// The difference of a solved projector from the rig.
struct Hang {
    glm::dvec3 movedMetres{};    // right, up, back
    glm::dvec3 turnedRadians{};  // yaw, pitch, roll
    double focalShare = 0;       // of the focal length; positive: longer
    glm::dvec2 shiftPixels{};    // of the principal point: right, down
    double k1 = 0;
};
[[nodiscard]] Hang hangOf(const geometry::SolvedHall& hall, std::size_t channel);

}  // namespace aquarama::result
