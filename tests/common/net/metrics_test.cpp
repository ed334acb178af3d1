// SPDX-License-Identifier: Apache-2.0
#include "common/net/metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aquarama::net {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Metrics, eachKindIsWrittenInPrometheusText) {
    Metrics metrics(0);
    metrics.gauge("fish", "Fish of the world")(60);
    const Record late = metrics.counter("late_total", "Deadlines", {{"node", "left"}});
    metrics.counter("late_total", "Deadlines", {{"node", "right"}})(2);
    late(5);
    late(3);  // a total never falls
    const Record skew = metrics.histogram("skew_seconds", "Skew");
    for (const double apart : {0.0003, 0.0004, 0.015, 7.0}) skew(apart);
    const std::string text = metrics.text();
    for (const char* line : {"# HELP fish Fish of the world\n",
                             "# TYPE fish gauge\n",
                             "\nfish 60\n",
                             "# TYPE late_total counter\n",
                             "late_total{node=\"left\"} 5\n",
                             "late_total{node=\"right\"} 2\n",
                             "# TYPE skew_seconds histogram\n",
                             "skew_seconds_bucket{le=\"0.0002\"} 0\n",
                             "skew_seconds_bucket{le=\"0.0005\"} 2\n",
                             "skew_seconds_bucket{le=\"0.016\"} 3\n",
                             "skew_seconds_bucket{le=\"+Inf\"} 4\n",
                             "skew_seconds_count 4\n"})
        EXPECT_THAT(text, HasSubstr(line));
}

// A second process with the same port goes on without; so does the first.
TEST(Metrics, aPortThatIsTakenIsSaidAndEndsNothing) {
    constexpr std::uint16_t kPort = 47131;
    Metrics first(kPort);
    testing::internal::CaptureStdout();
    Metrics second(kPort);
    EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("127.0.0.1:47131"));
    second.gauge("fish", "Fish")(1);
    EXPECT_THAT(second.text(), HasSubstr("fish 1"));
    EXPECT_THAT(first.text(), Not(HasSubstr("fish")));
}

}  // namespace
}  // namespace aquarama::net
