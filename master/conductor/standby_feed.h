// SPDX-License-Identifier: Apache-2.0
// The standby of a show: what the master sends it, so that it simulates along and can take over.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "common/base/digest.h"
#include "common/config/rig.h"
#include "common/net/channels.h"
#include "common/net/clock.h"
#include "common/wire/messages.h"
#include "master/conductor/sender.h"
#include "master/conductor/simulation.h"

namespace aquarama::conductor {

// What the wall shows and what was set, for a standby that takes over.
struct FollowedShow {
    std::string scene;  // name
    v1::WantedShow wanted, kept;
    std::optional<Digest> drawings;  // list of them, Drawings::kept(); nothing: the rig has none
};

// Of the conductor's thread. One standby at a time: the one that is named in the rig, or the former
// master once it stands by.
class StandbyFeed {
  public:
    // `isWanted`: the rig has one.
    StandbyFeed(bool isWanted, const Sender& sender)
        : isWanted_{isWanted}, sender_{sender}, stream_{sender.session()} {}

    // Answers whoever wants to follow, or notes how far it has come.
    void hear(const net::PeerId& peer, const v1::Follow& follow, net::Moment now);
    // Once after each call of beginAgain(), or when a standby has come: the world must begin
    // anew for it, by Simulation::beginFollowed().
    [[nodiscard]] bool takesBeginning();
    // The world is another one.
    void beginAgain();
    // Sends what the world has for it.
    void turn(Simulation& simulation, const FollowedShow& show, net::Moment now);
    // Its master ends with the show, which nobody is to take over.
    void sayFarewell();
    [[nodiscard]] bool isThere() const { return !peer_.empty(); }
    // The machine that stands by; empty: there is none.
    [[nodiscard]] std::string machine() const { return isThere() ? machine_ : ""; }
    // The same, where it simulates along; empty: it does not, or is behind.
    [[nodiscard]] std::string inStep() const { return isInStep_ ? machine_ : ""; }
    // Whether it is this peer that stands by.
    [[nodiscard]] bool is(const net::PeerId& peer) const { return isThere() && peer == peer_; }
    // Whether a machine simulates along whose disk has yet to get these drawings.
    [[nodiscard]] bool lacks(const std::optional<Digest>& drawings) const {
        return isInStep_ && drawings && drawings != drawings_;
    }
    // For operators; `machine`: the one that is the master.
    [[nodiscard]] v1::StandbyStatus status(const std::string& machine, net::Moment now) const;
    // It is to be the master. True once.
    void promote() { isPromoted_ = true; }
    [[nodiscard]] bool isPromoted() { return std::exchange(isPromoted_, false); }

  private:
    [[nodiscard]] std::string objectionTo(const v1::Follow& follow) const;
    void refuse(const net::PeerId& peer, const v1::Follow& follow, const std::string& objection);
    [[nodiscard]] std::optional<JournalPiece> pieceOf(Simulation& simulation);
    [[nodiscard]] bool isNews(const JournalPiece& piece,
                              const FollowedShow& show,
                              net::Moment now) const;
    void send(net::Moment now);
    void note(const v1::Follow& follow);
    void cutNext(Simulation& simulation, const FollowedShow& show, net::Moment now);
    void cut(const JournalPiece& piece, const FollowedShow& show);
    void writeShow(const FollowedShow& show, v1::Journalled& part);
    void drop(const std::string& why);

    bool isWanted_;
    const Sender& sender_;
    net::PeerId peer_;  // empty: none
    std::string machine_;
    bool isInStep_ = false, isPromoted_ = false, mustBegin_ = false, awaitsBeginning_ = false;
    std::uint64_t request_ = 0;  // of the standby, that was answered
    std::uint64_t stream_, nextPart_ = 0, sentParts_ = 0, taken_ = 0;
    std::deque<v1::Envelope> parts_;  // that wait
    std::optional<FollowedShow> told_;
    std::optional<Digest> drawings_;  // that it has
    Tick tick_;
    net::Moment lastHeard_{}, lastSent_{}, begun_ = net::monotonicNow();
    std::set<std::string> objections_;
};

}  // namespace aquarama::conductor
