// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/controllers_figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "master/capture/control/body_angles.h"
#include "master/capture/report/controller_trial.h"
#include "master/capture/report/plot.h"
#include "master/capture/report/silhouette.h"

namespace aquarama::report {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRunUpBeats = 20;
constexpr double kRoll = 40 * kDegree;  // from which balance rights the fish
constexpr double kPitch = 20 * kDegree;

// On the paper.
constexpr double kBodyLength = 84;
constexpr double kSection = 130;  // a body length where the fish is seen from behind
constexpr glm::dvec2 kPanel{370, 190};
constexpr glm::dvec2 kPitchOfPanels{446, 284};
constexpr glm::dvec2 kFirstPanel{62, 96};
constexpr const char* kPath = R"(fill="none" stroke="#2f77b4" stroke-width="1.6")";
constexpr const char* kFin = R"(stroke="#bf4a24" stroke-width="2.4" stroke-linecap="round")";

std::string spoken(std::string name) {
    std::ranges::replace(name, '_', ' ');
    return name;
}

class Sheet {
  public:
    explicit Sheet(const config::Species& species)
        : species_(species), body_(body::makeBody(species)) {
        svg_.text({kFirstPanel.x, 36},
                  "Nine motor controllers: the biomechanical " + spoken(species.name) +
                      ", in its stride at medium speed, then so ordered",
                  letters(18));
        svg_.text(
            {kFirstPanel.x, 56},
            "Dark is late; pectoral fins in red; lengths in body lengths (BL). Balance begins "
            "rolled by 40°, retreat at rest.",
            letters(13, "start", kQuietInk));
    }
    [[nodiscard]] std::string finish() && { return std::move(svg_).finish(); }

    // Straight ways: where the fish is, up the paper as time goes.
    void drawStraight(const std::string& title,
                      const ControllerTrial& trial,
                      double leastX,
                      int fish) {
        const double seconds = trial.moments.back().seconds;
        const double margin = 0.16 * seconds;
        const Plot plot = nextPlot(title + ", from above: " + speeds(trial),
                                   along(leastX),
                                   {.least = -margin,
                                    .most = seconds + margin,
                                    .tick = seconds > 2 ? 1 : 0.5,
                                    .digits = 1,
                                    .label = "time, s"});
        std::vector<glm::dvec2> path;
        for (const Moment& moment : trial.moments)
            path.push_back(plot.at(middleOf(moment.nodes).x, moment.seconds));
        drawFish(trial, fish, ViewSide::Above, [&](const Moment& moment, glm::dvec2 point) {
            return plot.at(point.x, moment.seconds) - glm::dvec2(0, point.y * kBodyLength);
        });
        svg_.polyline(path, kPath);
    }

    // The way itself.
    void drawMap(const std::string& title,
                 const ControllerTrial& trial,
                 ViewSide view,
                 double leastY,
                 int fish,
                 const std::string& caption) {
        const std::string seenFrom =
            view == ViewSide::Above ? ", from above: " : ", from the side: ";
        const Plot plot =
            nextPlot(title + seenFrom + caption,
                     along(-1),
                     {.least = leastY,
                      .most = leastY + kPanel.y / kBodyLength,
                      .tick = 0.5,
                      .digits = 1,
                      .label = view == ViewSide::Above ? "to the left, BL" : "up, BL"});
        std::vector<glm::dvec2> path;
        for (const Moment& moment : trial.moments) {
            const glm::dvec2 point = seen(view, middleOf(moment.nodes));
            path.push_back(plot.at(point.x, point.y));
        }
        drawFish(trial, fish, view, [&](const Moment&, glm::dvec2 point) {
            return plot.at(point.x, point.y);
        });
        svg_.polyline(path, kPath);
    }

    // Roll over time, with the fish from behind.
    void drawRoll(const std::string& title, const ControllerTrial& trial) {
        const auto rollOf = [](const Moment& moment) {
            return capture::bodyAnglesOf({.positions = moment.nodes, .velocities = {}}).rollRadians;
        };
        const auto level = std::ranges::find_if(trial.moments, [&](const Moment& moment) {
            return std::abs(rollOf(moment)) < 5 * kDegree;
        });
        const Plot plot = nextPlot(
            title + ", from behind: upright within 5° after " + fixed(level->seconds, 1) + " s",
            {.least = -0.3,
             .most = trial.moments.back().seconds + 0.3,
             .tick = 0.5,
             .digits = 1,
             .label = "time, s"},
            {.least = -25, .most = 75, .tick = 20, .digits = 0, .label = "roll, degrees"});
        std::vector<glm::dvec2> curve;
        for (const Moment& moment : trial.moments)
            curve.push_back(plot.at(moment.seconds, rollOf(moment) / kDegree));
        svg_.polyline(curve, kPath);
        constexpr int kFish = 6;
        for (int i = 0; i < kFish; ++i) {
            const Moment& moment = momentAt(trial, i, kFish);
            const double roll = rollOf(moment);
            drawFromBehind(plot.at(moment.seconds, roll / kDegree), roll, shade(i, kFish));
        }
    }

  private:
    static Axis along(double least) {
        return {.least = least,
                .most = least + kPanel.x / kBodyLength,
                .tick = 1,
                .digits = 0,
                .label = "ahead, BL"};
    }

    static std::string speeds(const ControllerTrial& trial) {
        return fixed(trial.speedBefore, 2) + " → " + fixed(trial.speedAfter, 2) + " BL/s";
    }

