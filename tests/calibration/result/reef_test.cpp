// SPDX-License-Identifier: Apache-2.0
// The drawn reef on a calibrated, crooked wall looks, from the sweet spot, as on one whose wall
// file is the truth. Beside a wall that hangs as its rig says it differs more, whatever the file:
// pixels lie elsewhere, and projectors that stand nearer are brighter. Drawn as walls with a
// graphics card draw it, antialiased. With AQUARAMA_SOAK at full size.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <thread>

#include <gtest/gtest.h>

#include "calibration/compose/compose.h"
#include "calibration/geometry/solve.h"
#include "calibration/hall/drawn_wall.h"
#include "calibration/hall/hall_view.h"
#include "calibration/hall/random_hall.h"
#include "calibration/hall/simulated_camera.h"
#include "calibration/result/maps.h"
#include "calibration/result/wall_of.h"
#include "common/base/units.h"
#include "common/base/worker_pool.h"
#include "common/config/text_file.h"
#include "common/formats/mpcdi.h"
#include "tests/support/flip.h"
#include "tests/support/source_folder.h"

namespace aquarama::result {
namespace {

namespace fs = std::filesystem;

// All projectors shine alike, and nothing else does: what differs is where light falls.
config::Hall evenlyLit(config::Hall hall) {
    for (config::HallProjector& projector : hall.projectors) {
        projector.gamma.reset();
        projector.toe = projector.knee = projector.black = projector.lens.vignetting = 0;
        projector.primaries = glm::dmat3(1.0);
        projector.brightness = 1;
    }
    hall.screen.albedo = 1;
    hall.screen.bounces = false;
    hall.darkLight = 0;
    return hall;
}

class Reef : public testing::Test {
  protected:
    void SetUp() override {
        if (std::getenv("AQUARAMA_SOAK") == nullptr) GTEST_SKIP() << "takes minutes";
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    // Real nodes draw the reef for a rig with these lines more: its channels' pictures.
    [[nodiscard]] std::vector<Light> drawn(const std::string& name, const std::string& more) const {
        std::string text = config::readTextFile(source_);
        const std::string scene = "scene: \"";
        text.insert(text.find(scene) + scene.size(), test::sourceFolder() + "/config/");
        const std::string path = (folder_ / (name + ".txtpb")).string();
        std::ofstream(path) << text << more;
        const std::string pictures = (folder_ / name).string();
        const std::string command = "\"$AQUARAMA_BIN\"/aquarama run " + path +
                                    " --quality high --deep --headless --frames 2 --snapshot " +
                                    pictures + " >" + pictures + ".log 2>&1";
        if (std::system(command.c_str()) != 0) {
            ADD_FAILURE() << config::readTextFile(pictures + ".log");
            return {};
        }
        return compose::readChannels(rig_, pictures);
    }
    // What the sweet spot sees of them, over the area of each pixel of its view: one sample of it
    // would tell of borders between projectors' pixels that no eye sees.
    [[nodiscard]] Light seen(const hall::TrueHall& hall, const std::vector<Light>& sent) const {
        const hall::LitScreen screen(hall, sent);
        const auto fall = fallOf(hall);
        Light light = darkness(viewPixels_);
        WorkerPool(std::thread::hardware_concurrency())
            .run(static_cast<std::size_t>(light.sizePixels.y), [&](std::size_t row) {
                const int y = static_cast<int>(row);
                constexpr int kParts = 3;  // of a pixel's side
                for (int i = 0; i < light.sizePixels.x * kParts * kParts; ++i) {
                    const int x = i / (kParts * kParts), part = i % (kParts * kParts);
                    const glm::dvec2 at =
                        glm::dvec2(x, y) +
                        (glm::dvec2(part % kParts, part / kParts) + 0.5) / double{kParts};
                    if (const auto point = fall->seenAt(at / glm::dvec2(light.sizePixels)))
                        light.at(x, y) += screen.at(*point) / float{kParts * kParts};
                }
            });
        return light;
    }
    // What it sees of an even grey through a rig's blend.
    [[nodiscard]] Light grey(const hall::TrueHall& hall, const config::Rig& rig) const {
        return seen(hall,
                    hall::DrawnWall(rig).pictures([](glm::dvec3) { return glm::vec3(0.5F); }));
    }
    // A wall's light as it were where grey is as bright as on another.
    [[nodiscard]] static Light asBright(Light light, const Light& grey, const Light& other) {
        for (std::size_t i = 0; i < light.rgb.size(); ++i)
            if (grey.rgb[i].g > 0) light.rgb[i] *= other.rgb[i].g / grey.rgb[i].g;
        return light;
    }
    // Without the dither of pictures that are shown.
    [[nodiscard]] static Picture rounded(const Light& light) {
        Picture picture = pictureOf(light, 16, 0);
        picture.bits = 8;
        for (std::uint16_t& code : picture.rgb)
            code = static_cast<std::uint16_t>((code + 128) / 257);
        return picture;
    }
    void write(const std::string& name, const formats::WallFile& file) const {
        formats::writeMpcdi((folder_ / name).string(), file, 2);
    }
    [[nodiscard]] formats::WallFile calibrated(const hall::TrueHall& hall) const {
        hall::SimulatedCamera camera(hall, scan::sequenceOf(rig_));
        const wall::Wall wall(rig_);
        const geometry::Solved solved = geometry::solveHall(
            rig_, wall, {scan::decode(camera, 0, rig_)}, [](const std::string&) {});
        return wallFileOf(*solved.hall);
    }
    // The same file with the places of the true hall.
    [[nodiscard]] formats::WallFile withTruth(formats::WallFile file,
                                              const hall::TrueHall& hall) const {
        const auto screen = wall::makeSurface(rig_);
        const glm::dvec3 eye = rig_.sweetSpotMetres;
        WorkerPool pool(std::thread::hardware_concurrency());
        for (std::size_t i = 0; i < file.channels.size(); ++i) {
            formats::Warp& warp = *file.channels[i].warp;
            pool.run(warp.samples.size(), [&](std::size_t k) {
                const int index = static_cast<int>(k);
                const glm::dvec2 pixel = glm::dvec2(index % warp.size.x, index / warp.size.x) + 0.5;
                const auto met = hall.screen().meet(
                    hall.lens(hall.projectorOf(i)).ray(hall.panelFrom(i, pixel)));
                const auto seen =
                    met ? screen->hit({eye, met->point - eye}, wall::kSpillMetres) : std::nullopt;
                warp.samples[k] = seen ? glm::vec3(*seen) : glm::vec3(NAN);
            });
        }
        return file;
    }
    [[nodiscard]] double flip(const Light& reference, const Light& other) const {
        const double pixelsPerDegree =
            viewPixels_.x * kRadiansPerDegree<double> / rig_.screen.arcRadians;
        const std::vector<double> errors =
            test::flip(rounded(reference), rounded(other), pixelsPerDegree);
        return std::accumulate(errors.begin(), errors.end(), 0.0) /
               static_cast<double>(errors.size());
    }

    std::string source_ = test::sourceFolder() + "/config/theatre.txtpb";
    config::Rig rig_ = config::readRigAsHung(source_);
    const double arcMetres_ = rig_.screen.radiusMetres * rig_.screen.arcRadians;
    // Square ones, as wide as the panorama's, which are less wide than high.
    glm::ivec2 viewPixels_ = glm::round(rig_.panoramaPixels.x / arcMetres_ *
                                        glm::dvec2(arcMetres_, rig_.screen.heightMetres));
    fs::path folder_ = fs::path(testing::TempDir()) / ("reef-" + std::to_string(getpid()));
};

TEST_F(Reef, looksOnACalibratedWallAsOnOneThatIsKnownExactly) {
    const double scale = hall::cameraScaleFor(rig_);
    const hall::TrueHall crooked(rig_, evenlyLit(hall::randomHall(rig_, 7, scale)));
    const formats::WallFile file = calibrated(crooked);
    write("found.mpcdi", file);
    write("truth.mpcdi", withTruth(file, crooked));
    const std::vector<Light> plain = drawn("plain", "");
    const std::vector<Light> found = drawn("found", "calibration: \"found.mpcdi\"\n");
    const std::vector<Light> truth = drawn("truth", "calibration: \"truth.mpcdi\"\n");
    for (const auto* sent : {&plain, &found, &truth}) ASSERT_EQ(sent->size(), rig_.channels.size());
    const Light looks = seen(crooked, found), exact = seen(crooked, truth);
    const double before = flip(exact, seen(crooked, plain)), after = flip(exact, looks);
    std::printf("mean FLIP from the sweet spot: %.4f before, %.4f after\n", before, after);
    EXPECT_GT(before, 0.1);
    EXPECT_LT(after, before / 3);
    // Aimed at is 0.03, here and below; it does not hold: docs/appendices/calibration.md.
    EXPECT_LE(after, 0.045);
    const hall::TrueHall straight(rig_, hall::plainHall(rig_, 7, scale));
    const Light other = seen(straight, plain);
    const double beside = flip(other, looks);
    std::printf("beside a wall that hangs as its rig says: %.4f; a file of the truth: %.4f\n",
                beside,
                flip(other, exact));
    const auto calibratedRig = [&](const std::string& name) {
        return hall::withWallFile(rig_, (folder_ / name).string());
    };
    const Light even = grey(straight, rig_);
    std::printf("in its light: %.4f; a file of the truth: %.4f\n",
                flip(other, asBright(looks, grey(crooked, calibratedRig("found.mpcdi")), even)),
                flip(other, asBright(exact, grey(crooked, calibratedRig("truth.mpcdi")), even)));
    EXPECT_LE(beside, 0.065);
}

}  // namespace
}  // namespace aquarama::result
