// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/channel_show.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "common/base/log.h"
#include "render_node/show/channel_picture.h"

namespace aquarama::show {

namespace {

// On CLOCK_MONOTONIC, as FrameTimes.
std::chrono::nanoseconds now() {
    return std::chrono::steady_clock::now().time_since_epoch();
}

// Returns when the GPU has finished all that was submitted. A frame may be called ready only after
// that.
void waitForGpu() {
    constexpr GLuint64 kASecond = 1'000'000'000;
    const GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    while (glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kASecond) == GL_TIMEOUT_EXPIRED) {
    }
    glDeleteSync(fence);
}

// Copies the picture into the window, scaled to fit, with black margins.
void show(const gl::Target& picture, glm::ivec2 window) {
    const auto [corner, size] = fitInto(window, picture.sizePixels());
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
                           corner.x + size.x,
                           corner.y + size.y,
                           GL_COLOR_BUFFER_BIT,
                           GL_LINEAR);
}

}  // namespace

ChannelShow::ChannelShow(session::Session& session,
                         gl::Context& context,
                         Controls& controls,
                         const NodeOptions& options)
    : session_{session},
      context_{context},
      controls_{controls},
      options_{options},
      trace_{options.traceFolder, options.channel} {
    assert(options_.filmEvery > 0);
    if (!options.filmPipe.empty()) film_ = net::connectFrames(options.filmPipe);
}

void ChannelShow::run(session::Admission first) {
    std::optional<session::Admission> admission = std::move(first);
    while (admission) {
        build(std::move(*admission));
        session_.prepared(bears_);
        const session::Release end = play();
        if (end == session::Release::Quit) break;
        logInfo("lost the master; joining again");
        admission = session_.join();
    }
    if (!shown_ || options_.snapshotFolder.empty()) return;
    if (undrawn_) draw(*undrawn_);
    writeSnapshot(options_.snapshotFolder,
                  options_.channel,
                  *picture_,
                  options_.deep ? PictureBits::Deep16 : PictureBits::Dithered8);
}

// When the same show goes on after an interruption, nothing is built again.
void ChannelShow::build(session::Admission admission) {
    if (built_ && built_->show == admission.show) return;
    const std::size_t channel = channelIndex(admission.rig, options_.channel);
    const glm::ivec2 size = admission.rig.channels[channel].sizePixels;
    if (picture_ && picture_->sizePixels() != size)
        throw Error("channel \"" + options_.channel +
                    "\" has another size than before; start its node again");
    logInfo("building {} x {} pixels on {}", size.x, size.y, context_.description());
    pointing_.emplace(admission.rig, channel);
    watched_.reset();
    offscreen_.emplace(GL_RGBA8, size);
    built_ = std::move(admission);
    shown_ = false;
    chooseQuality();
}

void ChannelShow::buildPicture(config::QualityTier quality) {
    assert(built_.has_value());
    // The old picture goes first, so that the GPU need not hold both.
    picture_.reset();
    picture_.emplace(*built_, channelIndex(built_->rig, options_.channel), quality);
    quality_ = quality;
}

void ChannelShow::chooseQuality() {
    if (built_->quality || built_->pattern != wire::Pattern::World) {
        bears_ = built_->quality.value_or(config::QualityTier::Low);
    } else {
        bears_ =
            finestWithin(kBudgetShare / built_->rig.timing.refreshHertz,
                         [this](config::QualityTier quality) { return secondsAFrame(quality); });
        logInfo("keeps up with quality {}", config::nameOf(bears_));
    }
    if (!picture_ || quality_ != bears_) buildPicture(bears_);
}

double ChannelShow::secondsAFrame(config::QualityTier quality) {
    constexpr int kFrames = 5;
    buildPicture(quality);
    wire::StateFrame frame;
    frame.eye.positionMetres = built_->scene.eye;
    // The first frame is not measured: some drivers compile shaders on first use.
    draw(frame);
    waitForGpu();
    const auto begin = now();
    for (int i = 0; i < kFrames; ++i) draw(frame);
    waitForGpu();
    return std::chrono::duration<double>(now() - begin).count() / kFrames;
}

