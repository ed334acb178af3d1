// SPDX-License-Identifier: Apache-2.0
// The drawing thread of a node: it draws and shows the frames of one channel that the master sends.
#pragma once

#include <cstdint>
#include <deque>
#include <future>
#include <memory>
#include <optional>

#include "common/base/units.h"
#include "common/body/side_skin.h"
#include "common/config/rig.h"
#include "common/machine/service_notifier.h"
#include "common/net/channels.h"
#include "common/net/clock.h"
#include "common/wire/state_codec.h"
#include "render_node/gl/context.h"
#include "render_node/session/session.h"
#include "render_node/show/built_look.h"
#include "render_node/show/controls.h"
#include "render_node/show/preview.h"
#include "render_node/show/run_node.h"
#include "render_node/show/trace.h"

namespace aquarama::show {

// Runs on the drawing thread; construct, use and destroy it there. The next look is built on
// another thread. Session, context, controls and service must outlive it.
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
    // Draws the last state and writes the picture of it, and the poster where one is wanted.
    void writePicture();
    // Throws Error where the last frame did not show the world.
    void writePanorama();
    // Prepares for a show. Where the look is the same as before, nothing is built again.
    void build(session::Admission admission);
    // Begins to build the look that the master announces, and reports it when it is built.
    void buildNext();
    // Shows this look from now on; false where it is not built. The look before is destroyed on
    // another thread.
    [[nodiscard]] bool bringOn(std::uint32_t look);
    void enter(std::unique_ptr<BuiltLook> stage);
    // Builds the picture again where the wall changes to another tier.
    void bringTo(config::QualityTier quality);
    // Draws and presents frames until the master is lost (Rejoin) or the show ends (Quit).
    [[nodiscard]] session::Release play();
    // Whether the master leads, and by which number its frames name what is shown.
    void followMaster();
    void renumber(std::uint32_t look);
    // What fish wear: one new drawing a frame, so that none is late; all where the picture is new.
    void dress();
    // Draws and projects a frame, for quad buffers once for each eye, and waits for the GPU. The
    // stage's workspace is current afterwards.
    void draw(const wire::StateFrame& frame);
    void fillWindow();
    // Throws Error where the context is lost.
    void film(Frame frame);
    void watchBlanks(Frame frame);
    // Gives a watcher a picture of this frame, and answers their questions about fish.
    // The picture is started now, and read after a later frame.
    void showWatchers(const wire::StateFrame& frame);
    void nameFish(WatcherLink& watcher);
    void refuseLoss() const;
    // Sends the food that a visitor has dropped, as places of the world.
    void feed(const wire::Eye& eye);
    void touch(net::Moment now);
    // Converts a place of the window to a pixel of the picture; empty where it is outside the
    // picture. Without a place it is the middle of the picture.
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
    machine::ServiceNotifier& service_;  // is told of every frame that was presented
    NodeOptions options_;
    Trace trace_;
    // Sends frames to the program that encodes a clip; null: none.
    std::unique_ptr<net::FrameSender> film_;
    // The look that is drawn; its workspace is current. Then the next look, while it is built and
    // until it is shown.
    std::unique_ptr<BuiltLook> stage_;
    std::future<std::unique_ptr<BuiltLook>> building_;
    std::unique_ptr<BuiltLook> next_;
    bool isStale_ = false;  // the look that is being built
    std::future<void> retiring_;
    std::optional<Pointing> pointing_;
    StatePace<WallHands> handPace_;
    // Who watches, and the last frames that they were shown, the newest last.
    std::deque<WatcherLink> watchers_;
    WatcherLink* reading_ = nullptr;  // for whom the picture is read
    std::deque<wire::StateFrame> lookedAt_;
    // The fish whose mind is shown, as its index in the school.
    std::optional<std::uint32_t> watched_;
    // When the fish was last chosen and the master asked.
    net::Moment askedAt_{};
    // What visitors have painted, and whether the picture has none of it yet.
    std::shared_ptr<const body::SkinsByNumber> skins_ =
        std::make_shared<const body::SkinsByNumber>();
    bool isUndressed_ = true;
    // Whether a frame of this show has been presented, and how many since the node started.
    bool shown_ = false;
    bool isAlone_ = false;  // the master is silent
    std::uint64_t framesShown_ = 0;
    // The last frame, where it was not drawn because it was neither shown nor filmed.
    std::optional<wire::StateFrame> undrawn_;
};

}  // namespace aquarama::show
