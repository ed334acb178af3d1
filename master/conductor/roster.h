// SPDX-License-Identifier: Apache-2.0
// Who takes part in a show: a seat for each channel, whose key a connection has shown, what each
// may say, and how often.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/config/keys.h"
#include "common/config/rig.h"
#include "common/net/channels.h"
#include "common/wire/messages.h"

namespace aquarama::conductor {

// Whose key a connection has shown.
struct User {
    config::KeyRole role = config::KeyRole::Watcher;
    std::string name;  // of a node: its channel
};
// As the channels name it (net::Allowed): "node left", and back.
[[nodiscard]] std::string userOf(config::KeyRole role, const std::string& name);
[[nodiscard]] std::optional<User> userIn(const std::string& text);
// Whether the holder of a key may say this to the master.
[[nodiscard]] bool maySay(const User& user, const v1::Envelope& message);
// Whether it is a question for the status or for a mind.
[[nodiscard]] bool isQuestion(const v1::Envelope& message);
// Whether it is food, steering, or hands before the wall.
[[nodiscard]] bool isVisitorsInput(const v1::Envelope& message);

// A channel of the show, and the node that draws it.
struct NodeSeat {
    std::string name;
    std::string machine = {};                       // empty: the master's
    net::PeerId peer = {};                          // of its node; empty: it is absent
    bool prepared = false;                          // the node takes part
    std::uint32_t builtLook = 0;                    // the newest that the node has built
    std::optional<config::QualityTier> bears = {};  // the finest tier that it has kept up with
    net::Moment lastHeard = {};
    std::uint64_t dropped = 0;     // how often it fell silent
    std::uint64_t mismatches = 0;  // steps after which its fish were others than the master's
    std::shared_ptr<const v1::NodeReport> report = {};  // the node's last
    std::optional<net::Blanks> blanks = {};             // of its display, in the master's clock
    net::Moment lastFed = {};                           // when food was last dropped in its window
    std::uint64_t logLines = 0;                         // of the node, in this second
    net::RecentPeak pictures = {};                      // how long those of the node take
    Frame released = {};                                // the newest that the node has shown

    // The node is not counted any more.
    void vacate();
};

// Of the conductor's thread.
class Roster {
  public:
    // `names`: the channels that take part; empty: all of the rig.
    Roster(const config::Rig& rig, const std::vector<std::string>& names);

    // In the order of the channels; a node is named by its place.
    [[nodiscard]] std::vector<NodeSeat>& seats() { return seats_; }
    [[nodiscard]] const std::vector<NodeSeat>& seats() const { return seats_; }
    // The place of a channel, or of a peer's node; nothing where there is none.
    [[nodiscard]] std::optional<std::size_t> named(const std::string& channel) const;
    [[nodiscard]] std::optional<std::size_t> of(const net::PeerId& peer) const;
    // The place of the node that speaks. A node that shows its key and knows this run is the same
    // one over another connection.
    [[nodiscard]] std::optional<std::size_t> speaker(const net::FromPeer& from, bool knowsRun);
    [[nodiscard]] bool isEmpty() const;
    // The seats for which it is true, as "left, right"; empty where none is.
    [[nodiscard]] std::string listed(const std::function<bool(const NodeSeat&)>& isListed) const;

    // The finest tier that every node has measured that it bears; nothing where one has not.
    [[nodiscard]] std::optional<config::QualityTier> measuredTier() const;
    // Of those that have measured; low where none has. A node that has left still counts: when it
    // comes back, nothing changes.
    [[nodiscard]] config::QualityTier finestTier() const;

    // Whether the holder of a key may ask or be welcomed once more in this second.
    [[nodiscard]] bool isWithinRate(const std::string& user, net::Moment now);
    // True the first time: what a user may not say, and why a node is refused, is logged once.
    [[nodiscard]] bool isFirstRefusalOf(const std::string& user);
    [[nodiscard]] bool isFirstObjection(const std::string& objection);

  private:
    struct Rate {
        net::Moment since{};
        int count = 0;
    };

    std::vector<NodeSeat> seats_;
    std::map<std::string, Rate> rates_;  // by user: what was answered in this second
    std::set<std::string> refused_;      // users
    std::set<std::string> objections_;
};

}  // namespace aquarama::conductor