session::Release ChannelShow::play() {
    while (const std::optional<wire::StateFrame> state = session_.nextFrame()) {
        FrameTimes times{.state = session_.stateArrival()};
        feed(state->eye);
        if (state->quality != quality_) buildPicture(state->quality);
        const bool seen = isSeen(state->frame);
        if (seen) {
            draw(*state);
            waitForGpu();
            refuseLoss();
        }
        // Ready is reported only after the GPU has finished the picture.
        times.ready = now();
        const session::Release release = session_.readyThenWait(state->frame);
        if (release == session::Release::Rejoin || release == session::Release::Quit)
            return release;
        if (release == session::Release::Skip) continue;
        if (seen) context_.swap();
        times.present = now();
        trace_.write(state->frame, times);
        if (film_ && isFilmed(state->frame)) film(state->frame);
        undrawn_ = seen ? std::nullopt : state;
        if (!std::exchange(shown_, true)) logInfo("showing");
    }
    return session_.interruption();
}

// A lost context takes all textures and programs with it. The node ends; a new process builds
// everything again in a few seconds.
void ChannelShow::refuseLoss() const {
    if (const auto loss = context_.loss())
        throw Error("the graphics driver took its context away (" + *loss +
                    "); this node ends, and is to be started again");
}

void ChannelShow::draw(const wire::StateFrame& frame) {
    assert(picture_.has_value());
    const Overlays overlays = controls_.overlays();
    picture_->drawScene(frame, overlays, overlays.mind ? watchMind(frame) : std::nullopt);
    if (!context_.quadBuffered()) return project(overlays, Shown::Display);
    const bool swapped = picture_->stereo().swapEyes;
    glNamedFramebufferDrawBuffer(0, swapped ? GL_BACK_RIGHT : GL_BACK_LEFT);
    project(overlays, Shown::LeftEye);
    glNamedFramebufferDrawBuffer(0, swapped ? GL_BACK_LEFT : GL_BACK_RIGHT);
    project(overlays, Shown::RightEye);
}

void ChannelShow::project(const Overlays& overlays, Shown shown) {
    const glm::ivec2 window = context_.framebufferPixels();
    const bool fits = context_.hasWindow() && window == picture_->sizePixels();
    picture_->project(fits ? 0 : offscreen_->framebuffer(), Encoding::Dithered8, overlays, shown);
    if (context_.hasWindow() && !fits) show(*offscreen_, window);
}

void ChannelShow::feed(const wire::Eye& eye) {
    while (const auto pinch = controls_.nextPinch()) {
        const auto pixel = pixelAt(pinch->place);
        const auto place = pixel ? pointing_->pinchAt(*pixel, eye) : std::nullopt;
        if (place) session_.dropFood(*place);
    }
}

std::optional<glm::vec2> ChannelShow::pixelAt(const WindowPlace& place) const {
    if (!place) return pointing_->middle();
    return picturePlace(context_.framebufferPixels(), picture_->sizePixels(), *place);
}

// The fish is chosen only as often as the master is asked, because the nearest fish may change at
// any time and the text must stay long enough to be read.
std::optional<WatchedMind> ChannelShow::watchMind(const wire::StateFrame& frame) {
    constexpr std::chrono::milliseconds kBetweenQuestions{250};
    if (now() - askedAt_ >= kBetweenQuestions) {
        askedAt_ = now();
        const auto pixel = pixelAt(controls_.pointer()).value_or(pointing_->middle());
        watched_ = picture_->fishNearest(frame, pixel);
        if (watched_) session_.askMind(*watched_);
    }
    if (!watched_) return std::nullopt;
    WatchedMind mind{*watched_, {}};
    auto latest = session_.latestMind();
    if (latest && latest->fish == mind.fish) mind.lines = std::move(latest->lines);
    return mind;
}

