// SPDX-License-Identifier: Apache-2.0
#include "calibration/result/figures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/base/statistics.h"

namespace aquarama::result {

const char* nameOf(Judgement judgement) {
    constexpr std::array kNames{"pass", "warn", "refuse"};
    return kNames.at(static_cast<std::size_t>(judgement));
}

namespace {

// The place of the panorama that each channel shows at a point that it lights.
std::vector<glm::dvec2> shownAt(const hall::TrueHall& truth,
                                const wall::ScreenSurface& screen,
                                const formats::WallFile& file,
                                glm::ivec2 panorama,
                                glm::dvec3 point) {
    std::vector<glm::dvec2> shown;
    for (std::size_t channel = 0; channel < file.channels.size(); ++channel) {
        const auto pixel = truth.pixelOf(channel, point);
        if (!pixel) continue;
        const formats::FileChannel& region = file.channels[channel];
        const glm::vec3 lit = formats::warpAt(*region.warp, *pixel / glm::dvec2(region.sizePixels));
        if (std::isnan(lit.x)) continue;
        shown.push_back(screen.unrolled(lit) * glm::dvec2(panorama));
    }
    return shown;
}

}  // namespace

WallErrors errorsOf(const hall::TrueHall& truth,
                    const config::Rig& rig,
                    const formats::WallFile& file,
                    std::size_t points) {
    const auto screen = wall::makeSurface(rig);
    WallErrors errors;
    for (const glm::dvec3& point : truth.screenPoints(points)) {
        const glm::dvec2 place = truth.unrolled(point) * glm::dvec2(rig.panoramaPixels);
        if (std::isnan(place.x)) continue;
        const auto shown = shownAt(truth, *screen, file, rig.panoramaPixels, point);
        for (std::size_t i = 0; i < shown.size(); ++i) {
            errors.absolute.push_back(glm::distance(shown[i], place));
            for (std::size_t j = i + 1; j < shown.size(); ++j)
                errors.overlap.push_back(glm::distance(shown[i], shown[j]));
        }
    }
    return errors;
}

namespace {

// Bounds of good and of usable overlaps, in panorama pixels.
struct Bounds {
    double rms, p95, most;
};
constexpr Bounds kGood{0.2, 0.45, 1.0};
constexpr Bounds kUsable{0.6, 1.4, 3.0};

bool isWithin(const geometry::OverlapFigures& overlap, const Bounds& bounds) {
    return overlap.rms <= bounds.rms && overlap.p95 <= bounds.p95 && overlap.most <= bounds.most;
}

void take(CalibrationVerdict& verdict, Judgement judgement, const scan::ScanFault& fault) {
    if (judgement <= verdict.judgement && !verdict.cause.empty()) return;
    verdict = {std::max(judgement, verdict.judgement), fault.cause, fault.advice};
}

// The number of channels that light a point of the rig's screen, as the rig describes them.
std::size_t lightAt(const geometry::SolvedHall& hall, glm::dvec3 point) {
    std::size_t lit = 0;
    for (std::size_t c = 0; c < hall.rig.channels.size(); ++c)
        if (hall.nominal.channel(c).pixelOf(point)) ++lit;
    return lit;
}

// Whether the rig has two channels that show one place. A single channel and channels that hang
// apart need no overlap.
bool hasOverlaps(const geometry::SolvedHall& hall) {
    constexpr int kColumns = 192, kRows = 64;
    if (hall.rig.channels.size() < 2) return false;
    for (int i = 0; i < kColumns * kRows; ++i) {
        const glm::dvec2 cell(i % kColumns, i / kColumns);
        const auto point = hall.nominal.screen().at((cell + 0.5) / glm::dvec2(kColumns, kRows));
        if (point && lightAt(hall, *point) > 1) return true;
    }
    return false;
}

// Judges places that were held out from the solve, where the rig has overlaps.
void judgeOverlaps(CalibrationVerdict& verdict,
                   const geometry::SolvedHall& hall,
                   const geometry::SolveFigures& solved) {
    constexpr std::size_t kLeastPoints = 8;
    if (solved.overlap.points < kLeastPoints) {
        if (!hasOverlaps(hall)) return;
        return take(verdict,
                    Judgement::Refuse,
                    {"no_overlap",
                     "the camera sees no place that two channels light, where the rig has them: "
                     "let neighbours overlap by a tenth of their pictures, or correct where the "
                     "rig says that they hang, and scan again"});
    }
    if (isWithin(solved.overlap, kGood)) return;
    take(verdict,
         isWithin(solved.overlap, kUsable) ? Judgement::Warn : Judgement::Refuse,
         {"misregistration",
          fmt::format("neighbours part by {:.2f} panorama pixels (RMS) at places that were kept "
                      "from the solve: let nothing move during the scan, focus the camera and scan "
                      "again",
                      solved.overlap.rms)});
}

// Judges the place of the whole picture by the camera's noise; errors of the model add to it.
void judgePlace(CalibrationVerdict& verdict, const geometry::SolveFigures& solved) {
    constexpr double kMostPixels = 1;
    if (solved.absoluteSigma <= kMostPixels) return;
    take(verdict,
         Judgement::Warn,
         {"place_not_sure",
          fmt::format("{}the whole picture may be off by {:.1f} panorama pixels "
                      "(RMS): mark the middle of the screen's upper and lower edge with strips of "
                      "dark tape, 50 mm by 150 mm, let the screen fill the camera's picture, and "
                      "scan again",
                      solved.overlap.points > 0 ? "neighbours agree, but " : "",
                      solved.absoluteSigma)});
}

// The difference of a projector's lens from the rig, as shares of the permitted difference.
struct LensApart {
    const config::Channel* channel = nullptr;
    double stretch = 0;          // of its picture: the aspect, and that of a trapezoid
    double zoom = 0, shift = 0;  // of the focal length, and of the picture's width
    [[nodiscard]] double setting() const { return std::max(zoom, shift); }
};
LensApart apartFromRig(const geometry::SolvedHall& hall, std::size_t channel) {
    constexpr double kMostStretch = 0.01, kMostZoom = 0.1, kMostShift = 0.15;
    const config::Channel& said = hall.rig.channels[channel];
    const geometry::LensParameters expected = geometry::lensOf(said.projector);
    const geometry::LensParameters& found = hall.projectors[channel].lens;
    const glm::dvec2 size(said.sizePixels);
    const double aspect =
        std::abs(found[geometry::lens::Aspect] - expected[geometry::lens::Aspect]);
    const double trapezoid = std::hypot(found[geometry::lens::P1], found[geometry::lens::P2]) *
                             glm::length(size) / (2 * expected[geometry::lens::Focal]);
    const double shift =
        std::hypot(found[geometry::lens::CentreX] - expected[geometry::lens::CentreX],
                   found[geometry::lens::CentreY] - expected[geometry::lens::CentreY]);
    return {
        &said,
        std::max(aspect, trapezoid) / kMostStretch,
        std::abs(found[geometry::lens::Focal] / expected[geometry::lens::Focal] - 1) / kMostZoom,
        shift / size.x / kMostShift};
}

// A picture of another shape than the rig's can be fitted so that neighbours agree, but its errors
// pull the other projectors from their places: most of all on domes, where all overlap.
void judgeLenses(CalibrationVerdict& verdict, const geometry::SolvedHall& hall) {
    std::vector<LensApart> lenses;
    for (std::size_t c = 0; c < hall.projectors.size(); ++c)
        lenses.push_back(apartFromRig(hall, c));
    const LensApart& worst = *std::ranges::max_element(lenses, {}, &LensApart::stretch);
    if (worst.stretch > 1)
        take(verdict,
             Judgement::Warn,
             {"picture_stretched",
              fmt::format("channel \"{}\" shows its picture stretched or as a trapezoid: switch "
                          "its keystone correction off, send it its own resolution, and scan again",
                          worst.channel->name)});
    const LensApart& set = *std::ranges::max_element(lenses, {}, &LensApart::setting);
    if (set.setting() > 1)
        take(verdict,
             Judgement::Warn,
             {"lens_not_as_stated",
              fmt::format("the lens of channel \"{}\" is not {} as the rig says: switch keystone "
                          "correction off, correct the rig or the lens, and scan again",
                          set.channel->name,
                          set.zoom > set.shift ? "zoomed" : "shifted")});
}

// A round edge does not show the rotation about its axis; a mark on it does.
void judgeDome(CalibrationVerdict& verdict, const geometry::Solved& solved) {
    if (solved.hall->rig.screen.shape != config::ScreenShape::Dome || solved.figures.marks > 0)
        return;
    take(verdict,
         Judgement::Warn,
         {"dome_front",
          "the camera does not see where the front of a dome is: stick strips of dark tape, 50 mm "
          "by 150 mm, on its edge straight ahead and straight behind, from the edge inwards, and "
          "scan again"});
}

// Where each place of a dome is lit by one projector alone, only the round edge shows where the
// picture lies: in simulations it was up to eight pixels off.
void judgeLoneDome(CalibrationVerdict& verdict, const geometry::Solved& solved) {
    if (solved.hall->rig.screen.shape != config::ScreenShape::Dome ||
        solved.figures.overlap.points > 0)
        return;
    take(
        verdict,
        Judgement::Warn,
        {"place_not_checked",
         "no place of the dome is lit by two projectors, so nothing checks where its picture lies: "
         "show aquarama run --pattern grid, and move what is off by aquarama adjust move"});
}

void judgeOutline(CalibrationVerdict& verdict, const geometry::SolveFigures& solved) {
    constexpr std::size_t kLeastPoints = 150;
    constexpr double kMostPixels = 1.5;
    if (solved.outlinePoints < kLeastPoints)
        take(verdict,
             Judgement::Warn,
             {"outline_not_seen",
              "the outline of the screen is not seen all round, so the whole picture may be off: "
              "show all of the screen to the camera, and light the room for the first picture"});
    else if (solved.outlineRms > kMostPixels)
        take(verdict,
             Judgement::Refuse,
             {"wrong_screen",
              fmt::format("the screen's outline is {:.1f} camera pixels off (RMS) from what the "
                          "rig says: measure the screen and correct the rig",
                          solved.outlineRms)});
}

// Exchanged cables make channels look hidden, so the faults of the solve come first.
void takeFaults(CalibrationVerdict& verdict,
                const std::vector<scan::CameraView>& views,
                const geometry::Solved& solved) {
    const auto takeAll = [&](const std::vector<scan::ScanFault>& faults) {
        for (const scan::ScanFault& fault : faults)
            take(verdict, fault.refuses ? Judgement::Refuse : Judgement::Warn, fault);
    };
    takeAll(solved.faults);
    for (const scan::CameraView& view : views) takeAll(view.faults);
}

}  // namespace

CalibrationVerdict judged(const std::vector<scan::CameraView>& views,
                          const geometry::Solved& solved) {
    CalibrationVerdict verdict;
    takeFaults(verdict, views, solved);
    if (!solved.faults.empty()) return verdict;
    judgeOverlaps(verdict, *solved.hall, solved.figures);
    judgeOutline(verdict, solved.figures);
    judgePlace(verdict, solved.figures);
    judgeDome(verdict, solved);
    judgeLoneDome(verdict, solved);
    judgeLenses(verdict, *solved.hall);
    return verdict;
}

CalibrationVerdict judgedLight(CalibrationVerdict verdict,
                               const std::optional<light::BrightnessFigures>& brightness,
                               const std::optional<light::ForeseenSeams>& seams) {
    constexpr double kMostLight = 0.01, kMostDark = 0.03;
    if (!brightness)
        take(verdict,
             Judgement::Warn,
             {"colour_not_measured",
              "places are right, but light and colour are as the projectors give them: the scan "
              "lacks levels, or a channel cannot be told from others; scan with all patterns, and "
              "let no channel be wholly covered by others"});
    if (!seams) return verdict;
    const double light = std::max(seams->grey18, seams->grey100);
    if (light > kMostLight || seams->grey2 > kMostDark)
        take(verdict,
             Judgement::Warn,
             {"seam_visible",
              fmt::format("a seam of {:.1f} % is to be expected (of {:.1f} % in the dark): let the "
                          "projectors warm up for half an hour, switch off their automatic "
                          "brightness, keep lamps and people away, and scan again",
                          100 * light,
                          100 * seams->grey2)});
    return verdict;
}

TrueFigures trueFigures(const WallErrors& errors, const light::Seams& seams) {
    return {.overlap = geometry::overlapFigures(errors.overlap),
            .absoluteRms = rootMeanSquare(errors.absolute),
            .seams = seams};
}

std::string jsonOf(const Figures& figures) {
    const auto told = [](const auto& from, auto value, double unit) {
        return from ? nlohmann::ordered_json(unit * (*from).*value)
                    : nlohmann::ordered_json(nullptr);
    };
    const auto parting = [&](double pixels) {
        return figures.overlap().points > 0 ? nlohmann::ordered_json(pixels)
                                            : nlohmann::ordered_json(nullptr);
    };
    const auto seam = [&](double light::Seams::*known, double light::ForeseenSeams::*foreseen) {
        return figures.truth ? nlohmann::ordered_json(100 * figures.truth->seams.*known)
                             : told(figures.foreseen, foreseen, 100);
    };
    return nlohmann::ordered_json{
               {"verdict", nameOf(figures.verdict.judgement)},
               {"cause", figures.verdict.cause},
               {"advice", figures.verdict.advice},
               {"from_ground_truth", figures.truth.has_value()},
               {"overlap_rms_px", parting(figures.overlap().rms)},
               {"overlap_p95_px", parting(figures.overlap().p95)},
               {"overlap_max_px", parting(figures.overlap().most)},
               {"overlap_points", figures.overlap().points},
               {"absolute_rms_px", figures.absoluteRms()},
               {"seam_percent_grey2", seam(&light::Seams::grey2, &light::ForeseenSeams::grey2)},
               {"seam_percent_grey18", seam(&light::Seams::grey18, &light::ForeseenSeams::grey18)},
               {"seam_percent_grey100",
                seam(&light::Seams::grey100, &light::ForeseenSeams::grey100)},
               {"seam_ciede2000",
                figures.truth ? nlohmann::ordered_json(figures.truth->seams.colour)
                              : nlohmann::ordered_json(nullptr)},
               {"kept_light", told(figures.brightness, &light::BrightnessFigures::keptLight, 1)},
               {"kept_contrast",
                told(figures.brightness, &light::BrightnessFigures::keptContrast, 1)},
               {"desaturation",
                told(figures.brightness, &light::BrightnessFigures::desaturation, 1)},
               {"outline_rms_camera_px", figures.solve.outlineRms},
               {"fit_rms_projector_px", figures.solve.fitRms},
               {"seconds", figures.seconds},
               {"pictures", figures.pictures},
               {"peak_megabytes", figures.peakMegabytes}}
               .dump(2) +
           "\n";
}

}  // namespace aquarama::result
