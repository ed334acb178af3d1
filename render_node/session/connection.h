// SPDX-License-Identifier: Apache-2.0
// A node's connection to the master: its channels, and hello until a run of the master welcomes it.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "common/net/channels.h"
#include "common/net/clock.h"
#include "common/wire/messages.h"

namespace aquarama::session {

// Used by the net thread; only wake() may be called from others.
class Connection {
  public:
    // Connects once. Throws Error where the address is malformed.
    Connection(std::string name, net::Connect connect);

    [[nodiscard]] const std::string& name() const { return name_; }  // of the channel
    // Starts an attempt to join with fresh channels, as old ones may be dead without notice.
    void renew();
    // Hello ten times a second. Every three seconds without a welcome it logs why and makes a new
    // connection, as ZeroMQ never retries one whose key was refused.
    void greet(net::Moment now);
    // The master does not let the node in yet; greet() logs this reason.
    void notYet(const std::string& reason) { lastDismissal_ = reason; }
    // The run of the master that all further messages go to.
    void enter(std::uint64_t session) { session_ = session; }
    void leave() { session_ = 0; }
    // 0: no run has welcomed the node.
    [[nodiscard]] std::uint64_t session() const { return session_; }

    // Sends a message to the run that welcomed the node.
    void say(v1::Envelope message);
    void farewell();
    [[nodiscard]] std::optional<net::ByteVector> receiveControl() {
        return channels_->receiveControl();
    }
    [[nodiscard]] std::optional<net::ByteVector> receiveState() {
        return channels_->receiveState();
    }
    // Throws Error where the address is malformed.
    void subscribeState(const std::string& address) { channels_->subscribeState(address); }
    // Returns when something has arrived, after wake(), or after `atMost`.
    void wait(net::Duration atMost) { channels_->wait(atMost); }
    void wake();

  private:
    std::string name_;
    net::Connect connect_;
    std::mutex mutex_;  // held to replace or wake the channels, never to use them
    std::unique_ptr<net::NodeChannels> channels_;
    bool isUsed_ = false;  // by an attempt to join
    std::uint64_t session_ = 0;
    std::string lastDismissal_;
    net::Moment lastHello_{}, lastComplaint_{};
};

}  // namespace aquarama::session
