// SPDX-License-Identifier: Apache-2.0
// A camera that takes the pictures of a scan in a simulated hall, with the hall's faults.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "calibration/hall/bounce.h"
#include "calibration/hall/hall_view.h"
#include "calibration/hall/true_hall.h"
#include "calibration/scan/pictures.h"
#include "common/base/worker_pool.h"

namespace aquarama::hall {

// The same picture for the same hall, patterns, seed and index, in whatever order they are taken.
// Keeps a reference to the hall. For one thread; works with all processors.
class SimulatedCamera final : public scan::PictureSource {
  public:
    SimulatedCamera(const TrueHall& hall,
                    const std::vector<config::ScanPattern>& patterns,
                    std::uint32_t seed = 1);

    [[nodiscard]] const config::Scan& scan() const override { return scan_; }
    [[nodiscard]] Picture picture(std::size_t index) override;
    // The light that arrives at the camera, before blur, exposure and the noise of the sensor.
    [[nodiscard]] Light lightOf(std::size_t index) const;

    // A picture while the channels show these pictures, after the scan; exposed as the scan is.
    [[nodiscard]] Picture pictureOf(const std::vector<ThrownPicture>& pictures) const;

  private:
    // The state before a projector was moved.
    struct Earlier {
        Earlier(const TrueHall& now, WorkerPool& pool);
        TrueHall hall;
        Bounce bounce;
        HallView view;
    };
    void listPictures(const std::vector<config::ScanPattern>& patterns);
    [[nodiscard]] const config::ScanPattern& shownIn(std::size_t index) const;
    // Before the projector was moved.
    [[nodiscard]] bool isEarly(std::size_t index) const;
    [[nodiscard]] float gainFor(const Light& light) const;
    void hide(Light& light) const;
    void blur(Light& light) const;
    void dim(Light& light) const;
    // The stored picture of light that arrives. `index`: of the noise; `exposure`: as a share of
    // that of the scan.
    [[nodiscard]] Picture taken(Light light, std::uint32_t index, float exposure) const;
    [[nodiscard]] Picture counted(const Light& light, float gain, std::uint32_t seed) const;

    const TrueHall& hall_;
    config::Scan scan_;
    std::uint32_t seed_;
    mutable WorkerPool pool_;
    Bounce bounce_;
    HallView view_;
    std::unique_ptr<Earlier> earlier_;
    float gain_ = 1;
    std::vector<std::uint16_t> codes_;  // of light in equal steps
};

}  // namespace aquarama::hall
