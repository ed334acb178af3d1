// SPDX-License-Identifier: Apache-2.0
#include "calibration/inventory.h"

#include <cstdarg>
#include <cstdio>

#include "common/place/water.h"

namespace aquarama {

namespace {

[[gnu::format(printf, 1, 2)]] std::string said(const char* format, ...) {
    char text[512];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return text;
}

const char* nameOf(config::Role role) {
    if (role == config::Role::Prey) return "prey";
    return role == config::Role::Pacifist ? "pacifist" : "predator";
}

const char* nameOf(config::Gathering gathering) {
    if (gathering == config::Gathering::None) return "the school goes where its members go";
    return gathering == config::Gathering::Mill ? "the school mills"
                                                : "the school journeys past the eye";
}

std::string joined(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list;
}

std::string lineOf(const config::Species& species) {
    const config::Habits& habits = species.habits;
    std::string line = said("%s, %s, %.3g to %.3g m",
                            species.name.c_str(),
                            nameOf(habits.role),
                            double{species.size.leastMetres},
                            double{species.size.mostMetres});
    if (!habits.hunts.empty()) line += "; hunts " + joined(habits.hunts);
    if (!habits.shadows.empty()) line += "; shadows " + joined(habits.shadows);
    return line;
}

std::string lineOfTour(const config::Scene& scene) {
    if (!scene.tour) return "submarine: stays at the eye until somebody steers\n";
    const std::size_t stops = scene.tour->stops.size();
    return said("submarine: tours %s at %.3g m/s after %.4g s without a hand\n",
                stops > 0 ? said("%zu stops", stops).c_str() : "round the water",
                scene.tour->metresPerSecond,
                scene.idleSeconds);
}

std::string lineOf(const config::Day& day) {
    if (day.lengthSeconds <= 0) return said("light: always as at %.3g of a day\n", day.startsAt);
    return said("light: a day of %.4g s, from %.3g on, down to %.3g at midnight\n",
                day.lengthSeconds,
                day.startsAt,
                day.night);
}

}  // namespace

std::string inventoryOf(const config::Scene& scene, const std::string& path) {
    const std::vector<config::CastSpecies> cast = config::readCastSpecies(scene, path);
    const std::size_t fish = config::fishIn(scene);
    const auto length = cast.front().species.size.meanMetres;
    place::checkRoom(scene, path, fish, length);

    std::string text = said("scene \"%s\": %s; %s\n",
                            scene.name.c_str(),
                            scene.place == config::PlaceKind::Reef ? "a reef" : "the open sea",
                            nameOf(scene.gathering));
    for (std::size_t i = 0; i < cast.size(); ++i)
        text += said("%7u ", scene.cast[i].fish) + lineOf(cast[i].species) +
                (scene.cast[i].start ? "; with a start" : "") + "\n";
    const place::Region water = place::waterFor(scene, fish, length);
    const glm::dvec3 size = glm::dvec3(water.halfExtent) * 2.0;
    const auto top = static_cast<double>(-water.centre.y) - size.y / 2;
    text += said("water: %.3g x %.3g x %.3g m, %.3g to %.3g m deep, for up to %u fish\n",
                 size.x,
                 size.y,
                 size.z,
                 top,
                 top + size.y,
                 place::mostFishIn(scene, length));
    text += said("food: %u plankton, %zu drops\n", scene.plankton, scene.drops.size());
    return text + lineOfTour(scene) + lineOf(scene.day) + path + ": good\n";
}

std::string inventoryOf(const config::Species& species, const std::string& path) {
    return "species " + lineOf(species) + "\n" + path + ": good\n";
}

}  // namespace aquarama
