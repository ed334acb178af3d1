// SPDX-License-Identifier: Apache-2.0
// The paper's Table 2: what a whole frame takes with culling and levels of detail, and without
// either. The middle channel of config/desk.txtpb at medium, along the tour of the reef.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <epoxy/gl.h>
#include <glm/gtc/quaternion.hpp>
#include <unistd.h>

#include "common/base/picture.h"
#include "common/config/rig.h"
#include "common/config/scene.h"
#include "master/surroundings/pilot.h"
#include "render_node/gl/context.h"
#include "render_node/gl/handle.h"
#include "render_node/show/channel_picture.h"
#include "render_node/show/snapshot.h"
#include "render_node/surface/school_surface.h"
#include "tests/bench/gpu/sea.h"
#include "tests/support/flip.h"
#include "tests/support/source_folder.h"

namespace aquarama::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMiddle = 1;  // channel
constexpr int kStops = 3;
constexpr int kTicksBefore = 40;  // after which a school has taken its shape

// Replaces each number that follows the name, and only there.
std::string times(const std::string& text, const std::string& name, double factor, double least) {
    const std::regex number(name + R"(: ([0-9.]+))");
    std::string made;
    auto last = text.cbegin();
    for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at) {
        made.append(last, text.cbegin() + at->position(0));
        const double value = std::max(std::round(factor * std::stod((*at)[1])), least);
        std::ostringstream written;
        written << name << ": " << value;
        made += written.str();
        last = text.cbegin() + at->position(0) + at->length(0);
    }
    made.append(last, text.cend());
    return made;
}

// The reef with so many fish, in as much more water where they are more than its own.
std::string reefOf(std::size_t fish, const fs::path& folder) {
    const fs::path scenes = fs::path(test::sourceFolder()) / "config/scenes";
    std::ifstream file(scenes / "reef.txtpb");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    const double factor = static_cast<double>(fish) / 381;  // fish of the file
    text = times(text, "fish", factor, 1);
    const double wider = std::max(std::sqrt(factor), 1.0);
    std::ostringstream extent;
    extent << "half_extent { x_m: " << 7.4 * wider << " y_m: 2.45 z_m: " << 6.1 * wider << " }";
    text = std::regex_replace(text, std::regex(R"(half_extent \{[^}]*\})"), extent.str());
    text = std::regex_replace(
        text, std::regex(R"(\.\./species/)"), (scenes / "../species/").lexically_normal().string());
    const fs::path made = folder / "reef.txtpb";
    std::ofstream(made) << text;
    return made.string();
}

glm::quat lookingAt(glm::vec3 way) {
    return glm::quatLookAt(glm::normalize(way), glm::vec3{0, 1, 0});
}

// The sea with the submarine at stops of its tour.
Sea seaOf(std::size_t fish) {
    const fs::path folder =
        fs::temp_directory_path() / ("aquarama-table2-" + std::to_string(getpid()));
    fs::create_directories(folder);
    Sea sea = makeSea(reefOf(fish, folder), std::nullopt, kTicksBefore, kStops);
    fs::remove_all(folder);
    const surroundings::Tour tour = surroundings::tourOf(sea.admission.scene);
    for (int stop = 0; stop < kStops; ++stop) {
        const auto at = surroundings::pointOf(tour, 1.5F * static_cast<float>(stop), {});
        sea.frames[static_cast<std::size_t>(stop)].eye = {at.at, lookingAt(at.lookAt - at.at)};
    }
    sea.admission.rig = config::readRig(test::sourceFolder() + "/config/desk.txtpb");
    return sea;
}

double processMilliseconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

// The channel, and what its display shows of the frames.
class DrawnChannel {
  public:
    DrawnChannel(const session::Admission& admission, bool savesWork)
        : picture_{admission, kMiddle, config::QualityTier::Medium, nullptr, savesWork} {}

    void draw(const wire::StateFrame& frame) {
        picture_.drawScene(frame, {});
        picture_.project(target_.framebuffer(), show::Encoding::Dithered8, {});
        glFinish();
    }
    [[nodiscard]] Picture shown() {
        return show::takePicture(picture_, show::PictureBits::Dithered8, show::Shown::Display);
    }
    [[nodiscard]] surface::SurfaceCounts fish() {
        return picture_.drawnWorld()->renderer.fishCounts();
    }

