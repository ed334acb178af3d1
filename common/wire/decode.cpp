// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>

#include "common/wire/aquarama.pb.h"
#include "common/wire/envelope.h"
#include "common/wire/state_codec.h"

namespace aquarama::wire {
namespace {

// Printed in logs and errors: no control characters, so that no peer can write lines of its own.
bool isText(const std::string& text, std::size_t maxBytes) {
    return text.size() <= maxBytes && std::ranges::none_of(text, [](char c) {
               const auto byte = static_cast<unsigned char>(c);
               return byte < 0x20 || byte == 0x7F;
           });
}

bool isName(const std::string& text) {
    return !text.empty() && isText(text, kMostNameBytes);
}

std::optional<Digest> digestIn(const std::string& bytes) {
    Digest digest;
    if (bytes.size() != digest.bytes.size()) return std::nullopt;
    std::ranges::transform(
        bytes, digest.bytes.begin(), [](char c) { return static_cast<std::uint8_t>(c); });
    return digest;
}

std::optional<Pace> paceIn(v1::Pace pace) {
    if (pace == v1::PACE_LIVE) return Pace::Live;
    if (pace == v1::PACE_LOCKSTEP) return Pace::Lockstep;
    return std::nullopt;
}

std::optional<Pattern> patternIn(v1::Pattern pattern) {
    if (pattern == v1::PATTERN_WORLD) return Pattern::World;
    if (pattern == v1::PATTERN_GRID) return Pattern::Grid;
    if (pattern == v1::PATTERN_GREY) return Pattern::Grey;
    return std::nullopt;
}

std::optional<NodeCondition> conditionIn(v1::NodeCondition condition) {
    switch (condition) {
        case v1::NODE_ABSENT:
            return NodeCondition::Absent;
        case v1::NODE_PREPARING:
            return NodeCondition::Preparing;
        case v1::NODE_IN_STEP:
            return NodeCondition::InStep;
        case v1::NODE_LATE:
            return NodeCondition::Late;
        default:
            return std::nullopt;
    }
}

// One reader a message; empty where it is not what it should be.
std::optional<Message> read(const v1::Hello& message) {
    if (!isName(message.channel()) || !message.has_major()) return std::nullopt;
    if (!isText(message.build(), kMostNameBytes)) return std::nullopt;
    return Hello{message.channel(), message.major(), message.build()};
}

std::optional<Message> read(const v1::Refusal& message) {
    if (!message.has_reason() || !isText(message.reason(), kMostReasonBytes)) return std::nullopt;
    return Refusal{message.reason()};
}

std::optional<std::vector<motion::FishTraits>> schoolIn(const v1::Welcome& message) {
    const int fish = message.fish_ids_size();
    if (message.length_millimetres_size() != fish || std::size_t(fish) > kMostFish) {
        return std::nullopt;
    }
    std::vector<motion::FishTraits> school;
    school.reserve(std::size_t(fish));
    for (int i = 0; i < fish; ++i) {
        if (message.length_millimetres(i) > UINT16_MAX) return std::nullopt;
        school.push_back(
            {message.fish_ids(i), static_cast<std::uint16_t>(message.length_millimetres(i))});
    }
    return school;
}

// Species that together have as many fish as the school.
std::optional<std::vector<SpeciesBlobs>> castIn(const v1::Welcome& message, std::size_t school) {
    if (std::size_t(message.cast_size()) > kMostSpecies) return std::nullopt;
    std::vector<SpeciesBlobs> cast;
    std::size_t fish = 0;
    for (const v1::SpeciesBlobs& member : message.cast()) {
        const auto species = digestIn(member.species());
        const auto repertoire = digestIn(member.repertoire());
        if (!species || !repertoire || member.fish() > kMostFish) return std::nullopt;
        cast.push_back({*species, *repertoire, member.fish()});
        fish += member.fish();
    }
    if (fish != school) return std::nullopt;
    return cast;
}

template <class Message>
std::optional<config::QualityTier> tierIn(const Message& message) {
    if (!message.has_quality()) return std::nullopt;
    return config::tierAt(message.quality());
}

std::optional<Message> read(const v1::Welcome& message) {
    const auto pace = paceIn(message.pace());
    const auto pattern = patternIn(message.pattern());
    auto school = schoolIn(message);
    if (!pace || !pattern || !school) return std::nullopt;
    auto cast = castIn(message, school->size());
    if (!cast) return std::nullopt;
    const auto quality = tierIn(message);
    if (message.has_quality() && !quality) return std::nullopt;
    if (message.rig_text().size() > kMostRigTextBytes ||
        message.scene_text().size() > kMostSceneTextBytes || !message.has_seed() ||
        !isText(message.state_address(), kMostReasonBytes)) {
        return std::nullopt;
    }
    return Welcome{message.rig_text(),
                   message.scene_text(),
                   message.state_address(),
                   message.seed(),
                   *pace,
                   *pattern,
                   std::move(*school),
                   std::move(*cast),
                   quality};
}

std::optional<Message> read(const v1::BlobRequest& message) {
    const auto digest = digestIn(message.digest());
    if (!digest || !message.has_offset() || message.offset() > kMostBlobBytes) return std::nullopt;
    return BlobRequest{*digest, message.offset()};
}

std::optional<Message> read(const v1::BlobChunk& message) {
    const auto digest = digestIn(message.digest());
    const std::string& content = message.content();
    if (!digest || !message.has_offset() || !message.has_total()) return std::nullopt;
    if (content.size() > kBlobChunkBytes || message.total() > kMostBlobBytes) return std::nullopt;
    if (message.offset() > message.total() || content.size() > message.total() - message.offset()) {
        return std::nullopt;
    }
    const auto* first = reinterpret_cast<const std::byte*>(content.data());
    return BlobChunk{*digest, message.offset(), message.total(), {first, first + content.size()}};
}

std::optional<Message> read(const v1::Prepared& message) {
    const auto quality = tierIn(message);
    if (!quality) return std::nullopt;
    return Prepared{*quality};
}

std::optional<Message> read(const v1::Joined& message) {
    if (!message.has_first_frame()) return std::nullopt;
    return Joined{{message.first_frame()}};
}

std::optional<Message> read(const v1::State& message) {
    return readState(message);
}

std::optional<Message> read(const v1::Ready& message) {
    if (!message.has_frame() || message.has_released_frame() != message.has_released_ns()) {
        return std::nullopt;
    }
    Ready ready{{message.frame()}, {}};
    if (message.has_released_frame()) {
        ready.released = ReleaseReport{{message.released_frame()}, message.released_ns()};
    }
    return ready;
}

std::optional<Message> read(const v1::Present& message) {
    if (!message.has_frame() || !message.has_at_ns()) return std::nullopt;
    return Present{{message.frame()}, message.at_ns()};
}

std::optional<Message> read(const v1::Dismissed& message) {
    if (!message.has_reason() || !isText(message.reason(), kMostReasonBytes)) return std::nullopt;
    return Dismissed{message.reason()};
}

std::optional<Message> read(const v1::Ping& message) {
    if (!message.has_sent_ns()) return std::nullopt;
    return Ping{message.sent_ns()};
}

std::optional<Message> read(const v1::Pong& message) {
    if (!message.has_sent_ns() || !message.has_master_ns()) return std::nullopt;
    return Pong{message.sent_ns(), message.master_ns()};
}

std::optional<Message> steeringIn(const v1::Input& message) {
    constexpr int kAxes = 5;
    const auto& axes = message.steering();
    const auto isShare = [](std::int32_t axis) {
        return axis >= -kFullSteering && axis <= kFullSteering;
    };
    if (axes.size() != kAxes || !std::ranges::all_of(axes, isShare) || !message.position().empty())
        return std::nullopt;
    const auto axis = [&](int i) { return static_cast<std::int8_t>(axes[i]); };
    return Input{InputKind::Steer, {}, {axis(0), axis(1), axis(2), axis(3), axis(4)}};
}

std::optional<Message> read(const v1::Input& message) {
    const auto& at = message.position();
    if (message.kind() == v1::INPUT_STEER) return steeringIn(message);
    if (!message.steering().empty()) return std::nullopt;
    const auto isNear = [](float number) { return std::abs(number) <= kMostInputMetres; };
    if (message.kind() == v1::INPUT_DROP_FOOD) {  // a number that is none is not near
        if (at.size() != 3 || !std::ranges::all_of(at, isNear)) return std::nullopt;
        return Input{InputKind::DropFood, {at[0], at[1], at[2]}, {}};
    }
    if (!at.empty()) return std::nullopt;
    if (message.kind() == v1::INPUT_QUIT) return Input{};
    if (message.kind() == v1::INPUT_TOGGLE_PAUSE) return Input{InputKind::TogglePause, {}, {}};
    return std::nullopt;
}

std::optional<NodeStatus> nodeIn(const v1::NodeStatus& message) {
    const auto condition = conditionIn(message.condition());
    if (!condition || !isName(message.name())) return std::nullopt;
    return NodeStatus{message.name(), *condition, message.late(), message.dropped()};
}

std::optional<Message> read(const v1::StatusReply& message) {
    const auto pace = paceIn(message.pace());
    if (!pace || std::size_t(message.nodes_size()) > kMostNodes) return std::nullopt;
    for (const float ms : {message.frame_median_ms(),
                           message.frame_p99_ms(),
                           message.skew_median_ms(),
                           message.skew_p99_ms(),
                           message.speed_m_s()}) {
        if (!std::isfinite(ms)) return std::nullopt;
    }
    const auto eye = readEye(message.eye());
    if (!eye || !isText(message.pilot(), kMostNameBytes)) return std::nullopt;
    StatusReply reply{*pace,
                      message.paused(),
                      {message.frame()},
                      {message.tick()},
                      message.frame_median_ms(),
                      message.frame_p99_ms(),
                      message.skew_median_ms(),
                      message.skew_p99_ms(),
                      message.refused_packets(),
                      {},
                      *eye,
                      message.speed_m_s(),
                      message.pilot()};
    for (const auto& node : message.nodes()) {
        auto status = nodeIn(node);
        if (!status) return std::nullopt;
        reply.nodes.push_back(std::move(*status));
    }
    return reply;
}

std::optional<Message> read(const v1::ExplainRequest& message) {
    if (!message.has_fish()) return std::nullopt;
    return ExplainRequest{message.fish()};
}

// Drawn with a font of ASCII, and printed.
bool isLine(const std::string& line) {
    return line.size() <= kMostExplanationLineBytes &&
           std::ranges::all_of(line, [](char c) { return c >= ' ' && c <= '~'; });
}

std::optional<Message> read(const v1::Explanation& message) {
    if (!message.has_fish() || !message.has_school() || !message.has_tick()) return std::nullopt;
    if (message.school() > kMostFish || std::size_t(message.lines_size()) > kMostExplanationLines ||
        !std::ranges::all_of(message.lines(), isLine)) {
        return std::nullopt;
    }
    return Explanation{message.fish(),
                       message.school(),
                       {message.tick()},
                       {message.lines().begin(), message.lines().end()}};
}

std::optional<Message> read(const v1::Envelope& envelope) {
    switch (envelope.message_case()) {
        case v1::Envelope::kHello:
            return read(envelope.hello());
        case v1::Envelope::kRefusal:
            return read(envelope.refusal());
        case v1::Envelope::kWelcome:
            return read(envelope.welcome());
        case v1::Envelope::kBlobRequest:
            return read(envelope.blob_request());
        case v1::Envelope::kBlobChunk:
            return read(envelope.blob_chunk());
        case v1::Envelope::kPrepared:
            return read(envelope.prepared());
        case v1::Envelope::kJoined:
            return read(envelope.joined());
        case v1::Envelope::kState:
            return read(envelope.state());
        case v1::Envelope::kBeacon:
            return Beacon{};
        case v1::Envelope::kReady:
            return read(envelope.ready());
        case v1::Envelope::kPresent:
            return read(envelope.present());
        case v1::Envelope::kDismissed:
            return read(envelope.dismissed());
        case v1::Envelope::kFarewell:
            return Farewell{};
        case v1::Envelope::kPing:
            return read(envelope.ping());
        case v1::Envelope::kPong:
            return read(envelope.pong());
        case v1::Envelope::kInput:
            return read(envelope.input());
        case v1::Envelope::kStatusRequest:
            return StatusRequest{};
        case v1::Envelope::kStatusReply:
            return read(envelope.status_reply());
        case v1::Envelope::kExplainRequest:
            return read(envelope.explain_request());
        case v1::Envelope::kExplanation:
            return read(envelope.explanation());
        case v1::Envelope::MESSAGE_NOT_SET:
            break;
    }
    return std::nullopt;
}

// Only these hold their content as plain bytes or numbers; in the others a few bytes of a packet
// may become a whole object, so they must be small.
bool mayBeLarge(int field) {
    return field == v1::Envelope::kState || field == v1::Envelope::kWelcome ||
           field == v1::Envelope::kBlobChunk;
}

bool isBounded(std::span<const std::byte> packet) {
    using google::protobuf::internal::WireFormatLite;
    if (packet.size() <= kMostSmallPacketBytes) return true;
    if (packet.size() > kMostPacketBytes) return false;
    google::protobuf::io::CodedInputStream stream(
        reinterpret_cast<const std::uint8_t*>(packet.data()), static_cast<int>(packet.size()));
    while (const std::uint32_t tag = stream.ReadTag()) {
        const int start = stream.CurrentPosition();
        if (!WireFormatLite::SkipField(&stream, tag)) return false;
        const auto size = static_cast<std::size_t>(stream.CurrentPosition() - start);
        if (size > kMostSmallPacketBytes && !mayBeLarge(WireFormatLite::GetTagFieldNumber(tag))) {
            return false;
        }
    }
    return stream.ConsumedEntireMessage();
}

}  // namespace

std::optional<Envelope> decode(std::span<const std::byte> packet) {
    if (!isBounded(packet)) return std::nullopt;
    v1::Envelope envelope;
    if (!envelope.ParseFromArray(packet.data(), static_cast<int>(packet.size())) ||
        !envelope.has_session()) {
        return std::nullopt;
    }
    auto message = read(envelope);
    if (!message) return std::nullopt;
    return Envelope{envelope.session(), std::move(*message)};
}

}  // namespace aquarama::wire
