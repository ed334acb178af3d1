// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/channel_show.h"

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>

#include <spdlog/spdlog.h>

#include "common/units/error.h"
#include "render_node/show/snapshot.h"

namespace aquarama {

namespace {

std::chrono::nanoseconds now() {
    return std::chrono::steady_clock::now().time_since_epoch();
}

// Whether what was built for one serves the other.
bool sameShow(const Welcome& a, const Welcome& b) {
    const auto parts = [](const Welcome& w) {
        return std::tie(w.rigText, w.sceneText, w.seed, w.pattern, w.cast);
    };
    const auto sameFish = [](const FishTraits& one, const FishTraits& other) {
        return one.id == other.id && one.lengthMillimetres == other.lengthMillimetres;
    };
    return parts(a) == parts(b) && std::ranges::equal(a.school, b.school, sameFish);
}

// Returns when all that was asked of the GPU is done: only then a frame is ready.
void waitForGpu() {
    constexpr GLuint64 kASecond = 1'000'000'000;
    const GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    while (glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kASecond) == GL_TIMEOUT_EXPIRED) {
    }
    glDeleteSync(fence);
}

// The whole picture, in the middle of a window of another size.
void fitIntoWindow(const gl::Target& picture, glm::ivec2 window) {
    const glm::vec2 size(picture.sizePixels());
    const glm::vec2 room = glm::vec2(window) / size;
    const glm::ivec2 fitted(size * std::min(room.x, room.y));
    const glm::ivec2 corner = (window - fitted) / 2;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glBlitNamedFramebuffer(picture.framebuffer(),
                           0,
                           0,
                           0,
                           picture.sizePixels().x,
                           picture.sizePixels().y,
                           corner.x,
                           corner.y,
                           corner.x + fitted.x,
                           corner.y + fitted.y,
                           GL_COLOR_BUFFER_BIT,
                           GL_LINEAR);
}

}  // namespace

ChannelShow::ChannelShow(Session& session,
                         Context& context,
                         const Controls& controls,
                         const NodeOptions& options)
    : session_{session},
      context_{context},
      controls_{controls},
      options_{options},
      trace_{options.traceFolder, options.channel} {}

void ChannelShow::run(Admission first) {
    std::optional<Admission> admission = std::move(first);
    while (admission) {
        build(*admission);
        session_.prepared();
        const Release end = play();
        if (end == Release::Quit) break;
        spdlog::info("lost the master; joining again");
        admission = session_.join();
    }
    if (shown_ && !options_.snapshotFolder.empty())
        writeSnapshot(options_.snapshotFolder,
                      options_.channel,
                      *picture_,
                      options_.deep ? PictureBits::Deep16 : PictureBits::Dithered8);
}

// A show that goes on after an interruption is not built a second time.
void ChannelShow::build(const Admission& admission) {
    if (built_ && sameShow(*built_, admission.welcome)) return;
    const std::size_t channel = channelIndex(admission.rig, options_.channel);
    const glm::ivec2 size = admission.rig.channels[channel].sizePixels;
    if (picture_ && picture_->sizePixels() != size)
        throw Error("channel \"" + options_.channel +
                    "\" has another size than before; start its node again");
    spdlog::info("building {} x {} pixels on {}", size.x, size.y, context_.description());
    picture_.reset();
    picture_.emplace(admission, channel);
    offscreen_.emplace(GL_RGBA8, size);
    built_ = admission.welcome;
    shown_ = false;
}

Release ChannelShow::play() {
    while (const std::optional<StateFrame> state = session_.nextFrame()) {
        FrameTimes times{.state = session_.stateArrival()};
        draw(*state);
        waitForGpu();
        times.ready = now();
        const Release release = session_.readyThenWait(state->frame);
        if (release == Release::Rejoin || release == Release::Quit) return release;
        if (release == Release::Skip) continue;
        context_.swap();
        times.present = now();
        trace_.write(state->frame, times);
        film(state->frame);
        if (!std::exchange(shown_, true)) spdlog::info("showing");
    }
    return session_.interruption();
}

void ChannelShow::draw(const StateFrame& frame) {
    const Overlays overlays = controls_.overlays();
    picture_->drawScene(frame, overlays);
    const glm::ivec2 window = context_.framebufferPixels();
    const bool fits = context_.hasWindow() && window == picture_->sizePixels();
    picture_->project(fits ? 0 : offscreen_->framebuffer(), Encoding::Dithered8, overlays);
    if (context_.hasWindow() && !fits) fitIntoWindow(*offscreen_, window);
}

void ChannelShow::film(Frame frame) {
    if (options_.filmEvery <= 0 || options_.snapshotFolder.empty()) return;
    if (frame.value % static_cast<std::uint64_t>(options_.filmEvery) != 0) return;
    writeSnapshot(filmFolder(options_.snapshotFolder, frame),
                  options_.channel,
                  *picture_,
                  PictureBits::Dithered8);
}

}  // namespace aquarama
