// SPDX-License-Identifier: Apache-2.0
// The state of the world as it crosses the wire, as plain data, and its codec: steps of the fish
// (common/school), 8 bytes a particle of food, each checked on arrival. No protobuf type leaves the
// .cpp file; the small control packets are in messages.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/base/digest.h"
#include "common/base/units.h"
#include "common/config/rig.h"
#include "common/config/scan.h"
#include "common/config/scene.h"
#include "common/motion/motion_state.h"

namespace aquarama::v1 {  // generated from aquarama.proto
class Show;
class State;
}  // namespace aquarama::v1

namespace aquarama::wire {

// The bytes of one message on a channel.
using Packet = std::vector<std::byte>;

// How a show advances: by the clock, or frame by frame. Numbered as in aquarama.proto.
enum class Pace : std::uint8_t { Live = 1, Lockstep = 2 };
// What the channels show: the world, or a pattern for setting up and for tests. As above.
enum class Pattern : std::uint8_t { World = 1, Grid = 2, Grey = 3, Scan = 4 };
// As command lines and logs name them.
inline constexpr std::array<std::string_view, 4> kPatternNames{"world", "grid", "grey", "scan"};
[[nodiscard]] constexpr std::string_view nameOf(Pattern pattern) {
    return kPatternNames.at(static_cast<std::size_t>(pattern) - 1);
}
// One that can be chosen by its name alone, which a scan's cannot.
[[nodiscard]] constexpr std::optional<Pattern> patternNamed(std::string_view name) {
    const auto* const found = std::ranges::find(kPatternNames, name);
    if (found >= kPatternNames.end() - 1) return std::nullopt;
    return static_cast<Pattern>(found - kPatternNames.begin() + 1);
}

// Resolution of a position of food.
inline constexpr float kFoodUnitMetres = 1.0F / 8192.0F;
// Records of food in one state: plankton, and pellets.
inline constexpr std::size_t kMostFood = config::kMostPlankton + 256;

// Position from the cloud's origin, x | y << 20 | z << 40, each in 20-bit two's complement and
// units of 2^-13 m (64 m to each side; a finer step than a particle drifts in a tick, so that none
// is seen to stutter); kind << 60 | generation << 62. All zero: nothing is there.
struct FoodRecord {
    // What it is; None: an empty place of the list.
    enum class Kind : std::uint8_t { None, Plankton, Pellet };

    std::uint64_t bits = 0;

