// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/channel_show.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

#include "common/base/log.h"
#include "render_node/show/poster.h"
#include "render_node/show/snapshot.h"
#include "render_node/show/window_fit.h"

namespace aquarama::show {

namespace {

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

// Who is brought pictures, and with which keys.
struct Watcher {
    std::string address;
    std::optional<net::PeerKeys> keys;
};

// The console, and the program that serves visitors, where the rig has them. The console has the
// master's key; that program has its own, as strangers speak to it.
std::vector<Watcher> watchersOf(const session::Admission& admission,
                                const std::optional<net::PeerKeys>& keys) {
    const config::Rig& rig = admission.rig;
    std::vector<Watcher> watchers;
    if (!rig.sides.watch.empty()) watchers.push_back({rig.sides.watch, keys});
    const bool isShown = rig.guests && !rig.guests->picturesAddress.empty();
    if (!isShown || (keys && admission.guestsKey.empty())) return watchers;
    watchers.push_back({rig.guests->picturesAddress, keys});
    if (keys) watchers.back().keys->master = admission.guestsKey;
    return watchers;
}

}  // namespace

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

// Waits for a look that is still being built: it uses the context.
ChannelShow::~ChannelShow() {
    if (stage_) stage_->workspace().release();
}

void ChannelShow::run(session::Admission first) {
    std::optional<session::Admission> admission = std::move(first);
    for (const Watcher& watcher : watchersOf(*admission, options_.keys))
        watchers_.emplace_back(options_.channel, watcher.address, watcher.keys);
    while (admission) {
        build(std::move(*admission));
        session_.prepared(stage_->admission().look, stage_->bears(), stage_->motion());
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
    if (options_.panoramaScale > 1) writePanorama();
}

void ChannelShow::writePanorama() {
    const std::string path = options_.snapshotFolder + "/panorama.png";
    const std::optional<DrawnWorld> world = stage_->picture().drawnWorld();
    if (!world)
        throw Error(path + ": the last frame shows a pattern; a scaled panorama needs the world");
    service_.beginLongWork("drawing the panorama");
    const Poster poster(*stage_->wall(),
                        *world,
                        {.panoramaPixels = stage_->admission().rig.panoramaPixels,
                         .scale = options_.panoramaScale,
                         .quality = stage_->quality()});
    writePoster(path, poster, options_.deep ? PictureBits::Deep16 : PictureBits::Dithered8);
    service_.endLongWork();
}

// When the same show goes on after an interruption, nothing is built again.
void ChannelShow::build(session::Admission admission) {
    if (stage_ && stage_->admission().show == admission.show) return renumber(admission.look);
    next_.reset();
    isStale_ = building_.valid();
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
    isUndressed_ = true;
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
    session_.prepared(next_->admission().look, next_->bears(), next_->motion());
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
    isUndressed_ = true;
    service_.endLongWork();
}

session::Release ChannelShow::play() {
    // The frame on the target, for whoever watches. It is read after nextFrame(): until then
    // this thread has real-time priority and would delay other nodes of its machine.
    std::optional<wire::StateFrame> presented;
    isUndressed_ = true;  // of what was painted while the node was away
    while (std::optional<wire::StateFrame> state = session_.nextFrame()) {
        if (presented) showWatchers(*std::exchange(presented, {}));
        FrameTimes times{.state = session_.stateArrival()};
        followMaster();
        controls_.show(state->show);
        buildNext();
        if (!bringOn(state->show.look)) return session::Release::Rejoin;
        feed(state->eye);
        touch(net::monotonicNow());
        bringTo(state->show.quality);
        dress();
        const bool seen = isSeen(state->frame);
        if (seen) {
            draw(*state);
            fillWindow();
        }
        // Ready is reported only after the GPU has finished the picture.
        times.ready = net::monotonicNow();
        const session::Release release = session_.readyThenWait(state->frame);
        if (release == session::Release::Rejoin || release == session::Release::Quit)
            return release;
        if (release == session::Release::Skip) continue;
        if (seen) context_.swap();
        times.present = net::monotonicNow();
        ++framesShown_;
        service_.alive(isAlone_ ? 0 : framesShown_);  // keeps the status
        watchBlanks(state->frame);
        trace_.write(state->frame, times);
        if (film_ && isFilmed(state->frame)) film(state->frame);
        undrawn_ = seen ? std::nullopt : state;
        if (seen && !watchers_.empty()) presented = std::move(state);
        if (!std::exchange(shown_, true)) logInfo("showing");
    }
    return session_.interruption();
}

void ChannelShow::followMaster() {
    if (const auto look = session_.renumbered()) renumber(*look);
    if (session_.isReckoned() == std::exchange(isAlone_, session_.isReckoned())) return;
    if (!isAlone_) return logInfo("the master leads again");
    logInfo("lost the master; the fish swim on");
    service_.status("the master is gone; the fish swim on");
}

// A look that was being built is one of another run of the master: its number is not valid now.
void ChannelShow::renumber(std::uint32_t look) {
    next_.reset();
    isStale_ = building_.valid();
    stage_->renumber(look);
}

void ChannelShow::dress() {
    if (auto newest = session_.newSkins()) skins_ = std::move(newest);
    stage_->workspace().makeCurrent();
    stage_->picture().wear(*skins_, std::exchange(isUndressed_, false) ? skins_->size() : 1);
}

void ChannelShow::showWatchers(const wire::StateFrame& frame) {
    constexpr std::size_t kRemembered = 4;
    PictureReader& reader = stage_->reader();
    if (reader.isBusy()) {
        stage_->workspace().makeCurrent();
        if (auto picture = reader.take())
            reading_->put(lookedAt_.back().frame, std::move(*picture));
    } else {
        for (WatcherLink& watcher : watchers_) {
            const auto width = watcher.wantedWidth();
            if (!width) continue;
            stage_->workspace().makeCurrent();
            reader.begin(stage_->target(), *width);
            reading_ = &watcher;
            lookedAt_.push_back(frame);
            if (lookedAt_.size() > kRemembered) lookedAt_.pop_front();
            break;
        }
    }
    for (WatcherLink& watcher : watchers_) nameFish(watcher);
}

void ChannelShow::nameFish(WatcherLink& watcher) {
    while (const auto question = watcher.nextQuestion()) {
        if (lookedAt_.empty()) return;
        const auto same = std::ranges::find(lookedAt_, question->frame, &wire::StateFrame::frame);
        const wire::StateFrame& frame = same == lookedAt_.end() ? lookedAt_.back() : *same;
        const glm::vec2 pixel = question->place * glm::vec2(stage_->picture().sizePixels());
        watcher.answer(*question, frame.frame, stage_->picture().fishNearest(frame, pixel));
    }
}

// Not after every frame, as it queries the display server.
void ChannelShow::watchBlanks(Frame frame) {
    constexpr std::uint64_t kEvery = 16;
    if (frame.value % kEvery != 0) return;
    const auto blank = context_.lastBlank();
    if (!blank) return;
    const net::Duration age = net::monotonicNow() - blank->at;
    if (age >= net::Duration{0} && age < std::chrono::seconds(1))
        session_.sawBlank(blank->count, blank->at);
}

// A lost context takes all textures and programs with it. The node ends; a new process builds
// everything again in a few seconds.
void ChannelShow::refuseLoss() const {
    if (const auto loss = context_.loss())
        throw Error("the graphics driver took its context away (" + *loss +
                    "); this node ends; start it again");
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
    gl::waitForGpu();
    refuseLoss();
}

// Copies the picture into the back buffer, so that a swap shows it at once. The window's context is
// current afterwards.
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
    gl::waitForGpu();
}

void ChannelShow::feed(const wire::Eye& eye) {
    while (const auto pinch = controls_.nextPinch()) {
        const auto pixel = pixelAt(pinch->place);
        const auto place = pixel ? pointing_->pinchAt(*pixel, eye) : std::nullopt;
        if (place) session_.dropFood(*place);
    }
}

// A pointer before the wall is a hand.
void ChannelShow::touch(net::Moment now) {
    const WindowPlace place = controls_.heldPointer(now);
    const auto pixel = place ? pixelAt(place) : std::nullopt;
    const auto point = pixel ? pointing_->handAt(*pixel) : std::nullopt;
    if (const auto hands = handPace_.due(point ? WallHands{{1, *point}} : WallHands{}, now))
        session_.touch(*hands);
}

std::optional<glm::vec2> ChannelShow::pixelAt(const WindowPlace& place) const {
    if (!place) return pointing_->middle();
    return picturePlace(context_.framebufferPixels(), stage_->picture().sizePixels(), *place);
}

// The fish is chosen only as often as the master is asked, because the nearest fish may change at
// any time and the text must stay long enough to be read.
std::optional<WatchedMind> ChannelShow::watchMind(const wire::StateFrame& frame) {
    constexpr std::chrono::milliseconds kBetweenQuestions{250};
    if (net::monotonicNow() - askedAt_ >= kBetweenQuestions) {
        askedAt_ = net::monotonicNow();
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

}  // namespace aquarama::show
