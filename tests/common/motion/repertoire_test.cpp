// SPDX-License-Identifier: Apache-2.0
#include "common/motion/repertoire.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/digest.h"
#include "common/base/log.h"
#include "tests/support/synthetic_repertoire.h"

namespace aquarama::motion {
namespace {

using Bytes = std::vector<std::byte>;

const Bytes& smallFile() {
    static const Bytes kFile = encodeRepertoire(test::syntheticRepertoire(false));
    return kFile;
}

bool isRefused(std::span<const std::byte> bytes) {
    try {
        (void)decodeRepertoire(bytes, "trout.rep");
    } catch (const Error& error) {
        return std::string(error.what()).starts_with("trout.rep: ");
    }
    return false;
}

// Gives altered content its right SHA-256, so that the reader behind it is reached.
Bytes resigned(Bytes file) {
    const auto content = std::span(file).first(file.size() - 32);
    const Digest digest = digestOf(content);
    std::ranges::copy(std::as_bytes(std::span(digest.bytes)), file.end() - 32);
    return file;
}

TEST(Repertoire, isReadAsItWasWritten) {
    const Repertoire written = test::syntheticRepertoire(true);
    const Bytes file = encodeRepertoire(written);
    const Repertoire read = decodeRepertoire(file, "file");
    EXPECT_EQ(read.species, "synthetic");
    EXPECT_EQ(read.recordedLengthMetres, written.recordedLengthMetres);
    for (std::size_t action = 0; action < kActions; ++action) {
        EXPECT_EQ(read.segments[action].nodes, written.segments[action].nodes);
        EXPECT_EQ(read.segments[action].controlPoints, written.segments[action].controlPoints);
        EXPECT_EQ(read.segments[action].playsToEnd, written.segments[action].playsToEnd);
        EXPECT_EQ(read.segments[action].increments[9].rotation,
                  written.segments[action].increments[9].rotation);
    }
    EXPECT_EQ(read.response.swimDrag, written.response.swimDrag);
    EXPECT_EQ(read.response.glideDrag, written.response.glideDrag);
    EXPECT_EQ(read.response.brakeRate, written.response.brakeRate);
    EXPECT_EQ(encodeRepertoire(read), file);
}

TEST(Repertoire, beginsWithItsNameAndEndsWithItsSha256) {
    const auto text = reinterpret_cast<const char*>(smallFile().data());
    EXPECT_EQ(std::string(text, 5), "AQREP");
    EXPECT_EQ(resigned(smallFile()), smallFile());
}

// Those of the head and the signature, and every 13th between; with AQUARAMA_SOAK in the
// environment each.
TEST(Repertoire, anyAlteredByteIsRefused) {
    Bytes file = smallFile();
    constexpr std::size_t kEnds = 256;
    const std::size_t step = std::getenv("AQUARAMA_SOAK") == nullptr ? 13 : 1;
    std::size_t accepted = 0;
    for (std::size_t at = 0; at < file.size();
         at += at < kEnds || at + kEnds > file.size() ? 1 : step) {
        file[at] ^= static_cast<std::byte>(1U << at % 8);
        accepted += isRefused(file) ? 0 : 1;
        file[at] = smallFile()[at];
    }
    EXPECT_EQ(accepted, 0U);
}

TEST(Repertoire, anyTruncationIsRefused) {
    std::size_t accepted = 0;
    for (std::size_t length = 0; length < smallFile().size(); ++length) {
        accepted += isRefused(std::span(smallFile()).first(length)) ? 0 : 1;
    }
    EXPECT_EQ(accepted, 0U);
}

TEST(Repertoire, trailingBytesAreRefusedEvenWhenSigned) {
    Bytes file = smallFile();
    file.insert(file.end() - 32, std::byte{0});
    EXPECT_TRUE(isRefused(resigned(file)));
    const auto length = static_cast<std::uint32_t>(file.size());
    std::memcpy(&file[7], &length, sizeof(length));  // even with the right length in its head
    EXPECT_TRUE(isRefused(resigned(file)));
}

std::string refusalOf(const Bytes& file) {
    try {
        (void)decodeRepertoire(file, "trout.rep");
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Repertoire, aVersionFromTheFutureAsksForAnUpdateAndAnOldOneForACapture) {
    Bytes file = smallFile();
    file[5] = std::byte{9};
    EXPECT_THAT(refusalOf(resigned(file)), testing::HasSubstr("version 9"));
    EXPECT_THAT(refusalOf(resigned(file)), testing::HasSubstr("newer Aquarama; update"));
    EXPECT_THAT(refusalOf(file), testing::HasSubstr("newer Aquarama")) << "whatever else is in it";
    file[5] = std::byte{1};
    EXPECT_THAT(refusalOf(resigned(file)), testing::HasSubstr("version 1"));
    EXPECT_THAT(refusalOf(resigned(file)), testing::HasSubstr("capture the species again"));
}

// Where the floats of a file without control points are.
struct FloatsAt {
    std::size_t length, drags;
    std::vector<std::size_t> ofSegments;
};
FloatsAt floatsOf(const std::string& species) {
    FloatsAt at;
    at.length = 12 + species.size();
    at.drags = at.length + 4;
    std::size_t segment = at.drags + 6 * 4 + kCapturedActions;
    for (int action = 0; action < kCapturedActions; ++action) {
        at.ofSegments.push_back(segment);  // the period
        for (std::size_t i = 0; i < 7 * kPhases; ++i) at.ofSegments.push_back(segment + 5 + 4 * i);
        segment += 5 + kPhases * (7 * 4 + (body::kNodalPoints + 2) * 3 * 2);
    }
    return at;
}
Bytes withFloat(std::size_t at, float value) {
    Bytes file = smallFile();
    std::memcpy(&file[at], &value, sizeof(value));
    return resigned(std::move(file));
}

// Of the many floats of the segments, each is one of the three.
TEST(Repertoire, anyFloatThatIsNoNumberIsRefusedByWhatItIs) {
    const FloatsAt at = floatsOf("synthetic");
    constexpr std::array kBad{std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity(),
                              -std::numeric_limits<float>::infinity()};
    for (const float bad : kBad) {
        EXPECT_THAT(refusalOf(withFloat(at.length, bad)), testing::HasSubstr("recorded length"));
        for (const std::size_t drag : {0U, 1U, 2U, 3U, 4U, 5U})
            EXPECT_THAT(refusalOf(withFloat(at.drags + 4 * drag, bad)), testing::HasSubstr("drag"));
    }
    for (std::size_t i = 0; i < at.ofSegments.size(); ++i)
        ASSERT_THAT(refusalOf(withFloat(at.ofSegments[i], kBad[i % kBad.size()])),
                    testing::HasSubstr("segment "));
}

TEST(Repertoire, aDragOutOfBoundsIsRefused) {
    const FloatsAt at = floatsOf("synthetic");
    for (const float bad : {-0.001F, 1000.5F})
        for (const std::size_t drag : {0U, 1U, 2U, 3U, 4U, 5U})
            EXPECT_THAT(refusalOf(withFloat(at.drags + 4 * drag, bad)),
                        testing::HasSubstr("drag outside 0 to 1000"));
    EXPECT_EQ(refusalOf(withFloat(at.drags, 1000.0F)), "accepted");
}

// Behind a right SHA-256 a file is refused, or means exactly what it says.
TEST(Repertoire, anAlteredFileThatIsSignedIsRefusedOrReadWhole) {
    std::mt19937 random(1);
    for (int trial = 0; trial < 1000; ++trial) {
        Bytes file = smallFile();
        const std::size_t reach = trial % 2 == 0 ? 40 : file.size() - 32;  // the head, or anywhere
        file[random() % reach] = static_cast<std::byte>(random());
        file = resigned(file);
        if (isRefused(file)) continue;
        EXPECT_EQ(encodeRepertoire(decodeRepertoire(file, "file")), file);
    }
}

TEST(Repertoire, randomBytesAreRefused) {
    std::mt19937 random(2);
    for (int trial = 0; trial < 2000; ++trial) {
        Bytes noise(random() % 300);
        for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
        EXPECT_TRUE(isRefused(noise));
        Bytes headed = smallFile();
        headed.resize(7 + noise.size());
        std::ranges::copy(noise, headed.begin() + 7);
        EXPECT_TRUE(isRefused(headed));
        headed.resize(std::max<std::size_t>(headed.size(), 32));
        EXPECT_TRUE(isRefused(resigned(headed)));
    }
}

TEST(Repertoire, isNotWrittenWithValuesOutOfBounds) {
    const Repertoire good = test::syntheticRepertoire(false);
    const auto broken = [&](auto&& damage) {
        Repertoire repertoire = good;
        damage(repertoire);
        return repertoire;
    };
    const float nan = std::nanf("");
    EXPECT_THROW((void)encodeRepertoire(broken([](auto& r) { r.species = ""; })), Error);
    EXPECT_THROW((void)encodeRepertoire(broken([&](auto& r) { r.recordedLengthMetres = nan; })),
                 Error);
    EXPECT_THROW((void)encodeRepertoire(broken([](auto& r) { r.segments[2].periodSeconds = 0; })),
                 Error);
    EXPECT_THROW(
        (void)encodeRepertoire(broken([](auto& r) { r.segments[2].controlPoints.resize(3); })),
        Error);
    EXPECT_THROW((void)encodeRepertoire(
                     broken([&](auto& r) { r.segments[6].increments[3].translation.y = nan; })),
                 Error);
    EXPECT_THROW((void)encodeRepertoire(broken([](auto& r) {
                     r.segments[0].increments[0].rotation = glm::quat(0, 0, 0, 0);
                 })),
                 Error);
}

// A small repertoire whose turns have paths by entry, each another.
Repertoire withEntries() {
    Repertoire repertoire = test::syntheticRepertoire(false);
    for (int turn = kFirstTurn; turn < kFirstTurn + kTurns; ++turn) {
        ActionSegment& segment = repertoire.segments[static_cast<std::size_t>(turn)];
        segment.entered.resize(kTurnEntries);
        for (std::size_t entry = 0; entry < segment.entered.size(); ++entry) {
            TurnPath& path = segment.entered[entry];
            const float angle = 0.01F * static_cast<float>(entry + 1);
            path.courseBefore = {std::cos(angle), 0, std::sin(angle)};
            path.courseAfter = {std::cos(angle), 0, -std::sin(angle)};
            path.speedBefore = 1 + angle;
            path.speedAfter = 1 - angle;
            path.increments = segment.increments;
            path.increments[5].translation.x = angle / 10;
        }
    }
    return repertoire;
}

TEST(Repertoire, keepsThePathsOfTurnsByTheirEntries) {
    const Repertoire written = withEntries();
    const Bytes file = encodeRepertoire(written);
    const Repertoire read = decodeRepertoire(file, "file");
    EXPECT_EQ(encodeRepertoire(read), file);
    for (std::size_t entry = 0; entry < kTurnEntries; ++entry) {
        const TurnPath& was = written.segments[kFirstTurn + 1].entered[entry];
        const TurnPath& is = read.segments[kFirstTurn + 1].entered.at(entry);
        EXPECT_EQ(is.courseBefore, was.courseBefore);
        EXPECT_EQ(is.courseAfter, was.courseAfter);
        EXPECT_EQ(is.speedBefore, was.speedBefore);
        EXPECT_EQ(is.speedAfter, was.speedAfter);
        EXPECT_EQ(is.increments[5].translation, was.increments[5].translation);
    }
    EXPECT_TRUE(read.segments[0].entered.empty());
}

TEST(Repertoire, refusesPathsOfTurnsThatLeadNowhere) {
    const auto fault = [](auto&& damage) {
        Repertoire repertoire = withEntries();
        damage(repertoire.segments[kFirstTurn].entered);
        try {
            (void)encodeRepertoire(repertoire);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    const float nan = std::nanf("");
    EXPECT_THAT(fault([](auto& paths) { paths.pop_back(); }), testing::HasSubstr("some of its"));
    for (const glm::vec3 course : {glm::vec3(0), glm::vec3(2, 0, 0), glm::vec3(nan, 0, 0)}) {
        EXPECT_THAT(fault([&](auto& paths) { paths[3].courseBefore = course; }),
                    testing::HasSubstr("turn_left_gradual has a course"));
        EXPECT_THAT(fault([&](auto& paths) { paths[39].courseAfter = course; }),
                    testing::HasSubstr("no direction"));
    }
    for (const float speed : {nan, 17.0F, -17.0F}) {
        EXPECT_THAT(fault([&](auto& paths) { paths[0].speedBefore = speed; }),
                    testing::HasSubstr("speed beyond"));
        EXPECT_THAT(fault([&](auto& paths) { paths[0].speedAfter = speed; }),
                    testing::HasSubstr("speed beyond"));
    }
    EXPECT_THAT(fault([&](auto& paths) { paths[9].increments[7].translation.z = nan; }),
                testing::HasSubstr("moves the body frame"));
}

TEST(Repertoire, numbersSegmentsByTheirActions) {
    int segments = 0;
    for (int action = 0; action < kActions; ++action) {
        const auto one = static_cast<Action>(action);
        const int count = isTurn(one) ? kTurnSegments : isStart(one) ? kStartSegments : 1;
        for (int i = 0; i < count; ++i)
            EXPECT_EQ(actionOf(static_cast<std::uint32_t>(firstSegmentOf(one) + i)), one);
        EXPECT_EQ(firstSegmentOf(one), segments);
        segments += count;
    }
    EXPECT_EQ(segments, kSegments);
}

TEST(Repertoire, namesItsSegments) {
    EXPECT_STREQ(nameOf(Action::ForwardSlow), "forward_slow");
    EXPECT_STREQ(nameOf(Action::TurnRightSharp), "turn_right_sharp");
}

}  // namespace
}  // namespace aquarama::motion
