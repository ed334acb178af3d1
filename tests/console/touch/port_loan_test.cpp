// SPDX-License-Identifier: Apache-2.0
// The console lends the tracker's port as long as somebody asks, to one at a time.
#include "console/touch/port_loan.h"

#include <cstdlib>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama::console {
namespace {

TEST(PortLoan, holdsWhileItLivesAndForOneAtATime) {
    const TemporaryFolder folder("loan");
    const char* const before = std::getenv("XDG_STATE_HOME");
    const std::string kept = before == nullptr ? "" : before;
    setenv("XDG_STATE_HOME", folder.path().c_str(), 1);
    EXPECT_FALSE(PortLoan::isAsked("hall.txtpb"));
    std::optional<PortLoan> loan(std::in_place, "hall.txtpb");
    EXPECT_TRUE(PortLoan::isAsked("hall.txtpb"));
    EXPECT_FALSE(PortLoan::isAsked("foyer.txtpb")) << "another rig's";
    EXPECT_THROW(PortLoan("hall.txtpb"), Error);
    loan.reset();
    EXPECT_FALSE(PortLoan::isAsked("hall.txtpb"));
    loan.emplace("hall.txtpb");
    EXPECT_TRUE(PortLoan::isAsked("hall.txtpb"));
    setenv("XDG_STATE_HOME", kept.c_str(), 1);
}

}  // namespace
}  // namespace aquarama::console
