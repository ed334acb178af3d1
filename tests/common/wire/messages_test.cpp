// SPDX-License-Identifier: Apache-2.0
#include "common/wire/messages.h"

#include <cmath>
#include <limits>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/base/units.h"
#include "common/config/rules.h"
#include "tests/common/wire/sample_messages.h"
#include "tests/support/count_memory.h"
#include "tests/support/state_packet.h"

namespace aquarama::wire {
namespace {

// decode(packet) and the memory that it took on the way.
std::size_t memoryToDecode(std::span<const std::byte> packet) {
    const std::size_t before = test::bytesTaken;
    const auto message = decode(packet);
    if (message) static_cast<void>(readState(message->state()));
    return test::bytesTaken - before;
}

std::string nameOf(const Packet& packet) {
    const auto message = decode(packet);
    return "message kind " + std::to_string(message ? int{message->message_case()} : 0);
}

// What a receiver makes of a packet, all checks included.
bool isUnderstood(std::span<const std::byte> packet) {
    const auto message = decode(packet);
    return message && (!message->has_state() || readState(message->state()));
}

bool isUnderstood(const v1::Envelope& message) {
    return isUnderstood(encode(1, message));
}

std::optional<CodedState> codedIn(const Packet& packet) {
    const auto message = decode(packet);
    return message ? readState(message->state()) : std::nullopt;
}

std::optional<StateFrame> stateIn(const Packet& packet) {
    auto coded = codedIn(packet);
    return coded ? std::optional(std::move(coded->frame)) : std::nullopt;
}

Packet packetOf(const StateFrame& state) {
    return test::packetOf(1, state, sampleSchool());
}

// Programs of one major version understand each other: the bytes of a message never change.
TEST(Messages, haveTheBytesThatTheyAlwaysHad) {
    const std::vector<std::string> digests{
        "2ffbddd0a4e4ff9f", "ae4cef27df3adcf5", "dfbdd8d85639eb3e", "a3fdc54a6bf9ddbd",
        "ad11dd27c0983987", "090c0b2bd94cf4ca", "a36e0f7f63cf522e", "24df64566f2e3ca7",
        "a8f675baedfe365b", "a0d58f772300ae41", "53120c895e56033d", "857492f5684f76b4",
        "247b8e1afba65972", "c7f3b369c0a00088", "a551c3a1e912174b", "760f621d6ecf57ec",
        "bc793839cd199cc1", "235999b6cc1f24b0", "b4f804f1f21489db", "bcea5a3655123469",
        "133cce62e1fa4467", "920e8d8fb9aad386", "8ab8134b5d347401", "432db362e4cc50a3",
        "f78471573ccb309e", "02e79b84136ffc4c", "64180bfe060fe0db", "e69c1fd821f63d79",
        "425830a2b520f0ca", "46ccb28c5816dcff", "3923e2dda7170bb0", "d7e28540e2a7e592",
        "d93655f93549c7a7", "4c05463c5a8485f5", "89a4419730a1cf45", "bcad3b13c61f2ed5",
        "d2d0fb349a124769", "82237231c4be6081", "1821004a010ce9ae", "d9a07501cef5a5cd",
        "8577ff43dd645d36", "79d9b76fd34295b7", "8e02d0f47cf4161a", "ffd01da1ca239d92",
        "2d3d841a32c3907b", "737676a7be02f7b2", "00a175c588369d39", "90437d35a3117237",
        "9b9dac21361f4714", "4699894d539ea8e1", "8a47fc93c7075f49", "1fbe8695add13fbf",
        "69926a0db1cb5c89", "e406a56129ada6e5"};
    const std::vector<Packet> packets = samplePackets();
    ASSERT_EQ(packets.size(), digests.size());
    for (std::size_t i = 0; i < packets.size(); ++i)
        EXPECT_EQ(toHex(digestOf(packets[i])).substr(0, 16), digests[i]) << nameOf(packets[i]);
}

// A master puts its lease before packets of any kind.
TEST(Messages, carryTheLeaseThatIsPutBeforeThem) {
    for (const Packet& packet : samplePackets()) {
        Packet fenced = leaseField(77);
        fenced.insert(fenced.end(), packet.begin(), packet.end());
        const auto plain = decode(packet), message = decode(fenced);
        ASSERT_TRUE(message) << nameOf(packet);
        EXPECT_EQ(message->message_case(), plain->message_case());
        EXPECT_EQ(message->lease_revision(), 77U);
    }
}

TEST(Messages, everyKindComesBackToTheBit) {
    for (const Packet& packet : samplePackets()) {
        const auto decoded = decode(packet);
        ASSERT_TRUE(decoded);
        EXPECT_EQ(decoded->session(), 0x0123456789ABCDEFU);
        EXPECT_EQ(encode(decoded->session(), *decoded), packet) << nameOf(packet);
    }
}

TEST(Messages, aStateKeepsEveryBit) {
    const StateFrame sent = sampleFrame();
    const auto state = stateIn(packetOf(sent));
    ASSERT_TRUE(state);
    EXPECT_EQ(state->frame, sent.frame);
    EXPECT_EQ(state->tick, sent.tick);
    EXPECT_EQ(state->fraction, sent.fraction);
    EXPECT_EQ(state->worldHash, sent.worldHash);
    EXPECT_EQ(state->eye.positionMetres, sent.eye.positionMetres);
    EXPECT_EQ(state->eye.worldFromWall, sent.eye.worldFromWall);
    EXPECT_EQ(state->foodOriginMetres, sent.foodOriginMetres);
    EXPECT_EQ(state->foodBefore, sent.foodBefore);
    EXPECT_EQ(state->foodAfter, sent.foodAfter);
    EXPECT_EQ(state->timeOfDay, sent.timeOfDay);
    EXPECT_EQ(state->show, sent.show);
}

TEST(Messages, aPartOfTheStreamComesBackInAFrameAndAsABlob) {
    const SchoolPart sent = sampleSchool();
    const auto coded = codedIn(packetOf(sampleFrame()));
    const auto blob = readSchoolPart(encodeSchoolPart(sent));
    ASSERT_TRUE(coded);
    ASSERT_TRUE(blob);
    for (const SchoolPart& part : {coded->school, *blob}) {
        EXPECT_EQ(part.stream, sent.stream);
        EXPECT_EQ(part.keyframe, sent.keyframe);
        ASSERT_EQ(part.steps.size(), sent.steps.size());
        for (std::size_t i = 0; i < part.steps.size(); ++i) {
            EXPECT_EQ(part.steps[i].tick, sent.steps[i].tick);
            EXPECT_EQ(part.steps[i].code, sent.steps[i].code);
            EXPECT_EQ(part.steps[i].hash, sent.steps[i].hash);
        }
    }
    EXPECT_FALSE(readSchoolPart(std::vector<std::byte>(9, std::byte{0xFF})));
    EXPECT_FALSE(readSchoolPart({})) << "of no stream";
}

TEST(Messages, aStateWithoutFoodIsAState) {
    StateFrame state = sampleFrame();
    state.foodBefore.clear();
    state.foodAfter.clear();
    EXPECT_TRUE(stateIn(packetOf(state)));
}

TEST(FoodRecord, keepsAParticleToATenthOfAMillimetre) {
    for (const glm::vec3 place : {glm::vec3(0), glm::vec3(63.99F, -63.99F, 0.001F)}) {
        const FoodRecord record = foodRecord(FoodRecord::Kind::Pellet, place, 7);
        EXPECT_LT(glm::distance(record.offsetMetres(), place), 1e-4F);
        EXPECT_EQ(record.kind(), FoodRecord::Kind::Pellet);
        EXPECT_EQ(record.generation(), 3U);
        EXPECT_TRUE(record.isPossible());
    }
}

TEST(FoodRecord, whatIsOutOfReachIsNotThere) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const glm::vec3 place :
         {glm::vec3(65, 0, 0), glm::vec3(0, -1e30F, 0), glm::vec3(0, 0, nan)})
        EXPECT_EQ(foodRecord(FoodRecord::Kind::Plankton, place, 1), FoodRecord{});
    EXPECT_EQ(foodRecord(FoodRecord::Kind::None, {1, 2, 3}, 1), FoodRecord{});
}

