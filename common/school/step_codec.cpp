// SPDX-License-Identifier: Apache-2.0
#include "common/school/step_codec.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

#include "common/motion/repertoire.h"

namespace aquarama::school {
namespace {

// Bits of StepModels::changes.
enum Change : unsigned {
    kAction = 1,
    kRate = 2,
    kBrake = 4,
    kMouth = 8,
    kGaze = 16,
    kPitch = 32,
    kYaw = 64
};

// Commands have levels (master/fish/secondary_controller.cpp); others are possible, and cost more.
constexpr unsigned kRateLevelBits = 5;  // 1/32 of the recorded rate
constexpr std::int32_t kMostRateLevel = 63, kMostRate = 0x7FFF;
constexpr std::int32_t kFarthestRateOff = 7;
constexpr std::int32_t kPitchLevel = 1024;  // 1/32 of the sine
constexpr std::int32_t kMiddlePitch = 64;
constexpr std::int32_t kMostBrake = 255, kBrakeLevels = 8, kNoBrakeLevel = 15;
constexpr std::uint32_t kManyPlaced = 255;
constexpr unsigned kFishBits = 20;
static_assert(kMostFish <= 1U << kFishBits);

// What a fish does, as far as the code tells apart.
unsigned manner(std::uint8_t action) {
    const auto what = static_cast<motion::Action>(action);
    if (motion::isForward(what)) return 0;
    if (motion::swims(what)) return 1;
    return motion::isTurn(what) || motion::isStart(what) ? 2 : 3;
}

// The rate of a level, rounded to nearest; and the level of a rate, 0 where it has none.
std::int32_t rateOf(std::int32_t level, std::int32_t recorded) {
    return std::min((recorded * level + (1 << (kRateLevelBits - 1))) >> kRateLevelBits, kMostRate);
}
std::int32_t levelOf(std::int32_t rate, std::int32_t recorded) {
    if (recorded <= 0) return 0;
    const std::int32_t level = ((rate << kRateLevelBits) + recorded / 2) / recorded;
    return level <= kMostRateLevel && rateOf(level, recorded) == rate ? level : 0;
}

// The rate at which a fish is expected to play another action: in proportion.
std::int32_t expectedRate(std::int32_t rate, std::int32_t recorded, std::int32_t recordedNow) {
    if (recorded <= 0 || recordedNow <= 0) return rate;
    const std::int32_t level = levelOf(rate, recorded);
    if (level > 0) return rateOf(level, recordedNow);
    return std::min((rate * recordedNow + recorded / 2) / recorded, kMostRate);
}

std::int32_t brakeLevelOf(std::int32_t brake) {
    const std::int32_t level = (brake * kBrakeLevels + kMostBrake - 1) / kMostBrake;
    return kMostBrake * level / kBrakeLevels == brake ? level : kNoBrakeLevel;
}

// Of each fish, whether any of its commands differ. Simple loops, for the compiler to vectorise.
std::vector<std::uint8_t> changedIn(const motion::MotorCommands& a,
                                    const motion::MotorCommands& b) {
    std::vector<std::uint8_t> changed(a.action.size());
    const auto compare = [&](const auto& left, const auto& right) {
        for (std::size_t fish = 0; fish < changed.size(); ++fish)
            changed[fish] = static_cast<std::uint8_t>(changed[fish] | (left[fish] != right[fish]));
    };
    compare(a.action, b.action);
    compare(a.phaseRate, b.phaseRate);
    compare(a.brake, b.brake);
    compare(a.mouth, b.mouth);
    compare(a.gaze, b.gaze);
    compare(a.pitch, b.pitch);
    compare(a.yawRate, b.yawRate);
    return changed;
}

// One description of the code, for both directions: each function is given what is wanted and
// returns what it is, which for an encoder is the same.
template <class Coder>
class StepCode {
  public:
    // `changed`: of each fish, whether any of its commands changes; empty for a decoder.
    StepCode(Coder& coder,
             StepMemory& memory,
             Tick tick,
             motion::MotorCommands& known,
             std::span<const std::uint8_t> changed)
        : coder_(coder),
          models_(memory.models),
          memory_(memory),
          tick_(tick),
          known_(known),
          changed_(changed) {}

