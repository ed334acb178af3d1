// SPDX-License-Identifier: Apache-2.0
// The optics of a channel: map its pixels to points of the screen and back. Wall frame, metres.
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

// A projector as a pinhole with a lens, prepared for many pixels. Immutable.
class Lens {
  public:
    // Focal lengths must be positive, and the lens must not fold its picture.
    Lens(const config::Projector& projector, glm::ivec2 sizePixels);

    // The ray of a place in the picture (continuous, top left corner at (0, 0)). One unit along its
    // direction is one metre along the optical axis.
    [[nodiscard]] Ray ray(glm::dvec2 pixel) const;
    // The place in the picture that lights a point; nothing outside the picture and behind the
    // projector. Does not test whether the screen is in between.
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
    // The point of the screen that a pixel lights (continuous, top left corner at (0, 0), centres
    // at +0.5); nothing where its light passes the screen's edge by more than `spillMetres`.
    [[nodiscard]] virtual std::optional<glm::dvec3> pointOf(glm::dvec2 pixel,
                                                            double spillMetres) const = 0;
    // The inverse: nothing where the channel does not light this point of the screen.
    [[nodiscard]] virtual std::optional<glm::dvec2> pixelOf(glm::dvec3 point) const = 0;
    // The border of the lit area, as many points in no order, which enclose all of it. Empty where
    // the channel misses the screen.
    [[nodiscard]] virtual std::vector<glm::dvec3> outline(double spillMetres) const = 0;
    // The axes of a panel (x right, y up, z towards the audience), which needs no warp.
    [[nodiscard]] virtual std::optional<glm::dmat3> wallFromPanel() const { return std::nullopt; }
    // Blend and black of a wall file, for each pixel, top row first; empty where it has none.
    [[nodiscard]] virtual const std::vector<glm::vec3>& blend() const { return nothing(); }
    [[nodiscard]] virtual const std::vector<glm::vec3>& black() const { return nothing(); }
    // The colour of a wall file; null: the projector takes sRGB.
    [[nodiscard]] virtual const formats::ChannelColour* colour() const { return nullptr; }

  protected:
    // No points.
    [[nodiscard]] static const std::vector<glm::vec3>& nothing();
};

// The wall files of a rig by their names in it. Uneven meshes are resampled to the channel's
// pixels.
using WallFiles = std::map<std::string, formats::WallFile>;
// Throws Error where one cannot be read.
[[nodiscard]] WallFiles readWallFiles(const config::Rig& rig);

// The colour of each channel whose wall file has one. Throws Error as readWallFiles() and
// makeOptics().
[[nodiscard]] std::vector<std::optional<formats::ChannelColour>> coloursOf(const config::Rig& rig);

// Makes the optics of a channel. `screen` is the rig's and outlives them. Throws Error where a wall
// file lacks the region, or the warp that it needs.
[[nodiscard]] std::unique_ptr<const Optics> makeOptics(const config::Rig& rig,
                                                       std::size_t channel,
                                                       const ScreenSurface& screen,
                                                       const WallFiles& files);

// A part of makeOptics(), for a channel with a wall file. Its samples are converted to points of
// the screen: places of content lie on the unrolled screen, directions start at the sweet spot, and
// points are in the wall's frame.
[[nodiscard]] std::unique_ptr<const Optics> makeCalibratedOptics(const config::Rig& rig,
                                                                 std::size_t channel,
                                                                 const ScreenSurface& screen,
                                                                 const formats::WallFile& file);

// The optics, moved by the control points of this channel; unchanged without any. Throws Error with
// file:line:column where a point is not on the screen, or points fold the picture.
[[nodiscard]] std::unique_ptr<const Optics> adjusted(std::unique_ptr<const Optics> optics,
                                                     const config::Rig& rig,
                                                     std::size_t channel,
                                                     const ScreenSurface& screen,
                                                     const config::Adjustments& adjustments);

}  // namespace aquarama::wall
