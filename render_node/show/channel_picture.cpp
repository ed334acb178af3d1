// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/channel_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/body/fish_body.h"
#include "common/config/species.h"
#include "common/units/error.h"
#include "render_node/show/presented.h"

namespace aquarama {

namespace {

// Beyond what the projector lights, so that filters which read neighbours have some: 1 degree.
constexpr double kMarginRadians = 0.0175;
constexpr float kNearMetres = 0.05F;

// Dots large enough to be read from the sweet spot.
float dotPixels(glm::ivec2 pictureSize) {
    return std::max(1.0F, std::round(static_cast<float>(pictureSize.y) / 400.0F));
}

// For whole sentences, which an operator reads from near.
float smallDotPixels(glm::ivec2 pictureSize) {
    return std::max(1.0F, std::round(static_cast<float>(pictureSize.y) / 600.0F));
}

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

std::vector<SceneSpecies> castOf(const Admission& admission) {
    std::vector<SceneSpecies> cast;
    for (const AdmittedSpecies& admitted : admission.cast) {
        const Species species = parseSpecies(admitted.text, "the master's species file");
        cast.push_back({makeBody(species), skinOf(species), admitted.repertoire, admitted.fish});
    }
    return cast;
}

}  // namespace

std::size_t channelIndex(const Rig& rig, const std::string& name) {
    const auto found = std::ranges::find(rig.channels, name, &Channel::name);
    if (found == rig.channels.end())
        throw Error("rig \"" + rig.name + "\" has no channel \"" + name +
                    "\"; name one that it has");
    return static_cast<std::size_t>(found - rig.channels.begin());
}

ChannelPicture::ChannelPicture(const Admission& admission, std::size_t channel, QualityTier quality)
    : pattern_{admission.welcome.pattern},
      school_{admission.welcome.school},
      frustum_{channelFrustum(admission.rig, channel, kMarginRadians)},
      map_{projectionMap(warpMap(admission.rig, channel), frustum_)},
      sceneSize_{scenePictureSize(map_)},
      patternPass_{frustum_},
      projection_{map_, admission.rig.channels[channel].id} {
    if (pattern_ == Pattern::World) {
        scene_.emplace(
            SceneOptions{
                .seed = admission.welcome.seed, .place = admission.scene.place, .quality = quality},
            castOf(admission));
    } else {
        patternPicture_.emplace(GL_RGBA16F, sceneSize_);
    }
}

void ChannelPicture::drawScene(const StateFrame& frame,
                               const Overlays& overlays,
                               const std::optional<WatchedMind>& mind) {
    frame_ = frame.frame;
    if (scene_)
        drawWorld(frame);
    else
        drawPattern();
    glNamedFramebufferTexture(onScene_.name(), GL_COLOR_ATTACHMENT0, sceneTexture_, 0);
    if (overlays.warpGrid) patternPass_.addGrid(onScene_.name(), sceneSize_);
    if (overlays.fishIds) drawFishIds();
    if (mind) drawMind(*mind);
}

void ChannelPicture::drawWorld(const StateFrame& frame) {
    fish_ = presentedFish(frame, school_);
    food_ = presentedFood(frame);
    const View view = viewOf(frame.eye);
    clipFromWorld_ = view.clipFromCamera * view.cameraFromWorld;
    const SceneFrame scene{.timeSeconds = presentedSeconds(frame),
                           .eyePositionMetres = frame.eye.positionMetres,
                           .fish = fish_,
                           .food = food_,
                           .daylight = frame.daylight};
    scene_->update(scene);
    sceneTexture_ = scene_->draw(view);
}

void ChannelPicture::drawPattern() {
    sceneTexture_ = patternPicture_->texture();
    if (pattern_ == Pattern::Grid)
        patternPass_.drawGrid(patternPicture_->framebuffer(), sceneSize_);
    else
        patternPass_.drawGrey(patternPicture_->framebuffer(), sceneSize_);
}

std::optional<FishPlace> ChannelPicture::placeOf(const PresentedFish& fish) const {
    const glm::vec4 clip = clipFromWorld_ * glm::vec4(fish.positionMetres, 1);
    if (clip.w <= 0) return std::nullopt;
    const glm::vec2 size(sceneSize_);
    const glm::vec2 place = (glm::vec2(clip.x, -clip.y) / clip.w * 0.5F + 0.5F) * size;
    if (place.x < 0 || place.y < 0 || place.x >= size.x || place.y >= size.y) return std::nullopt;
    const glm::vec3 across(clipFromWorld_[0].x, clipFromWorld_[1].x, clipFromWorld_[2].x);
    const float pixelsAMetre = glm::length(across) / clip.w * 0.5F * size.x;
    return FishPlace{place, 0.5F * fish.lengthMetres * pixelsAMetre};
}

// Each number stands on its fish's body frame.
void ChannelPicture::drawFishIds() {
    const float dot = dotPixels(sceneSize_);
    std::vector<Label> labels;
    for (const PresentedFish& fish : fish_) {
        const auto place = placeOf(fish);
        if (!place) continue;
        const std::string text = std::to_string(fish.id);
        labels.push_back({place->middle - extentInDots(text) * dot / 2.0F, text});
    }
    text_.draw(labels, onScene_.name(), sceneSize_, dot);
}

void ChannelPicture::drawMind(const WatchedMind& mind) {
    if (mind.fish >= fish_.size()) return;
    const auto place = placeOf(fish_[mind.fish]);
    if (!place) return;
    const float dot = smallDotPixels(sceneSize_);
    text_.draw(mindLabels(*place, mind, sceneSize_, dot), onScene_.name(), sceneSize_, dot);
}

std::optional<std::uint32_t> ChannelPicture::fishNearest(glm::vec2 pixel) const {
    const glm::ivec2 texel = glm::clamp(glm::ivec2(pixel), glm::ivec2(0), map_.sizePixels - 1);
    const glm::vec4 lit =
        map_.placeAndWeight[static_cast<std::size_t>(texel.y * map_.sizePixels.x + texel.x)];
    const glm::vec2 wanted = glm::vec2(lit.x, 1.0F - lit.y) * glm::vec2(sceneSize_);
    std::optional<std::uint32_t> nearest;
    float least = std::numeric_limits<float>::infinity();
    for (std::uint32_t i = 0; i < fish_.size(); ++i) {
        const auto place = placeOf(fish_[i]);
        if (!place) continue;
        const float distance = glm::distance(place->middle, wanted);
        if (distance >= least) continue;
        least = distance;
        nearest = i;
    }
    return nearest;
}

void ChannelPicture::project(unsigned framebuffer, Encoding encoding, const Overlays& overlays) {
    projection_.draw({.sceneTexture = sceneTexture_,
                      .framebuffer = framebuffer,
                      .frame = frame_,
                      .encoding = encoding,
                      .blendMask = overlays.blendMask});
    if (!overlays.help) return;
    const float dot = dotPixels(sizePixels());
    text_.draw(helpLabels(dot), framebuffer, sizePixels(), dot);
}

View ChannelPicture::viewOf(const Eye& eye) const {
    return {.clipFromCamera = clipFromCamera(frustum_, kNearMetres),
            .cameraFromWorld = glm::mat4(frustum_.cameraFromWall * wallFromWorld(eye)),
            .sizePixels = sceneSize_};
}

}  // namespace aquarama
