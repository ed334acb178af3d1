// SPDX-License-Identifier: Apache-2.0
// Large packets in parts: they come together whole, and nothing else does.
#include "common/wire/parts.h"

#include <gtest/gtest.h>

namespace aquarama::wire {
namespace {

using std::chrono::seconds;

constexpr PartAssembly::Moment kNow{seconds(100)};

Packet offer(std::size_t bytes) {
    v1::Envelope message;
    message.mutable_order()->set_request(1);
    message.mutable_order()->mutable_drawing()->set_species("clownfish");
    message.mutable_order()->mutable_drawing()->set_skin(std::string(bytes, 'x'));
    return encode(0, message);
}

v1::PacketPart partIn(const Packet& packet) {
    const auto message = decode(packet);
    EXPECT_TRUE(message && message->has_packet_part());
    return message ? message->packet_part() : v1::PacketPart{};
}

TEST(Parts, ofASmallPacketAreItself) {
    const Packet small = offer(60'000);
    EXPECT_EQ(partsOf(small, 7), std::vector<Packet>{small});
}

TEST(Parts, areSmallAndMakeTheWhole) {
    const Packet whole = offer(kMostSkinBytes);
    const auto parts = partsOf(whole, 7);
    EXPECT_EQ(parts.size(), (whole.size() + kPartBytes - 1) / kPartBytes);
    PartAssembly assembly;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        EXPECT_LE(parts[i].size(), kMostSmallPacketBytes);
        const auto made = assembly.take("anna", partIn(parts[i]), kNow);
        EXPECT_EQ(made.has_value(), i + 1 == parts.size());
        if (made) {
            EXPECT_EQ(*made, whole);
        }
    }
}

TEST(Parts, ofSeveralSendersAreKeptApart) {
    const Packet one = offer(100'000), other = offer(120'000);
    const auto first = partsOf(one, 7), second = partsOf(other, 7);
    PartAssembly assembly;
    std::optional<Packet> ofAnna, ofBert;
    for (std::size_t i = 0; i < first.size(); ++i) {
        ofAnna = assembly.take("anna", partIn(first[i]), kNow);
        ofBert = assembly.take("bert", partIn(second[i]), kNow);
    }
    EXPECT_EQ(ofAnna, one);
    EXPECT_EQ(ofBert, other);
}

TEST(Parts, thatAreLostOrMixedMakeNothing) {
    const auto parts = partsOf(offer(100'000), 7);
    ASSERT_EQ(parts.size(), 3U);
    PartAssembly assembly;
    const auto take = [&](std::size_t i, std::uint64_t packet, PartAssembly::Moment now) {
        v1::PacketPart part = partIn(parts[i]);
        part.set_packet(packet);
        return assembly.take("anna", part, now).has_value();
    };
    EXPECT_FALSE(take(1, 7, kNow)) << "without the first";
    EXPECT_FALSE(take(0, 7, kNow));
    EXPECT_FALSE(take(2, 7, kNow)) << "one is missing";
    EXPECT_FALSE(take(1, 8, kNow)) << "of another packet";
    EXPECT_FALSE(take(1, 7, kNow + seconds(6))) << "too late";
    EXPECT_FALSE(take(0, 9, kNow));
    EXPECT_FALSE(take(1, 9, kNow));
    EXPECT_TRUE(take(2, 9, kNow)) << "said once more";
}

// Who begins and never ends takes the memory of what he has sent; no more than eight do.
TEST(Parts, areOfFewSendersAtOnce) {
    const auto parts = partsOf(offer(60'000 + kPartBytes), 7);
    ASSERT_EQ(parts.size(), 3U);
    PartAssembly assembly;
    for (std::size_t sender = 0; sender <= PartAssembly::kMostSenders; ++sender)
        EXPECT_FALSE(assembly.take(std::to_string(sender), partIn(parts[0]), kNow));
    const auto ends = [&](std::size_t sender, PartAssembly::Moment now) {
        const std::string name = std::to_string(sender);
        return !assembly.take(name, partIn(parts[1]), now) &&
               assembly.take(name, partIn(parts[2]), now).has_value();
    };
    EXPECT_TRUE(ends(0, kNow));
    EXPECT_FALSE(ends(PartAssembly::kMostSenders, kNow));
}

}  // namespace
}  // namespace aquarama::wire
