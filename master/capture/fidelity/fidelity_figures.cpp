// SPDX-License-Identifier: Apache-2.0
#include "master/capture/fidelity/fidelity_figures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/units/ids.h"
#include "master/capture/fidelity/paint.h"
#include "master/capture/report/fish_view.h"
#include "master/capture/report/svg.h"

namespace aquarama::fidelity {

namespace {

constexpr double kWidth = 1080;

struct Kind {
    const char* name;
    const char* colour;
};
constexpr std::array kKinds{Kind{"slow", "#9fc9e8"},
                            Kind{"medium", "#5b9fd0"},
                            Kind{"fast", "#1f6aa5"},
                            Kind{"gradual turn", "#f2b35c"},
                            Kind{"sharp turn", "#e0702c"},
                            Kind{"glide", "#9bbf7a"},
                            Kind{"up, down, level", "#b59ad6"},
                            Kind{"brake, retreat", "#8a969e"}};

const Kind& kindOf(Manoeuvre manoeuvre) {
    switch (manoeuvre) {
        case Manoeuvre::ForwardSlow:
            return kKinds[0];
        case Manoeuvre::ForwardMedium:
            return kKinds[1];
        case Manoeuvre::ForwardFast:
            return kKinds[2];
        case Manoeuvre::TurnLeftGradual:
        case Manoeuvre::TurnRightGradual:
            return kKinds[3];
        case Manoeuvre::TurnLeftSharp:
        case Manoeuvre::TurnRightSharp:
            return kKinds[4];
        case Manoeuvre::Glide:
            return kKinds[5];
        case Manoeuvre::Ascend:
        case Manoeuvre::Descend:
        case Manoeuvre::Balance:
            return kKinds[6];
        case Manoeuvre::Brake:
        case Manoeuvre::Retreat:
            break;
    }
    return kKinds[7];
}

void drawKey(report::Svg& svg, glm::dvec2 at) {
    for (const Kind& kind : kKinds) {
        svg.line(at, at + glm::dvec2(22, 0), stroke(kind.colour, 6));
        svg.text(at + glm::dvec2(28, 4), kind.name, letters(12));
        at.x += 50 + 6.6 * static_cast<double>(std::string(kind.name).size());
    }
}

// Ways from above on a piece of the paper, lying so that the longer side is across.
class Map {
  public:
    Map(const Fidelity& fidelity, glm::dvec2 corner, glm::dvec2 size) : corner_(corner) {
        glm::dvec2 least(1e9);
        glm::dvec2 most(-1e9);
        const auto add = [&](const glm::dvec3& place) {
            least = glm::min(least, report::fromAbove(place));
            most = glm::max(most, report::fromAbove(place));
        };
        for (const TracePoint& point : fidelity.traces.fish) add(point.frame.origin);
        for (const glm::dvec3& place : fidelity.comparison.openLoop.replicaWay) add(place);
        isTurned_ = (most - least).y > (most - least).x;
        const glm::dvec2 extent =
            isTurned_ ? glm::dvec2(most.y - least.y, most.x - least.x) : most - least;
        scale_ = std::min(size.x / extent.x, size.y / extent.y);
        least_ = isTurned_ ? glm::dvec2(least.y, -most.x) : least;
        height_ = extent.y * scale_;
    }
    void lowerBy(double paper) { corner_.y += paper; }
    [[nodiscard]] glm::dvec2 operator()(const glm::dvec3& place) const {
        const glm::dvec2 seen = report::fromAbove(place);
        return corner_ + ((isTurned_ ? glm::dvec2(seen.y, -seen.x) : seen) - least_) * scale_;
    }
    [[nodiscard]] std::vector<glm::dvec2> operator()(std::span<const glm::dvec3> places) const {
        std::vector<glm::dvec2> points;
        for (const glm::dvec3& place : places) points.push_back((*this)(place));
        return points;
    }
    [[nodiscard]] double scale() const { return scale_; }
    [[nodiscard]] double height() const { return height_; }

