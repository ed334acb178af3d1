// SPDX-License-Identifier: Apache-2.0
// The biomechanical fish under its motor controllers: its attitude as the controllers sense it, the
// orders that it obeys, and the simulation that runs both.
#pragma once

#include <array>
#include <cstdint>

#include "capture/biomechanical_fish.h"
#include "common/config/species.h"

namespace aquarama::capture {

// Attitude of the body frame in the world, y up.
struct BodyAngles {
    double headingRadians = 0;  // of the body axis in the horizontal plane, left of +x positive
    double pitchRadians = 0;    // nose up positive
    double rollRadians = 0;     // right side up positive
    // Change of the sensed pitch, radians a second; 0 without a filter.
    double pitchRate = 0;
};

// Heading and roll in -pi .. pi, pitch in -pi/2 .. pi/2; without any filter.
[[nodiscard]] BodyAngles bodyAnglesOf(const FishState& state);

// The angles that the fish senses now, from those that it sensed before. Heading and pitch pass a
// first-order low pass, since the tail beat makes them oscillate: `share`, 0 to 1, of the
// difference is taken up in this step of `stepSeconds`. Roll is not filtered: the beat does not
// roll the fish, and a delay in the roll feedback would make it oscillate.
[[nodiscard]] BodyAngles sense(const BodyAngles& before,
                               const FishState& state,
                               double share,
                               double stepSeconds);

// The nine motor controllers (the paper's section 3.2), and ours.
enum class Controller : std::uint8_t {
    ForwardSwim,
    LeftTurn,
    RightTurn,
    Glide,
    Ascend,
    Descend,
    Balance,
    Brake,
    Retreat,
    // Not of the paper's nine.
    LeftStart,
    RightStart,
    Hover,      // in its place, by rowing
    LeftPivot,  // turns in its place, by rowing
    PitchUp     // pitches in its place, by rowing
};

// A command to the fish, which replaces the one before. A turn is over after secondsOf(bend); then
// the muscles stay relaxed until the next order. Each parameter is read only by the controllers
// named beside it.
struct Order {
    Controller controller = Controller::Glide;
    config::Gait gait{};      // of all that swim or row
    config::Bend bend{};      // LeftTurn, RightTurn
    double pitchRadians = 0;  // Ascend, Descend: slope of the body axis, positive in both
    double bendShare = 1;     // LeftStart, RightStart: of the time of the bend
    // ForwardSwim on a curve: the left muscles pull more by this share, the right ones less.
    double curve = 0;
    // ForwardSwim on a loop: both pectoral fins turn by this from parallel to the flow, radians;
    // the fish pitches up.
    double liftRadians = 0;
    // ForwardSwim on a curve, LeftTurn, RightTurn: the roll into the bend, positive.
    double bankRadians = 0;
};

// A simulated fish. It starts at rest at the origin with its nose towards +x. Lengths are body
// lengths. A value: a copy continues on its own. Not for use by several threads at once.
class Swimmer {
  public:
    // A fish of the species; without a step, longestStepSeconds() is used.
    explicit Swimmer(const config::Species& species);
    Swimmer(const config::Species& species, double stepSeconds);
    // This fish, with the muscle programs of the species.
    Swimmer(const BiomechanicalFish& fish, const config::Species& species, double stepSeconds);

    // Holds from the next step on. The phase of the beat continues through all orders. The muscles
    // change from the old program to the new one within a few hundredths of the fish's own second.
    // When a fish stops swimming, its tail beat fades out over half a beat.
    void give(const Order& order);
    void advance(int steps);  // steps >= 0

    // Length of one step.
    [[nodiscard]] double stepSeconds() const { return stepSeconds_; }
    // Simulated since the start.
    [[nodiscard]] double seconds() const { return stepSeconds_ * static_cast<double>(steps_); }
    [[nodiscard]] const FishState& state() const { return state_; }
    [[nodiscard]] const MotorControl& control() const { return control_; }  // of the last step
    // How the pectoral fins stand, left and right: opened, carried by the stroke, twisted, radians.
    // A fin that does not row lies on the flank, twisted by what it trims.
    [[nodiscard]] std::array<glm::dvec3, 2> fins() const;
    // Phase of the beat of the tail or, where they row, of the fins; cycles, 0 to 1.
    [[nodiscard]] double beat() const { return beat_; }

  private:
    void advanceOne();
    // Time of the order, of swimming and of the beat; `seconds` are not the fish's own.
    void advanceClocks(double seconds);
    // Whether the present order beats the tail, and whether it is a fast start.
    [[nodiscard]] bool swims() const;
    [[nodiscard]] bool starts() const;
    // What all actuators do at this instant.
    [[nodiscard]] MotorControl program() const;
    // The wanted state of muscles and fins at this instant under the present order, without the
    // transition from the order before.
    [[nodiscard]] MuscleActivation muscleProgram() const;
    [[nodiscard]] MuscleActivation tailBeat(double gain) const;
    [[nodiscard]] FinPlates finProgram() const;
    // The fins as they hold a pitch and a roll.
    [[nodiscard]] FinPlates held(double pitchRadians, double rollRadians = 0) const;
    // Of the centre of mass along the body axis, body lengths a second.
    [[nodiscard]] double forwardSpeed() const;
    // Whether the fish balances backwards, or too slowly for the plates: other fins right it.
    [[nodiscard]] bool balancesWithoutGrip() const;
    // Whether the fins row under the present order, and how they do.
    [[nodiscard]] bool rows() const;
    [[nodiscard]] RowingControl rowingProgram() const;
    // Under the present order: the roll that the fins hold, and their lift on a loop; radians.
    [[nodiscard]] double bank() const;
    [[nodiscard]] double lift() const;
    [[nodiscard]] BodyAngles foreseen() const;

    BiomechanicalFish fish_;
    config::Species species_;
    double stepSeconds_;
    std::int64_t steps_ = 0;
    FishState state_;

    Order order_;
    // The fish's own seconds (timeScale of them in one second): since the present order, and in all
    // orders that beat the tail.
    double ownSecondsOfOrder_ = 0;
    double ownSecondsSwum_ = 0;
    config::Gait beating_{};  // of the tail, or of fins that row
    config::Gait fading_{};   // the tail beat of the order before, which fades out
    double beat_ = 0;         // phase of the beat, 0 to 1
    BodyAngles attitude_;     // as sensed
    // Of the centre of mass, as sensed: its height, that when the order came, and its rise a
    // second.
    double height_ = 0, heightOfOrder_ = 0, rise_ = 0;
    MotorControl control_;
    MuscleActivation musclesBefore_;  // activations when the order came
};

}  // namespace aquarama::capture
