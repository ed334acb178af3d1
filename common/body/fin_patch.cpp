// SPDX-License-Identifier: Apache-2.0
#include "common/body/fin_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>

#include "common/body/monotone_curve.h"

namespace aquarama::body {

namespace {

constexpr int kSamples = 101;

std::vector<float> evenSteps(std::size_t count) {
    std::vector<float> steps(count);
    for (std::size_t i = 0; i < count; ++i)
        steps[i] = static_cast<float>(i) / static_cast<float>(count - 1);
    return steps;
}

std::vector<float> sampled(const std::vector<glm::vec2>& points, int component) {
    std::vector<float> values(points.size());
    std::ranges::transform(
        points, values.begin(), [&](glm::vec2 point) { return point[component]; });
    const MonotoneCurve curve(evenSteps(points.size()), values);
    std::vector<float> samples = evenSteps(kSamples);
    for (float& sample : samples) sample = curve.at(sample);
    return samples;
}

}  // namespace

FinPatch::FinPatch(const config::Fin& fin)
    : p_(evenSteps(kSamples)),
      baseS_(sampled(fin.base, 0)),
      baseY_(sampled(fin.base, 1)),
      edgeS_(sampled(fin.edge, 0)),
      edgeY_(sampled(fin.edge, 1)),
      angleRadians_(fin.angleRadians),
      round_(fin.round) {}

glm::vec2 FinPatch::at(float p, float q) const {
    const glm::vec2 base{interpolate(p_, baseS_, p), interpolate(p_, baseY_, p)};
    const glm::vec2 edge{interpolate(p_, edgeS_, p), interpolate(p_, edgeY_, p)};
    return glm::mix(base, edge, q);
}

glm::vec2 FinPatch::paddleAt(float p, float q) const {
    const float paddle = 1 + 0.3F * std::sin(std::numbers::pi_v<float> * q) - 0.42F * q * q;
    const glm::vec2 middle = at(0.5F, q);
    return middle + glm::mix(1.0F, paddle, round_) * (at(p, q) - middle);
}

float FinPatch::rayAtStation(float s) const {
    return interpolate(baseS_, p_, s);
}

}  // namespace aquarama::body
