// SPDX-License-Identifier: Apache-2.0
#include "calibration/hall/random_hall.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtx/quaternion.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "calibration/hall/chance.h"
#include "calibration/hall/true_hall.h"
#include "common/base/log.h"
#include "common/base/units.h"
#include "common/config/text_file.h"
#include "common/wall/surface.h"

namespace aquarama::hall {

namespace {

// The tangent from a lens's axis to the farthest corner of its picture.
double farthestTangent(const config::Channel& channel) {
    const config::Projector& lens = channel.projector;
    const glm::dvec2 size(channel.sizePixels);
    const glm::dvec2 far = glm::max(lens.principalPixels, size - lens.principalPixels);
    return glm::length(far / lens.focalPixels);
}

// A lens whose terms move the farthest corner by up to these shares of its distance from the axis.
config::HallLens drawLens(Chance& chance, double farthest, glm::dvec3 radial, double tangential) {
    const double square = farthest * farthest;
    config::HallLens lens;
    const glm::dvec3 k =
        chance.within(radial) / glm::dvec3(square, square * square, std::pow(square, 3));
    const double aside = tangential / farthest;
    lens.distortion = {k.x, k.y, k.z, chance.within(aside), chance.within(aside)};
    lens.vignetting = chance.between(0.1, 0.3);
    return lens;
}

// Random primaries. Rows add up to about one: white has a tint of a few percent.
glm::dmat3 primariesOf(Chance& chance) {
    glm::dmat3 primaries(0.0);
    for (int row = 0; row < 3; ++row) {
        const double white = 1 + chance.within(0.03);
        for (int column = 0; column < 3; ++column)
            if (column != row) primaries[column][row] = chance.between(0.0, 0.05);
        const double others = primaries[0][row] + primaries[1][row] + primaries[2][row];
        primaries[row][row] = white - others;
    }
    return primaries;
}

void drawLight(config::HallProjector& projector, Chance& chance) {
    projector.gamma = glm::dvec3(chance.between(2.0, 2.4)) + chance.within(glm::dvec3(0.05));
    projector.toe = chance.between(0, 0.02);
    projector.knee = chance.between(0, 0.15);
    projector.primaries = primariesOf(chance);
    projector.black = chance.between(0.0007, 0.0025);
    projector.brightness = chance.between(0.85, 1.15);
}

// The errors with which a crew hangs a projector.
struct Crookedness {
    glm::dvec3 moved{}, aim{};  // metres; of where the middle of its picture falls
    double roll = 0, focal = 0;
    glm::dvec2 shift{};  // of the picture's size
};

Crookedness drawCrookedness(Chance& chance) {
    Crookedness crooked;
    crooked.moved = chance.within(glm::dvec3(0.05));
    crooked.aim = chance.within(glm::dvec3(0.025));
    crooked.roll = chance.within(1.5 * kDegree);
    crooked.focal = chance.within(0.02);
    crooked.shift = glm::dvec2(chance.within(glm::dvec3(0.02)));
    return crooked;
}

// The planned point of the middle of a picture on the screen.
glm::dvec3 targetOf(const config::Channel& channel, const wall::ScreenSurface& screen) {
    const LensTruth lens = lensOf(channel);
    const wall::Ray ray = TrueLens(lens).ray(lens.size / 2.0);
    const auto point = screen.hit(ray, TrueScreen::kDrapeMetres);
    return point ? *point : ray.origin + ray.direction;
}

// The rotation of a lens such that the middle of its picture falls on a point.
glm::dmat3 aimed(const LensTruth& lens, glm::dvec3 point) {
    const glm::dvec3 now = glm::normalize(TrueLens(lens).ray(lens.size / 2.0).direction);
    const glm::dvec3 wanted = glm::normalize(point - lens.position);
    return glm::mat3_cast(glm::rotation(now, wanted)) * lens.wallFromLens;
}

// The projector with this share of its errors.
void hang(const config::Channel& channel,
          const Crookedness& crooked,
          double share,
          const wall::ScreenSurface& screen,
          config::HallProjector& projector) {
    projector.movedMetres = share * crooked.moved;
    projector.turnedRadians = {0, 0, share * crooked.roll};
    projector.focalFactor = 1 + share * crooked.focal;
    projector.shiftPixels = share * crooked.shift * glm::dvec2(channel.sizePixels);
    const glm::dvec3 point = targetOf(channel, screen) + share * crooked.aim;
    projector.turnedRadians =
        anglesOf(aimed(lensOf(channel, projector), point)) - channel.projector.yawPitchRollRadians;
}

bool lightsAll(const TrueHall& hall) {
    std::vector<glm::dvec3> points = hall.screenPoints(4000);
    const std::vector<glm::dvec3> edge = hall.outline();
    points.insert(points.end(), edge.begin(), edge.end());
    return std::ranges::all_of(points, [&](glm::dvec3 point) {
        for (std::size_t i = 0; i < hall.channels(); ++i)
            if (hall.pixelOf(i, point)) return true;
        return false;
    });
}

void hangAll(const config::Rig& rig, Chance& chance, config::Hall& hall) {
    const auto screen = wall::makeSurface(rig);
    std::vector<Crookedness> crooked;
    for (const config::Channel& channel : rig.channels) {
        crooked.push_back(drawCrookedness(chance));
        config::HallProjector& projector = hall.projectors[crooked.size() - 1];
        projector.lens =
            drawLens(chance, farthestTangent(channel), glm::dvec3(0.004, 0.0015, 0.0006), 0.0003);
        drawLight(projector, chance);
    }
    // Reduces the errors until all of the planned screen is lit, as a crew would.
    double share = 1;
    while (share > 0.01) {
        for (std::size_t i = 0; i < crooked.size(); ++i)
            hang(rig.channels[i], crooked[i], share, *screen, hall.projectors[i]);
        if (lightsAll(TrueHall(rig, hall))) return;
        share *= 0.8;
    }
}

void drawScreen(config::HallScreen& screen, Chance& chance) {
    screen.radiusFactor = 1 + chance.within(0.001);
    screen.sizeFactor = 1 + chance.within(0.0005);
    screen.bumpMetres = chance.between(0.015, 0.018);
    screen.bumpDistanceMetres = chance.between(1.2, 2.5);
    screen.bumpSeed = static_cast<std::uint32_t>(chance.below(1 << 20));
    const int dents = 1 + chance.below(2);
    for (int i = 0; i < dents; ++i) {
        const double u = chance.between(0.15, 0.85), v = chance.between(0.2, 0.8);
        screen.dents.push_back({{u, v}, chance.between(0.15, 0.4), chance.between(0.002, 0.006)});
    }
    screen.albedo = chance.between(0.75, 0.95);
    screen.bounces = true;
}

// A place for the camera beside and behind the viewer; a low one under a dome.
void placeCamera(const config::Rig& rig, Chance& chance, double scale, config::HallCamera& camera) {
    const bool isDome = rig.screen.shape == config::ScreenShape::Dome;
    const double side = chance.below(2) == 0 ? -1 : 1;
    const double x = side * chance.between(0.3, 0.9);
    const double y = isDome ? chance.between(-0.8, -0.3) : chance.between(-0.1, 0.5);
    camera.positionMetres = rig.sweetSpotMetres + glm::dvec3(x, y, chance.between(0.8, 1.5));
    camera.rollRadians = chance.within(2 * kDegree);
    const bool isWide = !isDome && chance.below(3) > 0;
    const glm::dvec2 full = isWide ? glm::dvec2(3840, 2160) : glm::dvec2(3264, 2448);
    camera.sizePixels = glm::round(full * scale);
    camera.principalPixels = glm::dvec2(camera.sizePixels) / 2.0;
}

// The box of some points about a camera's axis, as angles: low x, low y, high x, high y.
glm::dvec4 boxOf(const config::HallCamera& camera, const std::vector<glm::dvec3>& points) {
    const LensTruth lens = lensOf(camera);
    glm::dvec4 box(1e9, 1e9, -1e9, -1e9);
    for (const glm::dvec3& point : points) {
        const glm::dvec3 seen = (point - lens.position) * lens.wallFromLens;
        const glm::dvec2 at(std::atan2(seen.x, -seen.z), std::atan2(seen.y, -seen.z));
        box = {glm::min(glm::dvec2(box), at), glm::max(glm::dvec2(box.z, box.w), at)};
    }
    return box;
}

// The camera looks at the middle of the screen, from where its lens shows all of it.
void aimCamera(const TrueHall& hall, config::HallCamera& camera) {
    constexpr double kMargin = 1.05;
    std::vector<glm::dvec3> points = hall.outline();
    const std::vector<glm::dvec3> inside = hall.screenPoints(2000);
    points.insert(points.end(), inside.begin(), inside.end());
    glm::dvec3 sum(0);
    for (const glm::dvec3& point : inside) sum += point;
    camera.lookAtMetres = sum / double(inside.size());
    for (int i = 0; i < 12; ++i) {
        const glm::dvec4 box = boxOf(camera, points);
        const glm::dvec2 middle(std::tan((box.x + box.z) / 2), std::tan((box.y + box.w) / 2));
        camera.lookAtMetres =
            camera.positionMetres + lensOf(camera).wallFromLens * glm::dvec3(middle, -1);
    }
    const glm::dvec4 box = glm::abs(boxOf(camera, points));
    const glm::dvec2 widest = glm::tan(glm::max(glm::dvec2(box), glm::dvec2(box.z, box.w)));
    const glm::dvec2 focal = glm::dvec2(camera.sizePixels) / 2.0 / widest / kMargin;
    camera.focalPixels = std::min(focal.x, focal.y);
}

bool seesAll(const std::vector<glm::dvec3>& points, const config::HallCamera& camera) {
    const TrueLens lens(lensOf(camera));
    return std::ranges::all_of(points,
                               [&](glm::dvec3 point) { return lens.pixelOf(point).has_value(); });
}

// The lens and sensor of the camera. The lens is zoomed until it shows all of `edge`, the screen's.
void drawCamera(Chance& chance, const std::vector<glm::dvec3>& edge, config::HallCamera& camera) {
    const glm::dvec2 size(camera.sizePixels);
    camera.lens = drawLens(chance,
                           glm::length(size) / 2 / camera.focalPixels,
                           glm::dvec3(0.02, 0.006, 0.0008),
                           0.0004);
    camera.principalPixels += glm::dvec2(chance.within(glm::dvec3(0.006))) * size;
    constexpr double kStep = 0.99;
    for (int i = 0; i < 40 && !seesAll(edge, camera); ++i) camera.focalPixels *= kStep;
    camera.focalPixels *= kStep;
    camera.blurPixels = chance.between(0.4, 0.7);
    const bool isRaw = chance.below(2) == 0;
    camera.response =
        isRaw ? config::ScanCamera::Response::Linear : config::ScanCamera::Response::Srgb;
    camera.responseBend = isRaw ? 0 : chance.within(0.03);
    camera.bits = isRaw ? 12 : 8;
    camera.fullWell = chance.between(8000, 30000);
    camera.readNoise = chance.between(2e-4, 6e-4);
}

// A hall with the camera of a random hall and no other difference from the rig.
config::Hall hallOf(const config::Rig& rig, Chance& chance, double scale) {
    config::Hall hall;
    hall.projectors.resize(rig.channels.size());
    placeCamera(rig, chance, scale, hall.camera);
    return hall;
}

}  // namespace

config::Hall plainHall(const config::Rig& rig, std::uint32_t seed, double scale) {
    Chance chance(hashOf(seed, 2));
    config::Hall hall = hallOf(rig, chance, scale);
    hall.camera.focalPixels = hall.camera.sizePixels.x;
    aimCamera(TrueHall(rig, hall), hall.camera);
    return hall;
}

config::Hall randomHall(const config::Rig& rig, std::uint32_t seed, double scale) {
    Chance chance(hashOf(seed, 2));
    config::Hall hall = hallOf(rig, chance, scale);
    drawScreen(hall.screen, chance);
    hall.camera.focalPixels = hall.camera.sizePixels.x;
    hangAll(rig, chance, hall);
    aimCamera(TrueHall(rig, hall), hall.camera);
    drawCamera(chance, TrueHall(rig, hall).outline(), hall.camera);
    hall.darkLight = chance.between(0.0005, 0.003);
    hall.roomLight = chance.between(0.2, 0.5);
    constexpr double kMarkMetres = 0.001;  // how well a crew sticks its tape
    hall.screen.marksOffMetres = {chance.within(kMarkMetres), chance.within(kMarkMetres)};
    return hall;
}

double cameraScaleFor(const config::Rig& rig) {
    constexpr double kFullPanorama = 4000;
    return std::clamp(rig.panoramaPixels.x / kFullPanorama, 0.1, 1.0);
}

config::Hall hallFrom(const std::string& option, const std::string& text, const config::Rig& rig) {
    constexpr std::string_view kRandom = "random:";
    if (!text.starts_with(kRandom)) {
        std::vector<std::string> names;
        for (const config::Channel& channel : rig.channels) names.push_back(channel.name);
        return config::parseHall(config::readTextFile(text), text, names);
    }
    std::uint32_t seed = 0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + kRandom.size(), end, seed);
    if (read.ec != std::errc{} || read.ptr != end)
        throw Error(option + ": \"" + text.substr(kRandom.size()) +
                    "\" is no seed; give a whole number from 0 to 4294967295, as in random:7");
    return randomHall(rig, seed, cameraScaleFor(rig));
}

