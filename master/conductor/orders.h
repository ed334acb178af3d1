// SPDX-License-Identifier: Apache-2.0
// What orders ask of a show, which of them are refused, and what became of each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/ask/order_book.h"
#include "common/base/units.h"
#include "common/wire/messages.h"
#include "master/conductor/drawings.h"
#include "master/conductor/hunter_cues.h"
#include "master/conductor/roster.h"
#include "master/conductor/sender.h"
#include "master/conductor/show_control.h"

namespace aquarama::conductor {

// A fader that somebody moves: it is told once it has come to rest.
struct MovedFader {
    std::string told;  // the line; empty: none moves
    net::Moment moved{};
};

// What a show allows.
struct OrderLimits {
    bool isLockstep = false;  // such a show is the same every time: nothing is ordered
    std::string whyOneScene;  // empty: other scenes can be shown
    v1::WantedShow wanted;    // at first
    v1::WantedShow kept;      // what was set in earlier runs, part of `wanted`
};

// Of the conductor's thread. An order that a node carries out is passed on to it once; the node's
// answer, or its silence, ends it.
class Orders {
  public:
    // All but the limits outlive this.
    Orders(OrderLimits limits, Roster& roster, const Sender& sender, Drawings& drawings);

    // Carries out an order of `user`, or begins it; said again, it is answered again.
    // `unpublished`: the first frame that is still to be published.
    [[nodiscard]] v1::OrderReply obey(const std::string& user,
                                      const v1::Order& order,
                                      Frame unpublished,
                                      net::Moment now);
    // What the node at this seat says of an order that was passed on to it.
    void hear(std::size_t node, const v1::OrderReply& reply);
    // Gives up nodes that do not answer and a scan that has fallen silent.
    void giveUpTheSilent(net::Moment now);

    // What the wall shows or changes to, hunters that are called, and who holds it for a scan.
    [[nodiscard]] ShowControl& control() { return control_; }
    [[nodiscard]] const ShowControl& control() const { return control_; }
    [[nodiscard]] HunterCues& hunters() { return hunters_; }
    [[nodiscard]] const ScanHold& scan() const { return scan_; }
    [[nodiscard]] const SignHold& sign() const { return sign_; }

  private:
    // An order that a node was told, and has not answered.
    struct PassedOn {
        std::uint64_t request = 0;
        std::size_t node = 0;
        net::Moment said{};
    };
    [[nodiscard]] Answer change(const std::string& user, const v1::Order& order, net::Moment now);
    [[nodiscard]] Answer hold(const std::string& user,
                              const v1::HeldScan& scan,
                              Frame unpublished,
                              net::Moment now);
    [[nodiscard]] Answer takeDrawing(const std::string& user,
                                     const v1::Order& order,
                                     std::uint32_t& number);
    // An order that is carried out once, by its request.
    [[nodiscard]] Answer carryOutOnce(const std::string& user,
                                      const v1::Order& order,
                                      net::Moment now);
    [[nodiscard]] Answer release(const std::string& user, const v1::Order& order);
    [[nodiscard]] Answer restart(const std::string& user, const v1::Order& order);
    [[nodiscard]] Answer power(const std::string& user, const v1::Order& order, net::Moment now);
    [[nodiscard]] Answer hold(const v1::HeldSign& sign, net::Moment now);
    // Why an order is refused; empty where it is not.
    [[nodiscard]] std::string objectionTo(const v1::WantedShow& show) const;
    [[nodiscard]] std::string objectionToRelease() const;
    [[nodiscard]] std::string objectionToScene(const std::string& scene) const;
    [[nodiscard]] std::string objectionToScan() const;
    [[nodiscard]] std::string objectionToEnding(const std::string& channel) const;
    [[nodiscard]] std::string objectionToPower(const std::string& channel) const;
    // The channels that have not shown the pattern of the scan yet; empty where all have.
    [[nodiscard]] std::string notShowingScan() const;
    // To the node of this channel, as it came.
    void passOn(const v1::Order& order, const std::string& channel) const;

    OrderLimits limits_;
    Roster& roster_;
    const Sender& sender_;
    Drawings& drawings_;
    HunterCues hunters_;
    ask::OrderBook book_;
    ShowControl control_;
    ScanHold scan_;
    SignHold sign_;
    std::vector<PassedOn> passedOn_;
    MovedFader fader_;
};

}  // namespace aquarama::conductor
