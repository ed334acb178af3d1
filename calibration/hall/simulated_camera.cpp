// SPDX-License-Identifier: Apache-2.0
#include "calibration/hall/simulated_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/base/hash.h"
#include "common/base/worker_pool.h"
#include "common/wall/scan_pattern.h"

namespace aquarama::hall {

namespace {

constexpr float kDrapeAlbedo = 0.03F;
constexpr glm::ivec2 kPatches(16, 8);
constexpr int kPatchSamples = 4;  // each way
// The middle of a dome's front edge has a mark of black tape, half so wide and so far inwards.
constexpr double kMarkMetres = 0.06;

unsigned threads() {
    return std::max(1U, std::thread::hardware_concurrency());
}

// From codes to linear Rec. 709 light of a projector.
class Response {
  public:
    explicit Response(const config::HallProjector& truth) : truth_{truth} {}

    [[nodiscard]] glm::vec3 operator()(glm::vec3 codes) const {
        glm::dvec3 own;
        for (int i = 0; i < 3; ++i) own[i] = channel(i, static_cast<double>(codes[i]));
        return glm::vec3(truth_.primaries * own + truth_.black);
    }

  private:
    // A power, lifted at its dark end and bent down at its bright one; 1 stays 1.
    [[nodiscard]] double channel(int i, double code) const {
        const double power =
            truth_.gamma ? std::pow(code, (*truth_.gamma)[i]) : linearFromSrgb(code);
        const double light = (1 - truth_.toe) * power + truth_.toe * code;
        return light * (1 + truth_.knee * (1 - light));
    }
    const config::HallProjector& truth_;
};

// Between the centres of pixels of a picture that may be one row or one column.
glm::vec3 sampled(const Light& light, glm::vec2 place) {
    const glm::dvec2 size(light.sizePixels);
    return bilinear(light, glm::min(glm::dvec2(place), size));
}

std::size_t indexIn(glm::ivec2 size, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
           static_cast<std::size_t>(x);
}

}  // namespace

SeenHall::SeenHall(const TrueHall& hall) : hall_{hall}, size_{hall.hall().camera.sizePixels} {
    const std::size_t pixels =
        static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y);
    albedo_.assign(pixels, kDrapeAlbedo);
    unrolled_.assign(pixels, glm::vec2(std::numeric_limits<float>::quiet_NaN()));
    first_.assign(pixels + 1, 0);
    std::vector<std::vector<Ray>> rows(static_cast<std::size_t>(size_.y));
    WorkerPool(threads()).run(rows.size(), [&](std::size_t row) { findRays(row, rows); });
    for (std::size_t i = 0; i < pixels; ++i) first_[i + 1] += first_[i];
    for (const std::vector<Ray>& row : rows) rays_.insert(rays_.end(), row.begin(), row.end());
    if (hall.hall().screen.bounces) findPatches();
}

// The edge of the screen is found by four samples to a pixel; light changes slowly and has one.
void SeenHall::findRays(std::size_t row, std::vector<std::vector<Ray>>& rows) {
    for (int x = 0; x < size_.x; ++x) {
        const std::size_t index = indexIn(size_, x, static_cast<int>(row));
        const glm::dvec2 centre(x + 0.5, static_cast<double>(row) + 0.5);
        double covered = 0;
        for (int k = 0; k < 4; ++k) {
            const glm::dvec2 at = centre + glm::dvec2(k % 2, k / 2) * 0.5 - 0.25;
            const auto meeting = hall_.screen().meet(hall_.cameraLens().ray(at));
            if (meeting && meeting->isScreen && !isMark(meeting->point)) covered += 0.25;
        }
        albedo_[index] =
            static_cast<float>(glm::mix(double{kDrapeAlbedo}, hall_.hall().screen.albedo, covered));
        const auto meeting = hall_.screen().meet(hall_.cameraLens().ray(centre));
        if (!meeting) continue;
        if (meeting->isScreen)
            unrolled_[index] =
                glm::vec2(glm::clamp(hall_.screen().shape().unrolled(meeting->foot), 0.0, 1.0));
        for (std::size_t channel = 0; channel < hall_.channels(); ++channel) {
            const auto place = hall_.pixelOf(channel, meeting->point);
            if (!place) continue;
            const double white =
                hall_.whiteAt(channel, meeting->point) / hall_.hall().screen.albedo;
            rows[row].push_back({static_cast<std::uint32_t>(channel),
                                 static_cast<float>(white),
                                 glm::vec2(*place)});
            ++first_[index + 1];
        }
    }
}

