// SPDX-License-Identifier: Apache-2.0
// A release is copied in pieces, also after cuts; what is not as it was signed is refused by name.
#include "releases/copy.h"

#include <filesystem>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "releases/boot.h"
#include "releases/messages.h"
#include "releases/shelf.h"
#include "releases/signing.h"

namespace aquarama::releases {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const ReleaseId kRunning{"1.0", 6};

void write(const fs::path& file, const std::string& text) {
    writeWhole(file, std::as_bytes(std::span(text)));
}

class Copying : public testing::Test {
  protected:
    Copying() {
        write(from_ / "vmlinuz", "kernel");
        write(from_ / "empty", "");
        write(from_ / "filesystem.squashfs", std::string(1'000'000, 's'));
        id_ = signRelease(from_, 7, keys_.secretPem, "show.key").id;
    }

    // As the depot answers.
    void give(ReleaseCopy& copy) {
        const WantedPiece place = *copy.wanted();
        const fs::path file = depot_ / place.version / place.file;
        if (!fs::exists(file)) return copy.take({place, std::nullopt, {}});
        const auto bytes = readWhole(file, 10'000'000);
        const auto rest =
            std::span(bytes).subspan(std::min<std::size_t>(place.offset, bytes.size()));
        copy.take({place, bytes.size(), rest.first(std::min(rest.size(), kPieceBytes))});
    }
    ReleaseCopy begun() const { return {id_, running_, to_, {keys_.publicPem, "show.pub"}}; }
    // To its end; what it is refused for, or empty.
    std::string refusal() {
        try {
            ReleaseCopy copy = begun();
            for (int pieces = 0; copy.wanted() && pieces < 100; ++pieces) give(copy);
            return copy.wanted() ? "it never ends" : "";
        } catch (const Error& error) {
            return error.what();
        }
    }
    bool isWhole() const {
        try {
            return checkRelease(to_, {keys_.publicPem, "show.pub"}).id == id_;
        } catch (const Error&) {
            return false;
        }
    }

