// SPDX-License-Identifier: Apache-2.0
#include "calibration/result/page.h"

#include <algorithm>
#include <cmath>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "calibration/result/drawing.h"
#include "calibration/result/maps.h"
#include "common/base/picture.h"
#include "common/base/statistics.h"
#include "common/base/units.h"
#include "common/wall/pattern.h"

namespace aquarama::result {

extern const char* const kPageStyle;  // page.css, embedded by CMake

namespace {

// The head of the page: {0} is the name of the rig, {1} the style.
constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>Calibration of {0}</title>
<style>
{1}</style></head><body>
<h1>Calibration of {0}</h1>
)";

// Title and explanation are escaped here; `content` is HTML already.
std::string section(const std::string& title, const std::string& what, const std::string& content) {
    return fmt::format(
        "<section><h2>{}</h2>\n<p>{}</p>\n{}</section>\n", escaped(title), escaped(what), content);
}

std::string verdict(const CalibrationPage& page) {
    const std::string name = nameOf(page.figures.verdict.judgement);
    std::string what = page.figures.verdict.advice;
    if (page.figures.verdict.judgement == Judgement::Pass)
        what =
            "neighbours agree and the picture lies where it belongs. Name the file in the rig: "
            "calibration: \"" +
            page.wallFile.substr(page.wallFile.find_last_of('/') + 1) + "\".";
    if (page.figures.verdict.judgement == Judgement::Refuse)
        what += ". No wall file was written: the wall shows what it showed before.";
    const std::string cause =
        page.figures.verdict.cause.empty() ? "" : ": " + page.figures.verdict.cause;
    return fmt::format("<div class=\"verdict {0}\"><b>{0}{1}</b><p>{2}</p></div>\n",
                       name,
                       escaped(cause),
                       escaped(what));
}

// One row of the table of figures. All three texts are escaped here.
std::string row(const std::string& name, const std::string& value, const std::string& meaning) {
    return fmt::format(
        "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"dim\">{}</td></tr>\n",
        escaped(name),
        escaped(value),
        escaped(meaning));
}

// Pixels of the panorama, as the head of the page says.
std::string pixels(double value) {
    return fmt::format("{:.3f} px", value);
}

// What is known of light and colour: of a simulated hall what is left, else what evening costs.
std::string lightRows(const Figures& figures) {
    std::string rows;
    if (figures.truth) {
        rows +=
            row("Steps of light",
                fmt::format("{:.1f}, {:.1f} and {:.1f} %",
                            100 * figures.truth->seams.grey2,
                            100 * figures.truth->seams.grey18,
                            100 * figures.truth->seams.grey100),
                "The largest about an overlap, for grey of 2, 18 and 100 %; good is 3, 1 and 1.");
        rows += row("Steps of colour",
                    fmt::format("{:.2f}", figures.truth->seams.colour),
                    "CIEDE2000 from one side of an overlap to the other, mean; good is 0.7.");
    }
    if (figures.brightness)
        rows +=
            row("Kept light",
                fmt::format("{:.0f} %, contrast {:.0f} %",
                            100 * figures.brightness->keptLight,
                            100 * figures.brightness->keptContrast),
                "Of what the projectors give at their brightest, and of white against black, so "
                "that neighbours look alike.");
    return rows;
}

// How channels agree where two of them show one point.
std::string neighbourRows(const Figures& figures, const std::string& source) {
    std::string rows =
        row("Neighbours, RMS",
            pixels(figures.overlap().rms),
            source + "How far two projectors part where both show one point; good is 0.20.");
    rows += row("Neighbours, 95 %",
                pixels(figures.overlap().p95),
                "Nineteen points of twenty are better; good is 0.45.");
    rows +=
        row("Neighbours, most", pixels(figures.overlap().most), "The worst point; good is 1.0.");
    return rows + row("Points", fmt::format("{}", figures.overlap().points), "of these errors.");
}

// A simulation is told apart in words: its errors come from the truth, others from places that were
// kept from the solve.
std::string figureTable(const Figures& figures) {
    const std::string source =
        figures.truth ? "From the truth of the simulated hall, at points that the solve has not "
                        "seen. "
                      : "At places that were kept from the solve. ";
    std::string rows = "<div class=\"wide\"><table class=\"figures\">\n";
    if (figures.overlap().points > 0) rows += neighbourRows(figures, source);
    rows += row("Place, RMS",
                pixels(figures.absoluteRms()),
                figures.truth
                    ? "How far the picture lies from where it belongs; good is 1.0."
                    : "How well the solve knows where the whole picture lies, by the noise of what "
                      "the camera saw; good is 0.8.");
    rows += row("Outline, RMS",
                fmt::format("{:.2f} camera px", figures.solve.outlineRms),
                "Between the screen's edge in the camera's picture and where the solve has it.");
    rows += row("Fit, RMS",
                fmt::format("{:.3f} projector px", figures.solve.fitRms),
                "What models of lenses and screen leave over at the places that they were fitted "
                "to; it is corrected afterwards and is no measure of accuracy.");
    rows += lightRows(figures);
    rows += row("Cost",
                fmt::format("{} pictures, {:.0f} s, {:.0f} MB",
                            figures.pictures,
                            figures.seconds,
                            figures.peakMegabytes),
                "Pictures of the camera, time and memory of the computer.");
    return rows + "</table></div>\n";
}

// The whole page while its parts are drawn.
class Writer {
  public:
    explicit Writer(const CalibrationPage& page)
        : page_{page}, hall_{*page.solved.hall}, rig_{hall_.rig} {}

