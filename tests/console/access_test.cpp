// SPDX-License-Identifier: Apache-2.0
#include "console/access.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/base/typed_code.h"

namespace aquarama::console {
namespace {

namespace fs = std::filesystem;

class AccessTest : public testing::Test {
  protected:
    AccessTest() {
        folder_ = fs::temp_directory_path() / ("aquarama-access-" + std::to_string(getpid()));
        fs::remove_all(folder_);
    }
    ~AccessTest() override { fs::remove_all(folder_); }

    std::optional<std::string> pair(Access& access,
                                    const std::string& code,
                                    UnixSeconds now,
                                    const std::string& client = "192.0.2.1") {
        return access.pair(code, {.name = "Anna", .client = client}, now, spent_);
    }
    std::string everythingKept() const {
        std::string all;
        for (const auto& entry : fs::directory_iterator(folder_)) {
            std::ifstream file(entry.path());
            all += std::string(std::istreambuf_iterator<char>(file), {});
        }
        return all;
    }

    fs::path folder_;
    bool spent_ = false;
};

TEST_F(AccessTest, aCodeLetsOneBrowserInOnceAndItsSessionOutlivesTheProgram) {
    std::string secret;
    {
        Access access(folder_);
        const std::string code = access.makeCode(ConsoleRole::Operator, 1000);
        EXPECT_FALSE(access.hasPeople());
        secret = pair(access, code, 1001).value();
        EXPECT_FALSE(pair(access, code, 1002));
        EXPECT_EQ(everythingKept().find(secret), std::string::npos);
        EXPECT_EQ(everythingKept().find(plainCode(code)), std::string::npos);
    }
    const Access later(folder_);
    ASSERT_TRUE(later.session(secret, 2000));
    EXPECT_EQ(later.session(secret, 2000)->role, ConsoleRole::Operator);
    EXPECT_EQ(later.session(secret, 2000)->name, "Anna");
    EXPECT_FALSE(later.session(secret, 1000 + 31 * 86400));
    EXPECT_FALSE(later.session(secret.substr(1) + "0", 2000));
    EXPECT_FALSE(later.session("", 2000));
}

TEST_F(AccessTest, aCodeIsReadAsPeopleTypeIt) {
    Access access(folder_);
    std::string code = access.makeCode(ConsoleRole::Watcher, 0);
    for (char& c : code) c = static_cast<char>(std::tolower(c));
    EXPECT_TRUE(pair(access, code, 1));
}

TEST_F(AccessTest, aCodeEndsAfterTenMinutesAndAfterFiveWrongTries) {
    Access access(folder_);
    EXPECT_FALSE(pair(access, access.makeCode(ConsoleRole::Crew, 0), 601));
    const std::string code = access.makeCode(ConsoleRole::Crew, 1000);
    for (int i = 0; i < 4; ++i) EXPECT_FALSE(pair(access, "00000000", 1001));
    EXPECT_FALSE(spent_);
    EXPECT_FALSE(pair(access, "00000000", 1001));
    EXPECT_TRUE(spent_);
    EXPECT_FALSE(pair(access, code, 1002));
    // Another code is refused for a while, which grows.
    const std::string next = access.makeCode(ConsoleRole::Crew, 1003);
    EXPECT_FALSE(pair(access, next, 1010));
    EXPECT_TRUE(pair(access, next, 1032));
}

TEST_F(AccessTest, whoIsRevokedIsOutAndATokenKnowsItsRole) {
    Access access(folder_);
    const std::string secret = pair(access, access.makeCode(ConsoleRole::Crew, 0), 1).value();
    access.revoke(access.people().at(0).id);
    EXPECT_FALSE(access.session(secret, 2));
    const std::string token = access.makeToken("companion", ConsoleRole::Operator, 3);
    EXPECT_EQ(access.token(token)->role, ConsoleRole::Operator);
    EXPECT_EQ(everythingKept().find(token), std::string::npos);
    EXPECT_NE(access.makeToken("companion", ConsoleRole::Watcher, 4), token);
    EXPECT_FALSE(access.token(token)) << "a new token of the same name ends the old one";
}

TEST_F(AccessTest, whoGuessedIsRefusedForAWhileAndNobodyElse) {
    Access access(folder_);
    access.makeCode(ConsoleRole::Crew, 0);
    for (int i = 0; i < 5; ++i) EXPECT_FALSE(pair(access, "00000000", 1, "198.51.100.7"));
    EXPECT_TRUE(spent_);
    const std::string next = access.makeCode(ConsoleRole::Crew, 2);
    EXPECT_FALSE(pair(access, next, 3, "198.51.100.7"));
    EXPECT_TRUE(pair(access, next, 3, "192.0.2.1"));
    // A clock that is set back makes no years of that while.
    access.makeCode(ConsoleRole::Crew, 2e9);
    for (int i = 0; i < 5; ++i) EXPECT_FALSE(pair(access, "00000000", 2e9, "198.51.100.7"));
    EXPECT_TRUE(spent_);
    EXPECT_TRUE(pair(access, access.makeCode(ConsoleRole::Crew, 50), 60, "198.51.100.7"));
}

TEST_F(AccessTest, aClockThatIsWrongMakesNothingValidThatIsNot) {
    constexpr UnixSeconds kBuilt = 1.79e9, kDay = 86400, kIn1970 = 1000, kNow = kBuilt + 50 * kDay;
    constexpr UnixSeconds kLongAgo = kBuilt - 90 * kDay;
    std::string old;
    {
        Access before(folder_);
        old = pair(before, before.makeCode(ConsoleRole::Crew, kLongAgo), kLongAgo).value();
        EXPECT_TRUE(before.session(old, kLongAgo + kDay));
    }
    // A session that is over is so in 1970 as well; one of now goes on through a power cut.
    Access access(folder_, kBuilt);
    EXPECT_FALSE(access.session(old, kIn1970));
    const std::string own = pair(access, access.makeCode(ConsoleRole::Crew, kNow), kNow).value();
    EXPECT_TRUE(access.session(own, kIn1970));
    EXPECT_FALSE(access.session(own, kNow + 31 * kDay));
    // A code of now does not become valid again when the clock is set back.
    EXPECT_FALSE(pair(access, access.makeCode(ConsoleRole::Crew, kNow), kIn1970));
    // What is made in 1970 lasts thirty days from the build, and no longer.
    const std::string made =
        pair(access, access.makeCode(ConsoleRole::Crew, kIn1970), kIn1970 + 1).value();
    EXPECT_TRUE(access.session(made, kIn1970 + 2));
    EXPECT_TRUE(access.session(made, kBuilt + 29 * kDay));
    EXPECT_FALSE(access.session(made, kNow));
    // What a clock far ahead has dated is none when it is set right.
    const std::string ahead = pair(access, access.makeCode(ConsoleRole::Crew, 4e9), 4e9).value();
    EXPECT_TRUE(access.session(ahead, 4e9));
    EXPECT_FALSE(access.session(ahead, kNow));
}

TEST_F(AccessTest, othersCannotReadWhatIsKept) {
    Access access(folder_);
    EXPECT_EQ(fs::status(folder_).permissions() & fs::perms::mask, fs::perms::owner_all);
}

// A file stands where its folder should be, as good as a full disk.
TEST_F(AccessTest, whereNothingCanBeKeptPeopleAreLetInUntilTheEnd) {
    std::ofstream(folder_) << "";
    Access access(folder_);
    const std::string code = access.makeCode(ConsoleRole::Operator, 1000);
    const auto secret = pair(access, code, 1001);
    ASSERT_TRUE(secret);
    EXPECT_TRUE(access.session(*secret, 1002));
    EXPECT_FALSE(pair(access, code, 1003));
    access.revoke(access.people().front().id);
    EXPECT_FALSE(access.session(*secret, 1004));
}

}  // namespace
}  // namespace aquarama::console
