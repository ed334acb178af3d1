// SPDX-License-Identifier: Apache-2.0
// The noise of a camera as a function of the light of a pixel.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace aquarama::scan {

// Measured in the pictures themselves: add() all samples, trim(), add() them again, finish().
class NoiseCurve {
  public:
    explicit NoiseCurve(float mostLight) : most_{std::max(mostLight, 1e-6F)} { limit_.fill(1e30); }
    // `square`: the square of a deviation at this light.
    void add(float light, float square) {
        const std::size_t bin = binOf(light);
        if (double{square} > limit_[bin]) return;
        sum_[bin] += double{square};
        ++count_[bin];
    }
    // Begins anew, and drops samples beyond four of the standard deviations found so far.
    void trim() {
        for (std::size_t i = 0; i < kBins; ++i) limit_[i] = 16 * variances()[i] + 1e-12;
        sum_.fill(0);
        count_.fill(0);
    }
    void finish() { result_ = variances(); }
    [[nodiscard]] float variance(float light) const {
        return static_cast<float>(result_[binOf(light)]);
    }

  private:
    static constexpr std::size_t kBins = 24;
    [[nodiscard]] std::size_t binOf(float light) const {
        const float share = std::sqrt(std::clamp(light / most_, 0.0F, 1.0F));
        return std::min(kBins - 1, static_cast<std::size_t>(share * kBins));
    }
    [[nodiscard]] std::array<double, kBins> variances() const {
        std::array<double, kBins> found{};
        double last = 1e-12;
        for (std::size_t i = 0; i < kBins; ++i) {
            if (count_[i] > 50) last = sum_[i] / static_cast<double>(count_[i]);
            found[i] = last;
        }
        return found;
    }

    float most_;
    std::array<double, kBins> sum_{}, limit_{}, result_{};
    std::array<std::size_t, kBins> count_{};
};

}  // namespace aquarama::scan
