// SPDX-License-Identifier: Apache-2.0
#include "common/machine/connectors.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace aquarama::machine {
namespace {

namespace fs = std::filesystem;

// Of a television of 55 inches, 1920 x 1080 at 60 Hz, as the standard has it: 148.5 MHz, 2200 x
// 1125 with blanks.
std::vector<std::uint8_t> televisionEdid() {
    std::vector<std::uint8_t> edid(128, 0);
    for (std::size_t i = 1; i < 7; ++i) edid[i] = 0xFF;
    const std::vector<std::uint8_t> timing{0x02,
                                           0x3A,
                                           0x80,
                                           0x18,
                                           0x71,
                                           0x38,
                                           0x2D,
                                           0x40,
                                           0x58,
                                           0x2C,
                                           0x45,
                                           0x00,
                                           0xBA,
                                           0xA8,
                                           0x42,
                                           0x00,
                                           0x00,
                                           0x1E};
    std::ranges::copy(timing, edid.begin() + 54);
    const std::string name("\0\0\0\xFC\0TV of 55\n    ", 18);
    std::ranges::copy(name, edid.begin() + 54 + 18);
    return edid;
}

std::string textOf(const std::vector<std::uint8_t>& bytes) {
    return {bytes.begin(), bytes.end()};
}

// A folder as the kernel's, of these connectors.
class Drm {
  public:
    Drm() { fs::create_directories(folder / "card0"); }
    ~Drm() { fs::remove_all(folder); }
    Drm(const Drm&) = delete;
    Drm& operator=(const Drm&) = delete;

    void add(const std::string& name,
             const std::string& status,
             const std::string& edid,
             const std::string& modes) const {
        fs::create_directories(folder / name);
        std::ofstream(folder / name / "status") << status << '\n';
        std::ofstream(folder / name / "edid", std::ios::binary) << edid;
        std::ofstream(folder / name / "modes") << modes;
    }

    fs::path folder = fs::path(testing::TempDir()) / "aquarama_connectors_test";
};

TEST(Connectors, anEdidTellsNameModeAndSize) {
    const auto edid = televisionEdid();
    const auto facts = factsIn(std::as_bytes(std::span(edid)));
    ASSERT_TRUE(facts);
    EXPECT_EQ(facts->product, "TV of 55");
    EXPECT_EQ(facts->sizePixels, glm::ivec2(1920, 1080));
    EXPECT_NEAR(facts->refreshHertz, 60, 0.001);
    EXPECT_NEAR(facts->sizeMetres.x, 1.210, 0.0005);
    EXPECT_NEAR(facts->sizeMetres.y, 0.680, 0.0005);
}

TEST(Connectors, whatIsNoEdidTellsNothing) {
    EXPECT_FALSE(factsIn({}));
    auto edid = televisionEdid();
    edid[3] = 0;
    EXPECT_FALSE(factsIn(std::as_bytes(std::span(edid))));
    edid = televisionEdid();
    edid.resize(127);
    EXPECT_FALSE(factsIn(std::as_bytes(std::span(edid))));
}

// Each byte of a descriptor may be anything.
TEST(Connectors, anEdidWithAnyBytesIsRead) {
    for (std::size_t at = 54; at < 126; ++at)
        for (const int value : {0, 1, 0x7F, 0xFF}) {
            auto edid = televisionEdid();
            edid[at] = static_cast<std::uint8_t>(value);
            const auto facts = factsIn(std::as_bytes(std::span(edid)));
            ASSERT_TRUE(facts);
            EXPECT_GE(facts->sizePixels.x, 0);
            EXPECT_LE(facts->sizePixels.x, 4095);
            EXPECT_LE(facts->product.size(), 13U);
        }
}

TEST(Connectors, thoseWithAMonitorAreListedByTheNamesThatXGivesThem) {
    const Drm drm;
    drm.add("card0-HDMI-A-2", "connected", textOf(televisionEdid()), "1920x1080\n");
    drm.add("card0-HDMI-A-1", "disconnected", "", "");
    drm.add("card1-DP-1", "connected", "", "2560x1440\n1920x1080\n");
    drm.add("card0-eDP-1", "connected", "spoilt", "");
    const auto found = connectedMonitors(drm.folder);
    EXPECT_EQ(namesOf(found), "DP-1, HDMI-2, eDP-1");
    EXPECT_EQ(found[0].monitor.sizePixels, glm::ivec2(2560, 1440));
    EXPECT_EQ(found[1].monitor.product, "TV of 55");
    EXPECT_EQ(found[2].monitor.sizePixels, glm::ivec2(0));
    EXPECT_TRUE(isBuiltIn(found[2].name));
    EXPECT_FALSE(isBuiltIn(found[0].name));
    EXPECT_EQ(namesOf(connectedMonitors(drm.folder / "missing")), "no monitor");
}

TEST(Connectors, theKernelsNamesAreThoseOfX) {
    EXPECT_EQ(connectorName("HDMI-A-1"), "HDMI-1");
    EXPECT_EQ(connectorName("HDMI-1"), "HDMI-1");
    EXPECT_EQ(connectorName("DP-3"), "DP-3");
    EXPECT_EQ(connectorName("DUMMY0"), "DUMMY0");
}

}  // namespace
}  // namespace aquarama::machine
