// SPDX-License-Identifier: Apache-2.0
#include "master/fish/minds.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "common/base/digest.h"
#include "common/base/units.h"
#include "common/place/day.h"
#include "master/fish/secondary_controller.h"

namespace aquarama::fish {

const char* nameOf(Intention intention) {
    constexpr std::array<const char*, kIntentions> kNames{"wander",
                                                          "hover",
                                                          "graze",
                                                          "clean",
                                                          "visit",
                                                          "leave",
                                                          "school",
                                                          "eat",
                                                          "mate",
                                                          "charge",
                                                          "rest",
                                                          "hide",
                                                          "escape",
                                                          "avoid fish",
                                                          "avoid obstacle"};
    return kNames[static_cast<std::size_t>(intention)];
}

// Folds in member by member: padding bytes between members are undefined and may differ.
std::uint64_t Minds::hash() const {
    std::uint64_t hash = 1;
    const auto fold = [&](auto member) { hash = folded(hash, minds_, member); };
    fold(&Mind::intention);
    fold(&Mind::target);
    fold(&Mind::pursued);
    fold(&Mind::remembered);
    fold(&Mind::rememberedTarget);
    fold(&Mind::sinceRemembered);
    fold(&Mind::sinceMeal);
    fold(&Mind::sinceSpawning);
    fold(&Mind::sinceChase);
    fold(&Mind::sinceArrival);
    fold(&Mind::sinceCharge);
    fold(&Mind::sinceCleaning);
    fold(&Mind::alarm);
    fold(&Mind::spot);
    fold(&Mind::eaten);
    fold(&Mind::likes);
    fold(&Mind::stage);
    fold(&Mind::bites);
    fold(&Mind::charged);
    fold(&Mind::sinceStage);
    fold(&Mind::thoughtAt);
    return hash;
}

std::size_t Minds::bytes() const {
    return bytesIn(minds_);
}

namespace {

constexpr float kTicksASecond = static_cast<float>(kTicksPerSecond);

float seconds(std::uint32_t ticks) {
    return static_cast<float>(ticks) / kTicksASecond;
}

// What hunger leaves of the libido. A hunter is hungry nearly always: that takes half at most.
float leftBy(const SpeciesParameters& parameters, float hunger) {
    return 1 - (parameters.habits.role == config::Role::Predator ? 0.5F : 1.0F) * hunger;
}

// Limited to half of kLongAgo, so that the clock can still advance.
std::uint32_t ticksOf(float seconds) {
    return static_cast<std::uint32_t>(
        std::min(seconds * kTicksASecond, static_cast<float>(kLongAgo) / 2));
}

// R of the thesis: 1 right after a meal, falling linearly to 0 when it is digested.
float undigested(const SpeciesParameters& parameters, const Mind& mind) {
    return std::max(0.0F,
                    1 - parameters.habits.hunger.digestionPerSecond * seconds(mind.sinceMeal));
}

// Whether the fish shows that it is willing: it courts already, or its inner libido is high.
bool wouldMate(const SpeciesParameters& parameters, const Mind& mind, Intention aim) {
    return aim == Intention::Mate ||
           innerLibido(parameters, mind, innerHunger(parameters, mind)) > kDesire;
}

// The signs that every species has. Prey that does not mate now has no others.
unsigned moodOf(std::uint8_t likes, Intention aim) {
    return ((likes & kIsFemale) != 0 ? unsigned{kFemale} : 0U) |
           (aim == Intention::School ? unsigned{kSchooling} : 0U);
}

// Whether the target of an intention is the fish that FishView::partner shows.
bool hasPartner(Intention intention) {
    return intention == Intention::Mate || intention == Intention::Clean ||
           intention == Intention::Visit;
}

// A dive is seen for so long.
constexpr std::uint32_t kDiveTicks = 20;

unsigned divingOf(const Mind& mind) {
    const bool dives = mind.intention == Intention::Hide && mind.sinceStage < kDiveTicks;
    return dives ? unsigned{kDiving} | unsigned{kAlarmed} : 0U;
}

}  // namespace

float innerHunger(const SpeciesParameters& parameters, const Mind& mind) {
    assert(parameters.habits.hunger.appetiteParticles > 0);
    const float stomach = static_cast<float>(mind.eaten) * undigested(parameters, mind);
    return std::clamp(1 - stomach / parameters.habits.hunger.appetiteParticles, 0.0F, 1.0F);
}

bool isGorged(const SpeciesParameters& parameters, const Mind& mind) {
    return static_cast<float>(mind.eaten) > 2 * parameters.habits.hunger.appetiteParticles;
}

float innerLibido(const SpeciesParameters& parameters, const Mind& mind, float hunger) {
    if (!mates(parameters)) return 0;
    return std::min(1.0F, parameters.habits.libidoPerSecond * seconds(mind.sinceSpawning)) *
           leftBy(parameters, hunger);
}

bool mates(const SpeciesParameters& parameters) {
    return parameters.habits.libidoPerSecond > 0;
}

bool matesAt(const SpeciesParameters& parameters, double timeOfDay) {
    if (!mates(parameters) || !parameters.habits.spawnsInRush) return mates(parameters);
    const place::DayPhase phase = place::phaseOf(timeOfDay);
    return phase == place::DayPhase::Sunset || phase == place::DayPhase::Dusk;
}

void passTime(const SpeciesParameters& parameters, std::uint32_t ticks, Mind& mind) {
    for (std::uint32_t* clock : {&mind.pursued,
                                 &mind.sinceRemembered,
                                 &mind.sinceMeal,
                                 &mind.sinceSpawning,
                                 &mind.sinceChase,
                                 &mind.sinceArrival,
                                 &mind.sinceCharge,
                                 &mind.sinceCleaning,
                                 &mind.sinceStage})
        if (*clock < kLongAgo) *clock += ticks;
    if (mind.charged > 0 && mind.charged <= kChargedOnce) --mind.charged;
    if (undigested(parameters, mind) <= 0) mind.eaten = 0;
}

void setMood(const SpeciesParameters& parameters, float hunger, float libido, Mind& mind) {
    assert(hunger >= 0);
    assert(hunger <= 1);
    assert(libido >= 0);
    assert(libido <= 1);
    // A meal of whole particles, digested so far that n_e R / alpha = 1 - hunger.
    const float meal = std::max(1.0F, std::ceil(parameters.habits.hunger.appetiteParticles));
    const float left =
        std::clamp((1 - hunger) * parameters.habits.hunger.appetiteParticles / meal, 0.0F, 1.0F);
    mind.eaten = static_cast<std::uint16_t>(meal);
    mind.sinceMeal = ticksOf((1 - left) / parameters.habits.hunger.digestionPerSecond);
    // Inverts innerLibido() for the time since spawning.
    const float growth = parameters.habits.libidoPerSecond * leftBy(parameters, hunger);
    mind.sinceSpawning = growth > 0 ? ticksOf(libido / growth) : 0;
}

void showMood(const SpeciesParameters& parameters,
              const Minds& minds,
              std::uint32_t fish,
              bool mates,
              FishView& view) {
    assert(fish < minds.size());
    assert(minds.size() <= view.size());
    const unsigned away = view.signs[fish] & unsigned{kAway};
    const Mind& mind = minds[fish];
    if (parameters.habits.graze || parameters.habits.territory) {
        const Aim about = aimOf(mind);
        view.patch[fish] = about.intention == Intention::Graze ? about.target : kNobody;
        view.charged[fish] = about.intention == Intention::Charge ? about.target : kNobody;
    }
    const bool isPrey = parameters.habits.role == config::Role::Prey;
    if (isPrey && !mates) {  // most fish; they need but three bytes of their mind
        const bool schools =
            mind.intention == Intention::School || mind.remembered == Intention::School;
        view.signs[fish] = static_cast<std::uint8_t>(
            away | moodOf(mind.likes, schools ? Intention::School : mind.intention) |
            (mind.alarm == Alarm::Calm ? 0U : unsigned{kAlarmed}) | divingOf(mind));
        view.partner[fish] = kNobody;
        return;
    }
    const Aim aim = aimOf(mind);
    unsigned signs = away | moodOf(mind.likes, aim.intention) | divingOf(mind);
    if (mind.alarm != Alarm::Calm) signs |= kAlarmed;
    if (mates && wouldMate(parameters, mind, aim.intention)) signs |= kWilling;
    if (parameters.habits.role == config::Role::Predator && aim.intention == Intention::Eat)
        signs |= kHunting;
    view.signs[fish] = static_cast<std::uint8_t>(signs);
    view.stage[fish] = mind.stage;
    view.partner[fish] = hasPartner(aim.intention) ? aim.target : kNobody;
}

}  // namespace aquarama::fish
