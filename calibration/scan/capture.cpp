// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/capture.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/statistics.h"
#include "common/cli/command_line.h"
#include "common/cli/outputs.h"
#include "common/cli/progress.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::scan {

namespace {

using Pattern = config::ScanPattern;

// The delay of projectors: they show a frame some frames later.
constexpr auto kProjectorDelay = std::chrono::milliseconds(150);
constexpr int kAttempts = 3;

bool isWhite(const Pattern& pattern) {
    return pattern.kind == Pattern::Kind::Level && !isBlack(pattern) &&
           pattern.light == glm::vec3(1) && pattern.step == 0;
}

// All pixels have one code, as with a lens cap on.
bool isEven(const Picture& picture) {
    return std::ranges::adjacent_find(picture.rgb, std::ranges::not_equal_to{}) ==
           picture.rgb.end();
}

// The code (0 to 1) that this share of the pixels exceeds in one of its colours.
double codeExceededBy(const Picture& picture, double share) {
    std::vector<std::uint16_t> codes;
    for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3)
        codes.push_back(std::max({picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]}));
    const auto brighter = static_cast<std::size_t>(share * static_cast<double>(codes.size()));
    return valueAtRank(codes, codes.size() - 1 - brighter) / (picture.bits == 16 ? 65535.0 : 255.0);
}

// Shows patterns and takes pictures of them.
class Photographer {
  public:
    Photographer(PatternWall& wall, Camera& camera) : wall_{wall}, camera_{camera} {}

    struct Taken {
        Picture picture;
        std::uint64_t frame = 0;
    };
    // A channel that was lost meanwhile may return: show() waits for it.
    Taken take(const Pattern& pattern, double exposure) {
        for (int attempt = 1;; ++attempt) {
            const std::uint64_t frame = wall_.show(pattern);
            std::this_thread::sleep_for(kProjectorDelay);
            Picture picture = camera_.take(exposure);
            try {
                wall_.confirm();
            } catch (const Error& problem) {
                if (attempt == kAttempts) throw;
                logWarning("a picture is taken again: {}", problem.what());
                continue;
            }
            if (isNew(picture)) return {std::move(picture), frame};
            if (attempt == kAttempts)
                throw Error(
                    "the camera gives the same picture again and again; switch it off and on, "
                    "plug it in anew, and scan again");
        }
    }

  private:
    // Whether a picture differs from the one before: noise makes all pictures different.
    bool isNew(const Picture& picture) {
        const bool isSame = before_.rgb == picture.rgb && !isEven(picture);
        before_ = picture;
        return !isSame;
    }

    PatternWall& wall_;
    Camera& camera_;
    Picture before_;
};

// Finds the longest exposure of the camera at which white is not clipped.
class ExposureChoice {
  public:
    ExposureChoice(Photographer& photographer, ExposureRange range, double refreshHertz)
        : photographer_{photographer}, range_{range}, refresh_{1 / refreshHertz} {}

    double of(const std::vector<Pattern>& whites) {
        double chosen = range_.longest;
        for (const Pattern& white : whites) chosen = std::min(chosen, below(white, chosen));
        return chosen;
    }

  private:
    static constexpr double kNearFull = 0.98;
    static constexpr double kShare = 0.001;
    static constexpr double kWanted = 0.7;  // of the light that clips
    static constexpr double kDarkest = 0.05;

