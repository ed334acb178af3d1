// SPDX-License-Identifier: Apache-2.0
// What one channel shows of a frame: the world from the sweet spot, or from two eyes beside it,
// projected to its part of the wall.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/motion/reconstruct.h"
#include "common/wire/state_codec.h"
#include "render_node/gl/target.h"
#include "render_node/project/pattern_pass.h"
#include "render_node/project/projection.h"
#include "render_node/scene/scene.h"
#include "render_node/session/session.h"
#include "render_node/show/controls.h"
#include "render_node/show/mind_labels.h"
#include "render_node/show/text_overlay.h"

namespace aquarama::show {

// Which picture of a channel: the one that its display takes, with both eyes in it where there are
// two, or that of one eye.
enum class Shown : std::uint8_t { Display, LeftEye, RightEye };

// The channel of this name. Throws Error where the rig has none.
[[nodiscard]] std::size_t channelIndex(const config::Rig& rig, const std::string& name);

// Owns its GL objects; construct, use and destroy with the same context current.
class ChannelPicture {
  public:
    ChannelPicture(const session::Admission& admission,
                   std::size_t channel,
                   config::QualityTier quality);

    // The picture of each eye's frustum, in linear light, with what belongs to the world.
    void drawScene(const wire::StateFrame& frame,
                   const Overlays& overlays,
                   const std::optional<WatchedMind>& mind = std::nullopt);
    // Of the fish of a frame, the one that a pixel (of the display, from the top left corner) is
    // nearest to; its place in the school.
    [[nodiscard]] std::optional<std::uint32_t> fishNearest(const wire::StateFrame& frame,
                                                           glm::vec2 pixel) const;
    // The projector's pixels of the scene that was drawn last, into the framebuffer's lower left
    // corner. A display of quad buffers takes one eye at a time: in one picture it shows the left.
    void project(unsigned framebuffer,
                 project::Encoding encoding,
                 const Overlays& overlays,
                 Shown shown = Shown::Display);
    [[nodiscard]] glm::ivec2 sizePixels() const { return map_.sizePixels; }
    [[nodiscard]] const config::Stereo& stereo() const { return stereo_; }

  private:
    // A viewer's eye, or the place between both where one picture serves them.
    struct Viewing {
        Viewing(const wall::ChannelFrustum& from,
                const wall::WarpMap& warp,
                const config::Screen& screen,
                std::uint32_t channelId);

        wall::ChannelFrustum frustum;
        project::PatternPass pattern;
        project::Projection projection;
        gl::Framebuffer onScene;         // to draw over the scene's texture
        std::optional<gl::Target> kept;  // of its own, where the scene's is needed for another eye
        glm::mat4 clipFromWorld{1.0F};
        unsigned sceneTexture = 0;
    };

    void drawWorld(const wire::StateFrame& frame);
    void drawPattern(Viewing& eye) const;
    void drawFishIds(const Viewing& eye, const wire::StateFrame& frame);
    void drawMind(const Viewing& eye, const wire::StateFrame& frame, const WatchedMind& mind);
    [[nodiscard]] scene::View viewOf(const Viewing& viewing, const wire::Eye& submarine) const;
    // In the scene's pixels, from its top left corner; nothing for what it does not show.
    [[nodiscard]] std::optional<FishPlace> placeOf(const glm::mat4& clipFromWorld,
                                                   const motion::PresentedFish& fish) const;

    wire::Pattern pattern_;
    config::Stereo stereo_;
    std::vector<motion::FishTraits> school_;
    project::ProjectionMap map_;  // from between the eyes
    glm::ivec2 sceneSize_{};
    std::deque<Viewing> eyes_;                         // one, or left and right
    std::optional<project::PairProjection> together_;  // where one picture holds both
    std::optional<scene::SceneRenderer> scene_;        // of the world
    TextOverlay text_;
    std::vector<scene::FoodParticle> food_;
    Frame frame_;
};

}  // namespace aquarama::show
