// SPDX-License-Identifier: Apache-2.0
// Real photographs of Gray codes (kamino410/procam-calibration, MIT): a projector of 1024 x 768
// pixels, a camera of 1280 x 1024.
//
// The measure. A pixel is lit where white is more than kLitCodes brighter than black. It is valid
// where a place was found from its own pictures; none is filled in from others, who only say which
// of the places that fit them is looked at first. The residual is taken in windows of 17 x 17
// pixels, every second each way, with at least 80 % valid ones: around the homography from camera
// to projector that fits the window best, without what is more than 3 px off; RMS of a coordinate
// over all windows. The plain decoder takes each bit from a pattern and its inverse; a pixel is
// valid where all differ by at least kSureCodes: as OpenCV's, with 78.9 % of these pixels.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "calibration/scan/decode.h"
#include "calibration/scan/least_squares.h"

namespace aquarama::scan {
namespace {

const std::string kFolder = AQUARAMA_SOURCE_DIR "/../shared/data/graycode_kamino410/capture_0";
constexpr int kLitCodes = 40, kSureCodes = 5;
constexpr int kReach = 8;  // of a window

using Places = std::vector<glm::vec2>;

bool isKnown(glm::vec2 place) {
    return place.x == place.x && place.y == place.y;
}

// The places of one axis by the signs of pattern less inverse.
class PlainDecoder {
  public:
    explicit PlainDecoder(PictureSource& source) {
        for (std::size_t i = 0; i < source.scan().pictures.size(); ++i)
            pictures_.push_back(source.picture(i));
    }
    [[nodiscard]] bool isLit(std::size_t p) const {
        return std::abs(difference(pictures_.size() - 2, p)) > kLitCodes;
    }
    [[nodiscard]] Places places() const {
        Places places(pictures_[0].rgb.size() / 3);
        for (std::size_t p = 0; p < places.size(); ++p)
            places[p] = {placeAt(p, 0, 1024), placeAt(p, kBits, 768)};
        return places;
    }

  private:
    static constexpr std::size_t kBits = 10;
    [[nodiscard]] int difference(std::size_t index, std::size_t p) const {
        return pictures_[index].rgb[3 * p] - pictures_[index + 1].rgb[3 * p];
    }
    [[nodiscard]] float placeAt(std::size_t p, std::size_t firstBit, unsigned pixels) const {
        unsigned code = 0;
        bool isSure = true;
        for (std::size_t k = firstBit; k < firstBit + kBits; ++k) {
            const int apart = difference(2 * k, p);
            isSure &= std::abs(apart) >= kSureCodes;
            code = (code << 1U) | ((apart > 0 ? 1U : 0U) ^ (code & 1U));
        }
        return isSure && code < pixels ? static_cast<float>(code) + 0.5F
                                       : std::numeric_limits<float>::quiet_NaN();
    }
    std::vector<Picture> pictures_;
};

struct Sample {
    glm::dvec2 at, place;
};

using Homography = std::array<double, 8>;

glm::dvec2 errorOf(const Homography& h, const Sample& sample) {
    const glm::dvec2 p = sample.at;
    const double w = h[6] * p.x + h[7] * p.y + 1;
    return glm::dvec2(h[0] * p.x + h[1] * p.y + h[2], h[3] * p.x + h[4] * p.y + h[5]) / w -
           sample.place;
}

std::optional<Homography> homographyOf(const std::vector<Sample>& samples) {
    LeastSquares<8> fit;
    for (const auto& [at, place] : samples) {
        fit.add({at.x, at.y, 1, 0, 0, 0, -at.x * place.x, -at.y * place.x}, place.x);
        fit.add({0, 0, 0, at.x, at.y, 1, -at.x * place.y, -at.y * place.y}, place.y);
    }
    return fit.solve();
}

std::vector<Sample> windowAt(const Places& places, int width, int x, int y) {
    std::vector<Sample> samples;
    for (int j = -kReach; j <= kReach; ++j)
        for (int i = -kReach; i <= kReach; ++i) {
            const glm::vec2 place = places[static_cast<std::size_t>((y + j) * width + x + i)];
            if (isKnown(place)) samples.push_back({glm::dvec2(i, j) / double{kReach}, place});
        }
    return samples;
}

// About the median place, where the fit is well conditioned.
void centre(std::vector<Sample>& samples) {
    glm::dvec2 middle(0);
    for (int axis = 0; axis < 2; ++axis) {
        std::ranges::nth_element(samples,
                                 samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2),
                                 {},
                                 [axis](const Sample& sample) { return sample.place[axis]; });
        middle[axis] = samples[samples.size() / 2].place[axis];
    }
    for (Sample& sample : samples) sample.place -= middle;
}

struct Squares {
    double sum = 0, count = 0;
};
void addWindow(Squares& squares, std::vector<Sample> samples) {
    constexpr std::size_t kLeast = (2 * kReach + 1) * (2 * kReach + 1) * 4 / 5;
    if (samples.size() < kLeast) return;
    centre(samples);
    Homography best{};
    for (const double allowed : {6.0, 6.0, 3.0, 3.0}) {
        const auto fit = homographyOf(samples);
        if (!fit) return;
        best = *fit;
        std::erase_if(samples, [&](const Sample& sample) {
            const glm::dvec2 error = glm::abs(errorOf(best, sample));
            return std::max(error.x, error.y) > allowed;
        });
        if (samples.size() < kLeast * 3 / 4) return;
    }
    for (const Sample& sample : samples) {
        const glm::dvec2 error = errorOf(best, sample);
        squares.sum += error.x * error.x + error.y * error.y;
        squares.count += 2;
    }
}

struct Measure {
    double valid = 0, residual = 0;
};
Measure measureOf(const Places& places, const PlainDecoder& plain, glm::ivec2 size) {
    double lit = 0, valid = 0;
    for (std::size_t p = 0; p < places.size(); ++p) {
        if (!plain.isLit(p)) continue;
        ++lit;
        valid += isKnown(places[p]) ? 1 : 0;
    }
    Squares squares;
    constexpr int kApart = 2 * (2 * kReach + 1);
    for (int y = kReach; y + kReach < size.y; y += kApart)
        for (int x = kReach; x + kReach < size.x; x += kApart)
            addWindow(squares, windowAt(places, size.x, x, y));
    return {valid / lit, std::sqrt(squares.sum / squares.count)};
}

TEST(PhotographsTest, MorePixelsAndLessResidualThanAPlainDecoder) {
    if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << "no photographs in " << kFolder;
    config::Rig rig = config::readRig(AQUARAMA_SOURCE_DIR "/config/flat_3.txtpb");
    rig.channels.resize(1);
    rig.channels[0].sizePixels = {1024, 768};
    const auto source = openFolder(kFolder, rig);
    const PlainDecoder plain(*source);
    const CameraView view = decode(*source, 0, rig);
    const Measure ours = measureOf(view.channels[0].place, plain, view.sizePixels);
    const Measure theirs = measureOf(plain.places(), plain, view.sizePixels);
    EXPECT_NEAR(theirs.valid, 0.789, 0.002);  // the measure is that of the figure
    EXPECT_GT(ours.valid, 0.90);
    EXPECT_LT(ours.residual, 0.13);
    EXPECT_LT(ours.residual, 0.5 * theirs.residual);
}

}  // namespace
}  // namespace aquarama::scan
