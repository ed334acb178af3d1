// SPDX-License-Identifier: Apache-2.0
#include "common/formats/wall_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <limits>
#include <mutex>
#include <set>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/formats/mpcdi.h"
#include "common/formats/pfm.h"
#include "common/formats/vendors.h"

namespace aquarama::formats {

namespace {

using Bytes = std::span<const std::byte>;

// The largest file: forty 4K projectors.
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 32;

// A format: how its content is known, and its reader.
struct Format {
    bool (*isIt)(Bytes bytes);
    WallFile (*read)(Bytes bytes,
                     const std::string& source,
                     const ReadOptions& options,
                     const FrustumFile& frustum);
};

// For readers that need no frustum beside the file.
template <auto read>
WallFile alone(Bytes bytes,
               const std::string& source,
               const ReadOptions& options,
               const FrustumFile& /*frustum*/) {
    return read(bytes, source, options);
}

constexpr std::array kFormats{Format{isMpcdi, alone<readMpcdi>},
                              Format{isVioso, alone<readVioso>},
                              Format{isSciss, alone<readSciss>},
                              Format{isScalable, alone<readScalable>},
                              Format{isDomeprojection, readDomeprojection},
                              Format{isSimcad, readSimcad},
                              Format{isPaulBourke, alone<readPaulBourke>},
                              Format{isPfm, readPfm},
                              Format{isObj, alone<readObjWarp>}};

// The two samples around a place along one axis: the first one, and the share of the second.
struct Between {
    int low = 0, high = 0;
    double t = 0;
};

Between between(double place, int count, Sampling sampling) {
    if (count == 1) return {};
    const double index = sampling == Sampling::Centres ? place * count - 0.5 : place * (count - 1);
    const int low = static_cast<int>(std::clamp(std::floor(index), 0.0, count - 2.0));
    return {low, low + 1, index - low};
}

}  // namespace

void remark(std::vector<std::string>& remarks, const std::string& line) {
    if (remarks.size() < kMostRemarks) remarks.push_back(line);
}

void sayRemarks(const std::vector<std::string>& remarks) {
    static std::mutex mutex;
    static std::set<std::string> said;
    const std::lock_guard lock(mutex);
    for (const std::string& line : remarks)
        if (said.insert(line).second) logWarning("{}", line);
}

glm::dvec3 CoordinateFrame::canonicalPosition() const {
    return {glm::dot(position, pitch), -glm::dot(position, yaw), -glm::dot(position, roll)};
}

glm::dmat3 worldFromCamera(const Frustum& frustum) {
    const glm::dquat yaw = glm::angleAxis(-frustum.yaw, glm::dvec3(0, 1, 0));
    const glm::dquat pitch = glm::angleAxis(frustum.pitch, glm::dvec3(1, 0, 0));
    const glm::dquat roll = glm::angleAxis(-frustum.roll, glm::dvec3(0, 0, 1));
    return glm::mat3_cast(yaw * pitch * roll);
}

namespace {

WallFile readWith(Bytes bytes,
                  const std::string& source,
                  const ReadOptions& options,
                  const FrustumFile& frustum) {
    for (const Format& format : kFormats)
        if (format.isIt(bytes)) return format.read(bytes, source, options, frustum);
    // Of text formats only the manifest of an MPCDI may have two bytes a letter.
    const std::string_view mark = beginning(bytes, 2);
    if (mark == "\xFF\xFE" || mark == "\xFE\xFF")
        throw Error(source + ": is saved as UTF-16, or is no wall file; save it as UTF-8");
    throw Error(source + ": is of no known format of wall files; export it as MPCDI");
}

}  // namespace

WallFile readWallFile(Bytes bytes,
                      const std::string& source,
                      const ReadOptions& options,
                      Bytes frustum) {
    return readWith(bytes, source, options, {source + ", frustum", frustum});
}

WallFile readWallFile(const std::string& path, const ReadOptions& options) {
    const std::vector<std::byte> bytes = readWhole(path, kMostBytes);
    const std::string beside = frustumPathBeside(path);
    if (beside == path || !std::filesystem::is_regular_file(beside))
        return readWith(bytes, path, options, {});
    const std::vector<std::byte> frustum = readWhole(beside, kMostBytes);
    return readWith(bytes, path, options, {beside, frustum});
}

namespace {

std::string faultIn(std::span<const float> response) {
    const std::size_t count = response.size();
    if (count < kLeastResponses || count > kMostResponses)
        return fmt::format(
            "of {} samples, not of {} to {}", count, kLeastResponses, kMostResponses);
    if (response.front() != 0 || response.back() != 1) return "that does not run from 0 to 1";
    const auto falls = [](float before, float after) { return !(before <= after); };
    return std::ranges::adjacent_find(response, falls) == response.end() ? "" : "that falls";
}

}  // namespace

std::string faultOf(const ChannelColour& colour) {
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (!(std::abs(colour.mix[column][row]) <= kMostMix))
                return fmt::format("a mix with a number beyond {}", kMostMix);
    if (!(std::abs(glm::determinant(colour.mix)) >= kLeastMix))
        return "a mix that gives the same to different colours";
    for (std::size_t i = 0; i < kPrimaryNames.size(); ++i)
        if (const std::string fault = faultIn(colour.response[i]); !fault.empty())
            return fmt::format("a {} response {}", kPrimaryNames[i], fault);
    return "";
}

double codeFor(std::span<const float> response, double light) {
    const double wanted = std::clamp(light, 0.0, 1.0);
    const auto above = std::ranges::lower_bound(response, wanted);
    assert(above != response.end());
    if (above == response.begin()) return 0;
    const double low = *std::prev(above);
    const double steps = static_cast<double>(above - response.begin()) - 1;
    return (steps + (wanted - low) / (static_cast<double>(*above) - low)) /
           static_cast<double>(response.size() - 1);
}

double lightFor(std::span<const float> response, double code) {
    const Between at = between(code, static_cast<int>(response.size()), Sampling::Nodes);
    return std::lerp(response[static_cast<std::size_t>(at.low)],
                     response[static_cast<std::size_t>(at.high)],
                     at.t);
}

glm::vec3 warpAt(const Warp& warp, glm::dvec2 place) {
    assert(!warp.samples.empty());
    if (!std::isfinite(place.x) || !std::isfinite(place.y)) return glm::vec3(kUnlit);
    const Between x = between(place.x, warp.size.x, warp.sampling);
    const Between y = between(place.y, warp.size.y, warp.sampling);
    glm::dvec3 sum{};
    const auto add = [&](int column, int row, double weight) {
        const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(warp.size.x) +
                           static_cast<std::size_t>(column);
        if (weight != 0) sum += weight * glm::dvec3(warp.samples[index]);
    };
    add(x.low, y.low, (1 - x.t) * (1 - y.t));
    add(x.high, y.low, x.t * (1 - y.t));
    add(x.low, y.high, (1 - x.t) * y.t);
    add(x.high, y.high, x.t * y.t);
    return glm::vec3(sum);
}

Warp resampled(const Warp& warp, glm::ivec2 size) {
    Warp fine{.size = size, .samples = {}};
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            fine.samples.push_back(warpAt(warp, (glm::dvec2(x, y) + 0.5) / glm::dvec2(size)));
    return fine;
}

namespace {

double lightOf(const Mask& mask, int code) {
    const double most = mask.bits == 16 ? 65535 : 255;
    return std::pow(code / most, mask.gamma);
}

// `lightOfCode`: of a code of the mask, linear.
template <typename Light>
glm::vec3 lightBetween(const Mask& mask, glm::dvec2 place, const Light& lightOfCode) {
    assert(!mask.codes.empty());
    const Between x = between(std::clamp(place.x, 0.0, 1.0), mask.size.x, Sampling::Centres);
    const Between y = between(std::clamp(place.y, 0.0, 1.0), mask.size.y, Sampling::Centres);
    const auto light = [&](int column, int row, int component) {
        const int pixel = row * mask.size.x + column;
        const int index = pixel * mask.components + (mask.components == 3 ? component : 0);
        return lightOfCode(mask.codes[static_cast<std::size_t>(index)]);
    };
    const double tx = std::clamp(x.t, 0.0, 1.0), ty = std::clamp(y.t, 0.0, 1.0);
    glm::dvec3 sum;
    for (int i = 0; i < 3; ++i)
        sum[i] = (1 - ty) * ((1 - tx) * light(x.low, y.low, i) + tx * light(x.high, y.low, i)) +
                 ty * ((1 - tx) * light(x.low, y.high, i) + tx * light(x.high, y.high, i));
    return glm::vec3(sum);
}

}  // namespace

glm::vec3 lightAt(const Mask& mask, glm::dvec2 place) {
    return lightBetween(mask, place, [&](int code) { return lightOf(mask, code); });
}

MaskLight::MaskLight(const Mask& mask) : mask_(mask) {
    assert(!mask.codes.empty());
    const int most = std::ranges::max(mask.codes);
    for (int code = 0; code <= most; ++code) lightOfCode_.push_back(lightOf(mask, code));
}

glm::vec3 MaskLight::at(glm::dvec2 place) const {
    return lightBetween(
        mask_, place, [&](int code) { return lightOfCode_[static_cast<std::size_t>(code)]; });
}

}  // namespace aquarama::formats