    // Computes the next exposure as if the camera had the response of sRGB, and tests each, since
    // the response is only similar.
    double below(const Pattern& white, double most) {
        constexpr int kMostSteps = 10;
        if (range_.isFixed()) return fixed(white);
        double exposure = std::min(most, std::max(range_.shortest, 2 * refresh_));
        for (int step = 0; step < kMostSteps; ++step) {
            const double code = brightest(white, exposure);
            const bool isClipped = code >= kNearFull;
            const double light = std::max(linearFromSrgb(code), 1e-3);
            const double next =
                inRange(isClipped ? exposure / 3 : exposure * kWanted / light, most);
            if (!isClipped && std::abs(std::log(next / exposure)) < 0.2)
                return unlessTooDark(exposure, light);
            if (isClipped && exposure <= range_.shortest) break;
            exposure = next;
        }
        throw Error(
            fmt::format("white is clipped at {:.4f} s, or changes from picture to picture; "
                        "close the aperture, switch off what the camera does by itself (exposure, "
                        "gain, white balance), and scan again",
                        exposure));
    }
    double fixed(const Pattern& white) {
        if (brightest(white, range_.shortest) >= kNearFull)
            throw Error(
                "white is clipped and the camera lets no exposure be chosen; choose a "
                "shorter one on it, or close its aperture, and scan again");
        return range_.shortest;
    }
    static double unlessTooDark(double exposure, double light) {
        if (light < kDarkest)
            throw Error(
                fmt::format("white is too dark even at {:.3f} s; open the aperture, take "
                            "the cap off the lens, aim the camera at the wall, and scan again",
                            exposure));
        return exposure;
    }
    double brightest(const Pattern& white, double exposure) {
        return codeExceededBy(photographer_.take(white, exposure).picture, kShare);
    }
    // Exposes for whole refreshes where possible; else the flicker of projectors is in the picture.
    [[nodiscard]] double inRange(double exposure, double most) const {
        const double within = std::clamp(exposure, range_.shortest, std::min(most, range_.longest));
        const double whole = std::floor(within / refresh_ + 1e-6) * refresh_;
        return whole >= range_.shortest && whole > 0 ? whole : within;
    }

    Photographer& photographer_;
    ExposureRange range_;
    double refresh_;  // seconds
};

std::vector<Pattern> whitesOf(const std::vector<Pattern>& sequence) {
    std::vector<Pattern> whites;
    std::ranges::copy_if(sequence, std::back_inserter(whites), isWhite);
    return whites;
}

// What is to be taken, in order.
std::vector<config::ScanPicture> planOf(const std::vector<Pattern>& sequence,
                                        double chosen,
                                        ExposureRange range) {
    std::vector<config::ScanPicture> plan;
    for (const Pattern& pattern : sequence) {
        const double exposure = chosen * wall::scanExposure(pattern);
        if (exposure < range.shortest) continue;  // tells of the camera's response, if it can
        plan.push_back({.file = fmt::format("picture-{:04}.png", plan.size() + 1),
                        .exposureSeconds = exposure,
                        .pattern = pattern});
    }
    return plan;
}

void writeScan(const config::Scan& scan, const config::Rig& rig, const std::string& folder) {
    std::vector<std::string> names;
    for (const config::Channel& channel : rig.channels) names.push_back(channel.name);
    const std::string text = config::textOf(scan, names);
    writeWhole(folder + "/scan.txtpb", std::as_bytes(std::span{text}));
}

}  // namespace

config::Scan capture(const config::Rig& rig,
                     PatternWall& wall,
                     Camera& camera,
                     const std::vector<Pattern>& sequence,
                     const std::string& folder) {
    cli::requireFolder("--out", folder);
    const ExposureRange range = camera.exposures();
    Photographer photographer(wall, camera);
    const double chosen =
        ExposureChoice(photographer, range, rig.timing.refreshHertz).of(whitesOf(sequence));
    config::Scan scan{.rig = rig.name,
                      .cameras = std::vector<config::ScanCamera>(1),
                      .pictures = planOf(sequence, chosen, range)};
    cli::Progress progress("scan: picture", scan.pictures.size());
    std::uint64_t done = 0;
    for (config::ScanPicture& planned : scan.pictures) {
        const auto [picture, frame] = photographer.take(planned.pattern, planned.exposureSeconds);
        planned.frame = frame;
        writePng(folder + "/" + planned.file, picture);
        progress.count(++done);
    }
    progress.end();
    writeScan(scan, rig, folder);
    cli::say(fmt::format("scan of {} pictures in {}", scan.pictures.size(), folder));
    return scan;
}

config::Scan captureShow(const config::Rig& rig,
                         const ShownOn& where,
                         const std::string& device,
                         const std::vector<Pattern>& sequence,
                         const std::string& folder) {
    cli::holdSignals();
    ShownPatterns wall(where);
    const cli::SignalWatch watch([&wall] { wall.giveBack(); });
    const auto camera = openCamera(device);
    return capture(rig, wall, *camera, sequence, folder);
}

}  // namespace aquarama::scan
