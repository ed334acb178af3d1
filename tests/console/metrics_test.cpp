// SPDX-License-Identifier: Apache-2.0
#include "console/metrics.h"

#include <algorithm>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/console/parts.h"

namespace aquarama::console {
namespace {

// The samples whose names begin so, without the comments of the format.
std::string samplesOf(const std::string& text, const std::string& name) {
    std::istringstream lines(text);
    std::string samples;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("aquarama_console_" + name)) samples += line + "\n";
    return samples;
}

TEST(Metrics, figuresOfTheWallOfItsNodesAndOfTheConsoleAreWhatTheyWereTold) {
    browser::Wall wall;
    wall.set_heard(true);
    wall.set_watching(2);
    wall.set_refused_requests(5);
    v1::StatusReply& status = *wall.mutable_status();
    status.set_frame(1'000'000'000'000);
    status.set_frame_median_ms(16.5F);
    status.set_skew_p99_ms(0.25F);
    status.mutable_show()->set_black(true);
    for (const auto* const name : {"left", "right"}) {
        v1::NodeStatus& node = *status.add_nodes();
        node.set_name(name);
        node.set_condition(name == std::string("left") ? v1::NODE_IN_STEP : v1::NODE_LATE);
        node.set_late(3);
        node.mutable_report()->set_gpu_celsius(61.5F);
    }
    const std::string text = metricsOf(
        wall,
        {},
        {.cutOff = 9, .isClockWrong = true, .certificateDays = 12.5, .cues = CueCounts{4, 2, 1}});
    for (const auto* const sample : {"master_answers 1\n",
                                     "frame 1000000000000\n",
                                     "frame_median_ms 16.5\n",
                                     "skew_p99_ms 0.25\n",
                                     "black 1\n",
                                     "browsers 2\n",
                                     "refused_requests_total 5\n",
                                     "cut_off_connections_total 9\n",
                                     "clock_wrong 1\n",
                                     "certificate_days 12.5\n",
                                     "cues_total 4\n",
                                     "refused_cues_total 2\n",
                                     "dropped_cues_total 1\n",
                                     "node_late_total{node=\"left\"} 3\n",
                                     "node_dropped_total{node=\"left\"} 0\n",
                                     "node_hash_mismatches_total{node=\"left\"} 0\n",
                                     "node_picture_median_ms{node=\"left\"} 0\n",
                                     "node_gpu_celsius{node=\"left\"} 61.5\n"})
        EXPECT_NE(text.find(std::string("\naquarama_console_") + sample), std::string::npos)
            << sample << text;
    // The format wants the samples of one name together, after its kind.
    const std::string kind = "# TYPE aquarama_console_node_in_step gauge\n";
    ASSERT_NE(text.find(kind), std::string::npos) << text;
    const std::string group = text.substr(text.find(kind) + kind.size());
    EXPECT_EQ(std::ranges::count(group.substr(0, group.find('#')), '\n'), 2);
    const std::string samples = samplesOf(text, "node_in_step");
    EXPECT_NE(samples.find("{node=\"left\"} 1\n"), std::string::npos) << samples;
    EXPECT_NE(samples.find("{node=\"right\"} 0\n"), std::string::npos) << samples;
}

TEST(Metrics, withoutMasterAndCertificateThereAreTheConsolesOwnFigures) {
    const std::string text = metricsOf({}, {}, {});
    EXPECT_EQ(samplesOf(text, "master_answers"), "aquarama_console_master_answers 0\n");
    EXPECT_EQ(samplesOf(text, "clock_wrong"), "aquarama_console_clock_wrong 0\n");
    EXPECT_EQ(samplesOf(text, "certificate"), "");
    EXPECT_EQ(samplesOf(text, "node"), "");
}

TEST(Metrics, figuresOfProjectorsHaveNoSampleForWhatIsUnknown) {
    const auto figuresOf = [](const browser::ProjectorList& list) {
        return samplesOf(metricsOf({}, list, {}), "projector");
    };
    EXPECT_EQ(figuresOf({}), "");
    EXPECT_EQ(figuresOf(test::projectorWith("no answer", "unknown")),
              "aquarama_console_projector_answers{projector=\"left\"} 0\n");
    browser::ProjectorList list = test::projectorWith("answers", "off");
    list.mutable_projectors(0)->set_name("a \"b\"\\");
    list.mutable_projectors(0)->set_shut(false);
    list.mutable_projectors(0)->set_lamp_hours(7);
    list.mutable_projectors(0)->set_tells_problems(true);
    const std::string label = R"({projector="a \"b\"\\"} )";
    EXPECT_EQ(figuresOf(list),
              "aquarama_console_projector_answers" + label + "1\naquarama_console_projector_on" +
                  label + "0\naquarama_console_projector_shut" + label +
                  "0\naquarama_console_projector_lamp_hours" + label +
                  "7\naquarama_console_projector_problems" + label + "0\n");
}

}  // namespace
}  // namespace aquarama::console
