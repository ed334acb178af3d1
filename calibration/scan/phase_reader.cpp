// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "calibration/scan/axis_reader.h"
#include "calibration/scan/noise_curve.h"
#include "calibration/scan/stripe_table.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

namespace {

constexpr float kPeriod = wall::kScanPeriodPixels;
constexpr float kTurn = 2 * std::numbers::pi_v<float>;

class PhaseReader final : public AxisReader {
  public:
    PhaseReader(const AxisSignals& signals,
                const Plane& light,
                const std::vector<std::size_t>& owned,
                int pixels)
        : signals_{signals},
          code_{codeOf(signals, pixels)},
          light_{light},
          pixels_{static_cast<float>(pixels)},
          table_(pixels, code_, 1, kSoftPixels),
          noise_(mostSum(owned) / 4) {
        measureNoise(owned);
        measureRipple(owned);
    }

    [[nodiscard]] Reading read(std::size_t pixel) const override {
        if (!isModulated(pixel)) return {};
        const Bits bits = contrastsOf(signals_, pixel);
        const float within = placeInPeriod(pixel);
        const auto half = static_cast<float>(code_.finestPixels);
        const float centre = half * (static_cast<float>(stripeOf(bits, code_.bits)) + 0.5F);
        const float place = nearest(within, centre);
        if (isInside(place) && worstBit(bits, place) > kSureContrast)
            return {place, sigmaOf(pixel)};
        return {search(bits, within), sigmaOf(pixel)};
    }
    [[nodiscard]] Reading readNear(std::size_t pixel, float expected) const override {
        if (!isModulated(pixel)) return {};
        const float place = nearest(placeInPeriod(pixel), expected);
        if (!isInside(place) || std::abs(place - expected) > kPeriod / 4) return {};
        const Bits bits = contrastsOf(signals_, pixel);
        // Allows for one bit that is unclear or wrong.
        return score(bits, place) > 0.6F * weightOf(bits) ? Reading{place, sigmaOf(pixel)}
                                                          : Reading{};
    }
    [[nodiscard]] double noise() const override { return std::sqrt(noise_.variance(middle_)); }

  private:
    // The assumed blur of stripes: bits that are close to an edge do not count.
    static constexpr double kSoftPixels = 2.5;
    static constexpr float kSureContrast = 0.2F, kLeastMargin = 0.5F;
    // The least share of the light that is modulated; less means indirect light.
    static constexpr float kLeastModulation = 0.1F;
    static constexpr float kLeastSignal = 6;  // amplitude in standard deviations

    [[nodiscard]] float mostSum(const std::vector<std::size_t>& owned) const {
        float most = 0;
        for (const std::size_t p : owned) most = std::max(most, signals_.sum[p]);
        return most;
    }
    [[nodiscard]] float amplitude(std::size_t p) const {
        return 0.5F * std::hypot(signals_.cosine[p], signals_.sine[p]);
    }
    [[nodiscard]] bool isModulated(std::size_t p) const {
        const float wave = amplitude(p);
        return 2 * wave > kLeastModulation * light_[p] &&
               wave * wave >
                   kLeastSignal * kLeastSignal * 0.5F * noise_.variance(signals_.sum[p] / 4);
    }
    [[nodiscard]] float sigmaOf(std::size_t p) const {
        const float deviation = std::sqrt(0.5F * noise_.variance(signals_.sum[p] / 4));
        return kPeriod / kTurn * deviation / amplitude(p);
    }
    [[nodiscard]] float angle(std::size_t p) const {
        return std::atan2(signals_.sine[p], signals_.cosine[p]);
    }
    [[nodiscard]] float placeInPeriod(std::size_t p) const {
        const float raw = angle(p);
        const float turned =
            raw + 0.5F * (ripple_.real() * std::sin(4 * raw) - ripple_.imag() * std::cos(4 * raw));
        return turned * (kPeriod / kTurn);
    }
    [[nodiscard]] static float nearest(float within, float expected) {
        return within + kPeriod * std::round((expected - within) / kPeriod);
    }
    [[nodiscard]] bool isInside(float place) const { return place > -1 && place < pixels_ + 1; }

