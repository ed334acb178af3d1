// SPDX-License-Identifier: Apache-2.0
// What the GPU makes of the wire's records, against the CPU: which fish a view shows, how finely,
// and where each is between two ticks.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "common/motion/gaze.h"
#include "tests/render_node/surface/surface_fixture.h"

namespace aquarama::surface {
namespace {

constexpr SharedView kShared{{0.3F, -0.1F, 0.2F}, 0.0016F};

// Two ticks of fish all about, some of which turn, switch segments, go and come.
struct TwoTicks {
    explicit TwoTicks(std::size_t fish, unsigned seed) {
        std::mt19937 random{seed};
        std::uniform_real_distribution<float> unit{-1.0F, 1.0F};
        std::uniform_int_distribution<int> any{0, 65535};
        motion::MotionStates states;
        states.resize(1);
        for (std::size_t i = 0; i < fish; ++i) {
            // As many far as near.
            const float range = std::exp(3.5F * unit(random) + 1.5F);
            const glm::vec3 place =
                range * glm::normalize(glm::vec3{unit(random), unit(random), unit(random)});
            const glm::quat turn = test::anyRotation(random);
            motion::setBodyFrame(states, 0, {place, turn});
            before.push_back(motion::recordOf(states, 0));
            const glm::vec3 step{unit(random), unit(random), unit(random)};
            motion::setBodyFrame(
                states,
                0,
                {place + 0.05F * step, glm::normalize(turn + 0.1F * test::anyRotation(random))});
            after.push_back(motion::recordOf(states, 0));
            move(before.back(), after.back(), any, random);
            if (any(random) % 50 == 0) before.back().y = after.back().y = kAway;
            if (any(random) % 50 == 0) after.back().y = kAway;
            traits.push_back({static_cast<std::uint32_t>(7 * i),
                              static_cast<std::uint16_t>(50 + any(random) % 400)});
        }
    }

    static constexpr std::int32_t kAway = -16384 * 65536;

    static void move(motion::FishRecord& from,
                     motion::FishRecord& to,
                     std::uniform_int_distribution<int>& any,
                     std::mt19937& random) {
        from.segment = static_cast<std::uint8_t>(any(random) % motion::kSegments);
        from.fromSegment = static_cast<std::uint8_t>(any(random) % motion::kSegments);
        from.phase = static_cast<std::uint16_t>(any(random));
        from.fromPhase = static_cast<std::uint16_t>(any(random));
        from.warpLength = static_cast<std::uint8_t>(any(random) % 9);
        from.warpFrame = static_cast<std::uint8_t>(any(random) % (from.warpLength + 1));
        from.mouth = static_cast<std::uint8_t>(any(random));
        from.gaze = static_cast<std::uint8_t>(any(random));
        const motion::FishRecord place = to;
        to = from;
        to.x = place.x, to.y = place.y, to.z = place.z;
        to.orientationLow = place.orientationLow, to.orientationHigh = place.orientationHigh;
        to.phase = static_cast<std::uint16_t>(from.phase + any(random) % 4000 - 2000);
        to.mouth = static_cast<std::uint8_t>(any(random));
        to.gaze = motion::gazeAfter(from.gaze, static_cast<unsigned>(any(random)));
        to.warpFrame =
            std::min<std::uint8_t>(static_cast<std::uint8_t>(from.warpFrame + 1), to.warpLength);
        if (any(random) % 3 != 0) return;
        // It leaves its segment in this tick: mid-cycle, or from within a warp.
        to.fromSegment = from.segment;
        to.fromPhase = from.phase;
        to.segment = static_cast<std::uint8_t>(any(random) % motion::kSegments);
        to.phase = static_cast<std::uint16_t>(any(random));
        to.warpLength = 8;
        to.warpFrame = 0;
        if (any(random) % 2 == 0) from.warpFrame = from.warpLength;
    }

