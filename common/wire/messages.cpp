// SPDX-License-Identifier: Apache-2.0
#include "common/wire/messages.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/stubs/logging.h>

#include "common/base/units.h"
#include "common/config/rules.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::wire {
namespace {

namespace pb = google::protobuf;

constexpr int kEyeNumbers = 7;  // position and rotation
// In the order of Input.steering.
constexpr std::array kAxes{
    &Steering::ahead, &Steering::aside, &Steering::up, &Steering::turn, &Steering::tilt};

// The plain enums are cast to and from the generated ones.
static_assert(int{v1::PACE_LIVE} == static_cast<int>(Pace::Live) &&
              int{v1::PACE_LOCKSTEP} == static_cast<int>(Pace::Lockstep));
static_assert(int{v1::PATTERN_WORLD} == static_cast<int>(Pattern::World) &&
              int{v1::PATTERN_GRID} == static_cast<int>(Pattern::Grid) &&
              int{v1::PATTERN_GREY} == static_cast<int>(Pattern::Grey) &&
              int{v1::PATTERN_SCAN} == static_cast<int>(Pattern::Scan));

// What no rule of a single field can tell (aquarama.proto): one overload a message.

// As many lengths as fish, each of 16 bits as in motion::FishTraits.
bool isSchool(const v1::Look& m) {
    return m.fish_ids_size() <= int{kMostFish} &&
           m.length_millimetres_size() == m.fish_ids_size() &&
           std::ranges::all_of(m.length_millimetres(), [](std::uint32_t length) {
               return length <= std::numeric_limits<std::uint16_t>::max();
           });
}

// The species together have as many fish as the school.
bool isValid(const v1::Look& m) {
    std::uint64_t fish = 0;
    for (const v1::SpeciesBlobs& member : m.cast()) fish += member.fish();
    return isSchool(m) && std::cmp_equal(fish, m.fish_ids_size());
}

// A power order names its run: it must not come to the next one.
bool isValid(const v1::Order& m) {
    switch (m.order_case()) {
        case v1::Order::kScan:
            return !m.scan().has_pattern() || readScanPattern(m.scan().pattern());
        case v1::Order::kPower:
            return m.run() != 0;
        default:
            return m.order_case() != v1::Order::ORDER_NOT_SET;
    }
}

// The content lies within the blob; written so that no sum overflows.
bool isValid(const v1::BlobChunk& m) {
    return m.offset() <= m.total() && m.content().size() <= m.total() - m.offset();
}

// An earlier release is reported as a whole or not at all, and so are blanks.
bool isValid(const v1::Ready& m) {
    return m.has_released_frame() == m.has_released_ns() &&
           m.has_blank_ns() == m.has_blank_period_ns();
}

// Only food has a position, only a steering has axes.
bool isValid(const v1::Input& m) {
    const bool isFood = m.kind() == v1::INPUT_DROP_FOOD;
    const bool isSteering = m.kind() == v1::INPUT_STEER;
    const bool isHands = m.kind() == v1::INPUT_HANDS;
    const auto isNear = [](float number) { return std::abs(number) <= kMostInputMetres; };
    const auto isShare = [](std::int32_t axis) {
        return axis >= -kFullSteering && axis <= kFullSteering;
    };
    return m.position_size() == (isFood ? 3 : 0) &&
           m.steering_size() == (isSteering ? int{kAxes.size()} : 0) &&
           (isHands || m.hands_size() == 0) &&
           std::ranges::all_of(m.position(), isNear) &&  // NaN is not near
           std::ranges::all_of(m.steering(), isShare);
}

bool isValid(const v1::StatusReply& m) {
    return readEye(m.eye()) && readShow(m.show());
}

// A state is checked by readState(); the rules need not walk its records.
bool isValid(const v1::Envelope& m) {
    if (m.has_state()) return true;
    if (!config::keepsRules(m)) return false;
    switch (m.message_case()) {
        case v1::Envelope::kWelcome:
            return isValid(m.welcome().look());
        case v1::Envelope::kPrepare:
            return isValid(m.prepare().look());
        case v1::Envelope::kOrder:
            return isValid(m.order());
        case v1::Envelope::kBlobChunk:
            return isValid(m.blob_chunk());
        case v1::Envelope::kReady:
            return isValid(m.ready());
        case v1::Envelope::kInput:
            return isValid(m.input());
        case v1::Envelope::kStatusReply:
            return isValid(m.status_reply());
        default:
            return m.message_case() != v1::Envelope::MESSAGE_NOT_SET;
    }
}

// Of a large packet, known or not: a field of two bytes may become a whole object in memory.
constexpr int kMostFields = 4096;
constexpr std::uint32_t kDelimited = 2;  // wire type of texts, messages and packed numbers

// Skips a field that is no message of ours. False: it is truncated, or a group, which no release
// writes.
bool skipField(pb::io::CodedInputStream& stream, std::uint32_t wireType) {
    constexpr std::uint32_t kVarint = 0, kFixed64 = 1, kFixed32 = 5;
    std::uint64_t number = 0;
    std::uint32_t size = 0;
    if (wireType == kVarint) return stream.ReadVarint64(&number);
    if (wireType == kFixed64) return stream.Skip(8);
    if (wireType == kFixed32) return stream.Skip(4);
    return wireType == kDelimited && stream.ReadVarint32(&size) &&
           stream.Skip(static_cast<int>(size));
}

// Counts the fields of a message and of the messages in it. False: there are more than `left`, or
// the message is malformed. Packed numbers are one field.
bool hasAtMost(int& left, pb::io::CodedInputStream& stream, const pb::Descriptor& type) {
    while (const std::uint32_t tag = stream.ReadTag()) {
        if (--left < 0) return false;
        const pb::FieldDescriptor* field = type.FindFieldByNumber(static_cast<int>(tag >> 3U));
        const bool isMessage = field != nullptr && field->message_type() != nullptr;
        if (!isMessage || (tag & 7U) != kDelimited) {
            if (!skipField(stream, tag & 7U)) return false;
            continue;
        }
        std::uint32_t size = 0;
        if (!stream.ReadVarint32(&size)) return false;
        const auto outer = stream.PushLimit(static_cast<int>(size));
        if (!hasAtMost(left, stream, *field->message_type())) return false;
        stream.PopLimit(outer);
    }
    return stream.ConsumedEntireMessage();
}

// Whether the packet may be parsed. In a small one nothing can take much memory.
bool isBounded(std::span<const std::byte> packet) {
    if (packet.size() <= kMostSmallPacketBytes) return true;
    if (packet.size() > kMostPacketBytes) return false;
    pb::io::CodedInputStream stream(reinterpret_cast<const std::uint8_t*>(packet.data()),
                                    static_cast<int>(packet.size()));
    int left = kMostFields;
    return hasAtMost(left, stream, *v1::Envelope::descriptor());
}

}  // namespace

