// SPDX-License-Identifier: Apache-2.0
// Convergence after dead reckoning: fish glide from where the picture had them to where the master
// has them. Only the picture; what the node follows is the master's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/motion/motion_state.h"
#include "common/wire/messages.h"

namespace aquarama::session {

// Each fish keeps its difference at first, and loses it in one to eight seconds, the slower the
// farther it has to go. Its body changes from the pose it had, as in a motion warp. A fish that is
// farther off than three metres, or comes, is shown where the master has it. Used by the net
// thread.
class Convergence {
  public:
    Convergence() { scratch_.resize(1); }
    // `shown`: what the picture would show next; `first`: the master's frame that takes its place.
    void begin(const wire::StateFrame& shown, const wire::StateFrame& first);
    // Adds what is left of the difference to the fish of a frame.
    void apply(wire::StateFrame& frame);
    void end() { gliding_.clear(); }

  private:
    struct Gliding {
        std::size_t fish = 0;
        glm::vec3 metres{};          // the picture less the master's
        glm::quat turn{1, 0, 0, 0};  // from the master's rotation to that of the picture
        float seconds = 0;           // that it takes
        std::uint16_t from = 0, fromPhase = 0, to = 0;  // segments of the change of pose
    };
    // Nothing: the fish is shown where the master has it.
    [[nodiscard]] static std::optional<Gliding> glidingBetween(const wire::StateFrame& shown,
                                                               const wire::StateFrame& first,
                                                               std::size_t fish);
    void apply(double world, std::vector<motion::FishRecord>& records);
    void move(motion::FishRecord& record, const Gliding& one, float left);
    static void pose(motion::FishRecord& record, const Gliding& one, std::uint8_t ticks);

    double begun_ = 0;  // the moment of the world, in ticks
    std::vector<Gliding> gliding_;
    motion::MotionStates scratch_;  // a fish, to unpack and pack its record
};

}  // namespace aquarama::session
