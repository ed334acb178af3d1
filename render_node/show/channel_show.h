// SPDX-License-Identifier: Apache-2.0
// The drawing thread of a node: the frames of one channel from the master's state to light, and a
// trace of their times.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/base/output_file.h"
#include "common/base/units.h"
#include "common/config/rig.h"
#include "common/machine/service_notifier.h"
#include "common/motion/reconstruct.h"
#include "common/net/channels.h"
#include "common/wire/state_codec.h"
#include "render_node/gl/context.h"
#include "render_node/gl/handle.h"
#include "render_node/scene/scene.h"
#include "render_node/session/session.h"
#include "render_node/show/channel_picture.h"
#include "render_node/show/controls.h"
#include "render_node/show/preview.h"
#include "render_node/show/run_node.h"

namespace aquarama::show {

// The times of one frame. On CLOCK_MONOTONIC, which all processes of a machine share.
struct FrameTimes {
    // When its state arrived.
    std::chrono::nanoseconds state{};
    // When its picture was finished.
    std::chrono::nanoseconds ready{};
    // When the swap had returned; without a display, when the frame was released.
    std::chrono::nanoseconds present{};
};

// Writes a line for each frame that was presented: frame,state_ns,ready_ns,present_ns.
class Trace {
  public:
    // Creates folder/name.csv, or empties it; an empty folder means that nothing is written. Throws
    // Error where it cannot be written.
    Trace(const std::string& folder, const std::string& name);
    // Appends a line, which a reader sees at once. A disk that is full ends the trace, not the
    // show.
    void write(Frame frame, const FrameTimes& times);
    // Throws Error where a line could not be written.
    void close() { file_.close(); }

  private:
    GrowingFile file_;
};

// A look that is ready to be drawn: the channel's picture of it, in a workspace of its own.
class BuiltLook {
  public:
    // Builds it on the calling thread and leaves its workspace current there. Without a prescribed
    // quality it measures with which the node keeps up. Throws Error: a channel that the rig does
    // not have or another size than the context's, a driver that cannot draw what is needed.
    BuiltLook(gl::Context& context, const std::string& channel, session::Admission admission);
    // May be on another thread, while no thread has the workspace current.
    ~BuiltLook();
    BuiltLook(const BuiltLook&) = delete;
    BuiltLook& operator=(const BuiltLook&) = delete;

    [[nodiscard]] const session::Admission& admission() const { return admission_; }
    // The same look under another number: the master was started again.
    void renumber(std::uint32_t look) { admission_.look = look; }
    [[nodiscard]] gl::Workspace& workspace() { return *workspace_; }
    [[nodiscard]] ChannelPicture& picture() { return *picture_; }
    [[nodiscard]] const std::shared_ptr<const wall::Wall>& wall() const { return wall_; }
    // What is shown, of one eye where the window shows both.
    [[nodiscard]] const gl::Target& target(Shown shown = Shown::Display) const {
        return shown == Shown::RightEye ? targets_.back() : targets_.front();
    }
    // For the operator's console; the workspace is current.
    [[nodiscard]] PictureReader& reader() { return *reader_; }
    // The finest tier that this node keeps up with.
    [[nodiscard]] config::QualityTier bears() const { return bears_; }
    // Of OpenGL, for people.
    [[nodiscard]] const std::string& renderer() const { return renderer_; }
    [[nodiscard]] config::QualityTier quality() const { return quality_; }  // of the picture
    // Makes the picture anew where it is of another tier. The workspace is current.
    void bringTo(config::QualityTier quality);

  private:
    void chooseQuality();
    // Measured time of a frame without fish at this tier; builds the picture for it.
    [[nodiscard]] double secondsAFrame(config::QualityTier quality);
    void drawEmpty();

    session::Admission admission_;
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

// The drawing loop.

// Runs on the drawing thread; construct, use and destroy it there. The next look is built on a
// thread of its own. Session, context, controls and service must outlive it.
class ChannelShow {
  public:
    ChannelShow(session::Session& session,
                gl::Context& context,
                Controls& controls,
                machine::ServiceNotifier& service,
                const NodeOptions& options);

    ~ChannelShow();
    ChannelShow(const ChannelShow&) = delete;
    ChannelShow& operator=(const ChannelShow&) = delete;

    // Runs from the first admission to the end of the show; whenever the master is lost it joins
    // again. Writes the snapshot at the end. Throws Error: a channel that the rig does not have, a
    // lost OpenGL context, a file that cannot be written.
    void run(session::Admission admission);

