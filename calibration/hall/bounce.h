// SPDX-License-Identifier: Apache-2.0
// The light that a concave screen reflects on itself: one bounce between coarse patches of the
// screen without its bumps.
#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "calibration/hall/thrown_light.h"
#include "calibration/hall/true_hall.h"
#include "common/base/picture.h"

namespace aquarama::hall {

// Keeps a reference to the hall.
class Bounce {
  public:
    explicit Bounce(const TrueHall& hall);

    // The light that falls on the unrolled screen while the channels project these pictures; read
    // it by bilinear(). An empty picture where the screen does not light itself.
    [[nodiscard]] Light of(const std::vector<ThrownPicture>& pictures) const;
    // The same while each patch reflects this light.
    [[nodiscard]] Light of(const std::vector<glm::vec3>& patches) const;
    [[nodiscard]] std::size_t patches() const { return shares_.empty() ? 0 : patches_.size(); }

  private:
    // A channel's light at a sample of a patch.
    struct Lit {
        std::size_t channel = 0;
        glm::vec2 panelPixel{};
        float white = 0;
    };
    // A cell of the unrolled screen.
    struct Patch {
        glm::dvec3 middle{}, normal{};
        struct Sample {
            glm::dvec3 point{}, normal{};
            double squareMetres = 0;
        };
        std::vector<Sample> samples;
        std::vector<Lit> lit;  // of all samples
    };
    [[nodiscard]] Patch patchAt(glm::ivec2 cell) const;
    // Adds the light that falls on one of `samples` samples of the patch.
    void light(Patch& patch, glm::dvec3 point, double samples) const;
    [[nodiscard]] float shareOf(const Patch& to, const Patch& from) const;
    [[nodiscard]] glm::vec3 sentBack(const Patch& patch,
                                     const std::vector<ThrownPicture>& pictures) const;

    const TrueHall& hall_;
    std::vector<Patch> patches_;
    std::vector<float> shares_;  // of a patch's light that another receives; rows are receivers
};

}  // namespace aquarama::hall
