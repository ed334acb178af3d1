// SPDX-License-Identifier: Apache-2.0
// Pretended machines follow a depot through lost messages, power cuts and bad releases. Whatever
// comes when: each can always start a release, no two releases are shown at once, and in the end
// all show one.
#include "releases/rollout.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "releases/boot.h"
#include "releases/follower.h"

namespace aquarama::releases {
namespace {

using testing::HasSubstr;
using Phase = RolloutState::Phase;

const ReleaseId kOld{"1.0", 10};
constexpr double kWatchdogSeconds = 60;   // of a machine that hangs
constexpr double kBlessingSeconds = 600;  // until a release on trial is started anew
constexpr RolloutLimits kLimits{.frames = 600, .trial = 900};

// What a release has wrong on a machine.
enum class Fault : std::uint8_t { None, DoesNotStart, IsMute, ShowsNothing, Crashes };

// A machine with a disk, which survives the power, and what runs on it.
struct PretendedMachine {
    // On its disk.
    FollowerMemory memory;
    std::vector<BootEntry> entries{{kOld, {}, "aquarama-1.0.conf"}};
    std::set<std::string> whole{"1.0"};  // versions
    // What runs.
    std::optional<ReleaseFollower> follower;  // nothing: off, or hangs
    std::deque<BootStep> steps;               // to be done, one after the other
    FollowerDuties duties;                    // after them
    bool mustRemember = false;                // before the next report
    bool isOn = false, isOnTrial = false, isShown = false;
    ReleaseId booted;
    double startedAt = 0;
    double frames = 0;
    int boots = 0;
    Fault fault = Fault::None;  // of every release but the first one

    [[nodiscard]] Fault faultNow() const { return booted == kOld ? Fault::None : fault; }
};

class Hall {
  public:
    explicit Hall(std::size_t count, std::uint32_t seed = 1) : machines(count), random(seed) {
        for (std::size_t i = 0; i < count; ++i) names.push_back("m" + std::to_string(i));
        startDepot();
        for (PretendedMachine& machine : machines) powerOn(machine);
    }

    bool chance(double share) { return std::uniform_real_distribution<>(0, 1)(random) < share; }

    void startDepot() { depot.emplace(names, kept, kLimits, now); }

    // As the boot loader does it.
    void powerOn(PretendedMachine& machine) {
        const auto mayStart = [](const BootEntry& e) { return !e.triesLeft || *e.triesLeft > 0; };
        BootEntry* chosen = nullptr;
        for (BootEntry& entry : machine.entries)
            if (mayStart(entry) && (!chosen || entry.release.serial > chosen->release.serial))
                chosen = &entry;
        ASSERT_NE(chosen, nullptr) << "nothing can be started";
        ASSERT_TRUE(machine.whole.contains(chosen->release.version)) << "it is not whole";
        if (chosen->triesLeft) --*chosen->triesLeft;
        machine.isOn = true;
        machine.isOnTrial = chosen->triesLeft.has_value();
        machine.booted = chosen->release;
        machine.startedAt = now;
        machine.frames = 0;
        ++machine.boots;
        if (machine.faultNow() == Fault::DoesNotStart || machine.faultNow() == Fault::IsMute)
            return;
        machine.follower.emplace(machine.memory, machine.booted, std::to_string(machine.boots));
        machine.mustRemember = true;
    }
    void powerOff(PretendedMachine& machine) {
        machine.follower.reset();
        machine.steps.clear();
        machine.duties = {};
        machine.isOn = machine.isShown = false;
    }

    void change(PretendedMachine& machine, const BootStep& step) {
        const auto same = [&](const BootEntry& entry) { return entry.file == step.entry.file; };
        if (step.what == BootStep::What::Write) machine.entries.push_back(step.entry);
        if (step.what == BootStep::What::Remove) std::erase_if(machine.entries, same);
        if (step.what == BootStep::What::Rename)
            for (BootEntry& entry : machine.entries)
                if (same(entry)) entry = {entry.release, {}, step.to};
    }

