// SPDX-License-Identifier: Apache-2.0
// A world that is journalled, the ends that a master can come to, and how its world goes on.
#include "master/journal/journal.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <thread>

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "master/journal/journalled_world.h"
#include "tests/support/synthetic_assets.h"

namespace {

// A disk that stands still: fsync() does not return while this is set.
std::atomic<bool> diskStandsStill = false;

}  // namespace

// In place of the C library's.
extern "C" int fsync(int file) {
    while (diskStandsStill) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    static const auto real = reinterpret_cast<int (*)(int)>(dlsym(RTLD_NEXT, "fsync"));
    return real(file);
}

namespace aquarama::journal {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

simulation::Assets assetsOf(std::uint32_t seed = 1) {
    simulation::Assets assets;
    assets.bytes = test::syntheticAssets(seed);
    assets.scene = config::parseScene(assets.bytes.scene, "scene");
    for (const wire::SpeciesAssets& species : assets.bytes.cast) {
        assets.scene.cast[assets.species.size()].fish = species.fish;
        assets.species.push_back(config::parseSpecies(species.text, species.file));
    }
    for (wire::SpeciesAssets& species : assets.bytes.cast)
        species.repertoireDigest = digestOf(species.repertoire);
    return assets;
}

class JournalTest : public testing::Test {
  protected:
    JournalTest() { fs::create_directories(folder_); }
    ~JournalTest() override {
        diskStandsStill = false;
        fs::remove_all(folder_);
    }
    JournalTest(const JournalTest&) = delete;
    JournalTest& operator=(const JournalTest&) = delete;

    [[nodiscard]] fs::path journal() const { return folder_ / "show.journal"; }
    // The folder as it is now, where a killed master would have left it.
    [[nodiscard]] fs::path copied() const {
        const fs::path copy = folder_ / "copy.journal";
        fs::remove_all(copy);
        fs::copy(journal(), copy, fs::copy_options::recursive);
        return copy;
    }
    // A new process goes on there; the clock is left out.
    [[nodiscard]] std::unique_ptr<JournalledWorld> wentOn(const fs::path& folder) const {
        return makeJournalled(folder, assets_, TimeAway::LeftOut);
    }

    simulation::Assets assets_ = assetsOf();