// A frame of two steps, of which one changes nothing, and without a sign.
TEST(Messages, aFrameBesideItsFishIsSmall) {
    StateFrame state = sampleFrame();
    state.show.sign = {};
    SchoolPart school = sampleSchool();
    school.keyframe.clear();
    EXPECT_LT(test::packetOf(9, state, school).size(), 260U);
}

TEST(Messages, noPrefixOfAMessageIsAMessage) {
    for (const Packet& packet : samplePackets()) {
        for (std::size_t size = 0; size < packet.size(); ++size) {
            EXPECT_FALSE(isUnderstood(std::span{packet}.first(size)))
                << nameOf(packet) << " " << size;
        }
    }
}

TEST(Messages, alteredBytesNeitherCrashNorCostMemory) {
    std::mt19937 random(20);
    for (const Packet& packet : samplePackets()) {
        for (int trial = 0; trial < 3000; ++trial) {
            Packet altered = packet;
            for (unsigned change = random() % 4 + 1; change > 0; --change) {
                altered[random() % altered.size()] = static_cast<std::byte>(random());
            }
            ASSERT_LT(memoryToDecode(altered), 64 * altered.size() + 4096) << nameOf(packet);
        }
    }
}

TEST(Messages, noiseIsRefused) {
    std::mt19937 random(21);
    int accepted = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        Packet noise(random() % 200);
        for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
        accepted += decode(noise) ? 1 : 0;
    }
    EXPECT_EQ(accepted, 0);
}

