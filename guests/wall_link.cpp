// SPDX-License-Identifier: Apache-2.0
#include "guests/wall_link.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/base/log.h"

namespace aquarama::guests {

namespace {

using std::chrono::milliseconds;

constexpr auto kBetweenHands = milliseconds(34);   // between two turns of the thread, at least,
constexpr auto kBetweenLooks = milliseconds(100);  // and at most
constexpr net::Duration kBetweenSigns = milliseconds(1000);
constexpr net::Duration kBetweenQuestions = milliseconds(1000);  // for the same fish
constexpr std::size_t kMostFood = 16;                            // that waits for the thread
constexpr std::size_t kMostOffers = 16;

WallDrawing::Condition conditionOf(const v1::DrawingStatus& drawing) {
    switch (drawing.condition()) {
        case v1::DrawingStatus::SWIMMING:
            return WallDrawing::Condition::Swimming;
        case v1::DrawingStatus::HOMELESS:
            return WallDrawing::Condition::Homeless;
        case v1::DrawingStatus::LEAVING:
            return WallDrawing::Condition::Leaving;
        default:
            return WallDrawing::Condition::Waiting;
    }
}

WallDrawings drawingsIn(const v1::DrawingsReply& reply) {
    WallDrawings drawings;
    for (const v1::DrawingStatus& one : reply.drawings()) {
        WallDrawing& drawing = drawings[one.number()];
        drawing.condition = conditionOf(one);
        if (one.has_fish()) drawing.fish = one.fish();
    }
    return drawings;
}

}  // namespace

void WallLink::begin(WallListener listener) {
    listener_ = std::move(listener);
    thread_ = std::thread([this] { run(); });
}

// Waits for the question that is under way.
void WallLink::end() {
    if (!thread_.joinable()) return;
    set([this] { ended_ = true; });
    thread_.join();
}

void WallLink::set(const std::function<void()>& change) {
    {
        const std::lock_guard lock(mutex_);
        change();
    }
    changed_.notify_all();
}

void WallLink::steer(const Steering& steering) {
    set([&] { wishes_.steering = steering; });
}

void WallLink::feed(const glm::vec3& position) {
    set([&] {
        if (wishes_.food.size() < kMostFood) wishes_.food.push_back(position);
    });
}

void WallLink::show(const wire::Sign& sign) {
    set([&] {
        sign_ = sign;
        isNewSign_ = true;
    });
}

// Of a flood the rest is refused.
void WallLink::offer(OfferedSkin skin) {
    const std::uint64_t request = skin.request;
    bool isTaken = false;
    set([&] {
        isTaken = offers_.size() < kMostOffers;
        if (isTaken) offers_.push_back(std::move(skin));
    });
    if (!isTaken) listener_.offered(request, 0);
}

void WallLink::watch(const std::set<std::uint32_t>& fish) {
    const std::lock_guard lock(mutex_);
    watched_ = fish;
}

void WallLink::run() {
    std::unique_lock lock(mutex_);
    const auto mustEnd = [this] { return ended_; };
    const auto isWanted = [this] {
        return ended_ || wishes_.steering || !wishes_.food.empty() || isNewSign_;
    };
    while (!ended_) {
        const Wishes wishes = std::exchange(wishes_, {});
        lock.unlock();
        try {
            work(wishes);
        } catch (const Error&) {  // nobody answers
            listener_.heard(std::nullopt);
        }
        lock.lock();
        changed_.wait_for(lock, kBetweenHands, mustEnd);
        changed_.wait_for(lock, kBetweenLooks - kBetweenHands, isWanted);
    }
}

// A hand is said first: all else waits for answers.
void WallLink::work(const Wishes& wishes) {
    if (wishes.steering) client_.steer(*wishes.steering, /*yields=*/true);
    for (const glm::vec3& position : wishes.food) client_.feed(position);
    const v1::StatusReply status = client_.status();
    lookAtDrawings(status);
    listener_.heard(WallState{.isOpen = status.guests() && !status.show().black(),
                              .eye = wire::readEye(status.eye()).value_or(wire::Eye{}),
                              .drawings = drawings_});
    if (status.guests()) showSign();
    if (!drawings_) return;
    offerNext();
    explainNext();
}

// All of them, whenever something has changed.
void WallLink::lookAtDrawings(const v1::StatusReply& status) {
    const bool areOn = status.drawings() && status.has_drawings_version();
    if (!areOn) drawings_.reset();
    if (!areOn || (drawings_ && drawingsVersion_ == status.drawings_version())) return;
    const v1::DrawingsReply reply = client_.drawings();
    drawings_ = std::make_shared<const WallDrawings>(drawingsIn(reply));
    drawingsVersion_ = reply.version();
}

// The oldest. It stays until there is an answer: the master takes a request once.
void WallLink::offerNext() {
    v1::Order order;
    {
        const std::lock_guard lock(mutex_);
        if (offers_.empty()) return;
        const OfferedSkin& offer = offers_.front();
        order.set_request(offer.request);
        v1::OfferedDrawing& drawing = *order.mutable_drawing();
        drawing.set_skin(offer.skin);
        drawing.set_species(offer.species);
        drawing.set_aside(offer.aside);
    }
    const v1::OrderReply reply = client_.give(order);
    if (reply.request() != order.request() || reply.outcome() == v1::OrderReply::WAITING) return;
    const bool isDone = reply.outcome() == v1::OrderReply::DONE;
    if (!isDone) logWarning("a visitor's drawing was refused: {}", reply.reason());
    listener_.offered(order.request(), isDone ? reply.drawing() : 0);
    const std::lock_guard lock(mutex_);
    offers_.pop_front();
}

// One at a turn, so that hands do not wait: the one that was asked for longest ago.
void WallLink::explainNext() {
    const net::Moment now = net::monotonicNow();
    std::map<std::uint32_t, net::Moment> asked;
    {
        const std::lock_guard lock(mutex_);
        for (const std::uint32_t fish : watched_) {
            const auto known = explained_.find(fish);
            asked[fish] = known == explained_.end() ? net::Moment{} : known->second;
        }
    }
    explained_ = std::move(asked);
    const auto next =
        std::ranges::min_element(explained_, {}, [](const auto& one) { return one.second; });
    if (next == explained_.end() || now - next->second < kBetweenQuestions) return;
    next->second = now;
    const v1::Explanation told = client_.explain(next->first);
    if (told.fish() == next->first) listener_.does(told.fish(), deedOf(told));
}

// When it changes, and every second. What is refused is said again by then.
void WallLink::showSign() {
    v1::Order order;
    order.set_request(ask::freshRequest());
    {
        const std::lock_guard lock(mutex_);
        const bool isDue = net::monotonicNow() - signShown_ >= kBetweenSigns;
        if (sign_.columns == 0 || (!std::exchange(isNewSign_, false) && !isDue)) return;
        v1::Sign& sign = *order.mutable_sign()->mutable_sign();
        sign.set_columns(sign_.columns);
        sign.set_rows(sign_.rows);
        sign.set_dots(sign_.dots);
    }
    signShown_ = net::monotonicNow();
    client_.give(order);
}

}  // namespace aquarama::guests
