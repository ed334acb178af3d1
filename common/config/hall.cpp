// SPDX-License-Identifier: Apache-2.0
#include "common/config/hall.h"

#include <algorithm>

#include "common/base/units.h"
#include "common/config/hall.pb.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

namespace {

static_assert(v1::HallCamera::LINEAR == static_cast<int>(ScanCamera::Response::Linear));

// A part of the file, and what it is read with.
struct HallReader {
    const TextReader& file;
    const std::vector<std::string>& channels;

    [[nodiscard]] std::size_t channelOf(const TextReader::Message& in,
                                        const std::string& field,
                                        const std::string& name,
                                        int index = 0) const {
        const auto found = std::ranges::find(channels, name);
        if (found == channels.end())
            file.refuse(in,
                        field,
                        "the rig has no channel \"" + name + "\": give the rig of this hall",
                        index);
        return static_cast<std::size_t>(found - channels.begin());
    }
};

double factorOf(double percent) {
    return 1 + percent / 100;
}

glm::dvec3 pointOf(const v1::HallPosition& in) {
    return {in.x_m(), in.y_m(), in.z_m()};
}

HallScreen screenOf(const v1::HallScreen& in) {
    HallScreen screen{.radiusFactor = factorOf(in.radius_percent()),
                      .sizeFactor = factorOf(in.size_percent()),
                      .tiltRadians = in.tilt_deg() * kDegree,
                      .bumpMetres = in.bump_m(),
                      .bumpDistanceMetres = in.bump_distance_m(),
                      .bumpSeed = in.bump_seed(),
                      .dents = {},
                      .albedo = in.albedo(),
                      .bounces = in.bounces(),
                      .marksOffMetres = {}};
    for (const v1::HallDent& dent : in.dents())
        screen.dents.push_back({{dent.u(), dent.v()}, dent.radius_m(), dent.depth_m()});
    for (const v1::HallMark& mark : in.marks()) screen.marksOffMetres.push_back(mark.off_m());
    return screen;
}

HallLens lensOf(const v1::HallLens& in) {
    return {.distortion = {in.k1(), in.k2(), in.k3(), in.p1(), in.p2()},
            .vignetting = in.vignetting()};
}

void requireCount(
    const HallReader& reader, const v1::HallProjector& in, const char* field, int has, int needs) {
    if (has == 0 || has == needs) return;
    reader.file.refuse(in,
                       field,
                       std::string(field) + " has " + std::to_string(has) + " values: give " +
                           std::to_string(needs) + " or none");
}

// A list of numbers, each from `least` to `most`; nothing where it is empty.
std::vector<double> numbersOf(const HallReader& reader,
                              const v1::HallProjector& in,
                              const std::string& field,
                              const google::protobuf::RepeatedField<float>& list,
                              std::array<double, 2> bounds) {
    std::vector<double> numbers;
    for (const float number : list) {
        if (!(double(number) >= bounds[0] && double(number) <= bounds[1]))
            reader.file.refuse(in,
                               field,
                               field + " has numbers from " + std::to_string(bounds[0]) + " to " +
                                   std::to_string(bounds[1]),
                               static_cast<int>(numbers.size()));
        numbers.push_back(double(number));
    }
    return numbers;
}

// Sets how a projector makes light.
void readLight(const HallReader& reader, const v1::HallProjector& in, HallProjector& out) {
    requireCount(reader, in, "gamma", in.gamma_size(), 3);
    requireCount(reader, in, "primaries", in.primaries_size(), 9);
    const auto gamma = numbersOf(reader, in, "gamma", in.gamma(), {0.5, 5});
    if (!gamma.empty()) out.gamma = {gamma[0], gamma[1], gamma[2]};
    const auto primaries = numbersOf(reader, in, "primaries", in.primaries(), {-2, 2});
    for (std::size_t i = 0; i < primaries.size(); ++i)
        out.primaries[static_cast<int>(i % 3)][static_cast<int>(i / 3)] = primaries[i];
    out.toe = in.toe();
    out.knee = in.knee();
    out.black = in.black();
    out.brightness = in.brightness();
}

void readProjector(const HallReader& reader, const v1::HallProjector& in, Hall& hall) {
    HallProjector& out = hall.projectors[reader.channelOf(in, "channel", in.channel())];
    out.movedMetres = pointOf(in.moved());
    out.turnedRadians = kDegree * glm::dvec3(in.yaw_deg(), in.pitch_deg(), in.roll_deg());
    out.focalFactor = factorOf(in.focal_percent());
    out.shiftPixels = {in.shift_x_px(), in.shift_y_px()};
    out.lens = lensOf(in.lens());
    out.keystone = {in.keystone_x(), in.keystone_y()};
    readLight(reader, in, out);
}

HallCamera cameraOf(const TextReader& file, const v1::HallCamera& in) {
    const glm::ivec2 size(in.width_px(), in.height_px());
    if (pointOf(in.position()) == pointOf(in.look_at()))
        file.refuse(in, "look_at", "the camera looks at its own place: give another");
    return {.positionMetres = pointOf(in.position()),
            .lookAtMetres = pointOf(in.look_at()),
            .rollRadians = in.roll_deg() * kDegree,
            .sizePixels = size,
            .focalPixels = in.focal_px(),
            .principalPixels = {in.has_principal_x_px() ? in.principal_x_px() : size.x / 2.0,
                                in.has_principal_y_px() ? in.principal_y_px() : size.y / 2.0},
            .lens = lensOf(in.lens()),
            .blurPixels = in.blur_px(),
            .response = static_cast<ScanCamera::Response>(in.response()),
            .responseBend = in.response_bend(),
            .bits = static_cast<int>(in.bits()),
            .exposure = in.exposure(),
            .fullWell = in.full_well(),
            .readNoise = in.read_noise()};
}

void readSwapped(const HallReader& reader, const v1::HallFaults& in, HallFaults& out) {
    if (in.swapped_size() == 0) return;
    if (in.swapped_size() != 2)
        reader.file.refuse(in, "swapped", "two channels are swapped: name both");
    out.swapped = {reader.channelOf(in, "swapped", in.swapped(0), 0),
                   reader.channelOf(in, "swapped", in.swapped(1), 1)};
}

HallFaults faultsOf(const HallReader& reader, const v1::HallFaults& in) {
    HallFaults out;
    if (in.has_blocked())
        out.blocked = {{in.blocked().u(), in.blocked().v()},
                       {in.blocked().radius_u(), in.blocked().radius_v()}};
    if (in.has_moved())
        out.moved = {reader.channelOf(in.moved(), "channel", in.moved().channel()),
                     in.moved().from_picture(),
                     kDegree * glm::dvec2(in.moved().yaw_deg(), in.moved().pitch_deg())};
    readSwapped(reader, in, out);
    if (in.has_lamp())
        out.lamp = {{in.lamp().u(), in.lamp().v()},
                    in.lamp().radius_m(),
                    in.lamp().light(),
                    in.lamp().from_picture()};
    if (in.has_late_picture()) out.latePicture = in.late_picture();
    out.autoExposure = in.auto_exposure();
    if (in.has_mode())
        out.mode = {reader.channelOf(in.mode(), "channel", in.mode().channel()),
                    {in.mode().width_px(), in.mode().height_px()}};
    out.flatScreen = in.flat_screen();
    return out;
}

}  // namespace

Hall parseHall(const std::string& text,
               const std::string& source,
               const std::vector<std::string>& channels) {
    v1::Hall in;
    TextReader file(text, source, in);
    file.check();
    const HallReader reader{file, channels};
    Hall hall{.screen = screenOf(in.screen()),
              .projectors = std::vector<HallProjector>(channels.size()),
              .camera = cameraOf(file, in.camera()),
              .darkLight = in.dark_light(),
              .roomLight = in.room_light(),
              .faults = faultsOf(reader, in.faults())};
    for (const v1::HallProjector& projector : in.projectors())
        readProjector(reader, projector, hall);
    return hall;
}

}  // namespace aquarama::config