TEST(Messages, aLargePacketOfTinyObjectsIsRefusedUnread) {
    // session, then a status reply that holds a million empty nodes: two bytes each on the wire, an
    // object each in memory.
    Packet packet = encode(1, test::statusRequest());
    packet.resize(9);
    const std::size_t nodes = 1'000'000;
    for (const unsigned byte : {0x92U, 0x01U}) packet.push_back(static_cast<std::byte>(byte));
    for (std::size_t size = 2 * nodes; size > 0; size >>= 7U) {
        packet.push_back(static_cast<std::byte>((size & 0x7FU) | (size > 0x7FU ? 0x80U : 0U)));
    }
    for (std::size_t i = 0; i < nodes; ++i) {
        packet.push_back(std::byte{0x52});
        packet.push_back(std::byte{0});
    }
    EXPECT_LT(memoryToDecode(packet), 4096U);
    EXPECT_FALSE(decode(packet));
}

// Each way in which a state can be well-formed protobuf and still lie.
TEST(Messages, aStateThatLiesIsRefused) {
    const auto refused = [](auto alter) {
        StateFrame state = sampleFrame();
        alter(state);
        return !stateIn(packetOf(state));
    };
    const auto nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(refused([](StateFrame&) {}));
    EXPECT_TRUE(refused([](StateFrame& s) { s.fraction = 1.01F; }));
    EXPECT_TRUE(refused([&](StateFrame& s) { s.fraction = nan; }));
    EXPECT_TRUE(refused([&](StateFrame& s) { s.eye.positionMetres.y = nan; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.foodBefore.pop_back(); }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.foodBefore.clear(); }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.foodAfter[0].bits |= 3ULL << 60U; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.foodAfter[1].bits = 5; }));  // nothing, somewhere
    EXPECT_TRUE(refused([&](StateFrame& s) { s.foodOriginMetres.z = nan; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.timeOfDay = -0.01F; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.timeOfDay = 1.01F; }));
    EXPECT_TRUE(
        refused([](StateFrame& s) { s.show.quality = static_cast<config::QualityTier>(4); }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.show.pattern = static_cast<Pattern>(5); }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.show.brightness = 1.01F; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.show.colourReturned = 1.01F; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.show.sign.rows = 4; })) << "20 dots are 3 bytes";
    EXPECT_TRUE(refused([](StateFrame& s) { s.show.sign.rows = 65; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.show.sign.dots.clear(); }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.show.scene = "a\nb"; }));
    EXPECT_TRUE(refused([](StateFrame& s) { s.show.pilot = std::string(65, 'x'); }));
    EXPECT_TRUE(refused([&](StateFrame& s) { s.timeOfDay = nan; }));
    EXPECT_TRUE(refused([](StateFrame& s) {
        s.foodBefore.resize(kMostFood + 1);
        s.foodAfter.resize(kMostFood + 1);
    }));
}

