// SPDX-License-Identifier: Apache-2.0
#include "common/base/derived_cache.h"

#include <atomic>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama {
namespace {

namespace fs = std::filesystem;
using Bytes = DerivedCache::Bytes;

class DerivedData : public testing::Test {
  protected:
    ~DerivedData() override { fs::remove_all(folder_); }

    // What the cache holds or makes; counts how often it is made.
    Bytes find(const DerivedKey& key, const Bytes& content) {
        return DerivedCache(folder_).find(key, [&] {
            ++made_;
            return content;
        });
    }
    [[nodiscard]] fs::path fileOf(const DerivedKey& key) const {
        return folder_ / (key.fileName() + ".data");
    }

    fs::path folder_ =
        fs::path(testing::TempDir()) / ("aquarama-derived-" + std::to_string(getpid()));
    Bytes bytes_ = Bytes(5000, std::byte{7});
    std::atomic<int> made_ = 0;
};

TEST_F(DerivedData, isMadeOnce) {
    const DerivedKey key("reef");
    EXPECT_EQ(find(key, bytes_), bytes_);
    EXPECT_EQ(find(key, bytes_), bytes_);
    EXPECT_EQ(made_, 1);
}

TEST_F(DerivedData, ofOtherInputsIsAnother) {
    static_cast<void>(find(DerivedKey("reef").add(1U), bytes_));
    static_cast<void>(find(DerivedKey("reef").add(2U), bytes_));
    static_cast<void>(find(DerivedKey("sand").add(1U), bytes_));
    static_cast<void>(find(DerivedKey("reef").add("ab").add("c"), bytes_));
    static_cast<void>(find(DerivedKey("reef").add("a").add("bc"), bytes_));
    EXPECT_EQ(made_, 5);
}

TEST_F(DerivedData, keyDependsOnTheSources) {
    EXPECT_EQ(sourceDigest().size(), 64U);
    EXPECT_NE(DerivedKey("reef").digest(), digestOf(""));
}

TEST_F(DerivedData, thatIsDamagedIsMadeAnew) {
    const DerivedKey key("reef");
    static_cast<void>(find(key, bytes_));
    std::fstream(fileOf(key), std::ios::in | std::ios::out | std::ios::binary).seekp(777).put('!');
    EXPECT_EQ(find(key, bytes_), bytes_);
    EXPECT_EQ(made_, 2);
    for (const std::uintmax_t size : {100U, 20U, 0U}) {
        fs::resize_file(fileOf(key), size);
        EXPECT_EQ(find(key, bytes_), bytes_);
    }
    EXPECT_EQ(made_, 5);
    EXPECT_EQ(find(key, bytes_), bytes_);
    EXPECT_EQ(made_, 5);
}

TEST_F(DerivedData, underAnothersNameIsMadeAnew) {
    const DerivedKey one = DerivedKey("reef").add(1U);
    const DerivedKey other = DerivedKey("reef").add(2U);
    static_cast<void>(find(one, bytes_));
    fs::copy_file(fileOf(one), fileOf(other));
    static_cast<void>(find(other, bytes_));
    EXPECT_EQ(made_, 2);
}

TEST_F(DerivedData, isMadeByOneOfManyThreads) {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([this] {
            const Bytes found = DerivedCache(folder_).find(DerivedKey("reef"), [this] {
                ++made_;
                std::this_thread::sleep_for(std::chrono::milliseconds(100));
                return bytes_;
            });
            EXPECT_EQ(found, bytes_);
        });
    threads.clear();
    EXPECT_EQ(made_, 1);
}

TEST_F(DerivedData, isMadeAgainAfterItsMakerFailed) {
    EXPECT_THROW(static_cast<void>(DerivedCache(folder_).find(
                     DerivedKey("reef"), []() -> Bytes { throw Error("no memory"); })),
                 Error);
    EXPECT_EQ(find(DerivedKey("reef"), bytes_), bytes_);
    EXPECT_EQ(made_, 1);
}

// A process that dies while it makes data leaves its lock to the next.
TEST_F(DerivedData, isMadeAfterItsMakerWasKilled) {
    const pid_t child = fork();
    if (child == 0) {
        static_cast<void>(
            DerivedCache(folder_).find(DerivedKey("reef"), []() -> Bytes { _exit(9); }));
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(find(DerivedKey("reef"), bytes_), bytes_);
    EXPECT_EQ(made_, 1);
}

TEST_F(DerivedData, thatCannotBeKeptIsUsedAllTheSame) {
    std::ofstream(folder_) << "a file where the folder should be";
    EXPECT_EQ(find(DerivedKey("reef"), bytes_), bytes_);
    EXPECT_EQ(find(DerivedKey("reef"), bytes_), bytes_);
    EXPECT_EQ(made_, 2);
}

TEST_F(DerivedData, thatWasNotUsedForLongestMakesRoom) {
    const DerivedCache small(folder_, 12000);
    const auto keep = [&](unsigned input) {
        static_cast<void>(small.find(DerivedKey("reef").add(input), [&] { return bytes_; }));
    };
    keep(1);
    keep(2);
    const auto hourAgo = fs::file_time_type::clock::now() - std::chrono::hours(1);
    fs::last_write_time(fileOf(DerivedKey("reef").add(2U)), hourAgo);
    keep(1);  // is used again
    keep(3);
    EXPECT_TRUE(fs::exists(fileOf(DerivedKey("reef").add(1U))));
    EXPECT_FALSE(fs::exists(fileOf(DerivedKey("reef").add(2U))));
    EXPECT_TRUE(fs::exists(fileOf(DerivedKey("reef").add(3U))));
}

TEST(Arrays, areReadAsTheyWereWritten) {
    const std::vector<float> floats{1.5F, -2.0F};
    const std::vector<std::uint16_t> none;
    const std::vector<std::uint64_t> longs{1U << 30U};
    const Bytes bytes = ArrayWriter().add(floats).add(none).add(longs).take();
    ArrayReader reader(bytes);
    EXPECT_EQ(reader.next<float>(), floats);
    EXPECT_EQ(reader.next<std::uint16_t>(), none);
    EXPECT_EQ(reader.next<std::uint64_t>(), longs);
    EXPECT_THROW(static_cast<void>(reader.next<float>()), Error);
}

TEST(Arrays, thatAnnounceMoreThanThereIsAreRefused) {
    Bytes bytes = ArrayWriter().add(std::vector<float>{1, 2, 3}).take();
    bytes[7] = std::byte{0xFF};
    EXPECT_THROW(static_cast<void>(ArrayReader(bytes).next<float>()), Error);
    bytes[7] = std::byte{0};
    bytes.resize(bytes.size() - 1);
    EXPECT_THROW(static_cast<void>(ArrayReader(bytes).next<float>()), Error);
}

}  // namespace
}  // namespace aquarama