    std::vector<motion::FishRecord> before, after;
    std::vector<motion::FishTraits> traits;
};

class VisibilityTest : public test::SurfaceTest {
  protected:
    [[nodiscard]] SchoolSurface surfaceOf(const TwoTicks& school,
                                          const SurfaceOptions& options) const {
        // Two species, of which the first does not fill its last group.
        const auto half = static_cast<std::ptrdiff_t>(school.traits.size() / 3);
        const std::vector<SchoolSpecies> cast{
            {body_, {}, repertoire_, {school.traits.begin(), school.traits.begin() + half}},
            {body_, {}, repertoire_, {school.traits.begin() + half, school.traits.end()}}};
        return {cast, options, programs()};
    }
};

// Nearer to a limit than numbers are rounded, the two may choose differently.
bool isOnALimit(const DetailLimits& limits, float pixels) {
    return std::ranges::any_of(
        limits, [&](float limit) { return std::abs(pixels - limit) < 1e-3F * limit; });
}

TEST_F(VisibilityTest, cullingAndLevelsAreThoseOfTheCpu) {
    constexpr float kFraction = 0.3F;
    const TwoTicks school(6000, 5);
    SchoolSurface surface = surfaceOf(school, {.finest = DetailLevel::CloseUp});
    surface.update({school.before, school.after, kFraction});
    surface.look(clip_, kShared);
    std::map<std::uint32_t, DrawnFish> found;
    for (const DrawnFish& fish : drawn(surface)) found[fish.id] = fish;
    EXPECT_EQ(found.size(), surface.counts().visible) << "a fish is drawn twice";

    const float reach = reachOf(recordedPoints(body_, repertoire_));
    const DetailLimits limits = detailLimits(1.0F);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < school.traits.size(); ++i) {
        const motion::PresentedFish fish =
            motion::present(school.before[i], school.after[i], kFraction, school.traits[i]);
        const float margin = marginOf(kShared, fish.positionMetres, fish.lengthMetres, reach);
        const auto shown = found.find(fish.id);
        const bool isShown = shown != found.end();
        if (motion::isAway(fish)) {
            EXPECT_FALSE(isShown) << i;
            continue;
        }
        const FrustumPlanes frustum = frustumOf(clip_);
        if (frustum.sees(fish.positionMetres, margin - 1e-4F)) {
            EXPECT_TRUE(isShown) << i;
        }
        if (!frustum.sees(fish.positionMetres, margin + 1e-4F)) {
            EXPECT_FALSE(isShown) << i;
        }
        if (!isShown) continue;
        ++seen;
        const float pixels =
            fish.lengthMetres /
            (glm::distance(fish.positionMetres, kShared.eyeMetres) * kShared.pixelRadians);
        if (isOnALimit(limits, pixels)) continue;
        const Detail expected =
            detailOf(kShared, limits, DetailLevel::CloseUp, fish.positionMetres, fish.lengthMetres);
        EXPECT_EQ(shown->second.level, expected.level) << pixels << " pixels";
        EXPECT_NEAR(shown->second.blend, expected.blend, 1e-3F) << pixels << " pixels";
    }
    EXPECT_GT(seen, 500U);
    for (std::size_t level = 3; level < kDetailLevels; ++level)
        EXPECT_GT(surface.counts().atLevel.at(level), 5U) << "level " << level;
}

TEST_F(VisibilityTest, aFishIsWhereTheReferencePresentsIt) {
    const TwoTicks school(3000, 9);
    SchoolSurface surface = surfaceOf(school, {.culling = false});
    for (const float fraction : {0.0F, 0.37F, 1.0F}) {
        surface.update({school.before, school.after, fraction});
        surface.look(clip_, kShared);
        const std::vector<DrawnFish> all = drawn(surface);
        EXPECT_GT(all.size(), 2800U);
        for (const DrawnFish& fish : all) {
            const std::size_t i = fish.id / 7;
            const motion::PresentedFish expected =
                motion::present(school.before[i], school.after[i], fraction, school.traits[i]);
            const float bodyLength = expected.lengthMetres;
            ASSERT_LT(glm::distance(fish.positionMetres, expected.positionMetres),
                      1e-4F * bodyLength);
            // Half a unit of a quaternion moves the nose by as many body lengths.
            ASSERT_LT(glm::distance(fish.rotation, expected.rotation), 1e-4F);
            ASSERT_LT(glm::distance(fish.gaze, expected.gaze), 1e-5F);
            ASSERT_NEAR(fish.mouth, expected.mouth, 1e-6F);
            ASSERT_FLOAT_EQ(fish.lengthMetres, bodyLength);
            ASSERT_EQ(fish.action, expected.action);
            ASSERT_EQ(fish.fromAction, expected.fromAction);
            // A cycle moves no point by more than a body length.
            const float phaseApart = std::abs(fish.phase - expected.phase);
            ASSERT_LT(std::min(phaseApart, 1.0F - phaseApart), 1e-5F) << i;
            ASSERT_NEAR(fish.fromPhase, expected.fromPhase, 1e-5F);
            ASSERT_NEAR(fish.warpWeight, expected.warpWeight, 1e-5F) << i;
        }
    }
}

TEST_F(VisibilityTest, aQuarterOfAMillionFishAreSorted) {
    const TwoTicks school(250'000, 13);
    SchoolSurface surface = surfaceOf(school, {});
    surface.update({school.before, school.after, 1.0F});
    surface.look(clip_, kShared);
    const FrustumPlanes frustum = frustumOf(clip_);
    const float reach = reachOf(recordedPoints(body_, repertoire_));
    std::size_t expected = 0;
    for (std::size_t i = 0; i < school.traits.size(); ++i) {
        if (motion::isAway(school.before[i]) || motion::isAway(school.after[i])) continue;
        const glm::vec3 place = motion::bodyFrameOf(school.after[i]).position;
        const float length = 0.001F * static_cast<float>(school.traits[i].lengthMillimetres);
        expected += frustum.sees(place, marginOf(kShared, place, length, reach)) ? 1 : 0;
    }
    const auto found = static_cast<double>(surface.counts().visible);
    EXPECT_NEAR(found, static_cast<double>(expected), 3);  // some lie on a plane
    EXPECT_GT(found, 10'000);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(VisibilityTest, withoutATickBeforeFishAreAtTheTick) {
    const TwoTicks school(50, 3);
    SchoolSurface surface = surfaceOf(school, {.culling = false});
    surface.update({{}, school.after, 0.25F});
    surface.look(clip_, kShared);
    for (const DrawnFish& fish : drawn(surface)) {
        const motion::FishRecord& record = school.after[fish.id / 7];
        EXPECT_LT(glm::distance(fish.positionMetres, motion::bodyFrameOf(record).position), 1e-5F);
    }
}

// Whatever was drawn before; within a list they are in the order of the school.
TEST_F(VisibilityTest, theOrderIsAlwaysThatOfTheSchool) {
    const TwoTicks school(4000, 5);
    SchoolSurface surface = surfaceOf(school, {});
    const auto idsSeen = [&](float fraction) {
        surface.update({school.before, school.after, fraction});
        surface.look(clip_, kShared);
        std::vector<std::uint32_t> ids;
        for (const DrawnFish& fish : drawn(surface)) ids.push_back(fish.id);
        return ids;
    };
    const auto first = idsSeen(0.5F);
    (void)idsSeen(1.0F);
    EXPECT_EQ(idsSeen(0.5F), first);
    const std::vector<DrawnFish> fish = drawn(surface);
    for (std::size_t i = 1; i < fish.size(); ++i) {
        if (fish[i].level != fish[i - 1].level || fish[i].species != fish[i - 1].species) continue;
        ASSERT_LT(fish[i - 1].id, fish[i].id);
    }
}

TEST_F(VisibilityTest, recordsBeyondTheSchoolAreLeftOutAndMissingOnesAreNotDrawn) {
    const TwoTicks school(200, 3);
    SchoolSurface surface = surfaceOf(school, {.culling = false});
    surface.update({{}, std::span(school.after).first(120)});
    surface.look(clip_, kShared);
    for (const DrawnFish& fish : drawn(surface)) EXPECT_LT(fish.id, 7U * 120);
    std::vector<motion::FishRecord> more = school.after;
    more.resize(400, school.after.front());
    surface.update({{}, more});
    surface.look(clip_, kShared);
    EXPECT_LE(surface.counts().visible, 200U);
}

TEST_F(VisibilityTest, neighbouringChannelsChooseTheSameLevels) {
    const glm::vec3 up{0, 1, 0}, eye = kShared.eyeMetres;
    // One channel looks from the shared eye, the other from beside it and with a longer lens.
    const glm::mat4 left = clip_ * glm::lookAt(eye, eye + glm::vec3{-0.3F, 0, -1}, up);
    const glm::mat4 right =
        test::clipFromCamera(0.6F, 1.0F) *
        glm::lookAt(eye + glm::vec3{0.3F, 0, 0}, eye + glm::vec3{-0.1F, 0, -1}, up);
    const TwoTicks school(6000, 21);
    SchoolSurface surface = surfaceOf(school, {});
    const auto found = [&](const glm::mat4& clip) {
        surface.update({school.before, school.after, 0.5F});
        surface.look(clip, kShared);
        std::map<std::uint32_t, DrawnFish> fish;
        for (const DrawnFish& one : drawn(surface)) fish[one.id] = one;
        return fish;
    };
    const auto inLeft = found(left), inRight = found(right);
    std::size_t both = 0;
    for (const auto& [id, fish] : inLeft) {
        const auto other = inRight.find(id);
        if (other == inRight.end()) continue;
        ++both;
        EXPECT_EQ(fish.level, other->second.level);
        EXPECT_EQ(fish.blend, other->second.blend);
    }
    EXPECT_GT(both, 100U);
}

}  // namespace
}  // namespace aquarama::surface