// A node computes a picture by these numbers.
TEST(Messages, aScanHasAPatternWithinItsBoundsAndNoOtherPatternHasOne) {
    const auto accepted = [](auto alter) {
        v1::Envelope message = sampleScan();
        alter(*message.mutable_order()->mutable_scan());
        return isUnderstood(message);
    };
    EXPECT_TRUE(accepted([](v1::HeldScan& s) { s.clear_pattern(); }));
    EXPECT_FALSE(accepted([](v1::HeldScan& s) { s.clear_holder(); }));
    using Alter = void (*)(v1::ScanPattern&);
    for (const Alter alter : {Alter{[](v1::ScanPattern& p) { p.set_kind(0); }},
                              Alter{[](v1::ScanPattern& p) { p.set_kind(8); }},
                              Alter{[](v1::ScanPattern& p) { p.set_step(16); }},
                              Alter{[](v1::ScanPattern& p) {
                                  p.set_kind(4);  // a phase
                                  p.set_step(4);
                              }},
                              Alter{[](v1::ScanPattern& p) { p.set_finest_pixels(0); }},
                              Alter{[](v1::ScanPattern& p) { p.set_finest_pixels(65536); }},
                              Alter{[](v1::ScanPattern& p) { p.set_light(1, 1.01F); }},
                              Alter{[](v1::ScanPattern& p) { p.set_light(0, -0.01F); }},
                              Alter{[](v1::ScanPattern& p) { p.add_light(1); }},
                              Alter{[](v1::ScanPattern& p) { p.set_number(4096); }},
                              Alter{[](v1::ScanPattern& p) { p.clear_lit(); }},
                              Alter{[](v1::ScanPattern& p) { p.clear_inverse(); }},
                              Alter{[](v1::ScanPattern& p) { p.clear_tagged(); }}})
        EXPECT_FALSE(accepted([&](v1::HeldScan& s) { alter(*s.mutable_pattern()); }));
    v1::Envelope byName = sampleOrder();
    byName.mutable_order()->mutable_show()->set_pattern(
        static_cast<v1::WantedShow::Shown>(v1::PATTERN_SCAN));
    EXPECT_FALSE(isUnderstood(byName));
    StateFrame state = sampleScanState();
    EXPECT_TRUE(stateIn(packetOf(state)));
    EXPECT_EQ(stateIn(packetOf(state))->show, state.show);
    state.show.pattern = Pattern::Grey;
    EXPECT_FALSE(stateIn(packetOf(state)));
    state.show.pattern = Pattern::Scan;
    state.show.scan.reset();
    EXPECT_FALSE(stateIn(packetOf(state)));
}

// What a node sends may come from a broken one.
TEST(Messages, foodIsDroppedAtAPlaceOrNotAtAll) {
    const auto accepted = [](glm::vec3 place) { return isUnderstood(test::dropFood(place)); };
    EXPECT_TRUE(accepted({0, -6, -kMostInputMetres}));
    EXPECT_FALSE(accepted({0, -6, -2 * kMostInputMetres}));
    EXPECT_FALSE(accepted({std::numeric_limits<float>::quiet_NaN(), -6, 0}));
    EXPECT_FALSE(accepted({0, std::numeric_limits<float>::infinity(), 0}));
    EXPECT_FALSE(isUnderstood(test::input(v1::INPUT_DROP_FOOD)));
    v1::Envelope quit = test::dropFood({0, 0, 0});
    quit.mutable_input()->set_kind(v1::INPUT_QUIT);
    EXPECT_FALSE(isUnderstood(quit));
    EXPECT_FALSE(isUnderstood(test::input(v1::INPUT_UNSPECIFIED)));
}

TEST(Messages, aSteeringIsOfSharesNoneBeyondFull) {
    const Steering held{kFullSteering, -kFullSteering, 3, -1, 0};
    const auto decoded = decode(encode(1, test::steer(held)));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(steeringOf(decoded->input()), held);
    EXPECT_FALSE(isUnderstood(test::steer({-128, 0, 0, 0, 0})));
    v1::Envelope four = test::input(v1::INPUT_STEER);
    for (int axis = 0; axis < 4; ++axis) four.mutable_input()->add_steering(0);
    EXPECT_FALSE(isUnderstood(four));
}

