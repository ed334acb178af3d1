// SPDX-License-Identifier: Apache-2.0
// Measures a graphics card without a display: three walls, six seas, the tiers, and the golden
// pictures; or what software OpenGL takes for the desk. tests/bench/gpu.sh bundles it for machines
// that have nothing else of ours.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <epoxy/gl.h>

#include "calibration/compose/compose.h"
#include "common/base/log.h"
#include "common/base/picture.h"
#include "common/wall/wall.h"
#include "render_node/gl/context.h"
#include "tests/bench/gpu/call_counter.h"
#include "tests/bench/gpu/card_memory.h"
#include "tests/bench/gpu/counted_wall.h"
#include "tests/bench/gpu/sea.h"
#include "tests/bench/gpu/shader_log.h"
#include "tests/bench/gpu/wall_timing.h"
#include "tests/bench/machine.h"
#include "tests/support/golden_stills.h"
#include "tests/support/source_folder.h"

namespace {

using namespace aquarama;
namespace fs = std::filesystem;

constexpr int kSkipped = 77;  // the status, as test drivers have it

struct Options {
    std::string device = "auto";
    fs::path out = "build/gpu";
    std::vector<std::string> only;
    bool software = false;
    bool counts = false;

    [[nodiscard]] bool wants(const std::string& name) const {
        return only.empty() || std::ranges::any_of(only, [&](const std::string& part) {
                   return name.find(part) != std::string::npos;
               });
    }
};

// How much is measured.
struct Extent {
    int ticksBefore = 120;  // that a school takes to find its shape
    int frames = 32;        // of which each sea is made
    bench::Patience frameTimes;
    bench::Patience stageTimes{.leastFrames = 16, .mostFrames = 64, .seconds = 3};
    std::size_t channels = 8;  // at most
    int smaller = 1;           // pictures, along either axis
    std::uint32_t fewer = 1;   // fish
};

// Of walls for cards on software OpenGL: enough to see that this program works.
constexpr Extent kTrial{.ticksBefore = 2,
                        .frames = 2,
                        .frameTimes = {.leastFrames = 2, .mostFrames = 2, .seconds = 0},
                        .stageTimes = {.leastFrames = 1, .mostFrames = 1, .seconds = 0},
                        .channels = 1,
                        .smaller = 16,
                        .fewer = 1000};

// Of walls whose calls are counted.
constexpr Extent kCounted{.frames = 2, .frameTimes = {}};

struct SeaChoice {
    const char* name;
    const char* scene;
    std::optional<std::uint32_t> fish;
};
const SeaChoice kSeas[]{{"reef_1998", "reef_1998", std::nullopt},
                        {"reef", "reef", std::nullopt},
                        {"reef_full", "reef_full", std::nullopt},
                        {"bait_ball_2400", "bait_ball", 2'400},
                        {"bait_ball_100000", "bait_ball", 100'000},
                        {"bait_ball_250000", "bait_ball", 250'000}};

struct NamedWall {
    std::string name;
    Extent extent;
    std::vector<config::QualityTier> tiers;
    config::Rig rig;
    compose::PanoramaMap panorama{rig};
};

config::Rig within(const Extent& extent, config::Rig rig) {
    const int times = extent.smaller;
    rig.panoramaPixels /= times;
    rig.channels.resize(std::min(rig.channels.size(), extent.channels));
    for (config::Channel& channel : rig.channels) {
        channel.sizePixels /= times;
        channel.projector.focalPixels /= times;
        channel.projector.principalPixels /= times;
    }
    return rig;
}

NamedWall wallOf(const std::string& name,
                 const std::string& file,
                 const Extent& extent,
                 std::vector<config::QualityTier> tiers) {
    const std::string path = test::sourceFolder() + "/" + file;
    const config::Rig rig = config::readRig(path);
    wall::checkGeometry(rig, path);
    return {name, extent, std::move(tiers), within(extent, rig)};
}

bool isSoftware(const std::string& renderer) {
    return std::ranges::any_of(
        std::vector<std::string>{"llvmpipe", "softpipe", "swrast", "Software Rasterizer"},
        [&](const std::string& name) { return renderer.find(name) != std::string::npos; });
}

std::string renderer() {
    return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

// A context on a graphics card; or nothing, and why.
struct Card {
    std::unique_ptr<gl::Context> context;
    std::string lack;
};

Card openCard(const Options& options) try {
    Card card{gl::makeOffscreenContext(options.device, {16, 16}), {}};
    if (isSoftware(renderer()) && !options.software)
        return {nullptr, "OpenGL is drawn by " + renderer()};
    return card;
} catch (const Error& error) {
    return {nullptr, error.what()};
}

std::string underscored(std::string name) {
    std::ranges::replace(name, ' ', '_');
    return name;
}

std::string fileOf(std::string name) {
    std::ranges::replace(name, '/', '-');
    return name + ".png";
}

double sumOf(const bench::StageTimes& stages) {
    double sum = 0;
    for (const auto& [stage, time] : stages) sum += time.gpu;
    return sum;
}

std::vector<NamedWall> wallsOf(const Extent& ofCards, const Extent& ofDesk) {
    using enum config::QualityTier;
    return {wallOf("theatre", "config/theatre.txtpb", ofCards, {Medium, High, Ultra}),
            wallOf("eight_4k", "tests/bench/gpu/eight_4k.txtpb", ofCards, {Medium, High, Ultra}),
            wallOf("desk", "config/desk.txtpb", ofDesk, {Low})};
}

std::string nameOf(const NamedWall& wall, const SeaChoice& sea, config::QualityTier tier) {
    return "gpu/" + wall.name + "/" + sea.name + "/" + std::string(aquarama::config::nameOf(tier));
}

bench::Sea made(const SeaChoice& choice, const Extent& extent) {
    const auto fish = choice.fish ? std::optional{*choice.fish / extent.fewer} : std::nullopt;
    return bench::makeSea(test::sourceFolder() + "/config/scenes/" + choice.scene + ".txtpb",
                          fish,
                          extent.ticksBefore,
                          extent.frames);
}

// Calls for each sea on each wall that is wanted; a sea is made once for all tiers of a wall.
template <class Measure>
void eachWanted(const Options& options,
                const std::vector<NamedWall>& walls,
                const Measure& measure) {
    for (const SeaChoice& choice : kSeas)
        for (const NamedWall& wall : walls) {
            std::optional<bench::Sea> sea;
            for (const config::QualityTier tier : wall.tiers) {
                const std::string name = nameOf(wall, choice, tier);
                if (!options.wants(name)) continue;
                if (!sea) sea = made(choice, wall.extent);
                measure(name, *sea, wall, tier);
            }
        }
}

void refuseErrors(const std::string& name) {
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
        throw Error(name + ": OpenGL error " + std::to_string(error) +
                    " while it was drawn; leave it out by --only");
}

std::ofstream opened(const fs::path& path) {
    fs::create_directories(path.parent_path());
    std::ofstream file(path);
    if (!file) throw Error(path.string() + ": cannot be written; choose another --out");
    return file;
}

void count(const Options& options) {
    const fs::path path = options.out / "counts.csv";
    std::ofstream csv = opened(path);
    csv << bench::kCountsHead << '\n';
    bench::ShaderLog log{options.out / "shaders.txt"};
    bench::CallCounter counter{log};
    eachWanted(options,
               wallsOf(kCounted, kCounted),
               [&](const std::string& name,
                   const bench::Sea& sea,
                   const NamedWall& wall,
                   config::QualityTier tier) {
                   bench::writeCounts(csv, name, countedWall(sea, wall.rig, tier, counter));
                   refuseErrors(name);
               });
    std::printf("written: %s, and shaders.txt beside it\n", path.c_str());
}

class Measurement {
  public:
    explicit Measurement(const Options& options)
        : options_{options},
          isSoftware_{isSoftware(renderer())},
          csvPath_{options.out / (bench::fileNameOf(renderer()) + ".csv")},
          csv_{opened(csvPath_)},
          rows_{csv_, gl::rendererAndVersion() + ", " + bench::processorName()} {}

    void measure() {
        std::printf("%s, %s\n", gl::rendererAndVersion().c_str(), bench::processorName().c_str());
        eachWanted(options_, wallsOf(isSoftware_ ? kTrial : Extent{}, {}), [&](const auto&... of) {
            measureWall(of...);
        });
        compareGolden();
        std::printf("written: %s, and pictures beside it\n", csvPath_.c_str());
    }

  private:
    void measureWall(const std::string& name,
                     const bench::Sea& sea,
                     const NamedWall& wall,
                     config::QualityTier tier) {
        const auto free = bench::freeMebibytes();
        const auto start = std::chrono::steady_clock::now();
        bench::DrawnWall drawn(sea, wall.rig, tier);
        const std::chrono::duration<double> building = std::chrono::steady_clock::now() - start;
        rows_.counter(name, "build_s", building.count());
        writeMemory(name, free);
        writeFrames(name, drawn.timeFrames(wall.extent.frameTimes));
        writeStages(name,
                    drawn.timeStages(wall.extent.stageTimes, clock(), /*withPixels=*/true),
                    drawn.timeStages(wall.extent.stageTimes, clock(), /*withPixels=*/false));
        writePng((options_.out / fileOf(name)).string(),
                 pictureOf(wall.panorama.compose(drawn.lights()), 8, 0));
        refuseErrors(name);
        csv_.flush();
    }

    [[nodiscard]] bench::Clocked clock() const {
        return isSoftware_ ? bench::Clocked::Finished : bench::Clocked::Queued;
    }

    void writeMemory(const std::string& name, std::optional<double> freeBefore) {
        const bench::CardMemory memory = bench::cardMemory();
        rows_.counter(name, "textures_mib", memory.textureMebibytes);
        rows_.counter(name, "buffers_mib", memory.bufferMebibytes);
        const auto free = bench::freeMebibytes();
        if (freeBefore && free) rows_.counter(name, "driver_mib", *freeBefore - *free);
    }

    void writeFrames(const std::string& name, const bench::FrameTimes& times) {
        const double median = bench::percentile(times.wall, 0.5);
        const double slow = bench::percentile(times.wall, 0.99);
        rows_.time(name, 1e6 * times.cpu);
        rows_.counter(name, "frames", static_cast<double>(times.wall.size()));
        rows_.counter(name, "frame_p50_ms", median);
        rows_.counter(name, "frame_p99_ms", slow);
        std::printf("%-40s frame %7.2f ms (p99 %7.2f), %6.1f a second; cpu %6.2f ms\n",
                    name.c_str(),
                    median,
                    slow,
                    1000 / median,
                    times.cpu);
        std::fflush(stdout);
    }

    void writeStages(const std::string& name,
                     const bench::StageTimes& all,
                     const bench::StageTimes& noPixels) {
        rows_.counter(name, "gpu_ms", sumOf(all));
        rows_.counter(name, "gpu_vertex_ms", sumOf(noPixels));
        for (const auto& [stage, time] : all) {
            const auto without = noPixels.find(stage);
            const double vertex = without == noPixels.end() ? 0.0 : without->second.gpu;
            const std::string row = name + "/" + underscored(stage);
            rows_.counter(row, "gpu_ms", time.gpu);
            rows_.counter(row, "gpu_vertex_ms", vertex);
            rows_.counter(row, "cpu_ms", time.cpu);
            const bench::StageWork& work = time.work;
            rows_.counter(row, "vertices", static_cast<double>(work.vertices));
            rows_.counter(row, "primitives", static_cast<double>(work.primitives));
            rows_.counter(row, "fragments", static_cast<double>(work.fragments));
            rows_.counter(row, "computed", static_cast<double>(work.computed));
            std::printf(
                "    %-14s %8.3f ms, without pixels %8.3f; cpu %8.3f; thousands of vertices %7.1f, "
                "triangles %7.1f, fragments %8.1f, computed %8.1f\n",
                stage.c_str(),
                time.gpu,
                vertex,
                time.cpu,
                1e-3 * static_cast<double>(work.vertices),
                1e-3 * static_cast<double>(work.primitives),
                1e-3 * static_cast<double>(work.fragments),
                1e-3 * static_cast<double>(work.computed));
        }
    }

    void compareGolden() {
        fs::create_directories(options_.out / "golden");
        int within = 0;
        int compared = 0;
        for (const test::GoldenStill& golden : test::goldenStills()) {
            const std::string name = "gpu/golden/" + golden.name;
            if (!options_.wants(name)) continue;
            const Picture picture = test::pictureOf(golden.still);
            const auto apart =
                test::codeDifference(picture, readPng(test::goldenPath(golden.name)));
            const bool isWithin = apart.within(golden.limits);
            rows_.counter(name, "mean_codes", apart.meanCodes);
            rows_.counter(name, "percentile_999_codes", apart.percentile999Codes);
            rows_.counter(name, "within_bounds", isWithin ? 1 : 0);
            writePng((options_.out / "golden" / fileOf(golden.name)).string(), picture);
            if (!isWithin)
                std::printf("%-40s differs: mean %.2f codes, 99.9 %% within %.0f\n",
                            name.c_str(),
                            apart.meanCodes,
                            apart.percentile999Codes);
            within += isWithin ? 1 : 0;
            ++compared;
        }
        if (compared > 0)
            std::printf("%d of %d pictures are those of software Mesa\n", within, compared);
    }

    const Options& options_;
    bool isSoftware_;
    fs::path csvPath_;
    std::ofstream csv_;
    bench::CsvWriter rows_;
};

}  // namespace

int main(int argc, char** argv) try {
    Options options;
    CLI::App app{"Measures a graphics card without a display."};
    app.add_option("--out", options.out, "folder of the figures and pictures");
    app.add_option("--only", options.only, "parts of names, as eight_4k, reef/high or golden/");
    app.add_option("--device", options.device, "auto | nvidia | mesa | surfaceless | device:N");
    app.add_flag("--software",
                 options.software,
                 "also without a card: the desk as it is, the other walls tiny");
    app.add_flag("--counts",
                 options.counts,
                 "no times: what each call of a frame gives a card to do, at full size");
    CLI11_PARSE(app, argc, argv);
    const Card card = openCard(options);
    if (!card.context) {
        std::printf("no GPU here: %s\n", card.lack.c_str());
        return kSkipped;
    }
    if (options.counts)
        count(options);
    else
        Measurement(options).measure();
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "aquarama_gpu_bench: %s\n", error.what());
    return 1;
}
