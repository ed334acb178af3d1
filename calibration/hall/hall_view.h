// SPDX-License-Identifier: Apache-2.0
// The view of an eye in a simulated hall: screen and drape, lit by projectors and lamps. The rays
// are traced once for many pictures.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "calibration/hall/bounce.h"
#include "calibration/hall/thrown_light.h"
#include "calibration/hall/true_hall.h"
#include "common/base/picture.h"
#include "common/base/worker_pool.h"

namespace aquarama::hall {

// The lamps of a hall, as shares of their full light.
struct HallLamps {
    float dark = 1, room = 0, spot = 0;
};

// Keeps references to the hall and the pool. Takes some 30 bytes for each pixel and projector that
// lights it. In pictures wider than 1500 pixels every fourth ray is traced and the others are
// interpolated, exact to 0.005 pixels of a projector.
class HallView {
  public:
    HallView(const TrueHall& hall, const TrueLens& eye, WorkerPool& pool);

    // Linear light; 1 is a projector's white on a white screen. One picture for each channel.
    [[nodiscard]] Light of(const std::vector<ThrownPicture>& pictures,
                           const Light& bounced,
                           HallLamps lamps) const;
    // The brightest light of the white of these channels, without the brightest thousandth.
    [[nodiscard]] float brightestOf(std::uint64_t channels) const;

  private:
    // A pixel that a projector lights.
    struct Beam {
        glm::vec2 panelPixel{};
        float white = 0;  // the light of white that falls on the screen
        std::array<std::int16_t, 2> right{},
            down{};                // of panelPixel, to the next pixel of the view
        std::uint16_t column = 0;  // of the view
    };
    struct Row {
        std::vector<std::vector<Beam>> beams;  // of each channel
        std::vector<std::uint8_t> coverage;    // share of white screen, in 1 / kFullCoverage
        std::vector<float> room, spot;         // light of lamps; spot may be empty
        std::vector<glm::vec2> place;          // on the unrolled smooth screen
    };
    // Where a ray arrives.
    struct Arrival {
        glm::dvec3 point{}, normal{};
        glm::dvec2 place{};
        bool isThere = false;
        bool isWhite = false;  // screen, and no tape on it
    };
    [[nodiscard]] Arrival arrivalAt(glm::dvec2 pixel) const;
    [[nodiscard]] bool isWhite(glm::dvec2 pixel) const;
    [[nodiscard]] Arrival arrivalIn(const std::vector<Arrival>& grid, int x, int y) const;
    [[nodiscard]] Row rowOf(const std::vector<Arrival>& grid, int y) const;
    void add(const Arrival& arrival, int column, Row& row) const;
    void addBeam(const Arrival& arrival,
                 int column,
                 std::size_t channel,
                 std::vector<Beam>& beams) const;
    [[nodiscard]] std::vector<float> whiteOf(const Row& row, std::uint64_t channels) const;
    [[nodiscard]] std::vector<std::uint8_t> smoothed(int y) const;
    [[nodiscard]] float roomLight(const Arrival& arrival) const;
    [[nodiscard]] float spotLight(const Arrival& arrival) const;
    void setSteps(int y);
    static void setStepsRight(std::vector<Beam>& beams);
    // Sets the steps down from the beams of the row below, or of the row above.
    static void setStepsDown(std::vector<Beam>& beams,
                             const std::vector<Beam>& others,
                             bool areAbove);
    void light(const Row& row,
               const std::vector<ThrownPicture>& pictures,
               std::vector<glm::vec4>& sum) const;
    [[nodiscard]] float albedo(std::uint8_t coverage) const;

    static constexpr int kFullCoverage = 16;

    const TrueHall& hall_;
    TrueLens eye_;
    WorkerPool& pool_;
    glm::ivec2 size_;
    int step_ = 1;  // pixels between the rays that are followed
    int gridWidth_ = 0;
    double middleLight_ = 1;          // of the room's lamp at the middle of the screen
    std::optional<glm::dvec3> spot_;  // the middle of the light of the lamp that is switched on
    std::vector<Row> rows_;
};

// The eye of a camera without faults that looks at a point. `halfWidth`: the tangent of half its
// view.
[[nodiscard]] TrueLens eyeAt(glm::dvec3 position,
                             glm::dvec3 lookAt,
                             glm::ivec2 sizePixels,
                             double halfWidth);

// The view of an eye in the dark hall while the channels show these pictures.
[[nodiscard]] Light seen(const TrueHall& hall,
                         std::span<const Light> channels,
                         const TrueLens& eye);

// The true screen while the channels show some pictures. Keeps a reference to the hall.
class LitScreen {
  public:
    LitScreen(const TrueHall& hall, std::span<const Light> channels);
    // The light that the screen reflects at one of its points, or at a point of the smooth screen
    // under its bumps.
    [[nodiscard]] glm::vec3 at(glm::dvec3 point) const;
    // The true screen, unrolled; black where the panorama has no screen.
    [[nodiscard]] Light panorama(glm::ivec2 sizePixels) const;

  private:
    const TrueHall& hall_;
    std::vector<ThrownPicture> pictures_;
    Light bounced_;
};

}  // namespace aquarama::hall
