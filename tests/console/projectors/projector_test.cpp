// SPDX-License-Identifier: Apache-2.0
// Projectors with the habits of real ones, against two days of hours in quickened time: what was
// on, open and shut, minute by minute. Without clock or socket.
#include "console/projectors/projector.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "console/opening.h"

namespace aquarama::console {
namespace {

namespace fs = std::filesystem;

constexpr double kMinute = 60, kProjectorHour = 3600, kProjectorDay = 86400;
constexpr UnixSeconds kThursday = 1767225600;  // 2026-01-01 00:00 UTC
constexpr double kOpens = 10 * kProjectorHour,
                 kCloses = 18 * kProjectorHour;  // of each of the two days
const std::string kHoursText =
    "zone: \"UTC\" open { days: [THURSDAY, FRIDAY] from: \"10:00\" to: \"18:00\" }\n"
    "projectors { name: \"odd\" address: \"192.168.7.21\" input: \"31\" }\n"
    "projectors { name: \"plain\" address: \"192.168.7.22\" }\n";

using Says = std::map<std::string, std::string>;  // command -> answer; "": silence

// What a projector does otherwise than the standard has it, or than others do.
struct Habit {
    std::string name;
    double answerSeconds = 0.05, warmSeconds = 20, coolSeconds = 30;
    Says always = {}, inStandby = {}, whileItChanges = {};
    int ignored = 0;           // so many of each command are answered OK, and not obeyed
    bool comesOnShut = false;  // as its menu has it
    std::string comesOnInput = "11";
    PjlinkEnd end = PjlinkEnd::Answered;
    double goneFrom = 0, goneTo = 0;  // without current: seconds since the first midnight
    std::function<void(double, char&, bool&)> byHand = {};  // at a time: power, shut
    // What is expected: light from so many seconds after the opening at most, none so many after
    // the closing; or no light at all.
    double lightWithin = 60, darkWithin = 60;
    bool isNeverLit = false, cannotShut = false;
    double excusedFrom = 0, excusedTo = 0;  // it has to come back meanwhile
};

// The projector itself.
class Pretended {
  public:
    explicit Pretended(Habit habit) : habit_{std::move(habit)} {}

    PjlinkReply answer(const std::string& command, double now) {
        tick(now);
        ++heard_;
        if (now >= habit_.goneFrom && now < habit_.goneTo) return {PjlinkEnd::Unreachable};
        if (habit_.end == PjlinkEnd::Unreachable || habit_.end == PjlinkEnd::Refused)
            return {habit_.end};
        const std::string value = valueOf(command.substr(2), now);
        if (habit_.end == PjlinkEnd::Unanswered || value.empty()) return {PjlinkEnd::Unanswered};
        return {PjlinkEnd::Answered, value};
    }
    // Off, warming, shut, open, cooling.
    char stateAt(double now) {
        tick(now);
        if (power_ != '1') return power_ == '0' ? '.' : power_ == '3' ? 'w' : 'c';
        return shut_ ? 's' : 'o';
    }
    [[nodiscard]] const std::string& input() const { return input_; }
    [[nodiscard]] int heard() const { return heard_; }
    [[nodiscard]] const Habit& habit() const { return habit_; }

