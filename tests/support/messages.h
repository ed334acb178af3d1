// SPDX-License-Identifier: Apache-2.0
// Messages of the wire in one expression each.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/motion/motor.h"
#include "common/wire/messages.h"

namespace aquarama::test {

inline v1::Envelope hello(const std::string& channel,
                          std::uint32_t major = wire::kProtocolMajor,
                          const std::string& build = "") {
    static const std::uint64_t motorHash = motion::motorSelfTest();
    v1::Envelope message;
    message.mutable_hello()->set_channel(channel);
    message.mutable_hello()->set_motor_hash(motorHash);
    message.mutable_hello()->set_major(major);
    message.mutable_hello()->set_build(build);
    return message;
}

inline v1::Envelope refusal(const std::string& reason) {
    v1::Envelope message;
    message.mutable_refusal()->set_reason(reason);
    return message;
}

inline v1::Envelope dismissed(const std::string& reason) {
    v1::Envelope message;
    message.mutable_dismissed()->set_reason(reason);
    return message;
}

inline v1::Envelope welcome(const v1::Welcome& what) {
    v1::Envelope message;
    *message.mutable_welcome() = what;
    return message;
}

inline v1::Envelope blobRequest(const Digest& digest, std::uint64_t offset) {
    v1::Envelope message;
    message.mutable_blob_request()->set_digest(wire::bytesOf(digest));
    message.mutable_blob_request()->set_offset(offset);
    return message;
}

inline v1::Envelope blobChunk(const Digest& digest,
                              std::uint64_t offset,
                              std::uint64_t total,
                              std::span<const std::byte> content) {
    v1::Envelope message;
    v1::BlobChunk& chunk = *message.mutable_blob_chunk();
    chunk.set_digest(wire::bytesOf(digest));
    chunk.set_offset(offset);
    chunk.set_total(total);
    chunk.set_content(content.data(), content.size());
    return message;
}

inline v1::Envelope prepared(config::QualityTier quality, std::uint32_t look = 1) {
    v1::Envelope message;
    message.mutable_prepared()->set_quality(static_cast<std::uint32_t>(quality));
    message.mutable_prepared()->set_look(look);
    return message;
}

inline v1::Envelope joined(std::uint64_t first) {
    v1::Envelope message;
    message.mutable_joined()->set_first_frame(first);
    return message;
}

inline v1::Envelope beacon() {
    v1::Envelope message;
    message.mutable_beacon();
    return message;
}

inline v1::Envelope ready(std::uint64_t frame) {
    v1::Envelope message;
    message.mutable_ready()->set_frame(frame);
    return message;
}

inline v1::Envelope ready(std::uint64_t frame, std::uint64_t released, std::int64_t atNs) {
    v1::Envelope message = ready(frame);
    message.mutable_ready()->set_released_frame(released);
    message.mutable_ready()->set_released_ns(atNs);
    return message;
}

inline v1::Envelope present(std::uint64_t frame, std::int64_t atNs) {
    v1::Envelope message;
    message.mutable_present()->set_frame(frame);
    message.mutable_present()->set_at_ns(atNs);
    return message;
}

inline v1::Envelope farewell() {
    v1::Envelope message;
    message.mutable_farewell();
    return message;
}

inline v1::Envelope ping(std::int64_t sentNs) {
    v1::Envelope message;
    message.mutable_ping()->set_sent_ns(sentNs);
    return message;
}

inline v1::Envelope pong(std::int64_t sentNs, std::int64_t masterNs) {
    v1::Envelope message;
    message.mutable_pong()->set_sent_ns(sentNs);
    message.mutable_pong()->set_master_ns(masterNs);
    return message;
}

inline v1::Envelope input(v1::InputKind kind) {
    v1::Envelope message;
    message.mutable_input()->set_kind(kind);
    return message;
}

inline v1::Envelope dropFood(glm::vec3 place) {
    v1::Envelope message = input(v1::INPUT_DROP_FOOD);
    for (const int axis : {0, 1, 2}) message.mutable_input()->add_position(place[axis]);
    return message;
}

inline v1::Envelope steer(const Steering& steering) {
    v1::Envelope message;
    *message.mutable_input() = wire::steeringInput(steering);
    return message;
}

inline v1::Envelope statusRequest() {
    v1::Envelope message;
    message.mutable_status_request();
    return message;
}

inline v1::Envelope explainRequest(std::uint32_t fish) {
    v1::Envelope message;
    message.mutable_explain_request()->set_fish(fish);
    return message;
}

inline v1::Envelope explanation(std::uint32_t fish,
                                std::uint32_t school,
                                std::uint64_t tick,
                                const std::vector<std::string>& lines) {
    v1::Envelope message;
    v1::Explanation& what = *message.mutable_explanation();
    what.set_fish(fish);
    what.set_school(school);
    what.set_tick(tick);
    for (const std::string& line : lines) what.add_lines(line);
    return message;
}

}  // namespace aquarama::test
