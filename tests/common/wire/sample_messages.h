// SPDX-License-Identifier: Apache-2.0
// One message of every kind, with something to lose in each field.
#pragma once

#include <vector>

#include "tests/support/messages.h"
#include "tests/support/state_packet.h"

namespace aquarama::wire {

inline std::vector<FoodRecord> sampleFood() {
    return {foodRecord(FoodRecord::Kind::Plankton, {1.5F, -2.25F, 60.0F}, 3),
            {},
            foodRecord(FoodRecord::Kind::Pellet, {-63.0F, 0.125F, -1.0F}, 1)};
}

inline Show sampleShow() {
    return {.version = 12,
            .look = 3,
            .scene = "reef",
            .quality = config::QualityTier::Medium,
            .pattern = Pattern::Grid,
            .black = true,
            .brightness = 0.2F,
            .frozen = true,
            .pilot = "middle",
            .calibration = 0x0123456789ABCDEFU,
            .colourReturned = 0.6F,
            .sign = {.columns = 5, .rows = 2, .dots = "\xA5\x40"}};
}

inline config::ScanPattern sampleScanPattern() {
    return {.kind = config::ScanPattern::Kind::GrayRows,
            .step = 3,
            .finestPixels = 8,
            .inverse = true,
            .light = {0.25F, 1, 0},
            .lit = 0x8000000000000005U,
            .number = 4095,
            .tagged = false};
}

// Its bytes mean nothing here.
inline SchoolPart sampleSchool() {
    return {.stream = 7,
            .keyframe = std::vector<std::byte>(20, std::byte{0x5A}),
            .steps = {{{41}, std::vector<std::byte>(3, std::byte{0xA5}), {}},
                      {{42}, {}, 0x0123456789ABCDEFU}}};
}

inline StateFrame sampleFrame() {
    StateFrame state;
    state.frame = {1U << 20U};
    state.tick = {(std::uint64_t{1} << 40U) + 7};
    state.fraction = 0.25F;
    state.eye = {{1.5F, -2.0F, 30.25F}, {0.5F, 0.5F, -0.5F, 0.5F}};
    state.worldHash = 0xFEDCBA9876543210U;
    state.foodOriginMetres = {-3.5F, -6.0F, 0.25F};
    state.foodBefore = sampleFood();
    state.foodAfter = sampleFood();
    state.timeOfDay = 0.875F;
    state.show = sampleShow();
    return state;
}

// In a scan.
inline StateFrame sampleScanState() {
    StateFrame state = sampleFrame();
    state.show.pattern = Pattern::Scan;
    state.show.scan = sampleScanPattern();
    return state;
}

inline v1::Look sampleLook() {
    v1::Look look;
    look.set_number(3);
    look.set_scene_text("name: \"reef\"\n");
    look.set_seed(4000000000U);
    look.set_world(true);
    for (const std::uint32_t id : {7U, 4000000000U}) look.add_fish_ids(id);
    for (const std::uint32_t length : {230U, 65535U}) look.add_length_millimetres(length);
    for (const std::string kind : {"", "other "}) {
        v1::SpeciesBlobs& member = *look.add_cast();
        member.set_species(bytesOf(digestOf(kind + "species")));
        member.set_repertoire(bytesOf(digestOf(kind + "repertoire")));
        member.set_fish(1);
    }
    look.set_quality(static_cast<std::uint32_t>(config::QualityTier::Ultra));
    return look;
}

inline v1::Welcome sampleWelcome() {
    v1::Welcome welcome;
    welcome.set_rig_text("name: \"desk\"\n# a comment\n");
    welcome.set_state_address("tcp://127.0.0.1:7401");
    welcome.set_pace(v1::PACE_LOCKSTEP);
    *welcome.mutable_look() = sampleLook();
    return welcome;
}

inline v1::Envelope samplePrepare() {
    v1::Envelope message;
    *message.mutable_prepare()->mutable_look() = sampleLook();
    return message;
}

inline v1::Envelope sampleOrder() {
    v1::Envelope message;
    v1::Order& order = *message.mutable_order();
    order.set_request(0x8000000000000001U);
    v1::WantedShow& show = *order.mutable_show();
    show.set_scene("bait_ball");
    show.set_quality(v1::WantedShow::AUTO);
    show.set_pattern(v1::WantedShow::WORLD);
    show.set_black(false);
    show.set_freeze(true);
    return message;
}

inline v1::Envelope sampleScan() {
    v1::Envelope message;
    v1::Order& order = *message.mutable_order();
    order.set_request(7);
    order.mutable_scan()->set_holder(0x8000000000000003U);
    writeScanPattern(sampleScanPattern(), *order.mutable_scan()->mutable_pattern());
    return message;
}

// A drawing is offered, one is decided about, and the list is asked for and told.
inline std::vector<v1::Envelope> sampleDrawings() {
    std::vector<v1::Envelope> messages(5);
    v1::Order& offer = *messages[0].mutable_order();
    offer.set_request(8);
    offer.mutable_drawing()->set_skin("png");
    offer.mutable_drawing()->set_species("clownfish");
    offer.mutable_drawing()->set_aside(-1);
    v1::Order& moderation = *messages[1].mutable_order();
    moderation.set_request(9);
    moderation.mutable_moderation()->set_number(17);
    moderation.mutable_moderation()->set_verdict(v1::Moderation::LET_IN);
    messages[2].mutable_drawings_request()->set_skin_of(17);
    v1::DrawingsReply& reply = *messages[3].mutable_drawings_reply();
    reply.set_version(5);
    v1::DrawingStatus& drawing = *reply.add_drawings();
    drawing.set_number(17);
    drawing.set_species("clownfish");
    drawing.set_condition(v1::DrawingStatus::SWIMMING);
    drawing.set_fish(400);
    drawing.set_kept(false);
    drawing.set_offered_at(1'800'000'000);
    reply.set_skin_of(17);
    reply.set_skin("png");
    reply.add_species("clownfish");
    v1::PacketPart& part = *messages[4].mutable_packet_part();
    part.set_packet(11);
    part.set_index(1);
    part.set_count(3);
    part.set_content("content");
    return messages;
}

// A time of day is wanted, and a hunter is released.
inline std::vector<v1::Envelope> sampleCues() {
    std::vector<v1::Envelope> messages(2);
    messages[0].mutable_order()->set_request(81);
    messages[0].mutable_order()->mutable_show()->set_day(v1::WantedShow::DUSK);
    messages[1].mutable_order()->set_request(82);
    messages[1].mutable_order()->mutable_release()->set_species("blacktip_reef_shark");
    return messages;
}

inline v1::Envelope sampleOrderReply() {
    v1::Envelope message;
    v1::OrderReply& reply = *message.mutable_order_reply();
    reply.set_request(0x8000000000000001U);
    reply.set_outcome(v1::OrderReply::REFUSED);
    reply.set_reason("there is no such scene");
    return message;
}

inline v1::Envelope sampleScanReply() {
    v1::Envelope message;
    message.mutable_order_reply()->set_request(7);
    message.mutable_order_reply()->set_outcome(v1::OrderReply::DONE);
    message.mutable_order_reply()->set_frame(77);
    return message;
}

inline v1::NodeReport sampleReport() {
    v1::NodeReport report;
    report.set_host("wall-left");
    report.set_build("0.1.0 123456789abc");
    report.set_renderer("llvmpipe");
    report.add_monitors("HDMI-1 1920x1080 60 Hz");
    report.set_free_disk_bytes(1U << 30U);
    report.set_clock_synchronised(true);
    report.set_round_trip_median_ms(0.25F);
    report.set_round_trip_p99_ms(1.5F);
    report.set_unanswered_percent(0);
    report.set_clock_drift_ppm(-12.5F);
    report.set_gpu_celsius(61.5F);
    report.set_real_time(true);
    report.set_jitter_ms(0.125F);
    return report;
}

inline v1::Envelope sampleNodeReport() {
    v1::Envelope message;
    *message.mutable_node_report() = sampleReport();
    return message;
}

inline v1::Envelope sampleLogLine() {
    v1::Envelope message;
    v1::LogLine& line = *message.mutable_log_line();
    line.set_severity(v1::LOG_WARNING);
    line.set_frame(41);
    line.set_text("left: no master answers; still trying");
    return message;
}

inline v1::Envelope readyWithBlanks() {
    v1::Envelope message = test::ready(14);
    message.mutable_ready()->set_blank_ns(987654321);
    message.mutable_ready()->set_blank_period_ns(16683350);
    return message;
}

inline v1::Envelope sampleStatus() {
    v1::Envelope message;
    v1::StatusReply& reply = *message.mutable_status_reply();
    reply.set_pace(v1::PACE_LOCKSTEP);
    reply.set_frame(99);
    reply.set_tick(98);
    reply.set_frame_median_ms(16.5F);
    reply.set_frame_p99_ms(0);
    reply.set_skew_median_ms(0);
    reply.set_skew_p99_ms(0.75F);
    reply.set_refused_packets(3);
    writeEye({{1, -6, 2.5F}, {0.5F, 0.5F, 0.5F, -0.5F}}, *reply.mutable_eye());
    reply.set_speed_m_s(0.375F);
    *reply.mutable_show() = test::messageOf(sampleShow());
    reply.set_change("prepared by all nodes but left");
    reply.set_guests(false);
    reply.set_drawings(true);
    reply.set_drawings_version(5);
    reply.set_day(v1::WantedShow::FIRST_LIGHT);
    const auto add = [&](const char* name, v1::NodeCondition is, std::uint64_t late, int dropped) {
        v1::NodeStatus& node = *reply.add_nodes();
        node.set_name(name);
        node.set_condition(is);
        node.set_late(late);
        node.set_dropped(static_cast<std::uint64_t>(dropped));
    };
    add("left", v1::NODE_LATE, 4, 1);
    add("right", v1::NODE_ABSENT, 0, 2);
    *reply.mutable_nodes(0)->mutable_report() = sampleReport();
    return message;
}

inline v1::Envelope sampleExplanation() {
    v1::Envelope message = test::explanation(59, 60, 7200, {"59  bigeye_scad", "", "~"});
    v1::Explanation& explanation = *message.mutable_explanation();
    explanation.set_intention(v1::Explanation::EAT);
    explanation.set_target("particle 7");
    explanation.set_pursued_s(1.5F);
    explanation.set_hunger(0.75F);
    explanation.set_libido(0);
    explanation.set_fear(1);
    v1::Sighting& seen = *explanation.add_seen();
    seen.set_kind(v1::Sighting::FOOD);
    seen.set_name("particle 7");
    seen.set_distance_lengths(2.5F);
    seen.set_degrees_right(-170);
    return message;
}

// Orders for a node and its machine, and the report that allows one; a sign, and the hand of a
// phone.
inline std::vector<v1::Envelope> samplePower() {
    std::vector<v1::Envelope> messages(5);
    v1::Order& power = *messages[0].mutable_order();
    power.set_request(78);
    power.set_run(0x0123456789ABCDEFU);
    power.mutable_power()->set_channel("left");
    power.mutable_power()->set_word(v1::Power::POWEROFF);
    messages[1].mutable_order()->set_request(79);
    messages[1].mutable_order()->mutable_restart()->set_channel("left");
    messages[2].mutable_node_report()->set_takes_power_word(true);
    messages[3].mutable_order()->set_request(80);
    v1::Sign& sign = *messages[3].mutable_order()->mutable_sign()->mutable_sign();
    sign.set_columns(5);
    sign.set_rows(2);
    sign.set_dots("\xA5\x40");
    messages[4].mutable_input()->set_kind(v1::INPUT_STEER);
    for (const int axis : {127, 0, -127, 5, 0}) messages[4].mutable_input()->add_steering(axis);
    messages[4].mutable_input()->set_yields(true);
    return messages;
}

// What a node and the operator's console say to each other.
inline std::vector<v1::Envelope> sampleWatch() {
    std::vector<v1::Envelope> messages(5);
    messages[0].mutable_watch_hello()->set_channel("left");
    messages[1].mutable_picture_request()->set_number(7);
    messages[1].mutable_picture_request()->set_width_px(480);
    v1::FramePicture& picture = *messages[2].mutable_frame_picture();
    picture.set_number(7);
    picture.set_frame(1200);
    picture.set_width_px(480);
    picture.set_height_px(360);
    picture.set_jpeg("\xFF\xD8\xFF");
    v1::FishRequest& request = *messages[3].mutable_fish_request();
    request.set_number(8);
    request.set_frame(1200);
    request.set_x(0.25F);
    request.set_y(1);
    v1::FishReply& reply = *messages[4].mutable_fish_reply();
    reply.set_number(8);
    reply.set_frame(1200);
    reply.set_fish(59);
    return messages;
}

// What a standby and its master say to each other, and the order that changes the master.
inline std::vector<v1::Envelope> sampleStandby() {
    std::vector<v1::Envelope> messages(3);
    v1::Follow& follow = *messages[0].mutable_follow();
    follow.set_machine("spare");
    follow.set_major(3);
    follow.set_build("0.1.0");
    follow.set_motor_hash(0x0123456789ABCDEFU);
    follow.set_stream(9);
    follow.set_taken(70);
    follow.set_in_step(true);
    v1::Journalled& part = *messages[1].mutable_journalled();
    part.set_stream(9);
    part.set_part(0);
    part.set_entries("entries");
    part.set_goes_on(false);
    part.set_tick(300);
    part.set_scene("reef");
    part.mutable_wanted()->set_black(true);
    part.mutable_kept()->set_scene("reef");
    messages[2].mutable_order()->set_request(83);
    messages[2].mutable_order()->mutable_change_master()->set_machine("spare");
    return messages;
}

// What is said of keyframes.
inline std::vector<v1::Envelope> sampleKeyframes() {
    std::vector<v1::Envelope> messages(2);
    messages[0].mutable_keyframe_request();
    messages[1].mutable_keyframe()->set_digest(bytesOf(digestOf("keyframe")));
    return messages;
}

// A state is encoded by its own codec.
inline std::vector<Packet> samplePackets() {
    constexpr std::uint64_t kSession = 0x0123456789ABCDEFU;
    const std::vector<std::byte> chunk(100, std::byte{0xA5});
    const Digest digest = digestOf("x");
    const std::vector<v1::Envelope> before{test::hello("left", 3, "0.1.0"),
                                           test::refusal("no"),
                                           test::welcome(sampleWelcome()),
                                           test::blobRequest(digest, 1U << 18U),
                                           test::blobChunk(digest, 50, 200, chunk),
                                           test::prepared(config::QualityTier::High, 3),
                                           test::joined(65)};
    const std::vector<v1::Envelope> after{test::beacon(),
                                          test::ready(12, 11, -5),
                                          test::ready(13),
                                          readyWithBlanks(),
                                          test::present(12, 123456789012345),
                                          test::dismissed("silent"),
                                          test::farewell(),
                                          test::ping(-1),
                                          test::pong(-1, 77),
                                          test::input(v1::INPUT_QUIT),
                                          test::dropFood({0.5F, -6.25F, -2.5F}),
                                          test::steer({127, -127, 0, 1, -64}),
                                          test::statusRequest(),
                                          sampleStatus(),
                                          test::explainRequest(59),
                                          sampleExplanation(),
                                          samplePrepare(),
                                          sampleOrder(),
                                          sampleOrderReply(),
                                          sampleNodeReport(),
                                          sampleLogLine(),
                                          sampleScan(),
                                          sampleScanReply()};
    std::vector<Packet> packets;
    for (const v1::Envelope& message : before) packets.push_back(encode(kSession, message));
    packets.push_back(test::packetOf(kSession, sampleFrame(), sampleSchool()));
    for (const v1::Envelope& message : after) packets.push_back(encode(kSession, message));
    for (const v1::Envelope& message : sampleWatch()) packets.push_back(encode(kSession, message));
    packets.push_back(test::packetOf(kSession, sampleScanState(), sampleSchool()));
    for (const v1::Envelope& message : samplePower()) packets.push_back(encode(kSession, message));
    for (const v1::Envelope& message : sampleDrawings())
        packets.push_back(encode(kSession, message));
    for (const v1::Envelope& message : sampleCues()) packets.push_back(encode(kSession, message));
    for (const v1::Envelope& message : sampleStandby())
        packets.push_back(encode(kSession, message));
    for (const v1::Envelope& message : sampleKeyframes())
        packets.push_back(encode(kSession, message));
    return packets;
}

}  // namespace aquarama::wire