  private:
    fs::path folder_ = fs::temp_directory_path() / ("aquarama-journal-" + std::to_string(getpid()));
};

// What visitors do, by the tick at which it comes.
void visitAt(JournalledWorld& world) {
    const std::uint64_t tick = world.tick().value;
    if (tick % 37 == 5)
        world.apply(world::DropFood{.position = {0.01F * static_cast<float>(tick % 100), -5, -4}});
    if (tick % 53 == 7) world.apply(Steering{.ahead = static_cast<std::int8_t>(tick % 100)});
    if (tick % 211 == 0) world.apply(world::MoveSubmarine{{0, -6, -1}, {0, 0, -0.1F}});
}

// At 200 drawn ticks of a minute; with AQUARAMA_SOAK in the environment at each.
TEST_F(JournalTest, aMasterThatIsKilledAtAnyTickGoesOnAsIfItHadNot) {
    constexpr std::uint64_t kMinute = 3600;
    // Not before the first: then inputs take effect at once.
    constexpr std::uint64_t kTicks = kMinute - 1;
    const std::size_t count = std::getenv("AQUARAMA_SOAK") != nullptr ? kTicks : 200;
    std::mt19937 random(20261127);
    std::set<std::uint64_t> kills;
    while (kills.size() < count) kills.insert(1 + random() % kTicks);
    auto world = makeJournalled(journal(), assets_, TimeAway::LeftOut);
    simulation::LivingWorld again(simulation::worldOptionsOf(assets_));
    while (world->tick().value < kMinute) {
        visitAt(*world);
        if (kills.contains(world->tick().value)) {
            // All that the file system has: what a kill leaves.
            ASSERT_TRUE(world->journal().flush());
            const auto last = lastWorldIn(copied(), assets_.bytes);
            ASSERT_TRUE(last);
            const auto ahead = goOn(again, *last, TimeAway::LeftOut);
            ASSERT_TRUE(ahead);
            ASSERT_LE(again.tick(), world->tick());
            auto next = ahead->begin();
            while (again.tick() < world->tick()) {
                for (; next != ahead->end() && next->tick <= again.tick(); ++next)
                    again.apply(simulation::inputOf(*next));
                again.advance();
            }
            ASSERT_EQ(again.hash(), world->hash()) << world->tick().value;
        }
        world->advance();
    }
}

// What had come, but had not taken effect, still does: at its tick.
TEST_F(JournalTest, anInputThatCameJustBeforeTheEndIsNotLost) {
    auto world = makeJournalled(journal(), assets_, TimeAway::LeftOut);
    for (int i = 0; i < 100; ++i) world->advance();
    world->apply(world::DropFood{.position = {0, -5, -4}});
    ASSERT_TRUE(world->journal().flush());
    auto again = wentOn(copied());
    while (world->tick().value < 110) world->advance();
    while (again->tick().value < 110) again->advance();
    EXPECT_EQ(again->hash(), world->hash());
    EXPECT_GT(again->living().world().surroundings().food.pellets, 0U);
}

TEST_F(JournalTest, aRecordingOfTheJournalPlaysAlsoFromWhereAWorldWentOn) {
    {
        auto world = makeJournalled(journal(), assets_, TimeAway::LeftOut);
        while (world->tick().value < 700) visitAt(*world), world->advance();
    }
    std::map<Tick, std::uint64_t> hashes;
    {
        auto world = wentOn(journal());
        EXPECT_GT(world->tick().value, 0U);
        const v1::JournalStatus status = world->journal().report()->status(net::monotonicNow());
        EXPECT_EQ(status.went_on_tick(), world->tick().value);
        EXPECT_LT(status.away_s(), 60);
        while (world->tick().value < 1300) {
            visitAt(*world);
            world->advance();
            hashes[world->tick()] = world->hash();
        }
    }
    std::vector<fs::path> recordings;
    for (const auto& entry : fs::directory_iterator(journal()))
        if (entry.path().extension() == ".aqrec") recordings.push_back(entry.path());
    ASSERT_EQ(recordings.size(), 2U);
    std::ranges::sort(recordings);
    for (const fs::path& path : recordings) {
        wire::Recording recording = wire::readRecording(path.string());
        EXPECT_TRUE(recording.beginsWithSave);
        // The repertoires of this test are not captured.
        for (std::size_t i = 0; i < recording.assets.cast.size(); ++i)
            recording.assets.cast[i].repertoire = assets_.bytes.cast[i].repertoire;
        simulation::LivingWorld world(simulation::worldOptionsOf(recording.assets));
        simulation::Playback playback(recording, world);
        playback.goTo({1300});
        EXPECT_FALSE(playback.difference());
        EXPECT_GE(playback.compared(), 1U);
        if (path == recordings.back()) {
            EXPECT_GT(world.tick().value, 1250U);
            EXPECT_EQ(world.hash(), hashes.at(world.tick()));
        }
    }
}

TEST_F(JournalTest, otherAssetsBeginAnewAndTheFirstWorldStillGoesOn) {
    {
        auto world = makeJournalled(journal(), assets_, TimeAway::LeftOut);
        for (int i = 0; i < 400; ++i) world->advance();
    }
    EXPECT_EQ(makeJournalled(journal(), assetsOf(2), TimeAway::LeftOut)->tick(), Tick{});
    EXPECT_GE(wentOn(journal())->tick().value, 300U);
}

// Removed first: a file system that is asked to cut a file to nothing waits for its disk.
void write(const fs::path& file, const std::vector<std::byte>& bytes) {
    fs::remove(file);
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
}

// Ten thousand cuts and altered bits of recording and saves: what is before goes on, or an earlier
// save does, and at worst a new world begins.
TEST_F(JournalTest, aJournalThatIsCutOrDamagedAnywhereIsReadUpToThere) {
    {
        auto world = makeJournalled(journal(), assets_, TimeAway::LeftOut);
        while (world->tick().value < 700) {
            visitAt(*world), world->advance();
            // These ticks are faster than a hall's: a slow disk would leave saves out.
            if (world->tick().value % kTicksBetweenSaves == 1) {
                ASSERT_TRUE(world->journal().flush());
            }
        }
    }
    setLogListener({});
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(journal()))
        if (entry.path().extension() == ".aqrec" || entry.path().extension() == ".aqsav")
            files.push_back(entry.path());
    ASSERT_GE(files.size(), 4U);
    std::map<fs::path, std::vector<std::byte>> whole;
    for (const fs::path& file : files) whole[file] = readWhole(file, wire::kMostSavedBytes);
    std::mt19937 random(7);
    simulation::LivingWorld world(simulation::worldOptionsOf(assets_));
    int goneOn = 0;
    for (int i = 0; i < 10'000; ++i) {
        const fs::path& file = files[random() % files.size()];
        std::vector<std::byte> bytes = whole[file];
        const std::size_t at = random() % bytes.size();
        if (random() % 2 == 0)
            bytes.resize(at);
        else
            bytes[at] ^= std::byte{1} << random() % 8;
        write(file, bytes);
        const auto last = lastWorldIn(journal(), assets_.bytes);
        if (last && i % 100 == 0) goneOn += goOn(world, *last, TimeAway::LeftOut) ? 1 : 0;
        write(file, whole[file]);
    }
    EXPECT_GT(goneOn, 50);
}