    // The least agreement of a bit with this place, of the bits that are far from an edge.
    [[nodiscard]] float worstBit(const Bits& bits, float place) const {
        float worst = 1;
        const std::span<const float> expected = table_.atPlace(place);
        for (std::size_t k = 0; k < expected.size(); ++k)
            if (std::abs(expected[k]) > 0.95F) worst = std::min(worst, expected[k] * bits[k]);
        return worst;
    }
    // The sum of the agreements of all bits with this place.
    [[nodiscard]] float score(const Bits& bits, float place) const {
        float sum = 0;
        const std::span<const float> expected = table_.atPlace(place);
        for (std::size_t k = 0; k < expected.size(); ++k)
            sum += expected[k] * std::clamp(bits[k], -1.0F, 1.0F);
        return sum;
    }
    [[nodiscard]] float weightOf(const Bits& bits) const {
        float sum = 0;
        for (int k = 0; k < code_.bits; ++k)
            sum += std::min(1.0F, std::abs(bits[static_cast<std::size_t>(k)]));
        return sum;
    }
    // The place, of those in all periods, that agrees best with the bits; unknown where a second
    // one agrees nearly as well.
    [[nodiscard]] float search(const Bits& bits, float within) const {
        float best = -1e9F, second = -1e9F, found = kUnknown;
        for (float place = within < -1 ? within + kPeriod : within; isInside(place);
             place += kPeriod) {
            const float sum = score(bits, place);
            second = std::max(second, std::min(best, sum));
            if (sum <= best) continue;
            best = sum;
            found = place;
        }
        const bool isSure = best - second > kLeastMargin && worstBit(bits, found) > 0;
        return isSure ? found : kUnknown;
    }

    // Measures the noise. Without noise, I0 + I2 = I1 + I3 where the response is linear. A response
    // that is not linear leaves a wave of twice the phase; it is subtracted.
    void measureNoise(const std::vector<std::size_t>& owned) {
        double product = 0, square = 0, light = 0;
        for (const std::size_t p : owned) {
            const float bend = bendAt(p);
            product += double{bend} * double{signals_.alternate[p]};
            square += double{bend} * double{bend};
            light += double{signals_.sum[p]} / 4;
        }
        middle_ =
            static_cast<float>(light / static_cast<double>(std::max<std::size_t>(1, owned.size())));
        const float bent = square > 0 ? static_cast<float>(product / square) : 0.0F;
        for (int pass = 0; pass < 2; ++pass) {
            if (pass > 0) noise_.trim();
            for (const std::size_t p : owned) {
                const float rest = 0.5F * (signals_.alternate[p] - bent * bendAt(p));
                noise_.add(signals_.sum[p] / 4, rest * rest);
            }
        }
        noise_.finish();
    }
    // The amplitude times the cosine of twice the phase.
    [[nodiscard]] float bendAt(std::size_t p) const {
        const float c = signals_.cosine[p], s = signals_.sine[p];
        const float length = std::hypot(c, s);
        return length > 0 ? (c * c - s * s) / length : 0.0F;
    }

    // Measures the ripple: a response that is not linear shifts the phase with four times its
    // frequency. The true phases are spread evenly, so any unevenness is this shift.
    void measureRipple(const std::vector<std::size_t>& owned) {
        constexpr std::size_t kParts = 4;
        constexpr float kMost = 0.2F, kAgree = 0.03F;
        std::array<std::complex<float>, kParts> parts{};
        for (std::size_t i = 0; i < kParts; ++i)
            parts.at(i) =
                meanFourth(owned, i * owned.size() / kParts, (i + 1) * owned.size() / kParts);
        const std::complex<float> mean = (parts[0] + parts[1] + parts[2] + parts[3]) / 4.0F;
        const bool agree = std::ranges::all_of(
            parts, [&](std::complex<float> part) { return std::abs(part - mean) < kAgree; });
        if (agree && std::abs(mean) < kMost) ripple_ = mean;
    }
    [[nodiscard]] std::complex<float> meanFourth(const std::vector<std::size_t>& owned,
                                                 std::size_t first,
                                                 std::size_t last) const {
        std::complex<double> sum = 0;
        double count = 0;
        for (std::size_t i = first; i < last; ++i) {
            if (!isModulated(owned[i])) continue;
            sum += std::polar(1.0, 4 * static_cast<double>(angle(owned[i])));
            ++count;
        }
        return std::complex<float>(sum / std::max(1.0, count));
    }

    const AxisSignals& signals_;
    AxisCode code_;
    const Plane& light_;
    float pixels_;
    StripeTable table_;
    NoiseCurve noise_;
    float middle_ = 0;
    std::complex<float> ripple_ = 0;
};

}  // namespace

std::unique_ptr<AxisReader> makePhaseReader(const AxisSignals& signals,
                                            const Plane& light,
                                            const std::vector<std::size_t>& owned,
                                            int pixelsOfAxis) {
    return std::make_unique<PhaseReader>(signals, light, owned, pixelsOfAxis);
}

}  // namespace aquarama::scan