  private:
    glm::dvec2 corner_;
    glm::dvec2 least_{};
    double scale_ = 1;
    double height_ = 0;
    bool isTurned_ = false;
};

std::vector<glm::dvec3> wayOf(const Trace& trace, std::size_t from, std::size_t to) {
    std::vector<glm::dvec3> way;
    for (std::size_t tick = from; tick <= to; ++tick) way.push_back(trace[tick].frame.origin);
    return way;
}

// Every so many points and the last: what the eye can tell apart.
std::vector<glm::dvec3> thinned(const std::vector<glm::dvec3>& way, std::size_t every) {
    std::vector<glm::dvec3> few;
    for (std::size_t i = 0; i + 1 < way.size(); i += every) few.push_back(way[i]);
    few.push_back(way.back());
    return few;
}

void drawWays(
    report::Svg& svg, const Map& map, const Fidelity& fidelity, double width, std::size_t every) {
    for (const CommandErrors& errors : fidelity.comparison.commands) {
        const auto first = static_cast<std::size_t>(errors.firstTick);
        const auto last = first + static_cast<std::size_t>(errors.command.ticks);
        svg.polyline(map(thinned(wayOf(fidelity.traces.fish, first, last), every)),
                     stroke(kindOf(errors.command.manoeuvre).colour, width));
    }
    svg.polyline(map(thinned(fidelity.comparison.openLoop.replicaWay, every)),
                 stroke("#7b3f00", width / 6, "stroke-dasharray=\"6 4\""));
    for (const CommandErrors& errors : fidelity.comparison.commands) {
        const std::vector<glm::dvec2> way = map(thinned(errors.replicaWay, every));
        svg.polyline(way, stroke("#10202b", width / 6));
        svg.circle(way.front(), width / 5, "fill=\"#10202b\"");
    }
}

void drawScale(report::Svg& svg, glm::dvec2 at, double scale) {
    constexpr int kLengths = 10;
    svg.line(at, at + glm::dvec2(kLengths * scale, 0), stroke(kInk, 2));
    svg.text(
        at + glm::dvec2(kLengths * scale + 8, 4), std::to_string(kLengths) + " BL", letters(12));
}

}  // namespace

std::string drawWays(const Fidelity& fidelity) {
    constexpr double kMargin = 24;
    constexpr double kTop = 40;
    constexpr double kMostHeight = 560;
    const Map map(fidelity, {kMargin, kTop}, {kWidth - 2 * kMargin, kMostHeight});
    const double height = kTop + map.height() + 56;
    report::Svg svg(kWidth, height);
    drawKey(svg, {kMargin, 18});
    drawWays(svg, map, fidelity, 7, 2);
    const double foot = height - 18;
    drawScale(svg, {kMargin, foot}, map.scale());
    svg.line({420, foot}, {450, foot}, stroke("#10202b", 1.2));
    svg.text({458, foot + 4}, "replica, laid over at each command", letters(12));
    svg.line({700, foot}, {730, foot}, stroke("#7b3f00", 1.2, "stroke-dasharray=\"6 4\""));
    svg.text({738, foot + 4}, "replica, laid over at the beginning only", letters(12));
    return std::move(svg).finish();
}

std::string drawWaysOfAll(std::span<const Fidelity> species) {
    constexpr std::size_t kColumns = 4;
    constexpr double kMargin = 16;
    constexpr double kTop = 40;
    constexpr glm::dvec2 kPanel{(kWidth - 5 * kMargin) / kColumns, 200};
    const std::size_t rows = (species.size() + kColumns - 1) / kColumns;
    report::Svg svg(kWidth, kTop + static_cast<double>(rows) * (kPanel.y + kMargin));
    drawKey(svg, {kMargin, 18});
    for (std::size_t i = 0; i < species.size(); ++i) {
        const glm::dvec2 corner =
            glm::dvec2(kMargin, kTop) +
            glm::dvec2(static_cast<double>(i % kColumns), static_cast<double>(i / kColumns)) *
                (kPanel + kMargin);
        svg.rectangle(corner, kPanel, R"(fill="none" stroke="#c9d3d9" stroke-width="1")");
        svg.text(corner + glm::dvec2(8, 18), species[i].species, letters(13));
        const glm::dvec2 room = kPanel - glm::dvec2(28, 66);
        Map map(species[i], corner + glm::dvec2(14, 30), room);
        map.lowerBy((room.y - map.height()) / 2);
        drawWays(svg, map, species[i], 3.6, 8);
        drawScale(svg, corner + glm::dvec2(12, kPanel.y - 14), map.scale());
    }
    return std::move(svg).finish();
}

namespace {

// Of one quantity over the script's seconds.
class Strip {
  public:
    Strip(report::Svg& svg, double top, double height, double seconds)
        : svg_(svg), top_(top), height_(height), perSecond_((kRight - kLeft) / seconds) {}

    [[nodiscard]] glm::dvec2 at(double seconds, double share) const {
        return {kLeft + seconds * perSecond_, top_ + (1 - share) * height_};
    }
    void grid(double share, const std::string& says, const report::SvgStyle& style = kGrid) {
        svg_.line({kLeft, at(0, share).y}, {kRight, at(0, share).y}, style);
        svg_.text(at(0, share) + glm::dvec2(-8, 4), says, letters(12, "end"));
    }
    // share(i) of the height at tick i + 1.
    template <class Share>
    void plot(std::size_t ticks, Share share, const report::SvgStyle& style) {
        std::vector<glm::dvec2> points;
        for (std::size_t i = 0; i < ticks; ++i)
            points.push_back(
                at(static_cast<double>(i + 1) / kTicksPerSecond, std::clamp(share(i), 0.0, 1.0)));
        svg_.polyline(points, style);
    }
    void title(const std::string& words) { svg_.text({kLeft, top_ - 8}, words, letters(12)); }

    static constexpr double kLeft = 64;
    static constexpr double kRight = kWidth - 12;

  private:
    report::Svg& svg_;
    double top_, height_, perSecond_;
};

void drawCommands(
    report::Svg& svg, const Fidelity& fidelity, const Strip& strip, double top, double height) {
    const int start = fidelity.script.front().ticks;
    for (const CommandErrors& errors : fidelity.comparison.commands) {
        const double from = (errors.firstTick - start) / kTicksPerSecond;
        const double to = from + errors.command.ticks / kTicksPerSecond;
        const glm::dvec2 corner(strip.at(from, 0).x, top);
        svg.rectangle(corner,
                      {strip.at(to, 0).x - corner.x, height},
                      std::string("fill=\"") + kindOf(errors.command.manoeuvre).colour + "\"");
    }
}

// The way of a beat, body lengths a second.
double speedAt(const Trace& trace, std::size_t tick, double beatTicks) {
    const auto beat = std::min(static_cast<std::size_t>(std::lround(beatTicks)), tick);
    return glm::distance(trace[tick].frame.origin, trace[tick - beat].frame.origin) *
           kTicksPerSecond / static_cast<double>(beat);
}

}  // namespace

std::string drawTimes(const Fidelity& fidelity) {
    const Comparison& comparison = fidelity.comparison;
    const std::size_t ticks = comparison.shapeAsPlayed.size();
    const double seconds = static_cast<double>(ticks) / kTicksPerSecond;
    report::Svg svg(kWidth, 470);

    Strip shape(svg, 26, 190, seconds);
    shape.title("error of the shape, root mean square over 23 nodal points, % of a body length");
    const auto onScale = [](double error) {  // from 0.01 % to 10 %
        return (std::log10(std::max(error, 1e-6)) + 4) / 3;
    };
    for (const auto& [error, says] :
         {std::pair{1e-4, "0.01"}, {1e-3, "0.1"}, {1e-2, "1"}, {1e-1, "10"}})
        shape.grid(onScale(error), says);
    shape.grid(onScale(0.01), "", R"(stroke="#c0392b" stroke-width="1" stroke-dasharray="5 4")");
    shape.plot(
        ticks,
        [&](std::size_t i) { return onScale(comparison.shapeAsPlayed[i]); },
        stroke("#b9c6cd", 1));
    shape.plot(
        ticks,
        [&](std::size_t i) { return onScale(comparison.shapeInPhase[i]); },
        stroke(kInk, 1.2));
    drawCommands(svg, fidelity, shape, 222, 10);

    const auto start = static_cast<std::size_t>(fidelity.script.front().ticks);
    const double beat = fidelity.script.front().beatTicks;
    const auto speeds = [&](const Trace& trace, std::size_t i) {
        return speedAt(trace, start + i + 1, beat);
    };
    double fastest = 0;
    for (std::size_t i = 0; i < ticks; ++i)
        fastest = std::max(
            {fastest, speeds(fidelity.traces.fish, i), speeds(fidelity.traces.replica, i)});
    const double top = std::ceil(fastest * 2) / 2;
    Strip speed(svg, 272, 150, seconds);
    speed.title("speed over the last beat of medium swimming, BL/s: fish (wide) and replica");
    for (const double share : {0.0, 0.5, 1.0}) speed.grid(share, report::fixed(share * top, 2));
    speed.plot(
        ticks,
        [&](std::size_t i) { return speeds(fidelity.traces.fish, i) / top; },
        stroke("#8fbfe0", 4));
    speed.plot(
        ticks,
        [&](std::size_t i) { return speeds(fidelity.traces.replica, i) / top; },
        stroke(kInk, 1.2));
    for (int second = 0; second <= static_cast<int>(seconds); second += 10)
        svg.text(speed.at(second, 0) + glm::dvec2(0, 18),
                 std::to_string(second) + " s",
                 letters(12, "middle"));
    svg.line({Strip::kLeft, 456}, {Strip::kLeft + 24, 456}, stroke(kInk, 1.2));
    svg.text({Strip::kLeft + 32, 460}, "in the fish's phase", letters(12));
    svg.line({260, 456}, {284, 456}, stroke("#b9c6cd", 1.2));
    svg.text({292, 460}, "as played", letters(12));
    svg.line({400, 456}, {424, 456}, R"(stroke="#c0392b" stroke-width="1" stroke-dasharray="5 4")");
    svg.text({432, 460}, "1 %, the goal within a segment", letters(12));
    return std::move(svg).finish();
}

}  // namespace aquarama::fidelity
