// SPDX-License-Identifier: Apache-2.0
// One packet: whose run it belongs to and what it says; the only thing that crosses the wire.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "common/units/digest.h"
#include "common/units/units.h"
#include "common/wire/messages.h"

namespace aquarama::wire {

inline constexpr std::uint32_t kProtocolMajor = 1;  // peers refuse any other

// Nothing larger is encoded, nor looked at when it arrives.
inline constexpr std::size_t kMostNameBytes = 64;
inline constexpr std::size_t kMostReasonBytes = 1024;
inline constexpr std::size_t kMostRigTextBytes = std::size_t{1} << 20U;
inline constexpr std::size_t kMostSceneTextBytes = std::size_t{1} << 20U;
inline constexpr std::size_t kMostBlobBytes = std::size_t{64} << 20U;
inline constexpr std::size_t kBlobChunkBytes = std::size_t{256} << 10U;
inline constexpr std::size_t kMostNodes = 256;
inline constexpr float kMostInputMetres = 10'000;  // of a position, on each axis
inline constexpr std::size_t kMostExplanationLines = 48;
inline constexpr std::size_t kMostExplanationLineBytes = 120;
inline constexpr std::size_t kMostSmallPacketBytes = std::size_t{64} << 10U;  // all but
// welcomes, states and chunks; nothing larger ever goes from a node to the master
inline constexpr std::size_t kMostPacketBytes = std::size_t{64} << 20U;  // two states of kMostFish

struct Hello {
    std::string channel;
    std::uint32_t major = kProtocolMajor;
    std::string build;
};

struct Refusal {
    std::string reason;
};

struct BlobRequest {
    Digest digest;
    std::uint64_t offset = 0;
};

struct BlobChunk {
    Digest digest;
    std::uint64_t offset = 0;
    std::uint64_t total = 0;
    std::vector<std::byte> content;
};

// The node has built all that it needs and hears the state channel. It would keep up with this
// tier.
struct Prepared {
    config::QualityTier quality = config::QualityTier::Low;
};

// The answer to Prepared: from this frame on the node is waited for.
struct Joined {
    Frame first;
};

// Tells a fresh subscriber that it hears the state channel.
struct Beacon {};

// When a node let go of a frame, in nanoseconds of the master's clock.
struct ReleaseReport {
    Frame frame;
    std::int64_t atNs = 0;
};

struct Ready {
    Frame frame;
    std::optional<ReleaseReport> released;  // of an earlier frame
};

struct Present {
    Frame frame;
    std::int64_t atNs = 0;  // in the master's clock; 0: at once
};

// The master does not count this node (any more): say hello (again).
struct Dismissed {
    std::string reason;
};

// From the master: the show is over. From a node: it leaves.
struct Farewell {};

struct Ping {
    std::int64_t sentNs = 0;
};

struct Pong {
    std::int64_t sentNs = 0;    // the ping's, in the node's clock
    std::int64_t masterNs = 0;  // in the master's
};

enum class InputKind : std::uint8_t { Quit, TogglePause, DropFood, Steer };
struct Input {
    InputKind kind = InputKind::Quit;
    glm::vec3 positionMetres{};  // of the food, world frame
    Steering steering = {};      // of the submarine
};

struct StatusRequest {};

enum class NodeCondition : std::uint8_t { Absent, Preparing, InStep, Late };
struct NodeStatus {
    std::string name;
    NodeCondition condition = NodeCondition::Absent;
    std::uint64_t late = 0;     // deadlines missed
    std::uint64_t dropped = 0;  // times that it fell silent and was no longer counted
};

struct StatusReply {
    Pace pace = Pace::Live;
    bool paused = false;
    Frame frame;
    Tick tick;
    float frameMedianMs = 0, frameP99Ms = 0;  // between two releases
    float skewMedianMs = 0, skewP99Ms = 0;    // latest minus earliest release of one frame
    std::uint64_t refusedPackets = 0;         // noise, strangers, other versions
    std::vector<NodeStatus> nodes;
    Eye eye;  // of the last state
    float speedMetresPerSecond = 0;
    std::string pilot;  // the window whose hand steers; empty: nobody's
};

// Asks what goes on in the mind of a fish; anybody may.
struct ExplainRequest {
    std::uint32_t fish = 0;
};

struct Explanation {
    std::uint32_t fish = 0;
    std::uint32_t school = 0;  // so many fish there are, 0 to school - 1; others have no lines
    Tick tick;
    std::vector<std::string> lines;  // printable ASCII
};

using Message = std::variant<Hello,
                             Refusal,
                             Welcome,
                             BlobRequest,
                             BlobChunk,
                             Prepared,
                             Joined,
                             StateFrame,
                             Beacon,
                             Ready,
                             Present,
                             Dismissed,
                             Farewell,
                             Ping,
                             Pong,
                             Input,
                             StatusRequest,
                             StatusReply,
                             ExplainRequest,
                             Explanation>;

struct Envelope {
    std::uint64_t session = 0;  // of the master's run; 0 where the node has not been welcomed yet
    Message message;
};

using Packet = std::vector<std::byte>;

[[nodiscard]] Packet encode(const Envelope& envelope);
// The frame loop's way: the state is not copied into an Envelope first.
[[nodiscard]] Packet encodeState(std::uint64_t session, const StateFrame& state);

// Empty: truncated, malformed, out of bounds. Never takes more memory than a small multiple of the
// packet's own size. A hello of another major version is read: its sender is to be told.
[[nodiscard]] std::optional<Envelope> decode(std::span<const std::byte> packet);

}  // namespace aquarama::wire
