// SPDX-License-Identifier: Apache-2.0
// A camera in a simulated hall: takes the pictures of a scan.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "calibration/hall/true_hall.h"
#include "calibration/scan/pictures.h"
#include "common/base/picture.h"
#include "common/config/scan.h"

namespace aquarama::hall {

// What a camera sees of a hall, found once for many pictures: which light of which channels each
// of its pixels gets. Immutable. Some 100 bytes for each of its pixels.
class SeenHall {
  public:
    // Uses all processors. `hall` outlives it.
    explicit SeenHall(const TrueHall& hall);

    // Linear light of what the channels show (codes of a projector, 0 to 1, each picture of its
    // channel's size or one row or column of it), before the camera's lens dims it.
    [[nodiscard]] Light lit(const std::vector<Light>& codes) const;
    // Of lamps of the room, as bright as this on the screen.
    [[nodiscard]] Light lampLit(double light) const;

  private:
    // A channel's light at a pixel.
    struct Ray {
        std::uint32_t channel = 0;
        float white = 0;
        glm::vec2 place{};  // in the channel's picture
    };
    // A part of the screen, for the light that parts give one another.
    struct Patch {
        std::vector<Ray> rays;
        double share = 0;  // of the points that the rays are of
    };
    void findRays(std::size_t row, std::vector<std::vector<Ray>>& rows);
    void findPatches();
    [[nodiscard]] bool isMark(glm::dvec3 point) const;
    [[nodiscard]] glm::vec3 sum(const Ray* begin,
                                const Ray* end,
                                const std::vector<Light>& lights) const;
    [[nodiscard]] std::vector<glm::vec3> bounced(const std::vector<Light>& lights) const;

    const TrueHall& hall_;
    glm::ivec2 size_;
    std::vector<Ray> rays_;            // of all pixels, one after the other
    std::vector<std::size_t> first_;   // of each pixel, and the end
    std::vector<float> albedo_;        // of each pixel: of the screen, the drape, or between
    std::vector<glm::vec2> unrolled_;  // of each pixel; not a number beside the screen
    std::vector<Patch> patches_;
    std::vector<std::vector<float>> given_;  // the share of each patch's light that each other gets
};

// Pictures of the hall, each the same whenever it is asked for. Throws as TrueHall does.
class SimulatedCamera final : public scan::PictureSource {
  public:
    SimulatedCamera(const TrueHall& hall,
                    const std::vector<config::ScanPattern>& patterns,
                    std::uint32_t seed = 1);

    [[nodiscard]] const config::Scan& scan() const override { return scan_; }
    [[nodiscard]] Picture picture(std::size_t index) override;

  private:
    [[nodiscard]] Light arriving(std::size_t index) const;
    [[nodiscard]] double exposure() const;
    void addLamp(std::size_t index, Light& light) const;

    const TrueHall& hall_;
    std::uint32_t seed_;
    config::Scan scan_;
    std::unique_ptr<TrueHall> before_;  // before a projector was moved
    std::unique_ptr<SeenHall> seen_, seenBefore_;
    double gain_ = 1;  // from light to the most that the camera takes
};

}  // namespace aquarama::hall
