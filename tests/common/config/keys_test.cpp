// SPDX-License-Identifier: Apache-2.0
#include "common/config/keys.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"

namespace aquarama::config {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKey = "rq:rM>}U?@Lns47E1%kR.o@n%FcmmsL/@{H8]yf7";

class Keys : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    [[nodiscard]] static KeyFile key(const std::string& name) {
        return {.rig = "hall",
                .masterAddress = "tcp://192.168.7.1:7400",
                .masterKey = kKey,
                .name = name,
                .role = KeyRole::Node,
                .publicKey = kKey,
                .secretKey = kKey,
                .made = "2026-11-23",
                .revoked = {}};
    }
    [[nodiscard]] static std::string refusalOf(const fs::path& path) {
        try {
            static_cast<void>(readKeyFile(path));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    const fs::path folder_ = fs::path(testing::TempDir()) /
                             testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(Keys, everyFieldComesBackFromAFileThatItsOwnerAloneMayRead) {
    KeyFile written = key("left");
    written.role = KeyRole::Operator;
    written.revoked = "2026-12-01";
    written.depotAddress = "tcp://192.168.7.1:7403";
    const fs::path path = keyFileIn(folder_, "left");
    writeKeyFile(path, written);
    writeKeyFile(path, written);  // over the first
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    const KeyFile read = readKeyFile(path);
    EXPECT_EQ(read.rig, written.rig);
    EXPECT_EQ(read.masterAddress, written.masterAddress);
    EXPECT_EQ(read.masterKey, written.masterKey);
    EXPECT_EQ(read.name, written.name);
    EXPECT_EQ(read.role, written.role);
    EXPECT_EQ(read.publicKey, written.publicKey);
    EXPECT_EQ(read.secretKey, written.secretKey);
    EXPECT_EQ(read.made, written.made);
    EXPECT_EQ(read.revoked, written.revoked);
    EXPECT_EQ(read.depotAddress, written.depotAddress);
}

TEST_F(Keys, aChannelWhoseNodeAloneHasTheSecretIsKnownButNobodysOwn) {
    KeyFile known = key("left");
    known.secretKey.clear();
    const fs::path path = keyFileIn(folder_, "left");
    writeKeyFile(path, known);
    EXPECT_EQ(readKeyFile(path).publicKey, known.publicKey);
    EXPECT_THAT([&] { static_cast<void>(readOwnKey(path)); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("another machine was given")));
    known.role = KeyRole::Operator;  // of nobody else a secret is missing
    writeKeyFile(path, known);
    EXPECT_THAT(refusalOf(path), testing::HasSubstr("secret_key"));
}

TEST_F(Keys, aFolderIsReadByNameAndNothingElseInIt) {
    writeKeyFile(keyFileIn(folder_, "right"), key("right"));
    writeKeyFile(keyFileIn(folder_, "left"), key("left"));
    std::ofstream(folder_ / "notes.txt") << "not a key";
    const std::vector<KeyFile> keys = readKeyFolder(folder_);
    ASSERT_EQ(keys.size(), 2U);
    EXPECT_EQ(keys[0].name, "left");
    EXPECT_EQ(keys[1].name, "right");
    EXPECT_TRUE(readKeyFolder(folder_ / "none").empty());
}

TEST_F(Keys, aFileThatOthersMayReadIsRefusedWithTheRemedy) {
    const fs::path path = keyFileIn(folder_, "left");
    writeKeyFile(path, key("left"));
    fs::permissions(path, fs::perms::group_read, fs::perm_options::add);
    EXPECT_THAT(refusalOf(path), testing::HasSubstr("chmod 600"));
}

TEST_F(Keys, aDamagedKeyIsNamedWithItsPlace) {
    const fs::path path = keyFileIn(folder_, "left");
    KeyFile damaged = key("left");
    damaged.secretKey.pop_back();
    writeKeyFile(path, damaged);
    EXPECT_THAT(refusalOf(path), testing::HasSubstr("left.key:9:"));
    EXPECT_THAT(refusalOf(path), testing::HasSubstr("secret_key is no key"));
    EXPECT_THAT(refusalOf(folder_ / "none.key"), testing::HasSubstr("none.key"));
}

}  // namespace
}  // namespace aquarama::config
