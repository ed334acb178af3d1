// SPDX-License-Identifier: Apache-2.0
// The truth of a simulated hall: where each pixel of a channel falls, and how bright it is. Wall
// frame, metres; channels are indices in the rig.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "calibration/hall/true_lens.h"
#include "calibration/hall/true_screen.h"
#include "common/config/hall.h"
#include "common/config/rig.h"

namespace aquarama::hall {

// The hall after a scan: a projector that was moved during it is at its last place. A channel's
// picture is the one that its node draws, whichever projector its cable leads to. Immutable; for
// any thread.
class TrueHall {
  public:
    // Throws Error where the hall has other channels than the rig, or one of them is no projector.
    TrueHall(const config::Rig& rig, const config::Hall& hall);

    // Where a pixel (continuous) of the channel's picture lights the true screen; nothing where it
    // misses it.
    [[nodiscard]] std::optional<glm::dvec3> pointOf(std::size_t channel, glm::dvec2 pixel) const;
    // The inverse; nothing where the channel does not light the point.
    [[nodiscard]] std::optional<glm::dvec2> pixelOf(std::size_t channel, glm::dvec3 point) const;
    // The place in the panorama where a viewer at the sweet spot sees a point, as a share of its
    // width and height; NaN where the rig's screen is not in this direction.
    [[nodiscard]] glm::dvec2 unrolled(glm::dvec3 point) const;
    // Nothing where the camera does not see the point.
    [[nodiscard]] std::optional<glm::dvec2> cameraPixelOf(glm::dvec3 point) const;
    [[nodiscard]] std::optional<glm::dvec3> pointSeen(glm::dvec2 cameraPixel) const;
    // About `count` points, evenly over the true screen.
    [[nodiscard]] std::vector<glm::dvec3> screenPoints(std::size_t count) const;
    // Points along the true edges of the screen.
    [[nodiscard]] std::vector<glm::dvec3> outline() const { return screen_.border(); }
    // The light that the screen reflects of the full white of a channel, at a point that it lights.
    // A projector of brightness one gives the albedo in the middle of the planned picture.
    [[nodiscard]] double whiteAt(std::size_t channel, glm::dvec3 point) const;
    // The light of full white that falls on a surface there; the normal has length one.
    [[nodiscard]] double whiteOn(std::size_t channel, glm::dvec3 point, glm::dvec3 normal) const;

    // How many channels there are.
    [[nodiscard]] std::size_t channels() const { return cables_.size(); }
    // The projector that a channel's cable leads to.
    [[nodiscard]] std::size_t projectorOf(std::size_t channel) const {
        return cables_[channel].projector;
    }
    // From pixels of the channel's picture to those of the projector's panel, and back.
    [[nodiscard]] glm::dvec2 panelFrom(std::size_t channel, glm::dvec2 pixel) const;
    [[nodiscard]] glm::dvec2 pictureFrom(std::size_t channel, glm::dvec2 panelPixel) const;
    [[nodiscard]] const TrueLens& lens(std::size_t projector) const { return lenses_[projector]; }
    [[nodiscard]] const TrueLens& cameraLens() const { return camera_; }
    [[nodiscard]] const TrueScreen& screen() const { return screen_; }
    [[nodiscard]] const config::Rig& rig() const { return rig_; }
    [[nodiscard]] const config::Hall& hall() const { return hall_; }

  private:
    struct Cable {
        std::size_t projector = 0;
        glm::dvec2 scale{1};  // pixels of the panel for one of the picture
        glm::dvec2 corner{};  // of the picture on the panel
    };
    [[nodiscard]] Cable cableOf(std::size_t channel) const;

    config::Rig rig_;
    config::Hall hall_;
    std::shared_ptr<const wall::ScreenSurface> nominal_;
    TrueScreen screen_;
    std::vector<TrueLens> lenses_;
    std::vector<double> unitLight_;  // of each projector's lens, for a white of one
    TrueLens camera_;
    std::vector<Cable> cables_;
};

}  // namespace aquarama::hall
