// SPDX-License-Identifier: Apache-2.0
// The control packets between master and nodes: generated messages (aquarama.proto), one encoder,
// and one decoder that checks every message against the bounds below. Included only by who speaks
// to a peer: master/conductor, render_node/session and the commands that ask a master.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/base/digest.h"
#include "common/base/units.h"
#include "common/base/wall_hands.h"
#include "common/config/rig.h"
#include "common/motion/motion_state.h"
#include "common/wire/aquarama.pb.h"
#include "common/wire/state_codec.h"

namespace aquarama::wire {

// Peers of another major version are refused.
inline constexpr std::uint32_t kProtocolMajor = 11;

// Bounds that the code keeps to. All bounds of arriving messages are rules of aquarama.proto; a
// test compares these with them.
inline constexpr std::size_t kMostNameBytes = 64;
inline constexpr std::size_t kMostReasonBytes = 1024;
inline constexpr std::size_t kMostReportBytes = 256;  // of a text of a node's report
inline constexpr std::size_t kMostLogBytes = 1000;    // of a line of a node's log
inline constexpr std::size_t kBlobChunkBytes = std::size_t{256} << 10U;
inline constexpr float kMostInputMetres = 10'000;  // of a position, on each axis
inline constexpr int kMostExplanationLines = 48;
inline constexpr std::size_t kMostExplanationLineBytes = 120;
inline constexpr std::size_t kMostSkinBytes = std::size_t{2} << 20U;  // of a drawing's PNG
inline constexpr int kMostDrawings = 256;                             // waiting and swimming
inline constexpr std::size_t kMostJpegBytes = std::size_t{60} << 10U;
inline constexpr float kFullLight = 255;  // of Show.brightness
inline constexpr float kAllColour = 255;  // of Show.colour_returned
// The fields of a larger packet are counted before it is parsed. Nothing larger goes from a node to
// the master.
inline constexpr std::size_t kMostSmallPacketBytes = std::size_t{64} << 10U;
inline constexpr std::size_t kMostPacketBytes = std::size_t{64} << 20U;  // a keyframe of kMostFish

// The packet of a message of the master's run `session`; 0 from a node that has not been welcomed.
[[nodiscard]] Packet encode(std::uint64_t session, v1::Envelope envelope);

// What precedes a packet of a master by a lease of etcd: the field Envelope.lease_revision.
[[nodiscard]] Packet leaseField(std::uint64_t revision);

// The message in a packet, within all bounds; empty where it is truncated, malformed or out of
// bounds. Of a state only the outside is checked, its content by readState(). Takes no more memory
// than a small multiple of the packet's own size. A hello of another major version is accepted: its
// sender is to be told.
[[nodiscard]] std::optional<v1::Envelope> decode(std::span<const std::byte> packet);

// Position x y z in metres, then w x y z of worldFromWall. Reading: empty where it is not seven
// finite numbers.
void writeEye(const Eye& eye, google::protobuf::RepeatedField<float>& numbers);
[[nodiscard]] std::optional<Eye> readEye(const google::protobuf::RepeatedField<float>& numbers);

// Empty where a field is missing or out of bounds.
[[nodiscard]] std::optional<Sign> readSign(const v1::Sign& message);
[[nodiscard]] std::optional<Show> readShow(const v1::Show& message);

// Reading: empty where a field is missing, or no channel could show it.
void writeScanPattern(const config::ScanPattern& pattern, v1::ScanPattern& message);
[[nodiscard]] std::optional<config::ScanPattern> readScanPattern(const v1::ScanPattern& message);

// The skins that a blob lists; empty where it is no such list, or out of bounds.
[[nodiscard]] std::optional<v1::SkinList> readSkinList(std::span<const std::byte> blob);

// Whether no number is infinite or not a number.
[[nodiscard]] bool areFinite(const google::protobuf::RepeatedField<float>& numbers);

// Hands before the wall, and those of a decoded input of kind INPUT_HANDS.
[[nodiscard]] v1::Input handsInput(const WallHands& hands);
[[nodiscard]] WallHands handsOf(const v1::Input& input);

// The five axes of a steering input of a pilot.
[[nodiscard]] v1::Input steeringInput(const Steering& steering);
// The steering of a decoded input of kind INPUT_STEER.
[[nodiscard]] Steering steeringOf(const v1::Input& input);

// "in step", "late" ...: the words that operators see.
[[nodiscard]] std::string wordFor(v1::NodeCondition condition);

// A digest as the bytes of a field, and back; the bytes are 32, as decode() has checked.
[[nodiscard]] std::string bytesOf(const Digest& digest);
[[nodiscard]] Digest digestIn(const std::string& bytes);
// Asks for the part of a blob that starts at `offset`.
[[nodiscard]] v1::Envelope chunkRequest(const Digest& blob, std::uint64_t offset);

// Names what a node's geometry follows from: the rig's text and the files that it names.
[[nodiscard]] std::uint64_t calibrationOf(const std::string& rigText, const v1::Look& look);

}  // namespace aquarama::wire
