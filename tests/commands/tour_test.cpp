// SPDX-License-Identifier: Apache-2.0
// Each step of a tour judges by what is there; its time is that of the work, without pauses; and
// what it keeps survives.
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "commands/tour_findings.h"
#include "commands/tour_record.h"
#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama {
namespace {

using testing::HasSubstr;

const std::string kConfig = std::string(AQUARAMA_SOURCE_DIR) + "/config/";
constexpr const char* kRig = "hall.txtpb";
constexpr double kNow = 1'800'000'000;

config::Rig desk() {
    return config::parseRig(config::readTextFile(kConfig + "desk.txtpb"), "desk.txtpb");
}

// A master with these nodes, each on the machine of its name's second word; "-": has said nothing.
MasterAnswer masterWith(const std::vector<std::pair<std::string, std::string>>& nodes) {
    MasterAnswer master{.status = v1::StatusReply{}};
    for (const auto& [name, host] : nodes) {
        v1::NodeStatus& node = *master.status->add_nodes();
        node.set_name(name);
        node.set_condition(host == "-" ? v1::NODE_ABSENT : v1::NODE_IN_STEP);
        if (host != "-") node.mutable_report()->set_host(host);
    }
    return master;
}

TEST(TourScreen, asItWasShippedIsToBeConfirmedAndAnotherSizeIsMeasured) {
    config::Rig rig = desk();
    const std::vector<std::pair<std::string, std::string>> shipped{{"desk.txtpb", textOf(rig)}};
    const StepFinding same = lookAtScreen(rig, shipped);
    EXPECT_EQ(same.state, StepState::ToConfirm);
    EXPECT_EQ(same.what,
              "cylinder, radius 2.620 m, arc 120.0 degrees, 2.438 m high, as in desk.txtpb of the "
              "programs");
    rig.screen.heightMetres += 0.01;
    EXPECT_EQ(lookAtScreen(rig, shipped).state, StepState::Done);
}

TEST(TourScreen, everyShapeIsSaid) {
    for (const auto& [file, said] : {std::pair{"flat_3.txtpb", "flat, "},
                                     {"dome_5.txtpb", "dome, radius "},
                                     {"televisions_3.txtpb", "panels, 1."},
                                     {"measured_3.txtpb", "measured, canvas.obj"}})
        EXPECT_THAT(textOf(config::parseRig(config::readTextFile(kConfig + file), file)),
                    testing::StartsWith(said));
}

TEST(TourMachines, theAbsentAreNamed) {
    EXPECT_EQ(lookAtMachines(kRig, {}).what, "no show runs");
    EXPECT_EQ(lookAtMachines(kRig, {.preparing = "the master prepares: reef"}).what,
              "the master prepares: reef");
    EXPECT_EQ(lookAtMachines(kRig, {.problem = "operator.key: is not there"}).what,
              "operator.key: is not there");
    MasterAnswer master = masterWith({{"left", "a"}, {"middle", "b"}, {"right", "-"}});
    master.status->mutable_nodes(2)->set_machine("right-pc");
    const StepFinding finding = lookAtMachines(kRig, master);
    EXPECT_EQ(finding.state, StepState::ToDo);
    EXPECT_EQ(finding.what, "2 of 3 nodes; absent: right of right-pc");
    EXPECT_EQ(lookAtMachines(kRig, masterWith({{"left", "a"}})).state, StepState::Done);
}

TEST(TourChannels, aNodeOnAnotherMachineThanTheRigNamesIsToBeConfirmed) {
    MasterAnswer master = masterWith({{"left", "Left-PC.hall.example"}, {"middle", "main"}});
    master.status->mutable_nodes(0)->set_machine("left-pc");
    const StepFinding right = lookAtChannels(kRig, master, {}, "main");
    EXPECT_EQ(right.state, StepState::Done) << right.what;
    EXPECT_EQ(right.what, "left on Left-PC.hall.example; middle on main");
    const StepFinding wrong = lookAtChannels(kRig, master, {}, "other");
    EXPECT_EQ(wrong.state, StepState::ToConfirm);
    EXPECT_EQ(wrong.what, "middle on main, not on other");
}

TEST(TourChannels, aKeyThatIsMissingComesFirst) {
    const std::vector<std::string> problems{"left.key: is not there"};
    const StepFinding finding = lookAtChannels(kRig, masterWith({{"left", "a"}}), problems, "a");
    EXPECT_EQ(finding.state, StepState::ToDo);
    EXPECT_EQ(finding.what, "left.key: is not there");
    EXPECT_THAT(finding.todo, HasSubstr("aquarama keys new hall.txtpb"));
}

TEST(TourDoctor, faultsAreNamedAndWithoutAShowNothingIsProved) {
    Findings findings;
    findings.pass("rig", "good");
    EXPECT_EQ(lookAtHealth(kRig, findings).what, "no show runs");
    findings.pass("show", "runs");
    findings.judge(false, Verdict::Warn, "disk", "small", "make room");
    EXPECT_EQ(lookAtHealth(kRig, findings).state, StepState::Done);
    EXPECT_EQ(lookAtHealth(kRig, findings).what, "no fault, 1 warning: aquarama doctor hall.txtpb");
    findings.fail("node left", "absent");
    EXPECT_EQ(lookAtHealth(kRig, findings).state, StepState::ToDo);
    EXPECT_EQ(lookAtHealth(kRig, findings).what, "node left: absent");
}

TEST(TourFocus, needsAWallThatIsNotBlackUntilItIsConfirmed) {
    const config::Rig rig = desk();
    MasterAnswer master = masterWith({{"left", "a"}});
    const StepFinding asks = lookAtFocus(kRig, rig, master, "");
    EXPECT_EQ(asks.state, StepState::ToConfirm);
    EXPECT_EQ(lookAtFocus(kRig, rig, {}, "").state, StepState::ToDo);
    EXPECT_EQ(lookAtFocus(kRig, rig, {}, asks.what).state, StepState::Done);
    EXPECT_EQ(lookAtFocus(kRig, rig, {}, "grid on left").state, StepState::ToDo)
        << "other channels were confirmed";
    master.status->mutable_show()->set_black(true);
    EXPECT_EQ(lookAtFocus(kRig, rig, master, "").what, "the wall is black");
}

TEST(TourCalibration, theVerdictOfTheOneInUseCounts) {
    config::Rig rig = desk();
    EXPECT_EQ(lookAtCalibration(kRig, rig, {}).state, StepState::ToDo);
    EXPECT_THAT(lookAtCalibration(kRig, rig, {}).todo,
                HasSubstr("aquarama calibrate --rig hall.txtpb"));
    rig.calibration = "hall.mpcdi";
    EXPECT_EQ(lookAtCalibration(kRig, rig, {}).state, StepState::ToConfirm) << "of another program";
    std::vector<FileVersion> kept{
        {.name = "2026-11-24T210301", .path = {}, .note = R"({"verdict": "pass"})"},
        {.name = "2026-11-23T210301",
         .path = {},
         .note = R"({"verdict": "warn"})",
         .isInUse = true}};
    EXPECT_EQ(lookAtCalibration(kRig, rig, kept).state, StepState::ToConfirm);
    EXPECT_EQ(lookAtCalibration(kRig, rig, kept).what, "calibrated at 2026-11-23T210301 UTC: warn");
    std::swap(kept[0].isInUse, kept[1].isInUse);
    EXPECT_EQ(lookAtCalibration(kRig, rig, kept).state, StepState::Done);
    rig.screen.shape = config::ScreenShape::Panels;
    EXPECT_EQ(lookAtCalibration(kRig, rig, {}).state, StepState::Done);
}

TEST(TourHours, theNextChangeIsSaid) {
    EXPECT_EQ(lookAtHours(kRig, std::nullopt, 0).state, StepState::ToConfirm);
    const auto hours = config::parseHours(
        R"(zone: "UTC" open { days: [SUNDAY] from: "10:00" to: "18:00" })", "hours.txtpb");
    constexpr long long kSaturday = 1'795'910'400;  // 2026-11-28 24:00 UTC
    const StepFinding finding = lookAtHours(kRig, hours, kSaturday - 60);
    EXPECT_EQ(finding.state, StepState::Done);
    EXPECT_EQ(finding.what, "now closed; 2026-11-29 10:00 +00:00 Sunday: open");
    const auto never = config::parseHours(R"(zone: "UTC")", "hours.txtpb");
    EXPECT_EQ(lookAtHours(kRig, never, kSaturday).state, StepState::ToConfirm);
}

TEST(TourBackup, aCopyOfTheHallAsItIsNowOnAnotherDisk) {
    BackupFacts facts;
    EXPECT_EQ(lookAtBackup(kRig, facts, 0).what, "no folder is named");
    facts = {.file = "/media/stick/hall.aqhall", .hallChangedAt = kNow};
    EXPECT_EQ(lookAtBackup(kRig, facts, 0).todo,
              "aquarama hall export hall.txtpb /media/stick/hall.aqhall");
    facts.writtenAt = kNow - 1;  // FAT keeps two seconds
    EXPECT_EQ(lookAtBackup(kRig, facts, 0).state, StepState::Done);
    facts.isOnDiskOfRig = true;
    EXPECT_EQ(lookAtBackup(kRig, facts, 0).state, StepState::ToConfirm);
    facts.hallChangedAt = kNow + 60;
    EXPECT_THAT(lookAtBackup(kRig, facts, 0).what, HasSubstr("has changed since"));
    facts = {.file = "/media/stick/hall.aqhall", .hallChangedAt = kNow};
    EXPECT_EQ(lookAtBackup(kRig, facts, kNow).state, StepState::Done) << "the stick is out";
    EXPECT_EQ(lookAtBackup(kRig, facts, kNow - 60).state, StepState::ToDo) << "and is too old";
}

TEST(TourRecord, theTimeOfAStepIsThatOfTheWork) {
    StepRecord step;
    noteLook(step, kNow, false);
    noteLook(step, kNow + 100, false);
    EXPECT_EQ(step.seconds, 100);
    noteLook(step, kNow + 100 + kLongestWork + 1, false);  // left for the night
    noteLook(step, kNow + 50, false);                      // a clock that was put back
    EXPECT_EQ(step.seconds, 100);
    noteLook(step, kNow + 60, true);
    EXPECT_EQ(step.seconds, 110);
    EXPECT_EQ(step.doneAt, kNow + 60);
    noteLook(step, kNow + 70, true);
    EXPECT_EQ(step.seconds, 110) << "what is done takes no time";
    noteLook(step, kNow + 80, false);
    EXPECT_EQ(step.doneAt, 0);
}

TEST(TourRecord, comesBackFromItsFile) {
    const TemporaryFolder folder("tour");
    const auto file = folder.path() / "hall.tour.json";
    EXPECT_TRUE(readTour(file).steps.empty());
    TourRecord record{.backupFolder = "/media/stick", .backupWrittenAt = kNow};
    record.steps["screen"] = {
        .seconds = 12.5, .lookedAt = kNow, .doneAt = kNow, .confirmed = "flat"};
    keepTour(file, record);
    const TourRecord back = readTour(file);
    EXPECT_EQ(back.backupFolder, "/media/stick");
    EXPECT_EQ(back.backupWrittenAt, kNow);
    EXPECT_EQ(back.steps.at("screen").seconds, 12.5);
    EXPECT_EQ(back.steps.at("screen").confirmed, "flat");
    const std::string cut = R"({"steps": {"screen")";
    writeWhole(file, std::as_bytes(std::span(cut)));
    EXPECT_THROW(static_cast<void>(readTour(file)), Error);
}

}  // namespace
}  // namespace aquarama
