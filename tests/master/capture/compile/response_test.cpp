// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "master/capture/compile/speed_response.h"
#include "tests/master/capture/compile/all_species.h"

namespace aquarama {
namespace {

using Response = EachSpecies;
INSTANTIATE_TEST_SUITE_P(Of,
                         Response,
                         testing::Range(std::size_t{0}, allSpecies().size()),
                         nameOfSpecies);

// Root mean square over the transition, as a share of the higher of its two speeds.
double errorOf(const Transition& transition, double drag) {
    const std::vector<double> law = replayLaw(transition, drag);
    double squares = 0;
    for (std::size_t i = 0; i < law.size(); ++i)
        squares += (law[i] - transition.speeds[i]) * (law[i] - transition.speeds[i]);
    return std::sqrt(squares / static_cast<double>(law.size())) /
           std::max(transition.segmentSpeed, transition.speeds.front());
}

TEST_P(Response, theLawReplaysWhatItWasFittedTo) {
    const Swim& gaits = species().swim;
    const Transitions swum = swimTransitions(species(),
                                             swimUntilSteady(species(), gaits.slow),
                                             swimUntilSteady(species(), gaits.medium),
                                             swimUntilSteady(species(), gaits.fast));
    const auto [swim, glide, brake] = fitResponse(swum);
    EXPECT_LT(errorOf(swum.slowToFast, static_cast<double>(swim)), 0.12);
    EXPECT_LT(errorOf(swum.mediumToSlow, static_cast<double>(swim)), 0.12) << "not fitted to";
    EXPECT_LT(errorOf(swum.glide, static_cast<double>(glide)), 0.05);
    EXPECT_LT(errorOf(swum.brake, static_cast<double>(glide + brake)), 0.12);
}

TEST_P(Response, isKeptInTheRepertoire) {
    const auto [swim, glide, brake] = repertoire().response;
    EXPECT_GT(swim, glide) << "a beating tail holds the fish to its speed";
    EXPECT_GT(glide, 0);
    EXPECT_GT(brake, glide) << "fins brake more than the body";
}

Transition obeying(double drag, double from, double to) {
    Transition transition{
        .sampleSeconds = 1e-3, .segmentSpeed = to, .speeds = std::vector<double>(2000, from)};
    transition.speeds = replayLaw(transition, drag);
    return transition;
}

TEST(SpeedResponse, findsTheDragOfAFishThatObeysTheLaw) {
    for (const double drag : {0.05, 0.3, 4.0})
        EXPECT_NEAR(fitDrag({obeying(drag, 0.5, 2), obeying(drag, 1.5, 0)}) / drag, 1, 0.01);
}

// dv/dt = -k v^2 has the closed form v = v0 / (1 + k v0 t).
TEST(SpeedResponse, coastsAsTheClosedFormDoes) {
    const Transition glide = obeying(0.4, 2, 0);
    for (std::size_t i = 0; i < glide.speeds.size(); i += 100)
        EXPECT_NEAR(glide.speeds[i], 2 / (1 + 0.4 * 2 * 1e-3 * static_cast<double>(i)), 2e-3);
}

TEST(SpeedResponse, aFishThatDoesNotSlowDownHasNoDrag) {
    EXPECT_EQ(fitDrag({{.sampleSeconds = 0.1, .segmentSpeed = 0, .speeds = {1, 1.1, 1.2}}}), 0);
}

}  // namespace
}  // namespace aquarama