    void obey(PretendedMachine& machine, const MachineOrder& order) {
        std::vector<ReleaseId> held{kOld};
        for (const BootEntry& entry : machine.entries) held.push_back(entry.release);
        if (machine.whole.contains(order.run.version)) held.push_back(order.run);
        machine.duties = machine.follower->obey(order, held, now, kLimits.lease());
        machine.mustRemember = true;
        if (machine.duties.isDark) machine.isShown = false;
        std::vector<BootStep> steps;
        if (machine.duties.start) steps = stepsToStart(machine.entries, machine.duties.start);
        if (machine.duties.isBlessed) steps = stepsToBless(machine.entries, machine.booted);
        machine.steps.assign(steps.begin(), steps.end());
    }

    // One thing after the other, so that the power may go between them.
    void act(std::size_t number) {
        PretendedMachine& machine = machines[number];
        if (!machine.steps.empty()) {
            if (machine.steps.front().what == BootStep::What::Rename && chance(cutRenames))
                return cutDuringRename(machine);
            change(machine, machine.steps.front());
            machine.steps.pop_front();
        } else if (machine.mustRemember) {
            machine.memory = machine.follower->memory();
            machine.mustRemember = false;
        } else if (machine.duties.start) {
            powerOff(machine);
            powerOn(machine);
        } else if (machine.duties.fetch) {
            if (chance(0.3)) machine.whole.insert(machine.duties.fetch.version);
            machine.duties.fetch = {};
        } else {
            report(number);
        }
    }

    // FAT has lost the old name, and the new one leads to an empty file: it counts as no entry.
    void cutDuringRename(PretendedMachine& machine) {
        change(machine, {BootStep::What::Remove, machine.steps.front().entry});
        powerOff(machine);
        powerOn(machine);
    }

    void report(std::size_t number) {
        PretendedMachine& machine = machines[number];
        if (chance(lost)) return;
        MachineReport report{.booted = machine.booted,
                             .epoch = machine.follower->epoch(),
                             .frames = static_cast<std::uint64_t>(machine.frames),
                             .leftIn = machine.follower->leftIn()};
        for (const BootEntry& entry : machine.entries)
            if (!entry.triesLeft) report.held.push_back(entry.release);
        const ReleaseId candidate = depot->state().candidate;
        if (machine.whole.contains(candidate.version)) report.held.push_back(candidate);
        if (chance(lost)) late.emplace_back(names[number], report);
        if (!late.empty() && chance(0.1)) {
            std::swap(late[random() % late.size()], late.back());
            depot->hear(late.back().first, late.back().second, now);
            late.pop_back();
        }
        depot->hear(names[number], report, now);
        if (chance(crashes)) return startDepot();  // before it was kept
        kept = depot->state();
        if (chance(crashes)) startDepot();
        if (!chance(lost)) obey(machine, depot->orderFor(names[number], now));
    }

    void pass(double seconds) {
        now += seconds;
        for (PretendedMachine& machine : machines) {
            if (!machine.isOn) continue;
            if (machine.follower) machine.isShown = machine.follower->mayShow(now);
            if (machine.isShown && machine.faultNow() == Fault::None)
                machine.frames += 60 * seconds;
            if (machine.isShown && machine.faultNow() == Fault::Crashes && chance(0.05))
                machine.frames = 0;
            const double age = now - machine.startedAt;
            const bool hangs = machine.faultNow() == Fault::DoesNotStart && age > kWatchdogSeconds;
            const bool isGood = machine.follower && machine.memory.settled == machine.booted;
            if (hangs || (machine.isOnTrial && !isGood && age > kBlessingSeconds)) {
                powerOff(machine);
                powerOn(machine);
            }
        }
        depot->pass(now);
        kept = depot->state();
        expectOneReleaseShown();
    }

    // Never mixed, and never without a good release to start.
    void expectOneReleaseShown() {
        std::set<std::string> shown;
        for (const PretendedMachine& machine : machines) {
            if (machine.isShown) shown.insert(machine.booted.version);
            ASSERT_TRUE(std::ranges::any_of(machine.entries, [&](const BootEntry& entry) {
                return !entry.triesLeft && machine.whole.contains(entry.release.version);
            })) << "no good release is left";
        }
        ASSERT_LE(shown.size(), 1U) << "a mixed wall";
    }

