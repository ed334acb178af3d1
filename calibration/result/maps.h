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

// Where light falls. Wall frame; channels are indices of the rig's. Immutable, for any thread.
class Fall {
  public:
    virtual ~Fall() = default;
    // The point of the screen that the sweet spot sees at a place of the panorama (0 to 1).
    [[nodiscard]] virtual std::optional<glm::dvec3> seenAt(glm::dvec2 place) const = 0;
    // Nothing where the channel does not light the point.
    [[nodiscard]] virtual std::optional<glm::dvec2> pixelOf(std::size_t channel,
                                                            glm::dvec3 point) const = 0;
    // What the screen sends back there of what is sent to the projector.
    [[nodiscard]] virtual glm::vec3 light(std::size_t channel,
                                          glm::dvec3 point,
                                          glm::vec3 sent) const = 0;
};
// As it was solved; every projector is as bright as the others. Keeps a reference.
[[nodiscard]] std::unique_ptr<Fall> fallOf(const geometry::SolvedHall& hall);
// As it is, without what parts of the screen throw on one another. Keeps a reference.
[[nodiscard]] std::unique_ptr<Fall> fallOf(const hall::TrueHall& hall);

// The panorama that the sweet spot sees of what nodes draw. Uses all processors.
[[nodiscard]] Light seenPanorama(const Fall& fall,
                                 const hall::DrawnWall& wall,
                                 const hall::Content& content,
                                 glm::ivec2 sizePixels);

// Errors in panorama pixels: between channels that show one point, and of the worst channel from
// what belongs there.
struct ErrorMaps {
    Field neighbours, absolute;
};
// A pixel that no channel lights has no value; one that a single channel lights has none in
// `neighbours`.
[[nodiscard]] ErrorMaps errorMaps(const Fall& fall,
                                  const hall::DrawnWall& wall,
                                  glm::ivec2 panoramaPixels,
                                  glm::ivec2 sizePixels);

// Towards the audience, millimetres; where the panorama shows screen.
[[nodiscard]] Field displacementMap(const geometry::SolvedHall& hall, glm::ivec2 sizePixels);

// Of the channels, by their shares of light, in a colour for each: channelColour().
[[nodiscard]] Light sharesOfLight(const hall::DrawnWall& wall, glm::ivec2 sizePixels);
// Along the middle row of the panorama: a curve for each channel.
[[nodiscard]] std::vector<std::vector<double>> shareProfile(const hall::DrawnWall& wall, int steps);
// Linear light; hues far from each other for neighbours.
[[nodiscard]] glm::vec3 channelColour(std::size_t channel);
// The borders of a channel's picture on the unrolled screen (0 to 1), in pieces where its light
// passes the screen.
[[nodiscard]] std::vector<std::vector<glm::dvec2>> footprint(const wall::Wall& wall,
                                                             std::size_t channel,
                                                             glm::ivec2 channelPixels);

// How a projector hangs in comparison with the rig.
struct Hang {
    glm::dvec3 movedMetres{};    // right, up, back
    glm::dvec3 turnedRadians{};  // yaw, pitch, roll
    double focalShare = 0;       // longer by so much
    glm::dvec2 shiftPixels{};    // of the principal point: right, down
    double k1 = 0;
};
[[nodiscard]] Hang hangOf(const geometry::SolvedHall& hall, std::size_t channel);

}  // namespace aquarama::result
