// SPDX-License-Identifier: Apache-2.0
// `aquarama doctor` against a master that says what this test wants: each finding about a node was
// tried once in the state that it is about. States of this machine are in doctor_test.py.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/net/channels.h"
#include "common/wire/messages.h"
#include "tests/common/wire/sample_messages.h"
#include "tests/end_to_end/free_port.h"

namespace aquarama {
namespace {

namespace fs = std::filesystem;

// What a command of `aquarama` writes to standard output.
std::string said(const std::string& arguments) {
    const std::string command =
        std::string(std::getenv("AQUARAMA_BIN")) + "/aquarama " + arguments + " 2>/dev/null";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
    std::string text;
    for (int c = 0; (c = std::fgetc(pipe.get())) != EOF;) text += static_cast<char>(c);
    return text;
}

// Version and commit, as nodes of the same build report them.
std::string ownBuild() {
    std::istringstream lines(said("--version"));
    std::string name;
    std::string version;
    std::string word;
    std::string commit;
    lines >> name >> version >> word;
    std::getline(lines >> std::ws, commit);
    return version + " " + commit;
}

// A node of another machine of which nothing is to be said but good.
v1::NodeStatus goodNode(const std::string& build) {
    v1::NodeStatus node;
    node.set_name("left");
    node.set_machine("pit");
    node.set_condition(v1::NODE_IN_STEP);
    v1::NodeReport& report = *node.mutable_report();
    report.set_host("pit");
    report.set_build(build);
    report.set_renderer("a card");
    report.add_monitors("HDMI-1 480x360 60 Hz");
    report.set_free_disk_bytes(std::uint64_t{5} << 30U);
    report.set_round_trip_median_ms(0.2F);
    report.set_round_trip_p99_ms(0.4F);
    report.set_real_time(true);
    report.set_clock_synchronised(true);
    return node;
}

// Answers every question for the status with this node.
class StagedMaster {
  public:
    StagedMaster() {
        fs::create_directories(folder_);
        std::string text = rigOnFreePorts("desk");
        text.replace(text.find("mode: WINDOW"),
                     std::string("mode: WINDOW").size(),
                     "mode: FULLSCREEN connector: \"HDMI-1\"");
        std::ofstream(rigFile()) << text;
        const config::Rig rig = config::parseRig(text, "desk");
        channels_ = net::bindMaster(rig.controlAddress, rig.stateAddress);
        thread_ = std::thread([this] { serve(); });
    }
    ~StagedMaster() {
        isOver_ = true;
        thread_.join();
        fs::remove_all(folder_);
    }
    StagedMaster(const StagedMaster&) = delete;
    StagedMaster& operator=(const StagedMaster&) = delete;

    // What the doctor says where the master tells of this node.
    std::string findings(const v1::NodeStatus& node) {
        reply_ = wire::sampleStatus();
        reply_.mutable_status_reply()->clear_nodes();
        *reply_.mutable_status_reply()->add_nodes() = node;
        isStaged_ = true;
        std::string text = said("doctor " + rigFile().string());
        isStaged_ = false;
        return text;
    }

  private:
    [[nodiscard]] fs::path rigFile() const { return folder_ / "rig.txtpb"; }
    void serve() {
        while (!isOver_) {
            channels_->wait(std::chrono::milliseconds(20));
            while (const auto from = channels_->receiveControl()) {
                const auto message = wire::decode(from->bytes);
                if (message && message->has_status_request() && isStaged_)
                    channels_->sendControl(from->peer, wire::encode(1, reply_));
            }
        }
    }