    // A refused calibration has no wall file: the parts that compare with one are left out.
    std::string html() {
        std::string text = fmt::format(kHead, escaped(rig_.name), kPageStyle);
        text += verdict(page_);
        text += "<p class=\"dim\">Errors are in pixels of the panorama (px), which is " +
                fmt::format("{} x {}", rig_.panoramaPixels.x, rig_.panoramaPixels.y) +
                ". The wall is drawn unrolled, as the sweet spot sees it.</p>\n";
        if (page_.figures.overlap().points > 0 ||
            page_.figures.verdict.judgement != Judgement::Refuse)
            text += section(
                "Figures", "What was measured, and what is good.", figureTable(page_.figures));
        text += camera();
        if (page_.figures.verdict.judgement != Judgement::Refuse) text += calibrated();
        return text + "</body></html>\n";
    }

  private:
    // Of a drawing over the panorama.
    [[nodiscard]] double height() const {
        return kDrawingWidth * rig_.panoramaPixels.y / rig_.panoramaPixels.x;
    }
    // A size in pixels with the aspect of the panorama, and with at least two rows.
    [[nodiscard]] glm::ivec2 sized(int width) const {
        return {width, std::max(2, width * rig_.panoramaPixels.y / rig_.panoramaPixels.x)};
    }
    // From shares of the unrolled screen (0 to 1) to units of the drawing.
    [[nodiscard]] glm::dvec2 drawn(glm::dvec2 unrolled) const {
        return unrolled * glm::dvec2(kDrawingWidth, height());
    }

    // The parts that need a wall file. Throws Error where it cannot be read.
    [[nodiscard]] std::string calibrated() const {
        const hall::DrawnWall before(rig_);
        const hall::DrawnWall after(hall::withWallFile(rig_, page_.wallFile));
        const auto fall = page_.truth != nullptr ? fallOf(*page_.truth) : fallOf(hall_);
        return beforeAndAfter(*fall, before, after) + errors(*fall, after) + uncertainty() +
               footprints(after) + profiles(*fall, before, after) + displacement() + projectors();
    }

