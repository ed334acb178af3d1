// SPDX-License-Identifier: Apache-2.0
#include "common/config/species_habits.h"

#include <algorithm>
#include <cmath>

namespace aquarama::config {

namespace {

constexpr Range kShare{0, 1};
constexpr Range kPerSecond{0, 1};
constexpr Range kMetres{0.01, 1000};
constexpr Range kSeconds{0, 3600};
constexpr Range kBodyLengths{0.01, 100};
constexpr Range kDepth{0, 1000};
constexpr Range kCelsius{-2, 45};

Role readRole(const TextPlace& at) {
    const std::string role = at.choice("role");
    if (role == "PREY") return Role::Prey;
    if (role == "PACIFIST") return Role::Pacifist;
    if (role != "PREDATOR")
        at.refuse("role", "role is " + role + ": write PREY, PACIFIST or PREDATOR");
    return Role::Predator;
}

void readHunger(const TextPlace& at, Habits& habits) {
    habits.appetiteParticles = static_cast<float>(at.number("appetite_particles", {0.1, 1000}));
    habits.digestionPerSecond = static_cast<float>(at.number("digestion_per_s", {1e-5, 1}));
    habits.eatsPlankton = at.truth("plankton");
}

void readFear(const TextPlace& at, Habits& habits) {
    habits.fearMetres = static_cast<float>(at.number("whole_m", kMetres));
    habits.fearFrom = static_cast<float>(at.number("heeded_from", {0.01, 1}));
    habits.fearAlone = static_cast<float>(at.number("alone_from", kShare));
    if (habits.fearAlone <= habits.fearFrom)
        at.refuse("alone_from", "alone_from must be more than heeded_from: exchange them");
}

// No fish is drawn to both.
void refuseBoth(const TextPlace& at, const std::string& one, const std::string& other) {
    if (at.numberOr(one, kShare, 0) + at.numberOr(other, kShare, 0) > 1)
        at.refuse(other, one + " and " + other + " sum to more than 1: no fish likes both");
}

HabitShares readShares(const TextPlace& at) {
    refuseBoth(at, "brightness", "darkness");
    refuseBoth(at, "warmth", "cold");
    return {.schooling = at.numberOr("schooling", kShare, 0),
            .brightness = at.numberOr("brightness", kShare, 0),
            .darkness = at.numberOr("darkness", kShare, 0),
            .warmth = at.numberOr("warmth", kShare, 0),
            .cold = at.numberOr("cold", kShare, 0),
            .female = at.numberOr("female", kShare, 0.5)};
}

Span readSpan(const TextPlace& at, const std::string& least, const std::string& most, Range range) {
    const Span span{at.number(least, range), at.number(most, range)};
    if (span.most <= span.least)
        at.refuse(most, most + " must be more than " + least + ": exchange them");
    return span;
}

void readComfort(const TextPlace& at, Habits& habits) {
    habits.depthMetres = readSpan(at, "least_depth_m", "most_depth_m", kDepth);
    habits.bestDepthMetres =
        at.number("best_depth_m", {habits.depthMetres.least, habits.depthMetres.most});
    habits.light = readSpan(at, "least_light", "most_light", kShare);
    habits.waterCelsius = readSpan(at, "coldest_c", "warmest_c", kCelsius);
}

Paces readPaces(const TextPlace& at) {
    const Paces paces{.hover = at.number("hover", kShare),
                      .slow = at.number("slow", kShare),
                      .medium = at.number("medium", kShare),
                      .fast = at.number("fast", kShare)};
    if (std::abs(paces.hover + paces.slow + paces.medium + paces.fast - 1) > 1e-6)
        at.refuse("the paces must sum to 1: they are shares of the time");
    return paces;
}

void readSenses(const TextPlace& at, Habits& habits) {
    habits.visionBodyLengths = static_cast<float>(at.number("vision_bl", kBodyLengths));
    habits.smellBodyLengths = static_cast<float>(at.number("smell_bl", kBodyLengths));
    if (habits.smellBodyLengths < habits.visionBodyLengths)
        at.refuse("smell_bl", "smell_bl is less than vision_bl: food that is seen is sensed too");
}

Home readHome(const TextPlace& at) {
    const std::string kind = at.choice("kind");
    if (kind != "SCHOOL" && kind != "PLACE")
        at.refuse("kind", "kind is " + kind + ": write SCHOOL or PLACE");
    if (kind == "SCHOOL") {
        for (const char* field : {"radius_m", "leash_m", "on_the_reef"})
            if (at.has(field))
                at.refuse(field,
                          "a home with the school has no " + std::string(field) + ": remove it");
        return {.kind = HomeKind::School};
    }
    const Home home{.kind = HomeKind::Place,
                    .radiusMetres = at.number("radius_m", kMetres),
                    .leashMetres = at.number("leash_m", kMetres),
                    .onTheReef = at.has("on_the_reef") && at.truth("on_the_reef")};
    if (home.leashMetres < home.radiusMetres)
        at.refuse("leash_m", "leash_m is less than radius_m: exchange them");
    return home;
}

// Names of other species; no name twice.
std::vector<std::string> readOthers(const TextPlace& at,
                                    const std::string& field,
                                    const std::string& own) {
    std::vector<std::string> names;
    for (int i = 0; i < at.count(field); ++i) {
        names.push_back(at.text(field, i));
        if (names.back() == own)
            at.refuse(field, field + " names the species itself: name others", i);
        if (std::count(names.begin(), names.end(), names.back()) > 1)
            at.refuse(field, "\"" + names.back() + "\" is named twice: once is enough", i);
    }
    return names;
}

void readHunt(const TextPlace& at, const std::string& own, Habits& habits) {
    habits.hunts = readOthers(at, "prey", own);
    if (habits.hunts.empty()) at.refuse("the hunt lacks prey: name the species that it eats");
    habits.hunt = {.chaseSeconds = at.number("chase_s", kSeconds),
                   .giveUpMetres = at.number("give_up_m", kMetres),
                   .restSeconds = at.number("rest_s", kSeconds)};
}

// What the role rules out is refused, so that no line of a file is without effect.
void refuseContradictions(const TextPlace& at, const Habits& habits) {
    const bool hunts = habits.role == Role::Predator;
    if (hunts && !at.has("hunt")) at.refuse("role", "a predator needs a hunt: add it");
    if (!hunts && at.has("hunt"))
        at.refuse("hunt", "only a predator hunts: remove it or change the role");
    if (hunts && at.has("fear")) at.refuse("fear", "a predator fears nobody: remove it");
    if (!hunts && !at.has("fear")) at.refuse("role", "all but predators fear: add fear");
    if (habits.role != Role::Pacifist && at.has("libido_per_s"))
        at.refuse("libido_per_s", "only a pacifist mates: remove it or change the role");
    if (hunts && at.has("pair_bl"))
        at.refuse("pair_bl", "a predator keeps no partner: remove it or change the role");
    if (habits.role != Role::Prey && habits.shares.schooling > 0)
        at.in("shares").refuse("schooling", "only prey schools: remove it or change the role");
    if (habits.home.kind == HomeKind::School && habits.shares.schooling <= 0)
        at.in("home").refuse("kind", "nobody of this species schools: its home is a PLACE or none");
    if (!habits.eatsPlankton && habits.hunts.empty())
        at.in("hunger").refuse("plankton", "it would eat nothing: let it eat plankton or hunt");
}

}  // namespace

Habits readHabits(const TextPlace& at, const std::string& species) {
    Habits habits;
    habits.role = readRole(at);
    readHunger(at.in("hunger"), habits);
    habits.libidoPerSecond = static_cast<float>(at.numberOr("libido_per_s", kPerSecond, 0));
    if (at.has("fear"))
        readFear(at.in("fear"), habits);
    else
        habits.fearMetres = 0, habits.fearFrom = 1, habits.fearAlone = 1;
    habits.shares = readShares(at.in("shares"));
    readComfort(at.in("comfort"), habits);
    habits.paces = readPaces(at.in("paces"));
    habits.gradualShare = at.number("gradual_share", kShare);
    readSenses(at.in("senses"), habits);
    const TextPlace box = at.in("box");
    habits.box = {.aheadBodyLengths = static_cast<float>(box.number("ahead_bl", kBodyLengths)),
                  .asideBodyLengths = static_cast<float>(box.number("aside_bl", kBodyLengths)),
                  .upBodyLengths = static_cast<float>(box.number("up_bl", kBodyLengths))};
    habits.persistence = static_cast<float>(at.number("persistence", kShare));
    if (at.has("home")) habits.home = readHome(at.in("home"));
    if (at.has("hunt")) readHunt(at.in("hunt"), species, habits);
    habits.pairBodyLengths = at.numberOr("pair_bl", kBodyLengths, 0);
    habits.shadows = readOthers(at, "shadows", species);
    refuseContradictions(at, habits);
    return habits;
}

}  // namespace aquarama::config
