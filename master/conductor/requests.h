// SPDX-License-Identifier: Apache-2.0
// Requests that anybody may send to the running master, and its status as text.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "common/net/channels.h"
#include "common/wire/messages.h"

namespace aquarama::conductor {

// A connection to a master for questions; takes no part in the show. One thread uses it.
class RequestClient {
  public:
    // Throws Error where the address is malformed.
    explicit RequestClient(const std::string& controlAddress,
                           const std::optional<net::PeerKeys>& keys = {})
        : address_(controlAddress), channels_(net::connectNode(controlAddress, {}, keys)) {}

    // The newest answer; the question is repeated until there is one, since the connection may not
    // be there yet. Throws Error where nobody answers within two seconds.
    v1::StatusReply status();
    v1::Explanation explain(std::uint32_t fish);

    // Repeated until the show shows it, also through the minutes that a new scene may take; between
    // that, `onWait` hears what is waited for, whenever that changes. Throws Error where it is
    // refused, saying why.
    void set(v1::Set set, const std::function<void(const std::string&)>& onWait);

    // Not answered, and lost where the connection does not stand yet.
    void steer(const Steering& steering);

  private:
    v1::Envelope ask(const v1::Envelope& question, v1::Envelope::MessageCase reply);

    std::string address_;
    std::unique_ptr<net::NodeChannels> channels_;
};

// "in step", "late" ...
[[nodiscard]] std::string wordFor(v1::NodeCondition condition);

// Where the submarine is, how fast, and who steers it; one line.
[[nodiscard]] std::string submarineText(const v1::StatusReply& status);

// The whole status, a line for each node at the end.
[[nodiscard]] std::string statusText(const v1::StatusReply& status);

}  // namespace aquarama::conductor
