// SPDX-License-Identifier: Apache-2.0
// What one channel shows of a frame: the world from the sweet spot, projected to its part of the
// wall.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/messages.h"
#include "render_node/gl/target.h"
#include "render_node/project/pattern_pass.h"
#include "render_node/project/projection.h"
#include "render_node/scene/scene.h"
#include "render_node/session/session.h"
#include "render_node/show/controls.h"
#include "render_node/show/mind_labels.h"
#include "render_node/show/text_overlay.h"

namespace aquarama {

// The channel of this name. Throws Error where the rig has none.
[[nodiscard]] std::size_t channelIndex(const Rig& rig, const std::string& name);

// Owns its GL objects; construct, use and destroy with the same context current.
class ChannelPicture {
  public:
    ChannelPicture(const Admission& admission, std::size_t channel, QualityTier quality);

    // The picture of the channel's frustum, in linear light, with what belongs to the world.
    void drawScene(const StateFrame& frame,
                   const Overlays& overlays,
                   const std::optional<WatchedMind>& mind = std::nullopt);
    // Of the fish that the last scene shows, the one that a pixel (from the top left corner) is
    // nearest to; its place in the school.
    [[nodiscard]] std::optional<std::uint32_t> fishNearest(glm::vec2 pixel) const;
    // The projector's pixels of the scene that was drawn last, into the framebuffer's lower left
    // corner.
    void project(unsigned framebuffer, Encoding encoding, const Overlays& overlays);
    [[nodiscard]] glm::ivec2 sizePixels() const { return map_.sizePixels; }

  private:
    void drawWorld(const StateFrame& frame);
    void drawPattern();
    void drawFishIds();
    void drawMind(const WatchedMind& mind);
    [[nodiscard]] View viewOf(const Eye& eye) const;
    // In the scene's pixels, from its top left corner; nothing for what it does not show.
    [[nodiscard]] std::optional<FishPlace> placeOf(const PresentedFish& fish) const;

    Pattern pattern_;
    std::vector<FishTraits> school_;
    ChannelFrustum frustum_;
    ProjectionMap map_;
    glm::ivec2 sceneSize_;
    std::optional<SceneRenderer> scene_;        // of the world
    std::optional<gl::Target> patternPicture_;  // of a pattern
    PatternPass patternPass_;
    Projection projection_;
    TextOverlay text_;
    gl::Framebuffer onScene_;  // to draw over the scene's texture
    std::vector<PresentedFish> fish_;
    std::vector<FoodParticle> food_;
    glm::mat4 clipFromWorld_{1.0F};
    unsigned sceneTexture_ = 0;
    Frame frame_;
};

}  // namespace aquarama