    void runFor(double seconds) {
        for (const double end = now + seconds; now < end && !testing::Test::HasFatalFailure();) {
            for (std::size_t i = 0; i < machines.size(); ++i)
                if (machines[i].follower) act(i);
            pass(0.25);
        }
    }

    // What people ask for, where it can be.
    void ask(void (Rollout::*what)(double)) {
        try {
            ((*depot).*what)(now);
            kept = depot->state();
        } catch (const Error&) {  // it cannot be now
        }
    }
    void stage(const ReleaseId& release) {
        try {
            depot->stage(release, now);
            kept = depot->state();
        } catch (const Error&) {
        }
    }

    [[nodiscard]] bool allRun(const ReleaseId& release) const {
        return std::ranges::all_of(machines, [&](const PretendedMachine& machine) {
            return machine.isOn && machine.booted == release && machine.isShown;
        });
    }

    std::vector<PretendedMachine> machines;
    std::vector<std::string> names;
    std::vector<std::pair<std::string, MachineReport>> late;  // what still comes, at any time
    std::optional<Rollout> depot;
    RolloutState kept;  // on its disk
    double now = 1000;
    double lost = 0, crashes = 0, cutRenames = 0;
    std::mt19937 random;
};

TEST(Rollout, bringsAllMachinesToAReleaseTogether) {
    Hall hall(3);
    hall.runFor(30);
    EXPECT_TRUE(hall.allRun(kOld));
    hall.stage({"1.1", 11});
    hall.runFor(120);
    EXPECT_TRUE(hall.depot->isReady());
    EXPECT_TRUE(hall.allRun(kOld)) << "copying disturbs nobody";
    hall.ask(&Rollout::go);
    hall.runFor(60);
    EXPECT_TRUE(hall.allRun({"1.1", 11}));
    EXPECT_EQ(hall.depot->state().phase, Phase::Settled);
    EXPECT_EQ(hall.depot->state().before, kOld);
    for (const PretendedMachine& machine : hall.machines)
        EXPECT_TRUE(std::ranges::any_of(machine.entries, [](const BootEntry& entry) {
            return entry.file == "aquarama-1.1.conf";
        })) << "it is good from now on";
}

TEST(Rollout, copiesToOneMachineAfterTheOther) {
    Hall hall(3);
    hall.runFor(30);
    hall.stage({"1.1", 11});
    while (!hall.depot->isReady()) {
        std::size_t copying = 0;
        for (const std::string& name : hall.names)
            copying += hall.depot->orderFor(name, hall.now).fetch ? 1 : 0;
        ASSERT_EQ(copying, 1U);
        hall.runFor(1);
    }
}

// Each fault on one of three machines: all return, and the reason names machine and release.
TEST(Rollout, returnsTogetherFromABadRelease) {
    for (const Fault fault :
         {Fault::DoesNotStart, Fault::IsMute, Fault::ShowsNothing, Fault::Crashes}) {
        Hall hall(3);
        hall.machines[1].fault = fault;
        hall.runFor(30);
        hall.stage({"1.1", 11});
        hall.runFor(120);
        hall.ask(&Rollout::go);
        hall.runFor(4000);
        EXPECT_TRUE(hall.allRun(kOld)) << static_cast<int>(fault);
        EXPECT_EQ(hall.depot->state().phase, Phase::Settled);
        EXPECT_THAT(hall.depot->state().reason, HasSubstr("release 1.1 was left: "));
        EXPECT_THAT(hall.depot->state().reason, HasSubstr("m1 "));
    }
}

TEST(Rollout, returnsToTheReleaseBeforeWhenAsked) {
    Hall hall(3);
    hall.runFor(30);
    hall.stage({"1.1", 11});
    hall.runFor(120);
    hall.ask(&Rollout::go);
    hall.runFor(60);
    hall.ask(&Rollout::back);
    hall.runFor(120);
    EXPECT_TRUE(hall.allRun(kOld));
    EXPECT_EQ(hall.depot->state().stable, kOld);
}

TEST(Rollout, waitsForAMachineThatIsOff) {
    Hall hall(3);
    hall.runFor(30);
    hall.stage({"1.1", 11});
    hall.powerOff(hall.machines[2]);
    hall.runFor(120);
    EXPECT_THROW(hall.depot->go(hall.now), Error);
    EXPECT_THAT(hall.depot->waitingFor(hall.now), HasSubstr("m2 is not heard"));
    hall.powerOn(hall.machines[2]);
    hall.runFor(60);
    EXPECT_TRUE(hall.depot->isReady());
}

// The wall shows while the depot is away, as all are settled; a release on trial goes dark.
TEST(Rollout, needsTheDepotForATrialOnly) {
    Hall hall(3);
    hall.runFor(30);
    hall.lost = 1;
    for (PretendedMachine& machine : hall.machines) {
        hall.powerOff(machine);
        hall.powerOn(machine);
    }
    hall.runFor(30);
    EXPECT_TRUE(hall.allRun(kOld));
    hall.lost = 0;
    hall.machines[1].fault = Fault::ShowsNothing;
    hall.stage({"1.1", 11});
    hall.runFor(120);
    hall.ask(&Rollout::go);
    hall.runFor(60);
    EXPECT_TRUE(hall.allRun({"1.1", 11}));
    hall.lost = 1;
    hall.runFor(kLimits.lease() + 1);
    for (const PretendedMachine& machine : hall.machines) EXPECT_FALSE(machine.isShown);
}

TEST(Rollout, refusesWhatIsNotNewer) {
    Hall hall(2);
    EXPECT_THROW(hall.depot->stage({"1.1", 11}, hall.now), Error) << "nobody has said what runs";
    hall.runFor(30);
    EXPECT_THROW(hall.depot->stage({"0.9", 9}, hall.now), Error);
    EXPECT_THROW(hall.depot->stage({"1.1", 10}, hall.now), Error);
    EXPECT_THROW(hall.depot->stage({"1.0", 11}, hall.now), Error);
    EXPECT_THROW(hall.depot->go(hall.now), Error);
    EXPECT_THROW(hall.depot->back(hall.now), Error);
}

// A hundred halls of two to five machines, each with an hour of trouble and an hour of quiet.
TEST(Rollout, isNeverMixedNeverNeitherNeverStuck) {
    std::size_t updated = 0, returned = 0;
    for (std::uint32_t seed = 0; seed < 100 && !testing::Test::HasFailure(); ++seed) {
        SCOPED_TRACE(seed);
        Hall hall(2 + seed % 4, seed);
        if (seed % 3 == 0)
            hall.machines[seed % hall.machines.size()].fault = static_cast<Fault>(seed / 3 % 5);
        hall.lost = seed % 2 == 0 ? 0 : 0.2;
        hall.crashes = seed % 5 == 0 ? 0.02 : 0;
        hall.cutRenames = seed % 4 == 0 ? 0.5 : 0;
        std::uint64_t serial = 10;
        for (int step = 0; step < 8000 && !testing::Test::HasFatalFailure(); ++step) {
            PretendedMachine& machine = hall.machines[hall.random() % hall.machines.size()];
            if (machine.follower) hall.act(static_cast<std::size_t>(&machine - &hall.machines[0]));
            if (machine.isOn ? hall.chance(0.004) : hall.chance(0.1))
                machine.isOn ? hall.powerOff(machine) : hall.powerOn(machine);
            if (hall.chance(0.002)) hall.stage({"1." + std::to_string(serial), ++serial});
            if (hall.chance(0.02)) hall.ask(&Rollout::go);
            if (hall.chance(0.001)) hall.ask(&Rollout::back);
            hall.pass(hall.chance(0.001) ? 400 : 0.4);
        }
        hall.lost = hall.crashes = hall.cutRenames = 0;
        for (PretendedMachine& machine : hall.machines)
            if (!machine.isOn) hall.powerOn(machine);
        hall.runFor(4000);
        const RolloutState& state = hall.depot->state();
        EXPECT_TRUE(state.phase == Phase::Settled || state.phase == Phase::Copying);
        EXPECT_TRUE(hall.allRun(state.stable));
        (state.stable == kOld ? returned : updated) += 1;
    }
    EXPECT_GT(updated, 10U);
    EXPECT_GT(returned, 10U);
}

}  // namespace
}  // namespace aquarama::releases
