// SPDX-License-Identifier: Apache-2.0
// A show of ten seconds with three drops of food, recorded, and what becomes of its replays.
#include <csignal>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "common/base/log.h"
#include "master/simulation/living_world.h"
#include "master/simulation/recorded_world.h"
#include "tests/support/synthetic_assets.h"

namespace aquarama::simulation {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kTicks = 630;
constexpr std::uint32_t kShark = 1;  // its place in the cast of the synthetic assets
constexpr glm::vec3 kTable{0.5F, -5.0F, -4.0F};

class Record : public testing::Test {
  protected:
    Record() { std::filesystem::create_directories(folder_); }
    ~Record() override { std::filesystem::remove_all(folder_); }
    Record(const Record&) = delete;
    Record& operator=(const Record&) = delete;
    [[nodiscard]] std::string path() const { return (folder_ / "show.aqrec").string(); }

    // Returns the hash of the world at every tick.
    std::vector<std::uint64_t> recordAShow() {
        const wire::AssetBundle assets = test::syntheticAssets();
        LivingWorld world(worldOptionsOf(assets));
        RecordingFile file(path(), assets);
        RecordedWorld recorded(world, file);
        std::vector<std::uint64_t> hashes{recorded.hash()};
        while (recorded.tick().value < kTicks) {
            const std::uint64_t tick = recorded.tick().value;
            if (tick == 0 || tick == 100 || tick == 401)
                recorded.apply(world::DropFood{.position = kTable});
            if (tick == 50) recorded.apply(world::SetDay{.timeOfDay = 0.85, .glideSeconds = 5});
            if (tick == 150) recorded.apply(world::ReleaseHunter{kShark});
            if (tick == 200) recorded.apply(world::MoveSubmarine{{0, -6, -1}, {0, 0, -0.1F}});
            recorded.advance();
            hashes.push_back(recorded.hash());
        }
        return hashes;
    }