namespace {

// The data that a fault is drawn from.
struct FaultDraw {
    const config::Rig& rig;
    config::Hall& hall;
    Chance& chance;
    std::size_t pictures;

    [[nodiscard]] std::size_t channel() const {
        return static_cast<std::size_t>(chance.below(static_cast<int>(rig.channels.size())));
    }
    [[nodiscard]] std::size_t picture(double low, double high) const {
        return static_cast<std::size_t>(chance.between(low, high) * double(pictures - 1)) + 1;
    }
    [[nodiscard]] double eitherSide(double least, double most) const {
        return chance.between(least, most) * (chance.below(2) == 0 ? -1 : 1);
    }
    [[nodiscard]] glm::dvec2 place() const {
        const double u = chance.between(0.2, 0.8), v = chance.between(0.2, 0.8);
        return {u, v};
    }
};

void block(const FaultDraw& draw) {
    const glm::dvec2 place = draw.place();
    const double width = draw.chance.between(0.06, 0.25);
    draw.hall.faults.blocked = {place, {width, draw.chance.between(0.1, 0.3)}};
}

void push(const FaultDraw& draw) {
    const double yaw = draw.eitherSide(0.3, 2), pitch = draw.eitherSide(0, 1);
    draw.hall.faults.moved = {
        draw.channel(), draw.picture(0.2, 0.9), kDegree * glm::dvec2(yaw, pitch)};
}

void swapCables(const FaultDraw& draw) {
    const std::size_t one = draw.channel();
    const auto others = static_cast<int>(draw.rig.channels.size()) - 1;
    const auto step = static_cast<std::size_t>(1 + draw.chance.below(std::max(1, others)));
    draw.hall.faults.swapped = {one, (one + step) % draw.rig.channels.size()};
}

void switchOn(const FaultDraw& draw) {
    const glm::dvec2 place = draw.place();
    const double radius = draw.chance.between(0.2, 0.6), light = draw.chance.between(0.5, 3);
    draw.hall.faults.lamp = {place, radius, light, draw.picture(0, 0.9) - 1};
}

void correctKeystone(const FaultDraw& draw) {
    glm::dvec2& keystone = draw.hall.projectors[draw.channel()].keystone;
    keystone[draw.chance.below(2)] = draw.eitherSide(0.05, 0.2);
}

void sendWrongSize(const FaultDraw& draw) {
    const std::size_t channel = draw.channel();
    constexpr std::array<double, 4> kShapes{4.0 / 3, 5.0 / 4, 16.0 / 10, 16.0 / 9};
    const double width = draw.chance.between(0.5, 0.8) * draw.rig.channels[channel].sizePixels.x;
    const double shape = kShapes[static_cast<std::size_t>(draw.chance.below(4))];
    draw.hall.faults.mode = {channel, glm::round(glm::dvec2(width, width / shape))};
}

// The last one, as those beside it would leave it no part of the screen but its own.
void turnAway(const FaultDraw& draw) {
    draw.hall.projectors.back().turnedRadians.x -= draw.chance.between(20, 35) * kDegree;
}

// The picture stays about at its place.
void shiftLens(const FaultDraw& draw) {
    const std::size_t index = draw.channel();
    const config::Channel& channel = draw.rig.channels[index];
    const auto screen = wall::makeSurface(draw.rig);
    const LensTruth lens = lensOf(channel);
    const double metres = glm::length(targetOf(channel, *screen) - lens.position);
    const double pixels = 1.2 * channel.sizePixels.y;
    config::HallProjector& projector = draw.hall.projectors[index];
    projector.shiftPixels.y -= pixels;
    projector.movedMetres += pixels / lens.focal.y * metres * lens.wallFromLens[1];
}

using Inflict = void (*)(const FaultDraw& draw);
// In the order of HallFault.
constexpr std::array<Inflict, kHallFaultNames.size()> kFaults{
    block,
    push,
    swapCables,
    switchOn,
    [](const FaultDraw& draw) { draw.hall.camera.exposure = draw.chance.between(3, 10); },
    [](const FaultDraw& draw) { draw.hall.camera.exposure = draw.chance.between(0.01, 0.05); },
    [](const FaultDraw& draw) { draw.hall.faults.latePicture = draw.picture(0.05, 1); },
    [](const FaultDraw& draw) { draw.hall.faults.autoExposure = true; },
    correctKeystone,
    sendWrongSize,
    turnAway,
    [](const FaultDraw& draw) { draw.hall.faults.flatScreen = true; },
    shiftLens};

}  // namespace

config::Hall withFault(const config::Rig& rig,
                       config::Hall hall,
                       HallFault fault,
                       std::uint32_t seed,
                       std::size_t pictures) {
    Chance chance(hashOf(seed, 3));
    kFaults.at(static_cast<std::size_t>(fault))({rig, hall, chance, pictures});
    return hall;
}

}  // namespace aquarama::hall
