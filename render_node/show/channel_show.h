// SPDX-License-Identifier: Apache-2.0
// The frames of one channel, from the master's state to light: the drawing thread of a node.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

#include "common/net/channels.h"
#include "render_node/context/context.h"
#include "render_node/gl/target.h"
#include "render_node/session/session.h"
#include "render_node/show/channel_picture.h"
#include "render_node/show/controls.h"
#include "render_node/show/node_options.h"
#include "render_node/show/pointing.h"
#include "render_node/show/trace.h"

namespace aquarama::show {

// Owns GL objects; construct, use and destroy with the context current.
class ChannelShow {
  public:
    ChannelShow(session::Session& session,
                context::Context& context,
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
    void film(Frame frame);
    void refuseLoss() const;
    void feed(const wire::Eye& eye);
    // Where in the picture a place of the window lies; where there is none, its middle.
    [[nodiscard]] std::optional<glm::vec2> pixelAt(const WindowPlace& place) const;
    [[nodiscard]] std::optional<WatchedMind> watchMind(const wire::StateFrame& frame);
    [[nodiscard]] bool isFilmed(Frame frame) const;
    [[nodiscard]] bool isSeen(Frame frame) const;

    session::Session& session_;
    context::Context& context_;
    Controls& controls_;
    NodeOptions options_;
    Trace trace_;
    std::unique_ptr<net::FrameSender> film_;
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

}  // namespace aquarama::show