TEST_F(JournalTest, aDiskThatStandsStillDelaysNoTickAndInputsTakeEffectAllTheSame) {
    auto world = makeJournalled(journal(), assets_, TimeAway::LeftOut);
    for (int i = 0; i < 10; ++i) world->advance();
    ASSERT_TRUE(world->journal().flush());
    std::string told;
    setLogListener([&](Severity, const std::string& line) { told += line + '\n'; });
    diskStandsStill = true;
    world->apply(world::DropFood{.position = {0, -5, -4}});
    for (int i = 0; i < 10; ++i) world->advance();
    EXPECT_GT(world->living().world().surroundings().food.pellets, 0U);
    EXPECT_THAT(told, HasSubstr("before the journal's disk had it"));
    const auto statusSoon = [&] {
        return world->journal().report()->status(net::monotonicNow() + std::chrono::seconds(4));
    };
    while (statusSoon().condition() != v1::JournalStatus::WAITING) std::this_thread::yield();
    const v1::JournalStatus status = statusSoon();
    EXPECT_EQ(status.late_inputs(), 1U);
    EXPECT_EQ(status.late_spells(), 1U);
    diskStandsStill = false;
    setLogListener({});
    while (world->tick().value < 60) world->advance();
    EXPECT_TRUE(world->journal().flush());
    EXPECT_EQ(statusSoon().condition(), v1::JournalStatus::WRITTEN);
    const auto last = lastWorldIn(journal(), assets_.bytes);
    ASSERT_TRUE(last && last->recording.moment);
    EXPECT_EQ(last->recording.moment->lateInputs, 1U) << "it is marked";
}

// A limit of the files' size stands for a full disk.
TEST_F(JournalTest, aFullDiskPausesTheJournalAndRoomMakesItGoOn) {
    auto world = makeJournalled(journal(), assets_, TimeAway::LeftOut);
    ASSERT_TRUE(world->journal().flush());
    // NOLINTNEXTLINE(cert-err33-c): it was at its default
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit full{.rlim_cur = 1000, .rlim_max = before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
    world->apply(world::DropFood{.position = {0, -5, -4}});
    for (int i = 0; i < 400; ++i) world->advance();
    EXPECT_FALSE(world->journal().flush());
    const v1::JournalStatus paused = world->journal().report()->status(net::monotonicNow());
    EXPECT_EQ(paused.condition(), v1::JournalStatus::PAUSED);
    EXPECT_THAT(paused.reason(), testing::StartsWith("it cannot be written"));
    setrlimit(RLIMIT_FSIZE, &before);
    while (world->tick().value < kSavesBetweenRecorded * kTicksBetweenSaves + 10) world->advance();
    EXPECT_TRUE(world->journal().flush());
    const v1::JournalStatus status = world->journal().report()->status(net::monotonicNow());
    EXPECT_EQ(status.condition(), v1::JournalStatus::WRITTEN);
    EXPECT_EQ(status.pauses(), 1U);
    EXPECT_LT(status.save_age_s(), 60);
    EXPECT_EQ(status.folder_bytes(), bytesIn(journal()));
    EXPECT_EQ(status.file_bytes(), fs::file_size(recordingsIn(journal()).back()));
    EXPECT_GT(status.free_disk_bytes(), 0U);
    const std::uint64_t hash = world->hash();
    auto again = wentOn(copied());
    while (again->tick() < world->tick()) again->advance();
    EXPECT_EQ(again->hash(), hash);
}

TEST_F(JournalTest, aWorldThatNeverLivesForFiveSecondsIsGivenUp) {
    {
        auto world = makeJournalled(journal(), assets_, TimeAway::LeftOut);
        for (int i = 0; i < 700; ++i) world->advance();
    }
    for (int attempt = 0; attempt < 3; ++attempt)
        EXPECT_GE(wentOn(journal())->tick().value, 600U) << attempt;
    EXPECT_EQ(wentOn(journal())->tick(), Tick{});
}

TEST_F(JournalTest, oneProcessWritesAtATime) {
    const FolderLock lock(journal());
    EXPECT_THROW(FolderLock{journal()}, Error);
}

}  // namespace
}  // namespace aquarama::journal