  private:
    // Draws the last state and writes the picture of it.
    void writePicture();
    // Prepares for a show; keeps everything where it is the same look as before.
    void build(session::Admission admission);
    // Begins to build the look that the master announces, and reports it when it is built.
    void buildNext();
    // Brings the stage of this look on; false where there is none. What was shown before ends on a
    // thread of its own.
    [[nodiscard]] bool bringOn(std::uint32_t look);
    void enter(std::unique_ptr<BuiltLook> stage);
    // Makes the picture anew where the wall is to be of another tier.
    void bringTo(config::QualityTier quality);
    // Draws and presents frames until the master is lost (Rejoin) or the show ends (Quit).
    [[nodiscard]] session::Release play();
    // Draws and projects a frame, for quad buffers once for each eye, and waits for the GPU. The
    // stage's workspace is current afterwards.
    void draw(const wire::StateFrame& frame);
    void fillWindow();
    // Throws Error where the context is lost.
    void film(Frame frame);
    void watchBlanks(Frame frame);
    // Gives the operator's console a picture of this frame, begun now and taken after a later one,
    // and says which fish is where it asks.
    void showOperator(const wire::StateFrame& frame);
    void nameFish();
    void refuseLoss() const;
    // Sends the food that a visitor has dropped, as places of the world.
    void feed(const wire::Eye& eye);
    // Converts a place of the window to a pixel of the picture. No place means the middle of the
    // picture; empty where the place is beside the picture.
    [[nodiscard]] std::optional<glm::vec2> pixelAt(const WindowPlace& place) const;
    // The fish nearest to the pointer and what the master last said of it.
    [[nodiscard]] std::optional<WatchedMind> watchMind(const wire::StateFrame& frame);
    // Whether the clip takes this frame.
    [[nodiscard]] bool isFilmed(Frame frame) const;
    // Whether anybody sees this frame, so that it must be drawn.
    [[nodiscard]] bool isSeen(Frame frame) const;

    session::Session& session_;
    gl::Context& context_;
    Controls& controls_;
    machine::ServiceNotifier& service_;  // hears of every frame that was presented
    NodeOptions options_;
    Trace trace_;
    // Sends frames to the program that encodes a clip; null: none.
    std::unique_ptr<net::FrameSender> film_;
    // What is drawn; its workspace is current. And the next look, while it is built and after.
    std::unique_ptr<BuiltLook> stage_;
    std::future<std::unique_ptr<BuiltLook>> building_;
    std::unique_ptr<BuiltLook> next_;
    bool isStale_ = false;  // what is being built
    std::future<void> retiring_;
    std::optional<Pointing> pointing_;
    // Where the rig has a console; and the last frames that it was shown, the newest last.
    std::optional<ConsoleLink> console_;
    std::deque<wire::StateFrame> lookedAt_;
    // The fish whose mind is shown, as its index in the school.
    std::optional<std::uint32_t> watched_;
    // When the fish was last chosen and the master asked.
    std::chrono::nanoseconds askedAt_{};
    // Whether a frame of this show has been presented, and how many were since the node began.
    bool shown_ = false;
    std::uint64_t framesShown_ = 0;
    // The last frame, where it was not drawn because nobody saw it.
    std::optional<wire::StateFrame> undrawn_;
};

// What the wire says of a frame, in the form that the scene and the overlays take.

// The school at the frame's moment. Records beyond the school of the welcome message are ignored.
// Slow for a large school: it is for overlays; the scene interpolates fish on the GPU.
[[nodiscard]] std::vector<motion::PresentedFish> presentedFish(
    const wire::StateFrame& frame, std::span<const motion::FishTraits> school);
// One fish by its index in the school; empty where there is none.
[[nodiscard]] std::optional<motion::PresentedFish> presentedFish(
    const wire::StateFrame& frame, std::span<const motion::FishTraits> school, std::size_t place);

// Replaces `food` by the particles at the frame's moment, world frame. A particle that has replaced
// another between the ticks does not glide from its place.
void presentFood(const wire::StateFrame& frame, std::vector<scene::FoodParticle>& food);

// Time of the frame's moment since tick 0, seconds; never negative.
[[nodiscard]] double presentedSeconds(const wire::StateFrame& frame);

// From the world to the wall's frame, which moves with the submarine; metres.
[[nodiscard]] glm::dmat4 wallFromWorld(const wire::Eye& eye);

// The tier of quality that a node keeps up with.

// Returns the seconds that a frame without fish takes at a tier.
using FrameCost = std::function<double(config::QualityTier)>;

// The finest tier whose frames take no more than the budget. It tries the tiers from the lowest and
// stops at the first that is too slow; the lowest is returned even when it is too slow itself.
[[nodiscard]] config::QualityTier finestWithin(double budgetSeconds, const FrameCost& cost);

// The share of the time between two refreshes that a frame without fish may take. The rest is for
// fish, for the events of a show, and reserve.
inline constexpr double kBudgetShare = 0.5;

}  // namespace aquarama::show
