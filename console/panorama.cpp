// SPDX-License-Identifier: Apache-2.0
#include "console/panorama.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include <glm/matrix.hpp>

#include "common/base/log.h"
#include "common/wall/wall.h"

namespace aquarama::console {

namespace {

namespace fs = std::filesystem;

using Place = std::optional<glm::dvec2>;

// Points of a mesh, across and down a picture: between them a browser draws straight on.
constexpr glm::ivec2 kMeshPoints{33, 25};
// Past the screen's edges light is followed so far, so that the mesh covers the screen up to them.
constexpr double kPastTheScreenMetres = 1;

// The places of a mesh, row by row.
class Mesh {
  public:
    Mesh(const wall::Wall& wall, std::size_t channel, glm::ivec2 sizePixels) {
        for (int row = 0; row < kMeshPoints.y; ++row)
            for (int column = 0; column < kMeshPoints.x; ++column) {
                const glm::dvec2 share =
                    glm::dvec2(column, row) / glm::dvec2(kMeshPoints - glm::ivec2(1));
                const auto point = wall.channel(channel).pointOf(share * glm::dvec2(sizePixels),
                                                                 kPastTheScreenMetres);
                places_.push_back(point ? Place(wall.screen().unrolled(*point)) : Place());
            }
    }

    // A point whose light misses a measured screen goes on as its neighbours do: else the screen's
    // edge would be cut off by up to a whole cell.
    void extend() {
        const std::vector<Place> seen = places_;
        for (int i = 0; i < static_cast<int>(seen.size()); ++i)
            if (!seen[static_cast<std::size_t>(i)])
                places_[static_cast<std::size_t>(i)] =
                    beside(seen, {i % kMeshPoints.x, i / kMeshPoints.x});
    }
    // As console.proto has them.
    [[nodiscard]] std::string bytes() const {
        std::string bytes;
        for (const Place& place : places_) {
            constexpr glm::dvec2 kFarOff{9};
            addShare(bytes, place.value_or(kFarOff).x);
            addShare(bytes, place.value_or(kFarOff).y);
        }
        return bytes;
    }

  private:
    // Straight on from two neighbours in a row or a column; nothing where none are.
    static Place beside(const std::vector<Place>& seen, glm::ivec2 at) {
        for (const glm::ivec2 step : std::array<glm::ivec2, 4>{
                 glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
            const Place near = placeAt(seen, at + step), far = placeAt(seen, at + 2 * step);
            if (near && far) return 2.0 * *near - *far;
        }
        return std::nullopt;
    }
    static Place placeAt(const std::vector<Place>& seen, glm::ivec2 at) {
        const bool isInside =
            at.x >= 0 && at.y >= 0 && at.x < kMeshPoints.x && at.y < kMeshPoints.y;
        return isInside ? seen[static_cast<std::size_t>(at.y * kMeshPoints.x + at.x)]
                        : std::nullopt;
    }
    // Shares from -0.5 to 1.5; farther off and nowhere is 65535.
    static void addShare(std::string& bytes, double share) {
        constexpr double kScale = 32768, kNowhere = 65535;
        const double scaled = std::round((share + 0.5) * kScale);
        const bool isNear = scaled >= 0 && scaled < kNowhere;
        const auto value = static_cast<unsigned>(isNear ? scaled : kNowhere);
        bytes += static_cast<char>(value & 0xFFU);
        bytes += static_cast<char>(value >> 8U);
    }

    std::vector<Place> places_;
};

// As console.proto has it: undoes what the last pass of a node does for a projector.
void addColour(browser::ChannelMesh& mesh, const formats::ChannelColour& colour) {
    constexpr int kCodes = 256;
    constexpr double kScale = 65535;
    std::string light;
    for (const std::vector<float>& response : colour.response)
        for (int code = 0; code < kCodes; ++code) {
            const double share = formats::lightFor(response, double(code) / (kCodes - 1));
            const auto value = static_cast<unsigned>(std::lround(kScale * share));
            light += static_cast<char>(value & 0xFFU);
            light += static_cast<char>(value >> 8U);
        }
    mesh.set_light_of_codes(light);
    const glm::mat3 rows(glm::transpose(glm::inverse(glm::dmat3(colour.mix))));
    for (int row = 0; row < 3; ++row)
        for (int own = 0; own < 3; ++own) mesh.add_light_of_own(rows[row][own]);
}

// Those that cannot be looked at have the earliest time.
std::vector<fs::file_time_type> timesOf(const std::vector<fs::path>& files) {
    std::vector<fs::file_time_type> times;
    std::error_code failure;
    for (const fs::path& file : files) times.push_back(fs::last_write_time(file, failure));
    return times;
}

}  // namespace

// The meshes are in the order of the rig's channels.
browser::Panorama panoramaOf(const config::Rig& rig) {
    const wall::Wall wall(rig);
    browser::Panorama panorama;
    panorama.set_width_px(static_cast<std::uint32_t>(rig.panoramaPixels.x));
    panorama.set_height_px(static_cast<std::uint32_t>(rig.panoramaPixels.y));
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        Mesh mesh(wall, i, rig.channels[i].sizePixels);
        for (int round = 0; round < 2; ++round) mesh.extend();  // so corners have two neighbours
        browser::ChannelMesh& out = *panorama.add_meshes();
        out.set_columns(kMeshPoints.x);
        out.set_rows(kMeshPoints.y);
        out.set_places(mesh.bytes());
        const glm::vec2 eye = wall::firstEyeShare(wall::stereoOf(rig, i).mode);
        out.set_eye_width(eye.x);
        out.set_eye_height(eye.y);
        if (const auto* colour = wall.channel(i).colour()) addColour(out, *colour);
    }
    return panorama;
}

// The times come first: what is written meanwhile is read once more.
PanoramaWatch::Made PanoramaWatch::make(const std::string& rigPath) {
    Made made{.files = {rigPath}, .times = {}, .panorama = {}, .problem = {}};
    try {
        const config::Rig rig = config::parseRig(config::readTextFile(rigPath), rigPath);
        for (const auto& [name, content] : rig.files)
            made.files.emplace_back(config::besideFile(rigPath, name));
        made.times = timesOf(made.files);
        made.panorama = panoramaOf(config::readRig(rigPath));
    } catch (const Error& problem) {
        made.times = timesOf(made.files);
        made.problem = problem.what();
    }
    return made;
}

// The last one that could be made is kept.
bool PanoramaWatch::update() {
    constexpr std::chrono::seconds kNow{0};
    if (!making_.valid()) {
        if (made_.files.empty() || timesOf(made_.files) != made_.times)
            making_ = std::async(std::launch::async, [path = rigPath_] { return make(path); });
        return false;
    }
    if (making_.wait_for(kNow) != std::future_status::ready) return false;
    Made made = making_.get();
    const bool isMade = made.problem.empty();
    if (!isMade) {
        logWarning("{}; the panorama stays as it was", made.problem);
        made.panorama = std::move(made_.panorama);
    }
    made_ = std::move(made);
    return isMade;
}

}  // namespace aquarama::console
