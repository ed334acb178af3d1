// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/scan/axis_reader.h"
#include "calibration/scan/stripe_table.h"

namespace aquarama::scan {

namespace {

class StripeReader final : public AxisReader {
  public:
    StripeReader(const AxisSignals& signals,
                 const Plane& light,
                 const std::vector<std::size_t>& owned,
                 int pixels)
        : signals_{signals},
          code_{codeOf(signals, pixels)},
          light_{light},
          table_{bestTable(owned, pixels)} {
        double sum = 0, count = 0;
        for (std::size_t i = 0; i < owned.size(); i += 7) {
            const Fit fit = fitAlone(contrastsOf(signals_, owned[i]), table_);
            if (fit.likeness < kLeastLikeness) continue;
            sum += double{fit.rest} * double{light_[owned[i]]} * double{light_[owned[i]]} / 4;
            ++count;
        }
        noise_ = std::sqrt(sum / std::max(1.0, count));
    }

    [[nodiscard]] Reading read(std::size_t pixel) const override {
        return readingOf(pixel, fitAlone(contrastsOf(signals_, pixel), table_));
    }
    [[nodiscard]] Reading readNear(std::size_t pixel, float expected) const override {
        const int sample = static_cast<int>(expected * static_cast<float>(table_.perPixel()));
        return readingOf(pixel, fitNear(contrastsOf(signals_, pixel), table_, sample));
    }
    [[nodiscard]] double noise() const override { return noise_; }

  private:
    static constexpr int kPerPixel = 8;
    static constexpr float kLeastLikeness = 0.85F;
    static constexpr float kLeastContrast = 0.1F;

    struct Fit {
        float likeness = 0;  // squared correlation
        float place = kUnknown;
        float contrast = 0;
        float rest = 0;   // variance that the stripes do not explain
        float slope = 0;  // of all bits together, for one pixel
    };

    [[nodiscard]] Reading readingOf(std::size_t pixel, const Fit& fit) const {
        if (fit.likeness < kLeastLikeness || fit.contrast < kLeastContrast) return {};
        const float signal = 0.5F * light_[pixel] * fit.contrast * fit.slope;
        const float flat = static_cast<float>(code_.finestPixels) / std::sqrt(12.0F);
        return {fit.place, std::min(flat, static_cast<float>(noise_) / std::max(signal, 1e-9F))};
    }

    // How well the bits agree with the stripes at a place.
    struct Likeness {
        float product = 0, square = 1e-9F;
        // The squared correlation, for bits of this power.
        [[nodiscard]] float of(float power) const {
            return product > 0 ? product * product / (square * power) : 0.0F;
        }
    };
    [[nodiscard]] static Likeness likeness(const Bits& bits, const StripeTable& table, int sample) {
        Likeness result;
        const std::span<const float> expected = table.at(sample);
        for (std::size_t k = 0; k < expected.size(); ++k) {
            result.product += bits[k] * expected[k];
            result.square += expected[k] * expected[k];
        }
        return result;
    }
    [[nodiscard]] static float powerOf(const Bits& bits) {
        float power = 1e-9F;
        for (const float bit : bits) power += bit * bit;
        return power;
    }

