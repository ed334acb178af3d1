// SPDX-License-Identifier: Apache-2.0
#include "common/config/species.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "common/base/units.h"
#include "common/config/species.pb.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

namespace {

namespace pb = google::protobuf;

constexpr double kMillisecond = 1e-3;
constexpr float kHead = 0.05F;  // no fin stands before it
// Of a mouth: the least length from front to corner, and the last station of a corner.
constexpr float kLeastGape = 0.01F, kMostGape = 0.15F;

static_assert(v1::Habits::PREDATOR - v1::Habits::PREY == static_cast<int>(Role::Predator));

std::optional<float> given(bool has, double value) {
    return has ? std::optional<float>(static_cast<float>(value)) : std::nullopt;
}

float real(double value) {
    return static_cast<float>(value);
}

float radians(double degrees) {
    return static_cast<float>(degrees * kDegree);
}

BodyProfile profileOf(const TextReader& file, const v1::Species& in) {
    BodyProfile profile;
    for (const v1::ProfileStation& at : in.profile()) {
        const float s = real(at.s());
        if (profile.stations.empty() ? s != 0.0F : s <= profile.stations.back())
            file.refuse(at, "s", "profile stations must begin at s: 0 and rise: sort them");
        profile.stations.push_back(s);
        profile.dorsal.push_back(real(at.up()));
        profile.ventral.push_back(real(at.down()));
        profile.halfWidth.push_back(real(at.half_width()));
        profile.fullnessUp.push_back(real(at.full_up()));
        profile.fullnessDown.push_back(real(at.full_down()));
    }
    return profile;
}

std::vector<glm::vec2> polylineOf(const pb::RepeatedPtrField<v1::Point>& in) {
    std::vector<glm::vec2> points;
    for (const v1::Point& at : in) points.emplace_back(at.s(), at.y());
    return points;
}

Fin finOf(const v1::Fin& in) {
    return {.base = polylineOf(in.base()),
            .edge = polylineOf(in.edge()),
            .angleRadians = radians(in.angle_deg()),
            .round = real(in.round()),
            .flex = real(in.flex())};
}

// A fin along the back or the belly: the skin's rings follow its base, so that must run tailwards.
Fin medianFinOf(const TextReader& file, const v1::Fin& in, const std::string& name) {
    Fin fin = finOf(in);
    for (std::size_t i = 1; i < fin.base.size(); ++i)
        if (fin.base[i].x <= fin.base[i - 1].x)
            file.refuse(in,
                        "base",
                        "the base of " + name + " must run from head to tail: sort it",
                        static_cast<int>(i));
    return fin;
}

// A fin that stands off the flank turns about its base. tailRoot: the last station of the profile,
// before which all fins but the tail end.
Fin pectoralOf(const TextReader& file, const v1::Fin& in, float tailRoot) {
    Fin fin = finOf(in);
    if (fin.base.front() == fin.base.back())
        file.refuse(in, "base", "the base of pectoral ends where it begins: spread it");
    for (std::size_t i = 0; i < fin.base.size(); ++i)
        if (fin.base[i].x < kHead || fin.base[i].x >= tailRoot)
            file.refuse(in,
                        "base",
                        "the base of pectoral must lie behind the head and before the tail, from "
                        "s: 0.05 to the last profile station: move it",
                        static_cast<int>(i));
    return fin;
}

// Along back and belly the bases of the fins come one after the other, between the head and the
// root of the tail.
void checkOrder(const TextReader& file, const v1::Fins& in, const Fins& fins, float tailRoot) {
    const auto begin = [](const Fin& fin) { return fin.base.front().x; };
    const auto end = [](const Fin& fin) { return fin.base.back().x; };
    const auto require = [&](bool good, const std::string& fin, const std::string& why) {
        if (!good) file.refuse(in, fin, fin + why);
    };
    require(begin(fins.firstDorsal) >= kHead,
            "first_dorsal",
            " begins on the head, before s: 0.05: move it back");
    require(begin(fins.pelvic) >= 2 * kHead,
            "pelvic",
            " begins on the head, before s: 0.1: move it back");
    const std::string tooLong = " ends behind the last profile station: shorten it";
    if (fins.secondDorsal) {
        require(begin(*fins.secondDorsal) > end(fins.firstDorsal),
                "second_dorsal",
                " begins before first_dorsal ends: move it back");
        require(end(*fins.secondDorsal) < tailRoot, "second_dorsal", tooLong);
    } else {
        require(end(fins.firstDorsal) < tailRoot, "first_dorsal", tooLong);
    }
    require(
        begin(fins.anal) > end(fins.pelvic), "anal", " begins before pelvic ends: move it back");
    require(end(fins.anal) < tailRoot, "anal", tooLong);
}

Fins finsOf(const TextReader& file, const v1::Fins& in, float tailRoot) {
    Fins fins{.firstDorsal = medianFinOf(file, in.first_dorsal(), "first_dorsal"),
              .secondDorsal = {},
              .anal = medianFinOf(file, in.anal(), "anal"),
              .caudal = finOf(in.caudal()),
              .pelvic = medianFinOf(file, in.pelvic(), "pelvic"),
              .pectoral = pectoralOf(file, in.pectoral(), tailRoot)};
    if (in.has_second_dorsal())
        fins.secondDorsal = medianFinOf(file, in.second_dorsal(), "second_dorsal");
    checkOrder(file, in, fins, tailRoot);
    return fins;
}

Ripple rippleOf(const v1::Ripple& in) {
    return {.amplitude = real(in.amplitude()),
            .waves = real(in.waves()),
            .beatHertz = real(in.beat_hz()),
            .isOpposed = in.opposed()};
}

// What is left out has zeros, and keeps still.
FinMotion finMotionOf(const v1::FinMotion& in) {
    const v1::Rowing& rowing = in.rowing();
    return {.rowing = {.beatHertz = real(rowing.beat_hz()),
                       .strokeRadians = radians(rowing.stroke_deg()),
                       .featherRadians = radians(rowing.feather_deg()),
                       .openRadians = radians(rowing.open_deg()),
                       .flapRadians = radians(rowing.flap_deg()),
                       .leadRadians = radians(rowing.lead_deg()),
                       .twistRadians = radians(rowing.twist_deg()),
                       .middleRadians = radians(rowing.middle_deg()),
                       .trimRadians = radians(rowing.trim_deg())},
            .swimming = rippleOf(in.swimming()),
            .hovering = rippleOf(in.hovering()),
            .cuppingRadians = radians(in.cupping_deg()),
            .pelvicFoldRadians = radians(in.pelvic_fold_deg())};
}

// No fish is drawn to both.
void refuseBoth(const TextReader& file,
                const v1::Shares& in,
                const std::string& one,
                const std::string& other,
                double sum) {
    if (sum > 1)
        file.refuse(in, other, one + " and " + other + " sum to more than 1: no fish likes both");
}

HabitShares sharesOf(const TextReader& file, const v1::Shares& in) {
    refuseBoth(file, in, "brightness", "darkness", in.brightness() + in.darkness());
    refuseBoth(file, in, "warmth", "cold", in.warmth() + in.cold());
    return {.schooling = in.schooling(),
            .brightness = in.brightness(),
            .darkness = in.darkness(),
            .warmth = in.warmth(),
            .cold = in.cold(),
            .female = in.female(),
            .maleFromMetres = given(in.has_male_from_m(), in.male_from_m()),
            .femaleFromMetres = given(in.has_female_from_m(), in.female_from_m())};
}

void comfortOf(const TextReader& file, const v1::Comfort& in, Habits& habits) {
    const auto rising = [&](const char* least, const char* most, Span span) {
        if (span.most <= span.least)
            file.refuse(
                in, most, std::string(most) + " must be more than " + least + ": exchange them");
        return span;
    };
    habits.comfort.depthMetres =
        rising("least_depth_m", "most_depth_m", {in.least_depth_m(), in.most_depth_m()});
    habits.comfort.bestDepthMetres = in.best_depth_m();
    if (in.best_depth_m() < in.least_depth_m() || in.best_depth_m() > in.most_depth_m())
        file.refuse(in,
                    "best_depth_m",
                    "best_depth_m must be from least_depth_m to most_depth_m: move it in between");
    habits.comfort.light = rising("least_light", "most_light", {in.least_light(), in.most_light()});
    habits.comfort.waterCelsius =
        rising("coldest_c", "warmest_c", {in.coldest_c(), in.warmest_c()});
}

Paces pacesOf(const TextReader& file, const v1::Paces& in) {
    if (std::abs(in.hover() + in.slow() + in.medium() + in.fast() - 1) > 1e-6)
        file.refuse(in, "the paces must sum to 1: they are shares of the time");
    return {.hover = in.hover(), .slow = in.slow(), .medium = in.medium(), .fast = in.fast()};
}

std::optional<SiteKind> siteOf(v1::Home::At at) {
    if (at < v1::Home::ANEMONE) return {};
    return static_cast<SiteKind>(at - v1::Home::ANEMONE);
}

Home homeOf(const TextReader& file, const v1::Home& in) {
    if (in.kind() == v1::Home::SCHOOL) {
        for (const auto& [field, has] : {std::pair{"radius_m", in.has_radius_m()},
                                         std::pair{"leash_m", in.has_leash_m()},
                                         std::pair{"at", in.has_at()},
                                         std::pair{"group", in.has_group()}})
            if (has)
                file.refuse(in,
                            field,
                            "a home with the school has no " + std::string(field) + ": remove it");
        return {.kind = HomeKind::School};
    }
    file.require(in, "radius_m");
    file.require(in, "leash_m");
    if (in.leash_m() < in.radius_m())
        file.refuse(in, "leash_m", "leash_m is less than radius_m: exchange them");
    return {.kind = HomeKind::Place,
            .radiusMetres = in.radius_m(),
            .leashMetres = in.leash_m(),
            .onTheReef = in.at() >= v1::Home::BOULDER,
            .site = siteOf(in.at()),
            .group = in.has_group() ? in.group() : 2};
}

Cloud cloudOf(const TextReader& file, const v1::Habits& in) {
    if (in.home().kind() != v1::Home::PLACE)
        file.refuse(in, "cloud", "a cloud is over a home: add home { kind: PLACE }");
    return {.heightMetres = in.cloud().height_m(), .pickSeconds = in.cloud().pick_s()};
}

Graze grazeOf(const TextReader& file, const v1::Graze& in) {
    if (in.most_bites() < in.least_bites())
        file.refuse(in, "most_bites", "most_bites is less than least_bites: exchange them");
    return {.manner = static_cast<GrazeManner>(in.manner() - v1::Graze::SHOAL),
            .share = in.share(),
            .bitesPerSecond = in.bites_per_s(),
            .leastBites = in.least_bites(),
            .mostBites = in.most_bites(),
            .bitesPerParticle = in.bites_per_particle(),
            .sandSeconds = in.sand_s()};
}

Territory territoryOf(const TextReader& file, const v1::Habits& in) {
    if (in.home().kind() != v1::Home::PLACE)
        file.refuse(in, "territory", "a territory is about a home: add home { kind: PLACE }");
    return {.radiusMetres = in.territory().radius_m(), .share = in.territory().share()};
}

std::optional<Ambush> ambushOf(const TextReader& file, const v1::Habits& in) {
    if (!in.hunt().has_ambush()) return {};
    const v1::Ambush& ambush = in.hunt().ambush();
    if (ambush.strikes_m() > ambush.notices_m())
        file.refuse(ambush, "strikes_m", "strikes_m is more than notices_m: exchange them");
    if (ambush.posts() > 1 && !siteOf(in.home().at()))
        file.refuse(ambush, "posts", "posts are sites of its home: let that be at a kind of site");
    return Ambush{.noticesMetres = ambush.notices_m(),
                  .strikesMetres = ambush.strikes_m(),
                  .hangsDegrees = ambush.hangs_deg(),
                  .posts = ambush.posts()};
}

Cleans cleansOf(const TextReader& file, const v1::Habits& in) {
    if (in.role() != v1::Habits::PACIFIST)
        file.refuse(in, "cleans", "only a pacifist cleans: remove it or change the role");
    if (in.home().kind() != v1::Home::PLACE)
        file.refuse(in, "cleans", "it cleans at its home: add home { kind: PLACE }");
    return {.inspectSeconds = in.cleans().inspect_s()};
}

// Kinds of sites; no kind twice.
std::vector<SiteKind> hidingOf(const TextReader& file, const v1::Habits& in) {
    std::vector<SiteKind> kinds;
    for (int i = 0; i < in.hides_in_size(); ++i) {
        const std::optional<SiteKind> kind = siteOf(in.hides_in(i));
        if (!kind) file.refuse(in, "hides_in", "no fish hides there: name a kind of site", i);
        if (std::ranges::count(kinds, *kind) > 0)
            file.refuse(in, "hides_in", "the kind is named twice: once is enough", i);
        kinds.push_back(*kind);
    }
    return kinds;
}

// Names of other species; no name twice.
std::vector<std::string> othersOf(const TextReader& file,
                                  const pb::Message& in,
                                  const std::string& field,
                                  const pb::RepeatedPtrField<std::string>& written,
                                  const std::string& own) {
    std::vector<std::string> names;
    for (const std::string& name : written) {
        const int index = static_cast<int>(names.size());
        if (name == own)
            file.refuse(in, field, field + " names the species itself: name others", index);
        if (std::ranges::count(names, name) > 0)
            file.refuse(in, field, "\"" + name + "\" is named twice: once is enough", index);
        names.push_back(name);
    }
    return names;
}

// What the role rules out is refused, so that no line of a file is without effect.
void refuseContradictions(const TextReader& file, const v1::Habits& in) {
    const bool hunts = in.role() == v1::Habits::PREDATOR;
    if (hunts && !in.has_hunt()) file.refuse(in, "role", "a predator needs a hunt: add it");
    if (!hunts && in.has_hunt())
        file.refuse(in, "hunt", "only a predator hunts: remove it or change the role");
    if (hunts && in.has_fear()) file.refuse(in, "fear", "a predator fears nobody: remove it");
    if (!hunts && !in.has_fear()) file.refuse(in, "role", "all but predators fear: add fear");
    if (in.has_spawns() && in.libido_per_s() <= 0)
        file.refuse(in, "spawns", "it never mates: add libido_per_s or remove this line");
    if (hunts && in.has_pair_bl())
        file.refuse(in, "pair_bl", "a predator keeps no partner: remove it or change the role");
    if (in.role() != v1::Habits::PREY && in.shares().schooling() > 0)
        file.refuse(in.shares(), "schooling", "only prey schools: remove it or change the role");
    if (in.home().kind() == v1::Home::SCHOOL && in.shares().schooling() <= 0)
        file.refuse(
            in.home(), "kind", "nobody of this species schools: its home is a PLACE or none");
    if (!in.hunger().plankton() && !in.has_hunt() && !in.has_graze())
        file.refuse(
            in.hunger(), "plankton", "it would eat nothing: let it eat plankton, graze or hunt");
    if (hunts && in.has_graze())
        file.refuse(in, "graze", "a predator does not graze: remove it or change the role");
}

void fearOf(const TextReader& file, const v1::Habits& in, Habits& habits) {
    habits.fear.metres = 0, habits.fear.from = 1, habits.fear.alone = 1;
    if (!in.has_fear()) return;
    const v1::Fear& fear = in.fear();
    habits.fear.metres = real(fear.whole_m());
    habits.fear.from = real(fear.heeded_from());
    habits.fear.alone = real(fear.alone_from());
    if (habits.fear.alone <= habits.fear.from)
        file.refuse(fear, "alone_from", "alone_from must be more than heeded_from: exchange them");
}

void sensesOf(const TextReader& file, const v1::Habits& in, Habits& habits) {
    habits.visionBodyLengths = real(in.senses().vision_bl());
    habits.smellBodyLengths = real(in.senses().smell_bl());
    if (habits.smellBodyLengths < habits.visionBodyLengths)
        file.refuse(in.senses(),
                    "smell_bl",
                    "smell_bl is less than vision_bl: food that is seen is sensed too");
}

// `own`: the name of the species itself, which it does not hunt.
void huntOf(const TextReader& file, const v1::Habits& in, const std::string& own, Habits& habits) {
    if (!in.has_hunt()) return;
    const v1::Hunt& hunt = in.hunt();
    habits.hunts = othersOf(file, hunt, "prey", hunt.prey(), own);
    habits.hunt = {
        .chaseSeconds = hunt.chase_s(),
        .giveUpMetres = hunt.give_up_m(),
        .restSeconds = hunt.rest_s(),
        .restByDaySeconds = hunt.has_rest_by_day_s() ? hunt.rest_by_day_s() : hunt.rest_s(),
        .ambush = ambushOf(file, in)};
}

void hoursOf(const v1::Habits& in, Habits& habits) {
    if (!in.has_hours()) return;
    const v1::ActiveHours& hours = in.hours();
    habits.hours = {.active = static_cast<Activity>(hours.active() - v1::ActiveHours::ALWAYS),
                    .retires = hours.retires(),
                    .rises = hours.rises()};
}

// `own`: the name of the species itself, which it neither hunts nor shadows.
Habits habitsOf(const TextReader& file, const v1::Habits& in, const std::string& own) {
    refuseContradictions(file, in);
    Habits habits;
    habits.role = static_cast<Role>(in.role() - v1::Habits::PREY);
    habits.hunger.appetiteParticles = real(in.hunger().appetite_particles());
    habits.hunger.digestionPerSecond = real(in.hunger().digestion_per_s());
    habits.hunger.eatsPlankton = in.hunger().plankton();
    habits.libidoPerSecond = real(in.libido_per_s());
    habits.spawnsInRush = in.spawns() == v1::Habits::RUSH;
    fearOf(file, in, habits);
    habits.shares = sharesOf(file, in.shares());
    comfortOf(file, in.comfort(), habits);
    habits.paces = pacesOf(file, in.paces());
    habits.gradualShare = in.gradual_share();
    sensesOf(file, in, habits);
    habits.box = {.aheadBodyLengths = real(in.box().ahead_bl()),
                  .asideBodyLengths = real(in.box().aside_bl()),
                  .upBodyLengths = real(in.box().up_bl())};
    habits.persistence = real(in.persistence());
    if (in.has_home()) habits.home = homeOf(file, in.home());
    if (in.has_cloud()) habits.cloud = cloudOf(file, in);
    if (in.has_graze()) habits.graze = grazeOf(file, in.graze());
    if (in.has_territory()) habits.territory = territoryOf(file, in);
    habits.hidesIn = hidingOf(file, in);
    hoursOf(in, habits);
    huntOf(file, in, own, habits);
    if (in.has_cleans()) habits.cleans = cleansOf(file, in);
    habits.pairBodyLengths = in.pair_bl();
    habits.shadows = othersOf(file, in, "shadows", in.shadows(), own);
    return habits;
}

SizeRange sizeOf(const TextReader& file, const v1::Size& in) {
    const SizeRange size{.meanMetres = real(in.mean_m()),
                         .deviationMetres = real(in.deviation_m()),
                         .leastMetres = real(in.least_m()),
                         .mostMetres = real(in.most_m())};
    if (size.leastMetres > size.meanMetres)
        file.refuse(in, "least_m", "least_m is more than mean_m: exchange them");
    if (size.mostMetres < size.meanMetres)
        file.refuse(in, "most_m", "most_m is less than mean_m: exchange them");
    return size;
}

Skeleton skeletonOf(const TextReader& file, const v1::Skeleton& in) {
    Skeleton skeleton;
    double before = 0;
    for (std::size_t i = 0; i < skeleton.rings.size(); ++i) {
        const v1::Ring& ring = in.rings(static_cast<int>(i));
        if (ring.s() < before + 0.02)
            file.refuse(
                ring, "s", "rings must stand 0.02 body lengths apart or more: move this one back");
        before = ring.s();
        skeleton.rings.at(i) = {.s = ring.s(),
                                .halfHeight = ring.half_height(),
                                .halfWidth = ring.half_width(),
                                .nodeMass = ring.node_mass()};
    }
    skeleton.tailHalfSpan = in.tail_half_span();
    skeleton.noseMass = in.nose_mass();
    skeleton.tailTipMass = in.tail_tip_mass();
    return skeleton;
}

Tissue tissueOf(const v1::Tissue& in) {
    return {.timeScale = in.time_scale(),
            .stiffness = in.stiffness(),
            .crossStiffness = in.cross_stiffness(),
            .muscleStiffness = in.muscle_stiffness(),
            .tailStiffening = in.tail_stiffening(),
            .damping = in.damping(),
            .muscleContraction = in.muscle_contraction()};
}

Gait gaitOf(const v1::Gait& in) {
    return {.beatHertz = in.beat_hz(), .gain = in.gain(), .rows = in.rows()};
}

Swim swimOf(const v1::Swim& in) {
    return {.middleDrive = in.middle_drive(),
            .backDrive = in.back_drive(),
            .backLagRadians = in.back_lag_deg() * kDegree,
            .slow = gaitOf(in.slow()),
            .medium = gaitOf(in.medium()),
            .fast = gaitOf(in.fast())};
}

Bend bendOf(const v1::Bend& in) {
    return {.strength = in.strength(), .tempo = in.tempo()};
}

StartStage stageOf(const v1::StartStage& in) {
    return {.front = in.front(),
            .middle = in.middle(),
            .back = in.back(),
            .seconds = in.ms() * kMillisecond};
}

FastStart startOf(const v1::FastStart& in) {
    return {.tone = in.tone(),
            .tailTone = in.tail_tone(),
            .muscleTone = in.muscle_tone(),
            .contraction = in.contraction(),
            .bend = stageOf(in.bend()),
            .stroke = stageOf(in.stroke()),
            .lagSeconds = in.lag_ms() * kMillisecond,
            .riseSeconds = in.rise_ms() * kMillisecond,
            .fallSeconds = in.fall_ms() * kMillisecond,
            .beatPhase = in.beat_phase()};
}

// All that moves the animal, as text.
std::string motionOf(v1::Species in) {
    in.clear_version();
    in.clear_habits();
    in.clear_palette();
    v1::Rowing rowing = in.fin_motion().rowing();
    rowing.clear_trim_deg();
    in.clear_fin_motion();
    *in.mutable_fin_motion()->mutable_rowing() = rowing;
    in.clear_threads();
    in.clear_eye();
    in.clear_gill();
    // The lips are part of the cage, whose control points some repertoires hold.
    if (!in.recorded_control_points()) in.clear_mouth();
    std::string kept;
    pb::TextFormat::PrintToString(in, &kept);
    return kept;
}

glm::vec2 pointOf(const v1::Point& in) {
    return {real(in.s()), real(in.y())};
}

// Of a species whose file has none: a small one at the tip of the snout.
Mouth smallMouth(const BodyProfile& profile) {
    constexpr float kLong = 0.03F;
    const float y = (profile.dorsal.front() - profile.ventral.front()) / 2;
    return {.front = {0, y},
            .corner = {kLong, y - kLong / 3},
            .joint = {2 * kLong, y - kLong / 2},
            .gapeRadians = radians(20)};
}

Mouth mouthOf(const TextReader& file, const v1::Species& in, const BodyProfile& profile) {
    if (!in.has_mouth()) return smallMouth(profile);
    const v1::Mouth& drawn = in.mouth();
    const Mouth mouth{.front = pointOf(drawn.front()),
                      .corner = pointOf(drawn.corner()),
                      .joint = pointOf(drawn.joint()),
                      .lip = real(drawn.lip()),
                      .gapeRadians = radians(drawn.gape_deg()),
                      .protrusion = real(drawn.protrusion()),
                      .teeth = static_cast<Teeth>(std::max(drawn.teeth() - v1::Mouth::HIDDEN, 0))};
    if (mouth.corner.x < mouth.front.x + kLeastGape || mouth.corner.x > kMostGape)
        file.refuse(drawn,
                    "corner",
                    "the corner of the mouth must lie behind its front by 0.01 or more, and before "
                    "s: 0.15: move it");
    if (mouth.joint.x < mouth.corner.x)
        file.refuse(drawn, "joint", "the joint of the jaw lies before the corner: move it back");
    return mouth;
}

// Fins that row need a beat and a stroke, and a gait is the fins' or the tail's.
void checkRowing(const TextReader& file, const v1::Species& in) {
    constexpr double kLeastBeatHz = 0.1;
    constexpr double kMostTwistDegrees = 180;
    const v1::Rowing& rowing = in.fin_motion().rowing();
    if (rowing.stroke_deg() > 0 && rowing.beat_hz() < kLeastBeatHz)
        file.refuse(
            rowing, "beat_hz", "fins with a stroke_deg row at 0.1 Hz at least: raise beat_hz");
    if (std::abs(rowing.twist_deg()) + std::abs(rowing.feather_deg()) > kMostTwistDegrees)
        file.refuse(
            rowing,
            "feather_deg",
            "twist_deg and feather_deg together twist a fin by more than 180 degrees: lower one");
    for (const v1::Gait* gait : {&in.swim().slow(), &in.swim().medium(), &in.swim().fast()})
        if (gait->rows() > 0 && (gait->gain() > 0 || rowing.stroke_deg() == 0))
            file.refuse(*gait,
                        "rows",
                        "a gait that rows has gain: 0, and fin_motion a rowing with a stroke_deg: "
                        "change one of them");
}

// The name becomes the name of the repertoire's file.
void checkName(const TextReader& file, const v1::Species& in) {
    if (in.name().find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos)
        file.refuse(
            in, "name", "name \"" + in.name() + "\" may hold a-z, 0-9 and _ only: rename it");
}

}  // namespace

