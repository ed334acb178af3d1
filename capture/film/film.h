// SPDX-License-Identifier: Apache-2.0
// A film of a simulated fish and its replica under one script: each alone, and the replica as a
// ghost over the fish. Each is seen from above and from the side; below, their distance and slip.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "capture/film/painted_fish.h"
#include "capture/report/compare.h"
#include "capture/report/script.h"
#include "common/base/picture.h"
#include "common/body/fish_body.h"

namespace aquarama::film {

inline constexpr glm::ivec2 kFilmPixels{1280, 720};
// Ticks of a player (1/60 s) for which a picture is shown.
inline constexpr int kTicksAPicture = 2;

// The angle between what a fish faces and its path, both over the half second about a tick;
// degrees. Empty where it is slower than 0.2 body lengths a second or backs, and where a trace has
// not half a second. What `study chronicle` measures, there over the half second before.
[[nodiscard]] std::optional<double> slipDegrees(const report::Trace& trace, std::size_t tick);

// Pictures of a film in any order. Immutable; several threads may draw at a time.
class Film {
  public:
    // What is shown. The replica is never corrected: in the third band it is only moved and turned,
    // about the vertical, to the fish at the start of each command.
    struct Shown {
        body::FishBody body;
        PaintedSkin skin;
        report::Script script;
        report::Trace fish, replica;  // traceFish(), traceReplica() of this script
    };
    explicit Film(Shown shown);
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    // Fast starts are shown at a quarter of their speed.
    [[nodiscard]] std::size_t pictures() const { return ticks_.size(); }
    // kFilmPixels, 8 bits.
    [[nodiscard]] Picture picture(std::size_t number) const;

  private:
    // Where the cameras of a fish are at each tick.
    struct Track {
        std::vector<glm::vec3> centre;
        std::vector<float> heading;  // radians, left positive
    };
    static Track trackOf(const report::Trace& trace);
    void listTicks();
    [[nodiscard]] const report::Overlay& overlayAt(std::size_t tick) const;
    [[nodiscard]] FarView viewOf(const Track& track, std::size_t tick, bool isFromAbove) const;
    void drawBand(Light& picture,
                  int band,
                  std::size_t tick,
                  const PosedSurface& surface,
                  const PosedSurface* ghost) const;
    void drawLabels(Light& picture, std::size_t number) const;
    void drawCurves(Light& picture, std::size_t number) const;

    Shown shown_;
    std::vector<std::size_t> ticks_;         // of each picture, an index of the traces
    std::vector<std::size_t> commands_;      // of each tick, an index of the script
    std::vector<report::Overlay> overlays_;  // of each command
    Track fishTrack_, replicaTrack_;
    // At each tick: body lengths between the origins; slip.
    std::vector<double> distance_;
    std::vector<std::optional<double>> fishSlip_, replicaSlip_;
    float sidePixels_ = 0;  // a body length from the side
};

}  // namespace aquarama::film