    fs::path folder_ = fs::temp_directory_path() / ("aquarama-staged-" + std::to_string(getpid()));
    std::unique_ptr<net::MasterChannels> channels_;
    v1::Envelope reply_;
    std::atomic<bool> isStaged_ = false, isOver_ = false;
    std::thread thread_;
};

// How the line begins, and what stands in it.
struct State {
    const char* verdict;
    const char* part;
    std::function<void(v1::NodeStatus& node, v1::NodeReport& report)> bring;
};

const std::vector<State> kStates{
    {"fail",
     "absent, machine pit: start it there",
     [](auto& node, auto&) { node.set_condition(v1::NODE_ABSENT); }},
    {"warn",
     "preparing, machine pit",
     [](auto& node, auto&) { node.set_condition(v1::NODE_PREPARING); }},
    {"warn",
     "late, machine pit: it draws more slowly",
     [](auto& node, auto&) { node.set_condition(v1::NODE_LATE); }},
    {"fail",
     "decodes other fish than were sent: check its memory",
     [](auto& node, auto&) { node.set_hash_mismatches(3); }},
    {"warn",
     "llvmpipe (LLVM 15): it draws on the processor",
     [](auto&, auto& report) { report.set_renderer("llvmpipe (LLVM 15)"); }},
    {"warn",
     "build 0.1 abc: this machine has",
     [](auto&, auto& report) { report.set_build("0.1 abc"); }},
    {"warn",
     "0 GB free: make room on its disk",
     [](auto&, auto& report) { report.set_free_disk_bytes(1000); }},
    {"warn",
     "99 % within 7.00 ms, jitter",
     [](auto&, auto& report) { report.set_round_trip_p99_ms(7); }},
    {"warn",
     "3.0 % of pings unanswered",
     [](auto&, auto& report) { report.set_unanswered_percent(3); }},
    {"warn",
     "no real-time priority: frames are late",
     [](auto&, auto& report) { report.set_real_time(false); }},
    {"warn",
     "clock not synchronised: install chrony",
     [](auto&, auto& report) { report.set_clock_synchronised(false); }},
    {"warn",
     "the rig wants monitor HDMI-1, of 0",
     [](auto&, auto& report) { report.clear_monitors(); }},
    {"warn",
     "the rig wants monitor HDMI-1, of 1",
     [](auto&, auto& report) { report.set_monitors(0, "DP-1 480x360 60 Hz"); }},
    {"warn",
     "monitor HDMI-1 is to show 480x360: it is at another size",
     [](auto&, auto& report) { report.set_monitors(0, "HDMI-1 1920x1080 60 Hz"); }},
};

// The lines about the node, in their order.
std::vector<std::string> linesOfNode(const std::string& findings) {
    std::vector<std::string> lines;
    std::istringstream all(findings);
    for (std::string line; std::getline(all, line);)
        if (line.find("  node left") == 4) lines.push_back(line);
    return lines;
}

TEST(DoctorFindings, aNodeThatIsWellPassesAndEachFaultIsFoundAlone) {
    StagedMaster master;
    const v1::NodeStatus good = goodNode(ownBuild());
    const auto passes = linesOfNode(master.findings(good));
    ASSERT_GE(passes.size(), 9U);
    for (const std::string& line : passes) EXPECT_TRUE(line.starts_with("pass")) << line;
    for (const State& state : kStates) {
        v1::NodeStatus node = good;
        state.bring(node, *node.mutable_report());
        std::vector<std::string> wrong;
        for (const std::string& line : linesOfNode(master.findings(node)))
            if (!line.starts_with("pass")) wrong.push_back(line);
        ASSERT_EQ(wrong.size(), 1U) << state.part << testing::PrintToString(wrong);
        EXPECT_TRUE(wrong[0].starts_with(state.verdict)) << wrong[0];
        EXPECT_NE(wrong[0].find(state.part), std::string::npos) << wrong[0] << state.part;
    }
}

TEST(DoctorFindings, ofANodeOnTheMastersMachineTheWayIsNotJudged) {
    StagedMaster master;
    v1::NodeStatus node = goodNode(ownBuild());
    node.clear_machine();
    node.mutable_report()->set_round_trip_p99_ms(50);
    node.mutable_report()->set_clock_synchronised(false);
    for (const std::string& line : linesOfNode(master.findings(node)))
        EXPECT_TRUE(line.starts_with("pass")) << line;
}

TEST(DoctorFindings, ofANodeWithoutAReportOnlyItsConditionIsSaid) {
    StagedMaster master;
    v1::NodeStatus node = goodNode("");
    node.clear_report();
    EXPECT_EQ(linesOfNode(master.findings(node)).size(), 2U);
}

}  // namespace
}  // namespace aquarama
