// SPDX-License-Identifier: Apache-2.0
#include "guests/wall_link.h"

#include <chrono>
#include <utility>

#include "common/base/log.h"

namespace aquarama::guests {

namespace {

using std::chrono::milliseconds;

constexpr auto kBetweenHands = milliseconds(34);   // between two turns of the thread, at least,
constexpr auto kBetweenLooks = milliseconds(100);  // and at most
constexpr net::Duration kBetweenSigns = milliseconds(1000);
constexpr std::size_t kMostFood = 16;  // that waits for the thread

}  // namespace

void WallLink::begin(std::function<void(const std::optional<WallState>&)> heard) {
    heard_ = std::move(heard);
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
            heard_(std::nullopt);
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
    heard_(WallState{.isOpen = status.guests(),
                     .eye = wire::readEye(status.eye()).value_or(wire::Eye{})});
    if (status.guests()) showSign();
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
