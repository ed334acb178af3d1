// SPDX-License-Identifier: Apache-2.0
// The simulated camera: what it measures, its noise, and each fault of a scan.
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "calibration/hall/random_hall.h"
#include "calibration/hall/simulated_camera.h"
#include "calibration/hall/true_hall.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::hall {
namespace {

using config::ScanPattern;
using Kind = ScanPattern::Kind;

// Black, the white of each channel one after the other, phases of the first.
std::vector<ScanPattern> patternsOf(const config::Rig& rig) {
    std::vector<ScanPattern> patterns{{.light = glm::vec3(0), .tagged = false}};
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        patterns.push_back({.lit = std::uint64_t{1} << i, .tagged = false});
    for (int step = 0; step < wall::kScanPhaseSteps; ++step)
        patterns.push_back({.kind = Kind::PhaseColumns,
                            .step = static_cast<std::uint8_t>(step),
                            .lit = 1,
                            .tagged = false});
    return patterns;
}

// A rig of three projectors on a cylinder with a small camera.
class Scan {
  public:
    explicit Scan(double scale = 0.08) : rig(randomRig(5, scale)) {
        hall = randomHall(rig, 5, scale);
        patterns = patternsOf(rig);
    }
    [[nodiscard]] Light light(const config::Hall& of, std::size_t index) const {
        const TrueHall truth(rig, of);
        return SimulatedCamera(truth, patterns).lightOf(index);
    }
    [[nodiscard]] Picture picture(const config::Hall& of, std::size_t index) const {
        const TrueHall truth(rig, of);
        return SimulatedCamera(truth, patterns).picture(index);
    }
    config::Rig rig;
    config::Hall hall;
    std::vector<ScanPattern> patterns;
};

double meanOf(const Picture& picture) {
    double sum = 0;
    for (const std::uint16_t code : picture.rgb) sum += code;
    return sum / double(picture.rgb.size()) / (picture.bits == 8 ? 255 : 65535);
}

double meanOf(const Light& light) {
    double sum = 0;
    for (const glm::vec3& rgb : light.rgb) sum += double(rgb.g);
    return sum / double(light.rgb.size());
}

double differenceOf(const Light& one, const Light& other) {
    double most = 0;
    for (std::size_t i = 0; i < one.rgb.size(); ++i)
        most = std::max(most, double(std::abs(one.rgb[i].g - other.rgb[i].g)));
    return most;
}

// The place in a period that four phases say, in pixels of the channel.
double placeOf(const std::vector<Light>& phases, int x, int y) {
    const auto sine = double(phases[1].at(x, y).g - phases[3].at(x, y).g);
    const auto cosine = double(phases[0].at(x, y).g - phases[2].at(x, y).g);
    return std::atan2(sine, cosine) / (2 * std::numbers::pi) * wall::kScanPeriodPixels;
}

// The whole chain, against the truth: the pattern that a pixel of the camera sees.
void expectPlaces(double scale, glm::ivec2 size, double tolerance) {
    const Scan scan(scale);
    config::Hall hall = scan.hall;
    hall.screen.bounces = false;  // moves phases
    for (config::HallProjector& projector : hall.projectors) projector.gamma.reset();
    for (config::HallProjector& projector : hall.projectors) projector.toe = projector.knee = 0;
    const double zoom = double(size.x) / hall.camera.sizePixels.x;
    hall.camera.focalPixels *= zoom;
    hall.camera.principalPixels *= zoom;
    hall.camera.sizePixels = size;
    const TrueHall truth(scan.rig, hall);
    const SimulatedCamera camera(truth, scan.patterns);
    std::vector<Light> phases;
    for (std::size_t i = 0; i < 4; ++i)
        phases.push_back(camera.lightOf(1 + scan.rig.channels.size() + i));
    double square = 0;
    int looked = 0;
    for (int y = 1; y < size.y - 1; y += 3)
        for (int x = 1; x < size.x - 1; x += 3) {
            const auto point = truth.pointSeen(glm::dvec2(x, y) + 0.5);
            const auto pixel = point ? truth.pixelOf(0, *point) : std::nullopt;
            const glm::dvec2 last = scan.rig.channels[0].sizePixels - 3;
            if (!pixel || glm::any(glm::lessThan(*pixel, glm::dvec2(3))) ||
                glm::any(glm::greaterThan(*pixel, last)))
                continue;
            const double off = placeOf(phases, x, y) - pixel->x;
            const double cut =
                off - wall::kScanPeriodPixels * std::round(off / wall::kScanPeriodPixels);
            square += cut * cut;
            ++looked;
        }
    EXPECT_GT(looked, 500);
    EXPECT_LT(std::sqrt(square / looked), tolerance);
}

TEST(SimulatedCamera, phasesTellWhereThePixelsFall) {
    expectPlaces(0.25, {480, 270}, 0.03);
}

// Where rays are interpolated.
TEST(SimulatedCamera, phasesTellWhereThePixelsFallInLargePictures) {
    expectPlaces(0.25, {1504, 480}, 0.03);
}

TEST(SimulatedCamera, noiseIsThatOfElectronsAndOfReading) {
    const Scan scan(0.2);
    config::Hall hall = scan.hall;
    hall.camera.response = config::ScanCamera::Response::Linear;
    hall.camera.bits = 16;
    hall.camera.blurPixels = 0;
    hall.camera.lens.vignetting = 0;
    hall.camera.fullWell = 5000;
    hall.camera.readNoise = 0.002;
    const TrueHall truth(scan.rig, hall);
    SimulatedCamera camera(truth, scan.patterns);
    const Light light = camera.lightOf(1);
    const Picture picture = camera.picture(1);
    double lights = 0, values = 0;
    for (std::size_t i = 0; i < light.rgb.size(); ++i) {
        if (light.rgb[i].g < 0.2F) continue;
        lights += double(light.rgb[i].g);
        values += picture.rgb[3 * i + 1] / 65535.0;
    }
    double normalised = 0;
    int looked = 0;
    for (std::size_t i = 0; i < light.rgb.size(); ++i) {
        const double mean = double(light.rgb[i].g) * values / lights;
        if (mean < 0.02 || mean > 0.9) continue;  // where nothing is cut off
        const double off = picture.rgb[3 * i + 1] / 65535.0 - mean;
        normalised += off * off / (mean / 5000 + 0.002 * 0.002);
        ++looked;
    }
    EXPECT_GT(looked, 10000);
    EXPECT_NEAR(normalised / looked, 1, 0.03);
}

TEST(SimulatedCamera, whiteIsExposedToFourFifths) {
    const Scan scan;
    config::Hall hall = scan.hall;
    hall.camera.response = config::ScanCamera::Response::Linear;
    hall.camera.bits = 16;
    hall.camera.fullWell = hall.camera.readNoise = 0;
    hall.screen.bounces = false;
    double brightest = 0;
    for (std::size_t i = 1; i <= scan.rig.channels.size(); ++i)
        for (const std::uint16_t code : scan.picture(hall, i).rgb)
            brightest = std::max(brightest, code / 65535.0);
    EXPECT_NEAR(brightest, 0.8, 0.06);
}

TEST(SimulatedCamera, picturesDependOnSeedAndIndexAlone) {
    const Scan scan;
    const TrueHall truth(scan.rig, scan.hall);
    SimulatedCamera one(truth, scan.patterns, 3), same(truth, scan.patterns, 3);
    SimulatedCamera other(truth, scan.patterns, 4);
    const auto first = one.picture(1).rgb, second = one.picture(2).rgb;
    EXPECT_EQ(same.picture(2).rgb, second);
    EXPECT_EQ(same.picture(1).rgb, first);
    EXPECT_NE(other.picture(1).rgb, first);
}

TEST(SimulatedCamera, itsBundleIsReadAsThatOfAnyCamera) {
    const Scan scan;
    const TrueHall truth(scan.rig, scan.hall);
    SimulatedCamera camera(truth, scan.patterns);
    const auto folder = std::filesystem::temp_directory_path() / "aquarama_hall_test_bundle";
    std::filesystem::remove_all(folder);
    scan::writeFolder(camera, folder.string(), scan.rig);
    const auto read = scan::openFolder(folder.string(), scan.rig);
    ASSERT_EQ(read->scan().pictures.size(), scan.patterns.size());
    EXPECT_EQ(read->scan().pictures[2].pattern, scan.patterns[2]);
    const Picture again = read->picture(2), taken = camera.picture(2);
    EXPECT_EQ(again.bits, taken.bits);
    EXPECT_EQ(again.rgb, taken.rgb);
    std::filesystem::remove_all(folder);
}

// Tape on the screen is as dark as what is beside it.
TEST(SimulatedCamera, theRoomsLampsShowTheScreen) {
    Scan scan;
    scan.patterns = {{.kind = Kind::Room, .tagged = false}, {.lit = 1}};
    const TrueHall truth(scan.rig, scan.hall);
    const Light room = SimulatedCamera(truth, scan.patterns).lightOf(0);
    int taped = 0;
    for (int y = 2; y < room.sizePixels.y - 2; ++y)
        for (int x = 2; x < room.sizePixels.x - 2; ++x) {
            const glm::dvec2 pixel(x + 0.5, y + 0.5);
            const auto isWhite = [&](glm::dvec2 at) {
                const auto meeting = truth.screen().meet(truth.cameraLens().ray(at));
                taped += meeting && meeting->isMarked ? 1 : 0;
                return meeting && meeting->isScreen && !meeting->isMarked;
            };
            const bool isScreen = isWhite(pixel);
            bool isEdge = false;
            for (const glm::dvec2 step : {glm::dvec2(-2), {2, -2}, {-2, 2}, glm::dvec2(2)})
                isEdge |= isWhite(pixel + step) != isScreen;
            if (isEdge) continue;
            EXPECT_EQ(room.at(x, y).g > 0.08F, isScreen) << x << " " << y;
        }
    EXPECT_GT(taped, 20);
}

TEST(HallFault, aHandHidesAPartOfTheView) {
    const Scan scan;
    config::Hall hall = withFault(scan.rig, scan.hall, HallFault::BlockedCamera, 1);
    ASSERT_TRUE(hall.faults.blocked.has_value());
    hall.faults.blocked->place = {0.3, 0.4};
    const Picture free = scan.picture(scan.hall, 1), hidden = scan.picture(hall, 1);
    const glm::ivec2 at(glm::dvec2(free.sizePixels) * hall.faults.blocked->place);
    const auto code = static_cast<std::size_t>(3 * (at.y * free.sizePixels.x + at.x) + 1);
    EXPECT_LT(hidden.rgb[code], free.rgb[code] / 3);
}

TEST(HallFault, aProjectorIsPushedAtOnePicture) {
    const Scan scan;
    config::Hall hall = scan.hall;
    hall.faults.moved = {0, 6, {0.01, 0}};
    EXPECT_EQ(differenceOf(scan.light(hall, 5), scan.light(scan.hall, 5)), 0);
    EXPECT_GT(differenceOf(scan.light(hall, 6), scan.light(scan.hall, 6)), 0.1);
    const TrueHall truth(scan.rig, hall), before(scan.rig, scan.hall);
    EXPECT_GT(glm::distance(*truth.pointOf(0, {70, 40}), *before.pointOf(0, {70, 40})), 0.01);
}

TEST(HallFault, swappedCablesShowTheOthersPicture) {
    const Scan scan;
    config::Hall hall = scan.hall;
    hall.faults.swapped = {0, 1};
    hall.screen.bounces = false;
    config::Hall right = scan.hall;
    right.screen.bounces = false;
    EXPECT_LT(differenceOf(scan.light(hall, 1), scan.light(right, 2)), 1e-6);
}

TEST(HallFault, aLampIsSwitchedOn) {
    const Scan scan;
    config::Hall hall = scan.hall;
    hall.faults.lamp = {{0.5, 0.5}, 0.3, 1.0, 3};
    EXPECT_EQ(differenceOf(scan.light(hall, 2), scan.light(scan.hall, 2)), 0);
    EXPECT_NEAR(
        differenceOf(scan.light(hall, 3), scan.light(scan.hall, 3)), hall.screen.albedo, 0.05);
}

TEST(HallFault, exposureIsWrong) {
    const Scan scan;
    const double right = meanOf(scan.picture(scan.hall, 1));
    const auto over = withFault(scan.rig, scan.hall, HallFault::OverExposure, 1);
    const auto under = withFault(scan.rig, scan.hall, HallFault::UnderExposure, 1);
    EXPECT_GT(meanOf(scan.picture(over, 1)), 1.1 * right);
    EXPECT_LT(meanOf(scan.picture(under, 1)), 0.5 * right);
}

TEST(HallFault, aLatePictureShowsThePatternBefore) {
    const Scan scan;
    const auto hall = withFault(scan.rig, scan.hall, HallFault::LatePicture, 1, 7);
    const std::size_t late = *hall.faults.latePicture;
    EXPECT_GE(late, 1U);
    EXPECT_LT(late, 8U);
    EXPECT_EQ(differenceOf(scan.light(hall, late), scan.light(scan.hall, late - 1)), 0);
}

TEST(HallFault, automaticExposureMakesPicturesAlike) {
    const Scan scan;
    const auto hall = withFault(scan.rig, scan.hall, HallFault::AutoExposure, 1);
    const double one = meanOf(scan.picture(hall, 1)), phase = meanOf(scan.picture(hall, 5));
    EXPECT_GT(phase / one, 0.75);
    EXPECT_LT(meanOf(scan.light(hall, 5)) / meanOf(scan.light(hall, 1)), 0.6);
}

TEST(HallFault, aPictureOfAnotherShapeLeavesBars) {
    const Scan scan;
    config::Hall hall = scan.hall;
    const glm::ivec2 size = scan.rig.channels[0].sizePixels;
    hall.faults.mode = {0, {size.x / 2, size.y / 4}};
    hall.screen.bounces = false;
    const TrueHall truth(scan.rig, hall), whole(scan.rig, scan.hall);
    const SimulatedCamera camera(truth, scan.patterns);
    const Light white = camera.lightOf(1);
    int inBars = 0;
    for (const glm::dvec3& point : truth.screenPoints(500)) {
        const auto pixel = whole.pixelOf(0, point);
        if (!pixel || (pixel->y > 0.2 * size.y && pixel->y < 0.8 * size.y)) continue;
        EXPECT_FALSE(truth.pixelOf(0, point).has_value());
        EXPECT_LT(bilinear(white, *truth.cameraPixelOf(point)).g, 0.1);
        ++inBars;
    }
    EXPECT_GT(inBars, 10);
}

TEST(HallFault, aProjectorTurnedAwaySharesNothing) {
    for (const std::uint32_t seed : {4U, 5U}) {  // on cylinders
        const config::Rig rig = randomRig(seed, 0.1);
        const TrueHall truth(
            rig, withFault(rig, randomHall(rig, seed, 0.1), HallFault::NoOverlap, seed));
        for (const glm::dvec3& point : truth.screenPoints(2000)) {
            if (!truth.pixelOf(truth.channels() - 1, point)) continue;
            for (std::size_t i = 0; i + 1 < truth.channels(); ++i)
                EXPECT_FALSE(truth.pixelOf(i, point).has_value());
        }
    }
}

TEST(HallFault, aShiftedLensShinesFromHigherUp) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        const config::Rig rig = randomRig(seed, 0.1);
        const config::Hall plain = plainHall(rig, seed, 0.1);
        const auto shifted = withFault(rig, plain, HallFault::LensShift, seed);
        const TrueHall truth(rig, shifted), meant(rig, plain);
        for (std::size_t i = 0; i < truth.channels(); ++i) {
            const glm::dvec2 middle = glm::dvec2(rig.channels[i].sizePixels) / 2.0;
            const auto now = truth.pointOf(i, middle), before = meant.pointOf(i, middle);
            ASSERT_TRUE(now && before) << seed;
            EXPECT_LT(glm::distance(*now, *before), 0.8) << seed;
        }
    }
}

}  // namespace
}  // namespace aquarama::hall