void ChannelShow::film(Frame frame) {
    Picture taken = takePicture(*picture_, PictureBits::Dithered8, flat(*picture_));
    film_->send({frame.value, taken.sizePixels.x, taken.sizePixels.y, std::move(taken.rgb)});
}

bool ChannelShow::isFilmed(Frame frame) const {
    return frame.value % static_cast<std::uint64_t>(options_.filmEvery) == 0;
}

// Without a window only the clip takes pictures: frames that it skips are not drawn.
bool ChannelShow::isSeen(Frame frame) const {
    return context_.hasWindow() || !film_ || isFilmed(frame);
}

std::optional<motion::PresentedFish> presentedFish(const wire::StateFrame& frame,
                                                   std::span<const motion::FishTraits> school,
                                                   std::size_t place) {
    if (place >= std::min(frame.after.size(), school.size())) return std::nullopt;
    // Without a record of the tick before, the frame shows the later tick.
    const bool between = frame.before.size() == frame.after.size();
    const motion::FishRecord& before = between ? frame.before[place] : frame.after[place];
    return motion::present(
        before, frame.after[place], between ? frame.fraction : 1.0F, school[place]);
}

std::vector<motion::PresentedFish> presentedFish(const wire::StateFrame& frame,
                                                 std::span<const motion::FishTraits> school) {
    std::vector<motion::PresentedFish> fish;
    const std::size_t count = std::min(frame.after.size(), school.size());
    fish.reserve(count);
    for (std::size_t i = 0; i < count; ++i) fish.push_back(*presentedFish(frame, school, i));
    return fish;
}

void presentFood(const wire::StateFrame& frame, std::vector<scene::FoodParticle>& food) {
    const bool between = frame.foodBefore.size() == frame.foodAfter.size();
    food.clear();
    food.reserve(frame.foodAfter.size());
    for (std::size_t i = 0; i < frame.foodAfter.size(); ++i) {
        const wire::FoodRecord after = frame.foodAfter[i];
        if (after.kind() == wire::FoodRecord::Kind::None) continue;
        const wire::FoodRecord before = between ? frame.foodBefore[i] : after;
        const bool isSame =
            before.kind() == after.kind() && before.generation() == after.generation();
        const glm::vec3 to = after.offsetMetres();
        const glm::vec3 from = isSame ? before.offsetMetres() : to;
        food.push_back({frame.foodOriginMetres + glm::mix(from, to, frame.fraction),
                        static_cast<std::uint32_t>(4 * i + after.generation()),
                        after.kind() == wire::FoodRecord::Kind::Pellet});
    }
}

double presentedSeconds(const wire::StateFrame& frame) {
    const double ticks =
        static_cast<double>(frame.tick.value) - 1 + static_cast<double>(frame.fraction);
    return std::max(ticks, 0.0) / kTicksPerSecond;
}

glm::dmat4 wallFromWorld(const wire::Eye& eye) {
    const glm::dmat4 wallFromWorldRotation =
        glm::mat4_cast(glm::conjugate(glm::dquat(eye.worldFromWall)));
    return glm::translate(wallFromWorldRotation, -glm::dvec3(eye.positionMetres));
}

Trace::Trace(const std::string& folder, const std::string& name) {
    if (folder.empty()) return;
    const std::string path = folder + "/" + name + ".csv";
    file_.open(path, std::ios::trunc);
    file_.close();
    // Now empty, and opened for appending: where another program empties the file meanwhile, the
    // next line starts at its new end.
    file_.open(path, std::ios::app);
    if (!(file_ << "frame,state_ns,ready_ns,present_ns\n" << std::flush))
        throw Error(path + ": cannot be written; choose a folder that exists for --trace");
}

void Trace::write(Frame frame, const FrameTimes& times) {
    if (!file_.is_open()) return;
    file_ << frame.value << ',' << times.state.count() << ',' << times.ready.count() << ','
          << times.present.count() << '\n'
          << std::flush;
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