// A node splits the school by the cast: both must have the same fish.
TEST(Messages, aCastOfMoreOrFewerFishThanTheSchoolIsRefused) {
    const auto accepted = [](std::uint32_t fish) {
        v1::Welcome welcome = sampleWelcome();
        welcome.mutable_look()->mutable_cast(1)->set_fish(fish);
        return isUnderstood(test::welcome(welcome));
    };
    EXPECT_TRUE(accepted(1));
    EXPECT_FALSE(accepted(0));
    EXPECT_FALSE(accepted(2));
    EXPECT_FALSE(accepted(0xFFFFFFFFU));
}

// Each bound of a welcome and of a status on its own.
TEST(Messages, aWelcomeOrAStatusThatLiesIsRefused) {
    const auto welcomed = [](auto alter) {
        v1::Welcome welcome = sampleWelcome();
        alter(welcome);
        return isUnderstood(test::welcome(welcome));
    };
    EXPECT_TRUE(welcomed([](v1::Welcome& w) { w.mutable_look()->clear_quality(); }));
    EXPECT_FALSE(welcomed([](v1::Welcome& w) { w.mutable_look()->set_quality(4); }));
    EXPECT_FALSE(welcomed([](v1::Welcome& w) { w.mutable_look()->clear_seed(); }));
    EXPECT_FALSE(welcomed([](v1::Welcome& w) { w.clear_pace(); }));
    EXPECT_FALSE(welcomed([](v1::Welcome& w) { w.mutable_look()->clear_world(); }));
    EXPECT_FALSE(
        welcomed([](v1::Welcome& w) { w.mutable_look()->set_length_millimetres(0, 65536); }));
    EXPECT_FALSE(welcomed([](v1::Welcome& w) { w.mutable_look()->add_fish_ids(1); }));
    EXPECT_FALSE(
        welcomed([](v1::Welcome& w) { w.mutable_look()->mutable_cast(0)->set_species("short"); }));
    EXPECT_FALSE(welcomed([](v1::Welcome& w) { w.set_state_address("a\nb"); }));
    EXPECT_FALSE(
        welcomed([](v1::Welcome& w) { w.set_rig_text(std::string((1U << 20U) + 1, ' ')); }));
    const auto told = [](auto alter) {
        v1::Envelope message = sampleStatus();
        alter(*message.mutable_status_reply());
        return isUnderstood(message);
    };
    EXPECT_TRUE(told([](v1::StatusReply& s) { s.clear_nodes(); }));
    EXPECT_FALSE(told([](v1::StatusReply& s) { s.clear_pace(); }));
    EXPECT_FALSE(told([](v1::StatusReply& s) { s.mutable_eye()->RemoveLast(); }));
    EXPECT_FALSE(told([](v1::StatusReply& s) { s.set_skew_p99_ms(INFINITY); }));
    EXPECT_FALSE(told([](v1::StatusReply& s) { s.set_frame_peak_ms(NAN); }));
    EXPECT_FALSE(told([](v1::StatusReply& s) { s.mutable_nodes(0)->set_picture_ms(NAN); }));
    EXPECT_FALSE(told([](v1::StatusReply& s) { s.mutable_nodes(0)->clear_condition(); }));
    EXPECT_FALSE(told([](v1::StatusReply& s) { s.mutable_nodes(0)->set_name(""); }));
    EXPECT_FALSE(told([](v1::StatusReply& s) {
        for (int i = 0; i < 64; ++i) *s.add_nodes() = s.nodes(0);
    }));
}

namespace pb = google::protobuf;
using Field = pb::FieldDescriptor;
using Break = std::function<void(pb::Message&)>;

const v1::Rule& ruleOf(const Field& field) {
    return field.options().GetExtension(v1::rule);
}

const v1::Rule& ruleOf(const pb::Message& message, const std::string& field) {
    return ruleOf(*message.GetDescriptor()->FindFieldByName(field));
}

void setText(pb::Message& message, const Field& field, const std::string& text) {
    const pb::Reflection& set = *message.GetReflection();
    if (field.is_repeated())
        set.SetRepeatedString(&message, &field, 0, text);
    else
        set.SetString(&message, &field, text);
}

