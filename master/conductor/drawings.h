// SPDX-License-Identifier: Apache-2.0
// Visitors' drawings: which there are, what the crew has decided, which fish wears each, and the
// files by which they survive a restart.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/ask/order_book.h"
#include "common/base/digest.h"
#include "common/config/rig.h"
#include "common/motion/motion_state.h"
#include "common/net/blob.h"
#include "common/net/clock.h"
#include "common/wire/messages.h"
#include "master/conductor/drawing_files.h"
#include "master/conductor/simulation.h"
#include "master/conductor/taken_requests.h"
#include "master/world/events.h"

namespace aquarama::conductor {

// Of the conductor's thread. A drawing is offered, waits for the crew or is let in at once, and
// swims as soon as the scene has a fish for it. Where there is no room the oldest makes room.
class Drawings {
  public:
    // Without rules every drawing is refused. `folder`: where drawings are kept; empty: nowhere.
    Drawings(std::optional<config::DrawingRules> rules, std::filesystem::path folder);

    // The world that they enter, by which fish. Those that swim in it go on, those that swam in
    // another one enter anew, and those that it has for itself alone leave.
    void enter(std::vector<DrawingSlots> slots);

    // What becomes of an offer of `request`; `number` is set where the drawing was taken. It waits
    // until the drawing is on the disk: what is done survives a killed master. Who says it again
    // is answered again.
    [[nodiscard]] ask::Answer offer(std::uint64_t request,
                                    const v1::OfferedDrawing& offered,
                                    std::uint64_t unixSeconds,
                                    std::uint32_t& number);
    // What `user` of the crew decides, in the same way.
    [[nodiscard]] ask::Answer decide(const std::string& user,
                                     std::uint64_t request,
                                     const v1::Moderation& moderation);

    // Gives a world an input; false: it is busy, and is given it again later.
    using Apply = std::function<bool(const world::WorldInput&)>;
    // Once a second: applies the inputs that are due. `fish`: the newest records; `maySwim`: what
    // the crew wants of all.
    void turn(std::span<const motion::FishRecord> fish,
              bool maySwim,
              net::Moment now,
              std::uint64_t unixSeconds,
              const Apply& apply);

    // Grows with every change that reply() shows; nothing without rules.
    [[nodiscard]] std::optional<std::uint64_t> version() const;
    [[nodiscard]] v1::DrawingsReply reply(const v1::DrawingsRequest& request) const;
    // Of the blob that names all skins, as frames carry it; nothing where there are none.
    [[nodiscard]] const std::optional<Digest>& skins() const { return list_; }
    // Of the blob that lists all drawings and names their skins, for a standby; nothing without
    // rules.
    [[nodiscard]] std::optional<Digest> kept() const {
        return rules_ ? std::optional(kept_.digest) : std::nullopt;
    }
    // Null where it is none of a drawing.
    [[nodiscard]] net::Blob blob(const Digest& digest) const;
    // Whether a standby has yet to write what was taken: answers wait for that as well, for some
    // seconds at most.
    void awaitCopy(bool isAwaited) { requests_.awaitCopy(isAwaited); }

  private:
    // A drawing, and how far it has come.
    struct Entry {
        KeptEntry kept;
        Digest picture;                          // of its skin
        std::optional<net::Moment> listed = {};  // since when nodes are told of its skin
        std::optional<std::uint32_t> fish = {};  // that wears it
        std::optional<net::Moment> leaving = {};
        bool isForgotten = false;  // it ends when its fish has left
        // It has a fish that was not told to leave.
        [[nodiscard]] bool swims() const { return fish && !leaving; }
        // Its fish was told to leave, and is away.
        [[nodiscard]] bool hasLeft(std::span<const motion::FishRecord> of, net::Moment now) const;
        // It has no fish any more.
        void rest() {
            fish.reset();
            leaving.reset();
            listed.reset();
        }
    };
    [[nodiscard]] Entry* find(std::uint32_t number);
    // Those that were let in and have no fish yet, the first of them.
    [[nodiscard]] std::vector<Entry*> nextToEnter();
    void decideOne(Entry& entry, const v1::Moderation& moderation);
    [[nodiscard]] ask::Answer answerOf(const TakenRequest& taken);
    const TakenRequest& take(std::uint64_t request, std::uint32_t number);
    [[nodiscard]] v1::DrawingStatus statusOf(const Entry& entry) const;
    [[nodiscard]] std::string objectionTo(const v1::OfferedDrawing& offered) const;
    [[nodiscard]] v1::DrawingStatus::Condition conditionOf(const Entry& entry) const;
    [[nodiscard]] bool hasRoomFor(const std::string& species) const;
    // A fish that no drawing has: one that is away, or one that leaves and still is there.
    [[nodiscard]] std::optional<std::uint32_t> unwornFish(
        const std::string& species, bool isAway, std::span<const motion::FishRecord> fish) const;
    [[nodiscard]] std::size_t swimming() const;
    void findWorn();
    void takeOver(std::uint32_t number, std::uint32_t fish);
    // Steps of a turn.
    void endLeft(std::span<const motion::FishRecord> fish, net::Moment now);
    void forgetOld(std::uint64_t unixSeconds);
    void enterNext(std::span<const motion::FishRecord> fish, net::Moment now);
    void sendAway(net::Moment now);
    // The oldest that swims, of this species where it is named: begins to leave for good.
    void makeRoom(const std::string& species);
    void takeDown(Entry& entry);
    // Tells whoever looks, and keeps it.
    void changed();
    void tellSkins();
    void keep();
    void replaceBlobs(std::map<Digest, net::Blob> blobs);

    std::optional<config::DrawingRules> rules_;
    DrawingFiles files_;
    std::vector<DrawingSlots> slots_;
    std::deque<Entry> entries_;  // the oldest first
    std::uint32_t lastNumber_ = 0;
    std::uint64_t version_ = 1;
    std::vector<std::uint32_t> toLeave_;    // fish that are told at the next turn
    std::deque<world::WorldInput> inputs_;  // that the world has not taken yet
    std::uint64_t state_ = 0;               // of the files
    struct {
        Digest digest;
        net::Blob list;
    } kept_;  // for a standby
    TakenRequests requests_;
    std::optional<Digest> list_;
    std::map<Digest, net::Blob> blobs_;
    std::deque<std::pair<Digest, net::Blob>> retired_;  // still asked for by slow nodes
};

}  // namespace aquarama::conductor
