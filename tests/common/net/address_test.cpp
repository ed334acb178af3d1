// SPDX-License-Identifier: Apache-2.0
#include "common/net/address.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/units/log.h"

namespace aquarama::net {
namespace {

void requireBindAddress(const std::string& address) {
    EXPECT_NE(bindAddress(address), "");
}

std::string refusal(void (*check)(const std::string&), const std::string& address) {
    try {
        check(address);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Address, theLoopbackMayBeBound) {
    for (const char* address :
         {"tcp://127.0.0.1:7400", "tcp://127.8.9.1:1", "tcp://[::1]:65535", "tcp://127.0.0.1:*"}) {
        EXPECT_EQ(refusal(requireBindAddress, address), "") << address;
    }
}

TEST(Address, localhostIsThisMachineWhateverItsResolverThinks) {
    EXPECT_EQ(bindAddress("tcp://localhost:7400"), "tcp://127.0.0.1:7400");
}

TEST(Address, nothingPastTheLoopbackMayBeBoundWithoutKeys) {
    for (const char* address : {"tcp://0.0.0.0:7400",
                                "tcp://*:7400",
                                "tcp://192.168.1.4:7400",
                                "tcp://[::]:7400",
                                "tcp://[fe80::1]:7400",
                                "tcp://128.0.0.1:7400",
                                "tcp://eth0:7400"}) {
        EXPECT_NE(refusal(requireBindAddress, address), "") << address;
    }
    EXPECT_THAT(refusal(requireBindAddress, "tcp://10.0.0.1:7400"),
                testing::HasSubstr("without keys"));
}

TEST(Address, whatIsMalformedIsNamed) {
    for (const char* address : {"",
                                "7400",
                                "127.0.0.1:7400",
                                "udp://127.0.0.1:7400",
                                "tcp://",
                                "tcp://:7400",
                                "tcp://127.0.0.1",
                                "tcp://127.0.0.1:",
                                "tcp://127.0.0.1:0",
                                "tcp://127.0.0.1:65536",
                                "tcp://127.0.0.1:74x",
                                "tcp://127.0.0.1:-1",
                                "tcp://a b:1",
                                "tcp://[::1:7400"}) {
        EXPECT_THAT(refusal(requireConnectAddress, address), testing::HasSubstr(address));
        EXPECT_NE(refusal(requireConnectAddress, address), "") << address;
        EXPECT_NE(refusal(requireBindAddress, address), "") << address;
    }
}

TEST(Address, aNodeMayReachAnyHostButNeedsItsPort) {
    EXPECT_EQ(refusal(requireConnectAddress, "tcp://master.hall:7400"), "");
    EXPECT_NE(refusal(requireConnectAddress, "tcp://127.0.0.1:*"), "");
}

}  // namespace
}  // namespace aquarama::net