// Fields are written in the order of their numbers: the same message is the same bytes.
Packet encode(std::uint64_t session, v1::Envelope envelope) {
    envelope.set_session(session);
    Packet packet(envelope.ByteSizeLong());
    assert(packet.size() <= kMostPacketBytes);
    envelope.SerializeToArray(packet.data(), static_cast<int>(packet.size()));
    return packet;
}

Packet leaseField(std::uint64_t revision) {
    v1::Envelope envelope;
    envelope.set_lease_revision(revision);
    Packet field(envelope.ByteSizeLong());
    envelope.SerializeToArray(field.data(), static_cast<int>(field.size()));
    return field;
}

std::optional<v1::Envelope> decode(std::span<const std::byte> packet) {
    const pb::LogSilencer silencer;  // protobuf would log a line for each text that is no UTF-8
    v1::Envelope envelope;
    if (!isBounded(packet) ||
        !envelope.ParseFromArray(packet.data(), static_cast<int>(packet.size())) ||
        !envelope.has_session() || !isValid(envelope))
        return std::nullopt;
    return envelope;
}

void writeEye(const Eye& eye, google::protobuf::RepeatedField<float>& numbers) {
    const auto& position = eye.positionMetres;
    const auto& rotation = eye.worldFromWall;
    for (const float number : {position.x, position.y, position.z}) numbers.Add(number);
    for (const float number : {rotation.w, rotation.x, rotation.y, rotation.z}) numbers.Add(number);
}