    // False: a decoder has read a command that does not exist.
    bool commands(const motion::MotorCommands& wanted) {
        wanted_ = &wanted;
        const std::size_t fish = known_.action.size();
        for (std::size_t first = 0; first < fish; first += kTicksBetweenDecisions)
            eight(first, std::min<std::size_t>(first + kTicksBetweenDecisions, fish));
        return isGood_;
    }

    // The number of placed fish, then each.
    std::uint32_t count(std::uint32_t wanted) {
        const std::uint32_t few = tree<8>(models_.placed, std::min(wanted, kManyPlaced));
        return few < kManyPlaced ? few : coder_.plain(kFishBits, wanted);
    }
    PlacedFish placed(const PlacedFish& wanted) {
        using Words = std::array<std::uint32_t, sizeof(motion::FishRecord) / sizeof(std::uint32_t)>;
        auto words = std::bit_cast<Words>(wanted.record);
        PlacedFish placed;
        placed.fish = coder_.plain(kFishBits, wanted.fish);
        for (std::uint32_t& word : words)
            word = coder_.plain(16, word >> 16U) << 16U | coder_.plain(16, word & 0xFFFFU);
        placed.record = std::bit_cast<motion::FishRecord>(words);
        return placed;
    }

  private:
    template <unsigned bits>
    std::uint32_t tree(Tree<bits>& models, std::uint32_t wanted) {
        std::uint32_t node = 1;
        for (unsigned at = bits; at-- > 0;)
            node = node << 1U |
                   static_cast<std::uint32_t>(coder_.bit(models[node], (wanted >> at & 1U) != 0));
        return node - (1U << bits);
    }

    // Eight fish in a row, of which one decides at this tick.
    void eight(std::size_t first, std::size_t last) {
        const std::size_t decides = first + (first - tick_.value + 1) % kTicksBetweenDecisions;
        const bool anyOther = coder_.bit(models_.others, othersChange(first, last, decides));
        if (!anyOther) return decides < last ? decision(decides) : void();
        for (std::size_t fish = first; fish < last; ++fish) {
            const std::size_t after = (fish - decides) % kTicksBetweenDecisions;
            if (after == 0)
                decision(fish);
            else if (coder_.bit(models_.other[after][manner(known_.action[fish])], changes(fish)))
                change(fish);
        }
    }

    // Of what is wanted; a decoder reads it.
    [[nodiscard]] bool changes(std::size_t fish) const {
        return !changed_.empty() && changed_[fish] != 0;
    }
    [[nodiscard]] bool othersChange(std::size_t first, std::size_t last, std::size_t but) const {
        bool any = false;
        for (std::size_t fish = first; fish < last; ++fish)
            any = any || (fish != but && changes(fish));
        return any;
    }

    void decision(std::size_t fish) {
        std::uint8_t& recent = memory_.recentlyChanged[fish];
        const bool isNew =
            coder_.bit(models_.decides[manner(known_.action[fish])][recent], changes(fish));
        recent = static_cast<std::uint8_t>((recent << 1U | unsigned{isNew}) & 3U);
        if (isNew) change(fish);
    }

    // Which commands of a fish change. A rate that changes in proportion with its action does not
    // count.
    unsigned changesOf(std::size_t fish) {
        const motion::MotorCommands& to = *wanted_;
        const bool acts = to.action[fish] != known_.action[fish];
        const std::int32_t expected = acts ? expectedRate(known_.phaseRate[fish],
                                                          recordedOf(fish, known_.action[fish]),
                                                          recordedOf(fish, to.action[fish]))
                                           : known_.phaseRate[fish];
        return (acts ? kAction : 0U) | (to.phaseRate[fish] != expected ? kRate : 0U) |
               (to.brake[fish] != known_.brake[fish] ? kBrake : 0U) |
               (to.mouth[fish] != known_.mouth[fish] ? kMouth : 0U) |
               (to.gaze[fish] != known_.gaze[fish] ? kGaze : 0U) |
               (to.pitch[fish] != known_.pitch[fish] ? kPitch : 0U) |
               (to.yawRate[fish] != known_.yawRate[fish] ? kYaw : 0U);
    }