    // What the camera saw with the lamps on, as bright as is clear.
    [[nodiscard]] std::string camera() const {
        constexpr int kWidth = 640;
        if (page_.views.empty() || page_.views.front().room.rgb.empty()) return {};
        const Light& room = page_.views.front().room;
        const glm::ivec2 size(kWidth, std::max(1, kWidth * room.sizePixels.y / room.sizePixels.x));
        Light small = darkness(size);
        std::vector<double> levels;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                small.at(x, y) = bilinear(
                    room,
                    (glm::dvec2(x, y) + 0.5) * glm::dvec2(room.sizePixels) / glm::dvec2(size));
                levels.push_back(static_cast<double>(small.at(x, y).y));
            }
        const auto bright = static_cast<float>(std::max(1e-6, quantile(levels, 0.99)));
        for (glm::vec3& light : small.rgb) light *= 0.8F / bright;
        return section("The camera's view",
                       "The first picture, brightened: the projectors are black, and all of the "
                       "screen's outline must be seen.",
                       drawing(pictureOf(small, 8, 0),
                               kDrawingWidth * size.y / size.x,
                               "",
                               "the screen as the camera sees it"));
    }

    // The name is put into the page as it is: only constants are given.
    [[nodiscard]] std::string grid(const Fall& fall,
                                   const hall::DrawnWall& wall,
                                   const std::string& name) const {
        constexpr int kWidth = 1200;
        const Light seen = seenPanorama(fall, wall, hall::gridContent(wall.wall()), sized(kWidth));
        return "<p>" + name + "</p>\n" + drawing(pictureOf(seen, 8, 0), height(), "", name);
    }

    // Both pictures are of the same hall; only what the nodes draw differs.
    [[nodiscard]] std::string beforeAndAfter(const Fall& fall,
                                             const hall::DrawnWall& before,
                                             const hall::DrawnWall& after) const {
        return section(
            "Before and after",
            std::string("The grid of aquarama run --pattern grid, from the sweet spot of the ") +
                (page_.truth != nullptr ? "simulated" : "solved") +
                " hall. Its lines are straight and single where the wall is one.",
            grid(fall, before, "Before: through the projectors as the rig has them") +
                grid(fall, after, "After: through the wall file"));
    }

    // A field with its scale below it.
    [[nodiscard]] std::string mapped(const Field& field,
                                     double most,
                                     const std::string& overlay,
                                     const std::string& title) const {
        return drawing(colouredField(field, kGrowing, 0, most), height(), overlay, title) +
               scaleBar(kGrowing, "0", fmt::format("{:.2g} px", most));
    }

    // A circle for each place that was kept from the solve. `most`: pixels at the end of the colour
    // scale.
    [[nodiscard]] std::string heldOutDots(double most) const {
        std::string dots;
        for (const geometry::Parting& parting : page_.solved.partings) {
            const glm::dvec2 at = drawn(parting.place / glm::dvec2(rig_.panoramaPixels));
            dots += fmt::format(
                "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"{}\" "
                "stroke=\"#fff\" stroke-width=\"0.7\"/>",
                at.x,
                at.y,
                cssColour(colourAt(kGrowing, parting.pixels / most)));
        }
        return dots;
    }

    // Without a truth only the dots are known, and the field below them is empty. The scale ends at
    // 0.2 pixels at least: small errors are not stretched over all colours.
    [[nodiscard]] std::string errors(const Fall& fall, const hall::DrawnWall& after) const {
        constexpr int kWidth = 500;
        std::string text;
        const bool hasNeighbours = page_.figures.overlap().points > 0;
        if (page_.truth == nullptr && !hasNeighbours) return text;
        if (page_.truth == nullptr) {
            double most = 0.2;
            for (const geometry::Parting& parting : page_.solved.partings)
                most = std::max(most, parting.pixels);
            text = mapped(emptyField({2, 2}), most, heldOutDots(most), "distances of neighbours");
            return section("Where neighbours part",
                           "Each dot is a place that two projectors light and that was kept from "
                           "the solve.",
                           text);
        }
        const ErrorMaps maps = errorMaps(fall, after, rig_.panoramaPixels, sized(kWidth));
        const double apart = std::max(0.2, largestOf(maps.neighbours));
        if (hasNeighbours)
            text =
                section("Where neighbours part",
                        "Grey is lit by one projector. Dots are the places that were kept from the "
                        "solve, the field is the truth.",
                        mapped(maps.neighbours, apart, heldOutDots(apart), "neighbours"));
        return text + section("Where the picture lies beside its place",
                              "By the truth of the simulated hall.",
                              mapped(maps.absolute,
                                     std::max(1.0, largestOf(maps.absolute)),
                                     "",
                                     "absolute errors"));
    }

