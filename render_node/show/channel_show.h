// SPDX-License-Identifier: Apache-2.0
// A line of times for each frame that was presented: frame,state_ns,ready_ns,present_ns.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/config/rig.h"
#include "common/motion/reconstruct.h"
#include "common/units/units.h"
#include "common/wall/frame_pipe.h"
#include "common/wire/messages.h"
#include "render_node/gl/context.h"
#include "render_node/gl/handle.h"
#include "render_node/light/scene.h"
#include "render_node/session/session.h"
#include "render_node/show/channel_picture.h"
#include "render_node/show/controls.h"
#include "render_node/show/run_node.h"

namespace aquarama::show {

// On CLOCK_MONOTONIC, which all processes of a machine share.
struct FrameTimes {
    std::chrono::nanoseconds state{};    // its state arrived
    std::chrono::nanoseconds ready{};    // its picture was finished
    std::chrono::nanoseconds present{};  // the swap had returned; without a display, the release
};

class Trace {
  public:
    // folder/name.csv, begun anew; an empty folder writes nothing. Throws Error where it cannot be
    // written.
    Trace(const std::string& folder, const std::string& name);
    void write(Frame frame, const FrameTimes& times);

  private:
    std::ofstream file_;
};

// The frames of one channel, from the master's state to light: the drawing thread of a node.

// Owns GL objects; construct, use and destroy with the context current.
class ChannelShow {
  public:
    ChannelShow(session::Session& session,
                gl::Context& context,
                Controls& controls,
                const NodeOptions& options);

    // From the first admission to the end of the show, through every time the master is lost and
    // found again; then the snapshot.
    void run(session::Admission admission);

  private:
    void build(session::Admission admission);
    void buildPicture(config::QualityTier quality);
    // What the wall is to be drawn at, or as fine as this node keeps up with.
    void chooseQuality();
    [[nodiscard]] double secondsAFrame(config::QualityTier quality);
    [[nodiscard]] session::Release play();
    void draw(const wire::StateFrame& frame);
    void project(const Overlays& overlays, Shown shown);
    void refuseLoss() const;
    void feed(const wire::Eye& eye);
    // Where in the picture a place of the window lies; where there is none, its middle.
    [[nodiscard]] std::optional<glm::vec2> pixelAt(const WindowPlace& place) const;
    [[nodiscard]] std::optional<WatchedMind> watchMind(const wire::StateFrame& frame);
    [[nodiscard]] bool isFilmed(Frame frame) const;
    [[nodiscard]] bool isSeen(Frame frame) const;

    session::Session& session_;
    gl::Context& context_;
    Controls& controls_;
    NodeOptions options_;
    Trace trace_;
    std::optional<wall::FramePipeWriter> film_;
    std::optional<session::Admission> built_;                 // what picture_ was built for
    config::QualityTier quality_ = config::QualityTier::Low;  // of picture_
    config::QualityTier bears_ =
        config::QualityTier::Low;  // the finest that this node keeps up with
    std::optional<Pointing> pointing_;
    std::optional<ChannelPicture> picture_;
    std::optional<gl::Target> offscreen_;   // where there is no window of the channel's size
    std::optional<std::uint32_t> watched_;  // the fish whose mind is shown
    std::chrono::nanoseconds askedAt_{};
    bool shown_ = false;
    std::optional<wire::StateFrame> undrawn_;  // the last frame, where nobody saw it
};

// A frame's food and clock as the scene takes them, and its fish for those who point at them.

// The school at the frame's moment. Records beyond the school that was welcomed are left out.
// It takes its time with all of them: the scene itself presents fish on the GPU.
[[nodiscard]] std::vector<motion::PresentedFish> presentedFish(
    const wire::StateFrame& frame, std::span<const motion::FishTraits> school);
// One of them by its place in the school, if there is such a one.
[[nodiscard]] std::optional<motion::PresentedFish> presentedFish(
    const wire::StateFrame& frame, std::span<const motion::FishTraits> school, std::size_t place);

// The food at the frame's moment: a particle that another takes the place of never glides to it.
void presentFood(const wire::StateFrame& frame, std::vector<scene::FoodParticle>& food);

// Since tick 0.
[[nodiscard]] double presentedSeconds(const wire::StateFrame& frame);

[[nodiscard]] glm::dmat4 wallFromWorld(const wire::Eye& eye);

// Which tier of quality a node keeps up with.

// Seconds that a frame takes at a tier, fish apart.
using FrameCost = std::function<double(config::QualityTier)>;

// Climbs from the lowest tier, which must do in any case, to the last whose frames take no more
// than the budget; beyond the first that takes more nothing is tried.
[[nodiscard]] config::QualityTier finestWithin(double budgetSeconds, const FrameCost& cost);

// The part of a refresh that a frame without fish may take: the other half is for the fish, for
// what a show brings, and for luck.
inline constexpr double kBudgetShare = 0.5;

}  // namespace aquarama::show