  private:
    void tick(double now) {
        if (power_ == '3' && now - since_ >= habit_.warmSeconds) {
            power_ = '1';
            shut_ = habit_.comesOnShut;
            input_ = habit_.comesOnInput;
        }
        if (power_ == '2' && now - since_ >= habit_.coolSeconds) power_ = '0';
        if (now >= habit_.goneFrom && now < habit_.goneTo) power_ = '0';
        if (habit_.byHand) habit_.byHand(now, power_, shut_);
    }
    std::string valueOf(const std::string& command, double now) {
        const bool changes = power_ == '2' || power_ == '3';
        for (const auto& [says, holds] : {std::pair{&habit_.always, true},
                                          std::pair{&habit_.inStandby, power_ == '0'},
                                          std::pair{&habit_.whileItChanges, changes}})
            if (holds && says->contains(command)) {
                if (says->at(command) == "OK") obey(command, now);
                return says->at(command);
            }
        if (command == "POWR ?") return {power_};
        if (command == "ERST ?") return "000000";
        if (command == "LAMP ?") return "1234 1";
        if (command.starts_with("POWR ")) return obey(command, now);
        if (power_ != '1') return "ERR3";
        if (command == "AVMT ?") return shut_ ? "31" : "30";
        if (command == "INPT ?") return input_;
        return obey(command, now);
    }
    std::string obey(const std::string& command, double now) {
        if (ignored_[command.substr(0, 6)]++ < habit_.ignored) return "OK";
        if (command == "POWR 1" && power_ == '0') power_ = '3', since_ = now;
        if (command == "POWR 0" && power_ == '1') power_ = '2', since_ = now;
        if (power_ == '1' && command.starts_with("AVMT")) shut_ = command.back() == '1';
        if (power_ == '1' && command.starts_with("INPT")) input_ = command.substr(5);
        return "OK";
    }

    Habit habit_;
    char power_ = '0';
    bool shut_ = false;
    std::string input_ = "11";
    double since_ = -1e6;
    int heard_ = 0;
    std::map<std::string, int> ignored_;
};

// As ProjectorWatch, in time that is told.
class Quickened final : public SwitchedProjector {
  public:
    Quickened(Pretended& pretended, const std::string& input)
        : pretended_{pretended}, control_{input, true} {}
    void want(std::optional<bool> power, std::optional<bool> shut) override {
        control_.want(power, shut);
    }
    void release() override { control_.release(); }
    [[nodiscard]] ProjectorFacts facts() const override { return control_.facts(); }

    void advance(double until) {
        for (int steps = 0; now_ < until; ++steps) {
            ASSERT_LT(steps, 1000) << "it never rests: " << pretended_.habit().name;
            if (!asked_.empty()) {
                if (answeredAt_ > until) return;
                now_ = answeredAt_;
                control_.heard(std::exchange(asked_, {}), reply_, now_);
            }
            const ProjectorStep step = control_.next(now_);
            if (step.command.empty()) {
                ASSERT_GT(step.until, now_);
                now_ = std::min(step.until, until);
            } else {
                ask(step.command);
            }
        }
    }

