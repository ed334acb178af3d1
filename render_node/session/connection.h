// SPDX-License-Identifier: Apache-2.0
// A node's connection to the master: its channels, and hello until a run of the master welcomes it.
// Where a rig has a standby it is said to both machines in turn.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/net/channels.h"
#include "common/net/clock.h"
#include "common/wire/messages.h"

namespace aquarama::session {

// Used by the net thread; only wake() may be called from others.
class Connection {
  public:
    // Connects once, to the first address. Throws Error where it is malformed.
    Connection(std::string name, std::vector<std::string> addresses, net::ConnectTo connect);

    [[nodiscard]] const std::string& name() const { return name_; }  // of the channel
    // Starts an attempt to join with fresh channels, as old ones may be dead without notice; at the
    // next address where there are several.
    void renew();
    // The master may also be at this address.
    void alsoAt(const std::string& address);
    [[nodiscard]] bool hasSeveral() const { return addresses_.size() > 1; }
    // Hello ten times a second. Every three seconds without a welcome it logs why. It makes a new
    // connection as often, as ZeroMQ never retries one whose key was refused; four times a second
    // where there are several addresses.
    void greet(net::Moment now);
    // Whether a message of a master counts: none of an older lease than one that was heard before.
    [[nodiscard]] bool isOfNewest(const v1::Envelope& message);
    // The master does not let the node in yet; greet() logs this reason.
    void notYet(const std::string& reason) { lastDismissal_ = reason; }
    // The run of the master that all further messages go to.
    void enter(std::uint64_t session);
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
    std::vector<std::string> addresses_;
    std::size_t turn_ = 0;  // the place of the present one
    net::ConnectTo connect_;
    std::mutex mutex_;  // held to replace or wake the channels, never to use them
    std::unique_ptr<net::NodeChannels> channels_;
    bool isUsed_ = false;  // by an attempt to join
    std::uint64_t session_ = 0;
    std::string lastDismissal_;
    net::Moment lastHello_{}, lastComplaint_{}, lastRenewal_{};
    std::uint64_t newestLease_ = 0;  // 0: of a rig without a standby
    bool hasRefused_ = false;        // a message of an older lease, since the newest
};

}  // namespace aquarama::session