    static const Moment& momentAt(const ControllerTrial& trial, int i, int count) {
        return trial.moments.at(static_cast<std::size_t>(i * kMoments / (count - 1)));
    }

    static SvgStyle shade(int i, int count) {
        const double dark = 0.25 + 0.75 * i / (count - 1);
        return "fill=\"#5b7280\" opacity=\"" + fixed(dark, 2) + "\"";
    }

    Plot nextPlot(const std::string& title, const Axis& x, const Axis& y) {
        const glm::dvec2 corner =
            kFirstPanel + kPitchOfPanels * glm::dvec2(panels_ % 3, panels_ / 3);
        ++panels_;
        const Plot plot(corner, kPanel, x, y);
        plot.drawAxes(svg_);
        svg_.text(corner - glm::dvec2(0, 9), title, letters(13));
        return plot;
    }

    template <class Place>
    void drawFish(const ControllerTrial& trial, int count, ViewSide view, Place place) {
        for (int i = 0; i < count; ++i) {
            const Moment& moment = momentAt(trial, i, count);
            const auto onPaper = [&](const Polygon& polygon) {
                std::vector<glm::dvec2> points;
                for (const glm::dvec2& point : polygon) points.push_back(place(moment, point));
                return points;
            };
            for (const Polygon& part : silhouetteOf(body_, moment.nodes, view))
                svg_.polygon(onPaper(part), shade(i, count));
            for (const Polygon& fin : finLines(moment.fins, moment.nodes, view))
                svg_.polyline(onPaper(fin), kFin);
        }
    }

    // A section of the body and the fin on its back.
    void drawFromBehind(glm::dvec2 at, double roll, const SvgStyle& style) {
        const auto turned = [&](double z, double y) {
            return at + kSection * glm::dvec2(std::cos(roll) * z - std::sin(roll) * y,
                                              -std::sin(roll) * z - std::cos(roll) * y);
        };
        std::vector<glm::dvec2> section;
        for (int i = 0; i < 40; ++i) {
            const double angle = i * std::numbers::pi / 20;
            section.push_back(turned(0.07 * std::cos(angle), 0.12 * std::sin(angle)));
        }
        svg_.polygon(section, style);
        svg_.line(turned(0, 0.12), turned(0, 0.2), stroke(kInk, 1.6));
        svg_.line(turned(-0.05, -0.03), turned(-0.17, -0.06), kFin);
        svg_.line(turned(0.05, -0.03), turned(0.17, -0.06), kFin);
    }

    const config::Species& species_;
    body::FishBody body_;
    Svg svg_{kFirstPanel.x + 3 * kPitchOfPanels.x - 40, kFirstPanel.y + 3 * kPitchOfPanels.y - 40};
    int panels_ = 0;
};

std::string degrees(double radians) {
    return fixed(radians / kDegree, 0) + "°";
}

std::string turnCaption(const ControllerTrial& trial) {
    const auto heading = [](const Moment& moment) {
        return capture::bodyAnglesOf({.positions = moment.nodes, .velocities = {}}).headingRadians;
    };
    return "turns by " + degrees(heading(trial.moments.back()) - heading(trial.moments.front()));
}

std::string climbCaption(const ControllerTrial& trial) {
    double pitch = 0;
    constexpr int kLast = kMoments / 4;
    for (int i = 0; i < kLast; ++i)
        pitch += capture::bodyAnglesOf(
                     {.positions = trial.moments.at(static_cast<std::size_t>(kMoments - i)).nodes,
                      .velocities = {}})
                     .pitchRadians /
                 kLast;
    return "pitch " + degrees(pitch);
}

}  // namespace

std::string drawControllers(const config::Species& species) {
    const config::Gait& medium = species.swim.medium;
    const auto order = [&](capture::Controller controller) {
        return capture::Order{.controller = controller,
                              .gait = medium,
                              .bend = species.turn.sharp,
                              .pitchRadians = kPitch};
    };
    const auto after =
        [&](capture::Controller controller, double seconds, double beats = kRunUpBeats) {
            return swimmingThen(species, order(controller), seconds, beats);
        };
    Sheet sheet(species);
    sheet.drawStraight("Forward swim", after(capture::Controller::ForwardSwim, 1.5), -1, 4);
    const ControllerTrial left = after(capture::Controller::LeftTurn, 1);
    sheet.drawMap("Left turn", left, ViewSide::Above, -0.7, 5, turnCaption(left));
    // From the other half of the beat, so that it is the left one's mirror image.
    const ControllerTrial right = after(capture::Controller::RightTurn, 1, kRunUpBeats + 0.5);
    sheet.drawMap("Right turn", right, ViewSide::Above, -1.55, 5, turnCaption(right));
    sheet.drawStraight("Glide", after(capture::Controller::Glide, 1.5), -1, 4);
    const ControllerTrial up = after(capture::Controller::Ascend, 1.5);
    sheet.drawMap("Ascend", up, ViewSide::Side, -0.7, 4, climbCaption(up));
    const ControllerTrial down = after(capture::Controller::Descend, 1.5);
    sheet.drawMap("Descend", down, ViewSide::Side, -1.55, 4, climbCaption(down));
    sheet.drawRoll("Balance", rolledThen(species, kRoll, order(capture::Controller::Balance), 2.5));
    sheet.drawStraight("Brake", after(capture::Controller::Brake, 1.5), -1, 4);
    sheet.drawStraight(
        "Retreat", restingThen(species, order(capture::Controller::Retreat), 3.25), -3, 4);
    return std::move(sheet).finish();
}

}  // namespace aquarama::report