bool SeenHall::isMark(glm::dvec3 point) const {
    if (hall_.rig().screen.shape != config::ScreenShape::Dome) return false;
    const auto front = hall_.screen().at({0.5, 1});
    return front && glm::distance(*front, point) < kMarkMetres;
}

// Light that a patch gets of all others by one bounce: two cosines over pi r squared.
void SeenHall::findPatches() {
    struct Centre {
        glm::dvec3 point, normal;
        double squareMetres;
    };
    std::vector<std::optional<Centre>> centres;
    const TrueScreen& screen = hall_.screen();
    for (int y = 0; y < kPatches.y; ++y)
        for (int x = 0; x < kPatches.x; ++x) {
            Patch patch;
            for (int k = 0; k < kPatchSamples * kPatchSamples; ++k) {
                const glm::dvec2 at =
                    (glm::dvec2(x, y) + (glm::dvec2(k % kPatchSamples, k / kPatchSamples) + 0.5) /
                                            double{kPatchSamples}) /
                    glm::dvec2(kPatches);
                const auto point = screen.at(at);
                if (!point) continue;
                patch.share += 1.0 / (kPatchSamples * kPatchSamples);
                for (std::uint32_t channel = 0; channel < hall_.channels(); ++channel)
                    if (const auto place = hall_.pixelOf(channel, *point))
                        patch.rays.push_back({channel,
                                              static_cast<float>(hall_.whiteAt(channel, *point) /
                                                                 (kPatchSamples * kPatchSamples)),
                                              glm::vec2(*place)});
            }
            patches_.push_back(std::move(patch));
            const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / glm::dvec2(kPatches);
            const glm::dvec2 step = 0.2 / glm::dvec2(kPatches);
            const auto here = screen.at(at), right = screen.at(at + glm::dvec2(step.x, 0)),
                       down = screen.at(at + glm::dvec2(0, step.y));
            if (!here || !right || !down) {
                centres.emplace_back();
                continue;
            }
            centres.push_back(Centre{*here,
                                     screen.normalAt(*here),
                                     25 * glm::length(glm::cross(*right - *here, *down - *here))});
        }
    given_.assign(patches_.size(), std::vector<float>(patches_.size(), 0.0F));
    for (std::size_t to = 0; to < centres.size(); ++to)
        for (std::size_t from = 0; from < centres.size(); ++from) {
            if (to == from || !centres[to] || !centres[from]) continue;
            const glm::dvec3 way = centres[from]->point - centres[to]->point;
            const double square = glm::dot(way, way);
            const double cosines = std::max(0.0, glm::dot(way, centres[to]->normal)) *
                                   std::max(0.0, -glm::dot(way, centres[from]->normal));
            given_[to][from] = static_cast<float>(
                hall_.hall().screen.albedo * cosines * centres[from]->squareMetres /
                (square * (std::numbers::pi * square + centres[from]->squareMetres)));
        }
}

glm::vec3 SeenHall::sum(const Ray* begin, const Ray* end, const std::vector<Light>& lights) const {
    glm::vec3 light(0);
    for (const Ray* ray = begin; ray != end; ++ray)
        light += ray->white * sampled(lights[ray->channel], ray->place);
    return light;
}

std::vector<glm::vec3> SeenHall::bounced(const std::vector<Light>& lights) const {
    std::vector<glm::vec3> direct, bounced(patches_.size(), glm::vec3(0));
    for (const Patch& patch : patches_)
        direct.push_back(sum(patch.rays.data(), patch.rays.data() + patch.rays.size(), lights));
    for (std::size_t to = 0; to < patches_.size(); ++to)
        for (std::size_t from = 0; from < patches_.size(); ++from)
            bounced[to] += given_[to][from] * direct[from];
    return bounced;
}

Light SeenHall::lit(const std::vector<Light>& codes) const {
    std::vector<Light> lights;
    for (std::size_t channel = 0; channel < codes.size(); ++channel) {
        const Response response(hall_.hall().projectors[hall_.projectorOf(channel)]);
        Light light = codes[channel];
        for (glm::vec3& rgb : light.rgb) rgb = response(rgb);
        lights.push_back(std::move(light));
    }
    Light seen = darkness(size_);
    Light indirect = darkness(kPatches);
    if (!patches_.empty()) indirect.rgb = bounced(lights);
    WorkerPool(threads()).run(static_cast<std::size_t>(size_.y), [&](std::size_t row) {
        for (int x = 0; x < size_.x; ++x) {
            const std::size_t i = indexIn(size_, x, static_cast<int>(row));
            glm::vec3 light = albedo_[i] * sum(&rays_[first_[i]], &rays_[first_[i + 1]], lights);
            if (!patches_.empty() && !std::isnan(unrolled_[i].x))
                light += bilinear(indirect, glm::dvec2(unrolled_[i]) * glm::dvec2(kPatches));
            seen.rgb[i] = light;
        }
    });
    return seen;
}

