// SPDX-License-Identifier: Apache-2.0
// What shows a channel: from its pixels to points of the screen and back. Wall frame, metres.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/adjustments.h"
#include "common/config/rig.h"
#include "common/formats/wall_file.h"
#include "common/wall/surface.h"

namespace aquarama::wall {

// A projector as a pinhole with a lens, with its rotation computed once, for many pixels.
// Immutable.
class Lens {
  public:
    // Focal lengths must be positive, and the lens must not fold its picture.
    Lens(const config::Projector& projector, glm::ivec2 sizePixels);

    // The light of a place in the picture (continuous, top left corner at (0, 0)). One unit along
    // the direction is one metre along the optical axis.
    [[nodiscard]] Ray ray(glm::dvec2 pixel) const;
    // The place in the picture that lights a point; nothing where that is outside of the picture or
    // behind the projector. Does not ask whether the screen is in between.
    [[nodiscard]] std::optional<glm::dvec2> pixelOf(glm::dvec3 point) const;
    [[nodiscard]] glm::dvec3 position() const { return position_; }

  private:
    // Projector frame: x right, y up, looking along -z. Focal lengths, principal point and size in
    // pixels.
    glm::dmat3 wallFromProjector_;
    glm::dvec3 position_;
    glm::dvec2 focal_, principal_, size_;
    BrownLens<double> distortion_;
    double farthestSquared_ = 0;  // the greatest squared tangent whose image is in the picture
};

// A projector, a panel, or a projector that another program has calibrated. Immutable.
class Optics {
  public:
    virtual ~Optics() = default;
    // Where a pixel (continuous, top left corner of the picture is (0, 0), texel centres at +0.5)
    // lights the screen; nothing where its light passes the screen by more than `spillMetres`.
    [[nodiscard]] virtual std::optional<glm::dvec3> pointOf(glm::dvec2 pixel,
                                                            double spillMetres) const = 0;
    // The inverse: nothing where the channel does not light this point of the screen.
    [[nodiscard]] virtual std::optional<glm::dvec2> pixelOf(glm::dvec3 point) const = 0;
    // The border of what it lights, as a dense set of points in no order. Together they enclose all
    // that is lit. Empty where it misses the screen.
    [[nodiscard]] virtual std::vector<glm::dvec3> outline(double spillMetres) const = 0;
    // Of a panel, which needs no warp: its axes, x right, y up, z towards the audience.
    [[nodiscard]] virtual std::optional<glm::dmat3> wallFromPanel() const { return std::nullopt; }
    // Of a wall file that has them, for each pixel, top row first; else empty.
    [[nodiscard]] virtual const std::vector<glm::vec3>& blend() const { return nothing(); }
    [[nodiscard]] virtual const std::vector<glm::vec3>& black() const { return nothing(); }
    // Of a wall file that has one; null: the projector takes sRGB.
    [[nodiscard]] virtual const formats::ChannelColour* colour() const { return nullptr; }

  protected:
    [[nodiscard]] static const std::vector<glm::vec3>& nothing();
};

// The wall files of a rig as they were read, by their name in the rig; uneven meshes were brought
// to the pixels of the channel.
using WallFiles = std::map<std::string, formats::WallFile>;
// Throws Error where one cannot be read.
[[nodiscard]] WallFiles readWallFiles(const config::Rig& rig);

// Of each channel, where its wall file has one. Throws Error as readWallFiles() and makeOptics()
// do.
[[nodiscard]] std::vector<std::optional<formats::ChannelColour>> coloursOf(const config::Rig& rig);

// `screen` is rig's and outlives the optics. Throws Error where a wall file cannot be used: has no
// such region, or no warp where it needs one.
[[nodiscard]] std::unique_ptr<const Optics> makeOptics(const config::Rig& rig,
                                                       std::size_t channel,
                                                       const ScreenSurface& screen,
                                                       const WallFiles& files);

// Of a channel with a wall file: a part of makeOptics(). What its samples mean is brought to points
// of the screen: places of content lie on the unrolled screen, directions start at the sweet spot,
// points are in the wall's frame.
[[nodiscard]] std::unique_ptr<const Optics> makeCalibratedOptics(const config::Rig& rig,
                                                                 std::size_t channel,
                                                                 const ScreenSurface& screen,
                                                                 const formats::WallFile& file);

// The optics with the control points of this channel on top; the same optics where it has none.
// Throws Error with file:line:column where a point does not lie on the screen, or points fold the
// picture.
[[nodiscard]] std::unique_ptr<const Optics> adjusted(std::unique_ptr<const Optics> optics,
                                                     const config::Rig& rig,
                                                     std::size_t channel,
                                                     const ScreenSurface& screen,
                                                     const config::Adjustments& adjustments);

}  // namespace aquarama::wall