  private:
    void ask(const std::string& command) {
        constexpr double kSilence = 10, kNobody = 3;
        asked_ = command;
        reply_ = pretended_.answer(command, now_);
        answeredAt_ = now_ + (reply_.end == PjlinkEnd::Answered ? pretended_.habit().answerSeconds
                              : reply_.end == PjlinkEnd::Unanswered ? kSilence
                                                                    : kNobody);
    }
    Pretended& pretended_;
    ProjectorControl control_;
    double now_ = 0, answeredAt_ = 0;
    std::string asked_;
    PjlinkReply reply_;
};

// Two days of a hall with an odd projector and a plain one.
struct TwoDays {
    std::string odd;                  // a letter a minute
    std::string plainTicks;           // of the plain one, a letter each ten seconds
    std::vector<std::string> inputs;  // of the odd one, each minute
    ProjectorFacts facts;             // of the odd one, at two o'clock on the first day
    int mostHeardInAnHour = 0;
};

TwoDays run(const Habit& habit) {
    const fs::path folder =
        fs::temp_directory_path() / ("aquarama-projectors-" + std::to_string(getpid()));
    fs::create_directories(folder);
    TwoDays days;
    {
        Pretended odd{habit}, plain{{.name = "plain"}};
        std::vector<Quickened*> hall;
        const auto make = [&](const config::ControlledProjector& one) {
            auto made = std::make_unique<Quickened>(one.name == "odd" ? odd : plain, one.input);
            hall.push_back(made.get());
            return made;
        };
        Opening opening(folder, make, {});
        opening.setText(kHoursText);
        constexpr double kTick = 10;
        int heardBefore = 0;
        for (double now = kTick; now < 2 * kProjectorDay; now += kTick) {
            if (const auto due = opening.due(kThursday + now)) opening.done(*due, kThursday + now);
            opening.switchProjectors(kThursday + now, true);
            for (Quickened* one : hall) one->advance(now);
            days.plainTicks += plain.stateAt(now);
            if (now == 14 * kProjectorHour) days.facts = hall[0]->facts();
            if (std::fmod(now, kProjectorHour) == 0)
                days.mostHeardInAnHour = std::max(
                    days.mostHeardInAnHour, odd.heard() - std::exchange(heardBefore, odd.heard()));
            if (std::fmod(now, kMinute) != 0) continue;
            days.odd += odd.stateAt(now);
            days.inputs.push_back(odd.input());
        }
    }
    fs::remove_all(folder);
    return days;
}

// "00:01 . 09:58 w 09:59 s 10:00 o": where a timeline changes.
std::string changesIn(const std::string& minutes) {
    std::string text;
    for (std::size_t i = 0; i < minutes.size(); ++i) {
        if (i > 0 && minutes[i] == minutes[i - 1]) continue;
        const int minute = static_cast<int>(i) + 1;
        char clock[32];
        snprintf(clock, sizeof clock, "%02d:%02d %c ", minute / 60, minute % 60, minutes[i]);
        text += clock;
    }
    return text;
}

// Holds each minute of two days to what the hours want. A minute's letter is of its first moment.
void expectHours(const std::string& minutes, const Habit& habit) {
    const auto where = [&](std::size_t i) {
        return habit.name + " in minute " + std::to_string(i + 1) + " of " + changesIn(minutes);
    };
    for (std::size_t i = 0; i < minutes.size(); ++i) {
        const double now = (static_cast<double>(i) + 1) * kMinute,
                     ofDay = std::fmod(now, kProjectorDay);
        const bool isExcused = now >= habit.excusedFrom && now < habit.excusedTo;
        const bool isLit = minutes[i] == 'o';
        if (ofDay >= kOpens + habit.lightWithin && ofDay < kCloses && !isExcused) {
            ASSERT_EQ(isLit, !habit.isNeverLit) << "light: " << where(i);
        }
        const bool mayBeLit = (ofDay >= kOpens && ofDay < kCloses + habit.darkWithin) ||
                              (habit.cannotShut && ofDay >= kOpens - 3 * kMinute);
        if (!mayBeLit) {
            ASSERT_FALSE(isLit) << "darkness: " << where(i);
        }
        const double lampOff = kCloses + habit.darkWithin + habit.coolSeconds + kMinute;
        if (ofDay >= lampOff || (ofDay > 0 && ofDay < kOpens - 4 * kMinute)) {
            ASSERT_EQ(minutes[i], '.') << "no lamp: " << where(i);
        }
    }
}

std::vector<Habit> errorsOnEachQuery() {
    std::vector<Habit> habits;
    for (const std::string query : {"POWR ?", "AVMT ?", "ERST ?", "LAMP ?", "INPT ?"})
        for (const std::string value : {"ERR1", "ERR2", "ERR3", "ERR4", "", "?", "99"}) {
            Habit habit{.name = query + " " + value, .always = {{query, value}}};
            // Light waits for a lamp that does not say that it is on, as for one that is off.
            if (query == "POWR ?") habit.lightWithin = 4 * kMinute;
            habits.push_back(habit);
        }
    return habits;
}

const Says kNotNow{{"POWR ?", "ERR3"},
                   {"AVMT ?", "ERR3"},
                   {"ERST ?", "ERR3"},
                   {"LAMP ?", "ERR3"},
                   {"INPT ?", "ERR3"}};
const Says kSilent{{"POWR ?", ""},
                   {"AVMT ?", ""},
                   {"ERST ?", ""},
                   {"LAMP ?", ""},
                   {"INPT ?", ""},
                   {"POWR 1", ""},
                   {"POWR 0", ""},
                   {"AVMT 30", ""},
                   {"AVMT 31", ""}};

std::vector<Habit> habits() {
    std::vector<Habit> all{
        {.name = "plain"},
        {.name = "warms for 90 s, cools for 3 min", .warmSeconds = 90, .coolSeconds = 180},
        {.name = "warms for 170 s", .warmSeconds = 170},
        {.name = "warms for 5 min", .warmSeconds = 300, .lightWithin = 4 * kMinute},
        {.name = "answers after 3 s", .answerSeconds = 3},
        {.name = "answers after 8 s", .answerSeconds = 8},
        {.name = "answers after 8 s, cannot be asked for its shutter",
         .answerSeconds = 8,
         .always = {{"AVMT ?", "ERR1"}}},
        {.name = "ERR3 in standby", .inStandby = kNotNow},
        {.name = "ERR3 while it warms and cools", .warmSeconds = 90, .whileItChanges = kNotNow},
        {.name = "ERR3 unless it is on",
         .warmSeconds = 90,
         .inStandby = kNotNow,
         .whileItChanges = kNotNow},
        {.name = "ERR3 to POWR 0 in standby",
         .inStandby = {{"POWR ?", "ERR3"}, {"POWR 0", "ERR3"}}},
        {.name = "silent while it warms and cools", .warmSeconds = 60, .whileItChanges = kSilent},
        {.name = "cannot be asked for anything but its power",
         .always =
             {{"AVMT ?", "ERR1"}, {"ERST ?", "ERR1"}, {"LAMP ?", "ERR1"}, {"INPT ?", "ERR1"}}},
        {.name = "cannot be asked for anything",
         .always = {{"POWR ?", "ERR1"},
                    {"AVMT ?", "ERR1"},
                    {"ERST ?", "ERR1"},
                    {"LAMP ?", "ERR1"},
                    {"INPT ?", "ERR1"}},
         .lightWithin = 4 * kMinute},
        {.name = "answers no question, and obeys",
         .end = PjlinkEnd::Unanswered,
         .lightWithin = 5 * kMinute,
         .cannotShut = true},  // not within a minute of its coming on
        {.name = "cannot be shut",
         .always =
             {{"AVMT 30", "ERR1"}, {"AVMT 31", "ERR1"}, {"AVMT 10", "ERR1"}, {"AVMT 11", "ERR1"}},
         .cannotShut = true},
        {.name = "mutes the picture alone", .always = {{"AVMT 30", "ERR2"}, {"AVMT 31", "ERR2"}}},
        {.name = "comes on shut", .comesOnShut = true},
        {.name = "comes on shut, and cannot be asked",
         .always = {{"AVMT ?", "ERR3"}},
         .comesOnShut = true},
        {.name = "says OK and does nothing, once", .ignored = 1},
        {.name = "says OK and does nothing, three times",
         .ignored = 3,
         .lightWithin = 3 * kMinute,
         .darkWithin = 3 * kMinute,
         .cannotShut = true},
        {.name = "says OK once without doing it, and cannot be asked for its shutter",
         .always = {{"AVMT ?", "ERR1"}},
         .ignored = 1},
        {.name = "is gone", .end = PjlinkEnd::Unreachable, .isNeverLit = true},
        {.name = "has another password", .end = PjlinkEnd::Refused, .isNeverLit = true},
        {.name = "has no current for ten minutes",
         .goneFrom = 14 * kProjectorHour + 30,
         .goneTo = 14 * kProjectorHour + 630,
         .excusedFrom = 14 * kProjectorHour,
         .excusedTo = 14 * kProjectorHour + 12 * kMinute},
        {.name = "has no current at the opening",
         .goneFrom = 9.5 * kProjectorHour,
         .goneTo = 10 * kProjectorHour + 600,
         .excusedFrom = 9.5 * kProjectorHour,
         .excusedTo = 10 * kProjectorHour + 12 * kMinute},
        {.name = "has an input that it does not tell", .always = {{"INPT ?", "ERR1"}}},
        {.name = "falls into standby by itself at three",
         .byHand =
             [done = false](double now, char& power, bool&) mutable {
                 if (now > 15 * kProjectorHour - 20 && !std::exchange(done, true)) power = '0';
             },
         .excusedFrom = 15 * kProjectorHour - 30,
         .excusedTo = 15 * kProjectorHour + 2 * kMinute},
    };
    for (Habit& habit : errorsOnEachQuery()) all.push_back(std::move(habit));
    return all;
}

TEST(Projectors, aPlainOneIsOnOpenAndShutToTheMinute) {
    const TwoDays days = run({.name = "plain", .warmSeconds = 50, .coolSeconds = 100});
    EXPECT_EQ(changesIn(days.odd),
              "00:01 . 09:57 w 09:58 s 10:00 o 18:00 c 18:02 . "
              "33:57 w 33:58 s 34:00 o 42:00 c 42:02 . ");
    EXPECT_EQ(days.facts.power, LampPower::On);
    EXPECT_EQ(days.facts.isShut, false);
    EXPECT_EQ(days.facts.lampHours, 1234U);
    EXPECT_EQ(days.facts.input, "31");
    EXPECT_TRUE(days.facts.areProblemsKnown);
}

// All habits, run once.
const std::vector<std::pair<Habit, TwoDays>>& allDays() {
    static const std::vector<std::pair<Habit, TwoDays>> all = [] {
        std::vector<std::pair<Habit, TwoDays>> days;
        for (const Habit& habit : habits()) days.emplace_back(habit, run(habit));
        return days;
    }();
    return all;
}

TEST(Projectors, eachHabitIsLitInOpenedMinutesAndInNoOther) {
    for (const auto& [habit, days] : allDays()) {
        expectHours(days.odd, habit);
        for (std::size_t i = 0; i < days.odd.size(); ++i) {
            const double ofDay = std::fmod((static_cast<double>(i) + 1) * kMinute, kProjectorDay);
            if (days.odd[i] == 'o' && ofDay >= kOpens + 8 * kMinute && ofDay < kCloses) {
                ASSERT_EQ(days.inputs[i], "31") << habit.name << " in minute " << i + 1;
            }
        }
        if (HasFatalFailure()) return;
    }
}

// To the tick of ten seconds, as beside another plain one.
TEST(Projectors, noneDelaysAnother) {
    const TwoDays beside = run({.name = "plain"});
    for (const auto& [habit, days] : allDays())
        EXPECT_EQ(days.plainTicks, beside.plainTicks) << "beside: " << habit.name;
}

// Looks of five questions, every twenty seconds, and every ten for some minutes.
TEST(Projectors, itIsAskedAndToldAtASlowPace) {
    constexpr int kMost = 3600 / 20 * 5 + 200;
    for (const auto& [habit, days] : allDays())
        EXPECT_LE(days.mostHeardInAnHour, kMost) << habit.name;
}

TEST(Projectors, whatIsNotToldIsUnknownAndWhatIsLackingHasAName) {
    for (const auto& [habit, days] : allDays()) {
        const auto isAlways = [&](const char* query) { return habit.always.contains(query); };
        const std::string name = habit.name;
        if (isAlways("AVMT ?")) {
            EXPECT_FALSE(days.facts.isShut) << name;
        }
        if (isAlways("POWR ?")) {
            EXPECT_EQ(days.facts.power, LampPower::Unknown) << name;
        }
        if (isAlways("INPT ?") && habit.always.at("INPT ?") != "99") {
            EXPECT_FALSE(days.facts.input) << name;
        }
        if (isAlways("ERST ?")) {
            EXPECT_FALSE(days.facts.areProblemsKnown) << name;
        }
        if (isAlways("LAMP ?") && habit.always.at("LAMP ?") != "99") {
            EXPECT_FALSE(days.facts.lampHours) << name;
        }
        for (const auto& [query, value] : habit.always)
            if (value == "ERR4") {
                EXPECT_EQ(days.facts.problems.size(), 1U) << name;
            }
    }
}

// The last answer of a projector that is out of reach is not what it is now.
TEST(Projectors, oneOutOfReachIsUnknownInAllThings) {
    for (const auto& [end, hasPassword, reach] :
         {std::tuple{PjlinkEnd::Unreachable, true, ProjectorReach::NoAnswer},
          {PjlinkEnd::Refused, true, ProjectorReach::RefusesPassword},
          {PjlinkEnd::Refused, false, ProjectorReach::WantsPassword}}) {
        ProjectorControl control("31", hasPassword);
        control.heard("%1POWR ?", {PjlinkEnd::Answered, "1"}, 1);
        control.heard("%1AVMT ?", {PjlinkEnd::Answered, "31"}, 1);
        control.heard("%1LAMP ?", {PjlinkEnd::Answered, "7 1"}, 1);
        EXPECT_EQ(control.facts().isShut, true);
        control.heard("%1POWR ?", {end}, 21);
        EXPECT_EQ(control.facts(), ProjectorFacts{.reach = reach});
    }
}

// The next command after so many seconds, where each question is answered by ERR3.
std::string nextCommand(ProjectorControl& control, double& now) {
    for (int i = 0; i < 100; ++i) {
        const ProjectorStep step = control.next(now);
        if (step.command.empty())
            now = step.until;
        else if (step.command.ends_with("?"))
            control.heard(step.command, {PjlinkEnd::Answered, "ERR3"}, now);
        else
            return step.command;
    }
    return "none";
}

TEST(Projectors, aPowerThatIsNotConfirmedIsWantedAgainAfterTenSecondsThenAfterThirtyThenAMinute) {
    ProjectorControl control;
    control.want(true, std::nullopt);
    double now = 100;
    std::vector<int> at;
    for (int i = 0; i < 16; ++i) {
        ASSERT_EQ(nextCommand(control, now), "%1POWR 1");
        at.push_back(static_cast<int>(now) - 100);
        control.heard("%1POWR 1", {PjlinkEnd::Answered, "ERR3"}, now);
    }
    EXPECT_EQ(at[0], 0);
    EXPECT_EQ(at[1], 10);
    EXPECT_EQ(at[2], 40);
    EXPECT_EQ(at[15] - at[14], 60);
}

// An input that there is not is named; and one that people choose later holds.
TEST(Projectors, anInputIsChosenOnceAfterItHasComeOn) {
    ProjectorControl control("3A");
    control.want(true, std::nullopt);
    double now = 1;
    const auto say = [&](const std::string& value) {
        const std::string command = control.next(now).command;
        control.heard(command, {PjlinkEnd::Answered, value}, now);
        return command;
    };
    EXPECT_EQ(say("1"), "%1POWR ?");
    EXPECT_EQ(say("11"), "%2INPT ?") << "letters are of class 2";
    EXPECT_EQ(say("ERR2"), "%2INPT 3A");
    EXPECT_EQ(control.facts().problems,
              std::vector<std::string>{"input 3A: the projector has none of that code"});
    EXPECT_EQ(control.facts().input, "11");
    const auto hear = [&](const std::string& input) {
        std::string commands;
        for (const double end = now + 400; now < end; now += 1) {
            const ProjectorStep step = control.next(now);
            if (step.command.empty()) continue;
            const std::string name = step.command.substr(2, 6);
            control.heard(step.command,
                          {PjlinkEnd::Answered,
                           name == "POWR ?"   ? "1"
                           : name == "INPT ?" ? input
                                              : "OK"},
                          now);
            if (!step.command.ends_with("?")) commands += step.command + " ";
        }
        return commands;
    };
    EXPECT_TRUE(hear("11").starts_with("%2INPT 3A ")) << "tried again, seldom";
    EXPECT_EQ(hear("3A"), "");
    EXPECT_TRUE(control.facts().problems.empty());
    EXPECT_EQ(hear("12"), "") << "by hand";
}

TEST(Projectors, whileTheScheduleRestsNothingIsSaid) {
    ProjectorControl control("31");
    control.want(true, false);
    control.release();
    double now = 1;
    EXPECT_EQ(nextCommand(control, now), "none");
    control.want(false, std::nullopt);
    EXPECT_EQ(nextCommand(control, now), "%1POWR 0");
}

}  // namespace
}  // namespace aquarama::console