void setNumber(pb::Message& message, const Field& field, double value) {
    const pb::Reflection& set = *message.GetReflection();
    if (field.cpp_type() == Field::CPPTYPE_UINT32)
        set.SetUInt32(&message, &field, static_cast<std::uint32_t>(value));
    else if (field.cpp_type() == Field::CPPTYPE_UINT64)
        set.SetUInt64(&message, &field, static_cast<std::uint64_t>(value));
    else
        set.SetFloat(&message, &field, static_cast<float>(value));
}

// Ways to break the rule of a field that the message has.
std::vector<Break> breaksOf(const Field& field) {
    const v1::Rule& rule = ruleOf(field);
    std::vector<Break> ways;
    const auto add = [&](auto way) {
        ways.emplace_back([&field, way](pb::Message& message) { way(message); });
    };
    if (rule.required())
        add([&field](pb::Message& m) { m.GetReflection()->ClearField(&m, &field); });
    for (const std::uint32_t bytes : {rule.most_bytes() + 1, rule.least_bytes() - 1})
        if (rule.has_most_bytes() && bytes <= rule.most_bytes() + 1)
            add([&field, bytes](pb::Message& m) { setText(m, field, std::string(bytes, 'x')); });
    if (rule.printed()) add([&field](pb::Message& m) { setText(m, field, "a\nb"); });
    if (rule.ascii()) add([&field](pb::Message& m) { setText(m, field, "\xC3\xA9"); });
    const bool isNumber = field.cpp_type() == Field::CPPTYPE_UINT32 ||
                          field.cpp_type() == Field::CPPTYPE_UINT64 ||
                          field.cpp_type() == Field::CPPTYPE_FLOAT;
    if (!isNumber || field.is_repeated()) return ways;
    if (rule.has_most())
        add([&field, &rule](pb::Message& m) { setNumber(m, field, rule.most() + 1); });
    if (rule.has_least())
        add([&field, &rule](pb::Message& m) { setNumber(m, field, rule.least() - 1); });
    if (field.cpp_type() == Field::CPPTYPE_FLOAT)
        add([&field](pb::Message& m) { setNumber(m, field, NAN); });
    return ways;
}

// Breaks each rule of `part`, which is inside `whole`, and looks whether that is noticed.
int breakEach(v1::Envelope& whole, pb::Message& part) {
    const pb::Reflection& get = *part.GetReflection();
    std::vector<const Field*> fields;
    get.ListFields(part, &fields);
    int broken = 0;
    for (const Field* field : fields) {
        const std::unique_ptr<pb::Message> good(part.New());
        good->CopyFrom(part);
        for (const Break& way : breaksOf(*field)) {
            way(part);
            EXPECT_FALSE(isUnderstood(whole)) << field->full_name();
            part.CopyFrom(*good);
            ++broken;
        }
        if (field->cpp_type() != Field::CPPTYPE_MESSAGE || field->name() == "state") continue;
        broken += breakEach(whole,
                            field->is_repeated() ? *get.MutableRepeatedMessage(&part, field, 0)
                                                 : *get.MutableMessage(&part, field));
    }
    return broken;
}

// Each rule of each message that is sampled, one at a time.
TEST(Messages, whatBreaksARuleOfTheSchemaIsRefused) {
    int broken = 0;
    for (const Packet& packet : samplePackets()) {
        auto message = decode(packet);
        ASSERT_TRUE(message);
        ASSERT_TRUE(isUnderstood(*message));
        broken += breakEach(*message, *message);
    }
    EXPECT_GT(broken, 150);
}

