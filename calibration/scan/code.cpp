// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/code.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "calibration/scan/tag.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

namespace {

using Kind = config::ScanPattern::Kind;

constexpr float kPeriod = wall::kScanPeriodPixels;
constexpr float kTurn = 2 * std::numbers::pi_v<float>;
constexpr int kMostBits = 16;

using Bits = std::array<float, kMostBits>;

Bits contrastsOf(const AxisSignals& signals, std::size_t pixel) {
    Bits bits{};
    const auto count = static_cast<std::size_t>(signals.code.bits);
    for (std::size_t k = 0; k < count; ++k)
        bits[k] =
            static_cast<float>(signals.contrast[pixel * count + k]) / AxisSignals::kContrastUnit;
    return bits;
}

// The stripe that a Gray code names; `flipped` has a bit for each of its bits to be turned round,
// the coarsest is the highest.
int stripeOf(const Bits& bits, int count, unsigned flipped = 0) {
    unsigned stripe = 0;
    for (int k = 0; k < count; ++k) {
        const bool lit = bits[static_cast<std::size_t>(k)] > 0;
        const unsigned turn = (flipped >> static_cast<unsigned>(count - 1 - k)) & 1U;
        stripe = (stripe << 1U) | ((static_cast<unsigned>(lit) ^ turn ^ stripe) & 1U);
    }
    return static_cast<int>(stripe);
}

// With the bits of this channel: pictures that are smaller than others of their round have fewer.
AxisCode codeOf(const AxisSignals& signals, int pixels) {
    AxisCode code = signals.code;
    code.bits = std::min(code.bits, wall::scanGrayBits(pixels, code.finestPixels));
    return code;
}

// Noise by the brightness of a pixel, from the pictures themselves.
class NoiseCurve {
  public:
    static constexpr std::size_t kBins = 24;
    explicit NoiseCurve(float mostLight) : most_{std::max(mostLight, 1e-6F)} { limit_.fill(1e30); }
    void add(float light, float square) {
        const std::size_t bin = binOf(light);
        if (double{square} > limit_[bin]) return;
        sum_[bin] += double{square};
        ++count_[bin];
    }
    // Keeps what was found, and counts anew only what is within four standard deviations of it.
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

// Phase names the place within a period, stripes of half a period name the period.
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
        // One bit may say nothing, or even the contrary.
        return score(bits, place) > 0.6F * weightOf(bits) ? Reading{place, sigmaOf(pixel)}
                                                          : Reading{};
    }
    [[nodiscard]] double noise() const override { return std::sqrt(noise_.variance(middle_)); }

  private:
    // Stripes are blurred by about so much, so that bits close to their edges are not asked.
    static constexpr double kSoftPixels = 2.5;
    static constexpr float kSureContrast = 0.2F, kLeastMargin = 0.5F;
    // The share of the light that reaches the camera as waves: less is light of other ways.
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

    // The contrast of the bit that agrees least, of those that are far from an edge.
    [[nodiscard]] float worstBit(const Bits& bits, float place) const {
        float worst = 1;
        const std::span<const float> expected = table_.atPlace(place);
        for (std::size_t k = 0; k < expected.size(); ++k)
            if (std::abs(expected[k]) > 0.95F) worst = std::min(worst, expected[k] * bits[k]);
        return worst;
    }
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
    // The place of all periods that its bits like best, where they like no other as much.
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

    // Without noise, I0 + I2 = I1 + I3 but for a response that is not straight: that leaves twice
    // the phase, which is taken off.
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

    // A response that is not straight shifts the phase by its fourth multiple. Places are spread
    // evenly, so that where their phases are not, that is the shift.
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

// Without phase: the place where blurred stripes look most like what is seen. Each column has the
// edge of one bit beside it, whose slope tells more than which side it is on.
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
        float rest = 0;   // variance of what it does not explain
        float slope = 0;  // of all bits together, for one pixel
    };

    [[nodiscard]] Reading readingOf(std::size_t pixel, const Fit& fit) const {
        if (fit.likeness < kLeastLikeness || fit.contrast < kLeastContrast) return {};
        const float signal = 0.5F * light_[pixel] * fit.contrast * fit.slope;
        const float flat = static_cast<float>(code_.finestPixels) / std::sqrt(12.0F);
        return {fit.place, std::min(flat, static_cast<float>(noise_) / std::max(signal, 1e-9F))};
    }

    // Squared correlation of the bits with the stripes at a place, and the contrast of those.
    struct Likeness {
        float product = 0, square = 1e-9F;
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
    // Between the samples, by the parabola through three of them.
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

    // From the code, and from those with one or both of its faintest bits turned round.
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

    // Of the blur that explains a sample of the pixels best.
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

// Its sum is one.
std::vector<float> gaussOf(double deviation) {
    const int reach = static_cast<int>(std::ceil(3 * deviation));
    std::vector<float> kernel;
    for (int i = -reach; i <= reach; ++i)
        kernel.push_back(static_cast<float>(std::exp(-0.5 * std::pow(i / deviation, 2))));
    const float whole = std::accumulate(kernel.begin(), kernel.end(), 0.0F);
    for (float& weight : kernel) weight /= whole;
    return kernel;
}

bool isGray(Kind kind) {
    return kind == Kind::GrayColumns || kind == Kind::GrayRows;
}

}  // namespace

AxisSignals::AxisSignals(AxisCode axisCode, std::size_t pixels)
    : code{axisCode}, contrast(pixels * static_cast<std::size_t>(code.bits)) {
    if (!code.hasPhase) return;
    for (Plane* plane : {&cosine, &sine, &sum, &alternate}) plane->resize(pixels);
}

