// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/connection.h"

#include <chrono>
#include <utility>

#include "common/base/log.h"
#include "common/motion/motor.h"

namespace aquarama::session {
namespace {

constexpr net::Duration kHello = std::chrono::milliseconds(100);
constexpr net::Duration kComplaint = std::chrono::seconds(3);

// Computed once, as it takes a moment and never changes.
std::uint64_t ownMotorHash() {
    static const std::uint64_t hash = motion::motorSelfTest();
    return hash;
}

}  // namespace

Connection::Connection(std::string name, net::Connect connect)
    : name_(std::move(name)), connect_(std::move(connect)), channels_(connect_()) {}

void Connection::renew() {
    if (std::exchange(isUsed_, true)) {
        auto fresh = connect_();
        const std::lock_guard lock(mutex_);
        std::swap(channels_, fresh);
    }
    session_ = 0;
    lastHello_ = {};
    lastComplaint_ = net::monotonicNow();
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
    if (now - lastComplaint_ < kComplaint) return;
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
