// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/mailbox.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace aquarama::session {

namespace {

constexpr net::Duration kBetweenCalls = std::chrono::milliseconds(250);  // of whileWaiting()

}  // namespace

void Mailbox::admit(Admitted admitted) {
    const std::lock_guard lock(mutex_);
    if (!join_) join_ = std::move(admitted);
    changed_.notify_all();
}

void Mailbox::refuse(const std::string& reason) {
    const std::lock_guard lock(mutex_);
    if (!join_) join_ = Refused{reason};
    changed_.notify_all();
}

void Mailbox::start(wire::Pace pace, Frame first) {
    const std::lock_guard lock(mutex_);
    pace_ = pace;
    next_ = first;
    changed_.notify_all();
}

void Mailbox::startAnew(wire::Pace pace, Frame first, std::optional<std::uint32_t> renumbered) {
    const std::lock_guard lock(mutex_);
    pace_ = pace;
    next_ = first;
    states_.clear();
    finished_.clear();
    release_.reset();
    if (renumbered) nextLook_.reset();  // of another run
    renumbered_ = renumbered;
    isForgotten_ = true;
    changed_.notify_all();
}

void Mailbox::put(ArrivedState arrived) {
    const std::lock_guard lock(mutex_);
    const auto isSame = [&](const ArrivedState& s) { return s.state.frame == arrived.state.frame; };
    if (std::ranges::any_of(states_, isSame)) return;  // sent again for another node
    if (states_.size() == kStates) states_.pop_front();
    states_.push_back(std::move(arrived));
    changed_.notify_all();
}

void Mailbox::release(const ReleaseOrder& order) {
    const std::lock_guard lock(mutex_);
    if (!release_ || release_->frame < order.frame) release_ = order;
    changed_.notify_all();
}

void Mailbox::tellMind(ExplainedMind explanation) {
    const std::lock_guard lock(mutex_);
    mind_ = std::move(explanation);
}

void Mailbox::offerNextLook(Admitted next) {
    const std::lock_guard lock(mutex_);
    nextLook_ = std::move(next);
}

void Mailbox::offerSkins(std::shared_ptr<const body::SkinsByNumber> skins) {
    const std::lock_guard lock(mutex_);
    skins_ = std::move(skins);
}

std::shared_ptr<const body::SkinsByNumber> Mailbox::takeSkins() {
    const std::lock_guard lock(mutex_);
    return std::exchange(skins_, {});
}

std::optional<Admitted> Mailbox::takeNextLook() {
    const std::lock_guard lock(mutex_);
    return std::exchange(nextLook_, {});
}

std::optional<FinishedFrame> Mailbox::takeFinished() {
    const std::lock_guard lock(mutex_);
    if (finished_.empty()) return std::nullopt;
    const FinishedFrame first = finished_.front();
    finished_.pop_front();
    return first;
}

void Mailbox::interrupt(Release why) {
    const std::lock_guard lock(mutex_);
    if (interruption_ != Release::Quit) interruption_ = why;
    changed_.notify_all();
}

void Mailbox::expectJoin() {
    const std::lock_guard lock(mutex_);
    if (interruption_ == Release::Quit) return;
    join_.reset();
    interruption_.reset();
    pace_.reset();
    next_ = {};  // frames of another run of the master may come before start()
    states_.clear();
    finished_.clear();
    release_.reset();
    mind_.reset();
    nextLook_.reset();
    renumbered_.reset();
    isForgotten_ = false;
}

void Mailbox::await(std::unique_lock<std::mutex>& lock, const std::function<bool()>& isDone) {
    while (!changed_.wait_for(lock, kBetweenCalls, isDone)) {
        lock.unlock();
        if (whileWaiting_) whileWaiting_();
        lock.lock();
    }
}

JoinOutcome Mailbox::awaitJoin() {
    std::unique_lock lock(mutex_);
    const auto isOver = [&] { return interruption_ == Release::Quit; };
    await(lock, [&] { return join_ || isOver(); });
    if (isOver()) return Ended{};
    return *std::exchange(join_, {});
}

// Lockstep: every frame in order. Live: the newest.
std::optional<ArrivedState> Mailbox::takeNext() {
    std::erase_if(states_, [&](const ArrivedState& s) { return s.state.frame < next_; });
    if (!pace_ || states_.empty()) return std::nullopt;
    const auto frameOf = [](const ArrivedState& s) { return s.state.frame; };
    auto chosen = *pace_ == wire::Pace::Live ? std::ranges::max_element(states_, {}, frameOf)
                                             : std::ranges::find(states_, next_, frameOf);
    if (chosen == states_.end()) return std::nullopt;
    ArrivedState taken = std::move(*chosen);
    states_.erase(chosen);
    next_ = {taken.state.frame.value + 1};
    taken.renumbered = std::exchange(renumbered_, {});
    isForgotten_ = false;
    return taken;
}

std::optional<ArrivedState> Mailbox::takeState() {
    std::unique_lock lock(mutex_);
    std::optional<ArrivedState> taken;
    await(lock, [&] { return interruption_ || (taken = takeNext()); });
    return taken;
}

void Mailbox::finish(const FinishedFrame& finished) {
    const std::lock_guard lock(mutex_);
    if (isForgotten_) return;
    if (finished_.size() == kStates) finished_.pop_front();
    finished_.push_back(finished);
}

std::optional<ReleaseOrder> Mailbox::awaitRelease(Frame frame) {
    std::unique_lock lock(mutex_);
    const auto isReleased = [&] { return release_ && release_->frame >= frame; };
    const auto isOver = [&] { return isForgotten_ || interruption_; };
    await(lock, [&] { return isReleased() || isOver(); });
    if (isForgotten_) return ReleaseOrder{frame, {}};
    return isReleased() ? release_ : std::nullopt;  // the last frame is shown before the end
}

std::optional<ExplainedMind> Mailbox::latestMind() const {
    const std::lock_guard lock(mutex_);
    return mind_;
}

Release Mailbox::interruption() const {
    const std::lock_guard lock(mutex_);
    return interruption_.value_or(Release::Quit);
}

}  // namespace aquarama::session
