// SPDX-License-Identifier: Apache-2.0
#include "calibration/theatre/film.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <vector>

#include "calibration/theatre/clip.h"
#include "calibration/theatre/compose.h"
#include "common/cli/signals.h"
#include "common/units/error.h"
#include "common/wall/frame_pipe.h"

namespace aquarama {

namespace {

// The channels that make the picture: all, or the one of this name.
std::vector<Channel> filmedChannels(const Rig& rig, const std::string& of) {
    if (of == kPanorama || of == kHall) return rig.channels;
    const auto named = std::ranges::find(rig.channels, of, &Channel::name);
    if (named == rig.channels.end())
        throw Error("rig \"" + rig.name + "\" has no channel \"" + of + "\"; film " + kPanorama +
                    ", " + kHall + " or one of its channels");
    return {*named};
}

class Camera {
  public:
    Camera(const Rig& rig, std::string of) : rig_{rig}, of_{std::move(of)} {
        if (of_ == kPanorama || of_ == kHall) map_.emplace(rig);
    }
    [[nodiscard]] glm::ivec2 sizePixels(const std::vector<Channel>& filmed) const {
        if (!map_) return filmed.front().sizePixels;
        return of_ == kHall ? kHallPixels : rig_.panoramaPixels;
    }
    [[nodiscard]] Picture pictureOf(const std::vector<PipedFrame>& frames) const {
        if (!map_) return frames.front().picture;
        std::vector<Light> channels;
        for (const PipedFrame& frame : frames) channels.push_back(lightOf(frame.picture));
        const Light panorama = map_->compose(channels);
        const auto seed = static_cast<std::uint32_t>(frames.front().frame);
        return aquarama::pictureOf(
            of_ == kHall ? composeHall(rig_, panorama, kHallPixels) : panorama, 8, seed);
    }

  private:
    const Rig& rig_;
    std::string of_;
    std::optional<PanoramaMap> map_;  // unless a channel is shown as it is
};

// The next frame of every channel; nothing as soon as one has ended.
std::optional<std::vector<PipedFrame>> nextFrame(std::deque<FramePipeReader>& pipes,
                                                 const std::vector<Channel>& channels) {
    std::vector<PipedFrame> frames;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        auto frame = pipes[i].read(channels[i].sizePixels);
        if (!frame) return std::nullopt;
        if (!frames.empty() && frame->frame != frames.front().frame)
            throw Error("channel \"" + channels[i].name + "\" sent frame " +
                        std::to_string(frame->frame) + " where others sent " +
                        std::to_string(frames.front().frame) + "; film in lockstep");
        frames.push_back(std::move(*frame));
    }
    return frames;
}

}  // namespace

void film(const Rig& rig, const Filming& filming) {
    const std::vector<Channel> channels = filmedChannels(rig, filming.of);
    std::deque<FramePipeReader> pipes;
    for (const Channel& channel : channels)
        pipes.emplace_back(framePipe(filming.pipes, channel.name));
    holdSignals();  // the end of the nodes is the clip's: what was shown until then is kept
    const Camera camera(rig, filming.of);
    const auto clip =
        makeClip({filming.clipPath, camera.sizePixels(channels), filming.ticksBetween});
    bool any = false;
    while (const auto frames = nextFrame(pipes, channels)) {
        clip->add(camera.pictureOf(*frames), frames->front().frame);
        any = true;
    }
    if (!any) throw Error(filming.clipPath + ": no frame was shown; let the show run for more");
    clip->finish();
}

}  // namespace aquarama
