// SPDX-License-Identifier: Apache-2.0
// Doors of waiting nodes, over real sockets and multicast DNS of this machine.
#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/base/log.h"
#include "common/enrol/hand_over.h"
#include "common/enrol/node_door.h"
#include "tests/support/await.h"
#include "tests/support/edited_text.h"

namespace aquarama::enrol {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;
using test::comesTrue;

// A door that a thread serves.
class ServedDoor {
  public:
    explicit ServedDoor(const WaitingNode::Keep& keep = [](const config::KeyFile&) {})
        : door_{keep}, thread_{[this] {
              while (!isOver_ && !key_) {
                  key_ = door_.serve(10ms);
                  const std::lock_guard lock(mutex_);
                  sign_ = door_.sign();
              }
          }} {}
    ~ServedDoor() {
        isOver_ = true;
        if (thread_.joinable()) thread_.join();
    }
    ServedDoor(const ServedDoor&) = delete;
    ServedDoor& operator=(const ServedDoor&) = delete;

    [[nodiscard]] NodeSign sign() const {
        const std::lock_guard lock(mutex_);
        return sign_;
    }
    // Once it has one.
    config::KeyFile key() {
        thread_.join();
        return *key_;
    }

  private:
    NodeDoor door_;
    mutable std::mutex mutex_;
    NodeSign sign_;
    std::atomic<bool> isOver_ = false;
    std::optional<config::KeyFile> key_;
    std::thread thread_;
};

FoundNode foundAs(const Discovery& discovery, const std::string& letter) {
    FoundNode found;
    EXPECT_TRUE(comesTrue([&] {
        for (const FoundNode& node : discovery.nodes())
            if (node.letter == letter) found = node;
        return !found.letter.empty();
    }));
    return found;
}

bool isFound(const Discovery& discovery, const std::string& letter) {
    return std::ranges::any_of(discovery.nodes(),
                               [&](const FoundNode& node) { return node.letter == letter; });
}

// A rig of three channels, with keys, in a folder of this test.
class DoorTest : public testing::Test {
  protected:
    DoorTest() {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        std::string text = test::shippedRigText("theatre");
        const std::map<std::string, std::string> ports{
            {"control", "7400"}, {"state", "7401"}, {"watch", "7402"}};
        for (const auto& [field, port] : ports)
            text = test::withField(text, field, test::quoted("tcp://192.168.7.1:" + port));
        std::ofstream(rig_) << text;
        config::KeyFile master =
            freshKey(config::readRig(rig_), rig_, "master", config::KeyRole::Master, "2026-11-29");
        master.masterKey = master.publicKey;
        masterKey_ = master.publicKey;
        config::writeKeyFile(folder_ / "master.key", master);
    }
    ~DoorTest() override { fs::remove_all(folder_); }

    void assign(const FoundNode& node, const std::string& channel, const std::string& code) {
        assignChannel(rig_, folder_, node, channel, code, "2026-11-29");
    }

    fs::path folder_ = fs::temp_directory_path() / ("aquarama-enrol-" + std::to_string(getpid()));
    std::string rig_ = folder_ / "hall.txtpb";
    std::string masterKey_;
};

TEST_F(DoorTest, threeNodesHaveThreeLettersAndAreAssigned) {
    const Discovery discovery;
    std::vector<std::unique_ptr<ServedDoor>> doors;
    for (int i = 0; i < 3; ++i) doors.push_back(std::make_unique<ServedDoor>());
    std::set<std::string> letters;
    for (const auto& door : doors) {
        ASSERT_TRUE(comesTrue([&] { return !door->sign().letter.empty(); }));
        letters.insert(door->sign().letter);
        EXPECT_EQ(door->sign().addresses, ownAddresses());
    }
    EXPECT_EQ(letters.size(), 3U);
    const std::vector<std::string> channels{"left", "middle", "right"};
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const NodeSign sign = doors[i]->sign();
        const FoundNode node = foundAs(discovery, sign.letter);
        assign(node, channels[i], sign.code);
        const config::KeyFile key = doors[i]->key();
        EXPECT_EQ(key.name, channels[i]);
        EXPECT_EQ(key.masterKey, masterKey_);
        EXPECT_EQ(key.masterAddress, "tcp://192.168.7.1:7400");
        const config::KeyFile known = config::readKeyFile(folder_ / (channels[i] + ".key"));
        EXPECT_EQ(known.publicKey, key.publicKey);
        EXPECT_EQ(known.secretKey, "") << "the master's machine could take its place";
        doors[i].reset();
        ASSERT_TRUE(comesTrue([&] { return !isFound(discovery, sign.letter); }));
    }
}

// Of a dozen that begin at one of 26 letters, some begin at the same one.
TEST_F(DoorTest, nodesThatStartTogetherHaveDifferentLetters) {
    constexpr std::size_t kDoors = 12;
    std::vector<std::unique_ptr<ServedDoor>> doors;
    while (doors.size() < kDoors) doors.push_back(std::make_unique<ServedDoor>());
    std::set<std::string> letters;
    for (const auto& door : doors) {
        ASSERT_TRUE(comesTrue([&] { return !door->sign().letter.empty(); }));
        letters.insert(door->sign().letter);
    }
    EXPECT_EQ(letters.size(), kDoors);
}

TEST_F(DoorTest, aWrongCodeAndAWrongNodeGetNothing) {
    const Discovery discovery;
    ServedDoor door;
    ASSERT_TRUE(comesTrue([&] { return !door.sign().letter.empty(); }));
    const FoundNode node = foundAs(discovery, door.sign().letter);
    EXPECT_THROW(assign(node, "left", "0000-0000"), Error);
    EXPECT_THROW(assign(node, "nowhere", door.sign().code), Error);
    // Somebody else announces himself under the letter that the crew sees: he does not know the
    // code, and hears no more than a proof for a key that is not the node's.
    ServedDoor stranger;
    ASSERT_TRUE(comesTrue([&] { return !stranger.sign().letter.empty(); }));
    const FoundNode other = foundAs(discovery, stranger.sign().letter);
    EXPECT_THROW(assign(other, "left", door.sign().code), Error);
    // Somebody who speaks for the node under a key of his own gets no connection.
    EXPECT_THROW(assign({node.letter, node.address, other.publicKey}, "left", door.sign().code),
                 Error);
    EXPECT_FALSE(fs::exists(folder_ / "left.key"));
}

TEST_F(DoorTest, aNodeThatCannotKeepItsKeySaysSo) {
    const Discovery discovery;
    ServedDoor door([](const config::KeyFile&) { throw Error("the disk is full"); });
    ASSERT_TRUE(comesTrue([&] { return !door.sign().letter.empty(); }));
    try {
        assign(foundAs(discovery, door.sign().letter), "left", door.sign().code);
        FAIL() << "the key was taken";
    } catch (const Error& problem) {
        EXPECT_STREQ(problem.what(), "the node refuses: the disk is full");
    }
}

}  // namespace
}  // namespace aquarama::enrol
