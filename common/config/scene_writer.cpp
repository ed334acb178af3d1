// SPDX-License-Identifier: Apache-2.0
#include <google/protobuf/text_format.h>

#include "common/config/angle.h"
#include "common/config/scene.h"
#include "common/config/scene.pb.h"

namespace aquarama::config {

namespace {

void write(glm::vec3 point, v1::ScenePoint& out) {
    out.set_x_m(static_cast<double>(point.x));
    out.set_y_m(static_cast<double>(point.y));
    out.set_z_m(static_cast<double>(point.z));
}

v1::Scene::Gathering gatheringOf(Gathering gathering) {
    if (gathering == Gathering::None) return v1::Scene::NONE;
    return gathering == Gathering::Mill ? v1::Scene::MILL : v1::Scene::JOURNEY;
}

void write(const SceneWater& water, v1::SceneWater& out) {
    write(water.centre, *out.mutable_centre());
    write(water.halfExtent, *out.mutable_half_extent());
    out.set_least_room(water.leastLengthsCubed);
    out.set_clarity_m(water.clarityMetres);
    out.set_surface_c(water.surfaceCelsius);
    out.set_celsius_per_metre(water.celsiusPerMetre);
    out.set_jerlov(std::string(kWaterTypeNames.at(static_cast<std::size_t>(water.jerlov))));
}

void write(const Day& day, v1::Day& out) {
    out.set_length_s(day.lengthSeconds);
    out.set_starts_at(day.startsAt);
    out.set_night(day.night);
}

void write(const FoodDrop& drop, v1::FoodDrop& out) {
    out.set_at_s(drop.atSeconds);
    write(drop.position, *out.mutable_position());
    out.set_pellets(drop.pellets);
}

void write(const Start& start, v1::Start& out) {
    write(start.centre, *out.mutable_centre());
    out.set_radius_m(start.radiusMetres);
    out.set_heading_deg(degreesOf(start.headingRadians));
    out.set_hunger(start.hunger);
    out.set_libido(start.libido);
}

void write(const CastMember& member, v1::CastMember& out) {
    out.set_species(member.species);
    out.set_fish(member.fish);
    if (member.start) write(*member.start, *out.mutable_start());
}

void write(const SceneTour& tour, v1::Tour& out) {
    out.set_speed_m_s(tour.metresPerSecond);
    for (const TourStop& stop : tour.stops) {
        v1::TourStop& written = *out.add_stops();
        write(stop.at, *written.mutable_at());
        if (stop.lookAt) write(*stop.lookAt, *written.mutable_look_at());
    }
}

}  // namespace

std::string writeScene(const Scene& scene) {
    v1::Scene out;
    out.set_name(scene.name);
    out.set_place(scene.place == PlaceKind::Reef ? v1::Scene::REEF : v1::Scene::OPEN_SEA);
    write(scene.eye, *out.mutable_eye());
    write(scene.water, *out.mutable_water());
    out.set_gathering(gatheringOf(scene.gathering));
    out.set_plankton(scene.plankton);
    write(scene.day, *out.mutable_day());
    for (const FoodDrop& drop : scene.drops) write(drop, *out.add_drops());
    for (const CastMember& member : scene.cast) write(member, *out.add_cast());
    if (scene.tour) write(*scene.tour, *out.mutable_tour());
    out.set_idle_s(scene.idleSeconds);
    std::string text;
    google::protobuf::TextFormat::PrintToString(out, &text);
    return text;
}

}  // namespace aquarama::config
