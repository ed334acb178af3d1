// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/shown_patterns.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

#include "common/ask/request_client.h"
#include "common/base/log.h"

namespace aquarama::scan {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kBetweenQuestions = 20ms;
constexpr auto kBetweenWords = 1s;  // a third of the master's patience

std::uint64_t freshHolder() {
    return ask::freshRequest() | 1U;  // never 0
}

}  // namespace

// One connection for two threads: one shows patterns, the other renews the hold.
class ShownPatterns::Link {
  public:
    explicit Link(const ShownOn& where)
        : client_{ask::AskedMaster{where.rig, where.master, where.key}.connect()},
          patience_{where.patience},
          speaker_{[this](const std::stop_token& stop) { sayAgain(stop); }} {}

    std::uint64_t show(const config::ScanPattern& pattern) {
        const auto giveUp = Clock::now() + patience_;
        while (true) {
            const v1::OrderReply reply = say(pattern);
            if (reply.outcome() == v1::OrderReply::DONE) return reply.frame();
            if (Clock::now() > giveUp)
                throw Error("pattern " + std::to_string(pattern.number) + " is " + reply.reason() +
                            " after " + std::to_string(patience_ / 1s) +
                            " s; look after these nodes (aquarama status)");
            std::this_thread::sleep_for(kBetweenQuestions);
        }
    }

    void confirm() {
        const std::optional<v1::OrderReply> reply = sayHeld();
        if (!reply) throw Error("no pattern of the scan is shown; scan again");
        if (reply->outcome() != v1::OrderReply::DONE)
            throw Error("the pattern of the scan is " + reply->reason() +
                        " any more; look after these nodes (aquarama status)");
    }

    void giveBack() {
        const std::lock_guard lock(mutex_);
        if (std::exchange(isOver_, true) || !held_) return;
        held_.reset();
        v1::Order order;
        order.set_request(ask::freshRequest());
        order.mutable_scan()->set_holder(holder_);
        client_.give(order);
    }

  private:
    v1::OrderReply say(const config::ScanPattern& pattern) {
        const std::lock_guard lock(mutex_);
        if (isOver_) throw Error("the scan was ended; the wall shows its scene again");
        v1::OrderReply reply = ask(pattern);
        held_ = pattern;
        return reply;
    }

    // The pattern is read and sent under one lock, so that an older pattern never replaces a newer.
    std::optional<v1::OrderReply> sayHeld() {
        const std::lock_guard lock(mutex_);
        return held_ ? std::optional(ask(*held_)) : std::nullopt;
    }

    // Throws Error where the master refuses it.
    v1::OrderReply ask(const config::ScanPattern& pattern) {
        v1::Order order;
        order.set_request(ask::freshRequest());
        order.mutable_scan()->set_holder(holder_);
        wire::writeScanPattern(pattern, *order.mutable_scan()->mutable_pattern());
        v1::OrderReply reply = client_.give(order);
        if (reply.outcome() == v1::OrderReply::REFUSED)
            throw Error("the master refuses to show a scan: " + reply.reason() +
                        "; see aquarama status");
        return reply;
    }

    // Errors are left to the next show() or confirm(), which ask the same.
    void sayAgain(const std::stop_token& stop) {
        std::mutex mutex;
        std::unique_lock lock(mutex);
        while (!wake_.wait_for(lock, stop, kBetweenWords, [&] { return stop.stop_requested(); }))
            try {
                sayHeld();
            } catch (const std::exception& problem) {
                logWarning("the wall is not held at the moment: {}", problem.what());
            }
    }

    const std::uint64_t holder_ = freshHolder();
    std::mutex mutex_;  // guards the members below
    ask::RequestClient client_;
    std::optional<config::ScanPattern> held_;
    bool isOver_ = false;

    std::chrono::milliseconds patience_;
    std::condition_variable_any wake_;
    std::jthread speaker_;  // last: it uses the rest
};

ShownPatterns::ShownPatterns(const ShownOn& where) : link_{std::make_unique<Link>(where)} {}

ShownPatterns::~ShownPatterns() {
    giveBack();
}

std::uint64_t ShownPatterns::show(const config::ScanPattern& pattern) {
    return link_->show(pattern);
}

void ShownPatterns::confirm() {
    link_->confirm();
}

void ShownPatterns::giveBack() noexcept {
    try {
        link_->giveBack();
    } catch (const std::exception& problem) {
        logWarning("the wall was not given back, it comes back by itself: {}", problem.what());
    }
}

}  // namespace aquarama::scan
