// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/built_look.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <future>
#include <utility>

#include <glm/vec3.hpp>

#include "common/base/log.h"
#include "render_node/gl/program.h"

namespace aquarama::show {

namespace {

// Height of an eye, below which noon may have no light.
constexpr float kLitMetres = -40;

// Whether the projector lights so much of the screen that a small copy of its picture shows it.
bool lightsEnough(const wall::WarpMap& warp) {
    constexpr float kSeen = 0.1F;
    constexpr std::size_t kLeastShare = 20;  // one in so many pixels
    std::size_t lit = 0;
    for (std::size_t i = 0; i < warp.pointAndWeight.size(); ++i) {
        const glm::vec3 blend = warp.blend.empty() ? glm::vec3(1) : warp.blend[i];
        lit += warp.pointAndWeight[i].w * std::max({blend.r, blend.g, blend.b}) > kSeen ? 1 : 0;
    }
    return lit * kLeastShare > warp.pointAndWeight.size();
}

}  // namespace

BuiltLook::BuiltLook(gl::Context& context, const std::string& channel, session::Admission admission)
    : admission_{std::move(admission)},
      channel_{channelIndex(admission_.rig, channel)},
      wall_{std::make_shared<const wall::Wall>(admission_.rig)},
      workspace_{context.makeWorkspace()} {
    // Beside the pictures. Patterns alone need no fish.
    std::future<std::shared_ptr<school::SchoolMotion>> motion;
    if (admission_.world)
        motion = std::async(std::launch::async, [this] { return session::motionOf(admission_); });
    const glm::ivec2 size = admission_.rig.channels[channel_].sizePixels;
    workspace_->makeCurrent();
#ifndef NDEBUG
    gl::logMessages();
#endif
    renderer_ = context.description();
    logInfo("building {} x {} pixels on {}", size.x, size.y, renderer_);
    for (int eye = 0; eye < (context.quadBuffered() ? 2 : 1); ++eye)
        targets_.emplace_back(GL_RGBA8, size);
    chooseQuality();
    // Some drivers compile shaders on first use.
    requireLight();
    if (motion.valid()) motion_ = motion.get();
}

BuiltLook::~BuiltLook() {
    workspace_->makeCurrent();
    reader_.reset();
    picture_.reset();
    targets_.clear();
    workspace_->release();
}

void BuiltLook::bringTo(config::QualityTier quality) {
    if (picture_ && quality_ == quality) return;
    // The old picture goes first, so that the GPU need not hold both.
    picture_.reset();
    picture_.emplace(admission_, channel_, quality, wall_);
    quality_ = quality;
}

void BuiltLook::chooseQuality() {
    if (admission_.quality || !admission_.world) {
        bears_ = admission_.quality.value_or(config::QualityTier::Low);
    } else {
        bears_ =
            finestWithin(kBudgetShare / admission_.rig.timing.refreshHertz,
                         [this](config::QualityTier quality) { return secondsAFrame(quality); });
        logInfo("keeps up with quality {}", config::nameOf(bears_));
    }
    bringTo(bears_);
}

void BuiltLook::drawEmpty() {
    wire::StateFrame frame;
    frame.eye.positionMetres = admission_.scene.eye;
    if (!admission_.world) frame.show.pattern = wire::Pattern::Grey;
    picture_->drawScene(frame, Overlays{});
    picture_->project(targets_.front().framebuffer(), Encoding::Dithered8, Overlays{});
}

bool BuiltLook::isTargetBlack() {
    constexpr int kWidthPixels = 64;
    reader_->begin(targets_.front(), kWidthPixels);
    gl::waitForGpu();
    const auto shown = reader_->take();
    return shown && isBlack(*shown);
}

void BuiltLook::requireLight() {
    constexpr std::array<float, 4> kWhite{1, 1, 1, 1}, kBlack{0, 0, 0, 1};
    const unsigned target = targets_.front().framebuffer();
    glClearNamedFramebufferfv(target, GL_COLOR, 0, kWhite.data());
    const bool isExecuted = !isTargetBlack();
    glClearNamedFramebufferfv(target, GL_COLOR, 0, kBlack.data());
    drawEmpty();
    if (!isExecuted) return logInfo("the driver executes nothing: there is no card");
    const bool hasLight = !admission_.world || admission_.scene.eye.y >= kLitMetres;
    if (hasLight && isTargetBlack() && lightsEnough(wall_->warp(channel_)))
        throw Error("the driver draws a black picture (" + renderer_ +
                    "); install another version of it, or use another card");
}

double BuiltLook::secondsAFrame(config::QualityTier quality) {
    constexpr int kFrames = 5;
    bringTo(quality);
    drawEmpty();  // not measured
    gl::waitForGpu();
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kFrames; ++i) drawEmpty();
    gl::waitForGpu();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() /
           kFrames;
}

config::QualityTier finestWithin(double budgetSeconds, const FrameCost& cost) {
    assert(cost != nullptr);
    config::QualityTier finest = config::QualityTier::Low;
    for (std::uint32_t i = 0; i < config::kTierNames.size(); ++i) {
        const config::QualityTier tier = *config::tierAt(i);
        if (cost(tier) > budgetSeconds) break;
        finest = tier;
    }
    return finest;
}

}  // namespace aquarama::show
