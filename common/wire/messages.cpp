// SPDX-License-Identifier: Apache-2.0
#include "common/wire/messages.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include <google/protobuf/io/coded_stream.h>

#include "common/base/units.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::wire {
namespace {

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

// No control characters, so that no peer can write lines of its own into a log.
bool isText(const std::string& text, std::size_t maxBytes) {
    return text.size() <= maxBytes && std::ranges::none_of(text, [](char c) {
               const auto byte = static_cast<unsigned char>(c);
               return byte < 0x20 || byte == 0x7F;
           });
}

// Of a channel, a node or a build.
bool isName(const std::string& text) {
    return !text.empty() && isText(text, kMostNameBytes);
}

// Drawn with a font of ASCII, and printed.
bool isLine(const std::string& line) {
    return line.size() <= kMostExplanationLineBytes &&
           std::ranges::all_of(line, [](char c) { return c >= ' ' && c <= '~'; });
}

bool isDigest(const std::string& bytes) {
    return bytes.size() == Digest{}.bytes.size();
}

// A value of an enum that we know, and not the unset one.
bool isOneOf(int value, bool (*isKnown)(int)) {
    return value != 0 && isKnown(value);
}

// One overload a message: whether all that it needs is there and within bounds.
bool isValid(const v1::Hello& m) {
    return isName(m.channel()) && m.has_major() && isText(m.build(), kMostNameBytes);
}

bool isValid(const v1::Refusal& m) {
    return m.has_reason() && isText(m.reason(), kMostReasonBytes);
}

bool isValid(const v1::Dismissed& m) {
    return m.has_reason() && isText(m.reason(), kMostReasonBytes);
}

// As many lengths as fish, each of 16 bits as in motion::FishTraits.
bool isSchool(const v1::Look& m) {
    return m.fish_ids_size() <= int{kMostFish} &&
           m.length_millimetres_size() == m.fish_ids_size() &&
           std::ranges::all_of(m.length_millimetres(), [](std::uint32_t length) {
               return length <= std::numeric_limits<std::uint16_t>::max();
           });
}

// Species that together have as many fish as the school.
bool isCast(const v1::Look& m) {
    std::uint64_t fish = 0;
    for (const v1::SpeciesBlobs& member : m.cast()) {
        if (!isDigest(member.species()) || !isDigest(member.repertoire())) return false;
        fish += member.fish();
    }
    return m.cast_size() <= int{kMostSpecies} && std::cmp_equal(fish, m.fish_ids_size());
}

bool areRigFiles(const v1::Look& m) {
    return m.rig_files_size() <= kMostRigFiles &&
           std::ranges::all_of(m.rig_files(), [](const v1::RigFile& file) {
               return isText(file.name(), kMostReasonBytes) && isDigest(file.digest());
           });
}

bool isValid(const v1::Look& m) {
    return m.has_number() && m.scene_text().size() <= kMostSceneTextBytes && m.has_seed() &&
           m.has_world() && (!m.has_quality() || config::tierAt(m.quality())) && isSchool(m) &&
           isCast(m) && areRigFiles(m);
}

bool isValid(const v1::Welcome& m) {
    return m.rig_text().size() <= kMostRigTextBytes &&
           isText(m.state_address(), kMostReasonBytes) && isOneOf(m.pace(), v1::Pace_IsValid) &&
           isValid(m.look());
}

bool isValid(const v1::HeldScan& m) {
    return m.holder() != 0 && (!m.has_pattern() || readScanPattern(m.pattern()));
}

// A value that is there is one of its choices.
bool isValid(const v1::WantedShow& m) {
    return (!m.has_scene() || isName(m.scene())) &&
           (!m.has_quality() || isOneOf(m.quality(), v1::WantedShow::Tier_IsValid)) &&
           (!m.has_pattern() || isOneOf(m.pattern(), v1::WantedShow::Shown_IsValid));
}

bool isValid(const v1::Order& m) {
    if (m.request() == 0) return false;
    switch (m.order_case()) {
        case v1::Order::kShow:
            return isValid(m.show());
        case v1::Order::kScan:
            return isValid(m.scan());
        case v1::Order::kRestart:
            return isName(m.restart().channel());
        case v1::Order::kPower:
            return m.run() != 0 && isName(m.power().channel()) &&
                   isOneOf(m.power().word(), v1::Power::Word_IsValid);
        case v1::Order::ORDER_NOT_SET:
            break;
    }
    return false;
}

bool isValid(const v1::OrderReply& m) {
    return m.request() != 0 && isOneOf(m.outcome(), v1::OrderReply::Outcome_IsValid) &&
           isText(m.reason(), kMostReasonBytes);
}

bool isValid(const v1::BlobRequest& m) {
    return isDigest(m.digest()) && m.has_offset() && m.offset() <= kMostBlobBytes;
}

// The content lies within the blob; written so that no sum overflows.
bool isValid(const v1::BlobChunk& m) {
    return isDigest(m.digest()) && m.has_offset() && m.has_total() &&
           m.content().size() <= kBlobChunkBytes && m.total() <= kMostBlobBytes &&
           m.offset() <= m.total() && m.content().size() <= m.total() - m.offset();
}

bool isValid(const v1::Prepared& m) {
    return m.has_quality() && config::tierAt(m.quality()) && m.has_look();
}

// An earlier release is reported as a whole or not at all, and so are blanks.
bool isValid(const v1::Ready& m) {
    return m.has_frame() && m.has_released_frame() == m.has_released_ns() &&
           m.has_blank_ns() == m.has_blank_period_ns();
}

// Only food has a position, only a steering has axes.
bool isValid(const v1::Input& m) {
    const bool isFood = m.kind() == v1::INPUT_DROP_FOOD;
    const bool isSteering = m.kind() == v1::INPUT_STEER;
    const auto isNear = [](float number) { return std::abs(number) <= kMostInputMetres; };
    const auto isShare = [](std::int32_t axis) {
        return axis >= -kFullSteering && axis <= kFullSteering;
    };
    return isOneOf(m.kind(), v1::InputKind_IsValid) && m.position_size() == (isFood ? 3 : 0) &&
           m.steering_size() == (isSteering ? int{kAxes.size()} : 0) &&
           std::ranges::all_of(m.position(), isNear) &&  // a number that is none is not near
           std::ranges::all_of(m.steering(), isShare);
}

bool isValid(const v1::NodeReport& m) {
    const std::array numbers{m.round_trip_median_ms(),
                             m.round_trip_p99_ms(),
                             m.unanswered_percent(),
                             m.clock_drift_ppm(),
                             m.gpu_celsius(),
                             m.jitter_ms(),
                             m.picture_median_ms(),
                             m.picture_p99_ms()};
    const auto isFinite = [](float number) { return std::isfinite(number); };
    const auto isLineOfReport = [](const std::string& line) {
        return isText(line, kMostLineBytes);
    };
    return isLineOfReport(m.host()) && isLineOfReport(m.build()) && isLineOfReport(m.renderer()) &&
           m.monitors_size() <= kMostMonitors &&
           std::ranges::all_of(m.monitors(), isLineOfReport) &&
           std::ranges::all_of(numbers, isFinite);
}

bool isValid(const v1::LogLine& m) {
    return isOneOf(m.severity(), v1::LogSeverity_IsValid) && m.has_frame() &&
           isText(m.text(), kMostLogBytes);
}

bool isValid(const v1::NodeStatus& m) {
    return (!m.has_report() || isValid(m.report())) && isName(m.name()) &&
           isOneOf(m.condition(), v1::NodeCondition_IsValid) &&
           isText(m.machine(), kMostNameBytes) && std::isfinite(m.picture_ms());
}

bool isValid(const v1::StatusReply& m) {
    const std::array numbers{m.frame_median_ms(),
                             m.frame_p99_ms(),
                             m.frame_peak_ms(),
                             m.skew_median_ms(),
                             m.skew_p99_ms(),
                             m.skew_peak_ms(),
                             m.speed_m_s()};
    const auto isFinite = [](float number) { return std::isfinite(number); };
    return isOneOf(m.pace(), v1::Pace_IsValid) && std::ranges::all_of(numbers, isFinite) &&
           readEye(m.eye()) && readShow(m.show()) && isText(m.change(), kMostReasonBytes) &&
           m.nodes_size() <= kMostNodes && m.skew_counts_size() <= kMostSkewCounts &&
           std::ranges::all_of(m.nodes(), [](const v1::NodeStatus& node) { return isValid(node); });
}

bool isValid(const v1::Explanation& m) {
    return m.has_fish() && m.has_school() && m.has_tick() && m.school() <= kMostFish &&
           m.lines_size() <= kMostExplanationLines && std::ranges::all_of(m.lines(), isLine);
}

bool isPictureWidth(std::uint32_t pixels) {
    return pixels > 0 && pixels <= kMostPictureWidth;
}

bool isValid(const v1::PictureRequest& m) {
    return m.has_number() && isPictureWidth(m.width_px());
}

bool isValid(const v1::FramePicture& m) {
    return m.has_number() && m.has_frame() && isPictureWidth(m.width_px()) &&
           isPictureWidth(m.height_px()) && m.jpeg().size() <= kMostJpegBytes;
}

// A number that is none is no share.
bool isValid(const v1::FishRequest& m) {
    const auto isShare = [](float number) { return number >= 0 && number <= 1; };
    return m.has_number() && m.has_frame() && isShare(m.x()) && isShare(m.y());
}

bool isValid(const v1::FishReply& m) {
    return m.has_number() && m.has_frame() && (!m.has_fish() || m.fish() < kMostFish);
}

// What a node and the operator's console say to each other.
bool isValidWatch(const v1::Envelope& m) {
    switch (m.message_case()) {
        case v1::Envelope::kWatchHello:
            return isName(m.watch_hello().channel());
        case v1::Envelope::kPictureRequest:
            return isValid(m.picture_request());
        case v1::Envelope::kFramePicture:
            return isValid(m.frame_picture());
        case v1::Envelope::kFishRequest:
            return isValid(m.fish_request());
        default:
            return m.has_fish_reply() && isValid(m.fish_reply());
    }
}

bool isValid(const v1::Envelope& m) {
    switch (m.message_case()) {
        case v1::Envelope::kHello:
            return isValid(m.hello());
        case v1::Envelope::kRefusal:
            return isValid(m.refusal());
        case v1::Envelope::kWelcome:
            return isValid(m.welcome());
        case v1::Envelope::kBlobRequest:
            return isValid(m.blob_request());
        case v1::Envelope::kBlobChunk:
            return isValid(m.blob_chunk());
        case v1::Envelope::kPrepare:
            return isValid(m.prepare().look());
        case v1::Envelope::kPrepared:
            return isValid(m.prepared());
        case v1::Envelope::kOrder:
            return isValid(m.order());
        case v1::Envelope::kOrderReply:
            return isValid(m.order_reply());
        case v1::Envelope::kNodeReport:
            return isValid(m.node_report());
        case v1::Envelope::kLogLine:
            return isValid(m.log_line());
        case v1::Envelope::kJoined:
            return m.joined().has_first_frame();
        case v1::Envelope::kReady:
            return isValid(m.ready());
        case v1::Envelope::kPresent:
            return m.present().has_frame() && m.present().has_at_ns();
        case v1::Envelope::kDismissed:
            return isValid(m.dismissed());
        case v1::Envelope::kPing:
            return m.ping().has_sent_ns();
        case v1::Envelope::kPong:
            return m.pong().has_sent_ns() && m.pong().has_master_ns();
        case v1::Envelope::kInput:
            return isValid(m.input());
        case v1::Envelope::kStatusReply:
            return isValid(m.status_reply());
        case v1::Envelope::kExplainRequest:
            return m.explain_request().has_fish();
        case v1::Envelope::kExplanation:
            return isValid(m.explanation());
        case v1::Envelope::kState:  // by readState()
        case v1::Envelope::kBeacon:
        case v1::Envelope::kFarewell:
        case v1::Envelope::kStatusRequest:
            return true;
        default:
            return isValidWatch(m);
    }
}

// In a large packet only these may be large: in the other messages a few bytes of a packet may
// become a whole object.
std::size_t mostBytesOf(std::uint32_t field) {
    const bool mayBeLarge = field == v1::Envelope::kState || field == v1::Envelope::kWelcome ||
                            field == v1::Envelope::kPrepare || field == v1::Envelope::kBlobChunk;
    return mayBeLarge ? kMostPacketBytes : kMostSmallPacketBytes;
}

// Whether a field of an envelope is skipped: fixed64 or a message that is not too large. No
// envelope of ours has another.
bool skipField(google::protobuf::io::CodedInputStream& stream, std::uint32_t tag) {
    constexpr std::uint32_t kFixed64 = 1, kDelimited = 2;
    if ((tag & 7U) == kFixed64) return stream.Skip(8);
    std::uint32_t size = 0;
    return (tag & 7U) == kDelimited && stream.ReadVarint32(&size) &&
           size <= mostBytesOf(tag >> 3U) && stream.Skip(static_cast<int>(size));
}

// Whether the packet may be parsed: looks at the sizes of its fields only.
bool isBounded(std::span<const std::byte> packet) {
    if (packet.size() <= kMostSmallPacketBytes) return true;
    if (packet.size() > kMostPacketBytes) return false;
    google::protobuf::io::CodedInputStream stream(
        reinterpret_cast<const std::uint8_t*>(packet.data()), static_cast<int>(packet.size()));
    while (const std::uint32_t tag = stream.ReadTag())
        if (!skipField(stream, tag)) return false;
    return stream.ConsumedEntireMessage();
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

std::optional<v1::Envelope> decode(std::span<const std::byte> packet) {
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

std::optional<Show> readShow(const v1::Show& m) {
    const auto quality = config::tierAt(m.quality());
    const bool isWhole = m.has_version() && m.has_look() && m.has_quality() && m.has_black() &&
                         m.has_brightness() && m.has_frozen() && m.has_calibration() &&
                         isOneOf(m.pattern(), v1::Pattern_IsValid);
    const bool isLight = m.brightness() <= static_cast<std::uint32_t>(kFullLight);
    const auto scan = m.has_scan() ? readScanPattern(m.scan()) : std::nullopt;
    const bool isScan = m.pattern() == v1::PATTERN_SCAN;
    if (!isWhole || !isLight || !quality || m.has_scan() != isScan || scan.has_value() != isScan ||
        !isText(m.scene(), kMostNameBytes) || !isText(m.pilot(), kMostNameBytes))
        return std::nullopt;
    return Show{m.version(),
                m.look(),
                m.scene(),
                *quality,
                static_cast<Pattern>(m.pattern()),
                m.black(),
                static_cast<float>(m.brightness()) / kFullLight,
                m.frozen(),
                m.pilot(),
                m.calibration(),
                scan};
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
    assert(isDigest(bytes));
    Digest digest;
    std::ranges::transform(
        bytes, digest.bytes.begin(), [](char c) { return static_cast<std::uint8_t>(c); });
    return digest;
}

std::uint64_t calibrationOf(const std::string& rigText, const v1::Look& look) {
    if (look.rig_files().empty()) return shortHash(digestOf(rigText));
    std::string all = toHex(digestOf(rigText));
    for (const v1::RigFile& file : look.rig_files()) all += file.name() + file.digest();
    return shortHash(digestOf(all));
}

}  // namespace aquarama::wire
