// SPDX-License-Identifier: Apache-2.0
// The plain reference of light in the sea: a backward Monte Carlo of homogeneous water under a flat
// surface, with sun and sky above it. Nothing is approximated but the sun, whose rays the waves
// spread. Lengths are optical: in units of 1/c, so that one run serves every water whose albedo b/c
// is the same. Radiances are relative to an irradiance of 1 just below the surface.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace aquarama::test {

// Fournier and Forand 1994 in its latest form, n = 1.10, mu = 3.5835: the particles of Mobley,
// Sundman and Boss 2002, of whose scattering 1.8 % goes back and half within 4 degrees.
class ForwardPhase {
  public:
    // What is scattered by less than the peak counts as not scattered: of an albedo w the share
    // peakShare() then belongs to the light that goes straight on. 0 is the plain truth; some
    // degrees change little and quiet the noise by an order.
    explicit ForwardPhase(double peakRadians = 0);
    [[nodiscard]] double peakShare() const { return peakShare_; }
    [[nodiscard]] double angleAt(double share) const;      // within it goes this share of all
    [[nodiscard]] double towardsSun(double cosine) const;  // 1/sr, of a sun of 6 degrees
    [[nodiscard]] double shareWithin(double radians) const;

  private:
    double peakShare_ = 0;
    std::vector<double> angles_, shares_;  // of the cumulated phase function
    std::vector<double> angleOfShare_, sun_;
};

// A ray from an eye, to a small black disc that faces it: a tenth of the range in radius, as a fish
// or a stone is.
struct SeenWater {
    double albedo = 0.5;  // b / c
    double depth = 1;     // of the eye
    glm::dvec3 direction{0, 0, -1};
    double range = 1;  // to the disc; ends at the surface
};

struct Estimate {
    double mean = 0, deviation = 0;  // of the mean
};

// Light scattered into the ray before the disc.
[[nodiscard]] Estimate scatteredIn(const ForwardPhase& phase,
                                   const SeenWater& seen,
                                   glm::dvec3 towardsSun,
                                   int paths,
                                   std::uint64_t seed);
// Light of a matte, glowing disc of radiance 1 that arrives, straight or by small angles; its
// radius in parts of the range.
[[nodiscard]] Estimate transmitted(const ForwardPhase& phase,
                                   double albedo,
                                   double range,
                                   double radius,
                                   int paths,
                                   std::uint64_t seed);
// Downwelling irradiance.
[[nodiscard]] Estimate irradiance(const ForwardPhase& phase,
                                  double albedo,
                                  double depth,
                                  glm::dvec3 towardsSun,
                                  int paths,
                                  std::uint64_t seed);

}  // namespace aquarama::test
