// SPDX-License-Identifier: Apache-2.0
#include "common/wire/recording.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/base/units.h"
#include "common/wire/messages.h"
#include "tests/common/wire/sample_recording.h"
#include "tests/support/count_memory.h"

namespace aquarama::wire {
namespace {

using testing::HasSubstr;

// Why it is refused; empty where it is read.
std::string refusalOf(const Packet& file) {
    try {
        static_cast<void>(decodeRecording(file, "show.aqrec"));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

std::size_t entriesIn(const Recording& recording) {
    return recording.inputs.size() + recording.checkpoints.size() + recording.saves.size() +
           (recording.moment ? 1U : 0U);
}

TEST(RecordingFormat, everyEntryComesBack) {
    const Recording recording = decodeRecording(joined(sampleEntries()), "show.aqrec");
    EXPECT_EQ(recording.protocol, kProtocolMajor);
    EXPECT_EQ(recording.assets.seed, 4000000000U);
    EXPECT_EQ(recording.assets.scene, sampleAssets().scene);
    ASSERT_EQ(recording.assets.cast.size(), 2U);
    EXPECT_EQ(recording.assets.cast[0].text, sampleAssets().cast[0].text);
    EXPECT_EQ(recording.assets.cast[0].repertoire, sampleAssets().cast[0].repertoire);
    EXPECT_EQ(recording.assets.cast[0].fish, 51U);
    ASSERT_EQ(recording.inputs.size(), 10U);
    EXPECT_EQ(recording.inputs[0].tick, Tick{17});
    const auto& food = std::get<RecordedFood>(recording.inputs[0].input);
    EXPECT_EQ(food.position, glm::vec3(1.5F, -2.0F, 30.25F));
    EXPECT_EQ(food.pellets, 12U);
    EXPECT_EQ(std::get<Steering>(recording.inputs[1].input), (Steering{127, -127, 0, 5, -1}));
    const auto& moved = std::get<RecordedSubmarine>(recording.inputs[2].input);
    EXPECT_EQ(moved.position, glm::vec3(0, -6, 0));
    EXPECT_EQ(moved.velocityMetresPerSecond, glm::vec3(0.5F, 0, -0.25F));
    const auto& clock = std::get<RecordedClock>(recording.inputs[3].input);
    EXPECT_EQ(clock.timeOfDay, 0.75);
    EXPECT_EQ(clock.lengthSeconds, 43'200);
    EXPECT_EQ(std::get<WallHands>(recording.inputs[4].input),
              (WallHands{{7, {0.5F, 0, -3}}, {8, {-2.5F, 1, -2}}}));
    const auto& drawing = std::get<RecordedDrawing>(recording.inputs[5].input);
    EXPECT_EQ(drawing.fish, 40U);
    EXPECT_EQ(drawing.number, 7U);
    EXPECT_EQ(drawing.picture, digestOf("png"));
    EXPECT_EQ(drawing.aside, -1);
    EXPECT_EQ(std::get<RecordedDeparture>(recording.inputs[6].input).fish, 40U);
    EXPECT_EQ(std::get<RecordedDay>(recording.inputs[7].input).timeOfDay, 0.85);
    EXPECT_EQ(std::get<RecordedDay>(recording.inputs[7].input).glideSeconds, 40);
    EXPECT_FALSE(std::get<RecordedDay>(recording.inputs[8].input).timeOfDay);
    EXPECT_EQ(std::get<RecordedRelease>(recording.inputs[9].input).species, 1U);
    const std::vector<RecordedHash> checkpoints{{{0}, 0xFEDCBA9876543210U}, {{600}, 1}};
    EXPECT_EQ(recording.checkpoints, checkpoints);
    ASSERT_EQ(recording.saves.size(), 1U);
    EXPECT_EQ(recording.saves[0].tick, Tick{600});
    const Packet file = joined(sampleEntries());
    EXPECT_TRUE(std::ranges::equal(
        std::span(file).subspan(recording.saves[0].at, recording.saves[0].bytes), sampleState()));
    ASSERT_TRUE(recording.moment);
    EXPECT_EQ(recording.moment->tick, Tick{660});
    EXPECT_EQ(recording.moment->clockNs, 123'456'789'000U);
    EXPECT_EQ(recording.moment->boot, "a boot");
    EXPECT_EQ(recording.moment->unixSeconds, 1'795'000'000U);
    ASSERT_TRUE(recording.end);
    EXPECT_EQ(recording.lastTick(), recording.end->tick);
    EXPECT_TRUE(doubtsAbout(recording).empty());
}

TEST(RecordingFormat, mayBeginWithASave) {
    const auto begins = [](const std::vector<Packet>& events) {
        std::vector<Packet> entries{beginningOf(sampleAssets())};
        entries.insert(entries.end(), events.begin(), events.end());
        return decodeRecording(joined(entries), "show.aqrec").beginsWithSave;
    };
    EXPECT_TRUE(begins({entryOf(Tick{60}, sampleState()), entryOf(RecordedHash{{60}, 5})}));
    EXPECT_FALSE(begins({entryOf(RecordedHash{{0}, 5}), entryOf(Tick{60}, sampleState())}));
    EXPECT_FALSE(begins({}));
}

// A journal writes an input ahead of its time.
TEST(RecordingFormat, inputsMayComeBeforeHashesOfEarlierTicksAndRepertoiresMayBeNamed) {
    const Packet file = joined({beginningOf(sampleAssets(), Repertoires::Named),
                                entryOf(RecordedInput{{20}, Steering{}}),
                                entryOf(RecordedHash{{18}, 5}),
                                entryOf(RecordedInput{{21}, Steering{}})});
    const Recording recording = decodeRecording(file, "show.aqrec");
    EXPECT_EQ(recording.bytesLeftOver, 0U);
    EXPECT_EQ(recording.inputs.size(), 2U);
    EXPECT_TRUE(recording.assets.cast[0].repertoire.empty());
    EXPECT_EQ(recording.assets.cast[0].repertoireDigest,
              digestOf(sampleAssets().cast[0].repertoire));
    EXPECT_LT(file.size(), joined({beginningOf(sampleAssets())}).size());
    EXPECT_THAT(refusalOf(joined({beginningOf(sampleAssets()),
                                  entryOf(RecordedInput{{20}, Steering{}}),
                                  entryOf(RecordedInput{{19}, Steering{}})})),
                HasSubstr("tick"));
}

TEST(RecordingFormat, errorsNameTheFileOfASpeciesButNotItsFolder) {
    const Recording recording = decodeRecording(joined(sampleEntries()), "show.aqrec");
    EXPECT_EQ(recording.assets.cast[0].file, "show.aqrec: its scad.txtpb");
}

// Whatever ended the program that wrote it.
TEST(RecordingFormat, aFileThatStopsAnywhereIsReadUpToItsLastWholeEntry) {
    const std::vector<Packet> entries = sampleEntries();
    const Packet whole = joined(entries);
    const std::size_t beginning = entries.front().size();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const Packet part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        if (size < beginning) {
            EXPECT_NE(refusalOf(part), "") << size;
            continue;
        }
        const Recording recording = decodeRecording(part, "show.aqrec");
        EXPECT_FALSE(recording.end);
        EXPECT_THAT(doubtsAbout(recording), testing::ElementsAre(HasSubstr("cut short")));
        std::size_t entriesThere = 0, bytes = 0;
        while (bytes + entries[entriesThere].size() <= size)
            bytes += entries[entriesThere++].size();
        EXPECT_EQ(entriesIn(recording), entriesThere - 1);
        EXPECT_EQ(recording.bytesLeftOver, size - bytes);
    }
}

// A disk that forgot a bit: what was before it is there, and what it says is said.
TEST(RecordingFormat, aFileThatIsDamagedAnywhereIsReadUpToThere) {
    const std::vector<Packet> entries = sampleEntries();
    const Packet whole = joined(entries);
    for (std::size_t at = entries.front().size(); at < whole.size(); ++at) {
        Packet altered = whole;
        altered[at] ^= std::byte{0x10};
        std::size_t entriesThere = 0, bytes = 0;
        while (bytes + entries[entriesThere].size() <= at) bytes += entries[entriesThere++].size();
        const Recording recording = decodeRecording(altered, "show.aqrec");
        EXPECT_FALSE(recording.end);
        EXPECT_EQ(recording.wholeBytes, bytes) << at;
        EXPECT_EQ(recording.bytesLeftOver, whole.size() - bytes);
        EXPECT_EQ(entriesIn(recording), entriesThere - 1);
    }
}

TEST(RecordingFormat, isKnownByItsFirstBytes) {
    EXPECT_TRUE(isRecording(sampleEntries().front()));
    EXPECT_FALSE(isRecording({}));
    EXPECT_FALSE(isRecording(std::as_bytes(std::span{std::string_view("AQREP\1 a repertoire")})));
    EXPECT_THAT(refusalOf(Packet(100)), HasSubstr("is not a recording"));
}

TEST(RecordingFormat, anotherVersionIsNamed) {
    Packet file = joined(sampleEntries());
    const std::byte versionTag{0x10};
    const auto version = std::ranges::find(file, versionTag) + 1;
    ASSERT_EQ(*version, std::byte{kRecordingVersion});
    *version = std::byte{kRecordingVersion + 1};
    EXPECT_THAT(refusalOf(file), HasSubstr("of version 4"));
    EXPECT_THAT(refusalOf(file), HasSubstr("reads version 3"));
}

TEST(RecordingFormat, anotherProtocolOrBuildIsADoubt) {
    Recording recording = decodeRecording(joined(sampleEntries()), "show.aqrec");
    recording.protocol = kProtocolMajor + 1;
    recording.build = "9.9.9";
    EXPECT_THAT(doubtsAbout(recording),
                testing::ElementsAre(HasSubstr("9.9.9"),
                                     HasSubstr("protocol " + std::to_string(kProtocolMajor + 1))));
}

TEST(RecordingFormat, whatCannotBeIsRefusedWithItsPlace) {
    const auto refusal = [](const Packet& entry) {
        std::vector<Packet> entries = sampleEntries();
        entries.insert(entries.end() - 1, entry);
        return refusalOf(joined(entries));
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(refusal(entryOf(RecordedHash{{599}, 0})), HasSubstr("tick"));
    EXPECT_THAT(refusal(entryOf(RecordedHash{{std::uint64_t{1} << 40U}, 0})), HasSubstr("tick"));
    EXPECT_THAT(refusal(entryOf(RecordedInput{{700}, RecordedFood{{nan, 0, 0}, 1}})),
                HasSubstr("from nowhere"));
    EXPECT_THAT(refusal(entryOf(RecordedInput{{700}, RecordedFood{{0, 1e9F, 0}, 1}})),
                HasSubstr("from nowhere"));
    EXPECT_THAT(refusal(entryOf(RecordedInput{{700}, Steering{.tilt = -128}})),
                HasSubstr("beyond full"));
    EXPECT_THAT(refusal(entryOf(RecordedInput{{700}, RecordedFood{{}, 1U << 30U}})),
                HasSubstr("input"));
    for (const RecordedClock& clock : {RecordedClock{1, 600},
                                       RecordedClock{-0.1, 600},
                                       RecordedClock{nan, 600},
                                       RecordedClock{0.5, -1},
                                       RecordedClock{0.5, 2e9},
                                       RecordedClock{0.5, nan}})
        EXPECT_THAT(refusal(entryOf(RecordedInput{{700}, clock})), HasSubstr("clock"));
    for (const RecordedDay& day : {RecordedDay{1, 40},
                                   RecordedDay{-0.1, 40},
                                   RecordedDay{0.5, -1},
                                   RecordedDay{0.5, 1e9},
                                   RecordedDay{0.5, nan}})
        EXPECT_THAT(refusal(entryOf(RecordedInput{{700}, day})), HasSubstr("time of day"));
    EXPECT_THAT(refusal(entryOf(RecordedInput{{700}, RecordedRelease{2}})),
                HasSubstr("releases a species"));
    EXPECT_THAT(refusal(beginningOf(sampleAssets())), HasSubstr("cannot be there"));
    EXPECT_THAT(refusal(entryOf(Tick{700}, {})), HasSubstr("save"));
    EXPECT_THAT(refusal(endOf({{700}, 0})), HasSubstr("behind its end"));
}

TEST(RecordingFormat, moreFishThanAWorldHoldsAreRefused) {
    AssetBundle assets = sampleAssets();
    assets.cast[1].fish = kMostFish - 50;
    EXPECT_THAT(refusalOf(beginningOf(assets)), HasSubstr("damaged species"));
}

// A length that promises more than there is takes no memory.
TEST(RecordingFormat, alteredBytesNeitherCrashNorCostMemory) {
    const Packet whole = joined(sampleEntries());
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (const unsigned bit : {1U, 0x10U, 0x80U, 0xFFU}) {
            Packet altered = whole;
            altered[at] ^= static_cast<std::byte>(bit);
            const std::size_t before = test::bytesTaken;
            static_cast<void>(refusalOf(altered));
            ASSERT_LT(test::bytesTaken - before, 64 * whole.size() + 4096) << at;
        }
    }
}

}  // namespace
}  // namespace aquarama::wire
