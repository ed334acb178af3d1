// SPDX-License-Identifier: Apache-2.0
#include "common/config/species_shape.h"

#include <cstddef>

#include "common/config/angle.h"

namespace aquarama::config {

namespace {

constexpr Range kStation{0, 1.4};  // threads trail behind the tail
constexpr float kHead = 0.05F;     // no fin stands before it
constexpr Range kHeight{-1, 1};
constexpr Range kFullness{1.4, 3.5};
constexpr Range kExtent{0.0005, 0.5};  // body lengths; thinner would fold the skin

float real(const TextPlace& at, const std::string& field, Range range) {
    return static_cast<float>(at.number(field, range));
}

std::vector<glm::vec2> readPolyline(const TextPlace& fin, const std::string& field) {
    const int count = fin.count(field);
    if (count < 2 || count > 32) fin.refuse(field, field + " needs 2 to 32 points");
    std::vector<glm::vec2> points;
    for (int i = 0; i < count; ++i) {
        const TextPlace at = fin.in(field, i);
        points.emplace_back(real(at, "s", kStation), real(at, "y", kHeight));
    }
    return points;
}

Fin readFin(const TextPlace& fins, const std::string& field) {
    const TextPlace at = fins.in(field);
    return {.base = readPolyline(at, "base"),
            .edge = readPolyline(at, "edge"),
            .angleRadians = static_cast<float>(radiansOf(at.numberOr("angle_deg", {0, 90}, 0))),
            .round = static_cast<float>(at.numberOr("round", {0, 1}, 0)),
            .flex = static_cast<float>(at.numberOr("flex", {0, 2}, 1))};
}

// A fin along the back or the belly: the skin's rings follow its base, so that must run tailwards.
Fin readMedianFin(const TextPlace& fins, const std::string& field) {
    Fin fin = readFin(fins, field);
    for (std::size_t i = 1; i < fin.base.size(); ++i)
        if (fin.base[i].x <= fin.base[i - 1].x)
            fins.in(field).refuse("base",
                                  "the base of " + field + " must run from head to tail: sort it",
                                  static_cast<int>(i));
    return fin;
}

// A fin that stands off the flank turns about its base.
Fin readPectoral(const TextPlace& fins, float tailRoot) {
    Fin fin = readFin(fins, "pectoral");
    const TextPlace at = fins.in("pectoral");
    if (fin.base.front() == fin.base.back())
        at.refuse("base", "the base of pectoral ends where it begins: spread it", 0);
    for (std::size_t i = 0; i < fin.base.size(); ++i)
        if (fin.base[i].x < kHead || fin.base[i].x >= tailRoot)
            at.refuse("base",
                      "the base of pectoral must lie behind the head and before the tail, from s: "
                      "0.05 to the last profile station: move it",
                      static_cast<int>(i));
    return fin;
}

// Along back and belly the bases of the fins come one after the other, between the head and the
// root of the tail.
void checkOrder(const TextPlace& fins, const Fins& read, float tailRoot) {
    if (read.firstDorsal.base.front().x < kHead)
        fins.refuse("first_dorsal",
                    "first_dorsal begins on the head, before s: 0.05: move it back");
    if (read.pelvic.base.front().x < 2 * kHead)
        fins.refuse("pelvic", "pelvic begins on the head, before s: 0.1: move it back");
    if (read.secondDorsal && read.secondDorsal->base.front().x <= read.firstDorsal.base.back().x)
        fins.refuse("second_dorsal", "second_dorsal begins before first_dorsal ends: move it back");
    const char* const last = read.secondDorsal ? "second_dorsal" : "first_dorsal";
    if (read.secondDorsal.value_or(read.firstDorsal).base.back().x >= tailRoot)
        fins.refuse(last, std::string(last) + " ends behind the last profile station: shorten it");
    if (read.anal.base.front().x <= read.pelvic.base.back().x)
        fins.refuse("anal", "anal begins before pelvic ends: move it back");
    if (read.anal.base.back().x >= tailRoot)
        fins.refuse("anal", "anal ends behind the last profile station: shorten it");
}

}  // namespace

BodyProfile readProfile(const TextPlace& root) {
    BodyProfile profile;
    const int count = root.count("profile");
    if (count < 4 || count > 64)
        root.refuse("the file has " + std::to_string(count) + " profile stations: give 4 to 64");
    for (int i = 0; i < count; ++i) {
        const TextPlace at = root.in("profile", i);
        const float s = real(at, "s", {0, 0.95});
        if (i == 0 ? s != 0.0F : s <= profile.stations.back())
            at.refuse("s", "profile stations must begin at s: 0 and rise: sort them");
        profile.stations.push_back(s);
        profile.dorsal.push_back(real(at, "up", kExtent));
        profile.ventral.push_back(real(at, "down", kExtent));
        profile.halfWidth.push_back(real(at, "half_width", kExtent));
        profile.fullnessUp.push_back(static_cast<float>(at.numberOr("full_up", kFullness, 2)));
        profile.fullnessDown.push_back(static_cast<float>(at.numberOr("full_down", kFullness, 2)));
    }
    return profile;
}

Fins readFins(const TextPlace& at, float tailRoot) {
    Fins fins{.firstDorsal = readMedianFin(at, "first_dorsal"),
              .secondDorsal = {},
              .anal = readMedianFin(at, "anal"),
              .caudal = readFin(at, "caudal"),
              .pelvic = readMedianFin(at, "pelvic"),
              .pectoral = readPectoral(at, tailRoot)};
    if (at.has("second_dorsal")) fins.secondDorsal = readMedianFin(at, "second_dorsal");
    checkOrder(at, fins, tailRoot);
    return fins;
}

namespace {

float optional(const TextPlace& at, const std::string& field, Range range) {
    return static_cast<float>(at.numberOr(field, range, 0));
}

float radians(const TextPlace& at, const std::string& field, Range degrees) {
    return static_cast<float>(radiansOf(at.numberOr(field, degrees, 0)));
}

Rowing readRowing(const TextPlace& at) {
    return {.beatHertz = real(at, "beat_hz", {0, 10}),
            .strokeRadians = radians(at, "stroke_deg", {0, 70}),
            .featherRadians = radians(at, "feather_deg", {0, 60}),
            .openRadians = radians(at, "open_deg", {0, 90}),
            .flapRadians = radians(at, "flap_deg", {0, 90}),
            .trimRadians = radians(at, "trim_deg", {0, 20}),
            .alternateBelow = optional(at, "alternate_below", {0, 10}),
            .foldAbove = real(at, "fold_above", {0.1, 100})};
}

Ripple readRipple(const TextPlace& fins, const std::string& field) {
    if (!fins.has(field)) return {};
    const TextPlace at = fins.in(field);
    return {.amplitude = real(at, "amplitude", {0, 0.5}),
            .waves = real(at, "waves", {0, 4}),
            .beatHertz = optional(at, "beat_hz", {0, 10}),
            .isOpposed = at.has("opposed") && at.truth("opposed")};
}

}  // namespace

FinMotion readFinMotion(const TextPlace& at) {
    FinMotion motion;
    if (at.has("rowing")) motion.rowing = readRowing(at.in("rowing"));
    motion.swimming = readRipple(at, "swimming");
    motion.hovering = readRipple(at, "hovering");
    motion.cuppingRadians = radians(at, "cupping_deg", {0, 45});
    motion.pelvicFoldRadians = radians(at, "pelvic_fold_deg", {0, 45});
    return motion;
}

std::vector<Thread> readThreads(const TextPlace& root) {
    std::vector<Thread> threads;
    for (int i = 0; i < root.count("threads"); ++i) {
        const TextPlace at = root.in("threads", i);
        threads.push_back(
            {.at = readPolyline(at, "at"),
             .rootWidth = real(at, "root_width", {0.0005, 0.05}),
             .tipWidth = real(at, "tip_width", {0, 0.05}),
             .isOfFirstDorsal = at.has("of_first_dorsal") && at.truth("of_first_dorsal")});
    }
    return threads;
}

FishEye readEye(const TextPlace& at) {
    return {.s = real(at, "s", {0, 0.5}),
            .y = real(at, "y", {-0.4, 0.4}),
            .radius = real(at, "radius", {0.001, 0.2}),
            .bulge = static_cast<float>(at.numberOr("bulge", {0, 1}, 0.35))};
}

}  // namespace aquarama::config
