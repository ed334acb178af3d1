// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/connection.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/base/log.h"
#include "common/motion/motor.h"

namespace aquarama::session {
namespace {

constexpr net::Duration kHello = std::chrono::milliseconds(100);
constexpr net::Duration kComplaint = std::chrono::seconds(3);
constexpr net::Duration kNextAddress = std::chrono::milliseconds(250);

// Computed once, as it takes a moment and never changes.
std::uint64_t ownMotorHash() {
    static const std::uint64_t hash = motion::motorSelfTest();
    return hash;
}

}  // namespace

Connection::Connection(std::string name, std::vector<std::string> addresses, net::ConnectTo connect)
    : name_(std::move(name)),
      addresses_(std::move(addresses)),
      connect_(std::move(connect)),
      channels_(connect_(addresses_.front())) {}

void Connection::renew() {
    if (std::exchange(isUsed_, true)) {
        turn_ = (turn_ + 1) % addresses_.size();
        auto fresh = connect_(addresses_[turn_]);
        const std::lock_guard lock(mutex_);
        std::swap(channels_, fresh);
    }
    session_ = 0;
    lastHello_ = {};
    lastRenewal_ = net::monotonicNow();
    if (!hasSeveral() || lastComplaint_ == net::Moment{}) lastComplaint_ = lastRenewal_;
}

void Connection::enter(std::uint64_t session) {
    session_ = session;
    lastDismissal_.clear();
    lastComplaint_ = {};
}

void Connection::alsoAt(const std::string& address) {
    if (std::ranges::find(addresses_, address) == addresses_.end()) addresses_.push_back(address);
}

bool Connection::isOfNewest(const v1::Envelope& message) {
    if (message.session() == 0) return true;  // of no show: "the master prepares"
    const std::uint64_t lease = message.lease_revision();
    if (lease > newestLease_) hasRefused_ = false;
    newestLease_ = std::max(newestLease_, lease);
    if (lease == newestLease_) return true;
    if (!std::exchange(hasRefused_, true))
        logWarning(
            "{}: a master whose lease is {} speaks, after one of {}; nothing that it says counts",
            name_,
            lease,
            newestLease_);
    return false;
}

void Connection::greet(net::Moment now) {
    if (now - lastHello_ >= kHello) {
        v1::Envelope message;
        v1::Hello& hello = *message.mutable_hello();
        hello.set_channel(name_);
        hello.set_major(wire::kProtocolMajor);
        hello.set_build(AQUARAMA_VERSION);
        hello.set_motor_hash(ownMotorHash());
        say(std::move(message));
        lastHello_ = now;
    }
    if (now - lastComplaint_ < kComplaint) {
        if (hasSeveral() && now - lastRenewal_ > kNextAddress) renew();
        return;
    }
    lastComplaint_ = now;
    logWarning("{}: {}; still trying",
               name_,
               lastDismissal_.empty() ? "no master answers (not started, another address, a "
                                        "firewall, or a key that is revoked)"
                                      : std::exchange(lastDismissal_, {}));
    renew();
}

void Connection::say(v1::Envelope message) {
    channels_->sendControl(wire::encode(session_, std::move(message)));
}

void Connection::farewell() {
    v1::Envelope message;
    message.mutable_farewell();
    say(std::move(message));
}

void Connection::wake() {
    const std::lock_guard lock(mutex_);
    channels_->wake();
}

}  // namespace aquarama::session
