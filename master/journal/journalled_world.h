// SPDX-License-Identifier: Apache-2.0
// A world that is journalled as it goes, and how one goes on from a journal.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "common/base/units.h"
#include "common/wire/recording.h"
#include "master/conductor/simulation.h"
#include "master/journal/journal.h"
#include "master/journal/relay.h"
#include "master/simulation/living_world.h"
#include "master/simulation/recorded_world.h"

namespace aquarama::journal {

// An input takes effect so many ticks after it has come, 50 ms: by then the disk has it.
inline constexpr std::uint64_t kTicksAhead = 3;

// Whether a world that goes on makes up for the time in which no master ran.
enum class TimeAway : std::uint8_t { MadeUpFor, LeftOut };

// What a world that goes on makes up for: ticks, and the time that this may take. Up to the last
// known tick it may take longer.
inline constexpr std::chrono::milliseconds kMostTimeKnown{10000};
inline constexpr std::uint64_t kMostTicksAway = 3600;
inline constexpr std::chrono::milliseconds kMostTimeAway{1500};
// A world that is to be restored from a save: that has lived already.
[[nodiscard]] std::unique_ptr<simulation::LivingWorld> emptyWorld(const simulation::Assets& assets);

// Brings a world of the same options to where its journal left it: the newest save that can be
// used, the inputs since then, and the ticks up to now by the clock of this machine; or up to the
// last known one where time away is left out, was over a minute, or the machine was started anew.
// Returns the inputs that are still ahead; nothing where no save can be used.
[[nodiscard]] std::optional<std::vector<wire::RecordedInput>> goOn(simulation::LivingWorld& world,
                                                                   const LastWorld& last,
                                                                   TimeAway away);

// Every input is written before it takes effect, hashes and saves as they are due. Where the disk
// does not have an input in time, it takes effect all the same: it is counted in the journal and in
// its report, and a line in the log says so. Of the tick thread, as the world itself.
class JournalledWorld final : public simulation::SimulationDecorator {
  public:
    // Of these assets. `ahead`: inputs of a world that goes on.
    JournalledWorld(std::unique_ptr<simulation::LivingWorld> world,
                    std::unique_ptr<Journal> journal,
                    const wire::AssetBundle& assets,
                    const std::vector<wire::RecordedInput>& ahead);

    void advance() override;
    // Before the first advance() it takes effect at once: nobody has seen the world yet.
    void apply(const world::WorldInput& input) override;
    // An input of a world that this one follows, or goes on from: its tick is given.
    void applyAt(Tick tick, const world::WorldInput& input) { put(tick, input, false); }
    void beginFollowed() override;
    [[nodiscard]] std::optional<conductor::JournalPiece> followed() override {
        return relay_.take();
    }
    [[nodiscard]] const simulation::LivingWorld& living() const { return *living_; }
    [[nodiscard]] Journal& journal() { return *journal_; }

  private:
    struct Ahead {
        Tick tick;
        std::uint64_t number = 0;  // of its entry
        bool isOwn = false;        // it came to this world: it waits for the disk
        world::WorldInput input;
    };
    void put(Tick tick, const world::WorldInput& input, bool isOwn);
    void noteNow();
    void applyDue();
    void noteLate();
    void note(const wire::Packet& entry);

    std::unique_ptr<simulation::LivingWorld> living_;
    std::unique_ptr<Journal> journal_;
    Relay relay_;
    std::deque<Ahead> ahead_;
    bool isRunning_ = false;
    std::uint64_t lateInputs_ = 0;  // that took effect before the disk had them
    std::optional<Tick> lateAt_;    // when it was last said
};

// The world of a show, journalled in a folder: that of its journal where it can go on, else a new
// one. Throws Error where the assets make no world.
[[nodiscard]] std::unique_ptr<JournalledWorld> makeJournalled(const std::filesystem::path& folder,
                                                              const simulation::Assets& assets,
                                                              TimeAway away);

}  // namespace aquarama::journal
