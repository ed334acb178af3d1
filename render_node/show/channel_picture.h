// SPDX-License-Identifier: Apache-2.0
// Makes the picture of one channel for a frame: the world seen from the sweet spot, or from two
// eyes beside it, projected to the channel's part of the wall.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "common/motion/reconstruct.h"
#include "common/wire/state_codec.h"
#include "render_node/gl/handle.h"
#include "render_node/scene/scene.h"
#include "render_node/session/session.h"
#include "render_node/show/controls.h"
#include "render_node/show/overlay.h"
#include "render_node/show/projection.h"
#include "render_node/show/sign.h"

namespace aquarama::show {

// Which picture of a channel: the one that its display takes, which holds both eyes where there are
// two, or that of one eye.
enum class Shown : std::uint8_t { Display, LeftEye, RightEye };

// Index of the channel of this name in rig.channels. Throws Error where the rig has none.
[[nodiscard]] std::size_t channelIndex(const config::Rig& rig, const std::string& name);

// The picture of a frustum is wider than what the projector lights by this angle, 1 degree, because
// softening and bloom read pixels beside a pixel.
inline constexpr double kMarginRadians = 0.0175;
// Distance of the near plane.
inline constexpr float kNearMetres = 0.05F;

// The world as a frame showed it, for more pictures of it. The renderer is updated for that frame.
// What it draws replaces the picture of drawScene(): project that before.
struct DrawnWorld {
    scene::SceneRenderer& renderer;
    wire::Eye eye;
    float brightness = 1.0F;
};

// The camera of a frustum in the world, for the submarine's place and heading.
[[nodiscard]] glm::mat4 cameraFromWorld(const wall::ChannelFrustum& frustum,
                                        const wire::Eye& submarine);

// The frame that a channel drew last: its number, whose parity seeds the dither, its brightness,
// and the eye where it showed the world.
struct DrawnFrame {
    Frame frame;
    float brightness = 1.0F;
    std::optional<wire::Eye> worldEye = {};
};

// Of a channel's pictures, in pixels: of the world, of a pattern, and of the one that was drawn
// last.
struct PictureSizes {
    glm::ivec2 world{}, pattern{}, scene{};
};

// Draws in two steps, so that a frame is drawn once and projected as often as needed: drawScene(),
// then project(). Owns its GL objects; construct, use and destroy it with the same context current.
class ChannelPicture {
  public:
    // channel: index in admission.rig.channels. Throws Error: the channel does not aim at the
    // screen, a driver that cannot draw what is needed.
    // wall: of admission.rig; null: made here. savesWork: false draws all that is in the world, at
    // its finest, to measure what culling and levels of detail save.
    ChannelPicture(const session::Admission& admission,
                   std::size_t channel,
                   config::QualityTier quality,
                   std::shared_ptr<const wall::Wall> wall = nullptr,
                   bool savesWork = true);

    // Drawings of visitors that fish wear in the frames that follow: SchoolSurface::wear().
    void wear(const body::SkinsByNumber& skins, std::size_t most);
    // Draws the picture of each eye's frustum in linear light, the world or the frame's pattern,
    // with the overlays that belong to the world: grid, fish numbers, a mind. A frame without light
    // is not drawn, nor is a scan, which has no frustum.
    void drawScene(const wire::StateFrame& frame,
                   const Overlays& overlays,
                   const std::optional<WatchedMind>& mind = std::nullopt);
    // The fish of the frame that is nearest to a pixel of the display (from the top left corner),
    // as its index in the school; empty where no fish is in the picture. Costs a step for each fish
    // of the school.
    [[nodiscard]] std::optional<std::uint32_t> fishNearest(const wire::StateFrame& frame,
                                                           glm::vec2 pixel) const;
    // Writes the projector's pixels of the scene that drawScene() drew last into the framebuffer,
    // from its lower left corner. A quad-buffered display takes one eye at a time: with
    // Shown::Display it gets the left one.
    void project(unsigned framebuffer,
                 Encoding encoding,
                 const Overlays& overlays,
                 Shown shown = Shown::Display);
    // The world of the frame that drawScene() drew last; empty where it showed something else.
    [[nodiscard]] std::optional<DrawnWorld> drawnWorld();
    // Size of the projector's picture.
    [[nodiscard]] glm::ivec2 sizePixels() const { return map_.sizePixels; }
    [[nodiscard]] const config::Stereo& stereo() const { return stereo_; }

  private:
    // The picture of one of the viewer's eyes, or of the point between them where one picture
    // serves both.
    struct Viewing {
        Viewing(const wall::ChannelFrustum& from,
                const wall::WarpMap& warp,
                const wall::PatternGround& ground,
                std::uint32_t channelId);

        wall::ChannelFrustum frustum;
        PatternPass pattern;
        Projection projection;
        // Used to draw overlays on the scene's texture.
        gl::Framebuffer onScene;
        // A copy of the picture, where the scene's own texture is overwritten by the next eye, or
        // where there is no scene.
        std::optional<gl::Target> kept;
        // A test pattern, in the projector's own fineness; made when one is first drawn.
        std::optional<gl::Target> patterned;
        glm::mat4 clipFromWorld{1.0F};
        // GL name of the picture that was drawn last; 0 before the first drawScene().
        unsigned sceneTexture = 0;
    };

    // Draws the world for each eye; drawPattern() draws a test pattern in its place.
    void drawWorld(const wire::StateFrame& frame);
    void drawPattern(Viewing& eye, wire::Pattern pattern) const;
    void projectScan(unsigned framebuffer, Shown shown);
    void drawFishIds(const Viewing& eye, const wire::StateFrame& frame);
    void drawMind(const Viewing& eye, const wire::StateFrame& frame, const WatchedMind& mind);
    // The camera of an eye in the world, for the submarine's place and heading.
    [[nodiscard]] scene::View viewOf(const Viewing& viewing, const wire::Eye& submarine) const;
    // Place of a fish in pixels of the scene's picture, from its top left corner; empty where it is
    // outside the picture or behind the camera.
    [[nodiscard]] std::optional<FishPlace> placeOf(const glm::mat4& clipFromWorld,
                                                   const motion::PresentedFish& fish) const;

    config::Stereo stereo_;
    std::vector<motion::FishTraits> school_;
    // Of the scene: its brightness follows from the time of day.
    config::Day day_;
    // The map for the point between the eyes.
    ProjectionMap map_;
    PictureSizes sizes_;
    // One, or left and right.
    std::deque<Viewing> eyes_;
    // Set where one picture holds both eyes.
    std::optional<PairProjection> together_;
    // Set where the channel has a colour.
    std::optional<ProjectorCodes> codes_;
    // Set where the world can be shown, not test patterns alone.
    std::optional<scene::SceneRenderer> scene_;
    TextOverlay text_;
    // Set where this channel draws the sign for visitors.
    std::optional<ChannelSign> sign_;
    // The pattern of a scan that the frame shows, and its pass, which is made when one is first
    // shown.
    std::optional<config::ScanPattern> scan_;
    std::optional<ScanPass> scanPass_;
    std::size_t channel_;
    std::vector<scene::FoodParticle> food_;
    DrawnFrame drawn_;
};

}  // namespace aquarama::show
