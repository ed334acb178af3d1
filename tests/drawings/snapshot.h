// SPDX-License-Identifier: Apache-2.0
// A simulated photograph of a sheet: where the camera is, the lamps, shadows, creases, a thumb,
// blur, noise and JPEG.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "drawings/photo.h"
#include "tests/drawings/painted_sheet.h"

namespace aquarama::test {

// How a photograph is taken. Places on the sheet are in millimetres.
struct Circumstances {
    glm::ivec2 sizePixels{1200, 900};
    double tiltDegrees = 0, tiltTowardsDegrees = 0;  // of the camera from the sheet's normal
    double rollDegrees = 0;
    double filling = 0.9;  // of the picture by the sheet
    double aside = 0;      // of the picture's width that it lies too far to the right
    double kelvin = 5000;
    double adaptation = 0.5;       // of the camera's white to the lamp's, 0 to 1
    double exposure = 0.8;         // what the brightest paper's green becomes
    double unevenness = 0.2;       // how much darker the far side is
    glm::dvec2 lampTowards{1, 0};  // unit vectors, as all of these
    // A soft shadow on one side of a line.
    double shadow = 0, shadowEdge = 30, shadowAt = 0;
    glm::dvec2 shadowTowards{1, 0};
    double creaseHeight = 0, creaseWidth = 15, creaseAt = 0;
    glm::dvec2 creaseTowards{1, 0};
    std::optional<glm::dvec2> thumb{};  // its tip
    double blurPixels = 0.5;
    double noise = 0.01;
    int jpegQuality = 88;
    std::uint32_t seed = 0;
};

// Skew to 45 degrees, lamps of 2700 to 6500 K, from 0.5 megapixels; all of it drawn by the seed.
[[nodiscard]] Circumstances circumstancesOf(std::uint32_t seed, double mostMegapixels);

// Where the camera sees the places of a sheet.
class Camera {
  public:
    Camera(const Circumstances& how, glm::dvec2 paperMillimetres);
    // In pixels, of a place that a crease may have lifted.
    [[nodiscard]] glm::dvec2 photoAt(glm::dvec2 sheet) const;
    // The inverse.
    [[nodiscard]] glm::dvec2 sheetAt(glm::dvec2 pixel) const;
    // Height of the crease at a place, millimetres, and its slope across.
    [[nodiscard]] double heightAt(glm::dvec2 sheet) const;
    [[nodiscard]] double slopeAt(glm::dvec2 sheet) const;

  private:
    [[nodiscard]] glm::dvec2 projected(glm::dvec3 place) const;
    void aim(glm::dvec2 paperMillimetres);

    Circumstances how_;
    glm::dmat3 turn_{1.0};
    glm::dvec3 move_{0, 0, 1000};
    double focalPixels_ = 1;
    glm::dmat3 sheetFromPhoto_{1.0};
};

// The photograph as a camera keeps it.
[[nodiscard]] drawings::Photo photographed(const PaintedSheet& sheet,
                                           const Circumstances& how,
                                           const Camera& camera);

}  // namespace aquarama::test
