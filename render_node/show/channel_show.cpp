// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/channel_show.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "common/base/log.h"
#include "render_node/gl/program.h"
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

// Copies a texture into framebuffer 0 of a window, scaled to fit, with black margins.
void copyToWindow(const gl::Target& picture, glm::ivec2 window, GLenum buffer) {
    const auto [corner, size] = fitInto(window, picture.sizePixels());
    const gl::Framebuffer from;  // framebuffers belong to one context, textures to all
    glNamedFramebufferTexture(from.name(), GL_COLOR_ATTACHMENT0, picture.texture(), 0);
    glNamedFramebufferDrawBuffer(0, buffer);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glBlitNamedFramebuffer(from.name(),
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
                           size == picture.sizePixels() ? GL_NEAREST : GL_LINEAR);
}

}  // namespace

BuiltLook::BuiltLook(gl::Context& context, const std::string& channel, session::Admission admission)
    : admission_{std::move(admission)},
      channel_{channelIndex(admission_.rig, channel)},
      wall_{std::make_shared<const wall::Wall>(admission_.rig)},
      workspace_{context.makeWorkspace()} {
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
    drawEmpty();
    waitForGpu();
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

double BuiltLook::secondsAFrame(config::QualityTier quality) {
    constexpr int kFrames = 5;
    bringTo(quality);
    drawEmpty();  // not measured
    waitForGpu();
    const auto begin = now();
    for (int i = 0; i < kFrames; ++i) drawEmpty();
    waitForGpu();
    return std::chrono::duration<double>(now() - begin).count() / kFrames;
}

ChannelShow::ChannelShow(session::Session& session,
                         gl::Context& context,
                         Controls& controls,
                         machine::ServiceNotifier& service,
                         const NodeOptions& options)
    : session_{session},
      context_{context},
      controls_{controls},
      service_{service},
      options_{options},
      trace_{options.traceFolder, options.channel} {
    assert(options_.filmEvery > 0);
    if (!options.filmPipe.empty()) film_ = net::connectFrames(options.filmPipe);
}

// A stage that is still being built is waited for: it uses the context.
ChannelShow::~ChannelShow() {
    if (stage_) stage_->workspace().release();
}

void ChannelShow::run(session::Admission first) {
    std::optional<session::Admission> admission = std::move(first);
    if (const std::string& address = admission->rig.watchAddress; !address.empty())
        console_.emplace(options_.channel, address, options_.keys);
    while (admission) {
        build(std::move(*admission));
        session_.prepared(stage_->admission().look, stage_->bears());
        service_.ready();
        const session::Release end = play();
        if (end == session::Release::Quit) break;
        logInfo("lost the master; joining again");
        service_.status("the master is gone; waiting for it");
        admission = session_.join();
    }
    if (shown_ && !options_.snapshotFolder.empty()) writePicture();
    trace_.close();
}

void ChannelShow::writePicture() {
    stage_->workspace().makeCurrent();
    if (undrawn_) draw(*undrawn_);
    writeSnapshot(options_.snapshotFolder,
                  options_.channel,
                  stage_->picture(),
                  options_.deep ? PictureBits::Deep16 : PictureBits::Dithered8);
}

// When the same show goes on after an interruption, nothing is built again.
void ChannelShow::build(session::Admission admission) {
    const std::uint32_t look = admission.look;
    next_.reset();
    isStale_ = building_.valid();  // of another run of the master: its numbers mean nothing now
    if (stage_ && stage_->admission().show == admission.show) return stage_->renumber(look);
    const std::size_t channel = channelIndex(admission.rig, options_.channel);
    if (stage_ && stage_->picture().sizePixels() != admission.rig.channels[channel].sizePixels)
        throw Error("channel \"" + options_.channel +
                    "\" has another size than before; start its node again");
    stage_.reset();  // first, so that the GPU need not hold both
    service_.beginLongWork("building what is shown");
    enter(std::make_unique<BuiltLook>(context_, options_.channel, std::move(admission)));
    service_.endLongWork();
    shown_ = false;
}

void ChannelShow::enter(std::unique_ptr<BuiltLook> stage) {
    stage_ = std::move(stage);
    lookedAt_.clear();
    session_.describe({options_.build, stage_->renderer(), options_.monitors});
    pointing_.emplace(stage_->admission().rig,
                      channelIndex(stage_->admission().rig, options_.channel),
                      stage_->wall());
    watched_.reset();
}

void ChannelShow::buildNext() {
    if (!building_.valid()) {
        auto admission = session_.nextLook();
        if (!admission) return;
        const auto build = [this](session::Admission what) {
            auto stage = std::make_unique<BuiltLook>(context_, options_.channel, std::move(what));
            stage->workspace().release();
            return stage;
        };
        building_ = std::async(std::launch::async, build, std::move(*admission));
    }
    if (building_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    try {
        next_ = building_.get();
    } catch (const Error& problem) {  // the wall goes on with the present one
        logError("the next look cannot be built: {}", problem.what());
        return;
    }
    if (std::exchange(isStale_, false)) return next_.reset();
    session_.prepared(next_->admission().look, next_->bears());
}

bool ChannelShow::bringOn(std::uint32_t look) {
    if (look == stage_->admission().look) return true;
    if (!next_ || next_->admission().look != look) return false;
    stage_->workspace().release();
    retiring_ =
        std::async(std::launch::async, [old = std::move(stage_)]() mutable { old.reset(); });
    next_->workspace().makeCurrent();
    enter(std::move(next_));
    return true;
}

void ChannelShow::bringTo(config::QualityTier quality) {
    if (quality == stage_->quality()) return;
    service_.beginLongWork("building another quality");
    stage_->bringTo(quality);
    service_.endLongWork();
}

session::Release ChannelShow::play() {
    // On the target, for the operator's console. Looked at after nextFrame(): until then this
    // thread has real-time priority, and would keep other nodes of its machine from their release.
    std::optional<wire::StateFrame> presented;
    while (std::optional<wire::StateFrame> state = session_.nextFrame()) {
        if (presented) showOperator(*std::exchange(presented, {}));
        FrameTimes times{.state = session_.stateArrival()};
        controls_.show(state->show);
        buildNext();
        if (!bringOn(state->show.look)) return session::Release::Rejoin;
        feed(state->eye);
        bringTo(state->show.quality);
        const bool seen = isSeen(state->frame);
        if (seen) {
            draw(*state);
            fillWindow();
        }
        // Ready is reported only after the GPU has finished the picture.
        times.ready = now();
        const session::Release release = session_.readyThenWait(state->frame);
        if (release == session::Release::Rejoin || release == session::Release::Quit)
            return release;
        if (release == session::Release::Skip) continue;
        if (seen) context_.swap();
        times.present = now();
        service_.alive(++framesShown_);
        watchBlanks(state->frame);
        trace_.write(state->frame, times);
        if (film_ && isFilmed(state->frame)) film(state->frame);
        undrawn_ = seen ? std::nullopt : state;
        if (seen && console_) presented = std::move(state);
        if (!std::exchange(shown_, true)) logInfo("showing");
    }
    return session_.interruption();
}

void ChannelShow::showOperator(const wire::StateFrame& frame) {
    constexpr std::size_t kRemembered = 4;
    PictureReader& reader = stage_->reader();
    if (reader.isBusy()) {
        stage_->workspace().makeCurrent();
        if (auto picture = reader.take())
            console_->put(lookedAt_.back().frame, std::move(*picture));
    } else if (const auto width = console_->wantedWidth()) {
        stage_->workspace().makeCurrent();
        reader.begin(stage_->target(), *width);
        lookedAt_.push_back(frame);
        if (lookedAt_.size() > kRemembered) lookedAt_.pop_front();
    }
    nameFish();
}

void ChannelShow::nameFish() {
    while (const auto question = console_->nextQuestion()) {
        if (lookedAt_.empty()) return;
        const auto same = std::ranges::find(lookedAt_, question->frame, &wire::StateFrame::frame);
        const wire::StateFrame& frame = same == lookedAt_.end() ? lookedAt_.back() : *same;
        const glm::vec2 pixel = question->place * glm::vec2(stage_->picture().sizePixels());
        console_->answer(*question, frame.frame, stage_->picture().fishNearest(frame, pixel));
    }
}

// Not after every frame: it asks the display server.
void ChannelShow::watchBlanks(Frame frame) {
    constexpr std::uint64_t kEvery = 16;
    if (frame.value % kEvery != 0) return;
    const auto blank = context_.lastBlank();
    if (!blank) return;
    const bool isOurClock = blank->at <= now() && now() - blank->at < std::chrono::seconds(1);
    if (isOurClock) session_.sawBlank(blank->count, blank->at);
}

// A lost context takes all textures and programs with it. The node ends; a new process builds
// everything again in a few seconds.
void ChannelShow::refuseLoss() const {
    if (const auto loss = context_.loss())
        throw Error("the graphics driver took its context away (" + *loss +
                    "); this node ends, and is to be started again");
}

void ChannelShow::draw(const wire::StateFrame& frame) {
    ChannelPicture& picture = stage_->picture();
    const Overlays overlays = controls_.overlays();
    stage_->workspace().makeCurrent();
    picture.drawScene(frame, overlays, overlays.mind ? watchMind(frame) : std::nullopt);
    if (!context_.quadBuffered()) {
        picture.project(
            stage_->target().framebuffer(), Encoding::Dithered8, overlays, Shown::Display);
    } else {
        for (const Shown eye : {Shown::LeftEye, Shown::RightEye})
            picture.project(stage_->target(eye).framebuffer(), Encoding::Dithered8, overlays, eye);
    }
    waitForGpu();
    refuseLoss();
}

// Into the back buffer, so that a swap shows it at once. The window's context is current
// afterwards.
void ChannelShow::fillWindow() {
    if (!context_.hasWindow()) return;
    stage_->workspace().release();
    context_.makeCurrent();
    const glm::ivec2 window = context_.framebufferPixels();
    if (!context_.quadBuffered()) {
        copyToWindow(stage_->target(), window, GL_BACK);
    } else {
        const bool swapped = stage_->picture().stereo().swapEyes;
        copyToWindow(
            stage_->target(swapped ? Shown::RightEye : Shown::LeftEye), window, GL_BACK_LEFT);
        copyToWindow(
            stage_->target(swapped ? Shown::LeftEye : Shown::RightEye), window, GL_BACK_RIGHT);
    }
    waitForGpu();
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
    return picturePlace(context_.framebufferPixels(), stage_->picture().sizePixels(), *place);
}

// The fish is chosen only as often as the master is asked, because the nearest fish may change at
// any time and the text must stay long enough to be read.
std::optional<WatchedMind> ChannelShow::watchMind(const wire::StateFrame& frame) {
    constexpr std::chrono::milliseconds kBetweenQuestions{250};
    if (now() - askedAt_ >= kBetweenQuestions) {
        askedAt_ = now();
        const auto pixel = pixelAt(controls_.pointer()).value_or(pointing_->middle());
        watched_ = stage_->picture().fishNearest(frame, pixel);
        if (watched_) session_.askMind(*watched_);
    }
    if (!watched_) return std::nullopt;
    WatchedMind mind{*watched_, {}};
    auto latest = session_.latestMind();
    if (latest && latest->fish == mind.fish) mind.lines = std::move(latest->lines);
    return mind;
}

void ChannelShow::film(Frame frame) {
    stage_->workspace().makeCurrent();
    Picture taken = takePicture(stage_->picture(), PictureBits::Dithered8, flat(stage_->picture()));
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
    file_ = GrowingFile(folder + "/" + name + ".csv");
    file_.append("frame,state_ns,ready_ns,present_ns\n");
}

void Trace::write(Frame frame, const FrameTimes& times) {
    if (!file_.isOpen()) return;
    file_.appendOrLog(fmt::format("{},{},{},{}\n",
                                  frame.value,
                                  times.state.count(),
                                  times.ready.count(),
                                  times.present.count()));
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