  private:
    show::ChannelPicture picture_;
    gl::Target target_{GL_RGBA8, picture_.sizePixels()};
};

std::vector<Picture> picturesOf(const session::Admission& admission, const Sea& sea) {
    DrawnChannel channel(admission, true);
    std::vector<Picture> pictures;
    for (const wire::StateFrame& frame : sea.frames) {
        channel.draw(frame);
        pictures.push_back(channel.shown());
    }
    return pictures;
}

// Neither fish nor place.
session::Admission waterOf(session::Admission admission) {
    admission.scene.place = config::PlaceKind::OpenSea;
    admission.cast.clear();
    admission.school.clear();
    return admission;
}

// Mean FLIP of the frames, and of the pixels that something covers in either.
struct Difference {
    double frame = 0, covered = 0;
};
Difference differenceOf(const std::vector<Picture>& saved,
                        const std::vector<Picture>& whole,
                        const std::vector<Picture>& water) {
    double all = 0, covered = 0;
    std::size_t pixels = 0, coveredPixels = 0;
    for (std::size_t i = 0; i < saved.size(); ++i) {
        const std::vector<double> apart = test::flip(whole[i], saved[i]);
        for (std::size_t pixel = 0; pixel < apart.size(); ++pixel) {
            const auto isWater = [&](const Picture& picture) {
                return std::equal(
                    &picture.rgb[3 * pixel], &picture.rgb[3 * pixel] + 3, &water[i].rgb[3 * pixel]);
            };
            all += apart[pixel];
            ++pixels;
            if (isWater(saved[i]) && isWater(whole[i])) continue;
            covered += apart[pixel];
            ++coveredPixels;
        }
    }
    return {all / static_cast<double>(pixels), covered / static_cast<double>(coveredPixels)};
}

// For the eye: build/bench/table2-FISH-STOP-saved.png and -whole.png.
void keep(const std::vector<Picture>& saved, const std::vector<Picture>& whole, long fish) {
    fs::create_directories("build/bench");
    for (std::size_t i = 0; i < saved.size(); ++i) {
        const std::string name =
            "build/bench/table2-" + std::to_string(fish) + "-" + std::to_string(i);
        writePng(name + "-saved.png", saved[i]);
        writePng(name + "-whole.png", whole[i]);
    }
}

// Every fish of the cast, at its finest.
bool areAllHeroes(const surface::SurfaceCounts& counts, std::size_t fish) {
    return counts.atLevel.at(std::size_t(surface::DetailLevel::Hero)) == fish &&
           counts.withoutRoom == 0;
}

void table2(benchmark::State& state) {
    const auto context = gl::makeOffscreenContext("auto", {16, 16});
    const Sea sea = seaOf(static_cast<std::size_t>(state.range(0)));
    const bool saves = state.range(1) != 0;
    DrawnChannel channel(sea.admission, saves);
    for (const wire::StateFrame& frame : sea.frames)
        if (saves || &frame == &sea.frames.front())
            channel.draw(frame);  // compiles what the driver compiles on first use
    std::vector<Picture> pictures;
    double milliseconds = 0;
    int frames = 0;
    for (auto iteration : state)
        for (const wire::StateFrame& frame : sea.frames) {
            const double start = processMilliseconds();
            channel.draw(frame);
            milliseconds += processMilliseconds() - start;
            ++frames;
            if (saves) continue;
            pictures.push_back(channel.shown());
            if (!areAllHeroes(channel.fish(), sea.admission.school.size()))
                return state.SkipWithError("a fish was not drawn at its finest");
        }
    state.counters["fish"] = static_cast<double>(sea.admission.school.size());
    state.counters["frame_ms"] = milliseconds / frames;
    state.counters["drawn"] = static_cast<double>(channel.fish().visible);
    if (saves) return;
    const std::vector<Picture> saved = picturesOf(sea.admission, sea);
    keep(saved, pictures, state.range(0));
    const Difference apart = differenceOf(saved, pictures, picturesOf(waterOf(sea.admission), sea));
    state.counters["flip_frame"] = apart.frame;
    state.counters["flip_covered"] = apart.covered;
}
BENCHMARK(table2)
    ->Name("table2/whole_frame")
    ->ArgNames({"fish", "culling_lod"})
    ->ArgsProduct({{60, 2400, 20000}, {0, 1}})
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aquarama::bench
