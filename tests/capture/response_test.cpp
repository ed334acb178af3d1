// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>

#include "capture/speed_response.h"
#include "tests/capture/all_species.h"

namespace aquarama::capture {
namespace {

using Response = EachSpecies;
INSTANTIATE_TEST_SUITE_P(Of,
                         Response,
                         testing::Range(std::size_t{0}, allSpecies().size()),
                         nameOfSpecies);

SpeedLaw swimOf(const motion::SpeedResponse& response, std::size_t gait) {
    return {.swimDrag = static_cast<double>(response.swimDrag.at(gait))};
}

SpeedLaw brakeOf(const motion::SpeedResponse& response) {
    return {.glideDrag = static_cast<double>(response.glideDrag),
            .brakeRate = static_cast<double>(response.brakeRate)};
}

// The speeds of a fish that obeys the law, from the transition's first speed on.
std::vector<double> replayLaw(const Transition& transition, const SpeedLaw& law) {
    std::vector<double> speeds{transition.speeds.front()};
    while (speeds.size() < transition.speeds.size()) {
        const double v = speeds.back();
        speeds.push_back(v +
                         transition.sampleSeconds * acceleration(law, transition.segmentSpeed, v));
    }
    return speeds;
}

// Root mean square over the transition, as a share of the higher of its two speeds.
double errorOf(const Transition& transition, const SpeedLaw& law) {
    const std::vector<double> speeds = replayLaw(transition, law);
    double squares = 0;
    for (std::size_t i = 0; i < speeds.size(); ++i)
        squares += (speeds[i] - transition.speeds[i]) * (speeds[i] - transition.speeds[i]);
    return std::sqrt(squares / static_cast<double>(speeds.size())) /
           std::max(transition.segmentSpeed, transition.speeds.front());
}

// Of the way, at the end of the transition.
double wayErrorOf(const Transition& transition, const SpeedLaw& law) {
    const std::vector<double> speeds = replayLaw(transition, law);
    const double way = std::accumulate(speeds.begin(), speeds.end(), 0.0);
    const double swum = std::accumulate(transition.speeds.begin(), transition.speeds.end(), 0.0);
    return std::abs(way / swum - 1);
}

// The most by which the place is off at any time, body lengths.
double farthestOff(const Transition& transition, const SpeedLaw& law) {
    const std::vector<double> speeds = replayLaw(transition, law);
    double off = 0;
    double most = 0;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        off += transition.sampleSeconds * (speeds[i] - transition.speeds[i]);
        most = std::max(most, std::abs(off));
    }
    return most;
}

TEST_P(Response, theLawReplaysEveryChangeOfSpeed) {
    const config::Swim& gaits = species().swim;
    const SteadySwimming slow = swimUntilSteady(species(), gaits.slow);
    const SteadySwimming medium = swimUntilSteady(species(), gaits.medium);
    const SteadySwimming fast = swimUntilSteady(species(), gaits.fast);
    const SteadySwimming retreat =
        swimUntilSteady(species(), rowingOrder(species(), Controller::Retreat));
    const Transitions swum = swimTransitions(species(), {&slow, &medium, &fast}, retreat);
    const motion::SpeedResponse response = fitResponse(swum);
    for (std::size_t gait = 0; gait < swum.swim.size(); ++gait)
        for (const Transition& change : swum.swim.at(gait)) {
            EXPECT_LT(errorOf(change, swimOf(response, gait)), 0.04) << "to gait " << gait;
            EXPECT_LT(wayErrorOf(change, swimOf(response, gait)), 0.05) << "to gait " << gait;
        }
    const SpeedLaw backing{.swimDrag = static_cast<double>(response.retreatDrag)};
    if (species().finMotion.rowing.rows()) {
        EXPECT_LT(errorOf(swum.retreat, backing), 0.05) << swum.retreat.speeds.back();
        EXPECT_LT(farthestOff(swum.retreat, backing), 0.04) << "body lengths";
    }
    EXPECT_LT(errorOf(swum.glide, {.glideDrag = static_cast<double>(response.glideDrag)}), 0.05);
    EXPECT_LT(errorOf(swum.brake, brakeOf(response)), 0.03);
    EXPECT_LT(wayErrorOf(swum.brake, brakeOf(response)), 0.03);
}

TEST_P(Response, isKeptInTheRepertoire) {
    const auto& [swim, retreat, glide, brake] = repertoire().response;
    for (const float drag : swim)
        EXPECT_GT(drag, 0) << "a beating tail holds the fish to its speed";
    EXPECT_EQ(retreat > 0, species().finMotion.rowing.rows());
    EXPECT_GT(glide, 0);
    const auto medium = segment(motion::Action::ForwardMedium);
    EXPECT_GT(brake * medium.periodSeconds, 0.5F) << "fins stop a fish within some beats";
}

Transition obeying(const SpeedLaw& law, double from, double to) {
    Transition transition{
        .sampleSeconds = 1e-3, .segmentSpeed = to, .speeds = std::vector<double>(2000, from)};
    transition.speeds = replayLaw(transition, law);
    return transition;
}

TEST(SpeedResponse, findsTheNumbersOfAFishThatObeysTheLaw) {
    const SpeedLaw gliding{.glideDrag = 0.3};
    for (const double number : {0.05, 0.3, 4.0}) {
        const SpeedLaw glide{.glideDrag = number};
        EXPECT_NEAR(fitTerm({obeying(glide, 1.5, 0)}, &SpeedLaw::glideDrag, {}) / number, 1, 0.01);
        const SpeedLaw swim{.swimDrag = number};
        const std::vector<Transition> both{obeying(swim, 0.5, 2), obeying(swim, 2, 0.5)};
        EXPECT_NEAR(fitTerm(both, &SpeedLaw::swimDrag, {}) / number, 1, 0.01);
        const SpeedLaw brake{.glideDrag = 0.3, .brakeRate = number};
        EXPECT_NEAR(
            fitTerm({obeying(brake, 1.5, 0)}, &SpeedLaw::brakeRate, gliding) / number, 1, 0.01);
    }
}

// dv/dt = -k v^2 has the closed form v = v0 / (1 + k v0 t).
TEST(SpeedResponse, coastsAsTheClosedFormDoes) {
    const Transition glide = obeying({.glideDrag = 0.4}, 2, 0);
    for (std::size_t i = 0; i < glide.speeds.size(); i += 100)
        EXPECT_NEAR(glide.speeds[i], 2 / (1 + 0.4 * 2 * 1e-3 * static_cast<double>(i)), 2e-3);
}

// dv/dt = k p (p - v) has the closed form v = p + (v0 - p) exp(-k p t). A fish that is faster than
// p by u obeys du/dt = -k (p + c u) u, with the closed form u = u0 exp(-k p t) / (1 + c u0 / p (1 -
// exp(-k p t))).
TEST(SpeedResponse, gathersAndLosesSpeedAsTheClosedFormDoes) {
    for (const double from : {0.5, 3.0}) {
        const Transition change = obeying({.swimDrag = 0.4}, from, 2);
        const double c = from > 2 ? static_cast<double>(motion::kExcessDrag) : 0;
        for (std::size_t i = 0; i < change.speeds.size(); i += 100) {
            const double left = std::exp(-0.4 * 2 * 1e-3 * static_cast<double>(i));
            const double faster = (from - 2) * left / (1 + c * (from - 2) / 2 * (1 - left));
            EXPECT_NEAR(change.speeds[i], 2 + faster, 2e-3);
        }
    }
}

TEST(SpeedResponse, aFishThatDoesNotSlowDownHasNoDrag) {
    EXPECT_EQ(fitTerm({{.sampleSeconds = 0.1, .segmentSpeed = 0, .speeds = {1, 1.1, 1.2}}},
                      &SpeedLaw::glideDrag,
                      {}),
              0);
}

}  // namespace
}  // namespace aquarama::capture
