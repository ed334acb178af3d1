// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/steering.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>

#include <spdlog/fmt/fmt.h>

#include "master/conductor/simulation_thread.h"

namespace aquarama::conductor {

namespace {

constexpr net::Duration kSilence = kTicksOfAHand * kTickPeriod;
// A window reports its steering thirty times a second; what comes much more often is ignored.
constexpr net::Duration kBetween = std::chrono::milliseconds(8);
constexpr std::size_t kMostPilots = 256;

constexpr int kNotches = 4;  // to either side

struct Key {
    std::string_view bytes;
    std::int8_t Steering::*axis;
    int notches;
};
// Terminals send arrows and pages as escape sequences; none begins as another does.
constexpr std::array kKeys{
    Key{"w", &Steering::ahead, 1},
    Key{"s", &Steering::ahead, -1},
    Key{"d", &Steering::aside, 1},
    Key{"a", &Steering::aside, -1},
    Key{"\x1b[A", &Steering::up, 1},
    Key{"\x1b[B", &Steering::up, -1},
    Key{"\x1b[5~", &Steering::up, 1},
    Key{"\x1b[6~", &Steering::up, -1},
    Key{"\x1b[D", &Steering::turn, 1},
    Key{"\x1b[C", &Steering::turn, -1},
    Key{"r", &Steering::tilt, 1},
    Key{"f", &Steering::tilt, -1},
};

struct Word {
    std::int8_t Steering::*axis;
    std::string_view plus, minus;
};
constexpr std::array kWords{
    Word{&Steering::ahead, "ahead", "back"},
    Word{&Steering::aside, "to the right", "to the left"},
    Word{&Steering::up, "rising", "sinking"},
    Word{&Steering::turn, "turning left", "turning right"},
    Word{&Steering::tilt, "nose up", "nose down"},
};

std::int8_t moved(std::int8_t axis, int notches) {
    const int notch = (axis * kNotches + (axis < 0 ? -64 : 64)) / kFullSteering + notches;
    return static_cast<std::int8_t>(std::clamp(notch, -kNotches, kNotches) * kFullSteering /
                                    kNotches);
}

}  // namespace

bool InputArbitration::holds(const HeldInput& input, net::Moment now) {
    return input.holds && now - input.heard < kSilence;
}

void InputArbitration::forgetTheSilent(net::Moment now) {
    std::erase_if(inputs_, [&](const auto& one) { return now - one.second.heard >= kSilence; });
}

bool InputArbitration::mayTake(const HeldInput& input, bool begins) const {
    const auto holder = inputs_.find(holder_);
    const bool isFree = holder == inputs_.end() || !holder->second.holds;
    return isFree || (begins && (!input.yields || holder->second.yields));
}

bool InputArbitration::accepts(const net::PeerId& pilot, const PilotHand& hand, net::Moment now) {
    forgetTheSilent(now);
    const bool holdsNow = hand.steering != Steering{};
    const auto known = inputs_.find(pilot);
    if (known == inputs_.end() && (!holdsNow || inputs_.size() >= kMostPilots)) return false;
    HeldInput& input = inputs_[pilot];
    const bool held = input.holds;
    if (held && holdsNow && now - input.heard < kBetween) return false;
    input = {holdsNow, hand.yields, now};
    if (holdsNow && mayTake(input, !held)) holder_ = pilot;
    return holder_ == pilot && (holdsNow || held);
}

std::optional<net::PeerId> InputArbitration::pilot(net::Moment now) const {
    const auto holder = inputs_.find(holder_);
    if (holder == inputs_.end() || !holds(holder->second, now)) return std::nullopt;
    return holder_;
}

void TerminalSteering::press(std::string_view bytes) {
    constexpr char kInterrupt = '\x03';
    constexpr char kEscape = '\x1b';
    while (!bytes.empty()) {
        const auto key = std::ranges::find_if(
            kKeys, [&](const Key& known) { return bytes.starts_with(known.bytes); });
        if (key != kKeys.end()) {
            steering_.*(key->axis) = moved(steering_.*(key->axis), key->notches);
            bytes.remove_prefix(key->bytes.size());
            continue;
        }
        const char first = bytes.front();
        if (first == ' ') steering_ = {};
        if (first == 'q' || first == kInterrupt || bytes == std::string_view(&kEscape, 1))
            ended_ = true;
        bytes.remove_prefix(1);
    }
}

std::string TerminalSteering::text() const {
    std::string text;
    for (const auto& [axis, plus, minus] : kWords) {
        const int notch = (std::abs(steering_.*axis) * kNotches + 64) / kFullSteering;
        if (notch == 0) continue;
        text += fmt::format("{}{} {}/{}",
                            text.empty() ? "" : ", ",
                            steering_.*axis > 0 ? plus : minus,
                            notch,
                            kNotches);
    }
    return text.empty() ? "hands off" : text;
}

}  // namespace aquarama::conductor
