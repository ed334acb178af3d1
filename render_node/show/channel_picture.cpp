// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/channel_picture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/base/digest.h"
#include "common/base/log.h"
#include "common/body/fish_body.h"
#include "common/config/species.h"
#include "common/motion/repertoire.h"
#include "common/place/day.h"
#include "render_node/gl/program.h"
#include "render_node/shaders/shader_interface.h"
#include "render_node/show/presented.h"

namespace aquarama::show {

namespace {

static_assert(double{shaders::kPostReach} <= kMarginRadians);

// Size of a dot of the overlay's font, in pixels, readable from the sweet spot.
float dotPixels(glm::ivec2 pictureSize) {
    return std::max(1.0F, std::round(static_cast<float>(pictureSize.y) / 400.0F));
}

// A smaller size for whole sentences, which an operator reads from near the wall.
float smallDotPixels(glm::ivec2 pictureSize) {
    return std::max(1.0F, std::round(static_cast<float>(pictureSize.y) / 600.0F));
}

// The list of keys, one label for each line, padded to one width so that the boxes form a
// rectangle.
std::vector<Label> helpLabels(float dot) {
    std::vector<Label> labels;
    std::size_t widest = 0;
    for (const std::string_view line : kKeyHelp) widest = std::max(widest, line.size());
    const float lineHeight = extentInDots("").y * dot;
    for (const std::string_view line : kKeyHelp) {
        std::string padded(line);
        padded.resize(widest, ' ');
        const float top = lineHeight * static_cast<float>(labels.size() + 1);
        labels.push_back({{lineHeight, top}, padded});
    }
    return labels;
}

// The species of a show with their fish. The school is sorted by species: each takes the next
// assets.fish traits. The digest of text and repertoire is the key of the cached tables.
std::vector<surface::SchoolSpecies> castOf(const session::Admission& admission) {
    std::vector<surface::SchoolSpecies> cast;
    std::span<const motion::FishTraits> rest = admission.school;
    const config::DrawingRules drawings = admission.rig.drawings.value_or(config::DrawingRules{});
    for (const wire::SpeciesAssets& assets : admission.cast) {
        const config::Species species = config::parseSpecies(assets.text, assets.file);
        const auto own = rest.first(std::min<std::size_t>(assets.fish, rest.size()));
        rest = rest.subspan(own.size());
        cast.push_back(
            {body::makeBody(species),
             body::skinOf(species),
             motion::decodeRepertoire(assets.repertoire, "the master's repertoire"),
             {own.begin(), own.end()},
             digestOf(toHex(digestOf(assets.text)) + toHex(digestOf(std::span{assets.repertoire}))),
             std::ranges::find(drawings.species, species.name) != drawings.species.end()});
    }
    return cast;
}

// Converts from the world to clip space.
glm::mat4 clipOf(const scene::View& view) {
    return view.clipFromCamera * view.cameraFromWorld;
}

}  // namespace

std::size_t channelIndex(const config::Rig& rig, const std::string& name) {
    const auto found = std::ranges::find(rig.channels, name, &config::Channel::name);
    if (found == rig.channels.end())
        throw Error("rig \"" + rig.name + "\" has no channel \"" + name +
                    "\"; name one that it has");
    return static_cast<std::size_t>(found - rig.channels.begin());
}

glm::mat4 cameraFromWorld(const wall::ChannelFrustum& frustum, const wire::Eye& submarine) {
    return glm::mat4(frustum.cameraFromWall * wallFromWorld(submarine));
}

ChannelPicture::Viewing::Viewing(const wall::ChannelFrustum& from,
                                 const wall::WarpMap& warp,
                                 const wall::PatternGround& ground,
                                 std::uint32_t channelId)
    : frustum{from}, pattern{from, ground}, projection{projectionMap(warp, from), channelId} {}

ChannelPicture::ChannelPicture(const session::Admission& admission,
                               std::size_t channel,
                               config::QualityTier quality,
                               std::shared_ptr<const wall::Wall> wall,
                               bool savesWork)
    : stereo_{wall::stereoOf(admission.rig, channel)},
      school_{admission.school},
      day_{admission.scene.day},
      channel_{channel} {
    assert(channel < admission.rig.channels.size());
    const config::Rig& rig = admission.rig;
    const std::uint32_t id = rig.channels[channel].id;
    if (!wall) wall = std::make_shared<const wall::Wall>(rig);
    const wall::WarpMap warp = wall->warp(channel);
    const wall::PatternGround ground = wall->screen().patternGround();
    const wall::ChannelFrustum between = wall->frustum(channel, kMarginRadians);
    map_ = projectionMap(warp, between);
    sizes_.pattern = between.sizePixels ? *between.sizePixels : scenePictureSize(map_);
    sizes_.world = glm::ceil(glm::vec2(sizes_.pattern) * scene::qualityOf(quality).pictureShare);
    sizes_.scene = sizes_.world;
    // Two eyes for any stereo mode, else one between them.
    const bool two = stereo_.mode != config::StereoMode::Mono;
    for (const wall::EyeSide side : two ? std::vector{wall::EyeSide::Left, wall::EyeSide::Right}
                                        : std::vector{wall::EyeSide::Between})
        eyes_.emplace_back(wall->frustum(channel, kMarginRadians, side), warp, ground, id);
    if (two && stereo_.mode != config::StereoMode::QuadBuffer)
        together_.emplace(map_.sizePixels, id, stereo_.mode);
    if (const formats::ChannelColour* colour = wall->channel(channel).colour())
        codes_.emplace(*colour);
    // The scene has one texture: all eyes but the last need a copy.
    for (Viewing& eye : eyes_)
        if (&eye != &eyes_.back()) eye.kept.emplace(GL_RGBA16F, sizes_.world);
    if (rig.guests && rig.guests->channel == rig.channels[channel].name) sign_.emplace(*rig.guests);
    if (admission.world)
        scene_.emplace(
            scene::SceneOptions{.place = place::placeOf(admission.scene, admission.seed),
                                .water = admission.scene.water.jerlov,
                                .current = admission.scene.current,
                                .quality = quality,
                                .pixelRadians = static_cast<float>(wall->finestPixelRadians()),
                                .culling = savesWork,
                                .levelsOfDetail = savesWork},
            castOf(admission));
}

void ChannelPicture::wear(const body::SkinsByNumber& skins, std::size_t most) {
    if (scene_) scene_->wear(skins, most);
}

void ChannelPicture::drawScene(const wire::StateFrame& frame,
                               const Overlays& overlays,
                               const std::optional<WatchedMind>& mind) {
    drawn_.frame = frame.frame;
    drawn_.brightness = frame.show.brightness;
    scan_ = frame.show.scan;
    drawn_.worldEye.reset();
    if (scan_ && frame.show.black) scan_->lit = 0;  // black takes effect at once
    if (scan_) return;
    const bool isWorld = scene_ && frame.show.pattern == wire::Pattern::World;
    sizes_.scene = isWorld ? sizes_.world : sizes_.pattern;
    if (isWorld) drawn_.worldEye = frame.eye;
    if (drawn_.brightness == 0 && eyes_.front().sceneTexture != 0) return;
    if (isWorld) drawWorld(frame);
    if (sign_) sign_->place(frame.show.sign, map_, sizes_.world);
    for (Viewing& eye : eyes_) {
        if (!isWorld) drawPattern(eye, frame.show.pattern);
        glNamedFramebufferTexture(eye.onScene.name(), GL_COLOR_ATTACHMENT0, eye.sceneTexture, 0);
        if (isWorld && sign_) sign_->draw(eye.onScene.name(), sizes_.scene, frame.show.sign);
        if (overlays.warpGrid) eye.pattern.addGrid(eye.onScene.name(), sizes_.scene);
        if (overlays.fishIds) drawFishIds(eye, frame);
        if (mind) drawMind(eye, frame, *mind);
    }
}

namespace {

surface::SchoolMoment momentOf(const wire::StateFrame& frame) {
    return {frame.before,
            frame.after,
            frame.fraction,
            frame.areOfTick ? std::optional(frame.tick) : std::nullopt};
}

}  // namespace

void ChannelPicture::drawWorld(const wire::StateFrame& frame) {
    presentFood(frame, food_);
    const scene::SceneFrame scene{.timeSeconds = presentedSeconds(frame),
                                  .eyePositionMetres = frame.eye.positionMetres,
                                  .fish = momentOf(frame),
                                  .food = food_,
                                  .daylight = place::daylightAt(day_, double{frame.timeOfDay}),
                                  .timeOfDay = frame.timeOfDay,
                                  .colourReturned = frame.show.colourReturned};
    scene_->update(scene);
    for (Viewing& eye : eyes_) {
        const scene::View view = viewOf(eye, frame.eye);
        eye.clipFromWorld = clipOf(view);
        eye.sceneTexture = scene_->draw(view);
        if (!eye.kept) continue;
        glCopyImageSubData(eye.sceneTexture,
                           GL_TEXTURE_2D,
                           0,
                           0,
                           0,
                           0,
                           eye.kept->texture(),
                           GL_TEXTURE_2D,
                           0,
                           0,
                           0,
                           0,
                           sizes_.scene.x,
                           sizes_.scene.y,
                           1);
        eye.sceneTexture = eye.kept->texture();
    }
}

void ChannelPicture::drawPattern(Viewing& eye, wire::Pattern pattern) const {
    if (!eye.patterned) eye.patterned.emplace(GL_RGBA16F, sizes_.pattern);
    eye.sceneTexture = eye.patterned->texture();
    if (pattern == wire::Pattern::Grid)
        eye.pattern.drawGrid(eye.patterned->framebuffer(), sizes_.pattern);
    else
        eye.pattern.drawGrey(eye.patterned->framebuffer(), sizes_.pattern);
}

std::optional<FishPlace> ChannelPicture::placeOf(const glm::mat4& clipFromWorld,
                                                 const motion::PresentedFish& fish) const {
    const glm::vec4 clip = clipFromWorld * glm::vec4(fish.positionMetres, 1);
    if (clip.w <= 0) return std::nullopt;
    const glm::vec2 size(sizes_.scene);
    const glm::vec2 place = (glm::vec2(clip.x, -clip.y) / clip.w * 0.5F + 0.5F) * size;
    if (place.x < 0 || place.y < 0 || place.x >= size.x || place.y >= size.y) return std::nullopt;
    // The first row of the matrix: its length is the horizontal scale, from metres to half widths
    // of the picture at w = 1.
    const glm::vec3 across(clipFromWorld[0].x, clipFromWorld[1].x, clipFromWorld[2].x);
    const float pixelsAMetre = glm::length(across) / clip.w * 0.5F * size.x;
    return FishPlace{place, 0.5F * fish.lengthMetres * pixelsAMetre};
}

// Writes the number of each fish at the origin of its body frame.
void ChannelPicture::drawFishIds(const Viewing& eye, const wire::StateFrame& frame) {
    const float dot = dotPixels(sizes_.scene);
    std::vector<Label> labels;
    for (const motion::PresentedFish& fish : presentedFish(frame, school_)) {
        const auto place = placeOf(eye.clipFromWorld, fish);
        if (!place) continue;
        const std::string text = std::to_string(fish.id);
        labels.push_back({place->middle - extentInDots(text) * dot / 2.0F, text});
    }
    text_.draw(labels, eye.onScene.name(), sizes_.scene, dot);
}

void ChannelPicture::drawMind(const Viewing& eye,
                              const wire::StateFrame& frame,
                              const WatchedMind& mind) {
    const auto fish = presentedFish(frame, school_, mind.fish);
    if (!fish) return;
    const auto place = placeOf(eye.clipFromWorld, *fish);
    if (!place) return;
    const float dot = smallDotPixels(sizes_.scene);
    text_.draw(mindLabels(*place, mind, sizes_.scene, dot), eye.onScene.name(), sizes_.scene, dot);
}

std::optional<std::uint32_t> ChannelPicture::fishNearest(const wire::StateFrame& frame,
                                                         glm::vec2 pixel) const {
    // From the pixel of the display to the pixel of an eye, and through the projection map to the
    // place in the scene's picture.
    const glm::vec2 own = pixelOfEye(stereo_.mode, map_.sizePixels, pixel);
    const glm::ivec2 texel = glm::clamp(glm::ivec2(own), glm::ivec2(0), map_.sizePixels - 1);
    const glm::vec4 lit =
        map_.placeAndWeight[static_cast<std::size_t>(texel.y * map_.sizePixels.x + texel.x)];
    const glm::vec2 wanted = glm::vec2(lit.x, 1.0F - lit.y) * glm::vec2(sizes_.scene);
    std::optional<std::uint32_t> nearest;
    float least = std::numeric_limits<float>::infinity();
    const glm::mat4 clipFromWorld = clipOf(viewOf(eyes_.front(), frame.eye));
    const std::vector<motion::PresentedFish> fish = presentedFish(frame, school_);
    for (std::uint32_t i = 0; i < fish.size(); ++i) {
        const auto place = placeOf(clipFromWorld, fish[i]);
        if (!place) continue;
        const float distance = glm::distance(place->middle, wanted);
        if (distance >= least) continue;
        least = distance;
        nearest = i;
    }
    return nearest;
}

std::optional<DrawnWorld> ChannelPicture::drawnWorld() {
    if (!drawn_.worldEye) return std::nullopt;
    return DrawnWorld{*scene_, *drawn_.worldEye, drawn_.brightness};
}

void ChannelPicture::project(unsigned framebuffer,
                             Encoding encoding,
                             const Overlays& overlays,
                             Shown shown) {
    const gl::Stage stage{"warp"};
    if (scan_) return projectScan(framebuffer, shown);
    Projection::Draw draw{.framebuffer = framebuffer,
                          .frame = drawn_.frame,
                          .encoding = encoding,
                          .blendMask = overlays.blendMask,
                          .brightness = drawn_.brightness,
                          .codes = codes_ ? &*codes_ : nullptr};
    const auto sceneAndMap = [](const Viewing& eye) {
        return PairProjection::Eye{eye.sceneTexture, eye.projection};
    };
    if (shown == Shown::Display && together_) {
        const Viewing& first = stereo_.swapEyes ? eyes_.back() : eyes_.front();
        const Viewing& second = stereo_.swapEyes ? eyes_.front() : eyes_.back();
        together_->draw(sceneAndMap(first), sceneAndMap(second), draw);
    } else {
        const Viewing& eye = shown == Shown::RightEye ? eyes_.back() : eyes_.front();
        // drawScene() comes first.
        assert(eye.sceneTexture != 0);
        draw.sceneTexture = eye.sceneTexture;
        eye.projection.draw(draw);
    }
    if (drawn_.brightness == 0) return;
    const float dot = dotPixels(sizePixels());
    if (overlays.help) text_.draw(helpLabels(dot), framebuffer, sizePixels(), dot);
    if (!overlays.endRefused) return;
    const float smallDot = smallDotPixels(sizePixels());
    const Label hint{glm::vec2(extentInDots("").y * smallDot), std::string(kEndHint)};
    text_.draw(std::span(&hint, 1), framebuffer, sizePixels(), smallDot);
}

// No overlay is drawn on it, and no light is dimmed: a camera measures it.
void ChannelPicture::projectScan(unsigned framebuffer, Shown shown) {
    if (!scanPass_) scanPass_.emplace(map_.sizePixels, channel_);
    const bool isWhole = shown == Shown::Display;
    scanPass_->draw(framebuffer, *scan_, isWhole ? stereo_.mode : config::StereoMode::Mono);
}

scene::View ChannelPicture::viewOf(const Viewing& viewing, const wire::Eye& submarine) const {
    return {.clipFromCamera = wall::clipFromCamera(viewing.frustum, kNearMetres),
            .cameraFromWorld = cameraFromWorld(viewing.frustum, submarine),
            .sizePixels = sizes_.scene};
}

}  // namespace aquarama::show
