// SPDX-License-Identifier: Apache-2.0
// Orders and questions to the master of a running show, by whoever takes no part in it. Included
// only by who speaks to a peer, as common/wire/messages.h.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/net/channels.h"
#include "common/wire/messages.h"

namespace aquarama::ask {

// A connection to a master for questions. One thread uses it.
class RequestClient {
  public:
    // Throws Error where the address is malformed.
    explicit RequestClient(const std::string& controlAddress,
                           const std::optional<net::PeerKeys>& keys = {})
        : RequestClient(std::vector{controlAddress}, keys) {}
    // To the one that is the master of several machines; all are asked.
    RequestClient(const std::vector<std::string>& controlAddresses,
                  const std::optional<net::PeerKeys>& keys);

    // The newest answer; the question is repeated until there is one, since the connection may not
    // be there yet. Throws Error where nobody answers within two seconds, and at once where the
    // master prepares its show.
    v1::StatusReply status();
    v1::Explanation explain(std::uint32_t fish);
    // Also with the skin of the drawing of this number; 0: of none.
    v1::DrawingsReply drawings(std::uint32_t skinOf = 0);

    // The run of the master that answered last; 0 before the first answer.
    [[nodiscard]] std::uint64_t run() const { return run_; }
    // What the master said to the last question instead of an answer: "the master prepares: ...".
    // Empty where it answered, or nobody did.
    [[nodiscard]] const std::string& preparing() const { return preparing_; }

    // Gives an order once, and returns what has become of it so far.
    v1::OrderReply give(const v1::Order& order);
    // Repeated until it is done, also through the minutes that a new scene may take. Meanwhile
    // `onWait` hears what is waited for, each time that this is something else. Throws Error where
    // the order is refused, saying why. Returns the last answer.
    v1::OrderReply carryOut(v1::Order order, const std::function<void(const std::string&)>& onWait);

    // Not answered, and lost where the connection does not stand yet. `yields`: to whoever steers
    // and does not.
    void steer(const Steering& steering, bool yields = false);
    // All hands before the wall. Likewise.
    void touch(const WallHands& hands);
    // Food at a point of the world, in metres. Likewise.
    void feed(const glm::vec3& position);

  private:
    v1::Envelope ask(const v1::Envelope& question, v1::Envelope::MessageCase reply);
    void send(net::ByteView packet);
    // The newest answer that has come within this time.
    std::optional<v1::Envelope> hear(v1::Envelope::MessageCase reply, net::Duration atMost);

    std::string addresses_;  // for messages
    std::vector<std::unique_ptr<net::NodeChannels>> channels_;
    std::uint64_t run_ = 0;
    std::string preparing_;
};

// Of Order.request: no two are the same, none is 0.
[[nodiscard]] std::uint64_t freshRequest();

// Which master is asked, and with whose key.
struct AskedMaster {
    std::string rig;      // its file
    std::string address;  // of its control channel; empty: the rig's
    std::string key;      // file; empty: the operator's, where the rig needs one

    // Throws Error where the rig or the key cannot be read.
    [[nodiscard]] RequestClient connect() const;

  private:
    // The file of the key to show; empty where none is needed.
    [[nodiscard]] std::string keyPath() const;
};

}  // namespace aquarama::ask
