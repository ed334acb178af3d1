// SPDX-License-Identifier: Apache-2.0
// What master and nodes say to each other, as plain data. Protobuf's types stay inside this
// folder's .cpp files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/config/rig.h"
#include "common/motion/motion_state.h"
#include "common/units/digest.h"
#include "common/units/units.h"
#include "common/wire/food_record.h"

namespace aquarama::wire {

// The submarine: where the wall's origin is in the world.
struct Eye {
    glm::vec3 positionMetres{};
    glm::quat worldFromWall{1, 0, 0, 0};
};

// All that a frame shows; nothing before it is needed to draw it. `before` and `foodBefore` are
// empty where fraction is 1: the frame shows the tick itself. Else the frame shows the moment
// between tick - 1 (before) and tick (after).
struct StateFrame {
    Frame frame;
    Tick tick;
    float fraction = 1.0F;
    Eye eye;
    std::uint64_t worldHash = 0;
    std::vector<motion::FishRecord> before;
    std::vector<motion::FishRecord> after;
    glm::vec3 foodOriginMetres{};  // of FoodRecord::offsetMetres
    std::vector<FoodRecord> foodBefore;
    std::vector<FoodRecord> foodAfter;
    float daylight = 1.0F;  // of the sky: 1 at noon, less towards the night, never below 0
    config::QualityTier quality = config::QualityTier::Low;  // of the whole wall
};

enum class Pace : std::uint8_t { Live, Lockstep };
// What the channels show: the world, or a pattern for setting up and for tests.
enum class Pattern : std::uint8_t { World, Grid, Grey };

// The fish of one species: in the school they follow those of the species before it.
struct SpeciesBlobs {
    Digest species;     // blob: the species file
    Digest repertoire;  // blob: encodeRepertoire
    std::uint32_t fish = 0;
    friend bool operator==(const SpeciesBlobs&, const SpeciesBlobs&) = default;
};

// What a node needs to take part, sent in answer to its hello.
struct Welcome {
    std::string rigText;       // of the rig's file
    std::string sceneText;     // of the scene's file; how many fish there are: see cast
    std::string stateAddress;  // where the states are published
    std::uint32_t seed = 0;
    Pace pace = Pace::Live;
    Pattern pattern = Pattern::World;
    std::vector<motion::FishTraits> school;
    std::vector<SpeciesBlobs> cast;  // of all fish of the school, in its order
    std::optional<config::QualityTier> quality =
        {};  // of the whole wall; nothing: the node measures its own
};

}  // namespace aquarama::wire
