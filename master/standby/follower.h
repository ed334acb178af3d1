// SPDX-License-Identifier: Apache-2.0
// A standby simulates along with the master: it gets all that the master's journal gets, and keeps
// a journal of its own, and the drawings. It takes over with the world that it has.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/base/units.h"
#include "common/net/channels.h"
#include "common/net/clock.h"
#include "common/wire/messages.h"
#include "common/wire/recording.h"
#include "master/conductor/standby_feed.h"
#include "master/journal/journalled_world.h"
#include "master/simulation/living_world.h"
#include "master/standby/followed_clock.h"
#include "master/standby/followed_drawings.h"
#include "master/standby/parts.h"

namespace aquarama::standby {

// A world that a standby has to have.
struct WantedWorld {
    std::string scene;
    std::uint32_t seed = 0;
    std::uint32_t fish = 0;  // of the first species, without those that wait for drawings
    friend bool operator==(const WantedWorld&, const WantedWorld&) = default;
};

// What a standby is, and where it has things from.
struct FollowerOptions {
    std::string machine;             // its own name
    net::Connect connect;            // to the master
    std::filesystem::path journal;   // folder of its own journal
    std::filesystem::path drawings;  // folder of its own copy
    // The files of this machine for such a world.
    std::function<simulation::Assets(const WantedWorld&)> assets;
};

// Used by one thread.
class Follower {
  public:
    // Throws Error where the master's address is malformed.
    explicit Follower(FollowerOptions options);

    // Takes what has come, waits for some milliseconds where nothing has, and simulates as far as
    // all inputs are known. What keeps it from that is an error in the log.
    void turn();
    // Whether it may take over: it has the world of a show that has not ended.
    [[nodiscard]] bool hasWorld() const { return world_ && !isOver_; }
    // The lease of the master whose world it has; 0 without one.
    [[nodiscard]] std::uint64_t lease() const { return lease_; }
    // The tick of its world; 0 without one.
    [[nodiscard]] Tick tick() const { return world_ ? world_->tick() : Tick{}; }

    // A world that goes on under this master.
    struct TakenOver {
        std::unique_ptr<journal::JournalledWorld> world;
        simulation::Assets assets;
        conductor::FollowedShow show;
    };
    // Brings its world to the tick that the clock names: where it stood in a show that is frozen.
    [[nodiscard]] TakenOver takeOver();

  private:
    void follow(net::Moment now);
    void hear();
    void read(const v1::Envelope& message);
    void take(const v1::Journalled& part);
    void takeShow(const v1::Journalled& part);
    void takePiece(const wire::Packet& piece, Tick tick);
    void tryToBegin(const wire::Packet& piece);
    // Throws Error where this machine's files are not the master's.
    void begin(const wire::Packet& piece);
    // False: these are no entries that can go on from here.
    [[nodiscard]] bool goOn(const wire::Packet& entries);
    void advance(std::size_t mostTicks);
    void compare();

    FollowerOptions options_;
    std::unique_ptr<net::NodeChannels> channels_;
    FollowedDrawings drawings_;
    std::unique_ptr<journal::JournalledWorld> world_;
    std::optional<simulation::Assets> assets_;  // of the world
    WantedWorld assetsOf_;
    conductor::FollowedShow show_;
    wire::Packet beginning_;  // of the stream's recording, without its save
    std::deque<wire::RecordedHash> expected_;
    Parts parts_;
    std::uint64_t lease_ = 0;
    std::uint64_t saidInStep_ = 0;  // the stream
    Tick known_;                    // up to it all inputs are known
    FollowedClock clock_;
    bool isOver_ = false;
    std::string refusal_, problem_;  // that were logged
    net::Moment lastFollow_{}, lastHeard_, lastDiffered_{};
};

}  // namespace aquarama::standby
