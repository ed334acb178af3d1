// SPDX-License-Identifier: Apache-2.0
#include "console/show_link.h"

#include <chrono>
#include <utility>

#include "common/base/log.h"

namespace aquarama::console {

namespace {

// Between two questions for the master's state.
constexpr auto kBetweenLooks = std::chrono::milliseconds(100);
// Of commands that wait for the link's thread.
constexpr std::size_t kMostWanted = 64;

}  // namespace

ShowLink::ShowLink(const ask::AskedMaster& master, ShowListener listener)
    : client_{master.connect()}, listener_{std::move(listener)}, thread_{[this] { run(); }} {}

// Waits for the question that is under way.
ShowLink::~ShowLink() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

// Of a flood the rest is lost: it is repeated by whoever wants it.
void ShowLink::give(v1::Order order) {
    {
        const std::lock_guard lock(mutex_);
        if (wanted_.size() < kMostWanted) wanted_.push_back(std::move(order));
        hasNew_ = true;
    }
    changed_.notify_all();
}

// At the next turn, together with all that waits.
void ShowLink::giveAgain(v1::Order order) {
    const std::lock_guard lock(mutex_);
    if (wanted_.size() < kMostWanted) wanted_.push_back(std::move(order));
}

// The newest counts: it is a state.
void ShowLink::steer(const Steering& steering) {
    {
        const std::lock_guard lock(mutex_);
        steering_ = steering;
    }
    changed_.notify_all();
}

void ShowLink::touch(const WallHands& hands) {
    {
        const std::lock_guard lock(mutex_);
        hands_ = hands;
    }
    changed_.notify_all();
}

// One question at a time.
void ShowLink::explain(std::uint32_t fish) {
    {
        const std::lock_guard lock(mutex_);
        fish_ = fish;
    }
    changed_.notify_all();
}

// At the next turn: a hundred pictures never crowd the master.
void ShowLink::askSkin(std::uint32_t number) {
    const std::lock_guard lock(mutex_);
    skin_ = number;
}

// Ten times a second, and at once for new orders, hands and questions.
void ShowLink::run() {
    std::unique_lock lock(mutex_);
    while (!ended_) {
        lock.unlock();
        try {
            work();
        } catch (const Error&) {  // nobody answers
            listener_.silent(client_.preparing());
        }
        lock.lock();
        changed_.wait_for(lock, kBetweenLooks, [this] {
            return ended_ || hasNew_ || steering_ || hands_ || fish_;
        });
    }
}

// A change that takes minutes is asked for again and again, beside all others.
void ShowLink::work() {
    std::deque<v1::Order> wanted;
    std::optional<Steering> steering;
    std::optional<WallHands> hands;
    std::optional<std::uint32_t> fish;
    {
        const std::lock_guard lock(mutex_);
        wanted = std::exchange(wanted_, {});
        hasNew_ = false;
        steering = std::exchange(steering_, {});
        hands = std::exchange(hands_, {});
        fish = std::exchange(fish_, {});
    }
    if (steering) client_.steer(*steering);
    if (hands) client_.touch(*hands);
    try {
        for (v1::Order& order : wanted) press(order);
    } catch (const Error& problem) {
        for (const v1::Order& order : wanted)
            listener_.said(order.request(), {ask::Outcome::Lost, problem.what()});
        throw;
    }
    if (fish) listener_.explained(client_.explain(*fish));
    const v1::StatusReply status = client_.status();
    listener_.heard(status, client_.run());
    hearDrawings(status);
}

// The list is asked for where it has changed.
void ShowLink::hearDrawings(const v1::StatusReply& status) {
    if (!status.has_drawings_version()) return;
    std::uint32_t skin = 0;
    {
        const std::lock_guard lock(mutex_);
        skin = std::exchange(skin_, 0);
    }
    const std::pair now{client_.run(), status.drawings_version()};
    if (skin == 0 && now == listed_) return;
    const v1::DrawingsReply reply = client_.drawings(skin);
    listed_ = {client_.run(), reply.version()};
    listener_.listed(reply);
}

// Asked once; what takes longer is asked for again at the next turn. An offer that was taken is
// told its number.
void ShowLink::press(v1::Order& order) {
    const v1::OrderReply reply = client_.give(order);
    const std::uint64_t id = order.request();
    if (reply.request() != id) return giveAgain(std::move(order));  // an answer to another
    const std::string what =
        reply.has_drawing() ? "drawing " + std::to_string(reply.drawing()) : reply.reason();
    listener_.said(id, {static_cast<ask::Outcome>(reply.outcome()), what});
    if (reply.outcome() == v1::OrderReply::WAITING) giveAgain(std::move(order));
}

}  // namespace aquarama::console