    // No text where the solve gave no uncertainty.
    [[nodiscard]] std::string uncertainty() const {
        const Field field{page_.solved.uncertainty.size, page_.solved.uncertainty.pixels};
        if (field.values.empty()) return {};
        return section("How well the place is known",
                       "One standard deviation, by the noise of what the camera saw and by how "
                       "models of lenses and screen hold together. Where it is large, a finer or "
                       "nearer camera helps.",
                       mapped(field, std::max(0.1, largestOf(field)), "", "uncertainty"));
    }

    // A white line lies below each dashed one, so that it is seen on every colour.
    [[nodiscard]] std::string footprints(const hall::DrawnWall& after) const {
        constexpr int kWidth = 600;
        std::string overlay;
        for (std::size_t i = 0; i < rig_.channels.size(); ++i) {
            const glm::ivec2 size = rig_.channels[i].sizePixels;
            const std::string colour = colourOf(i);
            for (const auto& piece : footprint(after.wall(), i, size)) {
                std::vector<glm::dvec2> points;
                points.reserve(piece.size());
                for (const glm::dvec2 place : piece) points.push_back(drawn(place));
                overlay += line(points, "#fff") + line(points, colour + "\" stroke-dasharray=\"8");
            }
            const auto middle =
                after.wall().channel(i).pointOf(glm::dvec2(size) / 2.0, wall::kSpillMetres);
            if (!middle) continue;
            const glm::dvec2 at = drawn(after.wall().screen().unrolled(*middle));
            overlay += fmt::format(
                "<text class=\"label\" x=\"{:.0f}\" y=\"{:.0f}\" "
                "text-anchor=\"middle\">{}</text>",
                at.x,
                at.y,
                escaped(rig_.channels[i].name));
        }
        return section("Who lights what",
                       "Each projector in a colour of its own, by its share of the light; lines "
                       "are the borders of their pictures.",
                       drawing(pictureOf(sharesOfLight(after, sized(kWidth)), 8, 0),
                               height(),
                               overlay,
                               "footprints and blend"));
    }

    // channelColour() is linear light; CSS takes codes of sRGB.
    [[nodiscard]] static std::string colourOf(std::size_t channel) {
        glm::vec3 codes = channelColour(channel);
        for (int c = 0; c < 3; ++c)
            codes[c] = static_cast<float>(srgbFromLinear(static_cast<double>(codes[c])));
        return cssColour(codes);
    }

    // The light of grey along the middle of the wall, as a share of its mean.
    [[nodiscard]] Curve greyCurve(const Fall& fall,
                                  const hall::DrawnWall& wall,
                                  const std::string& name,
                                  glm::vec3 colour) const {
        constexpr int kSteps = 600, kRows = 3;
        const Light seen =
            seenPanorama(fall,
                         wall,
                         [](glm::dvec3) { return glm::vec3(static_cast<float>(wall::kGreyLight)); },
                         {kSteps, kRows});
        Curve curve{.name = name, .colour = cssColour(colour), .values = {}};
        double sum = 0;
        for (int x = 0; x < kSteps; ++x) {
            const glm::vec3 light = seen.at(x, kRows / 2);
            curve.values.push_back(luminance(glm::dvec3(light)));
            sum += curve.values.back() / kSteps;
        }
        for (double& value : curve.values) value /= std::max(sum, 1e-9);
        return curve;
    }