    // The best fit near a sample of the table.
    [[nodiscard]] Fit fitNear(const Bits& bits, const StripeTable& table, int start) const {
        const int reach = 5 * kPerPixel / 2 * code_.finestPixels;
        const float power = powerOf(bits);
        const auto value = [&](int sample) { return likeness(bits, table, sample).of(power); };
        int best = start;
        float most = 0;
        const auto look = [&](int sample) {
            const float found = value(sample);
            if (found <= most) return;
            most = found;
            best = sample;
        };
        const int step = 2 * code_.finestPixels;
        for (int i = start - reach; i <= start + reach; i += step) look(i);
        for (int i = step / 2; i >= 1; i /= 2) {
            const int middle = best;
            look(middle - i);
            look(middle + i);
        }
        return refined(bits, table, best, power);
    }
    // Finds the place between the samples by a parabola through three of them.
    [[nodiscard]] Fit refined(const Bits& bits,
                              const StripeTable& table,
                              int best,
                              float power) const {
        if (best < 0 || best >= table.samples()) return {};
        const Likeness here = likeness(bits, table, best);
        const float before = likeness(bits, table, best - 1).of(power);
        const float after = likeness(bits, table, best + 1).of(power);
        const float most = here.of(power);
        const float bend = before - 2 * most + after;
        const float offset =
            bend < -1e-9F ? std::clamp(0.5F * (before - after) / bend, -0.5F, 0.5F) : 0.0F;
        const auto count = static_cast<float>(std::max(1, code_.bits - 2));
        return {.likeness = most,
                .place = (static_cast<float>(best) + 0.5F + offset) / kPerPixel,
                .contrast = here.product / here.square,
                .rest = power * (1 - most) / count,
                .slope = slopeAt(table, best)};
    }
    [[nodiscard]] static float slopeAt(const StripeTable& table, int sample) {
        const std::span<const float> before = table.at(sample - 1), after = table.at(sample + 1);
        float sum = 0;
        for (std::size_t k = 0; k < before.size(); ++k) {
            const float slope = (after[k] - before[k]) * kPerPixel / 2;
            sum += slope * slope;
        }
        return std::sqrt(sum);
    }

    // The best fit of the code as it is, and with one or both of its faintest bits inverted.
    [[nodiscard]] Fit fitAlone(const Bits& bits, const StripeTable& table) const {
        const std::array<unsigned, 2> faint = faintest(bits);
        Fit best;
        for (const unsigned flipped : {0U, faint[0], faint[1], faint[0] | faint[1]}) {
            const int stripe = stripeOf(bits, code_.bits, flipped);
            const int middle = (2 * stripe + 1) * code_.finestPixels * kPerPixel / 2;
            const Fit fit = fitNear(bits, table, middle);
            if (fit.likeness > best.likeness) best = fit;
            if (best.likeness > kSureLikeness) break;
        }
        return best;
    }
    static constexpr float kSureLikeness = 0.97F;
    [[nodiscard]] std::array<unsigned, 2> faintest(const Bits& bits) const {
        std::array<unsigned, 2> found{};
        std::array<float, 2> least{1e9F, 1e9F};
        for (int k = 0; k < code_.bits; ++k) {
            const float size = std::abs(bits[static_cast<std::size_t>(k)]);
            const std::size_t slot = size < least[0] ? 0 : 1;
            if (size >= least[slot]) continue;
            if (slot == 0) {
                least[1] = least[0];
                found[1] = found[0];
            }
            least[slot] = size;
            found[slot] = 1U << static_cast<unsigned>(code_.bits - 1 - k);
        }
        return found;
    }

    // The table of the blur that fits a sample of the pixels best.
    [[nodiscard]] StripeTable bestTable(const std::vector<std::size_t>& owned, int pixels) const {
        StripeTable best(pixels, code_, kPerPixel, 0.5);
        float most = 0;
        for (const double blur : {0.35, 0.5, 0.65, 0.8, 1.0, 1.25, 1.6}) {
            StripeTable table(pixels, code_, kPerPixel, blur);
            const float like = meanLikeness(owned, table);
            if (like <= most) continue;
            most = like;
            best = std::move(table);
        }
        return best;
    }
    [[nodiscard]] float meanLikeness(const std::vector<std::size_t>& owned,
                                     const StripeTable& table) const {
        constexpr std::size_t kSamples = 2000;
        float sum = 0;
        for (std::size_t i = 0; i < std::min(kSamples, owned.size()); ++i) {
            const std::size_t pixel = owned[i * owned.size() / std::min(kSamples, owned.size())];
            sum += fitAlone(contrastsOf(signals_, pixel), table).likeness;
        }
        return sum;
    }

    const AxisSignals& signals_;
    AxisCode code_;
    const Plane& light_;
    StripeTable table_;
    double noise_ = 0;
};

}  // namespace

std::unique_ptr<AxisReader> makeStripeReader(const AxisSignals& signals,
                                             const Plane& light,
                                             const std::vector<std::size_t>& owned,
                                             int pixelsOfAxis) {
    return std::make_unique<StripeReader>(signals, light, owned, pixelsOfAxis);
}

}  // namespace aquarama::scan
