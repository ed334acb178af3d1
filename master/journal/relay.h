// SPDX-License-Identifier: Apache-2.0
// What a journal gets, for a standby that simulates along.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

#include "common/base/job_thread.h"
#include "common/base/units.h"
#include "common/wire/recording.h"
#include "master/conductor/simulation.h"
#include "master/world/world.h"

namespace aquarama::journal {

// Of one world. Where nobody takes what waits, it ends, until it begins again.
class Relay {
  public:
    // `beginning`: of the recording.
    explicit Relay(wire::Packet beginning);

    // Of the tick thread. The stream begins with the world as it is now, and with the inputs that
    // are ahead of it.
    void begin(const world::World& world, const std::vector<wire::Packet>& ahead);
    void add(const wire::Packet& entry);
    // All that takes effect before this tick has been added.
    void reach(Tick tick);

    // From any thread: what came since the last call.
    [[nodiscard]] std::optional<conductor::JournalPiece> take();

  private:
    void addBeginning();

    wire::Packet beginning_;
    std::mutex mutex_;  // guards the rest, but the state while it is encoded
    bool isOn_ = false, isEncoding_ = false;
    std::optional<wire::Packet> first_;  // beginning and save, once they are encoded
    wire::Packet waiting_;
    Tick tick_;
    world::WorldState state_;
    JobThread thread_;  // last: it uses all of the above
};

}  // namespace aquarama::journal
