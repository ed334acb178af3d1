// SPDX-License-Identifier: Apache-2.0
#include <cassert>

#include "common/wire/aquarama.pb.h"
#include "common/wire/envelope.h"
#include "common/wire/state_codec.h"

namespace aquarama::wire {
namespace {

std::string bytesOf(const Digest& digest) {
    return {digest.bytes.begin(), digest.bytes.end()};
}

v1::Pace paceOf(Pace pace) {
    return pace == Pace::Live ? v1::PACE_LIVE : v1::PACE_LOCKSTEP;
}

v1::Pattern patternOf(Pattern pattern) {
    switch (pattern) {
        case Pattern::World:
            return v1::PATTERN_WORLD;
        case Pattern::Grid:
            return v1::PATTERN_GRID;
        case Pattern::Grey:
            break;
    }
    return v1::PATTERN_GREY;
}

v1::InputKind inputKindOf(InputKind kind) {
    switch (kind) {
        case InputKind::Quit:
            return v1::INPUT_QUIT;
        case InputKind::TogglePause:
            return v1::INPUT_TOGGLE_PAUSE;
        case InputKind::DropFood:
            return v1::INPUT_DROP_FOOD;
        case InputKind::Steer:
            break;
    }
    return v1::INPUT_STEER;
}

v1::NodeCondition conditionOf(NodeCondition condition) {
    switch (condition) {
        case NodeCondition::Absent:
            return v1::NODE_ABSENT;
        case NodeCondition::Preparing:
            return v1::NODE_PREPARING;
        case NodeCondition::InStep:
            return v1::NODE_IN_STEP;
        case NodeCondition::Late:
            break;
    }
    return v1::NODE_LATE;
}

// One overload a message: what it says goes into its member of the envelope.
void write(const Hello& hello, v1::Envelope& envelope) {
    auto& message = *envelope.mutable_hello();
    message.set_channel(hello.channel);
    message.set_major(hello.major);
    message.set_build(hello.build);
}

void write(const Refusal& refusal, v1::Envelope& envelope) {
    envelope.mutable_refusal()->set_reason(refusal.reason);
}

void write(const Welcome& welcome, v1::Envelope& envelope) {
    auto& message = *envelope.mutable_welcome();
    message.set_rig_text(welcome.rigText);
    message.set_scene_text(welcome.sceneText);
    message.set_state_address(welcome.stateAddress);
    message.set_seed(welcome.seed);
    message.set_pace(paceOf(welcome.pace));
    message.set_pattern(patternOf(welcome.pattern));
    if (welcome.quality) message.set_quality(static_cast<std::uint32_t>(*welcome.quality));
    for (const motion::FishTraits& fish : welcome.school) {
        message.add_fish_ids(fish.id);
        message.add_length_millimetres(fish.lengthMillimetres);
    }
    for (const SpeciesBlobs& blobs : welcome.cast) {
        v1::SpeciesBlobs& member = *message.add_cast();
        member.set_species(bytesOf(blobs.species));
        member.set_repertoire(bytesOf(blobs.repertoire));
        member.set_fish(blobs.fish);
    }
}

void write(const BlobRequest& request, v1::Envelope& envelope) {
    auto& message = *envelope.mutable_blob_request();
    message.set_digest(bytesOf(request.digest));
    message.set_offset(request.offset);
}

void write(const BlobChunk& chunk, v1::Envelope& envelope) {
    auto& message = *envelope.mutable_blob_chunk();
    message.set_digest(bytesOf(chunk.digest));
    message.set_offset(chunk.offset);
    message.set_total(chunk.total);
    message.set_content(chunk.content.data(), chunk.content.size());
}

void write(const Prepared& prepared, v1::Envelope& envelope) {
    envelope.mutable_prepared()->set_quality(static_cast<std::uint32_t>(prepared.quality));
}

void write(const Joined& joined, v1::Envelope& envelope) {
    envelope.mutable_joined()->set_first_frame(joined.first.value);
}

void write(const StateFrame& state, v1::Envelope& envelope) {
    writeState(state, *envelope.mutable_state());
}

void write(const Beacon&, v1::Envelope& envelope) {
    envelope.mutable_beacon();
}

void write(const Ready& ready, v1::Envelope& envelope) {
    auto& message = *envelope.mutable_ready();
    message.set_frame(ready.frame.value);
    if (!ready.released) return;
    message.set_released_frame(ready.released->frame.value);
    message.set_released_ns(ready.released->atNs);
}

void write(const Present& present, v1::Envelope& envelope) {
    auto& message = *envelope.mutable_present();
    message.set_frame(present.frame.value);
    message.set_at_ns(present.atNs);
}

void write(const Dismissed& dismissed, v1::Envelope& envelope) {
    envelope.mutable_dismissed()->set_reason(dismissed.reason);
}

void write(const Farewell&, v1::Envelope& envelope) {
    envelope.mutable_farewell();
}

void write(const Ping& ping, v1::Envelope& envelope) {
    envelope.mutable_ping()->set_sent_ns(ping.sentNs);
}

void write(const Pong& pong, v1::Envelope& envelope) {
    auto& message = *envelope.mutable_pong();
    message.set_sent_ns(pong.sentNs);
    message.set_master_ns(pong.masterNs);
}

void write(const Input& input, v1::Envelope& envelope) {
    auto& message = *envelope.mutable_input();
    message.set_kind(inputKindOf(input.kind));
    if (input.kind == InputKind::DropFood) {
        const glm::vec3& at = input.positionMetres;
        for (const float number : {at.x, at.y, at.z}) message.add_position(number);
    } else if (input.kind == InputKind::Steer) {
        const Steering& s = input.steering;
        for (const std::int8_t axis : {s.ahead, s.aside, s.up, s.turn, s.tilt})
            message.add_steering(axis);
    }
}

void write(const StatusRequest&, v1::Envelope& envelope) {
    envelope.mutable_status_request();
}

void write(const StatusReply& reply, v1::Envelope& envelope) {
    auto& message = *envelope.mutable_status_reply();
    message.set_pace(paceOf(reply.pace));
    message.set_paused(reply.paused);
    message.set_frame(reply.frame.value);
    message.set_tick(reply.tick.value);
    message.set_frame_median_ms(reply.frameMedianMs);
    message.set_frame_p99_ms(reply.frameP99Ms);
    message.set_skew_median_ms(reply.skewMedianMs);
    message.set_skew_p99_ms(reply.skewP99Ms);
    message.set_refused_packets(reply.refusedPackets);
    writeEye(reply.eye, *message.mutable_eye());
    message.set_speed_m_s(reply.speedMetresPerSecond);
    message.set_pilot(reply.pilot);
    for (const NodeStatus& status : reply.nodes) {
        auto& node = *message.add_nodes();
        node.set_name(status.name);
        node.set_condition(conditionOf(status.condition));
        node.set_late(status.late);
        node.set_dropped(status.dropped);
    }
}

void write(const ExplainRequest& request, v1::Envelope& envelope) {
    envelope.mutable_explain_request()->set_fish(request.fish);
}

void write(const Explanation& explanation, v1::Envelope& envelope) {
    auto& message = *envelope.mutable_explanation();
    message.set_fish(explanation.fish);
    message.set_school(explanation.school);
    message.set_tick(explanation.tick.value);
    for (const std::string& line : explanation.lines) message.add_lines(line);
}

Packet packed(const v1::Envelope& envelope) {
    Packet packet(envelope.ByteSizeLong());
    assert(packet.size() <= kMostPacketBytes);
    envelope.SerializeToArray(packet.data(), static_cast<int>(packet.size()));
    return packet;
}

}  // namespace

Packet encode(const Envelope& envelope) {
    v1::Envelope message;
    message.set_session(envelope.session);
    std::visit([&](const auto& what) { write(what, message); }, envelope.message);
    return packed(message);
}

Packet encodeState(std::uint64_t session, const StateFrame& state) {
    v1::Envelope message;
    message.set_session(session);
    write(state, message);
    return packed(message);
}

}  // namespace aquarama::wire