Light SeenHall::lampLit(double light) const {
    Light seen = darkness(size_);
    for (std::size_t i = 0; i < seen.rgb.size(); ++i)
        seen.rgb[i] = glm::vec3(albedo_[i] * static_cast<float>(light));
    return seen;
}

namespace {

// The codes that a channel shows: of a pattern along one axis one row or column is enough, but for
// its tag.
Light codesOf(const config::ScanPattern& pattern, std::size_t channel, glm::ivec2 size) {
    Light codes = darkness(size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::vec3 light = wall::scanLight(pattern, channel, size, {x, y});
            for (int i = 0; i < 3; ++i)
                codes.at(x, y)[i] = static_cast<float>(
                    std::round(255 * srgbFromLinear(static_cast<double>(light[i]))) / 255);
        }
    return codes;
}

// Two passes of a Gaussian.
void blur(Light& light, double sigma) {
    if (sigma <= 0) return;
    const int reach = static_cast<int>(std::ceil(3 * sigma));
    std::vector<float> weights;
    float total = 0;
    for (int i = -reach; i <= reach; ++i) {
        weights.push_back(static_cast<float>(std::exp(-i * i / (2 * sigma * sigma))));
        total += weights.back();
    }
    for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
        const Light sharp = light;
        WorkerPool(threads()).run(
            static_cast<std::size_t>(light.sizePixels.y), [&](std::size_t row) {
                for (int x = 0; x < light.sizePixels.x; ++x) {
                    glm::vec3 sum(0);
                    for (int i = -reach; i <= reach; ++i) {
                        const glm::ivec2 at =
                            glm::clamp(glm::ivec2(x, static_cast<int>(row)) + i * step,
                                       glm::ivec2(0),
                                       light.sizePixels - 1);
                        sum += weights[static_cast<std::size_t>(i + reach)] * sharp.at(at.x, at.y);
                    }
                    light.at(x, static_cast<int>(row)) = sum / total;
                }
            });
    }
}

// A normal deviate, the same for the same place, channel and picture: after Box and Muller.
double noiseAt(std::uint32_t seed, std::size_t place) {
    const std::uint32_t key = hashOf(seed, static_cast<std::uint32_t>(place));
    const double u = std::max(1e-9, static_cast<double>(unitOf(key)));
    const double v = static_cast<double>(unitOf(hashOf(key, 1U)));
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

// What the sensor and its file make of light, of which 1 is the most.
double codeOf(double light, const config::HallCamera& camera, double deviate) {
    const double shot = camera.fullWell > 0 ? std::max(0.0, light) / camera.fullWell : 0;
    const double noisy = light + deviate * std::sqrt(shot + camera.readNoise * camera.readNoise);
    const double clipped = std::clamp(noisy, 0.0, 1.0);
    if (camera.response == config::ScanCamera::Response::Linear) return clipped;
    const double code = srgbFromLinear(clipped);
    return std::clamp(code + camera.responseBend * code * (1 - code), 0.0, 1.0);
}

config::Hall beforeMove(config::Hall hall) {
    hall.faults.moved.reset();
    return hall;
}

}  // namespace

SimulatedCamera::SimulatedCamera(const TrueHall& hall,
                                 const std::vector<config::ScanPattern>& patterns,
                                 std::uint32_t seed)
    : hall_{hall}, seed_{seed}, seen_{std::make_unique<SeenHall>(hall)} {
    scan_.rig = hall.rig().name;
    scan_.cameras.push_back({.response = hall.hall().camera.response, .focalPixels = {}});
    for (const config::ScanPattern& pattern : patterns)
        scan_.pictures.push_back(
            {.file = fmt::format("picture_{:03}.png", scan_.pictures.size()), .pattern = pattern});
    if (hall.hall().faults.moved) {
        before_ = std::make_unique<TrueHall>(hall.rig(), beforeMove(hall.hall()));
        seenBefore_ = std::make_unique<SeenHall>(*before_);
    }
    gain_ = exposure() * hall.hall().camera.exposure;
}

