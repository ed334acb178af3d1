// SPDX-License-Identifier: Apache-2.0
// The kinematic replica: one fish moved by the motor of the show (motion::MotorStep).
#pragma once

#include <array>
#include <memory>

#include "capture/report/script.h"
#include "common/motion/motor.h"

namespace aquarama::report {

// A fish that is moved by the motor. It starts at the origin with forward_medium at phase 0, at
// that gait's speed. It is one metre long, so that metres are body lengths. Owns a copy of the
// repertoire; for one thread at a time.
class Replica {
  public:
    // Plays this repertoire.
    explicit Replica(const motion::Repertoire& repertoire);

    // Sets segment, tempo, pitch and brake for a manoeuvre; in force from the next tick on.
    void command(Manoeuvre manoeuvre);
    // A segment at `tempo` times its recorded phase rate, which must fit into 16 bits and not be
    // negative.
    void play(motion::Action action, double tempo);
    // 1/60 s. A swimming replica whose pitch is off plays the slope of its gait at the tempo 1; one
    // that hovers pitches in its place.
    void tick();

    // Replaces a segment of the repertoire that is not playing.
    void learn(motion::Action action, const motion::ActionSegment& segment);
    [[nodiscard]] motion::Action playing() const { return motion::actionOf(states_.segment[0]); }

    // While a cyclic segment plays, sets its phase to the one whose pose is nearest to `pose` (in
    // the body frame, body lengths) and keeps the direction of the mean frame. Does nothing during
    // a motion warp, a turn or a glide.
    void bringToPhaseOf(const capture::NodeVectors& pose);

    [[nodiscard]] TracePoint point() const;  // where it is now

  private:
    // Plays a segment without making it the wanted one.
    void begin(motion::Action action, double tempo);
    void takeSlope();
    void pitchInPlace();
    [[nodiscard]] float pitchSine() const;  // of the mean frame

    motion::Repertoire repertoire_;
    std::shared_ptr<const motion::MotorTables> tables_;  // of repertoire_
    motion::MotionStates states_;
    motion::MotorCommands commands_;
    motion::Action wanted_ = motion::Action::ForwardMedium;  // of the last command
};

}  // namespace aquarama::report
