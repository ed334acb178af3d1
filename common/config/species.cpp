// SPDX-License-Identifier: Apache-2.0
#include "common/config/species.h"

#include <google/protobuf/text_format.h>

#include "common/config/angle.h"
#include "common/config/species.pb.h"
#include "common/config/species_habits.h"
#include "common/config/species_shape.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

namespace {

constexpr Range kShare{0, 1};
constexpr Range kStrength{0.001, 1e6};
constexpr Range kMetres{0.005, 20};

SizeRange readSize(const TextPlace& at) {
    SizeRange size;
    size.meanMetres = static_cast<float>(at.number("mean_m", kMetres));
    size.deviationMetres = static_cast<float>(at.number("deviation_m", {0, 10}));
    size.leastMetres = static_cast<float>(at.number("least_m", kMetres));
    size.mostMetres = static_cast<float>(at.number("most_m", kMetres));
    if (size.leastMetres > size.meanMetres)
        at.refuse("least_m", "least_m is more than mean_m: exchange them");
    if (size.mostMetres < size.meanMetres)
        at.refuse("most_m", "most_m is less than mean_m: exchange them");
    return size;
}

Skeleton readSkeleton(const TextPlace& at) {
    Skeleton skeleton;
    if (at.count("rings") != 5) at.refuse("a skeleton has five rings: give five");
    double before = 0;
    for (std::size_t i = 0; i < 5; ++i) {
        const TextPlace in = at.in("rings", static_cast<int>(i));
        SkeletonRing& ring = skeleton.rings.at(i);
        ring.s = in.number("s", {0.05, 0.95});
        if (ring.s < before + 0.02)
            in.refuse("s", "rings must stand 0.02 body lengths apart or more: move this one back");
        before = ring.s;
        ring.halfHeight = in.number("half_height", {0.005, 0.5});
        ring.halfWidth = in.number("half_width", {0.005, 0.5});
        ring.nodeMass = in.number("node_mass", kStrength);
    }
    skeleton.tailHalfSpan = at.number("tail_half_span", {0.005, 0.5});
    skeleton.noseMass = at.number("nose_mass", kStrength);
    skeleton.tailTipMass = at.number("tail_tip_mass", kStrength);
    return skeleton;
}

Tissue readTissue(const TextPlace& at) {
    return {.timeScale = at.number("time_scale", {0.1, 10}),
            .stiffness = at.number("stiffness", kStrength),
            .crossStiffness = at.number("cross_stiffness", kStrength),
            .muscleStiffness = at.number("muscle_stiffness", kStrength),
            .tailStiffening = at.number("tail_stiffening", {0.1, 10}),
            .damping = at.number("damping", {0, 1000}),
            .muscleContraction = at.number("muscle_contraction", {0, 0.6})};
}

Gait readGait(const TextPlace& at) {
    return {.beatHertz = at.number("beat_hz", {0.1, 20}), .gain = at.number("gain", {0, 2})};
}

Swim readSwim(const TextPlace& at) {
    return {.middleDrive = at.number("middle_drive", kShare),
            .backDrive = at.number("back_drive", kShare),
            .backLagRadians = radiansOf(at.number("back_lag_deg", {0, 360})),
            .slow = readGait(at.in("slow")),
            .medium = readGait(at.in("medium")),
            .fast = readGait(at.in("fast"))};
}

Bend readBend(const TextPlace& at) {
    return {.strength = at.number("strength", kShare), .tempo = at.number("tempo", {0.5, 4})};
}

Turn readTurn(const TextPlace& at) {
    return {.gradual = readBend(at.in("gradual")), .sharp = readBend(at.in("sharp"))};
}

std::vector<Paint> readPalette(const TextPlace& root) {
    std::vector<Paint> palette;
    for (int i = 0; i < root.count("palette"); ++i) {
        const TextPlace at = root.in("palette", i);
        palette.push_back(
            {at.text("part"),
             glm::dvec3(
                 at.number("red", kShare), at.number("green", kShare), at.number("blue", kShare))});
    }
    return palette;
}

// The name becomes the name of the repertoire's file.
std::string readName(const TextPlace& root) {
    std::string name = root.text("name");
    if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos)
        root.refuse("name", "name \"" + name + "\" may hold a-z, 0-9 and _ only: rename it");
    return name;
}

}  // namespace

Species parseSpecies(const std::string& text, const std::string& source) {
    v1::Species message;
    const TextReader reader(text, source, message);
    const TextPlace root = reader.root();
    Species species;
    species.name = readName(root);
    species.size = readSize(root.in("size"));
    species.profile = readProfile(root);
    species.fins = readFins(root.in("fins"), species.profile.stations.back());
    if (root.has("fin_motion")) species.finMotion = readFinMotion(root.in("fin_motion"));
    species.eye = readEye(root.in("eye"));
    species.threads = readThreads(root);
    species.skeleton = readSkeleton(root.in("skeleton"));
    species.tissue = readTissue(root.in("tissue"));
    species.water = {.drag = root.in("water").number("drag", {0, 1e5}),
                     .frontFactor = root.in("water").number("front_factor", kShare),
                     .finDrag = root.in("water").number("fin_drag", {0, 100})};
    species.swim = readSwim(root.in("swim"));
    species.turn = readTurn(root.in("turn"));
    species.habits = readHabits(root.in("habits"), species.name);
    species.palette = readPalette(root);
    species.recordsControlPoints = message.recorded_control_points();
    return species;
}

std::string motionText(const std::string& text, const std::string& source) {
    v1::Species message;
    const TextReader reader(text, source, message);
    message.clear_habits();
    message.clear_palette();
    message.clear_fin_motion();
    message.clear_threads();
    message.clear_eye();
    std::string kept;
    google::protobuf::TextFormat::PrintToString(message, &kept);
    return kept;
}

Species readSpecies(const std::string& path) {
    return parseSpecies(readTextFile(path), path);
}

}  // namespace aquarama::config