// So that the brightest of the whites comes to 0.8.
double SimulatedCamera::exposure() const {
    std::vector<Light> white;
    for (const config::Channel& channel : hall_.rig().channels) {
        white.push_back(darkness(channel.sizePixels));
        std::ranges::fill(white.back().rgb, glm::vec3(1));
    }
    std::vector<float> all;
    for (const glm::vec3& rgb : seen_->lit(white).rgb)
        all.push_back(std::max({rgb.x, rgb.y, rgb.z}));
    const auto bright = all.begin() + static_cast<long>(0.999 * static_cast<double>(all.size()));
    std::ranges::nth_element(all, bright);
    return 0.8 / std::max(1e-6, static_cast<double>(*bright));
}

void SimulatedCamera::addLamp(std::size_t index, Light& light) const {
    const auto& lamp = hall_.hall().faults.lamp;
    if (!lamp || index < lamp->fromPicture) return;
    const auto middle = hall_.screen().at(lamp->place);
    if (!middle) return;
    for (int y = 0; y < light.sizePixels.y; ++y)
        for (int x = 0; x < light.sizePixels.x; ++x) {
            const auto point = hall_.pointSeen({x + 0.5, y + 0.5});
            if (!point) continue;
            const double off = glm::distance(*point, *middle) / lamp->radiusMetres;
            light.at(x, y) += static_cast<float>(lamp->light * std::exp(-off * off));
        }
}

// Before the sensor, as a share of the most that it takes.
Light SimulatedCamera::arriving(std::size_t index) const {
    const config::HallFaults& faults = hall_.hall().faults;
    const std::size_t shown = faults.latePicture == index && index > 0 ? index - 1 : index;
    const config::ScanPattern& pattern = scan_.pictures[shown].pattern;
    const bool isBefore = faults.moved && index < faults.moved->fromPicture;
    const SeenHall& seen = isBefore ? *seenBefore_ : *seen_;
    std::vector<Light> codes;
    for (std::size_t i = 0; i < hall_.channels(); ++i)
        codes.push_back(codesOf(pattern, i, hall_.rig().channels[i].sizePixels));
    Light light = seen.lit(codes);
    const bool isRoom = pattern.kind == config::ScanPattern::Kind::Room;
    const Light lamps = seen.lampLit(isRoom ? hall_.hall().roomLight : hall_.hall().darkLight);
    for (std::size_t i = 0; i < light.rgb.size(); ++i) light.rgb[i] += lamps.rgb[i];
    addLamp(index, light);
    return light;
}

Picture SimulatedCamera::picture(std::size_t index) {
    const config::HallCamera& camera = hall_.hall().camera;
    const config::HallFaults& faults = hall_.hall().faults;
    Light light = arriving(index);
    blur(light, camera.blurPixels);
    double gain = gain_;
    if (faults.autoExposure) {
        double mean = 0;
        for (const glm::vec3& rgb : light.rgb)
            mean += static_cast<double>(rgb.y) / static_cast<double>(light.rgb.size());
        gain = 0.2 / std::max(1e-4, mean);
    }
    const glm::ivec2 size = light.sizePixels;
    Picture picture{.sizePixels = size, .bits = camera.bits > 8 ? 16 : 8, .rgb = {}};
    picture.rgb.resize(3 * light.rgb.size());
    const double most = std::exp2(camera.bits) - 1;
    const double scale = (std::exp2(picture.bits) - 1) / most;
    const std::uint32_t seed = hashOf(seed_, static_cast<std::uint32_t>(index));
    WorkerPool(threads()).run(static_cast<std::size_t>(size.y), [&](std::size_t row) {
        for (int x = 0; x < size.x; ++x) {
            const std::size_t i = indexIn(size, x, static_cast<int>(row));
            const glm::dvec2 pixel(x + 0.5, static_cast<double>(row) + 0.5);
            const double dimmed = gain * hall_.cameraLens().vignetted(pixel);
            const glm::dvec2 off =
                faults.blocked
                    ? (pixel / glm::dvec2(size) - faults.blocked->place) / faults.blocked->radius
                    : glm::dvec2(2);
            const double blocked = glm::dot(off, off) < 1 ? 0 : 1;
            for (std::size_t c = 0; c < 3; ++c) {
                const double arrived =
                    blocked * dimmed * static_cast<double>(light.rgb[i][static_cast<int>(c)]);
                const double code = codeOf(arrived, camera, noiseAt(seed, 3 * i + c));
                picture.rgb[3 * i + c] =
                    static_cast<std::uint16_t>(std::lround(std::round(code * most) * scale));
            }
        }
    });
    return picture;
}

}  // namespace aquarama::hall
