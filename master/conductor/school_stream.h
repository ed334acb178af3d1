// SPDX-License-Identifier: Apache-2.0
// The stream of the fish of a world: each step coded once for all nodes, and keyframes for those
// that join it or have lost it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/base/digest.h"
#include "common/motion/motion_state.h"
#include "common/net/blob.h"
#include "common/school/step_codec.h"
#include "common/wire/state_codec.h"
#include "master/conductor/simulation.h"

namespace aquarama::conductor {

// Of the conductor's thread.
class SchoolStream {
  public:
    // Another world, from the next tick on. `rates`: of its fish, or none.
    void begin(std::vector<school::RecordedRates> rates);
    // The next tick of the world.
    void add(const Snapshot& snapshot);
    // What a frame carries that shows this tick: the steps since the frame before, or a keyframe
    // where nodes cannot follow from there. The tick was added, and comes after none before.
    [[nodiscard]] wire::SchoolPart upTo(Tick tick);
    // Names a blob that leads to the newest tick, for a node that asks; nothing where there is no
    // tick.
    [[nodiscard]] std::optional<Digest> keyframe();
    // A blob that was named in the last ten seconds; null where it is none of them.
    [[nodiscard]] net::Blob blob(const Digest& digest) const;

  private:
    // A keyframe, from which the steps after it lead on.
    struct Base {
        Tick tick;
        std::vector<std::byte> keyframe;
    };
    struct AskedFor {
        Tick newest;
        Digest digest;
        net::Blob blob;
    };
    void forgetOld();
    void keepBase(const Snapshot& snapshot, const motion::MotorCommands& commands);
    [[nodiscard]] std::vector<school::PlacedFish> placedIn(const Snapshot& snapshot);
    // From the newest base that is not after `latest`, or else the oldest.
    [[nodiscard]] wire::SchoolPart fromBase(Tick latest, Tick to) const;
    [[nodiscard]] std::vector<wire::SchoolStep> between(Tick after, Tick to) const;

    std::uint64_t stream_ = 0;
    std::vector<school::RecordedRates> rates_;
    school::StepMemory memory_;
    motion::MotorCommands known_;       // of the newest tick
    std::vector<std::uint32_t> skins_;  // of the newest tick
    std::optional<Tick> newest_;        // nothing: the world has just begun
    std::deque<Base> bases_;
    std::deque<wire::SchoolStep> steps_;  // since the oldest base
    std::optional<Tick> sent_;            // that the last frame showed
    std::deque<AskedFor> askedFor_;
};

}  // namespace aquarama::conductor
