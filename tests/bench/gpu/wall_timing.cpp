// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/gpu/wall_timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include <epoxy/gl.h>

#include "render_node/show/channel_picture.h"
#include "render_node/show/snapshot.h"

namespace aquarama::bench {

namespace {

constexpr int kFirstFrames = 4;  // in which the driver compiles and allocates

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Calls for frame after frame while patience lasts; returns how many.
template <class Frame>
std::size_t repeat(const Patience& patience, const Frame& frame) {
    const auto start = Clock::now();
    std::size_t frames = 0;
    while (frames < patience.mostFrames &&
           (frames < patience.leastFrames || millisecondsSince(start) < 1000 * patience.seconds))
        frame(frames++);
    return frames;
}

}  // namespace

DrawnWall::DrawnWall(const Sea& sea, const config::Rig& rig, config::QualityTier quality)
    : sea_{sea} {
    session::Admission admission = sea.admission;
    admission.rig = rig;
    for (std::size_t channel = 0; channel < rig.channels.size(); ++channel) {
        channels_.emplace_back(admission, channel, quality);
        targets_.emplace_back(GL_RGBA8, rig.channels[channel].sizePixels);
    }
    for (int i = 0; i < kFirstFrames; ++i) draw(sea_.frames.front());
    glFinish();
}

void DrawnWall::draw(const wire::StateFrame& frame) {
    for (std::size_t i = 0; i < channels_.size(); ++i) {
        channels_[i].drawScene(frame, {});
        channels_[i].project(targets_[i].framebuffer(), show::Encoding::Dithered8, {});
    }
}

FrameTimes DrawnWall::timeFrames(const Patience& patience) {
    FrameTimes times;
    const std::clock_t cpu = std::clock();
    const std::size_t frames = repeat(patience, [&](std::size_t i) {
        const auto start = Clock::now();
        draw(sea_.frames[i % sea_.frames.size()]);
        glFinish();
        times.wall.push_back(millisecondsSince(start));
    });
    times.cpu = 1000.0 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC /
                static_cast<double>(frames);
    return times;
}

StageTimes DrawnWall::timeStages(const Patience& patience, Clocked clocked, bool withPixels) {
    struct Samples {
        std::vector<double> gpu, cpu;
        StageWork work;
    };
    std::map<std::string, Samples> samples;
    StageClock clock{clocked};
    if (!withPixels) glEnable(GL_RASTERIZER_DISCARD);
    repeat(patience, [&](std::size_t i) {
        clock.begin();
        draw(sea_.frames[i % sea_.frames.size()]);
        for (const auto& [stage, time] : clock.end()) {
            samples[stage].gpu.push_back(time.gpu);
            samples[stage].cpu.push_back(time.cpu);
            samples[stage].work = time.work;
        }
    });
    glDisable(GL_RASTERIZER_DISCARD);
    StageTimes medians;
    for (const auto& [stage, of] : samples)
        medians[stage] = {percentile(of.gpu, 0.5), percentile(of.cpu, 0.5), of.work};
    return medians;
}

std::vector<Light> DrawnWall::lights() {
    draw(sea_.frames.front());
    std::vector<Light> lights;
    for (show::ChannelPicture& channel : channels_)
        lights.push_back(lightOf(
            show::takePicture(channel, show::PictureBits::Dithered8, show::Shown::Display)));
    return lights;
}

double percentile(std::vector<double> samples, double share) {
    const auto count = static_cast<double>(samples.size());
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * count)) - 1;
    std::nth_element(samples.begin(), samples.begin() + rank, samples.end());
    return samples[static_cast<std::size_t>(rank)];
}

}  // namespace aquarama::bench