    // Brightness where the truth is known: a camera's scan has seen the wall as it was before.
    [[nodiscard]] std::string profiles(const Fall& fall,
                                       const hall::DrawnWall& before,
                                       const hall::DrawnWall& after) const {
        constexpr int kSteps = 600;
        std::vector<Curve> shares;
        for (const std::vector<double>& values : shareProfile(after, kSteps)) {
            const std::size_t i = shares.size();
            shares.push_back({rig_.channels[i].name, colourOf(i), values});
        }
        std::string text = section("Shares of light",
                                   "What each projector gives along the middle of the wall.",
                                   plot(shares, 1, 4, "shares of light"));
        if (page_.truth == nullptr) return text;
        const std::vector<Curve> brightness{greyCurve(fall, before, "before", {0.6F, 0.6F, 0.6F}),
                                            greyCurve(fall, after, "after", {0.1F, 0.55F, 0.9F})};
        return text + section("Brightness through the seams",
                              "Grey of 18 % along the middle of the wall; 1 is its mean.",
                              plot(brightness, 2, 4, "brightness along the wall"));
    }

    // Both ends of the scale are equally far from 0, and at least 1 mm.
    [[nodiscard]] std::string displacement() const {
        constexpr int kWidth = 250;
        const Field field = displacementMap(hall_, sized(kWidth));
        const double most = std::max(1.0, largestOf(field));
        return section(
            "The screen beside its shape in the rig",
            "Red bulges towards the audience, blue away from it.",
            drawing(colouredField(field, kAround, -most, most),
                    height(),
                    "",
                    "displacement of the screen") +
                scaleBar(kAround, fmt::format("{:.0f} mm", -most), fmt::format("{:.0f} mm", most)));
    }

    // Centimetres, degrees and percent; Hang has metres, radians and shares.
    [[nodiscard]] std::string projectorRow(std::size_t channel) const {
        constexpr double kCentimetres = 100;
        const Hang hang = hangOf(hall_, channel);
        const glm::dvec3 moved = kCentimetres * hang.movedMetres;
        const glm::dvec3 turned = hang.turnedRadians / kRadiansPerDegree<double>;
        return fmt::format(
            "<tr><td>{}</td><td class=\"number\">{:+.1f} / {:+.1f} / {:+.1f}</td>"
            "<td class=\"number\">{:+.2f} / {:+.2f} / {:+.2f}</td>"
            "<td class=\"number\">{:+.2f} %</td>"
            "<td class=\"number\">{:+.0f} / {:+.0f}</td>"
            "<td class=\"number\">{:+.4f}</td></tr>\n",
            escaped(rig_.channels[channel].name),
            moved.x,
            moved.y,
            moved.z,
            turned.x,
            turned.y,
            turned.z,
            100 * hang.focalShare,
            hang.shiftPixels.x,
            hang.shiftPixels.y,
            hang.k1);
    }

    [[nodiscard]] std::string projectors() const {
        std::string table =
            "<div class=\"wide\"><table><tr><th>Projector</th><th>right / up / back, cm</th>"
            "<th>yaw / pitch / roll, degrees</th><th>focal length</th>"
            "<th>lens shift right / down, px</th><th>k1</th></tr>\n";
        for (std::size_t i = 0; i < rig_.channels.size(); ++i) table += projectorRow(i);
        return section("How the projectors hang",
                       "In comparison with the rig. A projector may stay as it hangs: the wall "
                       "file is for it. Place and lens shift can stand in for one another.",
                       table + "</table></div>\n");
    }

    const CalibrationPage& page_;
    const geometry::SolvedHall& hall_;
    const config::Rig& rig_;
};

}  // namespace

std::string htmlOf(const CalibrationPage& page) {
    return Writer(page).html();
}

}  // namespace aquarama::result
