// SPDX-License-Identifier: Apache-2.0
// A node's copy of the fish: it follows the stream of the master step by step, and asks for a
// keyframe where it cannot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "common/net/blob.h"
#include "common/net/clock.h"
#include "common/school/keyframe.h"
#include "common/school/school_motion.h"
#include "common/wire/messages.h"
#include "render_node/session/mailbox.h"
#include "render_node/session/recent_fish.h"
#include "render_node/session/session.h"

namespace aquarama::session {

// Used by the net thread. Frames go in as they arrive, and come out with their fish, in order.
class SchoolFollower {
  public:
    // `say` sends a message to the master.
    explicit SchoolFollower(std::function<void(v1::Envelope)> say) : say_(std::move(say)) {}

    // How the fish of a look move, once it is built.
    void use(std::uint32_t look, std::shared_ptr<school::SchoolMotion> motion);
    // Another run of the master: nothing of before holds.
    void forget();

    // A frame has arrived.
    void take(wire::CodedState coded, net::Moment arrival);
    // The master's answers: which blob it is, and its chunks. Others are ignored.
    void take(const v1::Keyframe& keyframe);
    void take(const v1::BlobChunk& chunk);
    // Asks for what is missing, now and then.
    void turn(net::Moment now);

    // The next frame whose fish are known, or whose look has no motion: that one comes without
    // fish.
    [[nodiscard]] std::optional<ArrivedState> next();
    // Whether frames of a look arrive that is built, and it cannot follow them yet.
    [[nodiscard]] bool isBehind() const { return isMissing_ && motion_ != nullptr; }
    // The newest fish, and those of the ticks before; null where it follows none.
    [[nodiscard]] const school::SchoolState* newest() const {
        return follows_ ? &follows_->school : nullptr;
    }
    [[nodiscard]] const RecentFish& recent() const { return recent_; }
    // Steps after which its fish were others than the master's; each was healed by a keyframe.
    [[nodiscard]] std::uint64_t mismatches() const { return mismatches_; }

  private:
    struct Waiting {
        wire::StateFrame frame;
        net::Moment arrival{};
    };
    // Another world.
    void enter(std::uint64_t stream);
    void keep(const wire::SchoolPart& part);
    // It follows from this keyframe on, where it is one of the fish of the look.
    void load(const wire::SchoolPart& part);
    // Brings the fish to this tick. False: a step is missing, or is none.
    bool advanceTo(Tick tick);
    bool advance(const wire::SchoolStep& step);
    void check(std::uint64_t hash);
    void goOn();
    void lose() { isMissing_ = true; }

    std::function<void(v1::Envelope)> say_;
    std::map<std::uint32_t, std::shared_ptr<school::SchoolMotion>> motions_;  // by look
    std::shared_ptr<school::SchoolMotion> motion_;  // of the world of the stream
    std::uint64_t stream_ = 0;
    std::optional<school::Keyframe> follows_;  // the newest tick; nothing: unknown
    RecentFish recent_;                        // a frame that was lost may come again
    std::map<Tick, wire::SchoolStep> steps_;   // those to come, and some before
    std::deque<Waiting> waiting_;              // for their fish, in order
    bool isMissing_ = false;                   // a keyframe is needed
    bool isWrong_ = false;                     // as its fish are others than the master's
    bool isRefused_ = false;                   // the last keyframe, which is said once
    std::optional<net::BlobAssembly> assembly_;
    net::Moment lastAsked_{};
    std::uint64_t mismatches_ = 0;
};

}  // namespace aquarama::session
