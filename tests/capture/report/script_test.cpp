// SPDX-License-Identifier: Apache-2.0
#include "capture/report/script.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "common/base/units.h"
#include "tests/support/synthetic_repertoire.h"

namespace aquarama::report {
namespace {

Script scriptOf(std::uint64_t seed, double seconds = 60) {
    static const motion::Repertoire repertoire = test::syntheticRepertoire(false);
    return makeScript(repertoire, seed, seconds);
}

bool same(const Script& a, const Script& b) {
    return std::ranges::equal(a, b, [](const ScriptCommand& one, const ScriptCommand& other) {
        return one.manoeuvre == other.manoeuvre && one.ticks == other.ticks;
    });
}

TEST(FidelityScript, isAFunctionOfItsSeed) {
    EXPECT_TRUE(same(scriptOf(7), scriptOf(7)));
    EXPECT_FALSE(same(scriptOf(7), scriptOf(8)));
}

TEST(FidelityScript, aLongerOneBeginsLikeAShorterOne) {
    const Script brief = scriptOf(3, 20);
    Script longer = scriptOf(3, 60);
    longer.resize(brief.size());
    EXPECT_TRUE(same(brief, longer));
}

TEST(FidelityScript, fillsItsSecondsAndEndsWithTheCommandThatDoes) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const Script script = scriptOf(seed);
        EXPECT_GE(ticksOf(script), 60 * kTicksPerSecond);
        EXPECT_LT(ticksOf(script) - script.back().ticks, 60 * kTicksPerSecond);
    }
}

TEST(FidelityScript, turnsOutOfMediumSwimmingAndForAWholeSegment) {
    const auto gaits = synthetic::gaits();
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const Script script = scriptOf(seed);
        for (std::size_t i = 1; i < script.size(); ++i) {
            if (!isTurn(script[i].manoeuvre)) continue;
            EXPECT_EQ(script[i - 1].manoeuvre, Manoeuvre::ForwardMedium);
            const double seconds = gaits.at(indexOf(actionOf(script[i].manoeuvre))).periodSeconds;
            EXPECT_NEAR(script[i].ticks, seconds * kTicksPerSecond, 1);
        }
    }
}

TEST(FidelityScript, holdsAGaitForSomeOfItsBeats) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const Script script = scriptOf(seed);
        for (const ScriptCommand& command : script) {
            if (command.manoeuvre > Manoeuvre::ForwardFast) continue;
            EXPECT_GE(command.ticks, 3 * command.beatTicks);
        }
    }
}

TEST(FidelityScript, knowsEveryManoeuvreButCurvesAndThoseInOnePlace) {
    std::set<Manoeuvre> seen;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        for (const ScriptCommand& command : scriptOf(seed)) seen.insert(command.manoeuvre);
    for (int i = 0; i < kManoeuvres; ++i) {
        const auto manoeuvre = static_cast<Manoeuvre>(i);
        EXPECT_EQ(seen.contains(manoeuvre), !isCurve(manoeuvre) && !staysInPlace(manoeuvre))
            << nameOf(manoeuvre);
    }
}

}  // namespace
}  // namespace aquarama::report