    TemporaryFolder temporary_{"copy_test"};
    fs::path depot_ = temporary_.path() / "depot";
    fs::path from_ = depot_ / "1.1", to_ = temporary_.path() / "system/aquarama/1.1";
    SigningKeys keys_ = makeSigningKeys();
    ReleaseId id_, running_ = kRunning;
};

TEST_F(Copying, endsWithTheSameRelease) {
    EXPECT_EQ(refusal(), "");
    EXPECT_TRUE(isWhole());
}

// After each number of pieces; what came before the cut is not asked for again.
TEST_F(Copying, goesOnAfterACut) {
    for (int pieces = 0; pieces < 8; ++pieces) {
        fs::remove_all(to_);
        ReleaseCopy cut = begun();
        for (int i = 0; i < pieces; ++i) give(cut);
        EXPECT_FALSE(isWhole());
        EXPECT_EQ(refusal(), "");
        EXPECT_TRUE(isWhole());
    }
    fs::remove(to_ / kListFile);
    fs::resize_file(to_ / "filesystem.squashfs", 600'000);
    ReleaseCopy copy = begun();
    for (int i = 0; i < 3; ++i) give(copy);
    EXPECT_EQ(copy.wanted(), (WantedPiece{"1.1", "filesystem.squashfs", 600'000}));
}

// A power cut may leave zeros where bytes were written, or more than there should be.
TEST_F(Copying, startsAFileAnewThatACutHasDamaged) {
    write(to_ / "filesystem.squashfs", std::string(600'000, '\0'));
    write(to_ / "vmlinuz", "a longer kernel");
    write(to_ / "initrd.img", "of another release");
    EXPECT_EQ(refusal(), "");
    EXPECT_TRUE(isWhole());
}

TEST_F(Copying, refusesWhatTheDepotHasChanged) {
    write(from_ / "vmlinuz", "kernem");
    EXPECT_THAT(refusal(), HasSubstr("release 1.1: vmlinuz was changed or cut"));
    write(from_ / "vmlinuz", "kerne");
    EXPECT_THAT(refusal(), HasSubstr("release 1.1: vmlinuz was changed or cut"));
    fs::remove(from_ / "vmlinuz");
    EXPECT_THAT(refusal(), HasSubstr("release 1.1: vmlinuz is not in the depot"));
    write(from_ / kListFile, "# aquarama release 1.1 8\n");
    EXPECT_THAT(refusal(), HasSubstr("release 1.1: SHA256SUMS: is not signed by the key"));
    fs::remove(from_ / kListFile);
    EXPECT_THAT(refusal(), HasSubstr("release 1.1: SHA256SUMS is not in the depot"));
    EXPECT_FALSE(isWhole());
}

TEST_F(Copying, refusesADowngradeAndAnotherRelease) {
    running_ = {"1.2", 7};
    EXPECT_THAT(refusal(), HasSubstr("release 1.1: is older (serial 7) than serial 8"));
    running_ = kRunning;
    id_.serial = 9;
    EXPECT_THAT(refusal(), HasSubstr("release 1.1: SHA256SUMS is of release 1.1, serial 7"));
    EXPECT_FALSE(fs::exists(to_));
}

TEST_F(Copying, ignoresPiecesThatItDoesNotWant) {
    ReleaseCopy copy = begun();
    give(copy);
    const std::string content = "kernel";
    copy.take({{"1.1", "vmlinuz", 0}, 6, std::as_bytes(std::span(content))});
    EXPECT_EQ(copy.wanted()->file, kSignatureFile);
}

TEST_F(Copying, refusesMoreThanAFileMayHave) {
    ReleaseCopy copy = begun();
    for (int i = 0; i < 2; ++i) give(copy);
    EXPECT_THROW(copy.take({*copy.wanted(), kMostReleaseFileBytes + 1, {}}), Error);
}

// Each message survives its packet; none of its beginnings does that breaks a rule.
TEST(DepotMessages, comeBackFromTheirPackets) {
    const MachineReport report{.booted = {"1.0", 10},
                               .epoch = 5,
                               .held = {{"1.0", 10}, {"1.1", 11}},
                               .frames = 600,
                               .leftIn = 4,
                               .problem = "no room"};
    v1::DepotMessage message;
    write(report, *message.mutable_report());
    const auto heard = decode(encode(message));
    ASSERT_TRUE(heard && heard->has_report());
    const MachineReport same = reportIn(heard->report());
    EXPECT_EQ(same.booted, report.booted);
    EXPECT_EQ(same.held, report.held);
    EXPECT_EQ(std::tuple(same.epoch, same.frames, same.leftIn, same.problem),
              std::tuple(5U, 600U, 4U, "no room"));
    const MachineOrder order{
        .epoch = 5, .run = {"1.0", 10}, .isSettled = true, .mayShow = true, .fetch = {"1.1", 11}};
    write(order, *message.mutable_order());
    EXPECT_FALSE(decode(encode(message))) << "without a lease";
    message.mutable_order()->set_lease_s(60);
    const MachineOrder told = orderIn(decode(encode(message))->order());
    EXPECT_EQ(std::tuple(told.epoch, told.run, told.isSettled, told.mayShow, told.fetch),
              std::tuple(order.epoch, order.run, true, true, order.fetch));
}

TEST(DepotMessages, areRefusedWhereTheyAreCutOrOutOfBounds) {
    v1::DepotMessage message;
    write(MachineReport{.booted = {"1.0", 10}}, *message.mutable_report());
    const auto packet = encode(message);
    for (std::size_t size = 0; size < packet.size(); ++size)
        EXPECT_FALSE(decode(std::span(packet).first(size)));
    message.mutable_report()->set_problem(std::string(kMostProblemBytes + 1, 'x'));
    EXPECT_FALSE(decode(encode(message)));
    message.mutable_report()->set_problem("a\nb");
    EXPECT_FALSE(decode(encode(message)));
    message.mutable_piece_request()->set_version(std::string(65, 'v'));
    EXPECT_FALSE(decode(encode(message)));
    EXPECT_FALSE(decode(std::vector<std::byte>(3 * kPieceBytes)));
}

TEST(KeptFiles, comeBackAndAreRefusedWhereTheyAreDamaged) {
    const TemporaryFolder folder("copy_test");
    const fs::path file = folder.path() / "rollout.txtpb";
    EXPECT_FALSE(keptRollout(file));
    const RolloutState state{.epoch = 7,
                             .phase = RolloutState::Phase::Trying,
                             .stable = {"1.0", 10},
                             .candidate = {"1.1", 11},
                             .before = {"0.9", 9},
                             .reason = "release 1.2 was left: \"no\""};
    keep(state, file);
    EXPECT_EQ(keptRollout(file), state);
    keep(RolloutState{}, file);
    EXPECT_EQ(keptRollout(file), RolloutState{});
    write(file, "epoch: 7 phase: NONE");
    EXPECT_THROW(static_cast<void>(keptRollout(file)), Error);
    const FollowerMemory memory{
        .settled = {"1.0", 10}, .triedIn = 3, .tried = {"1.1", 11}, .triedFrom = "a1"};
    keep(memory, file);
    EXPECT_EQ(keptFollower(file), memory);
}

TEST(BootEntries, areReadFromTheirNames) {
    EXPECT_EQ(entryOf("aquarama-1.4.0.conf")->release.version, "1.4.0");
    EXPECT_FALSE(entryOf("aquarama-1.4.0.conf")->triesLeft);
    EXPECT_EQ(entryOf("aquarama-1.4.0+2-1.conf")->triesLeft, 2);
    EXPECT_EQ(entryOf("aquarama-1.4.0+0-3.conf")->triesLeft, 0);
    EXPECT_EQ(entryOf(fileOf({"1.4.0", 5}, kTries))->triesLeft, kTries);
    for (const char* name :
         {"debian.conf", "aquarama-.conf", "aquarama-1.conf.7.1.part", "aquarama-1+x.conf"})
        EXPECT_FALSE(entryOf(name)) << name;
}

// A machine whose program writes entries only.
class OnAShelf : public testing::Test {
  protected:
    OnAShelf() {
        write(program_, "#!/bin/sh\necho \"$@\"\n");
        fs::permissions(program_, fs::perms::owner_all);
        for (const char* version : {"1.0", "1.1"}) {
            write(system_ / "aquarama" / version / "vmlinuz", version);
            signRelease(system_ / "aquarama" / version, ++serial_, keys_.secretPem, "show.key");
        }
        write(entries_ / "aquarama-1.0.conf", "entry 1.0 10\n");
        write(entries_ / "debian.conf", "");
    }
    std::set<std::string> names() const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(entries_))
            names.insert(entry.path().filename().string());
        return names;
    }
    void start(const ReleaseId& id) { shelf_.change(stepsToStart(shelf_.entries(), id), machine_); }

    TemporaryFolder temporary_{"copy_test"};
    fs::path program_ = temporary_.path() / "it's a machine",
             system_ = temporary_.path() / "system";
    fs::path entries_ = system_ / "loader/entries";
    SigningKeys keys_ = makeSigningKeys();
    std::uint64_t serial_ = 9;
    Machine machine_{program_};
    Shelf shelf_{system_};
    const ReleaseId old_{"1.0", 10}, new_{"1.1", 11};
};

TEST_F(OnAShelf, aReleaseIsTriedBlessedAndLeft) {
    start(new_);
    EXPECT_EQ(names(),
              (std::set<std::string>{"aquarama-1.0.conf", "aquarama-1.1+3.conf", "debian.conf"}));
    EXPECT_EQ(readWhole(entries_ / "aquarama-1.1+3.conf", 100).size(),
              std::string("entry 1.1 11\n").size());
    fs::rename(entries_ / "aquarama-1.1+3.conf", entries_ / "aquarama-1.1+0-3.conf");
    start(new_);  // its tries were used up
    EXPECT_EQ(names(),
              (std::set<std::string>{"aquarama-1.0.conf", "aquarama-1.1+3.conf", "debian.conf"}));
    EXPECT_EQ(shelf_.good(), std::vector{old_});
    shelf_.change(stepsToBless(shelf_.entries(), new_), machine_);
    EXPECT_EQ(names(),
              (std::set<std::string>{"aquarama-1.0.conf", "aquarama-1.1.conf", "debian.conf"}));
    start(old_);
    EXPECT_EQ(names(), (std::set<std::string>{"aquarama-1.0.conf", "debian.conf"}));
}

TEST_F(OnAShelf, roomIsMadeOnlyBesideAGoodRelease) {
    shelf_.keepOnly({new_}, machine_);
    EXPECT_TRUE(fs::exists(system_ / "aquarama/1.0")) << "1.1 is not good";
    start(new_);
    shelf_.change(stepsToBless(shelf_.entries(), new_), machine_);
    shelf_.keepOnly({new_, {"1.2", 12}}, machine_);
    EXPECT_EQ(names(), (std::set<std::string>{"aquarama-1.1.conf", "debian.conf"}));
    EXPECT_FALSE(fs::exists(system_ / "aquarama/1.0"));
}

// FAT may keep the new name of a file before it keeps its length.
TEST_F(OnAShelf, whatACutHasLeftEmptyIsNoEntry) {
    write(entries_ / "aquarama-1.1+3.conf", "");
    EXPECT_EQ(shelf_.entries().size(), 1U);
    start(new_);
    EXPECT_FALSE(fs::is_empty(entries_ / "aquarama-1.1+3.conf"));
    // The cut comes as the release is counted as good.
    fs::remove(entries_ / "aquarama-1.1+3.conf");
    write(entries_ / "aquarama-1.1.conf", "");
    EXPECT_EQ(shelf_.good(), std::vector{old_});
    start(new_);
    EXPECT_EQ(names(),
              (std::set<std::string>{"aquarama-1.0.conf", "aquarama-1.1+3.conf", "debian.conf"}));
}

TEST_F(OnAShelf, nothingIsWrittenWhereTheMachineFails) {
    write(program_, "#!/bin/sh\nexit 1\n");
    EXPECT_THROW(start(new_), Error);
    EXPECT_EQ(names(), (std::set<std::string>{"aquarama-1.0.conf", "debian.conf"}));
}

}  // namespace
}  // namespace aquarama::releases
