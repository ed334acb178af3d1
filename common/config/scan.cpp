// SPDX-License-Identifier: Apache-2.0
#include "common/config/scan.h"

#include <algorithm>

#include <google/protobuf/text_format.h>

#include "common/base/log.h"
#include "common/config/scan.pb.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

namespace {

static_assert(v1::ScanPicture::DOTS == static_cast<int>(ScanPattern::Kind::Dots));
static_assert(v1::ScanCamera::LINEAR == static_cast<int>(ScanCamera::Response::Linear));

// Whether a name is a file in the folder of the scan, and no path out of it.
bool isPlainName(const std::string& file) {
    return file.find('/') == std::string::npos && file.find('\0') == std::string::npos &&
           file != "." && file != "..";
}

ScanCamera cameraFrom(const v1::ScanCamera& in) {
    return {.response = static_cast<ScanCamera::Response>(in.response()),
            .focalPixels = in.has_focal_px() ? std::optional(in.focal_px()) : std::nullopt};
}

std::uint64_t litFrom(const TextReader& file,
                      const v1::ScanPicture& in,
                      const std::vector<std::string>& channels) {
    std::uint64_t lit = 0;
    for (int i = 0; i < in.lit_size(); ++i) {
        const auto found = std::ranges::find(channels, in.lit(i));
        if (found == channels.end())
            file.refuse(
                in,
                "lit",
                "the rig has no channel \"" + in.lit(i) + "\": give the rig that was scanned",
                i);
        lit |= bitOf(static_cast<std::size_t>(found - channels.begin()));
    }
    return lit;
}

glm::vec3 lightFrom(const TextReader& file, const v1::ScanPicture& in) {
    if (in.light_size() == 0) return glm::vec3(1);
    if (in.light_size() != 3) file.refuse(in, "light", "light has three values: red, green, blue");
    const glm::vec3 light(in.light(0), in.light(1), in.light(2));
    for (int i = 0; i < 3; ++i)
        if (!(light[i] >= 0 && light[i] <= 1)) file.refuse(in, "light", "light is from 0 to 1", i);
    return light;
}

ScanPicture pictureFrom(const TextReader& file,
                        const v1::Scan& scan,
                        const v1::ScanPicture& in,
                        const std::vector<std::string>& channels) {
    if (!isPlainName(in.file()))
        file.refuse(in, "file", "\"" + in.file() + "\" is not the name of a file beside this one");
    if (in.camera() >= static_cast<std::uint32_t>(scan.cameras_size()))
        file.refuse(in, "camera", "there are " + std::to_string(scan.cameras_size()) + " cameras");
    return {.file = in.file(),
            .camera = in.camera(),
            .exposureSeconds = in.exposure_s(),
            .frame = in.frame(),
            .pattern = {.kind = static_cast<ScanPattern::Kind>(in.kind()),
                        .step = static_cast<std::uint8_t>(in.step()),
                        .finestPixels = static_cast<std::uint16_t>(in.finest_px()),
                        .inverse = in.inverse(),
                        .light = lightFrom(file, in),
                        .lit = litFrom(file, in, channels),
                        .number = static_cast<std::uint16_t>(in.number()),
                        .tagged = in.tagged()}};
}

void addTo(v1::Scan& out, const ScanPicture& picture, const std::vector<std::string>& channels) {
    v1::ScanPicture& to = *out.add_pictures();
    const ScanPattern& pattern = picture.pattern;
    to.set_file(picture.file);
    to.set_camera(picture.camera);
    to.set_exposure_s(picture.exposureSeconds);
    if (picture.frame != 0) to.set_frame(picture.frame);
    to.set_kind(static_cast<v1::ScanPicture::Kind>(pattern.kind));
    to.set_step(pattern.step);
    to.set_finest_px(pattern.finestPixels);
    if (pattern.inverse) to.set_inverse(true);
    for (int i = 0; i < 3; ++i) to.add_light(pattern.light[i]);
    for (std::size_t i = 0; i < channels.size(); ++i)
        if (contains(pattern.lit, i)) to.add_lit(channels[i]);
    to.set_number(pattern.number);
    to.set_tagged(pattern.tagged);
}

}  // namespace

Scan parseScan(const std::string& text,
               const std::string& source,
               const std::vector<std::string>& channels) {
    v1::Scan in;
    TextReader file(text, source, in);
    file.check();
    Scan scan{.rig = in.rig(), .cameras = {}, .pictures = {}};
    for (const v1::ScanCamera& camera : in.cameras()) scan.cameras.push_back(cameraFrom(camera));
    for (const v1::ScanPicture& picture : in.pictures())
        scan.pictures.push_back(pictureFrom(file, in, picture, channels));
    return scan;
}

std::string textOf(const Scan& scan, const std::vector<std::string>& channels) {
    v1::Scan out;
    out.set_version(1);
    out.set_rig(scan.rig);
    for (const ScanCamera& camera : scan.cameras) {
        v1::ScanCamera& to = *out.add_cameras();
        to.set_response(static_cast<v1::ScanCamera::Response>(camera.response));
        if (camera.focalPixels) to.set_focal_px(*camera.focalPixels);
    }
    for (const ScanPicture& picture : scan.pictures) addTo(out, picture, channels);
    std::string text;
    google::protobuf::TextFormat::PrintToString(out, &text);
    return text;
}

}  // namespace aquarama::config
