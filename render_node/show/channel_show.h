// SPDX-License-Identifier: Apache-2.0
// The frames of one channel, from the master's state to light: the drawing thread of a node.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "common/wall/frame_pipe.h"
#include "render_node/context/context.h"
#include "render_node/gl/target.h"
#include "render_node/session/session.h"
#include "render_node/show/channel_picture.h"
#include "render_node/show/controls.h"
#include "render_node/show/node_options.h"
#include "render_node/show/pointing.h"
#include "render_node/show/trace.h"

namespace aquarama {

// Owns GL objects; construct, use and destroy with the context current.
class ChannelShow {
  public:
    ChannelShow(Session& session, Context& context, Controls& controls, const NodeOptions& options);

    // From the first admission to the end of the show, through every time the master is lost and
    // found again; then the snapshot.
    void run(Admission admission);

  private:
    void build(Admission admission);
    void buildPicture(QualityTier quality);
    // What the wall is to be drawn at, or as fine as this node keeps up with.
    void chooseQuality();
    [[nodiscard]] double secondsAFrame(QualityTier quality);
    [[nodiscard]] Release play();
    void draw(const StateFrame& frame);
    void project(const Overlays& overlays, Shown shown);
    void refuseLoss() const;
    void feed(const Eye& eye);
    // Where in the picture a place of the window lies; where there is none, its middle.
    [[nodiscard]] std::optional<glm::vec2> pixelAt(const WindowPlace& place) const;
    [[nodiscard]] std::optional<WatchedMind> watchMind(const StateFrame& frame);
    [[nodiscard]] bool isFilmed(Frame frame) const;
    [[nodiscard]] bool isSeen(Frame frame) const;

    Session& session_;
    Context& context_;
    Controls& controls_;
    NodeOptions options_;
    Trace trace_;
    std::optional<FramePipeWriter> film_;
    std::optional<Admission> built_;          // what picture_ was built for
    QualityTier quality_ = QualityTier::Low;  // of picture_
    QualityTier bears_ = QualityTier::Low;    // the finest that this node keeps up with
    std::optional<Pointing> pointing_;
    std::optional<ChannelPicture> picture_;
    std::optional<gl::Target> offscreen_;   // where there is no window of the channel's size
    std::optional<std::uint32_t> watched_;  // the fish whose mind is shown
    std::chrono::nanoseconds askedAt_{};
    bool shown_ = false;
    std::optional<StateFrame> undrawn_;  // the last frame, where nobody saw it
};

}  // namespace aquarama
