// SPDX-License-Identifier: Apache-2.0
#include "calibration/compose/film.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <optional>
#include <vector>

#include "calibration/compose/clip.h"
#include "calibration/compose/compose.h"
#include "common/base/counted.h"
#include "common/base/log.h"
#include "common/cli/command_line.h"
#include "common/cli/outputs.h"
#include "common/cli/progress.h"
#include "common/net/channels.h"

namespace aquarama::compose {

namespace {

// The channels that make the picture: all, or the one of this name.
std::vector<config::Channel> filmedChannels(const config::Rig& rig, const std::string& of) {
    if (of == kPanorama || of == kHall) return rig.channels;
    const auto named = std::ranges::find(rig.channels, of, &config::Channel::name);
    if (named == rig.channels.end())
        throw Error("rig \"" + rig.name + "\" has no channel \"" + of + "\"; film " + kPanorama +
                    ", " + kHall + " or one of its channels");
    return {*named};
}

// A frame of one channel.
struct FilmedFrame {
    std::uint64_t frame = 0;
    Picture picture;  // 8 bits
};

// Composes a picture of the clip from one frame of each filmed channel. Keeps a reference to the
// rig.
class Camera {
  public:
    Camera(const config::Rig& rig, const Filming& filming)
        : rig_{rig}, of_{filming.of}, fromFrame_{filming.fromFrame} {
        if (of_ != kPanorama && of_ != kHall) return;
        map_.emplace(rig);
        projectors_.emplace(rig);
    }
    [[nodiscard]] glm::ivec2 sizePixels(const std::vector<config::Channel>& filmed) const {
        if (!map_) return filmed.front().sizePixels;
        return of_ == kHall ? kHallPixels : rig_.panoramaPixels;
    }
    [[nodiscard]] Picture pictureOf(const std::vector<FilmedFrame>& frames) const {
        if (!map_) return frames.front().picture;
        const std::vector<Light> channels = channelsOf(frames);
        const Light panorama = map_->compose(channels);
        const auto seed = static_cast<std::uint32_t>(fromFrame_ + frames.front().frame);
        return aquarama::pictureOf(
            of_ == kHall ? composeHall(rig_, panorama, kHallPixels, channels) : panorama, 8, seed);
    }
    // The panorama and the hall of one frame; needs the frames of all channels.
    void writePictures(const std::vector<FilmedFrame>& frames, const std::string& folder) const {
        const std::vector<Light> channels = channelsOf(frames);
        writePanoramaAndHall(rig_, map_->compose(channels), channels, folder, 8);
        std::cout << "first picture: " << folder << "/panorama.png, " << folder << "/hall.png"
                  << std::endl;
    }

  private:
    [[nodiscard]] std::vector<Light> channelsOf(const std::vector<FilmedFrame>& frames) const {
        std::vector<Light> channels;
        channels.reserve(frames.size());
        for (const FilmedFrame& frame : frames)
            channels.push_back(projectors_->thrown(channels.size(), frame.picture));
        return channels;
    }

    const config::Rig& rig_;
    std::string of_;
    std::uint64_t fromFrame_;
    // Unless a channel is shown as it is.
    std::optional<PanoramaMap> map_;
    std::optional<Projectors> projectors_;
};

std::uint64_t picturesIn(const Filming& filming) {
    const auto between = static_cast<std::uint64_t>(filming.ticksBetween);
    return (filming.frames.value_or(0) + between - 1) / between;
}

// Receives the frames of the nodes of some channels.
class FilmedChannels {
  public:
    FilmedChannels(const std::filesystem::path& folder, std::vector<config::Channel> channels)
        : channels_{std::move(channels)} {
        for (const config::Channel& channel : channels_)
            receivers_.push_back(net::bindFrames(net::frameSocket(folder, channel.name)));
    }
    // The next frame of every channel; nothing as soon as one has ended.
    std::optional<std::vector<FilmedFrame>> nextFrame() {
        std::vector<FilmedFrame> frames;
        for (std::size_t i = 0; i < channels_.size(); ++i) {
            auto frame = nextOf(i);
            if (!frame) return std::nullopt;
            if (!frames.empty() && frame->frame != frames.front().frame)
                throw Error("channel \"" + channels_[i].name + "\" sent frame " +
                            std::to_string(frame->frame) + " where others sent " +
                            std::to_string(frames.front().frame) + "; film in lockstep");
            frames.push_back(std::move(*frame));
        }
        return frames;
    }

  private:
    std::optional<FilmedFrame> nextOf(std::size_t place) {
        auto raw = receivers_[place]->receive();
        if (!raw) return std::nullopt;
        const config::Channel& channel = channels_[place];
        const glm::ivec2 size(raw->width, raw->height);
        if (size != channel.sizePixels)
            throw Error("channel \"" + channel.name + "\" sent a frame of " +
                        std::to_string(size.x) + " x " + std::to_string(size.y) +
                        " pixels; film with the rig of the show");
        return FilmedFrame{raw->frame, {size, 8, std::move(raw->rgb)}};
    }

    std::vector<config::Channel> channels_;
    std::vector<std::unique_ptr<net::FrameReceiver>> receivers_;
};

}  // namespace

void film(const config::Rig& rig, const Filming& filming) {
    assert(filming.ticksBetween > 0);
    const std::vector<config::Channel> channels = filmedChannels(rig, filming.of);
    std::optional<FilmedChannels> filmed(std::in_place, filming.pipes, channels);
    cli::holdSignals();  // the clip ends with its nodes: what was shown until then is kept
    const Camera camera(rig, filming);
    const auto clip =
        makeClip({filming.clipPath, camera.sizePixels(channels), filming.ticksBetween});
    auto frames = filmed->nextFrame();
    if (!frames) throw Error(filming.clipPath + ": no frame was shown; let the show run for more");
    if (!filming.firstPictures.empty()) camera.writePictures(*frames, filming.firstPictures);
    cli::Progress progress("clip: picture", picturesIn(filming));
    std::uint64_t pictures = 0;
    for (; frames; frames = filmed->nextFrame()) {
        clip->add(camera.pictureOf(*frames), frames->front().frame);
        progress.count(++pictures);
    }
    filmed.reset();  // the nodes need not wait for the encoder's last pictures
    clip->finish();
    progress.end();
    cli::say(fmt::format(
        "clip of the {} in {}: {}", filming.of, filming.clipPath, counted(pictures, "picture")));
}

void encode(const SentPictures& sent) {
    assert(sent.ticksBetween > 0);
    auto sender = net::bindFrames(sent.pipe);
    cli::holdSignals();  // the clip ends with its sender
    std::optional<net::RawFrame> frame = sender->receive();
    if (!frame) throw Error(sent.clipPath + ": no picture came; see why its program ended");
    const glm::ivec2 size(frame->width, frame->height);
    const auto clip = makeClip({sent.clipPath, size, sent.ticksBetween});
    for (; frame; frame = sender->receive()) {
        if (size != glm::ivec2(frame->width, frame->height))
            throw Error(sent.clipPath + ": a picture has another size; send all alike");
        clip->add({size, 8, std::move(frame->rgb)}, frame->frame);
    }
    clip->finish();
}

}  // namespace aquarama::compose
