// SPDX-License-Identifier: Apache-2.0
#include "guests/guests.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/base/files.h"
#include "common/config/rig.h"
#include "guests/sign.h"
#include "tests/guests/callers.h"

namespace aquarama::guests {
namespace {

using nlohmann::json;
using test::Caller;
using test::RecordedOutbox;
using test::RecordedWall;

class GuestServiceTest : public testing::Test {
  protected:
    GuestServiceTest() { begin(); }

    void begin() {
        service.reset();
        service.emplace(
            GuestsOptions{
                .place = door, .key = kKey, .seatFile = folder.path() / "seats", .picture = shown},
            wall,
            [this] { return now; });
        service->heard(WallState{.isOpen = true, .eye = {.positionMetres = {1, 2, 3}}});
    }
    // Ten ticks a second.
    void pass(double seconds) {
        for (int ticks = static_cast<int>(seconds * 10 + 0.5); ticks > 0; --ticks) {
            now += 0.1;
            service->tick();
        }
    }
    [[nodiscard]] std::string entering() const {
        return json{{"enter", DoorTokens(kKey).wordAt(now)}}.dump();
    }

    static constexpr DoorTokens::Key kKey{7};
    TemporaryFolder folder{"guests"};
    config::Guests door{.host = "10.0.0.1", .port = 7490, .channel = {}};
    double now = 1000;
    RecordedWall wall;
    WallPicture* shown = nullptr;
    std::optional<GuestService> service;
};

// Where a finger points on the picture of the wall; beside it, and without one, ahead.
TEST_F(GuestServiceTest, foodGoesWhereAFingerPoints) {
    config::Rig rig = config::readRig(AQUARAMA_SOURCE_DIR "/config/desk.txtpb");
    rig.guests.emplace().picturesAddress = "tcp://127.0.0.1:*";
    WallPicture picture(rig, std::nullopt);
    const auto feed = [&](const std::string& said) {
        Caller phone(*service, entering());
        EXPECT_EQ(phone.state()["wall"], shown != nullptr);
        phone.say(said);
        pass(1);
        return wall.food.empty() ? glm::vec3() : wall.food.back() - glm::vec3(1, 2, 3);
    };
    shown = &picture;
    begin();
    const glm::vec3 left = feed(R"({"feed":[0.01,0.5]})");
    EXPECT_LT(left.x, -1.4F);
    EXPECT_GT(left.z, -2.0F) << "the screen's edge is 60 degrees aside";
    EXPECT_GT(feed(R"({"feed":[0.5,0.1]})").y, 0.5F);
    for (const char* const ahead :
         {R"({"feed":true})", R"({"feed":[7,7]})", R"({"feed":["a",2]})"}) {
        const glm::vec3 place = feed(ahead);
        EXPECT_LT(place.z, -1.9F) << ahead;
        EXPECT_LT(std::abs(place.x), 0.9F) << ahead;
    }
    shown = nullptr;
    begin();
    EXPECT_LT(feed(R"({"feed":[0.01,0.5]})").z, -1.9F);
}

// It shows the sign.
TEST_F(GuestServiceTest, theWallIsShownToWhoWasLetIn) {
    config::Rig rig = config::readRig(AQUARAMA_SOURCE_DIR "/config/desk.txtpb");
    rig.guests.emplace().picturesAddress = "tcp://127.0.0.1:*";
    WallPicture picture(rig, std::nullopt);
    shown = &picture;
    begin();
    const auto statusOf = [&](const std::string& target) {
        return service->answer({.method = "GET", .target = target, .host = "10.0.0.1:7490"}).status;
    };
    Caller phone(*service, entering());
    const std::string secret = phone.outbox.said["session"]["session"];
    EXPECT_EQ(statusOf("/wall.jpg?1"), 401);
    EXPECT_EQ(statusOf("/wall.jpg?"), 401);
    EXPECT_EQ(statusOf("/wall.jpg?" + secret.substr(1) + ".1"), 401);
    EXPECT_EQ(statusOf("/wall.jpg?" + secret + ".1"), 204) << "nodes have brought none yet";
}

TEST_F(GuestServiceTest, letsInWhoSeesTheWall) {
    Caller scanned(*service, entering()), read(*service), guessed(*service);
    EXPECT_EQ(scanned.you(), "steering") << "nobody else is there";
    EXPECT_EQ(read.you(), "stranger");
    read.say(json{{"enter", DoorTokens(kKey).digitsAt(now)}}.dump());
    EXPECT_EQ(read.you(), "waiting");
    EXPECT_EQ(read.state()["place"], 1);
    EXPECT_EQ(read.state()["wait_s"], 61);
    guessed.say(R"({"enter":"ABCDEFGHJK"})");
    EXPECT_EQ(guessed.outbox.said["refused"]["refused"], "code");
    EXPECT_EQ(guessed.you(), "stranger");
}

TEST_F(GuestServiceTest, guessesOfDigitsAreFew) {
    const std::string right = DoorTokens(kKey).digitsAt(now);
    const std::string wrong = right == "000" ? R"({"enter":"001"})" : R"({"enter":"000"})";
    Caller one(*service);
    for (int i = 0; i < 5; ++i) one.say(wrong);
    EXPECT_EQ(one.outbox.closed, kClosedTooMuch);
    Caller two(*service), three(*service);
    for (int i = 0; i < 5; ++i) two.say(wrong);
    three.say(json{{"enter", right}}.dump());
    EXPECT_EQ(three.you(), "stranger") << "ten guesses of all phones were spent";
    pass(2.1);
    three.say(json{{"enter", right}}.dump());
    EXPECT_NE(three.you(), "stranger");
}

TEST_F(GuestServiceTest, theOneWhosTurnItIsSteersAndNobodyElse) {
    Caller pilot(*service, entering()), other(*service, entering());
    wall.hands.clear();
    other.say(R"({"helm":[127,0,0,0,0]})");
    EXPECT_TRUE(wall.hands.empty());
    pilot.say(R"({"helm":[127,-1,2,-127,3]})");
    EXPECT_EQ(wall.hands.back(), (Steering{127, -1, 2, -127, 3}));
    for (const char* const bad : {R"({"helm":[128,0,0,0,0]})",
                                  R"({"helm":[1,0,0,0]})",
                                  R"({"helm":[1.5,0,0,0,0]})",
                                  R"({"helm":"ahead"})",
                                  R"({"helm":[1e99,0,0,0,0]})",
                                  "[]",
                                  "{",
                                  "\x80"})
        pilot.say(bad);
    EXPECT_EQ(wall.hands.size(), 1U);
}

TEST_F(GuestServiceTest, aHandIsHeldAndRestsWithoutItsPhone) {
    Caller pilot(*service, entering());
    pilot.say(R"({"helm":[127,0,0,0,0]})");
    wall.hands.clear();
    pass(0.3);
    EXPECT_EQ(wall.hands, std::vector<Steering>(3, Steering{127, 0, 0, 0, 0}));
    pass(0.2);
    EXPECT_EQ(wall.hands.back(), Steering{}) << "half a second after it was last heard";
    pilot.say(R"({"helm":[0,127,0,0,0]})");
    pilot.connection.reset();
    EXPECT_EQ(wall.hands.back(), Steering{}) << "at once where the connection ends";
}

TEST_F(GuestServiceTest, turnsEndWithASecondAtRestAndTheWallCountsDown) {
    Caller first(*service, entering()), second(*service, entering());
    const auto steady = [&] { first.say(R"({"helm":[127,0,0,0,0]})"); };
    pass(54);
    const std::size_t signs = wall.signs.size();
    for (int i = 0; i < 62; ++i) steady(), pass(0.1);
    EXPECT_EQ(wall.signs.size(), signs + 6) << "5, 4, 3, 2, 1, and the digits again";
    EXPECT_EQ(first.you(), "guest");
    EXPECT_EQ(second.you(), "waiting");
    EXPECT_EQ(wall.hands.back(), Steering{});
    pass(1);
    EXPECT_EQ(second.you(), "steering");
    first.say(R"({"join":true})");
    EXPECT_EQ(first.you(), "waiting");
    second.say(R"({"leave":true})");
    pass(1.1);
    EXPECT_EQ(first.you(), "steering");
}

TEST_F(GuestServiceTest, everyoneFeedsNowAndThen) {
    Caller one(*service, entering()), two(*service, entering()), three(*service, entering());
    one.say(R"({"feed":true})");
    one.say(R"({"feed":true})");
    ASSERT_EQ(wall.food.size(), 1U);
    const float away = glm::distance(wall.food[0], glm::vec3(1, 2, 3));
    EXPECT_GE(away, 2.0F);
    EXPECT_LE(away, 8.0F);
    EXPECT_LT(wall.food[0].z, 3) << "before the eye";
    EXPECT_EQ(one.state()["feed_s"], 20);
    two.say(R"({"feed":true})");
    three.say(R"({"feed":true})");
    EXPECT_EQ(wall.food.size(), 2U) << "two a second in all";
    pass(20.1);
    one.say(R"({"feed":true})");
    EXPECT_EQ(wall.food.size(), 3U);
}

TEST_F(GuestServiceTest, aPhoneComesBackToItsSeatAlsoAfterARestart) {
    std::optional<Caller> one, two;
    one.emplace(*service, entering());
    two.emplace(*service, entering());
    const std::string resuming = one->resuming();
    EXPECT_EQ(resuming.size(), std::string(R"({"resume":""})").size() + 32);
    one.reset();
    pass(3);
    one.emplace(*service, resuming);
    EXPECT_EQ(one->you(), "steering");
    const std::string other = two->resuming();
    std::stringstream kept;
    pass(1);
    kept << std::ifstream(folder.path() / "seats").rdbuf();
    EXPECT_EQ(kept.str().find(resuming.substr(11, 32)), std::string::npos) << "no secret is kept";
    one.reset();
    two.reset();
    begin();
    two.emplace(*service, other);
    EXPECT_EQ(two->you(), "steering") << "the first who is there";
    one.emplace(*service, resuming);
    EXPECT_EQ(one->you(), "waiting");
    Caller forged(*service, R"({"resume":"00000000000000000000000000000000"})");
    EXPECT_EQ(forged.outbox.said["refused"]["refused"], "session");
}

// Killed right after it has answered, without a tick.
TEST_F(GuestServiceTest, whatPhonesWereToldSurvivesAKill) {
    const auto seats = folder.path() / "seats", kept = folder.path() / "kept";
    std::optional<Caller> one, two, three;
    one.emplace(*service, entering());
    two.emplace(*service, entering());
    three.emplace(*service, entering());
    two->say(R"({"leave":true})");
    EXPECT_EQ(three->you(), "waiting");
    std::filesystem::copy_file(seats, kept);
    const std::string first = one->resuming(), second = two->resuming(), third = three->resuming();
    one.reset(), two.reset(), three.reset(), service.reset();
    std::filesystem::copy_file(kept, seats, std::filesystem::copy_options::overwrite_existing);
    begin();
    one.emplace(*service, first);
    two.emplace(*service, second);
    three.emplace(*service, third);
    EXPECT_EQ(one->you(), "steering");
    EXPECT_EQ(two->you(), "guest");
    EXPECT_EQ(three->you(), "waiting");
}

// Browsers write a host of version 6 in brackets, and its shortest form.
TEST_F(GuestServiceTest, isServedAtAnAddressOfVersion6) {
    door.host = "2001:db8::7";
    begin();
    Caller phone(*service, entering(), "[2001:db8::7]:7490");
    EXPECT_EQ(phone.you(), "steering");
    EXPECT_EQ(
        service->answer({.method = "GET", .target = "/", .host = "[2001:db8::7]:7490"}).status,
        200);
    EXPECT_EQ(
        service->answer({.method = "GET", .target = "/", .host = "[2001:db8::8]:7490"}).status,
        421);
    pass(0.1);
    EXPECT_EQ(wall.signs.back(),
              signOf("HTTP://[2001:DB8::7]:7490/P/" + DoorTokens(kKey).wordAt(now),
                     DoorTokens(kKey).digitsAt(now),
                     false));
}

TEST_F(GuestServiceTest, theLatestPageOfAVisitorCounts) {
    Caller one(*service, entering());
    Caller again(*service, one.resuming());
    EXPECT_EQ(one.outbox.closed, kClosedElsewhere);
    EXPECT_EQ(again.you(), "steering");
    one.connection.reset();
    pass(1);
    EXPECT_EQ(again.you(), "steering");
}

TEST_F(GuestServiceTest, turnsWaitWhileTheWallIsClosed) {
    Caller one(*service, entering());
    pass(10);
    for (const auto& closed : {std::optional(WallState{}), std::optional<WallState>()}) {
        service->heard(closed);
        EXPECT_EQ(one.you(), "closed");
        wall.hands.clear();
        one.say(R"({"helm":[127,0,0,0,0]})");
        one.say(R"({"feed":true})");
        pass(100);
        EXPECT_TRUE(wall.hands.empty() && wall.food.empty());
    }
    service->heard(WallState{.isOpen = true, .eye = {}});
    EXPECT_EQ(one.you(), "steering");
    EXPECT_NEAR(one.state()["left_s"].get<double>(), 50, 0.3);
}

TEST_F(GuestServiceTest, refusesOtherNamesOriginsAndFloods) {
    EXPECT_EQ(service->answer({.method = "GET", .target = "/", .host = "evil.example"}).status,
              421);
    EXPECT_EQ(service->answer({.method = "POST", .target = "/", .host = "10.0.0.1:7490"}).status,
              405);
    for (const char* const page : {"/", "/P/7Q2K4M9XHT", "/p/7q2k4m9xht"}) {
        const auto reply =
            service->answer({.method = "GET", .target = page, .host = "10.0.0.1:7490"});
        EXPECT_EQ(reply.status, 200) << page;
        EXPECT_TRUE(reply.type.starts_with("text/html")) << page;
    }
    RecordedOutbox outbox;
    web::HttpReply refusal;
    for (const char* const origin : {"http://evil.example", "", "null", "https://10.0.0.1:7490"}) {
        EXPECT_EQ(service->open(
                      {.target = "/g", .host = "10.0.0.1:7490", .origin = origin}, outbox, refusal),
                  nullptr);
        EXPECT_EQ(refusal.status, 403) << origin;
    }
    Caller loud(*service, std::string(300, ' '));
    EXPECT_EQ(loud.outbox.closed, kClosedTooMuch);
    Caller fast(*service);
    for (int i = 0; i < 100; ++i) fast.say("{}");
    EXPECT_EQ(fast.outbox.closed, kClosedTooMuch);
}

TEST_F(GuestServiceTest, bounds) {
    std::vector<std::unique_ptr<Caller>> phones;
    int busy = 0;
    for (std::size_t i = 0; i < GuestService::kMostPhones; ++i) {
        phones.push_back(std::make_unique<Caller>(*service, entering()));
        busy += phones.back()->you() == "stranger" ? 1 : 0;
    }
    EXPECT_EQ(busy, 560) << "40 at once";
    pass(1);
    for (const auto& phone : phones)
        if (phone->you() == "stranger") phone->say(entering()), --busy;
    EXPECT_EQ(phones[0]->state()["line"], 12);
    EXPECT_EQ(phones[20]->you(), "guest");
    Caller late(*service);
    EXPECT_EQ(late.connection, nullptr);
    EXPECT_EQ(late.refusal.status, 503);
}

}  // namespace
}  // namespace aquarama::guests