    std::int32_t recordedOf(std::size_t fish, std::uint8_t action) {
        if (memory_.rates.empty()) return 0;
        while (memory_.rates[kind_].last <= fish) ++kind_;
        while (memory_.rates[kind_].first > fish) --kind_;
        return memory_.rates[kind_].phaseRate[action];
    }

    void change(std::size_t fish) {
        std::uint8_t& last = memory_.lastChanges[fish];
        // What counts of the last change: action, gaze, pitch, yaw.
        const unsigned context =
            (last & kAction) | ((last & kGaze) >> 3U) | ((last & (kPitch | kYaw)) >> 3U);
        const std::uint32_t changes = tree<7>(models_.changes[context], changesOf(fish));
        last = static_cast<std::uint8_t>(changes);
        const std::uint8_t before = known_.action[fish];
        if ((changes & kAction) != 0) action(fish);
        if (!isGood_) return;
        rate(fish, before, (changes & kRate) != 0);
        if ((changes & kBrake) != 0) brake(fish);
        if ((changes & kMouth) != 0)
            known_.mouth[fish] =
                static_cast<std::uint8_t>(tree<8>(models_.mouth, wanted_->mouth[fish]));
        if ((changes & kGaze) != 0) gaze(fish);
        if ((changes & kPitch) != 0) pitch(fish);
        if ((changes & kYaw) != 0) yaw(fish);
    }

    void action(std::size_t fish) {
        std::uint8_t& known = known_.action[fish];
        const auto read = tree<6>(models_.action[known], wanted_->action[fish]);
        isGood_ = isGood_ && read < motion::kActions;
        if (isGood_) known = static_cast<std::uint8_t>(read);
    }

    void rate(std::size_t fish, std::uint8_t before, bool changes) {
        std::int16_t& known = known_.phaseRate[fish];
        const std::uint8_t action = known_.action[fish];
        const std::int32_t was = recordedOf(fish, before);
        const std::int32_t recorded = recordedOf(fish, action);
        const std::int32_t expected = action == before ? known : expectedRate(known, was, recorded);
        known = static_cast<std::int16_t>(
            changes ? changedRate(levelOf(known, was), recorded, expected, wanted_->phaseRate[fish])
                    : expected);
    }

    std::int32_t changedRate(std::int32_t levelBefore,
                             std::int32_t recorded,
                             std::int32_t expected,
                             std::int32_t wanted) {
        const auto level = static_cast<std::int32_t>(
            tree<6>(models_.rate[static_cast<std::size_t>(levelBefore)],
                    static_cast<std::uint32_t>(levelOf(wanted, recorded))));
        if (level > 0 && recorded > 0) return rateOf(level, recorded);
        const std::int32_t off = wanted - expected;
        const bool isNear = off >= -kFarthestRateOff && off <= kFarthestRateOff;
        const auto read = static_cast<std::int32_t>(tree<4>(
            models_.rateOff, isNear ? static_cast<std::uint32_t>(off + kFarthestRateOff + 1) : 0U));
        if (read > 0) return (expected + read - kFarthestRateOff - 1) & kMostRate;
        return static_cast<std::int32_t>(coder_.plain(15, static_cast<std::uint32_t>(wanted)));
    }

    void brake(std::size_t fish) {
        std::uint8_t& known = known_.brake[fish];
        const auto level = static_cast<std::int32_t>(
            tree<4>(models_.brake[static_cast<std::size_t>(brakeLevelOf(known))],
                    static_cast<std::uint32_t>(brakeLevelOf(wanted_->brake[fish]))));
        known = level > kBrakeLevels
                    ? static_cast<std::uint8_t>(coder_.plain(8, wanted_->brake[fish]))
                    : static_cast<std::uint8_t>(kMostBrake * level / kBrakeLevels);
    }

    // Aside and up are four bits each, and turn round.
    void gaze(std::size_t fish) {
        std::uint8_t& known = known_.gaze[fish];
        const unsigned to = wanted_->gaze[fish];
        const unsigned aside = tree<4>(models_.gazeAside[known & 15U], (to - known) & 15U);
        const unsigned up =
            tree<4>(models_.gazeUp[aside == 0 ? 1 : 0], ((to >> 4U) - (known >> 4U)) & 15U);
        known =
            static_cast<std::uint8_t>(((known + aside) & 15U) | (((known >> 4U) + up) & 15U) << 4U);
    }

