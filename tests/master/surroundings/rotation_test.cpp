// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "master/surroundings/vessel.h"

namespace aquarama::surroundings {
namespace {

TEST(Rotation, sineAndCosineAreThoseOfTheTables) {
    for (int i = -2000; i <= 2000; ++i) {
        const float angle = 0.005F * static_cast<float>(i);
        const auto [sine, cosine] = sineAndCosine(angle);
        EXPECT_NEAR(sine, std::sin(angle), 2e-6F) << angle;
        EXPECT_NEAR(cosine, std::cos(angle), 2e-6F) << angle;
    }
}

TEST(Rotation, anAngleIsWrappedToHalfATurn) {
    EXPECT_NEAR(wrapped(3.5F), 3.5F - 2 * place::kPi, 1e-5F);
    EXPECT_NEAR(wrapped(-7.0F), 2 * place::kPi - 7.0F, 1e-5F);
    EXPECT_EQ(wrapped(1.25F), 1.25F);
}

// The quaternion that nodes look through turns -z into the nose and x, without roll, to the right.
TEST(Rotation, worldFromBodyLooksAlongTheNose) {
    for (const float yaw : {-3.0F, -0.4F, 0.0F, 1.2F, 2.8F})
        for (const float pitch : {-0.4F, 0.0F, 0.3F}) {
            const Attitude attitude{yaw, pitch, 0};
            const motion::Quaternion q = worldFromBody(attitude);
            const glm::quat turn{q.w, q.x, q.y, q.z};
            EXPECT_NEAR(glm::distance(turn * glm::vec3(0, 0, -1), noseOf(attitude)), 0, 1e-5F);
            EXPECT_NEAR(glm::distance(turn * glm::vec3(1, 0, 0), rightOf(attitude)), 0, 1e-5F);
        }
    EXPECT_GT(noseOf({0, 0.3F, 0}).y, 0) << "pitched up";
    EXPECT_LT(noseOf({0.3F, 0, 0}).x, 0) << "yawed to the left";
    const motion::Quaternion q = worldFromBody({0, 0, 0.1F});
    EXPECT_GT((glm::quat{q.w, q.x, q.y, q.z} * glm::vec3(1, 0, 0)).y, 0) << "right side up";
}

}  // namespace
}  // namespace aquarama::surroundings
