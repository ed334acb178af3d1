// SPDX-License-Identifier: Apache-2.0
// A look of the show that a node has built: the channel's picture of it, and the tier of quality
// that the node keeps up with.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "render_node/gl/context.h"
#include "render_node/gl/handle.h"
#include "render_node/session/session.h"
#include "render_node/show/channel_picture.h"
#include "render_node/show/preview.h"

namespace aquarama::show {

// A look that is ready to be drawn: the channel's picture of it, in a workspace of its own.
class BuiltLook {
  public:
    // Builds it on the calling thread and leaves its workspace current there. Without a prescribed
    // quality it measures which tier the node keeps up with. Throws Error: a channel that the rig
    // does not have or another size than the context's, a driver that cannot draw what is needed,
    // or that draws black.
    BuiltLook(gl::Context& context, const std::string& channel, session::Admission admission);
    // May be destroyed on another thread, while no thread has the workspace current.
    ~BuiltLook();
    BuiltLook(const BuiltLook&) = delete;
    BuiltLook& operator=(const BuiltLook&) = delete;

    // What it was built from.
    [[nodiscard]] const session::Admission& admission() const { return admission_; }
    // How its fish move: for the session, which alone uses it; null where patterns alone are drawn.
    [[nodiscard]] const std::shared_ptr<school::SchoolMotion>& motion() const { return motion_; }
    // Gives the same look another number, after the master was started again.
    void renumber(std::uint32_t look) { admission_.look = look; }
    [[nodiscard]] gl::Workspace& workspace() { return *workspace_; }
    [[nodiscard]] ChannelPicture& picture() { return *picture_; }
    [[nodiscard]] const std::shared_ptr<const wall::Wall>& wall() const { return wall_; }
    // The picture that is shown; that of one eye where the window shows both.
    [[nodiscard]] const gl::Target& target(Shown shown = Shown::Display) const {
        return shown == Shown::RightEye ? targets_.back() : targets_.front();
    }
    // For the operator's console; the workspace is current.
    [[nodiscard]] PictureReader& reader() { return *reader_; }
    // The finest tier that this node keeps up with.
    [[nodiscard]] config::QualityTier bears() const { return bears_; }
    // The renderer of OpenGL, for messages.
    [[nodiscard]] const std::string& renderer() const { return renderer_; }
    [[nodiscard]] config::QualityTier quality() const { return quality_; }  // of the picture
    // Builds the picture again where it is of another tier. The workspace is current.
    void bringTo(config::QualityTier quality);

  private:
    void chooseQuality();
    // Measured time of a frame without fish at this tier; builds the picture for it.
    [[nodiscard]] double secondsAFrame(config::QualityTier quality);
    // The world at noon without fish, or grey where there is none.
    void drawEmpty();
    // Draws as drawEmpty(). Throws Error where the picture is black although there is light: a
    // driver may accept all calls and draw nothing, and that must not count as a show. A driver
    // that executes nothing at all has no card, and is for tests.
    void requireLight();
    [[nodiscard]] bool isTargetBlack();

    session::Admission admission_;
    std::shared_ptr<school::SchoolMotion> motion_;
    std::size_t channel_;
    std::shared_ptr<const wall::Wall> wall_;  // of admission_.rig
    std::string renderer_;
    std::unique_ptr<gl::Workspace> workspace_;
    std::optional<ChannelPicture> picture_;
    std::deque<gl::Target> targets_;
    std::optional<PictureReader> reader_{std::in_place};
    // The tier of picture_.
    config::QualityTier quality_ = config::QualityTier::Low;
    config::QualityTier bears_ = config::QualityTier::Low;
};

// The tier of quality that a node keeps up with.

// Returns the seconds that a frame without fish takes at a tier.
using FrameCost = std::function<double(config::QualityTier)>;

// The finest tier whose frames take no more than the budget. It tries the tiers from the lowest and
// stops at the first that is too slow; the lowest is returned even when it is too slow itself.
[[nodiscard]] config::QualityTier finestWithin(double budgetSeconds, const FrameCost& cost);

// The share of the time between two refreshes that a frame without fish may take. The rest is for
// fish and events of a show, and a reserve.
inline constexpr double kBudgetShare = 0.5;

}  // namespace aquarama::show