    // What is in this place.
    [[nodiscard]] Kind kind() const { return static_cast<Kind>(bits >> 60U & 3U); }
    // Modulo 4: another number is another particle in the same place of the list.
    [[nodiscard]] unsigned generation() const { return static_cast<unsigned>(bits >> 62U); }
    [[nodiscard]] glm::vec3 offsetMetres() const {
        const auto axis = [this](unsigned shift) {
            const auto signedBits = static_cast<std::int64_t>(bits << (44U - shift)) >> 44U;
            return static_cast<float>(signedBits) * kFoodUnitMetres;
        };
        return {axis(0), axis(20), axis(40)};
    }
    // A decoder refuses any other.
    [[nodiscard]] bool isPossible() const {
        return kind() <= Kind::Pellet && (kind() != Kind::None || bits == 0);
    }
    friend bool operator==(const FoodRecord&, const FoodRecord&) = default;
};
static_assert(sizeof(FoodRecord) == 8);

// The record of a particle at `offsetMetres` from the cloud's origin; an empty record where that is
// out of range or not a number. Of the generation the lowest two bits are kept.
[[nodiscard]] FoodRecord foodRecord(FoodRecord::Kind kind,
                                    glm::vec3 offsetMetres,
                                    unsigned generation);

// All food of one tick. A particle keeps its place in the list for as long as it is there.
struct FoodCloud {
    glm::vec3 originMetres{};  // world frame; the same in every tick of a show
    std::vector<FoodRecord> particles;
};

// The submarine: where the wall's origin is in the world.
struct Eye {
    glm::vec3 positionMetres{};
    glm::quat worldFromWall{1, 0, 0, 0};
};

// Dots that are drawn in a corner of the wall, as a code to be scanned: rows from the top, of
// columns from the left. Dot i is bit 7 - i % 8 of byte i / 8; lit where it is set.
struct Sign {
    std::uint32_t columns = 0, rows = 0;  // 0: there is none
    std::string dots;
    friend bool operator==(const Sign&, const Sign&) = default;
};

// What the whole wall shows, in every frame, as a node has received it. Only the master changes it,
// between two frames.
struct Show {
    std::uint64_t version = 0;  // grows with every change but those of brightness and pilot
    std::uint32_t look = 0;     // what nodes have built, and draw this frame with
    std::string scene;          // its name
    config::QualityTier quality = config::QualityTier::Low;
    Pattern pattern = Pattern::World;
    bool black = false;       // is wanted
    float brightness = 1.0F;  // share of the light, 0 to 1 in 255 steps: fades to what is wanted
    bool frozen = false;      // the world stands still
    std::string pilot;        // whose hand steers; empty: nobody's
    std::uint64_t calibration = 0;                 // shortHash() of the rig's text
    std::optional<config::ScanPattern> scan = {};  // where the pattern is Scan
    // Share of the colour that water takes which is given back, 0 to 1 in 255 steps.
    float colourReturned = 0.0F;
    Sign sign = {};
    std::optional<Digest> skins =
        {};  // of the blob of a v1::SkinList; nothing: no fish has its own
    friend bool operator==(const Show&, const Show&) = default;
};

// A step of the stream of the fish, as it travels.
struct SchoolStep {
    Tick tick;  // that it leads to
    std::vector<std::byte> code;
    // school::hashOf() afterwards: now and then.
    std::optional<std::uint64_t> hash = {};
};

// A part of the stream of the fish: steps in order, from a keyframe, or from what nodes have.
struct SchoolPart {
    std::uint64_t stream = 0;  // another number: another world
    std::vector<std::byte> keyframe = {};
    std::vector<SchoolStep> steps = {};
};

// All that a frame shows beside the fish. `foodBefore` is empty where fraction is 1: the frame
// shows the tick itself. Else the frame shows the moment between tick - 1 (before) and tick
// (after).
template <class FoodRecords, class Shown>
struct BasicState {
    Frame frame;
    Tick tick;
    float fraction = 1.0F;
    Eye eye;
    std::uint64_t worldHash = 0;
    glm::vec3 foodOriginMetres{};  // of FoodRecord::offsetMetres
    FoodRecords foodBefore;
    FoodRecords foodAfter;
    float timeOfDay = 0.5F;  // share of the day: 0 and 1 midnight, 0.5 noon
    Shown show{};
};
// What the master sends: views of the records of its snapshots, and of the message of what is
// shown, null until it is known.
using StateView = BasicState<std::span<const FoodRecord>, const v1::Show*>;
// What a node draws: owns its records. `before` is empty where fraction is 1.
struct StateFrame : BasicState<std::vector<FoodRecord>, Show> {
    std::vector<motion::FishRecord> before;
    std::vector<motion::FishRecord> after;
    // All frames between these two ticks have these fish: this node has moved none of them.
    bool areOfTick = false;
};
// What a node has received: a frame without its fish, and how it comes to them.
struct CodedState {
    StateFrame frame;
    SchoolPart school;
};

// The packet of a state whose `show` is known, of the master's run `session`.
[[nodiscard]] Packet encodeState(std::uint64_t session,
                                 const StateView& state,
                                 const SchoolPart& school);

// The state in a decoded message; empty where a field is missing, a record is impossible, or a
// number is not finite or out of range.
[[nodiscard]] std::optional<CodedState> readState(const v1::State& message);

// A part of the stream as a blob, and back; empty where the bytes are none, or out of bounds.
[[nodiscard]] std::vector<std::byte> encodeSchoolPart(const SchoolPart& school);
[[nodiscard]] std::optional<SchoolPart> readSchoolPart(std::span<const std::byte> blob);

}  // namespace aquarama::wire
