// SPDX-License-Identifier: Apache-2.0
// Which drawings swim: they wait for the crew, enter one after the other once nodes have their
// skins, make room for newer ones, and survive a restart.
#include "master/conductor/drawings.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/files.h"
#include "common/base/picture.h"
#include "common/body/side_view.h"
#include "common/wire/messages.h"

namespace aquarama::conductor {
namespace {

using Status = v1::DrawingStatus;
using Judgement = v1::Moderation;
using std::chrono::seconds;
using testing::HasSubstr;

constexpr std::uint64_t kNoon = 1'800'000'000;
constexpr std::uint32_t kFirst = 10, kLast = 13;  // fish that wait, of clownfish

// A skin of one colour.
std::string skin(std::uint16_t code, glm::ivec2 size = body::kSideTexels) {
    PngPicture picture;
    picture.sizePixels = size;
    picture.codes.assign(3 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y),
                         code);
    const auto png = encodePng(picture, PngMeaning::Srgb);
    return {reinterpret_cast<const char*>(png.data()), png.size()};
}

// Where the fish of a world are; all that wait are away.
std::vector<motion::FishRecord> everybody() {
    std::vector<motion::FishRecord> fish(kLast + 2);
    motion::MotionStates away;
    away.resize(1);
    motion::setAway(away, 0);
    for (std::uint32_t one = kFirst; one < kLast; ++one) fish[one] = motion::recordOf(away, 0);
    return fish;
}

// The drawings of a hall, and a world that does what they say.
struct Hall {
    explicit Hall(config::DrawingRules rules, const std::filesystem::path& folder = {})
        : drawings{std::move(rules), folder} {
        drawings.enter({{"clownfish", kFirst, kLast}});
    }
    std::uint32_t offer(std::uint16_t code, const std::string& species = "clownfish") {
        v1::OfferedDrawing offered;
        offered.set_skin(skin(code));
        offered.set_species(species);
        offered.set_aside(1);
        std::uint32_t number = 0;
        const std::uint64_t offer = ++request;
        answer = untilKept([&] { return drawings.offer(offer, offered, now, number); });
        return number;
    }
    ask::Answer decide(std::uint32_t number,
                       Judgement::Verdict verdict,
                       std::optional<int> aside = {}) {
        v1::Moderation moderation;
        moderation.set_number(number);
        moderation.set_verdict(verdict);
        if (aside) moderation.set_aside(*aside);
        const std::uint64_t decision = ++request;
        return untilKept([&] { return drawings.decide("the crew", decision, moderation); });
    }
    // Says it again until it is on the disk, as clients do.
    static ask::Answer untilKept(const std::function<ask::Answer()>& say) {
        while (true) {
            const ask::Answer answer = say();
            if (answer.outcome != ask::Outcome::Waiting) return answer;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    // Turns for so many seconds; fish that are told to leave are away after three.
    void pass(int count) {
        for (int second = 0; second < count; ++second) {
            clock += seconds(1);
            ++now;
            for (const auto& [one, at] : leaving)
                if (clock - at > seconds(3)) fish[one] = everybody()[kFirst];
            std::erase_if(leaving,
                          [&](const auto& one) { return clock - one.second > seconds(3); });
            drawings.turn(fish, maySwim, clock, now, [this](const auto& input) {
                return !isBusy && apply(input);
            });
        }
    }
    bool apply(const world::WorldInput& input) {
        inputs.push_back(input);
        if (const auto* entered = std::get_if<world::EnterDrawing>(&input))
            fish[entered->fish] = {};
        if (const auto* left = std::get_if<world::LeaveDrawing>(&input))
            leaving.emplace_back(left->fish, clock);
        return true;
    }
    [[nodiscard]] std::string conditions() const {
        std::string text;
        const v1::DrawingsReply reply = drawings.reply({});
        for (const Status& status : reply.drawings())
            text += std::to_string(status.number()) + " " +
                    Status::Condition_Name(status.condition()) +
                    (status.has_fish() ? " as " + std::to_string(status.fish()) : "") + "; ";
        return text;
    }

    Drawings drawings;
    std::uint64_t request = 0;
    ask::Answer answer;
    net::Moment clock{seconds(100)};
    std::uint64_t now = kNoon;
    bool maySwim = true;
    bool isBusy = false;  // the world takes nothing
    std::vector<motion::FishRecord> fish = everybody();
    std::vector<std::pair<std::uint32_t, net::Moment>> leaving;
    std::vector<world::WorldInput> inputs;
};

config::DrawingRules rules(bool atOnce = true, std::uint32_t most = 60) {
    config::DrawingRules rules;
    rules.species = {"clownfish", "blue_tang"};
    rules.most = most;
    rules.areLetInAtOnce = atOnce;
    return rules;
}

TEST(Drawings, waitForTheCrewAndSwimOnceNodesHaveHadTimeForTheirSkins) {
    Hall hall(rules(false));
    EXPECT_EQ(hall.offer(10), 1U);
    hall.pass(10);
    EXPECT_EQ(hall.conditions(), "1 WAITING; ");
    EXPECT_FALSE(hall.drawings.skins());
    EXPECT_EQ(hall.decide(1, Judgement::LET_IN).outcome, ask::Outcome::Done);
    hall.pass(1);
    ASSERT_TRUE(hall.drawings.skins());
    EXPECT_TRUE(hall.inputs.empty()) << "its skin is told first";
    v1::SkinList list;
    const net::Blob blob = hall.drawings.blob(*hall.drawings.skins());
    ASSERT_TRUE(blob);
    ASSERT_TRUE(list.ParseFromArray(blob->data(), static_cast<int>(blob->size())));
    ASSERT_EQ(list.skins_size(), 1);
    EXPECT_EQ(list.skins(0).number(), 1U);
    EXPECT_TRUE(hall.drawings.blob(wire::digestIn(list.skins(0).picture())));
    hall.pass(2);
    ASSERT_EQ(hall.inputs.size(), 1U);
    const auto& entered = std::get<world::EnterDrawing>(hall.inputs[0]);
    EXPECT_EQ(entered.fish, kFirst);
    EXPECT_EQ(entered.number, 1U);
    EXPECT_EQ(entered.aside, 1);
    EXPECT_EQ(wire::bytesOf(entered.picture), list.skins(0).picture());
    EXPECT_EQ(hall.conditions(), "1 SWIMMING as 10; ");
}

TEST(Drawings, areRefusedWithTheReason) {
    Hall hall(rules());
    EXPECT_EQ(hall.offer(1, "lionfish"), 0U);
    EXPECT_THAT(hall.answer.reason, HasSubstr("lionfish"));
    v1::OfferedDrawing small;
    small.set_skin(skin(1, {512, 512}));
    small.set_species("clownfish");
    std::uint32_t number = 0;
    EXPECT_THAT(hall.drawings.offer(7, small, kNoon, number).reason, HasSubstr("1024 x 512"));
    small.set_skin("no picture");
    EXPECT_EQ(hall.drawings.offer(8, small, kNoon, number).outcome, ask::Outcome::Refused);
    EXPECT_EQ(number, 0U);
    Drawings none(std::nullopt, {});
    EXPECT_THAT(none.offer(1, small, kNoon, number).reason, HasSubstr("drawings { }"));
    EXPECT_FALSE(none.version());
    EXPECT_EQ(hall.decide(5, Judgement::TAKE_DOWN).outcome, ask::Outcome::Refused);
}

// A phone that hears no answer says it again.
TEST(Drawings, thatAreOfferedAgainAreOne) {
    Hall hall(rules());
    EXPECT_EQ(hall.offer(1), 1U);
    --hall.request;
    EXPECT_EQ(hall.offer(1), 1U);
    EXPECT_EQ(hall.conditions(), "1 SWIMMING; ");
}

// The crew sees which child stands where.
TEST(Drawings, enterFromTheSideThatTheCrewNames) {
    Hall hall(rules(false));
    hall.offer(1);
    hall.offer(2);
    EXPECT_EQ(hall.decide(1, Judgement::LET_IN, -1).outcome, ask::Outcome::Done);
    EXPECT_EQ(hall.decide(2, Judgement::LET_IN).outcome, ask::Outcome::Done);
    hall.pass(5);
    ASSERT_EQ(hall.inputs.size(), 2U);
    EXPECT_EQ(std::get<world::EnterDrawing>(hall.inputs[0]).aside, -1);
    EXPECT_EQ(std::get<world::EnterDrawing>(hall.inputs[1]).aside, 1) << "as it was offered";
    EXPECT_EQ(hall.drawings.reply({}).drawings(0).aside(), -1);
}

// The world takes no inputs while too many wait; none is lost, and no fish is given twice.
TEST(Drawings, enterAndLeaveABusyWorldOnceItTakesThem) {
    Hall hall(rules());
    hall.offer(1);
    hall.isBusy = true;
    hall.pass(5);
    EXPECT_TRUE(hall.inputs.empty());
    ASSERT_EQ(hall.decide(1, Judgement::TAKE_DOWN).outcome, ask::Outcome::Done);
    hall.offer(2);
    hall.pass(6);
    EXPECT_THAT(hall.conditions(), HasSubstr("1 LEAVING as 10")) << "it is still to enter";
    hall.isBusy = false;
    hall.pass(1);
    ASSERT_EQ(hall.inputs.size(), 3U);
    EXPECT_EQ(std::get<world::EnterDrawing>(hall.inputs[0]).number, 1U);
    EXPECT_EQ(std::get<world::LeaveDrawing>(hall.inputs[1]).fish, kFirst);
    EXPECT_EQ(std::get<world::EnterDrawing>(hall.inputs[2]).fish, kFirst + 1);
    hall.pass(6);
    EXPECT_EQ(hall.conditions(), "2 SWIMMING as 11; ");
}

// Three clownfish have room; the oldest that is not kept makes room for the fourth.
TEST(Drawings, ofASpeciesMakeRoomTheOldestFirst) {
    Hall hall(rules());
    for (std::uint16_t code = 1; code <= 3; ++code) hall.offer(code);
    hall.pass(12);
    EXPECT_EQ(hall.conditions(), "1 SWIMMING as 10; 2 SWIMMING as 11; 3 SWIMMING as 12; ");
    EXPECT_EQ(hall.decide(1, Judgement::KEEP).outcome, ask::Outcome::Done);
    hall.offer(4);
    hall.pass(5);
    EXPECT_THAT(hall.conditions(), HasSubstr("2 LEAVING as 11"));
    hall.pass(10);
    EXPECT_EQ(hall.conditions(), "1 SWIMMING as 10; 3 SWIMMING as 12; 4 SWIMMING as 11; ");
}

// A bus of children: nodes load their skins together, and a fish comes in each second.
TEST(Drawings, enterOneASecond) {
    Hall hall(rules());
    for (std::uint16_t code = 1; code <= 3; ++code) hall.offer(code);
    hall.pass(3);
    EXPECT_EQ(hall.inputs.size(), 1U);
    hall.pass(2);
    EXPECT_EQ(hall.inputs.size(), 3U);
}

TEST(Drawings, areAsManyAsTheRigSays) {
    Hall hall(rules(true, 2));
    for (std::uint16_t code = 1; code <= 5; ++code) {
        hall.offer(code);
        hall.pass(12);
    }
    EXPECT_EQ(hall.conditions(), "4 SWIMMING as 10; 5 SWIMMING as 11; ");
}

TEST(Drawings, thatAreSetOffSwimAwayAndComeBack) {
    Hall hall(rules());
    hall.offer(1);
    hall.pass(5);
    hall.maySwim = false;
    hall.pass(1);
    EXPECT_EQ(hall.conditions(), "1 LEAVING as 10; ");
    hall.pass(10);
    EXPECT_EQ(hall.conditions(), "1 SWIMMING; ") << "it would";
    EXPECT_FALSE(hall.drawings.skins());
    hall.maySwim = true;
    hall.pass(5);
    EXPECT_EQ(hall.conditions(), "1 SWIMMING as 10; ");
}

TEST(Drawings, goAtTheEndOfTheDayUnlessTheyAreKept) {
    Hall hall(rules());
    hall.offer(1);
    hall.offer(2);
    hall.pass(8);
    ASSERT_EQ(hall.decide(2, Judgement::KEEP).outcome, ask::Outcome::Done);
    ASSERT_EQ(hall.decide(0, Judgement::END_DAY).outcome, ask::Outcome::Done);
    hall.pass(8);
    EXPECT_EQ(hall.conditions(), "2 SWIMMING as 11; ");
    hall.offer(3);
    hall.pass(5);
    hall.now += 21 * 3600;  // nobody closed the day
    hall.pass(8);
    EXPECT_EQ(hall.conditions(), "2 SWIMMING as 11; ");
}

TEST(Drawings, enterAnotherWorldAnewWhereItHasRoom) {
    Hall hall(rules());
    hall.offer(1);
    hall.pass(5);
    hall.drawings.enter({{"blue_tang", 0, 3}});
    EXPECT_EQ(hall.conditions(), "1 HOMELESS; ");
    hall.drawings.enter({{"clownfish", kFirst + 1, kLast}});
    hall.fish = everybody();
    hall.pass(5);
    EXPECT_EQ(hall.conditions(), "1 SWIMMING as 11; ");
}

// A world that goes on has them already. Of one that the crew took down meanwhile the fish leaves.
TEST(Drawings, swimOnInAWorldThatHasThem) {
    Hall hall(rules());
    for (std::uint16_t code = 1; code <= 3; ++code) hall.offer(code);
    hall.pass(9);
    EXPECT_EQ(hall.conditions(), "1 SWIMMING as 10; 2 SWIMMING as 11; 3 SWIMMING as 12; ");
    hall.inputs.clear();
    hall.drawings.enter({{"clownfish", kFirst, kLast, {2, 77, 0}}});
    hall.fish[kLast - 1] = everybody()[kFirst];
    hall.pass(1);
    ASSERT_EQ(hall.inputs.size(), 1U);
    EXPECT_EQ(std::get<world::LeaveDrawing>(hall.inputs[0]).fish, kFirst + 1);
    hall.pass(9);
    EXPECT_EQ(hall.conditions(), "1 SWIMMING as 12; 2 SWIMMING as 10; 3 SWIMMING as 11; ");
}

TEST(Drawings, surviveARestart) {
    const TemporaryFolder folder("drawings-test");
    const auto at = folder.path() / "desk.drawings";
    {
        Hall hall(rules(false), at);
        for (std::uint16_t code = 1; code <= 3; ++code) hall.offer(code);
        EXPECT_EQ(hall.decide(2, Judgement::LET_IN).outcome, ask::Outcome::Done);
        EXPECT_EQ(hall.decide(3, Judgement::TAKE_DOWN).outcome, ask::Outcome::Done);
        hall.pass(6);
    }
    EXPECT_FALSE(std::filesystem::exists(at / "3.png"));
    {
        Hall hall(rules(false), at);
        EXPECT_EQ(hall.conditions(), "1 WAITING; 2 SWIMMING; ");
        v1::DrawingsRequest request;
        request.set_skin_of(2);
        EXPECT_EQ(hall.drawings.reply(request).skin(), skin(2));
        hall.pass(5);
        EXPECT_EQ(hall.conditions(), "1 WAITING; 2 SWIMMING as 10; ");
        hall.request = 100;
        EXPECT_EQ(hall.offer(4), 4U) << "no number is given twice";
    }
    // A picture that is gone costs only its drawing; a list that is damaged costs no show.
    std::filesystem::remove(at / "1.png");
    EXPECT_EQ(Hall(rules(false), at).conditions(), "2 SWIMMING; 4 WAITING; ");
    writeWhole(at / "list.txtpb", std::as_bytes(std::span{"drawings {", 10}));
    EXPECT_EQ(Hall(rules(false), at).conditions(), "");
}

// What a sender was told of is on the disk: a master that is killed then has it again. A sender
// that was not told says it once more, and is told the same number.
TEST(Drawings, thatWereTakenSurviveAKilledMaster) {
    const TemporaryFolder folder("drawings-test");
    const auto at = folder.path() / "desk.drawings", copy = folder.path() / "killed.drawings";
    Hall hall(rules(false), at);
    ASSERT_EQ(hall.offer(1), 1U);
    ASSERT_EQ(hall.offer(2), 2U);
    ASSERT_EQ(hall.decide(2, Judgement::LET_IN, -1).outcome, ask::Outcome::Done);
    std::filesystem::copy(at, copy);  // what a killed one leaves
    Hall restarted(rules(false), copy);
    EXPECT_EQ(restarted.conditions(), "1 WAITING; 2 SWIMMING; ");
    EXPECT_EQ(restarted.drawings.reply({}).drawings(1).aside(), -1);
    EXPECT_EQ(restarted.offer(1), 1U) << "the same request";
    restarted.request = 1;
    EXPECT_EQ(restarted.offer(2), 2U);
    EXPECT_EQ(restarted.drawings.reply({}).drawings_size(), 2);
}

// A slow node may still ask for what was listed a moment ago.
TEST(Drawings, giveTheSkinsOfFormerListsForAWhile) {
    Hall hall(rules());
    hall.offer(1);
    hall.pass(5);
    const Digest former = hall.drawings.skins().value();
    ASSERT_EQ(hall.decide(1, Judgement::TAKE_DOWN).outcome, ask::Outcome::Done);
    hall.pass(6);
    EXPECT_FALSE(hall.drawings.skins());
    EXPECT_TRUE(hall.drawings.blob(former));
    EXPECT_FALSE(hall.drawings.blob(digestOf("something else")));
}

}  // namespace
}  // namespace aquarama::conductor