// What the code cuts texts to, and what is accepted, is one length.
TEST(Messages, boundsOfTheCodeAreThoseOfTheSchema) {
    EXPECT_EQ(ruleOf(v1::Hello(), "channel").most_bytes(), kMostNameBytes);
    EXPECT_EQ(ruleOf(v1::OrderReply(), "reason").most_bytes(), kMostReasonBytes);
    EXPECT_EQ(ruleOf(v1::NodeReport(), "host").most_bytes(), kMostReportBytes);
    EXPECT_EQ(ruleOf(v1::Show(), "scene").most_bytes(), kMostNameBytes);
    EXPECT_EQ(ruleOf(v1::LogLine(), "text").most_bytes(), kMostLogBytes);
    EXPECT_EQ(ruleOf(v1::BlobChunk(), "content").most_bytes(), kBlobChunkBytes);
    EXPECT_EQ(ruleOf(v1::Journalled(), "entries").most_bytes(), kBlobChunkBytes);
    EXPECT_EQ(ruleOf(v1::BlobChunk(), "total").most(), kMostBlobBytes);
    EXPECT_EQ(ruleOf(v1::Explanation(), "lines").most(), kMostExplanationLines);
    EXPECT_EQ(ruleOf(v1::Explanation(), "lines").most_bytes(), kMostExplanationLineBytes);
    EXPECT_EQ(ruleOf(v1::Explanation(), "school").most(), kMostFish);
    EXPECT_EQ(ruleOf(v1::FishReply(), "fish").most(), kMostFish - 1);
    EXPECT_EQ(ruleOf(v1::Look(), "cast").most(), kMostSpecies);
    EXPECT_EQ(ruleOf(v1::FramePicture(), "jpeg").most_bytes(), kMostJpegBytes);
    EXPECT_EQ(ruleOf(v1::Show(), "brightness").most(), kFullLight);
    EXPECT_EQ(ruleOf(v1::Show(), "colour_returned").most(), kAllColour);
}

TEST(Messages, namesAreBoundedAndPrintable) {
    const auto accepted = [](const std::string& name) { return isUnderstood(test::hello(name)); };
    EXPECT_TRUE(accepted(std::string(kMostNameBytes, 'n')));
    EXPECT_FALSE(accepted(std::string(kMostNameBytes + 1, 'n')));
    EXPECT_FALSE(accepted(""));
    EXPECT_FALSE(accepted("left\nmaster: all is well"));
    EXPECT_TRUE(isUnderstood(test::refusal(std::string(1024, 'r'))));
    EXPECT_FALSE(isUnderstood(test::refusal(std::string(1025, 'r'))));
    EXPECT_FALSE(isUnderstood(test::dismissed("\x1b[2J")));
}

// What a master says of a mind is drawn over the picture and printed in terminals.
TEST(Messages, anExplanationIsBoundedAndPrintable) {
    const auto accepted = [](int lines, const std::string& line, std::uint32_t school) {
        const std::vector<std::string> all(static_cast<std::size_t>(lines), line);
        return isUnderstood(test::explanation(0, school, 0, all));
    };
    EXPECT_TRUE(accepted(kMostExplanationLines, std::string(kMostExplanationLineBytes, '~'), 1));
    EXPECT_FALSE(accepted(kMostExplanationLines + 1, "", 1));
    EXPECT_FALSE(accepted(1, std::string(kMostExplanationLineBytes + 1, ' '), 1));
    EXPECT_FALSE(accepted(1, "\x1b[2J", 1));
    EXPECT_FALSE(accepted(1, "\xc3\xa9", 1));
    EXPECT_FALSE(accepted(1, "", kMostFish + 1));
    v1::Envelope message = sampleExplanation();
    v1::Explanation& explanation = *message.mutable_explanation();
    while (explanation.seen_size() < 4) *explanation.add_seen() = explanation.seen(0);
    EXPECT_TRUE(isUnderstood(message));
    *explanation.add_seen() = explanation.seen(0);
    EXPECT_FALSE(isUnderstood(message));
}

TEST(Messages, aChunkStaysInsideItsBlob) {
    const auto accepted = [](std::uint64_t offset, std::uint64_t total, std::size_t size) {
        return isUnderstood(test::blobChunk({}, offset, total, Packet(size)));
    };
    EXPECT_TRUE(accepted(0, kBlobChunkBytes, kBlobChunkBytes));
    EXPECT_FALSE(accepted(1, kBlobChunkBytes, kBlobChunkBytes));
    EXPECT_FALSE(accepted(0, kMostBlobBytes, kBlobChunkBytes + 1));
    EXPECT_FALSE(accepted(0, kMostBlobBytes + 1, 1));
    EXPECT_FALSE(accepted(std::numeric_limits<std::uint64_t>::max(), 2, 1));
    EXPECT_FALSE(isUnderstood(test::blobRequest({}, kMostBlobBytes + 1)));
}

TEST(Messages, aHelloOfAnotherMajorVersionIsReadSoThatItCanBeAnswered) {
    const auto decoded = decode(encode(0, test::hello("left", kProtocolMajor + 1, "9.0")));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->hello().major(), kProtocolMajor + 1);
}

}  // namespace
}  // namespace aquarama::wire