std::optional<Eye> readEye(const google::protobuf::RepeatedField<float>& e) {
    if (e.size() != kEyeNumbers || !areFinite(e)) return std::nullopt;
    return Eye{{e[0], e[1], e[2]}, {e[3], e[4], e[5], e[6]}};
}

void writeScanPattern(const config::ScanPattern& pattern, v1::ScanPattern& message) {
    message.set_kind(static_cast<std::uint32_t>(pattern.kind));
    message.set_step(pattern.step);
    message.set_finest_pixels(pattern.finestPixels);
    message.set_inverse(pattern.inverse);
    message.clear_light();
    for (const float part : {pattern.light.r, pattern.light.g, pattern.light.b})
        message.add_light(part);
    message.set_lit(pattern.lit);
    message.set_number(pattern.number);
    message.set_tagged(pattern.tagged);
}

namespace {

using ScanKind = config::ScanPattern::Kind;

bool hasAllScalars(const v1::ScanPattern& m) {
    return m.has_kind() && m.has_step() && m.has_finest_pixels() && m.has_inverse() &&
           m.has_lit() && m.has_number() && m.has_tagged();
}

bool isPhase(std::uint32_t kind) {
    return kind == static_cast<std::uint32_t>(ScanKind::PhaseColumns) ||
           kind == static_cast<std::uint32_t>(ScanKind::PhaseRows);
}

bool isInBounds(const v1::ScanPattern& m) {
    constexpr std::uint32_t kMostBits = 16;  // of a column's number
    const std::uint32_t steps = isPhase(m.kind()) ? wall::kScanPhaseSteps : kMostBits;
    return m.kind() >= static_cast<std::uint32_t>(ScanKind::Level) &&
           m.kind() <= static_cast<std::uint32_t>(ScanKind::Dots) && m.step() < steps &&
           m.finest_pixels() > 0 &&
           m.finest_pixels() <= std::numeric_limits<std::uint16_t>::max() &&
           m.number() < (1U << unsigned{wall::kScanTagBits});
}

}  // namespace

std::optional<config::ScanPattern> readScanPattern(const v1::ScanPattern& m) {
    const auto isShare = [](float part) { return part >= 0 && part <= 1; };
    const auto& light = m.light();
    if (!hasAllScalars(m) || !isInBounds(m) || light.size() != 3 ||
        !std::ranges::all_of(light, isShare))
        return std::nullopt;
    return config::ScanPattern{.kind = static_cast<ScanKind>(m.kind()),
                               .step = static_cast<std::uint8_t>(m.step()),
                               .finestPixels = static_cast<std::uint16_t>(m.finest_pixels()),
                               .inverse = m.inverse(),
                               .light = {light[0], light[1], light[2]},
                               .lit = m.lit(),
                               .number = static_cast<std::uint16_t>(m.number()),
                               .tagged = m.tagged()};
}

std::optional<Sign> readSign(const v1::Sign& m) {
    const std::uint32_t bytes = (m.columns() * m.rows() + 7) / 8;
    if (!config::keepsRules(m) || m.dots().size() != bytes) return std::nullopt;
    return Sign{.columns = m.columns(), .rows = m.rows(), .dots = m.dots()};
}

