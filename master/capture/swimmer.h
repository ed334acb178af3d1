// SPDX-License-Identifier: Apache-2.0
// How a fish lies in the water, as its controllers sense it.
#pragma once

#include <cstdint>

#include "common/config/species.h"
#include "master/capture/biomechanical_fish.h"

namespace aquarama::capture {

struct BodyAngles {
    double headingRadians = 0;  // of the body's axis over the horizon, left of +x positive
    double pitchRadians = 0;    // nose up positive
    double rollRadians = 0;     // right side up positive
};

[[nodiscard]] BodyAngles bodyAnglesOf(const FishState& state);

// What is sensed now, after what was sensed before: heading and pitch by a low pass, which goes a
// share of the way, for the tail beat sways them. It does not roll the fish, and roll that is
// sensed late would rock it.
[[nodiscard]] BodyAngles sense(const BodyAngles& before, const FishState& state, double share);

// The biomechanical fish under its motor controllers: what is captured, and what a replica is
// measured against.

enum class Controller : std::uint8_t {
    ForwardSwim,
    LeftTurn,
    RightTurn,
    Glide,
    Ascend,
    Descend,
    Balance,
    Brake,
    Retreat
};

// What the fish is told. It holds until the next order, but a turn is over after secondsOf(bend);
// then the muscles stay relaxed.
struct Order {
    Controller controller = Controller::Glide;
    config::Gait gait{};      // ForwardSwim, Ascend, Descend, Balance, Retreat
    config::Bend bend{};      // LeftTurn, RightTurn
    double pitchRadians = 0;  // Ascend, Descend: how steep, positive in both
};

// From rest at the origin, nose towards +x. Lengths are body lengths.
class Swimmer {
  public:
    explicit Swimmer(const config::Species& species);  // at the longest step that swims well
    Swimmer(const config::Species& species, double stepSeconds);
    Swimmer(const BiomechanicalFish& fish, const config::Swim& swim, double stepSeconds);

    // From now on. The beat keeps time through all orders; muscles change over within a few
    // hundredths of the fish's second, and a fish that stops swimming lets half a beat die away.
    void give(const Order& order);
    void advance(int steps);

    [[nodiscard]] double stepSeconds() const { return stepSeconds_; }
    [[nodiscard]] double seconds() const { return stepSeconds_ * static_cast<double>(steps_); }
    [[nodiscard]] const FishState& state() const { return state_; }
    [[nodiscard]] const MotorControl& control() const { return control_; }  // of the last step

  private:
    void advanceOne();
    [[nodiscard]] bool swims() const;
    [[nodiscard]] MuscleActivation muscleProgram() const;
    [[nodiscard]] MuscleActivation tailBeat(double share) const;
    [[nodiscard]] PectoralFins finProgram() const;

    BiomechanicalFish fish_;
    config::Swim swim_;
    double stepSeconds_;
    std::int64_t steps_ = 0;
    FishState state_;

    Order order_;
    double ownSecondsOfOrder_ = 0;
    double ownSecondsSwum_ = 0;
    config::Gait beating_{};  // of tail or fins
    double beat_ = 0;         // 0 to 1
    double headingOfOrder_ = 0;
    BodyAngles attitude_;  // as sensed
    MotorControl control_;
    MuscleActivation musclesBefore_;  // when the order came
};

}  // namespace aquarama::capture