  private:
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("aquarama-record-" + std::to_string(getpid()));
};

std::optional<Difference> differenceOf(const wire::Recording& recording) {
    LivingWorld world(worldOptionsOf(recording.assets));
    Playback playback(recording, world);
    while (!playback.over()) playback.advance();
    return playback.difference();
}

TEST_F(Record, aReplayIsTheSameWorldTickForTickOnAnyNumberOfThreads) {
    const std::vector<std::uint64_t> hashes = recordAShow();
    const wire::Recording recording = wire::readRecording(path());
    ASSERT_EQ(recording.inputs.size(), 6U);
    EXPECT_EQ(recording.checkpoints.size(), 2U);
    ASSERT_TRUE(recording.end);
    for (const unsigned threads : {1U, 2U, 4U}) {
        world::WorldOptions options = worldOptionsOf(recording.assets);
        options.threads = threads;
        LivingWorld world(options);
        Playback playback(recording, world);
        while (!playback.over()) {
            playback.advance();
            ASSERT_EQ(world.hash(), hashes[world.tick().value]) << world.tick().value;
        }
        EXPECT_EQ(world.tick().value, kTicks);
        EXPECT_EQ(playback.inputs(), 6U);
        EXPECT_EQ(playback.compared(), 3U);
        EXPECT_FALSE(playback.difference());
    }
}

// The hall's clock is set as the show begins and later: its day is part of the recording.
TEST_F(Record, aShowThatFollowsTheHallReplaysToTheSameHash) {
    wire::AssetBundle assets = test::syntheticAssets();
    assets.scene += "day { follows: HALL night: 0.5 }\n";
    std::uint64_t shown = 0;
    double evening = 0;
    {
        LivingWorld world(worldOptionsOf(assets));
        ASSERT_TRUE(world.followsHall());
        RecordingFile file(path(), assets);
        RecordedWorld recorded(world, file);
        while (recorded.tick().value < kTicks) {
            const std::uint64_t tick = recorded.tick().value;
            if (tick == 0) recorded.apply(world::SetClock{0.84, 600});
            if (tick == 300) recorded.apply(world::SetClock{0.9, 7200});
            recorded.advance();
        }
        shown = recorded.hash();
        evening = world.world().surroundings().timeOfDay;
    }
    EXPECT_NEAR(evening, 0.9 + (kTicks - 1 - 300) / 60.0 / 7200, 1e-9);
    const wire::Recording recording = wire::readRecording(path());
    ASSERT_EQ(recording.inputs.size(), 2U);
    LivingWorld again(worldOptionsOf(recording.assets));
    Playback playback(recording, again);
    while (!playback.over()) playback.advance();
    EXPECT_FALSE(playback.difference());
    EXPECT_EQ(again.hash(), shown);
    for (std::size_t left = 0; left < recording.inputs.size(); ++left) {
        wire::Recording without = recording;
        without.inputs.erase(without.inputs.begin() + static_cast<std::ptrdiff_t>(left));
        EXPECT_TRUE(differenceOf(without)) << left;
    }
}

// A clock that nobody asked for changes nothing.
TEST_F(Record, aSceneWithADayOfItsOwnHasNoHallsClock) {
    const wire::AssetBundle assets = test::syntheticAssets();
    LivingWorld world(worldOptionsOf(assets)), other(worldOptionsOf(assets));
    world.apply(world::SetClock{0.9, 60});
    for (int tick = 0; tick < 60; ++tick) world.advance(), other.advance();
    EXPECT_FALSE(world.followsHall());
    EXPECT_EQ(world.hash(), other.hash());
}

// Else the test above would prove little.
TEST_F(Record, theInputsMatter) {
    const std::vector<std::uint64_t> hashes = recordAShow();
    wire::Recording recording = wire::readRecording(path());
    for (std::size_t left = 0; left < recording.inputs.size(); ++left) {
        wire::Recording without = recording;
        without.inputs.erase(without.inputs.begin() + static_cast<std::ptrdiff_t>(left));
        EXPECT_TRUE(differenceOf(without)) << left;
    }
}

TEST_F(Record, anotherSeedSceneSpeciesOrCheckpointGivesADifference) {
    recordAShow();
    const wire::Recording recording = wire::readRecording(path());
    const auto firstDifference = [&](auto alter) {
        wire::Recording altered = recording;
        alter(altered);
        const auto difference = differenceOf(altered);
        return difference ? std::optional{difference->tick.value} : std::nullopt;
    };
    EXPECT_EQ(firstDifference([](wire::Recording&) {}), std::nullopt);
    EXPECT_EQ(firstDifference([](wire::Recording& r) { ++r.assets.seed; }), 0U);
    EXPECT_EQ(firstDifference([](wire::Recording& r) {
                  r.assets.scene.replace(r.assets.scene.find("200"), 3, "201");
              }),
              0U);
    EXPECT_EQ(firstDifference([](wire::Recording& r) { --r.assets.cast[0].fish; }), 0U);
    EXPECT_EQ(firstDifference([](wire::Recording& r) { r.checkpoints[1].hash ^= 1U; }), 600U);
    EXPECT_EQ(firstDifference([](wire::Recording& r) { r.end->hash ^= 1U; }), kTicks);
    EXPECT_EQ(firstDifference([](wire::Recording& r) { ++r.inputs[1].tick.value; }), 600U);
}

TEST_F(Record, aDamagedRepertoireOrSpeciesIsNamed) {
    recordAShow();
    const auto refusalOf = [](const wire::Recording& recording) -> std::string {
        try {
            static_cast<void>(worldOptionsOf(recording.assets));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    wire::Recording recording = wire::readRecording(path());
    recording.assets.cast[0].repertoire[5000] ^= std::byte{1};
    EXPECT_THAT(refusalOf(recording), HasSubstr("show.aqrec: its bigeye_scad.txtpb"));
    recording = wire::readRecording(path());
    recording.assets.cast[1].text += "\nfins_of_gold: 3\n";
    EXPECT_THAT(refusalOf(recording), HasSubstr("show.aqrec: its blacktip_reef_shark.txtpb:"));
    recording = wire::readRecording(path());
    recording.assets.cast.pop_back();
    EXPECT_THAT(refusalOf(recording), HasSubstr("show.aqrec: its scene"));
}

// Of three minutes, with food now and then: any tick is reached from the save before it, and only
// the ticks since then are computed.
TEST_F(Record, aReplayBeginsAtTheSaveBeforeATimeAndIsTheSameWorld) {
    constexpr std::uint64_t kLong = 2 * kTicksBetweenSaves + 700;
    const wire::AssetBundle assets = test::syntheticAssets();
    std::vector<std::uint64_t> hashes;
    {
        LivingWorld world(worldOptionsOf(assets));
        RecordingFile file(path(), assets);
        RecordedWorld recorded(world, file);
        while (recorded.tick().value < kLong) {
            hashes.push_back(recorded.hash());
            if (recorded.tick().value % 500 == 0)
                recorded.apply(world::DropFood{.position = kTable});
            recorded.advance();
        }
        ASSERT_TRUE(file.flush());
    }
    const wire::Recording recording = wire::readRecording(path());
    ASSERT_EQ(recording.saves.size(), 2U);
    for (const std::uint64_t tick : {5U, 3599U, 3600U, 3601U, 7100U, 7201U}) {
        LivingWorld world(worldOptionsOf(recording.assets));
        Playback playback(recording, world);
        playback.goTo({tick});
        EXPECT_EQ(world.tick().value, tick);
        EXPECT_EQ(world.hash(), hashes[tick]) << tick;
        // That of tick 0, that of the save, and one each ten seconds since.
        const std::uint64_t first = tick < kTicksBetweenSaves ? 1 : 2;
        EXPECT_EQ(playback.compared(), first + tick % kTicksBetweenSaves / kTicksBetweenCheckpoints)
            << tick;
        while (!playback.over()) playback.advance();
        EXPECT_FALSE(playback.difference()) << tick;
    }
}

// Killed in the middle: what had happened by then is there.
TEST_F(Record, aFileThatWasCutShortReplaysUpToThere) {
    recordAShow();
    std::filesystem::resize_file(path(), std::filesystem::file_size(path()) - 5);
    const wire::Recording recording = wire::readRecording(path());
    EXPECT_FALSE(recording.end);
    EXPECT_EQ(recording.lastTick().value, 600U);
    EXPECT_GT(recording.bytesLeftOver, 0U);
    EXPECT_FALSE(differenceOf(recording));
}

TEST_F(Record, neverOverwritesAFileAndSaysWhereItCannotWrite) {
    std::ofstream(path()) << "dear diary";
    EXPECT_THROW(RecordingFile(path(), test::syntheticAssets()), Error);
    EXPECT_EQ(config::readTextFile(path()), "dear diary");
    try {
        const RecordingFile nowhere("/proc/nowhere/show.aqrec", test::syntheticAssets());
        FAIL() << "it was opened";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("/proc/nowhere/show.aqrec: cannot be written (No such"));
    }
}

// A limit of the file's size stands for a full disk.
TEST_F(Record, theShowGoesOnWhenTheDiskIsFull) {
    const wire::AssetBundle assets = test::syntheticAssets();
    LivingWorld world(worldOptionsOf(assets));
    RecordingFile file(path(), assets);
    RecordedWorld recorded(world, file);
    ASSERT_TRUE(file.flush());

    // NOLINTNEXTLINE(cert-err33-c): it was at its default
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit full{.rlim_cur = std::filesystem::file_size(path()), .rlim_max = before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
    recorded.apply(world::DropFood{.position = kTable});
    recorded.advance();
    EXPECT_FALSE(file.flush());
    setrlimit(RLIMIT_FSIZE, &before);

    recorded.advance();
    EXPECT_EQ(recorded.tick(), Tick{2});
    EXPECT_EQ(wire::readRecording(path()).checkpoints.size(), 1U);
    EXPECT_THROW(file.close(), Error) << "the program has not done what it was asked for";
}

TEST_F(Record, visitorsDoNotReachAReplayAndItEndsOnce) {
    const std::vector<std::uint64_t> hashes = recordAShow();
    const wire::Recording recording = wire::readRecording(path());
    LivingWorld world(worldOptionsOf(recording.assets));
    int ends = 0;
    ReplayedWorld replayed(recording, world, Tick{}, [&] { ++ends; });
    while (replayed.tick().value < kTicks) {
        EXPECT_EQ(ends, 0);
        replayed.apply(world::DropFood{.position = kTable});
        replayed.advance();
    }
    EXPECT_EQ(replayed.hash(), hashes.back());
    replayed.advance();
    EXPECT_EQ(ends, 1);
}

}  // namespace
}  // namespace aquarama::simulation
