// SPDX-License-Identifier: Apache-2.0
#include "console/alerts.h"

#include <gtest/gtest.h>

namespace aquarama::console {
namespace {

const std::vector<Fault> kLate{{"node left", "node left is late", 10}};

TEST(Alerts, aFaultThatPassesIsNoAlert) {
    Alerts alerts;
    for (double now = 0; now < 100; ++now)
        EXPECT_TRUE(
            alerts.update(static_cast<int>(now) % 9 == 8 ? std::vector<Fault>{} : kLate, now)
                .empty())
            << now;
    EXPECT_TRUE(alerts.standing().empty());
}

TEST(Alerts, oneThatLastsFiresOnceAndStaysUntilSomebodyHasSeenIt) {
    Alerts alerts;
    int lines = 0;
    for (double now = 0; now <= 30; ++now)
        lines += static_cast<int>(alerts.update(kLate, now).size());
    EXPECT_EQ(lines, 1);
    ASSERT_EQ(alerts.standing().size(), 1U);
    EXPECT_EQ(alerts.standing()[0].since, 0);
    EXPECT_EQ(alerts.update({}, 31), std::vector<std::string>{"over: node left is late"});
    EXPECT_TRUE(alerts.update({}, 500).empty());
    ASSERT_EQ(alerts.standing().size(), 1U) << "over, and still to be seen";
    EXPECT_TRUE(alerts.standing()[0].isOver);
    EXPECT_TRUE(alerts.acknowledge("node left"));
    EXPECT_TRUE(alerts.standing().empty());
    EXPECT_FALSE(alerts.acknowledge("node left"));
}

TEST(Alerts, oneThatWasSeenEndsByItselfAndFiresAgainNextTime) {
    Alerts alerts;
    alerts.update(kLate, 0);
    alerts.update(kLate, 10);
    EXPECT_TRUE(alerts.acknowledge("node left"));
    EXPECT_TRUE(alerts.update(kLate, 11).empty());
    EXPECT_TRUE(alerts.standing()[0].isAcknowledged);
    alerts.update({}, 12);
    EXPECT_TRUE(alerts.standing().empty());
    alerts.update(kLate, 100);
    EXPECT_EQ(alerts.update(kLate, 110).size(), 1U);
}

TEST(Alerts, aClockThatIsSetNeitherFiresNorHoldsBackAnAlert) {
    for (const double jump : {1.7e9, -1.7e9}) {
        Alerts alerts;
        const double begin = 1.8e9;
        EXPECT_TRUE(alerts.update(kLate, begin).empty());
        EXPECT_TRUE(alerts.update(kLate, begin + 1 + jump).empty()) << "one second has passed";
        std::size_t lines = 0;
        for (double now = begin + 2; now < begin + 20; ++now)
            lines += alerts.update(kLate, now + jump).size();
        EXPECT_EQ(lines, 1U) << jump;
        EXPECT_NEAR(alerts.standing().at(0).since, begin + jump, 2) << "as people count now";
    }
}

TEST(Alerts, nothingNewFiresWhileTheWallIsOffOnPurpose) {
    Alerts alerts;
    for (double now = 0; now < 3600; ++now) EXPECT_TRUE(alerts.update(kLate, now, true).empty());
    EXPECT_EQ(alerts.update(kLate, 3600).size(), 1U) << "open again, and it is still wrong";
}

}  // namespace
}  // namespace aquarama::console