Species parseSpecies(const std::string& text, const std::string& source) {
    v1::Species in;
    TextReader file(text, source, in);
    Species species;
    species.text = text;
    species.motion = motionOf(in);  // of what the file says, without defaults
    file.check();
    checkName(file, in);
    checkRowing(file, in);
    species.name = in.name();
    species.size = sizeOf(file, in.size());
    species.profile = profileOf(file, in);
    species.fins = finsOf(file, in.fins(), species.profile.stations.back());
    species.finMotion = finMotionOf(in.fin_motion());
    species.eye = {.s = real(in.eye().s()),
                   .y = real(in.eye().y()),
                   .radius = real(in.eye().radius()),
                   .bulge = real(in.eye().bulge())};
    species.mouth = mouthOf(file, in, species.profile);
    if (in.has_gill())
        species.gill = {.s = real(in.gill().s()),
                        .bow = real(in.gill().bow()),
                        .flare = real(in.gill().flare())};
    for (const v1::Thread& thread : in.threads())
        species.threads.push_back({.at = polylineOf(thread.at()),
                                   .rootWidth = real(thread.root_width()),
                                   .tipWidth = real(thread.tip_width()),
                                   .isOfFirstDorsal = thread.of_first_dorsal()});
    species.skeleton = skeletonOf(file, in.skeleton());
    species.tissue = tissueOf(in.tissue());
    species.water = {.drag = in.water().drag(),
                     .frontFactor = in.water().front_factor(),
                     .finDrag = in.water().fin_drag()};
    species.swim = swimOf(in.swim());
    species.turn = {.gradual = bendOf(in.turn().gradual()), .sharp = bendOf(in.turn().sharp())};
    species.start = startOf(in.fast_start());
    species.habits = habitsOf(file, in.habits(), in.name());
    for (const v1::Paint& paint : in.palette())
        species.palette.push_back(
            {paint.part(), glm::dvec3(paint.red(), paint.green(), paint.blue())});
    species.recordsControlPoints = in.recorded_control_points();
    return species;
}

Species readSpecies(const std::string& path) {
    return parseSpecies(readTextFile(path), path);
}

}  // namespace aquarama::config