std::optional<Show> readShow(const v1::Show& m) {
    const auto sign = m.has_sign() ? readSign(m.sign()) : Sign{};
    const auto scan = m.has_scan() ? readScanPattern(m.scan()) : std::nullopt;
    const bool isScan = m.pattern() == v1::PATTERN_SCAN;
    if (!config::keepsRules(m) || !sign || m.has_scan() != isScan || scan.has_value() != isScan)
        return std::nullopt;
    return Show{.version = m.version(),
                .look = m.look(),
                .scene = m.scene(),
                .quality = *config::tierAt(m.quality()),
                .pattern = static_cast<Pattern>(m.pattern()),
                .black = m.black(),
                .brightness = static_cast<float>(m.brightness()) / kFullLight,
                .frozen = m.frozen(),
                .pilot = m.pilot(),
                .calibration = m.calibration(),
                .scan = scan,
                .colourReturned = static_cast<float>(m.colour_returned()) / kAllColour,
                .sign = *sign,
                .skins = m.has_skins() ? std::optional(digestIn(m.skins())) : std::nullopt};
}

std::optional<v1::SkinList> readSkinList(std::span<const std::byte> blob) {
    v1::SkinList list;
    if (blob.size() > kMostSmallPacketBytes ||
        !list.ParseFromArray(blob.data(), static_cast<int>(blob.size())) ||
        !config::keepsRules(list))
        return std::nullopt;
    return list;
}

bool areFinite(const google::protobuf::RepeatedField<float>& numbers) {
    return std::ranges::all_of(numbers, [](float number) { return std::isfinite(number); });
}

v1::Input steeringInput(const Steering& steering) {
    v1::Input input;
    input.set_kind(v1::INPUT_STEER);
    for (const auto axis : kAxes) input.add_steering(steering.*axis);
    return input;
}

v1::Input handsInput(const WallHands& hands) {
    v1::Input input;
    input.set_kind(v1::INPUT_HANDS);
    for (const WallHand& hand : hands) {
        v1::TrackedHand& tracked = *input.add_hands();
        tracked.set_id(hand.id);
        tracked.set_x(hand.point.x);
        tracked.set_y(hand.point.y);
        tracked.set_z(hand.point.z);
    }
    return input;
}

WallHands handsOf(const v1::Input& input) {
    WallHands hands;
    for (const v1::TrackedHand& hand : input.hands())
        hands.push_back({hand.id(), {hand.x(), hand.y(), hand.z()}});
    return hands;
}

Steering steeringOf(const v1::Input& input) {
    assert(std::cmp_equal(input.steering_size(), kAxes.size()));
    Steering steering;
    for (std::size_t i = 0; i < kAxes.size(); ++i)
        steering.*kAxes[i] = static_cast<std::int8_t>(input.steering(static_cast<int>(i)));
    return steering;
}

std::string wordFor(v1::NodeCondition condition) {
    switch (condition) {
        case v1::NODE_ABSENT:
            return "absent";
        case v1::NODE_PREPARING:
            return "preparing";
        case v1::NODE_IN_STEP:
            return "in step";
        default:
            return "late";
    }
}

std::string bytesOf(const Digest& digest) {
    return {digest.bytes.begin(), digest.bytes.end()};
}

Digest digestIn(const std::string& bytes) {
    assert(bytes.size() == Digest{}.bytes.size());
    Digest digest;
    std::ranges::transform(
        bytes, digest.bytes.begin(), [](char c) { return static_cast<std::uint8_t>(c); });
    return digest;
}

v1::Envelope chunkRequest(const Digest& blob, std::uint64_t offset) {
    v1::Envelope message;
    message.mutable_blob_request()->set_digest(bytesOf(blob));
    message.mutable_blob_request()->set_offset(offset);
    return message;
}

std::uint64_t calibrationOf(const std::string& rigText, const v1::Look& look) {
    if (look.rig_files().empty()) return shortHash(digestOf(rigText));
    std::string all = toHex(digestOf(rigText));
    for (const v1::RigFile& file : look.rig_files()) all += file.name() + file.digest();
    return shortHash(digestOf(all));
}

}  // namespace aquarama::wire
