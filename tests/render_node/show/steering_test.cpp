// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render_node/show/controls.h"

namespace aquarama::show {
namespace {

using std::chrono::milliseconds;

Steering holding(std::initializer_list<gl::HeldKey> keys) {
    gl::Hands hands;
    for (const gl::HeldKey key : keys) hands.hold(key);
    return steeringOf(hands);
}

TEST(Steering, eachKeyDoesItsOwnAndNothingElse) {
    const std::vector<std::pair<gl::HeldKey, Steering>> expected{
        {gl::HeldKey::W, {.ahead = 127}},
        {gl::HeldKey::S, {.ahead = -127}},
        {gl::HeldKey::Up, {.ahead = 127}},
        {gl::HeldKey::Down, {.ahead = -127}},
        {gl::HeldKey::A, {.aside = -127}},
        {gl::HeldKey::D, {.aside = 127}},
        {gl::HeldKey::Left, {.turn = 127}},
        {gl::HeldKey::Right, {.turn = -127}},
        {gl::HeldKey::PageUp, {.up = 127}},
        {gl::HeldKey::PageDown, {.up = -127}},
        {gl::HeldKey::Home, {.tilt = 127}},
        {gl::HeldKey::End, {.tilt = -127}},
    };
    ASSERT_EQ(expected.size(), gl::kHeldKeys);
    for (const auto& [key, steering] : expected) EXPECT_EQ(holding({key}), steering) << int(key);
    EXPECT_EQ(holding({}), Steering{});
    EXPECT_EQ(holding({gl::HeldKey::W, gl::HeldKey::Up}).ahead, 127) << "full is full";
    EXPECT_EQ(holding({gl::HeldKey::Left, gl::HeldKey::Right}), Steering{});
}

// Dragged to the right it turns right, dragged up the nose goes up: as far as it is dragged.
TEST(Steering, theMouseTurnsByHowFarItIsDragged) {
    const auto dragged = [](glm::vec2 drag) {
        gl::Hands hands;
        hands.drag = drag;
        return steeringOf(hands);
    };
    EXPECT_EQ(dragged({0.01F, -0.01F}), Steering{}) << "a hand that trembles";
    EXPECT_EQ(dragged({0.5F, 0}), (Steering{.turn = -127}));
    EXPECT_EQ(dragged({0, 0.5F}), (Steering{.tilt = 127}));
    EXPECT_EQ(dragged({-3, -3}), (Steering{.turn = 127, .tilt = -127}));
    const int half = dragged({-0.18F, 0}).turn;
    EXPECT_GT(half, 10);
    EXPECT_LT(half, 60);
}

TEST(Steering, sticksRestWithinTheirDeadZone) {
    gl::Hands hands;
    hands.pad = {{0.1F, -0.14F}, {-0.1F, 0.05F}, 0.1F, 0};
    EXPECT_EQ(steeringOf(hands), Steering{});
}

TEST(Steering, eachStickAndTriggerDoesItsOwn) {
    const auto with = [](const gl::Pad& pad) {
        gl::Hands hands;
        hands.pad = pad;
        return steeringOf(hands);
    };
    EXPECT_EQ(with({.leftStick = {0, 1}}), (Steering{.ahead = 127}));
    EXPECT_EQ(with({.leftStick = {-1, 0}}), (Steering{.aside = -127}));
    EXPECT_EQ(with({.rightStick = {1, 0}}), (Steering{.turn = -127}));
    EXPECT_EQ(with({.rightStick = {0, -1}}), (Steering{.tilt = -127}));
    EXPECT_EQ(with({.rightTrigger = 1}), (Steering{.up = 127}));
    EXPECT_EQ(with({.leftTrigger = 1}), (Steering{.up = -127}));
}

TEST(SteeringPace, nothingIsSaidOfHandsThatHoldNothing) {
    SteeringPace pace;
    for (int ms = 0; ms < 5000; ms += 10) EXPECT_FALSE(pace.due({}, net::Moment{milliseconds(ms)}));
}

TEST(SteeringPace, aChangeGoesOutAtOnceAndWhatIsHeldIsRepeated) {
    SteeringPace pace;
    const Steering ahead{.ahead = 127};
    EXPECT_EQ(pace.due(ahead, net::Moment{milliseconds(1000)}), ahead);
    int said = 0;
    for (int ms = 1010; ms <= 2000; ms += 10)
        said += pace.due(ahead, net::Moment{milliseconds(ms)}) ? 1 : 0;
    EXPECT_EQ(said, 10);
    EXPECT_EQ(pace.due({}, net::Moment{milliseconds(2035)}), Steering{}) << "letting go is said";
    EXPECT_FALSE(pace.due({}, net::Moment{milliseconds(4000)}));
}

TEST(SteeringPace, handsThatNeverRestSpeakThirtyTimesASecond) {
    SteeringPace pace;
    int said = 0;
    for (int ms = 0; ms < 1000; ++ms) {
        const Steering trembling{.turn = static_cast<std::int8_t>(1 + ms % 100)};
        said += pace.due(trembling, net::Moment{milliseconds(ms)}) ? 1 : 0;
    }
    EXPECT_LE(said, 31);
    EXPECT_GE(said, 29);
}

}  // namespace
}  // namespace aquarama::show
