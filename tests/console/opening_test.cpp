// SPDX-License-Identifier: Apache-2.0
#include "console/opening.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/base/log.h"
#include "common/config/text_file.h"
#include "console/overview.h"

namespace aquarama::console {
namespace {

namespace fs = std::filesystem;

constexpr UnixSeconds kTen = 1767258000;  // 2026-01-01 10:00 in Berlin, a Thursday
constexpr double kHour = 3600;
const std::string kText =
    "zone: \"Europe/Berlin\"\nopen { days: [THURSDAY] from: \"10:00\" to: \"18:00\" scene: "
    "\"reef\" }\n";

class OpeningTest : public testing::Test {
  protected:
    OpeningTest()
        : folder_{fs::temp_directory_path() / ("aquarama-opening-" + std::to_string(getpid()))} {
        fs::create_directories(folder_);
    }
    ~OpeningTest() override { fs::remove_all(folder_); }
    fs::path folder_;
};

TEST_F(OpeningTest, withoutHoursNothingIsEverDue) {
    const Opening opening(folder_);
    EXPECT_FALSE(opening.due(kTen));
    EXPECT_FALSE(opening.isClosed(kTen));
    EXPECT_FALSE(opening.hours(kTen).present());
}

TEST_F(OpeningTest, whatIsWantedIsDueUntilItIsDoneAndWhatPeopleSetMeanwhileHolds) {
    Opening opening(folder_);
    opening.setText(kText);
    ASSERT_TRUE(opening.due(kTen - 60));
    EXPECT_FALSE(opening.due(kTen - 60)->isOpen);
    opening.done({}, kTen);
    EXPECT_FALSE(opening.due(kTen - 1));
    EXPECT_TRUE(opening.isClosed(kTen - 1));
    const auto open = opening.due(kTen);
    ASSERT_TRUE(open);
    EXPECT_EQ(*open, (config::WantedHours{true, "reef", ""}));
    EXPECT_TRUE(opening.due(kTen + 5)) << "not done yet";
    opening.done(*open, kTen);
    for (double t = 0; t < 8 * kHour; t += 60) EXPECT_FALSE(opening.due(kTen + t)) << t;
    EXPECT_TRUE(opening.due(kTen + 8 * kHour));
}

// After a power cut, at whatever moment, what should be is brought about, and nothing twice.
TEST_F(OpeningTest, aRestartInAnySecondGoesOnWithTheHours) {
    Opening(folder_).setText(kText);
    for (double t = -2 * kHour; t < 10 * kHour; t += 977) {
        Opening opening(folder_);
        const bool isOpen = t >= 0 && t < 8 * kHour;
        const auto due = opening.due(kTen + t);
        if (due) {
            EXPECT_EQ(due->isOpen, isOpen);
            opening.done(*due, kTen + t);
        }
        EXPECT_FALSE(Opening(folder_).due(kTen + t));
        EXPECT_EQ(opening.isClosed(kTen + t), !isOpen);
    }
}

// What an operator set before a power cut at noon does not hold on the next day.
TEST_F(OpeningTest, aNightWithoutPowerEndsWhatWasSetOnTheDayBefore) {
    const std::string daily =
        "zone: \"UTC\"\nopen { days: [THURSDAY, FRIDAY] from: \"09:00\" to: \"18:00\" }\n";
    {
        Opening opening(folder_);
        opening.setText(daily);
        opening.done(*opening.due(kTen), kTen);
    }
    const Opening restarted(folder_);
    EXPECT_FALSE(restarted.due(kTen + 2 * kHour)) << "the same day";
    EXPECT_TRUE(restarted.due(kTen + 9 * kHour)) << "is to be closed";
    const auto next = restarted.due(kTen + 24 * kHour);
    ASSERT_TRUE(next) << "is to be opened anew";
    EXPECT_TRUE(next->isOpen);
}

TEST_F(OpeningTest, aHoldRestsItForServiceWorkAndEndsByItself) {
    Opening opening(folder_);
    opening.setText(kText);
    opening.hold(2, kTen);
    EXPECT_FALSE(Opening(folder_).due(kTen + 60)) << "also after a restart";
    EXPECT_EQ(opening.heldUntil(kTen), kTen + 2 * kHour);
    EXPECT_FALSE(opening.isClosed(kTen + 1)) << "a wall in service is not off on purpose";
    EXPECT_TRUE(opening.due(kTen + 2 * kHour));
    opening.hold(1000, kTen);
    EXPECT_EQ(opening.heldUntil(kTen), kTen + 10 * kHour);
    opening.hold(0, kTen);
    EXPECT_TRUE(opening.due(kTen));
}

// Kept on the disk until it has ended: a console that dies at closing time ends it afterwards.
TEST_F(OpeningTest, theDayEndsWithItsLastClosing) {
    Opening opening(folder_);
    opening.setText(
        "zone: \"Europe/Berlin\"\n"
        "open { days: [THURSDAY] from: \"10:00\" to: \"12:00\" scene: \"reef\" }\n"
        "open { days: [THURSDAY] from: \"13:00\" to: \"18:00\" scene: \"reef\" }\n");
    bool ended = false;
    for (double t = -kHour; t < 9 * kHour; t += 60) {
        if (const auto due = opening.due(kTen + t)) opening.done(*due, kTen + t);
        ended = ended || opening.isDayToEnd();
        EXPECT_EQ(ended, t >= 8 * kHour) << t;
    }
    Opening again(folder_);
    EXPECT_TRUE(again.isDayToEnd());
    again.dayEnded();
    EXPECT_FALSE(Opening(folder_).isDayToEnd());
}

TEST_F(OpeningTest, hoursThatAreSetWhileTheWallIsShutEndNoDay) {
    Opening opening(folder_);
    opening.setText(kText);
    opening.done(*opening.due(kTen - kHour), kTen - kHour);
    EXPECT_FALSE(opening.isDayToEnd());
}

TEST_F(OpeningTest, theNextHourIsSaid) {
    Opening opening(folder_);
    opening.setText(kText);
    const browser::Hours before = opening.hours(kTen - 30 * 60);
    EXPECT_EQ(before.next() + " " + before.next_at() + " " + before.next_scene(),
              "opens 10:00 reef");
    EXPECT_EQ(opening.hours(kTen + 7.5 * kHour).next(), "closes");
    EXPECT_EQ(opening.hours(kTen + 1 * kHour).next(), "stays");
}

// What a form shows is what the text says.
TEST_F(OpeningTest, theTextIsToldAsAFormHasIt) {
    Opening opening(folder_);
    opening.setText(
        "zone: \"UTC\"\nopen { days: [FRIDAY, SATURDAY] from: \"19:00\" to: \"01:30\" quality: "
        "\"low\" }\nopen { days: [SUNDAY] from: \"09:05\" to: \"24:00\" scene: \"reef\" }\n"
        "exceptions { date: \"2026-12-31\" open { from: \"10:00\" to: \"14:00\" } }\n"
        "projectors { name: \"left\" address: \"192.168.7.21\" password: \"secret\" }\n");
    const browser::Hours hours = opening.hours(kTen);
    const v1::Hours& form = hours.form();
    EXPECT_EQ(form.zone(), "UTC");
    ASSERT_EQ(form.open_size(), 2);
    EXPECT_EQ(form.open(0).days(1), v1::OpenSpan::SATURDAY);
    EXPECT_EQ(form.open(0).from() + form.open(0).to() + form.open(0).quality(), "19:0001:30low");
    EXPECT_EQ(form.open(1).to() + form.open(1).scene(), "24:00reef");
    ASSERT_EQ(form.exceptions_size(), 1);
    EXPECT_EQ(form.exceptions(0).date(), "2026-12-31");
    EXPECT_EQ(form.exceptions(0).open(0).to(), "14:00");
    EXPECT_EQ(form.projectors(0).address(), "192.168.7.21");
    EXPECT_EQ(form.projectors(0).password(), "secret");
}

TEST_F(OpeningTest, aFormIsKeptAsText) {
    Opening opening(folder_);
    opening.setText(kText);
    v1::Hours form = opening.hours(kTen).form();
    form.mutable_open(0)->set_scene("röhre \"1\"");
    opening.setForm(form);
    Opening again(folder_);
    EXPECT_EQ(again.hours(kTen).form().SerializeAsString(), form.SerializeAsString())
        << "the text says the same";
    EXPECT_NE(again.hours(kTen).text().find("röhre"), std::string::npos);
}

TEST_F(OpeningTest, aFormWithAMistakeChangesNothing) {
    Opening opening(folder_);
    opening.setText(kText);
    v1::Hours form = opening.hours(kTen).form();
    form.mutable_open(0)->set_to("25:00");
    EXPECT_THROW(opening.setForm(form), config::FileError);
    EXPECT_THROW(opening.setForm({}), config::FileError);
    EXPECT_EQ(opening.hours(kTen).text(), kText);
    EXPECT_EQ(opening.hours(kTen).form().open(0).to(), "18:00");
}

TEST_F(OpeningTest, aTextWithAMistakeChangesNothing) {
    Opening opening(folder_);
    opening.setText(kText);
    EXPECT_THROW(opening.setText("zone: \"Europe/Berlin\" open {}"), Error);
    EXPECT_EQ(opening.hours(kTen).text(), kText);
    EXPECT_EQ(Opening(folder_).hours(kTen).text(), kText);
    opening.setText("");
    EXPECT_FALSE(Opening(folder_).hours(kTen).present());
}

// A projector that only notes what is wanted of it.
struct Noted final : SwitchedProjector {
    void want(std::optional<bool> power, std::optional<bool> shut) override {
        if (power) wanted += *power ? "on " : "off ";
        if (shut) wanted += *shut ? "shut " : "open ";
    }
    void release() override { wanted += "rest "; }
    [[nodiscard]] ProjectorFacts facts() const override { return known; }
    ProjectorFacts known = {};
    std::string wanted;
};

class OpeningOfProjectors : public OpeningTest {
  protected:
    Opening openingWith(const std::string& text) {
        const auto make = [this](const config::ControlledProjector&) {
            auto made = std::make_unique<Noted>();
            noted_.push_back(made.get());
            return made;
        };
        Opening opening(folder_, make, battery_);
        noted_.clear();  // those of hours that were kept
        opening.setText(text);
        return opening;
    }
    const fs::path battery_ = folder_ / "on-battery";
    std::vector<Noted*> noted_;
    const std::string text_ = kText +
                              "projectors { name: \"left\" address: \"10.0.0.1\" }\n"
                              "projectors { name: \"right\" address: \"10.0.0.2\" }\n";
};

// Seconds after ten o'clock when shutters were told to open, from `begin` on; 1000: never.
double openedAfter(Opening& opening,
                   const Noted& one,
                   double begin,
                   const std::function<bool(double)>& isInStep) {
    constexpr double kNever = 1000;
    for (double t = begin; t < kNever; ++t) {
        opening.switchProjectors(kTen + t, isInStep(t));
        if (one.wanted.ends_with("open ")) return t;
    }
    return kNever;
}

bool always(double /*seconds*/) {
    return true;
}

TEST_F(OpeningOfProjectors, oneThatIsGoneSilentWrongOrLateDelaysNoOther) {
    for (const ProjectorReach reach :
         {ProjectorReach::Answers, ProjectorReach::NoAnswer, ProjectorReach::RefusesPassword})
        for (const LampPower power : {LampPower::Unknown, LampPower::Off, LampPower::Warming}) {
            Opening opening = openingWith(text_);
            noted_[0]->known = {.reach = ProjectorReach::Answers, .power = LampPower::On};
            noted_[1]->known = {.reach = reach, .power = power};
            opening.done({}, kTen);
            EXPECT_EQ(openedAfter(opening, *noted_[0], -200, always), 0)
                << nameOf(reach) << ", " << nameOf(power);
            EXPECT_EQ(noted_[0]->wanted, "off shut on shut on open ");
            EXPECT_EQ(noted_[1]->wanted, noted_[0]->wanted);
        }
}

// After a power cut in the afternoon, say.
TEST_F(OpeningOfProjectors, lampsThatComeOnWhileTheWallIsOpenAreWaitedForThreeMinutesAtMost) {
    for (const auto& [power, expected] : {std::pair{LampPower::Warming, kHour + 180},
                                          std::pair{LampPower::On, kHour},
                                          std::pair{LampPower::Unknown, kHour}}) {
        Opening opening = openingWith(text_);
        noted_[0]->known = {.reach = ProjectorReach::Answers, .power = LampPower::On};
        noted_[1]->known = {.reach = ProjectorReach::Answers, .power = power};
        double opened = kHour;
        while (opened < 2 * kHour && !noted_[0]->wanted.ends_with("open "))
            opening.switchProjectors(kTen + opened++, true);
        EXPECT_EQ(opened - 1, expected) << nameOf(power);
    }
}

TEST_F(OpeningOfProjectors, nodesThatAreNotInStepAreWaitedForAtTheOpeningAndNotLater) {
    const std::vector<std::pair<std::function<bool(double)>, double>> cases{
        {[](double t) { return t > 40; }, 41}, {[](double) { return false; }, 181}};
    for (const auto& [isInStep, expected] : cases) {
        Opening opening = openingWith(text_);
        for (Noted* one : noted_)
            one->known = {.reach = ProjectorReach::Answers, .power = LampPower::On};
        opening.done({}, kTen);
        EXPECT_EQ(openedAfter(opening, *noted_[0], -200, isInStep), expected);
        opening.done(*opening.due(kTen), kTen);
        for (double t = 200; t < 300; ++t) opening.switchProjectors(kTen + t, t > 250);
        EXPECT_TRUE(noted_[0]->wanted.ends_with("shut on open ")) << noted_[0]->wanted;
    }
}

// A console that is started again in the evening leaves shutters as they are.
TEST_F(OpeningOfProjectors, aStartWhileTheWallIsOpenShutsNothing) {
    Opening opening = openingWith(text_);
    opening.done(*opening.due(kTen + kHour), kTen);
    opening.switchProjectors(kTen + kHour, true);
    EXPECT_EQ(noted_[0]->wanted, "on ") << "before it was asked, its shutter is left alone";
    noted_[0]->known = {.reach = ProjectorReach::Answers, .power = LampPower::On, .isShut = false};
    noted_[1]->known = {.reach = ProjectorReach::NoAnswer};
    opening.switchProjectors(kTen + kHour + 1, true);
    EXPECT_EQ(noted_[0]->wanted, "on on open ");
}

TEST_F(OpeningOfProjectors, whileTheScheduleIsHeldNothingIsWantedOfThem) {
    Opening opening = openingWith(text_);
    noted_[0]->known =
        noted_[1]->known = {.reach = ProjectorReach::Answers, .power = LampPower::On};
    opening.done(*opening.due(kTen), kTen);
    opening.switchProjectors(kTen, true);
    opening.hold(1, kTen);
    for (double t = 1; t < 10; ++t) opening.switchProjectors(kTen + t, true);
    opening.hold(0, kTen + 10);
    opening.switchProjectors(kTen + 10, true);
    EXPECT_EQ(noted_[0]->wanted, "on open rest on open ");
}

TEST_F(OpeningOfProjectors, onBatteryNothingOpensAndLampsAreOffUntilTheMainsAreBack) {
    Opening opening = openingWith(text_);
    noted_[0]->known =
        noted_[1]->known = {.reach = ProjectorReach::Answers, .power = LampPower::On};
    opening.done(*opening.due(kTen - 1), kTen - 1);
    std::ofstream{battery_};
    EXPECT_FALSE(opening.due(kTen)) << "its opening waits";
    EXPECT_TRUE(opening.isClosed(kTen));
    EXPECT_TRUE(opening.isOnBattery());
    opening.switchProjectors(kTen, true);
    fs::remove(battery_);
    ASSERT_TRUE(opening.due(kTen + 1));
    opening.done(*opening.due(kTen + 1), kTen + 1);
    EXPECT_FALSE(opening.isDayToEnd());
    opening.switchProjectors(kTen + 1, true);
    std::ofstream{battery_};
    EXPECT_FALSE(opening.due(kTen + 2)) << "black is said by whoever watches the battery";
    opening.switchProjectors(kTen + 2, true);
    EXPECT_TRUE(opening.due(kTen + 8 * kHour)) << "it closes on battery as well";
    EXPECT_EQ(noted_[0]->wanted, "off shut on open off shut ");
}

TEST_F(OpeningOfProjectors, whatIsUnknownIsLeftOutOfTheList) {
    const Opening opening = openingWith(text_);
    noted_[1]->known = {
        .reach = ProjectorReach::Answers, .power = LampPower::On, .isShut = false, .lampHours = 0};
    browser::ToBrowser message;
    *message.mutable_projectors() = opening.projectors();
    const std::string json = jsonOf(message);
    const std::string left = json.substr(0, json.find("right"));
    EXPECT_EQ(left.find("shut"), std::string::npos) << left;
    EXPECT_EQ(left.find("lampHours"), std::string::npos) << left;
    EXPECT_NE(left.find(R"("power":"unknown")"), std::string::npos) << left;
    EXPECT_NE(left.find(R"("reach":"not asked yet")"), std::string::npos) << left;
    const std::string right = json.substr(json.find("right"));
    EXPECT_NE(right.find(R"("shut":false)"), std::string::npos) << right;
    EXPECT_NE(right.find(R"("lampHours":0)"), std::string::npos) << right;
}

// What was kept and cannot be read is said with its place, and can be mended.
TEST_F(OpeningTest, hoursThatCannotBeReadAreKeptAndSayWhy) {
    std::ofstream(folder_ / "hours.txtpb") << "zone: \"Europe/Berlin\"\nopne {}\n";
    Opening opening(folder_);
    const browser::Hours hours = opening.hours(kTen);
    EXPECT_FALSE(hours.present());
    EXPECT_TRUE(hours.problem().starts_with("hours.txtpb:2:")) << hours.problem();
    EXPECT_NE(hours.text().find("opne"), std::string::npos);
    opening.setText(kText);
    EXPECT_EQ(opening.hours(kTen).problem(), "");
    EXPECT_TRUE(opening.hours(kTen).present());
}

// Hours do not depend on what was noted beside them.
TEST_F(OpeningTest, aDamagedNoteOfWhatWasDoneLosesNoHours) {
    Opening(folder_).setText(kText);
    std::ofstream(folder_ / "opening.json") << "{\"held_until\": ";
    const Opening opening(folder_);
    EXPECT_TRUE(opening.hours(kTen).present());
    EXPECT_TRUE(opening.due(kTen));
}

}  // namespace
}  // namespace aquarama::console