void AxisSignals::add(const ScanFrame& frame,
                      const Round& round,
                      const std::vector<ChannelView>& views,
                      WorkerPool& pool) {
    if (isGray(frame.pattern->kind))
        addStripes(frame, round, views, pool);
    else
        addPhase(frame, pool);
}

void AxisSignals::addStripes(const ScanFrame& frame,
                             const Round& round,
                             const std::vector<ChannelView>& views,
                             WorkerPool& pool) {
    const config::ScanPattern& pattern = *frame.pattern;
    const float unit =
        (pattern.inverse ? -1.0F : 1.0F) * (code.isPaired ? 0.5F : 1.0F) * kContrastUnit;
    const auto bits = static_cast<std::size_t>(code.bits);
    forPixels(pool, frame.luminance.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) {
            const std::uint8_t owner = round.owner[p];
            if (owner == Round::kNobody || ((pattern.lit >> owner) & 1U) == 0) continue;
            const float half = 0.5F * views[owner].light[p];
            std::int16_t& bit = contrast[p * bits + pattern.step];
            const float value =
                static_cast<float>(bit) + unit * (frame.luminance[p] - round.middle[p]) / half;
            bit = static_cast<std::int16_t>(std::clamp(value, -32767.0F, 32767.0F));
        }
    });
}

void AxisSignals::addPhase(const ScanFrame& frame, WorkerPool& pool) {
    const std::uint8_t step = frame.pattern->step;
    Plane& wave = step % 2 == 0 ? cosine : sine;
    const float sign = step < 2 ? 1.0F : -1.0F;
    const float alternating = step % 2 == 0 ? 1.0F : -1.0F;
    forPixels(pool, frame.luminance.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) {
            const float light = frame.luminance[p];
            wave[p] += sign * light;
            sum[p] += light;
            alternate[p] += alternating * light;
        }
    });
}

StripeTable::StripeTable(int pixels, const AxisCode& code, int perPixel, double blurPixels)
    : bits_{code.bits}, perPixel_{perPixel}, samples_{pixels * perPixel} {
    const std::vector<float> kernel = gaussOf(blurPixels * perPixel);
    const int reach = static_cast<int>(kernel.size()) / 2;
    values_.resize(static_cast<std::size_t>(samples_ * bits_));
    for (int k = 0; k < bits_; ++k) {
        const config::ScanPattern stripes{
            .kind = Kind::GrayColumns,
            .step = static_cast<std::uint8_t>(k),
            .finestPixels = static_cast<std::uint16_t>(code.finestPixels)};
        std::vector<float> sharp;
        for (int i = -reach; i < samples_ + reach; ++i) {
            const int pixel = std::clamp(i, 0, samples_ - 1) / perPixel;
            sharp.push_back(static_cast<float>(2 * wall::scanShare(stripes, pixel, pixels) - 1));
        }
        for (int i = 0; i < samples_; ++i)
            values_[static_cast<std::size_t>(i * bits_ + k)] =
                std::inner_product(kernel.begin(), kernel.end(), sharp.begin() + i, 0.0F);
    }
}

std::span<const float> StripeTable::at(int sample) const {
    const int inside = std::clamp(sample, 0, samples_ - 1);
    return {&values_[static_cast<std::size_t>(inside * bits_)], static_cast<std::size_t>(bits_)};
}

std::unique_ptr<AxisReader> makeAxisReader(const AxisSignals& signals,
                                           const Plane& light,
                                           const std::vector<std::size_t>& owned,
                                           int pixelsOfAxis) {
    if (signals.code.hasPhase)
        return std::make_unique<PhaseReader>(signals, light, owned, pixelsOfAxis);
    return std::make_unique<StripeReader>(signals, light, owned, pixelsOfAxis);
}

std::optional<double> stripeShift(const AxisSignals& signals,
                                  int bit,
                                  int pixelsOfAxis,
                                  const ChannelView& view,
                                  const std::vector<std::size_t>& owned) {
    constexpr double kReach = 5;
    constexpr int kLeastPixels = 500;
    // Edges of this bit are so far apart, the first is half of that from the picture's border. Near
    // a rising one the contrast is slope * (offset - shift), near a falling one the contrary; and
    // light of other ways is the same for both.
    const double apart = signals.code.finestPixels << (codeOf(signals, pixelsOfAxis).bits - bit);
    LeastSquares<3> fit;
    std::array<int, 2> count{};
    for (const std::size_t p : owned) {
        const double edges = double{view.place[p][signals.code.axis]} / apart - 0.5;
        const double nearest = std::round(edges), offset = (edges - nearest) * apart;
        if (!(std::abs(offset) < kReach)) continue;
        const auto falls = static_cast<std::size_t>(static_cast<int>(nearest) & 1);
        const double sign = falls == 0 ? 1 : -1;
        const float contrast = contrastsOf(signals, p)[static_cast<std::size_t>(bit)];
        fit.add({sign * offset, -sign, 1}, double{contrast});
        ++count.at(falls);
    }
    const auto found = fit.solve();
    if (std::min(count[0], count[1]) < kLeastPixels || !found) return std::nullopt;
    // More than that is no longer told from stripes of no use.
    constexpr double kMost = wall::kScanPeriodPixels / 2.0;
    return std::clamp((*found)[1] / std::max(1e-3, (*found)[0]), -kMost, kMost);
}

}  // namespace aquarama::scan