    void pitch(std::size_t fish) {
        std::int16_t& known = known_.pitch[fish];
        const std::int32_t to = wanted_->pitch[fish];
        const bool hasLevel = to % kPitchLevel == 0 && known % kPitchLevel == 0;
        const std::int32_t levels = (to - known) / kPitchLevel;
        const bool isNear = hasLevel && levels > -kMiddlePitch && levels < kMiddlePitch;
        const auto read = static_cast<std::int32_t>(
            tree<7>(models_.pitch[manner(known_.action[fish])],
                    isNear ? static_cast<std::uint32_t>(levels + kMiddlePitch) : 0U));
        known = static_cast<std::int16_t>(
            read > 0 ? known + (read - kMiddlePitch) * kPitchLevel
                     : static_cast<std::int32_t>(coder_.plain(16, static_cast<std::uint16_t>(to))));
    }

    void yaw(std::size_t fish) {
        std::int16_t& known = known_.yawRate[fish];
        const std::int32_t to = wanted_->yawRate[fish];
        const std::size_t wasZero = known == 0 ? 1 : 0;
        if (coder_.bit(models_.yawIsZero[wasZero], to == 0)) {
            known = 0;
            return;
        }
        const bool isLeft = coder_.bit(models_.yawIsLeft[known > 0 ? 1 : 0], to > 0);
        const auto size = static_cast<std::uint32_t>(to > 0 ? to : -(to + 1));
        const std::uint32_t high = tree<7>(models_.yawHigh, size >> 8U & 0x7FU);
        const std::uint32_t low = tree<8>(models_.yawLow[high & 15U], size & 0xFFU);
        const auto read = static_cast<std::int32_t>(high << 8U | low);
        known = static_cast<std::int16_t>(isLeft ? read : -read - 1);
    }

    Coder& coder_;
    StepModels& models_;
    StepMemory& memory_;
    Tick tick_;
    motion::MotorCommands& known_;
    std::span<const std::uint8_t> changed_;
    const motion::MotorCommands* wanted_ = nullptr;
    std::size_t kind_ = 0;  // of the fish that was looked at last
    bool isGood_ = true;
};

}  // namespace

StepMemory makeStepMemory(std::vector<RecordedRates> rates, std::size_t fish) {
    StepMemory memory{{}, std::move(rates), {}, {}};
    std::array<BitModel, sizeof(StepModels) / sizeof(BitModel)> even{};
    even.fill(kEven);
    memory.models = std::bit_cast<StepModels>(even);
    memory.lastChanges.resize(fish);
    memory.recentlyChanged.resize(fish);
    return memory;
}

std::vector<std::byte> encodeStep(Tick tick,
                                  const motion::MotorCommands& commands,
                                  std::span<const PlacedFish> placed,
                                  motion::MotorCommands& known,
                                  StepMemory& memory) {
    assert(commands.action.size() == known.action.size());
    RangeEncoder encoder;
    const std::vector<std::uint8_t> changed = changedIn(commands, known);
    StepCode code(encoder, memory, tick, known, changed);
    code.commands(commands);
    code.count(static_cast<std::uint32_t>(placed.size()));
    for (const PlacedFish& fish : placed) code.placed(fish);
    return encoder.finish();
}

std::optional<std::vector<PlacedFish>> decodeStep(Tick tick,
                                                  std::span<const std::byte> step,
                                                  motion::MotorCommands& known,
                                                  StepMemory& memory) {
    RangeDecoder decoder(step);
    StepCode code(decoder, memory, tick, known, {});
    if (!code.commands(known)) return std::nullopt;
    const std::uint32_t count = code.count(0);
    if (count > known.action.size()) return std::nullopt;
    std::vector<PlacedFish> placed(count);
    for (PlacedFish& fish : placed) {
        fish = code.placed({});
        if (fish.fish >= known.action.size() || !motion::isPlayable(fish.record))
            return std::nullopt;
    }
    return placed;
}

}  // namespace aquarama::school
